//! `octrace figures`, the real program; and the figures of the documentation, which are what it draws.

mod common;

use common::{Folder, PLATE};
use std::fs;
use std::path::Path;

const FILES: [&str; 5] = ["csg-tree.svg", "octree-slice.svg", "quadtree-walk.svg", "ray-tree.svg", "spans.svg"];

/// After looking at them, `OCTRACE_BLESS=1` renews them.
#[test]
fn the_figures_of_the_documentation_are_what_is_drawn() {
    let folder = Folder::with(&[]);
    folder.run(&["figures", "-q", "-o", "new"]).expect(0);
    let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/figures");
    for file in FILES {
        let (drawn, golden) = (folder.path("new").join(file), committed.join(file));
        if std::env::var_os("OCTRACE_BLESS").is_some() {
            fs::copy(&drawn, &golden).unwrap();
            continue;
        }
        let text = fs::read_to_string(&golden).unwrap_or_else(|e| panic!("{}: {e}", golden.display()));
        if text.replace("\r\n", "\n") != fs::read_to_string(&drawn).unwrap() {
            let left = Path::new(env!("CARGO_TARGET_TMPDIR")).join(file);
            fs::copy(&drawn, &left).unwrap();
            panic!("docs/figures/{file} is not what is drawn now: {}", left.display());
        }
    }
    let mut names: Vec<_> = fs::read_dir(committed).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, FILES);
}

#[test]
fn a_file_is_drawn_where_and_how_it_is_asked_for() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    let run = folder.run(&["figures", "plate.csg", "-o", "made", "--pixel", "500,400", "--slice", "1.5"]).expect(0);
    assert!(run.stderr.contains("made: csg-tree.svg, spans.svg"), "{}", run.stderr);
    let mut names: Vec<_> =
        fs::read_dir(folder.path("made")).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, FILES);
    let text = |file: &str| fs::read_to_string(folder.path("made").join(file)).unwrap();
    assert!(text("csg-tree.svg").contains("cylinder 1"));
    assert!(text("octree-slice.svg").contains("z = 1.5") && text("octree-slice.svg").contains("outside cylinder 1"));
    assert!(text("ray-tree.svg").contains("pixel 500, 400"));
    // Standard input, into the same folder: what is there is replaced.
    folder
        .run_with_input(&["figures", "-", "-o", "made", "-q"], "sphere($fn = 0, $fa = 12, $fs = 2, r = 1);")
        .expect(0);
    assert!(fs::read_to_string(folder.path("made/csg-tree.svg")).unwrap().contains("sphere 0"));
}

#[test]
fn whatever_is_wrong_leaves_no_folder_behind() {
    let files = [("plate.csg", PLATE), ("wrong.csg", "cube("), ("endless.oct", "halfspace();"), ("file", "")];
    let folder = Folder::with(&files);
    for (words, code, says) in [
        (&["figures", "wrong.csg", "-o", "new"][..], 1, "wrong.csg"),
        (&["figures", "endless.oct", "-o", "new"], 1, "nothing in the solid is bounded"),
        (&["figures", "plate.csg", "-o", "new", "--slice", "90"], 2, "misses the octree"),
        (&["figures", "plate.csg", "-o", "new", "--slice", "nan"], 2, "write a number"),
        (&["figures", "plate.csg", "-o", "new", "--pixel", "1024,0"], 2, "outside of the picture"),
        (&["figures", "plate.csg", "-o", "no/new"], 3, "is missing"),
        (&["figures", "plate.csg", "-o", "file"], 3, "not a folder"),
        (&["figures", "missing.csg", "-o", "new"], 3, "missing.csg"),
        (&["figures", "plate.csg"], 2, "--output"),
    ] {
        let run = folder.run(words).expect(code);
        assert!(run.stderr.contains(says), "{words:?}: {}", run.stderr);
        assert_eq!(folder.names(), ["endless.oct", "file", "plate.csg", "wrong.csg"], "{words:?}");
    }
}
