//! Damaged, hostile and huge files get an answer: never a panic, never a stack overflow, never silence.

use octrace_read::{Checked, Loaded, ReadOptions, Source, read_scene};
use proptest::prelude::*;
use std::fmt::Write;

/// One of everything, as OpenSCAD writes it.
const REAL: &str = include_str!("suite/csg/unsupported.csg");
const SCENE: &str = include_str!("suite/oct/looks.oct");

fn read(name: &str, content: impl Into<Vec<u8>>) -> Checked<Loaded> {
    let source = Source::new(name, content);
    let checked = read_scene(&source, &ReadOptions { skip_unsupported: true, ..ReadOptions::default() });
    for d in &checked.diagnostics {
        let places = std::iter::once(d.at).chain(d.notes.iter().map(|(at, _)| *at));
        for at in places {
            assert!(at.start <= at.end && at.end as usize <= source.text().len().max(1), "{at:?} of {}", d.message);
            source.line_col(at.start);
            source.slice(at);
        }
    }
    assert!(checked.value.is_some() || checked.has_errors(), "silence");
    checked
}

#[test]
fn a_file_may_end_anywhere() {
    for text in [REAL, SCENE] {
        for end in 0..text.len() {
            read("cut.csg", &text.as_bytes()[..end]);
            read("cut.oct", &text.as_bytes()[..end]);
        }
    }
}

#[test]
fn deep_trees_are_read() {
    for (open, close) in [
        ("union() {", "}"),
        ("difference() { cube(); ", "}"),
        ("translate([1, 0, 0]) ", ""),
        ("color(\"red\") { ", "}"),
        ("hull() { ", "}"),
        ("teapot() { ", "}"),
        ("!union() { ", "}"),
        ("%union() { ", "}"),
    ] {
        const DEPTH: usize = 100_000;
        let text = open.repeat(DEPTH) + "sphere();" + &close.repeat(DEPTH);
        read("deep.oct", text);
        read("deep.csg", open.repeat(DEPTH));
    }
}

#[test]
fn large_files_are_read() {
    let mut text = String::from("polyhedron(points = [");
    for i in 0..100_000 {
        write!(text, "[{}, {:.3}, 1e-06], ", i % 100, f64::from(i) * 0.001).expect("strings take all");
    }
    text.push_str("], faces = [[0, 1, 2]]);\n");
    for i in 0..30_000 {
        writeln!(text, "multmatrix([[1, 0, 0, {i}], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {{\n\tcube(size = [1, 2, 3], center = false);\n}}")
            .expect("strings take all");
    }
    assert!(text.len() > 5_000_000, "{}", text.len());
    let codes: Vec<_> = read("large.csg", text.clone()).diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes, ["polyhedron-open"]);
    // Thousands of the same mistake are a few of them and a number.
    let wrong = text.replace("size = [1, 2, 3]", "size = [1, 2]");
    assert_eq!(read("large.csg", wrong).diagnostics.len(), 52);
}

#[test]
fn odd_numbers_are_no_danger() {
    for number in
        ["1e999", "-1e999", "1e-999", "nan", "-nan", "inf", "-inf", "-0", "1e308", "1e-308", "4e9", "0.1e-320"]
    {
        for node in [
            "cube(N);",
            "cube([N, 1, 1]);",
            "sphere(N);",
            "sphere(r = 1, $fn = N);",
            "sphere(r = N, $fn = 5);",
            "cylinder(N, 1, 1);",
            "cylinder(1, N, 1);",
            "cylinder(1, 1, N, $fn = 7);",
            "cylinder(h = 1, r = 1, $fn = N);",
            "cylinder(r = N, $fa = N, $fs = N);",
            "torus(N, 1);",
            "torus(1, N);",
            "translate([N, 0, 0]) cube();",
            "rotate(N) cube();",
            "rotate([N, N, N]) cube();",
            "rotate(N, [N, 1, 0]) cube();",
            "scale(N) cube();",
            "mirror([N, 1, 0]) cube();",
            "multmatrix([[N, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, N], [0, 0, 0, 1]]) cube();",
            "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, N]]) cube();",
            "color([N, 0, 1, N]) cube();",
            "material(kd = N, ior = N, kr = N) cube();",
            "camera([N, 1, 2, 3, N, 5, N]); cube();",
            "camera(eye = [N, 0, 0], fov = N); cube();",
            "camera(eye = [9, 0, 0], height = N); cube();",
            "light(position = [N, 0, 0], intensity = N); cube();",
            "light(direction = [N, 0, 0]); cube();",
            "ambient(N); cube();",
            "background([N, 0, 0]); cube();",
            "polyhedron([[N, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, N]]);",
        ] {
            let text = node.replace('N', number);
            for facets in octrace_read::Facets::ALL {
                let source = Source::new("odd.oct", text.clone());
                let checked = read_scene(&source, &ReadOptions { facets, ..ReadOptions::default() });
                assert!(checked.value.is_some() || checked.has_errors(), "{text}");
            }
            read("odd.csg", text);
        }
    }
}

#[test]
fn tabs_and_one_line_and_no_newline_are_the_same() {
    let flat = REAL.lines().filter(|line| !line.starts_with("//")).collect::<Vec<_>>().join(" ");
    let codes = |text: &str| read("a.csg", text).diagnostics.iter().map(|d| d.code).collect::<Vec<_>>();
    assert_eq!(codes(REAL), codes(&flat));
}

proptest! {
    #[test]
    fn changed_bytes_are_survived(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
        for text in [REAL, SCENE] {
            let mut bytes = text.as_bytes().to_vec();
            for (at, byte) in &changes {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            read("changed.csg", bytes.clone());
            read("changed.oct", bytes);
        }
    }

    #[test]
    fn moved_pieces_are_survived(cuts in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..6)) {
        for text in [REAL, SCENE] {
            let pieces: Vec<&str> = cuts.iter().map(|(a, b)| {
                let (a, b) = (a.index(text.len()), b.index(text.len()));
                text.get(a.min(b)..a.max(b)).unwrap_or("")
            }).collect();
            read("pieces.oct", pieces.concat());
        }
    }

    #[test]
    fn any_bytes_are_survived(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        read("junk.csg", bytes);
    }
}
