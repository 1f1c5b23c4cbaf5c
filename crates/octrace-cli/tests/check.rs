//! `octrace check`, the real program.

mod common;

use common::{Folder, PLATE};

const UNSUPPORTED: &str = "cube(1);\n  roof() { cube(1); }\n";

#[test]
fn sound_files_pass() {
    let folder = Folder::with(&[("a.csg", PLATE), ("b.oct", "sphere(r = 2);")]);
    let run = folder.run(&["check", "a.csg", "b.oct"]).expect(0);
    assert!(run.stdout.is_empty());
    assert_eq!(folder.run(&["check", "-q", "a.csg"]).expect(0).stderr, "");
}

#[test]
fn every_file_is_checked_and_one_bad_one_fails() {
    let folder = Folder::with(&[("a.csg", UNSUPPORTED), ("b.csg", PLATE), ("c.csg", "cube(")]);
    let run = folder.run(&["check", "a.csg", "b.csg", "c.csg"]).expect(1);
    assert!(run.stderr.contains("a.csg:2:3") && run.stderr.contains("c.csg:1:"), "{}", run.stderr);
}

#[test]
fn a_missing_file_does_not_stop_the_others() {
    let folder = Folder::with(&[("a.csg", UNSUPPORTED)]);
    let run = folder.run(&["check", "nix.csg", "a.csg", "nada.csg"]).expect(3);
    for expected in ["cannot read nix.csg", "a.csg:2:3", "cannot read nada.csg"] {
        assert!(run.stderr.contains(expected), "{expected} in {}", run.stderr);
    }
}

#[test]
fn findings_as_json() {
    let folder = Folder::with(&[("a.csg", UNSUPPORTED), ("b.csg", PLATE)]);
    let run = folder.run(&["check", "--json", "a.csg", "b.csg"]).expect(1);
    let findings = run.json();
    let [finding] = findings.as_array().unwrap().as_slice() else { panic!("{findings}") };
    assert_eq!((&finding["file"], &finding["severity"]), (&"a.csg".into(), &"error".into()));
    assert_eq!((&finding["line"], &finding["column"], &finding["end_line"]), (&2.into(), &3.into(), &2.into()));
    assert!(finding["end_column"].as_u64().unwrap() > 3);
    assert!(finding["code"].is_string() && finding["message"].as_str().unwrap().contains("roof"), "{finding}");
    assert!(run.stderr.is_empty());

    assert_eq!(folder.run(&["check", "--json", "b.csg"]).expect(0).json(), serde_json::json!([]));
}

#[test]
fn standard_input_has_a_name() {
    let run = Folder::with(&[]).run_with_input(&["check", "-"], UNSUPPORTED).expect(1);
    assert!(run.stderr.contains("<stdin>:2:3"), "{}", run.stderr);
}
