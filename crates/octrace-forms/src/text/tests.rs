//! Against what OpenSCAD 2021.01 makes of the same texts.

use super::*;
use crate::curve::signed_area;
use crate::plane::{Fill, region};
use octrace::Curve;

/// Text, font, size, spacing, horizontal and vertical alignment, direction, chords of a circle of that size.
type Setting = (&'static str, &'static str, f64, f64, &'static str, &'static str, &'static str, u32);

/// With the box around OpenSCAD's text (least and greatest x, then y), and its area.
type Known = (Setting, [f64; 4], f64);

#[rustfmt::skip]
const LIBERATION: &[Known] = &[
    (("Hello, World!", "Liberation Sans", 10.0, 1.0, "left", "baseline", "ltr", 30), [1.1393, 76.2155, -1.7767, 10.0634], 228.8161),
    (("AVAToVo", "Liberation Sans", 10.0, 1.0, "center", "center", "ltr", 30), [-27.1163, 26.7408, -4.7325, 4.9579], 165.0316),
    (("fi ffl", "Liberation Sans:style=Bold Italic", 10.0, 1.0, "right", "top", "ltr", 30), [-24.1084, 0.3275, -9.8312, 0.2321], 106.3181),
    (("Qgjp@&%", "Liberation Serif:style=Bold", 7.0, 1.2, "left", "bottom", "ltr", 22), [0.4747, 53.5876, -0.0499, 8.8410], 132.1808),
    (("Stacked", "Liberation Sans", 10.0, 1.0, "left", "baseline", "ttb", 30), [-3.8926, 4.1025, -87.7213, -1.3363], 158.6341),
    (("btt", "Liberation Mono", 10.0, 1.0, "right", "center", "btt", 30), [-8.8933, -2.7155, -15.8481, 15.6572], 62.1991),
];

#[rustfmt::skip]
const DEJAVU: &[Known] = &[
    (("Hello", "DejaVu Sans", 10.0, 1.0, "left", "baseline", "ltr", 30), [1.3630, 33.8178, -0.1984, 10.5536], 110.4306),
    (("Gebäude", "DejaVu Sans", 5.0, 1.0, "center", "center", "ltr", 16), [-14.9417, 15.0619, -2.6273, 2.7487], 49.8991),
    (("AVA fi office", "DejaVu Sans", 10.0, 1.1, "right", "top", "ltr", 30), [-88.4189, -1.3739, -10.5046, 0.2473], 238.2442),
    (("B8&", "DejaVu Sans:style=Bold", 20.0, 1.0, "center", "bottom", "ltr", 64), [-29.0539, 31.0035, -0.0093, 21.0083], 719.7403),
    (("Quirky", "DejaVu Serif:style=Italic", 10.0, 1.25, "left", "baseline", "rtl", 8), [-0.5154, 55.2427, -3.0855, 10.5516], 135.8643),
    (("שלום", "DejaVu Sans", 10.0, 1.0, "left", "baseline", "rtl", 30), [1.2613, 29.6475, 0.0000, 10.1248], 81.2911),
    (("ЖΩд", "DejaVu Sans", 10.0, 1.0, "left", "center", "ltr", 30), [0.2713, 33.8510, -5.9856, 6.1808], 120.6059),
    (("VOX", "DejaVu Sans", 10.0, 1.0, "center", "top", "ttb", 30), [-9.1393, 0.2323, 1.8411, 39.0927], 91.8330),
];

/// Corners of the box around all ends of strokes.
fn bounds(paths: &Paths) -> [f64; 4] {
    let points = paths.iter().flatten().map(|edge| edge.from);
    points.fold([f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY], |[a, b, c, d], p| {
        [a.min(p.x), b.max(p.x), c.min(p.y), d.max(p.y)]
    })
}

fn bundled() -> FontSource {
    FontSource::files(vec![
        dejavu::sans::regular().to_vec(),
        dejavu::sans::bold().to_vec(),
        dejavu::serif::italic().to_vec(),
    ])
}

fn spec_of(setting: &Setting) -> TextSpec<'static> {
    let &(text, font, size, spacing, halign, valign, direction, facets) = setting;
    let facets = Some(facets);
    TextSpec { text, font, size, spacing, halign, valign, direction, facets, ..TextSpec::default() }
}

