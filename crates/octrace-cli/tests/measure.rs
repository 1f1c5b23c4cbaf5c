//! `octrace measure`, the real program.

mod common;

use common::{Folder, PLATE};

#[test]
fn a_plate_with_a_hole() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    let report = folder.run(&["measure", "plate.csg", "--json", "--tolerance=1e-3"]).expect(0).json();
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let expected = 40.0 * 30.0 * 5.0 - 6.0 * 6.0 * 5.0 * std::f64::consts::PI;
    assert!((number(&report["volume"]) - expected).abs() < 1e-3 * expected, "{report}");
    assert!(number(&report["volume_error"]) <= 1e-3 * expected, "{report}");
    for (axis, expected) in [20.0, 15.0, 2.5].into_iter().enumerate() {
        assert!((number(&report["centroid"][axis]) - expected).abs() < 0.05, "{report}");
    }
    for (i, expected) in [0.0, 0.0, 0.0, 40.0, 30.0, 5.0].into_iter().enumerate() {
        assert!((number(&report["bbox"][i]) - expected).abs() < 1e-6, "{report}");
    }
}

#[test]
fn for_people_there_is_a_table() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    let run = folder.run(&["measure", "plate.csg", "--tolerance=1e-2"]).expect(0);
    assert!(run.text().starts_with("volume    54"), "{}", run.text());
    for line in ["\nfrom      0 0 0 ± ", "\nto        40 30 5\n", "\nsize      40 30 5\n"] {
        assert!(run.text().contains(line), "{}", run.text());
    }
}

#[test]
fn unbounded_solids_have_no_volume() {
    let folder = Folder::with(&[("a.oct", "union() { halfspace(); block(); }")]);
    let run = folder.run(&["measure", "a.oct", "--json"]).expect(1);
    assert!(run.stderr.contains("unbounded") && run.stdout.is_empty(), "{}", run.stderr);
}

#[test]
fn nothing_has_no_extent() {
    let folder = Folder::with(&[("a.csg", "difference() { cube(1); cube(1); }")]);
    let report = folder.run(&["measure", "a.csg", "--json"]).expect(0).json();
    assert_eq!((&report["volume"], &report["bbox"]), (&0.0.into(), &serde_json::Value::Null), "{report}");
}
