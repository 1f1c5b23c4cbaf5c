//! `octrace bench`: what it prints has the form that it promises. What the numbers are is the machine's business.

mod common;

use common::{Folder, PLATE};
use serde_json::Value;

const LITTLE: [&str; 4] = ["bench", "--repeat=2", "--size=40x30", "--quiet"];

fn rows(folder: &Folder, words: &[&str]) -> Vec<Value> {
    let run = folder.run(&[&LITTLE, words, &["--json"]].concat()).expect(0);
    assert_eq!(run.stderr, "");
    run.json().as_array().expect("a list").clone()
}

fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap_or_else(|| panic!("{key} in {row}"))
}

#[test]
fn a_scene_is_one_object() {
    let rows = rows(&Folder::with(&[]), &["--scenes=classic,menger-3,classic", "--threads=2"]);
    let names: Vec<&str> = rows.iter().filter_map(|row| row["scene"].as_str()).collect();
    assert_eq!(names, ["classic", "menger-3"], "each once");
    for (row, primitives) in std::iter::zip(&rows, [6.0, 220.0]) {
        assert_eq!(number(row, "primitives"), primitives);
        assert_eq!((number(row, "threads"), number(row, "leaks")), (2.0, 0.0));
        let keys =
            "mrays_per_s limit_mrays_per_s ratio_to_limit shadowed_mrays_per_s build_s compile_s frame_s bytes speedup";
        for key in keys.split(' ') {
            assert!(number(row, key) > 0.0, "{key}");
        }
        assert!(row["parse_s"].is_null() && row["file_bytes"].is_null());
        let spread = &row["spread"]["mrays_per_s"];
        let [min, median, max] = ["min", "median", "max"].map(|key| number(spread, key));
        assert!(min <= median && median <= max);
        assert!((median / number(row, "mrays_per_s") - 1.0).abs() < 1e-4);
        assert_eq!(number(&row["frame_rays"], "camera"), 1200.0);
    }
}

#[test]
fn one_thread_has_nothing_to_compare_with() {
    let rows = rows(&Folder::with(&[]), &["--scenes=classic", "--threads=1"]);
    assert!(rows[0]["speedup"].is_null() && rows[0]["spread"]["speedup"].is_null());
}

#[test]
fn files_are_read_too() {
    let rows = rows(&Folder::with(&[("plate.csg", PLATE)]), &["plate.csg"]);
    assert_eq!((&rows[0]["scene"], number(&rows[0], "primitives")), (&"plate.csg".into(), 2.0));
    assert_eq!(number(&rows[0], "file_bytes"), PLATE.len() as f64);
    assert!(number(&rows[0], "parse_s") > 0.0);
}

#[test]
fn people_get_tables() {
    let files = [("a.csg", PLATE), ("b.csg", PLATE), ("c.csg", PLATE)];
    let run = Folder::with(&files).run(&[&LITTLE[..], &["a.csg", "b.csg", "c.csg", "--scenes=classic"]].concat());
    let run = run.expect(0);
    let heads: Vec<&str> = run.text().lines().filter_map(|line| line.split_whitespace().next()).collect();
    for head in ["scene", "classic", "file", "a.csg", "c.csg", "median", "greatest"] {
        assert!(heads.contains(&head), "{head} in {}", run.text());
    }
}

#[test]
fn others_are_measured_after_a_broken_file() {
    let folder = Folder::with(&[("bad.csg", "cube(size = [1, 2"), ("good.csg", PLATE)]);
    let run = folder.run(&[&LITTLE[..], &["bad.csg", "good.csg", "--json"]].concat()).expect(1);
    assert!(run.stderr.contains("bad.csg is left out: it has "), "{}", run.stderr);
    assert_eq!(run.json().as_array().map(Vec::len), Some(1));
}

#[test]
fn mistakes_are_explained() {
    let folder = Folder::with(&[]);
    assert!(folder.run(&["bench", "--scenes=teapot"]).expect(2).stderr.contains("there is no scene \"teapot\""));
    assert!(folder.run(&["bench", "--repeat=0"]).expect(2).stderr.contains("from 1 to 1000"));
}
