//! Finding figures in a study.

use crate::study::plan::Config;
use crate::study::results::{Figures, Run, SceneReport, Walk};
use octrace::traverse::TraversalKind;

/// The default settings with this traversal, or what has the same octree.
pub fn with_traversal<'a>(scene: &'a SceneReport, traversal: &str) -> Option<(&'a Run, &'a Figures)> {
    let usual = Config::default();
    let is_meant = |run: &&Run| {
        run.traversal == traversal
            && run.leaf_primitives == usual.leaf_primitives
            && run.octree_depth == usual.depth.levels()
    };
    let run = scene.runs.iter().find(is_meant)?;
    Some((run, figures(scene, run)?))
}

/// The figures of a run, or those of the one with the same octree.
pub fn figures<'a>(scene: &'a SceneReport, run: &'a Run) -> Option<&'a Figures> {
    match run.same_as {
        Some(other) => scene.runs.get(other)?.figures.as_ref(),
        None => run.figures.as_ref(),
    }
}

/// The walks of `bresenham` and `fujimoto` at the default settings, where there is more to walk than a single cell.
pub fn steps_of_both(scene: &SceneReport) -> Option<(Walk, Walk)> {
    let walk = |name: &str| {
        let (_, figures) = with_traversal(scene, name)?;
        (figures.octree.depth > 0).then_some(figures.walk)
    };
    Some((walk("bresenham")?, walk("fujimoto")?))
}

/// The names of the traversals that the scene was traced with, in the usual order.
pub fn traversals(scenes: &[SceneReport]) -> Vec<&'static str> {
    let is_used = |name: &&str| scenes.iter().any(|scene| scene.runs.iter().any(|run| run.traversal == *name));
    TraversalKind::ALL.map(TraversalKind::name).into_iter().filter(|name| is_used(name)).collect()
}
