//! The plots of the report, and what is said below them.

use super::look_up::{figures, traversals, with_traversal};
use super::plots::{Line, Plot};
use crate::study::plan::Config;
use crate::study::results::{MemoryRow, SceneReport, Study};
use crate::study::scenes::Family;
use maud::{Markup, PreEscaped, html};

/// A plot with its caption, if there is anything to plot.
pub fn figure(plot: &Plot<'_>, caption: &str) -> Option<Markup> {
    let svg = plot.svg()?;
    Some(html! { figure { (PreEscaped(svg)) figcaption { (caption) } } })
}

/// For each family, the time of a ray against what grows.
pub fn growth(study: &Study) -> Vec<(Plot<'static>, String)> {
    let plot = |family: Family| {
        let scenes: Vec<&SceneReport> =
            study.scenes.iter().filter(|scene| scene.family == Some(family.name())).collect();
        let (x_label, caption) = match family {
            Family::Balls => ("primitives", "A block minus more and more balls."),
            Family::Copies => ("primitives", "More and more copies of the classic side by side."),
            Family::Chain => (
                "depth of the CSG tree",
                "A ball that smaller ones are taken from and added to by turns: every operation lies on top of the one \
                 before.",
            ),
        };
        let x = |scene: &SceneReport| match family {
            Family::Balls | Family::Copies => scene.primitives as f64,
            Family::Chain => scene.tree_depth as f64,
        };
        let canonical = scenes.iter().map(|scene| (x(scene), scene.canonical.ns_per_ray.median));
        let mut lines = vec![Line { name: "none (canonical)".into(), points: canonical.collect() }];
        for traversal in traversals(&study.scenes) {
            let point = |scene: &&SceneReport| {
                let (_, figures) = with_traversal(scene, traversal)?;
                Some((x(scene), figures.ns_per_ray.median))
            };
            lines.push(Line { name: traversal.into(), points: scenes.iter().filter_map(point).collect() });
        }
        (Plot { x_label, y_label: "ns for a primary ray", lines }, caption.to_owned())
    };
    Family::ALL.into_iter().map(plot).collect()
}

/// Bytes against the number of smallest cells along the root's edge: the grid, and each scene's tree.
pub fn memory(study: &Study) -> Vec<(Plot<'static>, String)> {
    let rows = |scene: &SceneReport| {
        let is_meant = |row: &&MemoryRow| row.scene == scene.name && row.leaf_primitives == 1;
        study.memory.iter().filter(is_meant).collect::<Vec<_>>()
    };
    let cells = |row: &MemoryRow| (1_u64 << row.depth) as f64;
    let mut grid: Vec<(f64, f64)> = study.memory.iter().map(|row| (cells(row), row.fujimoto.tables as f64)).collect();
    grid.sort_by(|a, b| a.0.total_cmp(&b.0));
    grid.dedup();
    let tree = |scene: &SceneReport| {
        let point = |row: &&MemoryRow| (cells(row), (row.bresenham.tree + row.bresenham.tables) as f64);
        let points: Vec<(f64, f64)> = rows(scene).iter().map(point).collect();
        (!points.is_empty()).then(|| Line { name: format!("bresenham, {}", scene.name), points })
    };
    let grid = Line { name: "fujimoto, every scene".into(), points: grid };
    let lines = std::iter::once(grid).chain(study.scenes.iter().filter_map(tree)).collect();
    let plot = Plot { x_label: "smallest cells along the root's edge", y_label: "bytes", lines };
    vec![(
        plot,
        "One surface a leaf (p = 1), so that the octree gets as deep as it may; without the leaves' programs.".into(),
    )]
}

/// The time of a ray against *p*, for each depth, with the default traversal.
pub fn settings(scene: &SceneReport) -> Plot<'static> {
    let usual = Config::default().traversal.name();
    let mut depths: Vec<Option<u32>> = scene.runs.iter().map(|run| run.octree_depth).collect();
    depths.sort_unstable();
    depths.dedup();
    let line = |depth: Option<u32>| {
        let runs = scene.runs.iter().filter(|run| run.traversal == usual && run.octree_depth == depth);
        let mut points: Vec<(f64, f64)> =
            runs.filter_map(|run| Some((run.leaf_primitives as f64, figures(scene, run)?.ns_per_ray.median))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let name = depth.map_or("depth auto".to_owned(), |depth| format!("depth {depth}"));
        Line { name, points }
    };
    Plot {
        x_label: "p, surfaces a leaf",
        y_label: "ns for a primary ray",
        lines: depths.into_iter().map(line).collect(),
    }
}

/// What is said below [`settings`].
pub fn settings_caption() -> String {
    format!("Traversal {}, the default one; smaller is better.", Config::default().traversal)
}
