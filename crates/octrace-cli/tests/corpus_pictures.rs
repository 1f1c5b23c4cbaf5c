//! Every file of a corpus of real models, from the file to the picture.

#[path = "../../octrace-read/tests/corpora/mod.rs"]
mod corpora;
mod pictures;

use corpora::openscad_dumps;
use octrace::octree::BuildOptions;
use octrace::{Accel, TracerOptions};
use octrace_read::{Facets, ReadOptions, Severity, Source, read_scene};

const SIZE_PX: (u32, u32) = (40, 30);

/// How many of the corpus' 172 dumps need nothing that is not drawn yet.
const SUPPORTED: usize = 52;

/// What can be drawn is drawn, and the octree is not to be seen in it; of the rest, everything that is missing is named.
fn walk(facets: Facets) {
    let Some(dumps) = openscad_dumps() else { return };
    let mut drawn = 0;
    for path in dumps {
        let name = path.display().to_string();
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
