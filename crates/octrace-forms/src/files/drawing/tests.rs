//! Against what OpenSCAD 2021.01 makes of the same drawings.

use super::*;
use crate::curve::extent;
use octrace::{Contour, Curve};
use std::path::PathBuf;

/// The corners of a curve with its arcs as many short chords.
fn flattened(contour: &Contour) -> Vec<Vec2> {
    let mut corners = Vec::new();
    for (i, edge) in contour.iter().enumerate() {
        corners.push(edge.from);
        let Curve::Arc { center, ccw, .. } = edge.curve else { continue };
        let (a, b) = (edge.from - center, contour[(i + 1) % contour.len()].from - center);
        let mut turn = libm::atan2(a.cross(b), a.dot(b)).rem_euclid(std::f64::consts::TAU);
        if !ccw {
            turn -= std::f64::consts::TAU;
        } else if edge.from == contour[(i + 1) % contour.len()].from {
            turn = std::f64::consts::TAU;
        }
        corners.extend((1..160).map(|i| {
            let (sin, cos) = libm::sincos(turn * f64::from(i) / 160.0);
            center + a * cos + a.left() * sin
        }));
    }
    corners
}

/// The area of the union of even-odd shapes, by lines along x; and the box around all.
fn measured(drawing: &Drawing) -> ([f64; 4], f64) {
    let corners = drawing.shapes.iter().filter_map(|shape| extent(shape));
    let (low, high) = corners
        .reduce(|(a, b), (c, d)| (Vec2::new(a.x.min(c.x), a.y.min(c.y)), Vec2::new(b.x.max(d.x), b.y.max(d.y))))
        .unwrap_or_default();
    let shapes: Vec<Vec<Vec<Vec2>>> =
        drawing.shapes.iter().map(|shape| shape.iter().map(flattened).collect()).collect();
    let lines = 2000;
    let step = (high.y - low.y) / f64::from(lines);
    let mut area = 0.0;
    for y in (0..lines).map(|i| low.y + step * (f64::from(i) + 0.497)) {
        let mut inside: Vec<(f64, f64)> = Vec::new();
        for shape in &shapes {
            let mut xs = Vec::new();
            for path in shape {
                for (i, a) in path.iter().enumerate() {
                    let b = path[(i + 1) % path.len()];
                    if (a.y <= y) != (b.y <= y) {
                        xs.push(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
                    }
                }
            }
            xs.sort_by(f64::total_cmp);
            inside.extend(xs.chunks_exact(2).map(|pair| (pair[0], pair[1])));
        }
        inside.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut end = f64::NEG_INFINITY;
        for (from, to) in inside {
            area += (to - from.max(end)).max(0.0) * step;
            end = end.max(to);
        }
    }
    ([low.x, high.x, low.y, high.y], area)
}

fn check(drawing: &Drawing, corners: [f64; 4], area: f64, tolerance: f64, what: &str) {
    let (actual, measured) = measured(drawing);
    for (actual, expected) in actual.iter().zip(corners) {
        assert!((actual - expected).abs() < 1e-3 + tolerance, "{what}: {actual:?}, not {corners:?}");
    }
    assert!((measured / area - 1.0).abs() < 2e-3 + tolerance, "{what}: area {measured}, not {area}");
}

/// What OpenSCAD's usual settings make of a circle.
fn usual(radius: f64) -> u32 {
    (std::f64::consts::PI * radius).clamp(5.0, 30.0).ceil() as u32
}

/// A drawing, the box around it in OpenSCAD (least and greatest x, then y), and its area there.
#[rustfmt::skip]
const SVG: &[(&str, [f64; 4], f64)] = &[
    (
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 100 50"><circle cx="30" cy="20" r="10"/></svg>"#,
        [20.0000, 40.0000, 20.0000, 40.0000], 312.8705,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 200 100"><ellipse cx="30" cy="20" rx="10" ry="5"/></svg>"#,
        [10.0000, 20.0000, 37.5000, 42.5000], 39.1086,
    ),
    (
        r#"<svg width="100" height="50"><rect x="10" y="5" width="30" height="20"/></svg>"#,
        [10.0000, 40.0000, -7.3611, 12.6389], 600.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><rect x="10" y="5" width="30" height="20" rx="6"/></svg>"#,
        [10.0000, 40.0000, 25.0000, 45.0000], 568.5248,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><rect x="10" y="5" width="30" height="20" rx="6" ry="3"/></svg>"#,
        [10.0000, 40.0000, 25.0000, 45.0000], 584.2623,
    ),
    (
        r#"<svg width="100mm" height="50mm"><rect x="10" y="5" width="30" height="20"/></svg>"#,
        [10.0000, 40.0000, 25.0000, 45.0000], 600.0000,
    ),
    (
        r#"<svg viewBox="0 0 100 50"><rect x="10" y="5" width="30" height="20"/></svg>"#,
        [3.5278, 14.1111, 8.8194, 15.8750], 74.6713,
    ),
    (
        r#"<svg><rect x="10" y="5" width="30" height="20"/></svg>"#,
        [10.0000, 40.0000, -25.0000, -5.0000], 600.0000,
    ),
    (
        r#"<svg width="2in" height="1in" viewBox="0 0 100 50"><rect x="10" y="5" width="30" height="20"/></svg>"#,
        [5.0800, 20.3200, 12.7000, 22.8600], 154.8385,
    ),
    (
        r#"<svg width="100%" height="100%" viewBox="0 0 100 50"><rect x="10" y="5" width="30" height="20"/></svg>"#,
        [10.0000, 40.0000, 25.0000, 45.0000], 600.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="10 20 100 50"><rect x="10" y="25" width="30" height="20"/></svg>"#,
        [0.0000, 30.0000, -15.0000, 5.0000], 600.0000,
    ),
    (
        r#"<svg width="100mm" height="100mm" viewBox="0 0 100 50"><rect x="10" y="5" width="30" height="20"/></svg>"#,
        [10.0000, 40.0000, 50.0000, 70.0000], 600.0000,
    ),
    (
        r#"<svg width="100mm" height="100mm" viewBox="0 0 100 50" preserveAspectRatio="none"><rect x="10" y="5" width="30" height="20"/></svg>"#,
        [10.0000, 40.0000, 50.0000, 90.0000], 1200.0000,
    ),
    (
        r#"<svg width="100mm" height="100mm" viewBox="0 0 100 50" preserveAspectRatio="xMinYMax slice"><rect x="10" y="5" width="30" height="20"/></svg>"#,
        [20.0000, 80.0000, 50.0000, 90.0000], 2400.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><rect fill="none" x="10" y="5" width="30" height="20"/></svg>"#,
        [10.0000, 40.0000, 25.0000, 45.0000], 600.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><rect style="display:none" x="10" y="5" width="30" height="20"/></svg>"#,
        [10.0000, 40.0000, 25.0000, 45.0000], 600.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><line x1="10" y1="10" x2="30" y2="10" stroke-width="2"/></svg>"#,
        [9.0000, 31.0000, 39.0000, 41.0000], 44.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><line x1="10" y1="10" x2="30" y2="10" stroke-width="2" stroke-linecap="butt"/></svg>"#,
        [10.0000, 30.0000, 39.0000, 41.0000], 40.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><polyline points="10,10 30,10 30,30" stroke-width="2"/></svg>"#,
        [9.0000, 31.0000, 19.0000, 41.0000], 84.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><polygon points="10,10 30,10 30,30"/></svg>"#,
        [10.0000, 30.0000, 20.0000, 40.0000], 200.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><path d="M10,10 L30,10 L30,30"/></svg>"#,
        [9.5000, 30.5000, 19.5000, 40.5000], 41.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><path d="M10,10 L30,10 L30,30" style="stroke-width:4;stroke-linecap:round"/></svg>"#,
        [8.0000, 32.0000, 18.0000, 42.0000], 172.5662,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><path d="M10,10 h30 v30 h-30 z M20,20 h10 v10 h-10 z"/></svg>"#,
        [10.0000, 40.0000, 10.0000, 40.0000], 800.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><path fill-rule="nonzero" d="M10,10 h30 v30 h-30 z M20,20 v10 h10 v-10 z"/></svg>"#,
        [10.0000, 40.0000, 10.0000, 40.0000], 800.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><path d="M10,10 h20 v20 h-20 z"/><path d="M20,10 h20 v20 h-20 z"/></svg>"#,
        [10.0000, 40.0000, 20.0000, 40.0000], 600.0000,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><path d="M10,10 C10,30 40,30 40,10 Z M50 10 q10 30 20 0 t 10 0 z"/></svg>"#,
        [10.0000, 80.0000, 25.0000, 55.0000], 657.7515,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><path d="M10,10 A 10 10 0 0 1 30 10 Z M50 20 a 15 8 30 1 0 10 5 z"/></svg>"#,
        [10.0000, 66.2365, 10.1440, 50.0000], 524.5761,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><g transform="translate(20,5) rotate(30)"><rect transform="scale(2 1) skewX(10)" x="1" y="2" width="10" height="6"/></g><rect x="3" y="3" width="1" height="1" transform="rotate(45 10 10) matrix(1 0 0 2 3 4)"/></svg>"#,
        [5.7573, 38.6634, 25.6612, 42.8284], 122.0001,
    ),
    (
        r#"<svg width="100mm" height="50mm" viewBox="0 0 100 50"><path d="m10 10 20 0 0-5.5.5.5z"/></svg>"#,
        [10.0000, 30.5000, 40.0000, 45.5000], 48.9365,
    ),
];

#[test]
fn svg_drawings_are_where_openscad_has_them() {
    for &(text, corners, area) in SVG {
        let chords = DrawingOptions { fragments: Some(&usual), ..DrawingOptions::default() };
        let drawing = read(DrawingFormat::Svg, text.as_bytes(), &chords).unwrap();
        check(&drawing, corners, area, 0.0, text);
        let drawing = read(DrawingFormat::Svg, text.as_bytes(), &DrawingOptions::default()).unwrap();
        check(&drawing, corners, area, 0.02, text);
    }
}

#[test]
fn svg_arcs_stay_arcs() {
    let text = r#"<svg viewBox="0 0 9 9" width="9mm" height="9mm"><g transform="rotate(30) scale(2)"><circle r="1"/>
        <path d="M5 5 a 1 1 0 0 1 2 0 z"/></g></svg>"#;
    let drawing = read(DrawingFormat::Svg, text.as_bytes(), &DrawingOptions::default()).unwrap();
    let arcs = |shape: &Paths| shape.iter().flatten().filter(|edge| edge.curve != Curve::Line).count();
    assert_eq!(drawing.shapes.iter().map(arcs).collect::<Vec<_>>(), [1, 1]);
    assert_eq!(drawing.shapes.iter().map(|s| s[0].len()).collect::<Vec<_>>(), [1, 2]);
}

#[test]
fn parts_of_svg_drawings_can_be_chosen_used_again_and_centered() {
    let text = r##"<svg width="90" viewBox="0 0 90 90" height="90" xmlns:i="inkscape"><defs><rect id="r" width="2" height="4"/></defs>
        <g i:label="Layer 1"><use href="#r" x="10"/><use href="#r" y="20"/></g><g id="other"><rect x="50" width="8" height="8"/></g>
        <text>Hello</text></svg>"##;
    let options = DrawingOptions { dpi: 25.4, ..DrawingOptions::default() };
    let all = read(DrawingFormat::Svg, text.as_bytes(), &options).unwrap();
    check(&all, [0.0, 58.0, 66.0, 90.0], 80.0, 0.0, "all");
    assert_eq!(all.warnings, [DrawingWarning::PassedOver { kind: "text".to_string(), count: 1 }]);
    for (layer, area) in [("Layer 1", 16.0), ("other", 64.0)] {
        let options = DrawingOptions { layer: Some(layer), place: Place::Centered, ..options };
        let (corners, actual) = measured(&read(DrawingFormat::Svg, text.as_bytes(), &options).unwrap());
        assert!(
            (actual - area).abs() < 0.1 && (corners[0] + corners[1]).abs() + (corners[2] + corners[3]).abs() < 1e-9,
            "{layer}"
        );
    }
    let options = DrawingOptions { layer: Some("none"), ..options };
    let none = read(DrawingFormat::Svg, text.as_bytes(), &options).unwrap();
    assert!(none.shapes.is_empty() && none.warnings.contains(&DrawingWarning::NoLayer("none".to_string())));
}

#[test]
fn hostile_svg_comes_to_an_end() {
    let open = |text: &str| read(DrawingFormat::Svg, text.as_bytes(), &DrawingOptions::default());
    assert!(open("<svg>").is_err());
    assert!(open(r##"<svg><g id="a"><use href="#a"/><use href="#a"/></g></svg>"##).is_ok_and(|d| d.shapes.is_empty()));
    let wide =
        format!(r#"<svg><g id="a"><rect width="1" height="1"/>{}</g></svg>"#, r##"<use href="#a"/>"##.repeat(50));
    assert!(matches!(open(&wide), Err(DrawingError::TooLarge(_))));
    for d in [
        "M",
        "M0 0 L",
        "M nan 0",
        "L5 5 9 9 z",
        "M0 0 a0 0 0 0 0 5 5 z",
        "M0,0 A 1e300 1 0 1 1 5 5z",
        "M1e308 0 h1e308 v1 z",
    ] {
        assert!(open(&format!(r#"<svg viewBox="0 0 0 -5"><path d="{d}"/></svg>"#)).is_ok(), "{d}");
    }
}

/// A DXF file with these blocks and entities, their codes and values between blanks.
fn dxf(blocks: &str, entities: &str) -> String {
    let all = format!("0 SECTION 2 BLOCKS {blocks} 0 ENDSEC 0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF");
    all.split_whitespace().flat_map(|word| [word, "\n"]).collect()
}

#[test]
fn dxf_entities_are_what_openscad_makes_of_them() {
    let block = "0 BLOCK 8 0 2 B 70 0 10 1 20 1 0 LINE 8 0 10 0 20 0 11 1 21 0 0 LINE 8 0 10 1 20 0 11 1 21 1 \
        0 LINE 8 0 10 1 20 1 11 0 21 0 0 ENDBLK";
    let polyline = "0 LWPOLYLINE 8 0 90 4 70 1 10 0 20 0 10 4 20 0 42 1 10 4 20 4 10 0 20 4";
    // Entities; OpenSCAD's box and area; the area with arcs.
    let cases = [
        ("0 CIRCLE 8 0 10 3 20 4 40 5", [-2.0, 8.0, -1.0, 9.0], 76.5271, 78.5398),
        ("0 ARC 8 0 10 0 20 0 40 5 50 90 51 0", [-5.0, 5.0, -5.0, 5.0], 69.8953, 71.4049),
        (
            "0 ELLIPSE 8 0 10 1 20 2 11 3 21 4 40 0.5 41 0 42 6.283185307",
            [-2.5371, 4.5371, -2.2695, 6.2695],
            38.2702,
            39.2699,
        ),
        ("0 ELLIPSE 8 0 10 1 20 2 11 6 21 0 40 0.5 41 0 42 3.14159265", [-5.0, 7.0, 2.0, 5.0], 27.8122, 28.2743),
        (polyline, [0.0, 4.0, 0.0, 4.0], 16.0, 22.2832),
        ("0 INSERT 8 0 2 B 10 10 20 20 41 2 42 3 50 30", [10.0, 11.7324, 20.0, 23.5977], 3.0, 3.0),
        ("0 LINE 8 0 10 0 20 0 11 1 21 0 0 LINE 8 0 10 1 20 0 11 1 21 1", [0.0, 1.0, 0.0, 1.0], 0.5, 0.5),
    ];
    for (entities, corners, area, round_area) in cases {
        let text = dxf(block, entities);
        let chords = DrawingOptions { fragments: Some(&usual), ..DrawingOptions::default() };
        check(&read(DrawingFormat::Dxf, text.as_bytes(), &chords).unwrap(), corners, area, 0.0, entities);
        let round = measured(&read(DrawingFormat::Dxf, text.as_bytes(), &DrawingOptions::default()).unwrap()).1;
        assert!((round / round_area - 1.0).abs() < 1e-3, "{entities}: {round}, not {round_area}");
    }
}

#[test]
fn old_polylines_have_arcs_and_unknown_entities_are_counted() {
    let text = dxf(
        "",
        "0 POLYLINE 8 a 70 1 0 VERTEX 8 a 10 0 20 0 42 1 0 VERTEX 8 a 10 4 20 0 42 1 0 SEQEND 8 a 0 SPLINE 8 a 0 LINE 8 b 10 0 20 0 11 5 21 5",
    );
    let options =
        DrawingOptions { layer: Some("a"), scale: 0.5, origin: Vec2::new(2.0, 0.0), ..DrawingOptions::default() };
    let drawing = read(DrawingFormat::Dxf, text.as_bytes(), &options).unwrap();
    check(&drawing, [-1.0, 1.0, -1.0, 1.0], std::f64::consts::PI, 0.0, "a circle of two arcs");
    assert_eq!(drawing.warnings, [DrawingWarning::PassedOver { kind: "SPLINE".to_string(), count: 1 }]);

    // The corners of a net in space are no outline.
    let net = dxf(
        "",
        "0 POLYLINE 8 a 70 16 71 2 72 2 0 VERTEX 8 a 10 0 20 0 0 VERTEX 8 a 10 4 20 0 0 VERTEX 8 a 10 0 20 4 0 SEQEND 8 a",
    );
    let drawing = read(DrawingFormat::Dxf, net.as_bytes(), &DrawingOptions::default()).unwrap();
    assert_eq!(drawing.shapes.iter().flatten().count(), 0);
    assert_eq!(drawing.warnings, [DrawingWarning::PassedOver { kind: "POLYLINE (mesh)".to_string(), count: 1 }]);
    let options = DrawingOptions { layer: Some("c"), ..DrawingOptions::default() };
    let drawing = read(DrawingFormat::Dxf, text.as_bytes(), &options).unwrap();
    assert_eq!(drawing.warnings, [DrawingWarning::NoLayer("c".to_string())]);
}

/// A parabola over its chord: two thirds of the box.
#[test]
fn splines_are_curves() {
    let spline = "0 SPLINE 70 8 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 0 10 2 20 4 10 4 20 0";
    let text = dxf("", &format!("{spline} 0 LINE 10 4 20 0 11 0 21 0"));
    let drawing = read(DrawingFormat::Dxf, text.as_bytes(), &DrawingOptions::default()).unwrap();
    check(&drawing, [0.0, 4.0, 0.0, 2.0], 16.0 / 3.0, 0.0, "a parabola");
    assert_eq!(drawing.warnings, []);
    let chords = DrawingOptions { fragments: Some(&usual), ..DrawingOptions::default() };
    // Eight chords are an eighth of an eighth too small.
    let drawing = read(DrawingFormat::Dxf, text.as_bytes(), &chords).unwrap();
    check(&drawing, [0.0, 4.0, 0.0, 2.0], 16.0 / 3.0 * 63.0 / 64.0, 0.0, "a parabola in chords");
}

#[test]
fn hostile_dxf_comes_to_an_end() {
    let open = |text: &str| read(DrawingFormat::Dxf, text.as_bytes(), &DrawingOptions::default());
    assert_eq!(open("0\nSECTION\nx\ny").unwrap_err().to_string(), "line 3: `x` is no group code");
    assert_eq!(open("0\nLINE\n10\nnan").unwrap_err().to_string(), "line 4: `nan` is no finite number");
    assert!(open("").is_ok() && open("0").is_ok() && open("0\nEOF\n\n \n").is_ok());
    // Each block has the one before twenty times.
    let mut blocks = String::from("0 BLOCK 2 b0 0 LINE 11 1 0 ENDBLK");
    for i in 1..8 {
        blocks += &format!(" 0 BLOCK 2 b{i}{} 0 ENDBLK", format!(" 0 INSERT 2 b{}", i - 1).repeat(20));
    }
    assert!(matches!(open(&dxf(&blocks, "0 INSERT 2 b7")), Err(DrawingError::TooLarge(_))));
}

#[test]
fn the_drawings_of_openscads_examples_have_their_areas() {
    let corpora = std::env::var_os("OCTRACE_CORPORA").map(PathBuf::from);
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/corpora");
    let folder = corpora.unwrap_or(beside).join("openscad/examples");
    if !folder.is_dir() {
        eprintln!("skipped: there is no {}", folder.display());
        return;
    }
    let cases = [
        ("example007", "dorn", [0.0, 0.0], 1.0, [0.0, 11.0, 0.0, 30.0], 187.5),
        ("example007", "cutout1", [0.0, 0.0], 1.0, [-2.0, 2.0, 3.0, 31.0], 112.0),
        ("example008", "G", [0.0, 0.0], 1.0, [0.0, 50.0, 0.0, 50.0], 1650.0),
        ("example008", "B", [0.0, 0.0], 1.0, [100.0, 150.0, 100.0, 150.0], 1850.0),
        ("example009", "body", [0.0, 0.0], 1.0, [-19.9512, 19.9512, -19.9512, 19.9512], 308.862),
        ("example009", "plate", [0.0, 0.0], 1.0, [-20.0, 20.0, -20.0, 20.0], 627.1568),
        ("example009", "fan_top", [0.0, 0.0], 1.0, [-17.1172, 17.1172, -17.1172, 17.1172], 294.9395),
        ("example009", "fan_side", [0.0, -40.0], 1.0, [0.0, 20.4131, -10.0, 10.0], 363.9791),
        ("example009", "body", [1.0, 2.0], 2.0, [-41.9756, 37.9756, -43.9756, 35.9756], 1230.8806),
        ("example013", "", [0.0, 0.0], 1.0, [-30.0, 30.0, -30.0, 30.0], 2000.0),
    ];
    for (name, layer, [x, y], scale, corners, area) in cases {
        let bytes = std::fs::read(folder.join(name).with_extension("dxf")).unwrap();
        let (layer, origin) = (Some(layer).filter(|layer| !layer.is_empty()), Vec2::new(x, y));
        let round = DrawingOptions { layer, origin, scale, ..DrawingOptions::default() };
        let chords = DrawingOptions { fragments: Some(&usual), ..round };
        check(&read(DrawingFormat::Dxf, &bytes, &chords).unwrap(), corners, area, 0.0, &format!("{name} {layer:?}"));
        let (_, round) = measured(&read(DrawingFormat::Dxf, &bytes, &round).unwrap());
        assert!((round / area - 1.0).abs() < 0.05, "{name} {layer:?}: {round}, not about {area}");
    }
}
