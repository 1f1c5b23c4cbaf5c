//! `octrace render`, the real program: pictures, where they go, and what happens when something is wrong.

mod common;

use common::{Folder, PLATE, Picture};
use png::{BitDepth, ColorType};
use std::fs;

const SMALL: &str = "--size=64x48";

#[test]
fn the_default_is_a_png_named_like_the_file() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    let run = folder.run(&["render", "plate.csg"]).expect(0);
    assert_eq!(folder.names(), ["plate.csg", "plate.png"]);
    let picture = Picture::open(&folder.path("plate.png"));
    assert_eq!((picture.size, picture.color, picture.depth), ((1024, 768), ColorType::Rgb, BitDepth::Eight));
    assert_ne!(picture.pixel(0, 0), picture.pixel(512, 500), "there is something to see");
    assert!(run.stdout.is_empty());
}

#[test]
fn sizes_in_both_spellings() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    for size in ["--size=31x17", "--imgsize=31,17"] {
        folder.run(&["render", "plate.csg", "-o", "a.png", size]).expect(0);
        assert_eq!(Picture::open(&folder.path("a.png")).size, (31, 17));
    }
}

#[test]
fn transparent_and_sixteen_bit() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    folder.run(&["render", "plate.csg", "--transparent", "--bit-depth=16", SMALL]).expect(0);
    let picture = Picture::open(&folder.path("plate.png"));
    assert_eq!((picture.color, picture.depth), (ColorType::Rgba, BitDepth::Sixteen));
    assert_eq!(picture.pixel(0, 0)[6..], [0, 0], "the corner is clear");
    assert_eq!(picture.pixel(32, 32)[6..], [255, 255], "the plate is opaque");
}

#[test]
fn the_background_is_the_one_asked_for() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    for (color, expected) in [("red", [255, 0, 0]), ("#0000ff", [0, 0, 255]), ("0,1,0", [0, 255, 0])] {
        folder.run(&["render", "plate.csg", "--background", color, SMALL]).expect(0);
        assert_eq!(Picture::open(&folder.path("plate.png")).pixel(0, 0), expected, "{color}");
    }
}

#[test]
fn standard_input_and_output() {
    let folder = Folder::with(&[]);
    let run = folder.run_with_input(&["render", "-", "-o", "-", SMALL, "--stats=json"], PLATE).expect(0);
    assert_eq!(Picture::decode(&run.stdout).size, (64, 48));
    let stats: serde_json::Value = serde_json::from_str(run.stderr.trim()).expect("only the statistics are there");
    assert_eq!(stats["file"], "<stdin>");
    assert!(folder.names().is_empty());
}

#[test]
fn statistics_are_one_json_object() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    let run = folder.run(&["render", "plate.csg", SMALL, "--samples=1", "--threads=1", "--stats=json"]).expect(0);
    let stats = run.json();
    assert_eq!(stats["rays"]["camera"], 64 * 48);
    assert_eq!((&stats["width"], &stats["threads"], &stats["leaks"]), (&64.into(), &1.into(), &0.into()));
    for stage in ["read", "build", "render", "write", "total"] {
        assert!(stats["seconds"][stage].is_f64(), "{stage}");
    }
    assert!(stats["octree"]["leaves"].is_u64());
    // More than what the picture alone takes, and less than any machine has.
    let peak = stats["peak_memory_bytes"].as_u64();
    assert!(peak.map_or(!cfg!(unix), |bytes| (64 * 48 * 16..1 << 36).contains(&bytes)), "{peak:?}");
    let canonical = folder.run(&["render", "plate.csg", SMALL, "--accel=none", "--stats=json"]).expect(0);
    assert!(canonical.json()["octree"].is_null());
}

#[test]
fn how_rays_are_traced_never_changes_the_file() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    let draw = |how: &[&str]| {
        folder.run(&[&["render", "plate.csg", "-q", "-o", "a.png", SMALL], how].concat()).expect(0);
        fs::read(folder.path("a.png")).unwrap()
    };
    let expected = draw(&[]);
    for how in [&["--accel=none"][..], &["--threads=1"], &["--threads=3"], &["--octree-depth=7", "--leaf-primitives=1"]]
    {
        assert!(draw(how) == expected, "{how:?}");
    }
}

#[test]
fn cameras_and_projections() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    let draw = |view: &[&str]| {
        folder.run(&[&["render", "plate.csg", "-q", "-o", "a.png", SMALL], view].concat()).expect(0);
        Picture::open(&folder.path("a.png")).samples
    };
    let from_above = ["--camera=20,15,2,0,0,0,150", "--projection=o"];
    assert_eq!(draw(&from_above), draw(&["--camera=20,15,152,20,15,2", "--projection", "ortho"]), "one view, two ways");
    assert_ne!(draw(&from_above), draw(&[]));
    assert_eq!(
        draw(&["--camera=0,0,0,55,0,25,1", "--viewall", "--autocenter"]),
        draw(&["--camera=0,0,0,55,0,25,999", "--viewall", "--autocenter"]),
        "the distance is found"
    );
}

