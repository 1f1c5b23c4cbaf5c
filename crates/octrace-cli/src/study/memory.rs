//! The paper's claim about memory, weighed: the tree that `bresenham` walks against the complete grid of `fujimoto`,
//! when their smallest cells are of one size.

use super::context::Context;
use super::plan::{Config, Depth, Plan};
use super::results::{Bytes, MemoryRow};
use super::scenes::StudyScene;
use super::survey::bytes_of;
use crate::failure::Failure;
use crate::stats::Stopwatch;
use octrace::traverse::TraversalKind;

/// Weighs octrees of all depths, one surface a leaf (so that they get as deep as they may) and as many as usual, until
/// building takes too long.
pub fn weigh(scene: &StudyScene, plan: &Plan, context: &Context<'_>) -> Result<Vec<MemoryRow>, Failure> {
    let mut rows: Vec<MemoryRow> = Vec::new();
    let limits = [1, Config::default().leaf_primitives];
    context.progress.begin("weighing octrees", (limits.len() * plan.weighed_depths().count()) as u64);
    for leaf_primitives in limits {
        for levels in plan.weighed_depths() {
            let watch = Stopwatch::start();
            let config = |traversal| Config { traversal, leaf_primitives, depth: Depth::Levels(levels) };
            let row = row(scene, config, context)?;
            context.progress.advance(1);
            // Deeper ones would be the same.
            let is_known = rows.iter().any(|r| r.leaf_primitives == leaf_primitives && r.depth == row.depth);
            if !is_known {
                rows.push(row);
            }
            if is_known || watch.elapsed() > plan.longest_build_s() {
                break;
            }
        }
    }
    context.progress.end();
    Ok(rows)
}

fn row(
    scene: &StudyScene,
    config: impl Fn(TraversalKind) -> Config,
    context: &Context<'_>,
) -> Result<MemoryRow, Failure> {
    let weigh = |traversal: TraversalKind| {
        let config = config(traversal);
        let tracer = context.build(scene, &config.options(scene.snap))?;
        Ok::<_, Failure>((bytes_of(&tracer, &config), tracer.stats().octree.unwrap_or_default()))
    };
    let (bresenham, octree) = weigh(TraversalKind::Bresenham)?;
    let (glassner, _) = weigh(TraversalKind::Glassner)?;
    let (grid, made) = weigh(TraversalKind::Fujimoto)?;
    // Where the grid was made with fewer levels, each missing one makes eight of a cell.
    let missing = octree.depth.saturating_sub(made.depth);
    let fujimoto = Bytes { tables: grid.tables << (3 * missing), programs: bresenham.programs, ..grid };
    Ok(MemoryRow {
        scene: scene.name.clone(),
        leaf_primitives: config(TraversalKind::Bresenham).leaf_primitives,
        depth: octree.depth,
        nodes: octree.branches + octree.leaves + octree.outside + octree.inside,
        bresenham,
        glassner,
        fujimoto,
        grid_was_made: missing == 0,
        grid_over_tree: fujimoto.tables as f64 / (bresenham.tree + bresenham.tables).max(1) as f64,
    })
}
