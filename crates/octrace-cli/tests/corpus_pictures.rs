//! Every file of a corpus of real models, from the file to the picture.

mod pictures;

use octrace::octree::BuildOptions;
use octrace::{Accel, TracerOptions};
use octrace_read::{Facets, ReadOptions, Severity, Source, read_scene};
use std::path::{Path, PathBuf};

const SIZE_PX: (u32, u32) = (40, 30);

/// How many of the corpus' 172 dumps need nothing that is not drawn yet.
const SUPPORTED: usize = 52;

fn corpus() -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/corpora");
    let folder = std::env::var_os("OCTRACE_CORPORA").map_or_else(beside, PathBuf::from).join("openscad");
    if !folder.is_dir() {
        eprintln!("SKIPPED: no corpus at {}", folder.display());
        return None;
    }
    Some(folder)
}

fn dumps(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut pending = vec![folder.to_owned()];
    while let Some(folder) = pending.pop() {
        for entry in std::fs::read_dir(&folder).expect("the corpus is readable") {
            let path = entry.expect("the corpus is readable").path();
            if path.is_dir() {
                pending.push(path);
            } else if path.extension().is_some_and(|e| e == "csg") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// What can be drawn is drawn, and the octree is not to be seen in it; of the rest, everything that is missing is named.
fn walk(facets: Facets) {
    let Some(folder) = corpus() else { return };
    let mut drawn = 0;
    for path in dumps(&folder) {
        let name = path.strip_prefix(&folder).unwrap_or(&path).display().to_string();
        let source = Source::new(name.clone(), std::fs::read(&path).expect("the corpus is readable"));
        let checked = read_scene(&source, &ReadOptions { facets, ..ReadOptions::default() });
        let Some(loaded) = checked.value else {
            let errors = checked.diagnostics.iter().filter(|d| d.severity == Severity::Error);
            let expected = ["unsupported-node", "polyhedron-open", "empty-scene"];
            for error in errors {
                assert!(expected.contains(&error.code), "{name}: {}: {}", error.code, error.message);
            }
            continue;
        };
        drawn += 1;
        let scene = loaded.scene;
        let camera = |tracer: &octrace::Tracer| pictures::default_camera(&scene, tracer, SIZE_PX);
        let canonical = TracerOptions { accel: Accel::None, ..TracerOptions::default() };
        let expected = pictures::film(&scene, SIZE_PX, &canonical, 2, camera);
        assert!(expected.pixels().iter().any(|p| p != &expected.pixels()[0]), "{name}: an empty picture");
        for (leaf_surfaces, depth) in [(6, None), (2, Some(6))] {
            let octree = BuildOptions { leaf_surfaces, depth };
            let options = TracerOptions { octree, ..TracerOptions::default() };
            let accelerated = pictures::film(&scene, SIZE_PX, &options, 2, camera);
            assert_eq!(pictures::differing(&accelerated, &expected), 0, "{name}: p {leaf_surfaces}, depth {depth:?}");
        }
    }
    assert_eq!(drawn, SUPPORTED);
}

#[test]
fn real_models_with_round_things_round() {
    walk(Facets::Auto);
}

#[test]
fn real_models_with_facets_as_written() {
    walk(Facets::Written);
}