fn check((setting, expected, area): &Known, fonts: &FontSource) {
    let spec = spec_of(setting);
    let made = outline(&spec, fonts).unwrap();
    assert_eq!(made.warnings, [], "{setting:?}");
    // OpenSCAD moves points to whole pixels, of which an em has 2170.
    // Where glyphs hang from is moved to whole pixels there, not here.
    let off = if matches!(spec.direction, "ttb" | "btt") { 5e-4 } else { 1e-5 };
    for (actual, expected) in bounds(&made.paths).into_iter().zip(expected) {
        assert!(
            (actual - expected).abs() < off * spec.size + 1e-4,
            "{setting:?}: {:?}, not {expected}",
            bounds(&made.paths)
        );
    }
    // Glyphs may overlap.
    let actual = region(&made.paths, Fill::NonZero).unwrap().area();
    assert!((actual / area - 1.0).abs() < 2e-5, "{setting:?}: area {actual}, not {area}");
    // Arcs enclose what very many chords do, but for the pixels that chords are moved to.
    let arcs = signed_area(&outline(&TextSpec { facets: None, ..spec }, fonts).unwrap().paths);
    let chords = signed_area(&outline(&TextSpec { facets: Some(800), ..spec }, fonts).unwrap().paths);
    assert!((arcs / chords - 1.0).abs() < 1e-3, "{setting:?}: {arcs} {chords}");
}

#[test]
fn texts_are_as_wide_and_as_high_as_those_of_openscad() {
    let fonts = bundled();
    DEJAVU.iter().for_each(|known| check(known, &fonts));
}

#[test]
fn also_with_the_font_that_is_usual_there() {
    let fonts = FontSource::system(Vec::new());
    let probe = outline(&TextSpec { text: "x", ..TextSpec::default() }, &fonts);
    match probe {
        Ok(made) if made.font == "Liberation Sans" => LIBERATION.iter().for_each(|known| check(known, &fonts)),
        _ => eprintln!("skipped: the Liberation fonts are not installed"),
    }
}

#[test]
fn arcs_follow_each_other_smoothly() {
    let spec = TextSpec { text: "O", font: "DejaVu Sans", ..TextSpec::default() };
    let made = outline(&spec, &bundled()).unwrap();
    assert_eq!(made.paths.len(), 2);
    for contour in &made.paths {
        assert!((8..100).contains(&contour.len()), "{}", contour.len());
        for (i, edge) in contour.iter().enumerate() {
            let next = &contour[(i + 1) % contour.len()];
            let way = |edge: &octrace::Edge| match edge.curve {
                Curve::Line => None,
                Curve::Arc { center, radius, ccw } => {
                    Some((next.from - center).left() * (if ccw { 1.0 } else { -1.0 } / radius))
                }
            };
            let (Some(before), Some(after)) = (way(edge), way(next)) else { panic!("a line in {contour:?}") };
            assert!(before.dot(after) > 0.999, "a corner at {:?}", next.from);
        }
    }
}

#[test]
fn what_stands_in_for_a_font_is_said() {
    let fonts = bundled();
    let made = outline(&TextSpec { text: "x", ..TextSpec::default() }, &fonts).unwrap();
    assert_eq!(made.font, "DejaVu Sans");
    assert_eq!(made.warnings[0].to_string(), "there is no font `Liberation Sans`; `DejaVu Sans` is used instead");
    assert!(made.warnings[0].help().unwrap().contains("fonts-liberation"));
    let bold = outline(&TextSpec { text: "x", font: "Nowhere:bold", ..TextSpec::default() }, &fonts).unwrap();
    assert_eq!(bold.font, "DejaVu Sans Bold");
    let generic = outline(&TextSpec { text: "x", font: "sans", ..TextSpec::default() }, &fonts).unwrap();
    assert_eq!(generic.warnings, []);

    let error = outline(&TextSpec::default(), &FontSource::files(Vec::new())).unwrap_err();
    assert_eq!(error.to_string(), "there is no font `Liberation Sans`, and no other that could stand for it");
    let junk = FontSource::files(vec![b"no font at all".to_vec()]);
    assert!(outline(&TextSpec::default(), &junk).is_err());
}

#[test]
fn what_is_odd_is_said() {
    let spec = TextSpec {
        text: "a\u{10ffff}",
        font: "DejaVu Sans",
        halign: "middle",
        valign: "up",
        script: "??",
        direction: "",
        language: "",
        ..TextSpec::default()
    };
    let made = outline(&spec, &bundled()).unwrap();
    let said: Vec<String> = made.warnings.iter().map(ToString::to_string).collect();
    let expected =
        ["the font `DejaVu Sans` has no glyphs for `\u{10ffff}`", "`middle` is no halign", "`up` is no valign"];
    assert_eq!(said, expected);
    for spec in [
        TextSpec { size: f64::NAN, ..spec },
        TextSpec { spacing: f64::INFINITY, ..spec },
        TextSpec { size: 0.0, ..spec },
        TextSpec { text: "", ..spec },
        TextSpec { size: -3.0, ..spec },
        TextSpec { text: "\u{202e}\u{200d}\n\t\u{301}", ..spec },
    ] {
        assert!(outline(&spec, &bundled()).is_ok());
    }
}
