//! What a file says about itself: the lines that begin with `//?`.

use octrace::{Bounds, Ray, Vec3};

/// What is right for one scene.
#[derive(Debug, Default)]
pub struct Expected {
    /// The volume, where it is finite.
    pub volume: Option<f64>,
    /// Where something is.
    pub extent: Option<Extent>,
    /// Rays through the delicate places.
    pub probes: Vec<Probe>,
    /// Pictures.
    pub sights: Vec<Sight>,
    /// All colours that are named.
    pub colors: Vec<String>,
}

/// Where something is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// Nowhere.
    Empty,
    /// There is no end to it.
    Unbounded,
    /// In this box, and no smaller one; its sides may be off by so much, relative to its diagonal.
    Box { bounds: Bounds, within: f64 },
}

/// A ray and the spans of its line.
#[derive(Debug)]
pub struct Probe {
    pub ray: Ray,
    pub spans: Vec<SeenSpan>,
    /// How far the ends may be off, relative to their size where that exceeds 1.
    pub within: f64,
}

/// A span and the colours that are seen at its ends; `none` where there is no end.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenSpan {
    pub ends: [f64; 2],
    pub colors: [String; 2],
}

/// From where to look at the scene.
#[derive(Clone, Copy, Debug)]
pub enum From {
    /// The scene's own camera, or the default view of everything.
    Scene,
    /// An orthographic view of everything, along a direction.
    Along(Vec3),
    /// An orthographic view that is so high.
    Point { eye: Vec3, at: Vec3, height: f64 },
}

/// A view and what is seen in it.
#[derive(Debug)]
pub struct Sight {
    /// The line, for messages.
    pub line: String,
    pub from: From,
    /// In how many connected regions each colour is seen, sorted; the background is `nothing`.
    pub regions: Vec<(String, usize)>,
    /// In how many regions part and normal are the same.
    pub faces: Option<usize>,
}

/// Where a file says nothing about its accuracy: rounding.
const ROUNDING: f64 = 1e-12;
/// The same for boxes, which are searched for.
const SEARCHED: f64 = 1e-6;

impl Expected {
    /// Reads the lines of a file.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut expected = Self::default();
        for line in text.lines().filter_map(|line| line.strip_prefix("//?")) {
            expected.line(line.trim()).ok_or_else(|| format!("what does `//?{line}` mean?"))?;
        }
        let spans = expected.probes.iter().flat_map(|probe| &probe.spans).flat_map(|span| &span.colors);
        let regions = expected.sights.iter().flat_map(|sight| &sight.regions).map(|(color, _)| color);
        let mut colors: Vec<String> = spans.chain(regions).filter(|color| !is_void(color)).cloned().collect();
        colors.sort();
        colors.dedup();
        if let Some(unknown) = colors.iter().find(|color| csscolorparser::parse(color).is_err()) {
            return Err(format!("no colour is called `{unknown}`"));
        }
        expected.colors = colors;
        Ok(expected)
    }

    fn line(&mut self, line: &str) -> Option<()> {
        let (what, rest) = line.split_once(' ')?;
        match what {
            "volume" => self.volume = Some(rest.parse().ok()?),
            "box" => self.extent = Some(extent(rest)?),
            "ray" => self.probes.push(probe(rest)?),
            "along" | "from" => self.sights.push(sight(line)?),
            _ => return None,
        }
        Some(())
    }
}

/// Whether that is the colour of nothing: where rays meet nothing, or spans have no end.
fn is_void(color: &str) -> bool {
    matches!(color, "nothing" | "none")
}

/// Three numbers in brackets, and what comes after them.
fn vector(text: &str) -> Option<(Vec3, &str)> {
    let (inner, rest) = text.trim_start().strip_prefix('[')?.split_once(']')?;
    let numbers: Vec<f64> = inner.split(',').map(|n| n.trim().parse().ok()).collect::<Option<_>>()?;
    let [x, y, z] = numbers.try_into().ok()?;
    Some((Vec3::new(x, y, z), rest))
}

fn extent(text: &str) -> Option<Extent> {
    match text {
        "empty" => Some(Extent::Empty),
        "unbounded" => Some(Extent::Unbounded),
        corners => {
            let (min, rest) = vector(corners)?;
            let (max, rest) = vector(rest)?;
            let within = rest.strip_prefix(" within ").map_or(Some(SEARCHED), |within| within.parse().ok())?;
            Some(Extent::Box { bounds: Bounds { min, max }, within })
        }
    }
}

