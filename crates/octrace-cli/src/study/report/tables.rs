//! The tables of the report.

use super::format::{bytes, number, seconds, spread, spread_seconds, whole};
use super::look_up::{best_fixed_depth, by_cost, figures, steps_of_both, traversals, values_of_p, with_traversal};
use crate::study::plan::Config;
use crate::study::results::{Figures, Run, SceneReport, Status, Study};
use maud::{Markup, html};

/// Every scene, with every traversal at the default settings, and without octree.
pub fn defaults(study: &Study) -> Markup {
    html! {
        div.scroll { table {
            thead { tr {
                th.text { "scene" } th { "primitives" } th.text { "traversal" } th { "nodes" } th { "depth" }
                th { "bytes" } th { "build" } th { "cells/ray" } th { "tests/ray" } th { "ns/step" } th { "time/ray" }
                th { "picture" }
                th { "Mrays/s" } th { "time ÷ default" } th { "× canonical" }
            } }
            tbody { @for scene in &study.scenes { (scene_rows(study, scene)) } }
        } }
    }
}

fn scene_rows(study: &Study, scene: &SceneReport) -> Markup {
    let runs: Vec<(&Run, &Figures)> =
        traversals(&study.scenes).into_iter().filter_map(|name| with_traversal(scene, name)).collect();
    let fastest = runs.iter().map(|(_, f)| f.ns_per_ray.median).fold(f64::INFINITY, f64::min);
    let canonical = &scene.canonical;
    html! {
        tr.first {
            td.text { (scene.name) } td { (whole(scene.primitives as u64)) } td.text { "none" } td {} td {} td {}
            td { (spread_seconds(&canonical.build_seconds)) } td {}
            td { (number(canonical.surface_tests_per_ray)) } td {}
            td { (spread_seconds(&canonical.ns_per_ray.times(1e-9))) }
            td { (seconds(canonical.picture_seconds.median)) }
            td { (number(canonical.mrays_per_second)) } td { (spread(&canonical.ratio_to_default)) } td { "1" }
        }
        @for (run, f) in runs {
            tr.usual[run.is_default] {
                td {} td {} td.text { (run.traversal) } (octree_cells(f))
                (cost_cells(f, f.ns_per_ray.median == fastest))
            }
        }
    }
}

/// Nodes, depth, bytes, build.
fn octree_cells(f: &Figures) -> Markup {
    html! {
        td { (whole(f.octree.nodes() as u64)) } td { (f.octree.depth) } td { (bytes(f.bytes.total())) }
        td { (spread_seconds(&f.build_seconds)) }
    }
}

/// What rays cost.
fn cost_cells(f: &Figures, is_best: bool) -> Markup {
    html! {
        td { (number(f.cells_per_ray)) } td { (number(f.surface_tests_per_ray)) }
        td { (number(f.walk.ns_per_step().median)) }
        td.best[is_best] { (spread_seconds(&f.ns_per_ray.times(1e-9))) } td { (seconds(f.picture_seconds.median)) }
        td { (number(f.mrays_per_second)) } td { (spread(&f.ratio_to_default)) }
        td { (number(f.speedup_over_canonical.median)) }
    }
}

/// What a step costs, scene by traversal.
pub fn steps(study: &Study) -> Markup {
    let names = traversals(&study.scenes);
    html! {
        div.scroll { table {
            thead { tr {
                th.text { "ns per step" } th { "cells/ray" }
                @for name in &names { th { (name) } }
                th { "bresenham ÷ fujimoto" } th { "grid steps/cell" }
            } }
            tbody { @for scene in &study.scenes { (step_row(scene, &names)) } }
        } }
    }
}

fn step_row(scene: &SceneReport, names: &[&str]) -> Markup {
    let walks: Vec<_> = names.iter().map(|name| Some(with_traversal(scene, name)?.1.walk)).collect();
    let both = steps_of_both(scene);
    let ratio = both.map(|(b, f)| b.ns_per_cell.median / f.ns_per_step().median);
    let grid = both.and_then(|(_, f)| Some(f.grid_steps_per_ray? / f.cells_per_ray));
    html! {
        tr {
            td.text { (scene.name) }
            td { (walks.iter().flatten().next().map_or("–".into(), |walk| number(walk.cells_per_ray))) }
            @for walk in &walks {
                td { @match walk { Some(walk) => (spread(&walk.ns_per_step())), None => "–" } }
            }
            td { (ratio.map_or("–".into(), number)) } td { (grid.map_or("–".into(), number)) }
        }
    }
}

