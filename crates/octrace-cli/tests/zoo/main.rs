//! The zoo of coincident, nearly coincident and touching surfaces: each file of `scenes/zoo` states what is right in lines
//! that begin with `//?`, and is held to it.
//!
//! | line | says |
//! |---|---|
//! | `volume 12.5` | the volume |
//! | `box [0, 0, 0] [1, 2, 3]` | the smallest box around everything; `box empty`, `box unbounded` |
//! | `ray [0, 0, 9] [0, 0, -1]: red 8..9 blue` | the spans of that whole line, with the colours seen at their ends; `nothing` |
//! | `along [0, 0, -1]: red 1, nothing 2; faces 3` | an orthographic view of everything, in that direction |
//! | `from [9, 0, 0] to [0, 0, 0] high 4: ...` | an orthographic view of that height |
//!
//! Spans are separated by commas; they and boxes may end with `within 1e-5`; an end at infinity has the colour `none`; transparent
//! bodies have spans of their own. A view names each colour that is seen and in how many connected regions: one speck
//! more is a mistake. So is one in a face: `faces` counts regions in which part and normal are the same. Views without
//! such lines are only held to the same bits.

mod answers;
mod expected;
mod views;

use expected::Expected;
use octrace::exec::Exec;
use octrace::octree::BuildOptions;
use octrace::traverse::TraversalKind;
use octrace::{Accel, PartId, Rgb, Scene, Tracer, TracerOptions};
use octrace_read::{ReadOptions, Source, read_scene};
use std::fs;
use std::path::{Path, PathBuf};

/// A scene of the zoo, and what is right for it.
struct Exhibit {
    scene: Scene,
    expected: Expected,
}

impl Exhibit {
    fn open(path: &Path) -> Result<Self, String> {
        let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
        let expected = Expected::parse(&text)?;
        let checked = read_scene(&Source::new(file_name(path), text.into_bytes()), &ReadOptions::default());
        let scene = checked.value.ok_or_else(|| format!("{:?}", checked.diagnostics))?.scene;
        Ok(Self { scene, expected })
    }

    fn tracer(&self, options: &TracerOptions) -> Tracer {
        tracer(&self.scene, options)
    }

    /// The name of the part's colour, if the file's expectations name it.
    fn color(&self, part: Option<PartId>) -> &str {
        let actual = self.scene.material(part).color;
        let near = |a: f64, b: f64| (a - b).abs() < 1e-3;
        let same = |name: &&String| {
            let Rgb { r, g, b } = named(name);
            near(r, actual.r) && near(g, actual.g) && near(b, actual.b)
        };
        self.expected.colors.iter().find(same).map_or("unexpected", |name| name.as_str())
    }
}

fn tracer(scene: &Scene, options: &TracerOptions) -> Tracer {
    let options = TracerOptions { snap: scene.snap, ..*options };
    Tracer::build_bodies(&scene.bodies().solids, &options, &Exec::with_threads(1)).expect("nobody cancels")
}

/// A colour of the web, as in scenes.
fn named(color: &str) -> Rgb {
    let [r, g, b, _] = csscolorparser::parse(color).expect("checked when it was read").to_array();
    Rgb::from_srgb([r, g, b].map(f64::from))
}

/// Without an octree: the reference.
fn canonical() -> TracerOptions {
    TracerOptions { accel: Accel::None, ..TracerOptions::default() }
}

/// The default, with its tiles; small and large cells; every other way to walk.
fn accelerations() -> Vec<TracerOptions> {
    let usual = TracerOptions::default();
    let sizes = [BuildOptions { leaf_surfaces: 1, depth: Some(7) }, BuildOptions { leaf_surfaces: 3, depth: Some(2) }];
    let sized = sizes.into_iter().map(|octree| TracerOptions { octree, ..usual });
    let walks = TraversalKind::ALL.into_iter().filter(|&traversal| traversal != usual.traversal);
    let walked = walks.map(|traversal| TracerOptions { traversal, ..usual });
    std::iter::once(usual).chain(sized).chain(walked).collect()
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/zoo")
}

fn file_name(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

fn files() -> Vec<PathBuf> {
    let entries = fs::read_dir(folder()).expect("the zoo is readable");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("the zoo is readable").path()).collect();
    files.sort();
    files
}

/// Looks at every file and says all that is wrong with any.
fn inspect(wrong: impl Fn(&Exhibit) -> Vec<String>) {
    let mut all = Vec::new();
    for file in files() {
        let found = Exhibit::open(&file).map_or_else(|error| vec![error], |exhibit| wrong(&exhibit));
        all.extend(found.into_iter().map(|what| format!("{}: {what}", file_name(&file))));
    }
    assert!(all.is_empty(), "{} mistakes\n{}", all.len(), all.join("\n"));
}

#[test]
fn rays_see_what_is_there() {
    inspect(answers::wrong_rays);
}

#[test]
fn volume_and_extent_are_right() {
    inspect(answers::wrong_measures);
}

#[test]
fn views_show_what_they_must_and_no_speck_more() {
    inspect(views::wrong_regions);
}

#[test]
fn light_reaches_every_surface_that_faces_it() {
    inspect(views::wrong_light);
}

#[test]
fn pictures_have_the_same_bits_by_every_acceleration() {
    inspect(views::wrong_bits);
}
