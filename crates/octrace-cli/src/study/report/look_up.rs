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

/// The walks of `bresenham` and `fujimoto` at the default settings, where both have the same octree, and that is more
/// than a single cell.
pub fn steps_of_both(scene: &SceneReport) -> Option<(Walk, Walk)> {
    let (_, bresenham) = with_traversal(scene, "bresenham")?;
    let (_, fujimoto) = with_traversal(scene, "fujimoto")?;
    let is_fair = bresenham.octree == fujimoto.octree && bresenham.octree.depth > 0;
    is_fair.then_some((bresenham.walk, fujimoto.walk))
}

/// The least time with this *p*, the default traversal and a fixed depth, over that of the default settings; and the
/// depth that was reached.
pub fn best_fixed_depth(scene: &SceneReport, p: usize) -> Option<(f64, u32)> {
    let is_meant = |run: &&Run| {
        run.leaf_primitives == p && run.octree_depth.is_some() && run.traversal == Config::default().traversal.name()
    };
    let figures = scene.runs.iter().filter(is_meant).filter_map(|run| figures(scene, run));
    figures.map(|f| (f.ratio_to_default.median, f.octree.depth)).min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The time with this *p*, the default traversal and the depth left to the tracer, over that of the default settings;
/// and the depth that was reached.
pub fn by_cost(scene: &SceneReport, p: usize) -> Option<(f64, u32)> {
    let is_meant = |run: &&Run| {
        run.leaf_primitives == p && run.octree_depth.is_none() && run.traversal == Config::default().traversal.name()
    };
    let figures = figures(scene, scene.runs.iter().find(is_meant)?)?;
    Some((figures.ratio_to_default.median, figures.octree.depth))
}

/// All values of *p* that were tried on any of the scenes, ascending.
pub fn values_of_p<'a>(scenes: impl IntoIterator<Item = &'a SceneReport>) -> Vec<usize> {
    let mut values: Vec<usize> =
        scenes.into_iter().flat_map(|scene| &scene.runs).map(|run| run.leaf_primitives).collect();
    values.sort_unstable();
    values.dedup();
    values
}

/// The names of the traversals that the scene was traced with, in the usual order.
pub fn traversals(scenes: &[SceneReport]) -> Vec<&'static str> {
    let is_used = |name: &&str| scenes.iter().any(|scene| scene.runs.iter().any(|run| run.traversal == *name));
    TraversalKind::ALL.map(TraversalKind::name).into_iter().filter(|name| is_used(name)).collect()
}
