//! Every file of a corpus of real models, from the file to the picture.

#[path = "../../octrace-read/tests/corpora/mod.rs"]
mod corpora;
mod pictures;

use corpora::{openscad_dumps, source};
use octrace::octree::BuildOptions;
use octrace::{Accel, TracerOptions};
use octrace_read::{Facets, ReadOptions, Severity, read_scene};

const SIZE_PX: (u32, u32) = (40, 30);

/// Models with more primitives than this are drawn, but not by the canonical tracer, which takes its time.
const CANONICAL: usize = 1_000;

/// How many of the corpus' dumps hold something: all but one.
const DRAWN: usize = 171;

/// What there is is drawn, and the octree is not to be seen in it.
fn walk(facets: Facets) {
    let Some(dumps) = openscad_dumps() else { return };
    let (mut drawn, mut compared) = (0, 0);
    for path in dumps {
        let name = path.display().to_string();
        let checked = read_scene(&source(&path), &ReadOptions { facets, ..ReadOptions::default() });
        let Some(loaded) = checked.value else {
            let errors = checked.diagnostics.iter().filter(|d| d.severity == Severity::Error);
            assert!(errors.map(|error| error.code).eq(["empty-scene"]), "{name}");
            continue;
        };
        drawn += 1;
        let scene = loaded.scene;
        let camera = |tracer: &octrace::Tracer| pictures::default_camera(&scene, tracer, SIZE_PX);
        let octree = pictures::film(&scene, SIZE_PX, &TracerOptions::default(), 2, camera);
        assert!(octree.pixels().iter().any(|p| p != &octree.pixels()[0]), "{name}: an empty picture");
        let options =
            TracerOptions { octree: BuildOptions { leaf_surfaces: 2, depth: Some(6) }, ..TracerOptions::default() };
        let coarse = pictures::film(&scene, SIZE_PX, &options, 2, camera);
        assert_eq!(pictures::differing(&octree, &coarse), 0, "{name}: p 2, depth 6");
        if loaded.leaves <= CANONICAL {
            let canonical = TracerOptions { accel: Accel::None, ..TracerOptions::default() };
            let expected = pictures::film(&scene, SIZE_PX, &canonical, 2, camera);
            assert_eq!(pictures::differing(&octree, &expected), 0, "{name}");
            compared += 1;
        }
    }
    assert_eq!(drawn, DRAWN);
    eprintln!("{drawn} drawn, {compared} compared with the canonical tracer");
}

#[test]
fn real_models_with_round_things_round() {
    walk(Facets::Auto);
}

#[test]
fn real_models_with_facets_as_written() {
    walk(Facets::Written);
}
