//! What the figures say, in sentences.

use super::format::{number, range, whole};
use super::look_up::{best_fixed_depth, by_cost, steps_of_both, traversals, values_of_p, with_traversal};
use crate::statistics::Spread;
use crate::study::plan::Config;
use crate::study::results::{Advice, SceneReport, Study};
use crate::study::scenes::Family;
use maud::{Markup, html};

/// The findings, as a list.
pub fn findings(study: &Study) -> Markup {
    let growth: Vec<Markup> = Family::ALL.into_iter().filter_map(|family| growth(study, family)).collect();
    let others = [fastest(study), step(study), memory(study), stop_rule(study)].into_iter().flatten();
    // Whoever studies a file wants to know this first.
    let settings = settings(study);
    let sentences: Vec<Markup> = match growth.is_empty() {
        true => settings.into_iter().chain(others).collect(),
        false => growth.into_iter().chain(others).chain(settings).collect(),
    };
    html! {
        h2 id="findings" { "Findings" }
        (equality(study))
        p.quiet {
            "Numbers are medians, over the scenes where there are several; in brackets the least and the greatest."
        }
        ul { @for sentence in &sentences { li { (sentence) } } }
    }
}

/// Whether all ways to trace see the same.
fn equality(study: &Study) -> Markup {
    let c = &study.checked;
    html! {
        @if c.differing == 0 && c.leaks == 0 {
            p {
                "All see the same: " (whole(c.configurations)) " ways to trace " (scenes(study.scenes.len())) ", "
                (whole(c.hits)) " hits compared bit for bit, " (whole(c.canonical_hits)) " of them with those of the \
                canonical tracer. None differs."
            }
        } @else {
            p.defect {
                strong { (whole(c.differing)) " of " (whole(c.hits)) " hits differ" } ", and " (whole(c.leaks)) " rays \
                met cells that contradict each other. That is a defect of octrace; please report it. Scenes concerned: "
                (defective(study)) "."
            }
        }
    }
}

fn scenes(count: usize) -> String {
    if count == 1 { "one scene".into() } else { format!("{count} scenes") }
}

fn defective(study: &Study) -> String {
    let is_defective = |scene: &&SceneReport| scene.checked.differing > 0 || scene.checked.leaks > 0;
    let names: Vec<&str> = study.scenes.iter().filter(is_defective).map(|scene| scene.name.as_str()).collect();
    names.join(", ")
}

/// How the cost grows from a family's first scene to its last.
fn growth(study: &Study, family: Family) -> Option<Markup> {
    let mut members = study.scenes.iter().filter(|scene| scene.family == Some(family.name()));
    let (first, last) = (members.next()?, members.next_back()?);
    let usual = Config::default().traversal.name();
    let ns = |scene: &SceneReport| Some(with_traversal(scene, usual)?.1.ns_per_ray.median);
    let octree = ns(last)? / ns(first)?;
    let canonical = last.canonical.ns_per_ray.median / first.canonical.ns_per_ray.median;
    let grown = match family {
        Family::Balls | Family::Copies => {
            format!(
                "{} to {} primitives ({} to {})",
                whole(first.primitives as u64),
                whole(last.primitives as u64),
                first.name,
                last.name
            )
        }
        Family::Chain => format!("a CSG tree {} to one {} operations deep", first.tree_depth, last.tree_depth),
    };
    let by = with_traversal(last, usual)?.1.speedup_over_canonical.median;
    Some(html! {
        "From " (grown) " a ray costs " strong { (number(octree)) " times" } " as much with the octree, and "
        (number(canonical)) " times as much without: in the end the octree is " (number(by)) " times as fast."
    })
}

/// Which traversal is fastest, and how often.
fn fastest(study: &Study) -> Option<Markup> {
    let names = traversals(&study.scenes);
    if names.len() < 2 {
        return None;
    }
    let winner = |scene: &SceneReport| {
        let timed = names.iter().filter_map(|&name| Some((name, with_traversal(scene, name)?.1.ns_per_ray.median)));
        timed.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(name, _)| name)
    };
    let winners: Vec<&str> = study.scenes.iter().filter_map(winner).collect();
    let mut counts: Vec<(usize, &str)> =
        names.iter().map(|&name| (winners.iter().filter(|&&other| other == name).count(), name)).collect();
    counts.sort_by_key(|&(count, _)| std::cmp::Reverse(count));
    let words: Vec<String> = counts.iter().filter(|(n, _)| *n > 0).map(|(n, name)| format!("{name} in {n}")).collect();
    Some(html! {
        "Fastest for whole rays at the default settings, by the medians: " strong { (words.join(", ")) } " of "
        (scenes(winners.len())) "."
    })
}