fn probe(text: &str) -> Option<Probe> {
    let (ray, spans) = text.split_once(": ")?;
    let (origin, rest) = vector(ray)?;
    let (direction, _) = vector(rest)?;
    let (spans, within) = match spans.split_once(" within ") {
        Some((spans, within)) => (spans, within.parse().ok()?),
        None => (spans, ROUNDING),
    };
    let spans = match spans {
        "nothing" => Vec::new(),
        spans => spans.split(',').map(|span| seen_span(span.trim())).collect::<Option<_>>()?,
    };
    Some(Probe { ray: Ray { origin, direction }, spans, within })
}

/// For example `red 8..9 blue`.
fn seen_span(text: &str) -> Option<SeenSpan> {
    let [first, ends, last] = text.split(' ').collect::<Vec<_>>().try_into().ok()?;
    let (enter, exit) = ends.split_once("..")?;
    let ends = [enter.parse().ok()?, exit.parse().ok()?];
    Some(SeenSpan { ends, colors: [first.into(), last.into()] })
}

fn sight(line: &str) -> Option<Sight> {
    let (place, seen) = line.split_once(": ")?;
    let from = match place.strip_prefix("along ") {
        Some(direction) => From::Along(vector(direction)?.0),
        None => {
            let (eye, rest) = vector(place.strip_prefix("from ")?)?;
            let (at, rest) = vector(rest.trim_start().strip_prefix("to ")?)?;
            From::Point { eye, at, height: rest.trim_start().strip_prefix("high ")?.parse().ok()? }
        }
    };
    let (seen, faces) = match seen.split_once("; faces ") {
        Some((seen, faces)) => (seen, Some(faces.parse().ok()?)),
        None => (seen, None),
    };
    let region = |text: &str| -> Option<(String, usize)> {
        let (color, regions) = text.trim().split_once(' ')?;
        Some((color.into(), regions.parse().ok()?))
    };
    let mut regions: Vec<_> = seen.split(',').map(region).collect::<Option<_>>()?;
    regions.sort();
    Some(Sight { line: line.into(), from, regions, faces })
}

#[test]
fn expectations_are_read() {
    let text = "cube(1);\n//? volume 1\n//? box [0, 0, 0] [1, 1, 1]\n\
        //? ray [0, 0, 9] [0, 0, -1]: red 8..9 blue, none -inf..2.5 red within 1e-3\n\
        //? along [0, 0, -1]: red 1, nothing 2; faces 3\n";
    let expected = Expected::parse(text).expect("all is well");
    assert_eq!(expected.volume, Some(1.0));
    let bounds = Bounds { min: Vec3::ZERO, max: Vec3::splat(1.0) };
    assert_eq!(expected.extent, Some(Extent::Box { bounds, within: 1e-6 }));
    let [probe] = &expected.probes[..] else { panic!("one ray") };
    assert_eq!((probe.ray, probe.within), (Ray::new([0.0, 0.0, 9.0], [0.0, 0.0, -1.0]), 1e-3));
    let colors = |first: &str, last: &str| [first.to_owned(), last.to_owned()];
    let second = SeenSpan { ends: [f64::NEG_INFINITY, 2.5], colors: colors("none", "red") };
    assert_eq!(probe.spans, [SeenSpan { ends: [8.0, 9.0], colors: colors("red", "blue") }, second]);
    let [sight] = &expected.sights[..] else { panic!("one view") };
    assert_eq!(sight.regions, [("nothing".to_owned(), 2), ("red".to_owned(), 1)]);
    assert_eq!((sight.faces, &expected.colors[..]), (Some(3), &["blue".to_owned(), "red".to_owned()][..]));
}

#[test]
fn what_is_not_understood_is_not_passed_over() {
    for line in ["volume one", "ray [0, 0] [1, 0, 0]: nothing", "along [0, 0, 1]: red", "colour red", "ray"] {
        assert!(Expected::parse(&format!("//? {line}")).is_err(), "{line}");
    }
    assert!(Expected::parse("//? along [0, 0, 1]: reddish 1").is_err());
}