/// How each *p* does with the default traversal, scene by scene: with cells cut by expected cost, and at its best fixed
/// depth.
pub fn leaf_primitives(scenes: &[&SceneReport]) -> Markup {
    let cell = |found: Option<(f64, u32)>| {
        html! { td { @match found {
            Some((ratio, depth)) => { (number(ratio)) " " small { "(" (depth) ")" } }
            None => "–",
        } } }
    };
    html! {
        div.scroll { table {
            thead {
                tr { th {} @for scene in scenes { th colspan="2" { (scene.name) } } }
                tr { th.text { "p" } @for _ in scenes { th { "by cost" } th { "fixed" } } }
            }
            tbody { @for p in values_of_p(scenes.iter().copied()) {
                tr.usual[p == Config::default().leaf_primitives] {
                    td.text { (p) }
                    @for scene in scenes { (cell(by_cost(scene, p))) (cell(best_fixed_depth(scene, p))) }
                }
            } }
        } }
    }
}

/// All settings of one scene.
pub fn settings(scene: &SceneReport) -> Markup {
    let fastest =
        scene.runs.iter().filter_map(|r| r.figures.as_ref()).map(|f| f.ns_per_ray.median).fold(f64::INFINITY, f64::min);
    let same = scene.runs.iter().filter(|run| run.status == Status::SameTree).count();
    html! {
        div.scroll { table {
            thead { tr {
                th.text { "traversal" } th { "p" } th { "depth asked" } th { "nodes" } th { "depth" }
                th { "bytes" } th { "build" } th { "cells/ray" } th { "tests/ray" } th { "ns/step" } th { "time/ray" }
                th { "picture" }
                th { "Mrays/s" } th { "time ÷ default" } th { "× canonical" }
            } }
            tbody { @for run in scene.runs.iter().filter(|run| run.status != Status::SameTree) {
                tr.usual[run.is_default] {
                    td.text { (run.traversal) } td { (run.leaf_primitives) }
                    td { (run.octree_depth.map_or("auto".into(), |depth| depth.to_string())) }
                    @match figures(scene, run) {
                        Some(f) => { (octree_cells(f)) (cost_cells(f, f.ns_per_ray.median == fastest)) }
                        None => { td.text colspan="12" { (why_not(run)) } }
                    }
                }
            } }
        } }
        @if same > 0 { p.quiet { (same) " more settings lead to octrees that are in the table already." } }
    }
}

fn why_not(run: &Run) -> String {
    let why = match run.status {
        Status::Measured => "measured",
        Status::SameTree => "the octree of other settings",
        Status::NotPossible => "not possible at this depth",
        Status::TooSlowToBuild => "not built",
    };
    match &run.note {
        Some(note) => format!("{why}: {note}"),
        None => why.into(),
    }
}

/// Trees against grids.
pub fn memory(study: &Study) -> Markup {
    html! {
        div.scroll { table {
            thead { tr {
                th.text { "scene" } th { "p" } th { "depth" } th { "nodes" } th { "programs" } th { "tree + parents" }
                th { "hash table" } th { "grid" } th { "grid ÷ tree" }
            } }
            tbody { @for row in &study.memory {
                tr {
                    td.text { (row.scene) } td { (row.leaf_primitives) } td { (row.depth) }
                    td { (whole(row.nodes as u64)) }
                    td { (bytes(row.bresenham.programs)) } td { (bytes(row.bresenham.tree + row.bresenham.tables)) }
                    td { (bytes(row.glassner.tables)) }
                    td { (bytes(row.fujimoto.tables)) @if !row.grid_was_made { " " small { "(computed)" } } }
                    td { (number(row.grid_over_tree)) }
                }
            } }
        } }
    }
}