/// The paper's claim about the cost of a step.
fn step(study: &Study) -> Option<Markup> {
    let pairs: Vec<_> = study.scenes.iter().filter_map(steps_of_both).collect();
    if pairs.is_empty() {
        return None;
    }
    let tree = Spread::of(pairs.iter().map(|(b, _)| b.ns_per_cell.median));
    let grid = Spread::of(pairs.iter().map(|(_, f)| f.ns_per_step().median));
    let ratio = Spread::of(pairs.iter().map(|(b, f)| b.ns_per_cell.median / f.ns_per_step().median));
    let longer = Spread::of(pairs.iter().map(|(b, f)| f.grid_steps_per_ray.unwrap_or(1.0) / b.cells_per_ray));
    Some(html! {
        "A step of " code { "bresenham" } " takes " (number(tree.median)) " ns" (range(&tree)) ", one of "
        code { "fujimoto" } "’s grid " (number(grid.median)) " ns" (range(&grid)) ": "
        strong { (number(ratio.median)) " times" } " as much" (range(&ratio)) ". But the grid needs "
        (number(longer.median)) " steps" (range(&longer)) " for each cell of the octree."
    })
}

/// The paper's claim about memory.
fn memory(study: &Study) -> Option<Markup> {
    let deepest =
        study.memory.iter().filter(|row| row.leaf_primitives == 1 && row.grid_was_made).map(|row| row.depth).max()?;
    let rows = study.memory.iter().filter(|row| row.leaf_primitives == 1 && row.depth == deepest);
    let ratio = Spread::of(rows.map(|row| row.grid_over_tree));
    Some(html! {
        "With " (deepest) " levels and one surface a leaf, " code { "fujimoto" } "’s grid takes "
        strong { (number(ratio.median)) " times" } " the memory of "
        code { "bresenham" } "’s tree with the same smallest cell"
        (range(&ratio)) "."
    })
}

/// What cutting cells by expected cost gains over the paper's fixed *p* and depth.
fn stop_rule(study: &Study) -> Option<Markup> {
    let best = |scene, find: fn(&SceneReport, usize) -> Option<(f64, u32)>| {
        let found = values_of_p([scene]).into_iter().filter_map(|p| find(scene, p));
        found.map(|(ratio, _)| ratio).min_by(f64::total_cmp)
    };
    let both = |scene| Some((best(scene, by_cost)?, best(scene, best_fixed_depth)?));
    let both: Vec<(f64, f64)> = study.scenes.iter().filter_map(both).collect();
    if both.is_empty() {
        return None;
    }
    let fixed = Spread::of(both.iter().map(|(by_cost, fixed)| fixed / by_cost));
    let usual = Spread::of(both.iter().map(|(by_cost, _)| by_cost.recip()));
    Some(html! {
        "When to stop cutting: with the best p and fixed depth of those tried on a scene, rays take "
        strong { (number(fixed.median)) " times" } " as long" (range(&fixed)) " as with the best p and cells cut by their \
        expected cost. The default p takes " (number(usual.median)) " times" (range(&usual)) " as long as that."
    })
}

/// What other settings than the default ones gain.
fn settings(study: &Study) -> Option<Markup> {
    let advice: Vec<(&SceneReport, &Advice)> =
        study.scenes.iter().filter_map(|scene| Some((scene, scene.advice.as_ref()?))).collect();
    if advice.is_empty() {
        return None;
    }
    Some(html! {
        "Settings: "
        @for (i, (scene, advice)) in advice.iter().enumerate() {
            @if i > 0 { "; " }
            (scene.name) ": "
            @if advice.is_worth_it {
                code { (advice.options) } " is "
                strong { (number(advice.speedup.median)) " times" } " as fast as the default"
            } @else {
                "the default settings do"
            }
        }
        "."
    })
}
