//! `.scad` files, with a stand-in for OpenSCAD that says and does what the test wants.

#![cfg(unix)]

mod common;

use common::{Folder, PLATE, Run};

/// Runs `octrace` where `openscad` does this, in shell; `$2` is the file to write, as in `openscad -o FILE ...`.
fn run(folder: &Folder, words: &[&str], pretend: &str) -> Run {
    let openscad = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/openscad.sh");
    folder.command(words).env("OPENSCAD", openscad).env("PRETEND", pretend).output().unwrap().into()
}

#[test]
fn variables_go_in_and_warnings_come_out() {
    let folder = Folder::with(&[("a.scad", "cube(n);"), ("plate.csg", PLATE)]);
    let words = ["render", "a.scad", "--size=64x48", "-D", "n=3", "-D", "m=\"x y\""];
    let openscad = "cp plate.csg \"$2\"; echo \"WARNING: got $4, $6\" >&2; echo 'ECHO: 1' >&2";
    let result = run(&folder, &words, openscad).expect(0);
    assert!(result.stderr.contains("WARNING: got n=3, m=\"x y\"\n"), "{}", result.stderr);
    assert!(result.stderr.contains("ECHO: 1\n"), "{}", result.stderr);
    assert_eq!(folder.names(), ["a.png", "a.scad", "plate.csg"]);
    let quiet = run(&folder, &[&words[..], &["-q"]].concat(), openscad).expect(0);
    assert_eq!(quiet.stderr, "");
}

#[test]
fn what_openscad_rejects_is_an_error_in_the_input() {
    let folder = Folder::with(&[("a.scad", "cube(")]);
    let openscad = "echo 'ERROR: Parser error: syntax error in file a.scad, line 1' >&2; exit 1";
    let result = run(&folder, &["check", "a.scad"], openscad).expect(1);
    assert!(result.stderr.contains("syntax error in file a.scad, line 1"), "{}", result.stderr);
}

#[test]
fn findings_are_about_the_dump() {
    let folder = Folder::with(&[("a.scad", "roof() cube();")]);
    let result = run(&folder, &["check", "a.scad"], "echo 'roof();' > \"$2\"").expect(1);
    assert!(result.stderr.contains("a.scad (dump):1:1"), "{}", result.stderr);
    assert!(result.stderr.contains("`openscad -o dump.csg a.scad` writes"), "{}", result.stderr);
}

#[test]
fn without_openscad_the_way_to_get_it_is_told() {
    let folder = Folder::with(&[("a.scad", "cube();")]);
    let missing = folder.command(&["render", "a.scad"]).env("OPENSCAD", "/no/such/openscad").output().unwrap();
    let result = Run::from(missing).expect(3);
    assert!(
        result.stderr.contains("not installed") && result.stderr.contains("https://openscad.org"),
        "{}",
        result.stderr
    );
}

#[test]
fn a_missing_file_is_not_left_to_openscad() {
    let result = run(&Folder::with(&[]), &["render", "nix.scad"], "exit 1").expect(3);
    assert!(result.stderr.contains("cannot read nix.scad: no such file"), "{}", result.stderr);
}