#[test]
fn all_errors_of_a_file_are_told_at_once() {
    let text = "union() {\n  roof() { cube(1); }\n  cube(size = [1, 1, 1]);\n  roof() { cube(2); }\n}\n";
    let folder = Folder::with(&[("a.csg", text)]);
    let run = folder.run(&["render", "a.csg"]).expect(1);
    for place in ["a.csg:2:3", "a.csg:4:3", "roof"] {
        assert!(run.stderr.contains(place), "{place} in\n{}", run.stderr);
    }
    assert_eq!(folder.names(), ["a.csg"], "nothing is left behind");

    let run = folder.run(&["render", "a.csg", "--skip-unsupported", SMALL]).expect(0);
    assert!(run.stderr.contains("a.csg:2:3") && run.stderr.contains("a.csg:4:3"), "{}", run.stderr);
    assert_eq!(folder.names(), ["a.csg", "a.png"]);
}

#[test]
fn an_error_keeps_the_old_picture() {
    let folder = Folder::with(&[("a.csg", "cube("), ("a.png", "old")]);
    folder.run(&["render", "a.csg"]).expect(1);
    assert_eq!(fs::read(folder.path("a.png")).unwrap(), b"old");
    assert_eq!(folder.names(), ["a.csg", "a.png"]);
}

#[test]
fn what_cannot_be_read_or_written_is_named() {
    let folder = Folder::with(&[("plate.csg", PLATE), ("solid.step", ""), ("part.csg", PLATE)]);
    for (words, code, expected) in [
        (&["render", "nix.csg"][..], 3, "cannot read nix.csg: no such file"),
        (&["render", "."], 3, "cannot read .: it is a folder"),
        (&["render", "plate.csg", "-o", "."], 3, "cannot write .: it is a folder"),
        (&["render", "plate.csg", "-o", "no/a.png"], 3, "cannot write no/a.png: there is no folder no"),
        (&["render", "solid.step"], 1, ".step files are not supported"),
        (&["render", "-"], 2, "say with -o"),
        (&["render", "plate.csg", "-o", "./plate.csg"], 2, "would replace the file that it is of"),
        (&["render", "plate.csg", "-o", "part.csg"], 2, "pictures are PNG files"),
        (&["render", "plate.csg", "-o", "a.JPG"], 2, "name it a.png"),
        (&["render", "plate.csg", "--size=-5x5"], 2, "as in 1024x768"),
        (&["render", "plate.csg", "--samples=x"], 2, "a whole number from 1 to 65536"),
        (&["plate.csg"], 2, "octrace render plate.csg"),
        (&["render", "plate.csg", "-D", "a=1"], 2, "-D is for .scad files"),
        (&["render", "plate.csg", "--size=0x0"], 2, "at least one pixel"),
        (&["render", "plate.csg", "--size=99999x99999"], 2, "are the most"),
    ] {
        let run = folder.run(words).expect(code);
        assert!(run.stderr.contains(expected), "{words:?}: {}", run.stderr);
    }
    assert_eq!(folder.names(), ["part.csg", "plate.csg", "solid.step"]);
    assert_eq!(fs::read_to_string(folder.path("plate.csg")).unwrap(), PLATE);
}

#[test]
fn no_file_at_all_crashes_it() {
    let deep = "group() {".repeat(100_000) + &"}".repeat(100_000);
    let deeper = "difference() { cube(1); multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) ".repeat(50_000);
    let far = "cube(1e300); multmatrix([[1,0,0,1e308],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(1); cube(1e29);";
    for text in [far, "", "}", "cube(", "\0\x01\x02", "multmatrix([[", &deep, &deeper, &"(".repeat(1_000_000)] {
        let folder = Folder::with(&[("a.csg", text)]);
        let run = folder.run(&["render", "a.csg", SMALL]);
        assert!(run.code == 0 || run.code == 1, "{} on {:.40}: {:.2000}", run.code, text, run.stderr);
        assert!(run.stderr.len() < 100_000, "{} bytes of complaints about {:.40}", run.stderr.len(), text);
    }
}

#[test]
fn bytes_that_are_no_text() {
    let folder = Folder::with(&[]);
    let junk: Vec<u8> = (0..50_000u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    fs::write(folder.path("a.csg"), junk).unwrap();
    let run = folder.run(&["render", "a.csg"]).expect(1);
    assert!(run.stderr.contains("a.csg:1:"), "{}", run.stderr);
    assert!(!run.stderr.chars().any(|c| c.is_control() && c != '\n'), "nothing steers the terminal");
}

#[test]
fn quiet_says_nothing() {
    let folder = Folder::with(&[("a.csg", "roof();\ncube(1);")]);
    let run = folder.run(&["render", "a.csg", "--skip-unsupported", "-q", SMALL]).expect(0);
    assert_eq!((run.stderr.as_str(), run.text()), ("", ""));
}
