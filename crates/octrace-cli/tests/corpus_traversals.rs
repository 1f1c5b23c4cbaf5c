//! Every way to walk the octree on real models: the pictures are those of the canonical tracer, bit for bit.

#[path = "../../octrace-read/tests/corpora/mod.rs"]
mod corpora;
mod pictures;

use corpora::{openscad_dumps, source};
use octrace::octree::BuildOptions;
use octrace::traverse::TraversalKind;
use octrace::{Accel, Scene, Tracer, TracerOptions};
use octrace_read::{ReadOptions, read_scene};

const SIZE_PX: (u32, u32) = (64, 48);

/// So many models are traced: of those in which everything is supported, by size, every second one from the smallest
/// on.
const MODELS: usize = 20;

fn models() -> Option<Vec<(String, Scene)>> {
    let mut files = openscad_dumps()?;
    files.sort_by_key(|path| (std::fs::metadata(path).map_or(0, |data| data.len()), path.clone()));
    let supported = files.into_iter().filter_map(|path| {
        let checked = read_scene(&source(&path), &ReadOptions::default());
        Some((path.display().to_string(), checked.value?.scene))
    });
    Some(supported.step_by(2).take(MODELS).collect())
}

#[test]
fn real_models_look_the_same_by_every_traversal() {
    let Some(models) = models() else { return };
    assert_eq!(models.len(), MODELS);
    for (name, scene) in models {
        let camera = |tracer: &Tracer| pictures::default_camera(&scene, tracer, SIZE_PX);
        let canonical = TracerOptions { accel: Accel::None, ..TracerOptions::default() };
        let expected = pictures::film(&scene, SIZE_PX, &canonical, 1, camera);
        assert!(expected.pixels().iter().any(|p| p != &expected.pixels()[0]), "{name}: an empty picture");
        for traversal in TraversalKind::ALL {
            for octree in [BuildOptions::default(), BuildOptions { leaf_surfaces: 1, depth: Some(5) }] {
                let options = TracerOptions { traversal, octree, ..TracerOptions::default() };
                let walked = pictures::film(&scene, SIZE_PX, &options, 1, camera);
                assert_eq!(
                    pictures::differing(&walked, &expected),
                    0,
                    "{name}: {traversal}, {octree:?}: pixels differ"
                );
            }
        }
    }
}
