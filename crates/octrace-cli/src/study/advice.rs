//! Which settings suit a scene: the fastest ones that were tried, if they still are when measured once more.
//!
//! The fastest of many is partly the luckiest of many. So it is measured again, against the default settings, in rounds
//! of its own, and only these say what it gains.

use super::context::Context;
use super::plan::{Config, Depth};
use super::results::{Advice, Figures};
use super::rounds::duel;
use super::scenes::StudyScene;
use crate::failure::Failure;
use crate::statistics::Spread;
use octrace::Ray;
use std::fmt::Write;

/// Chooses among settings that were measured, of which the first are the default ones.
pub fn advise(
    scene: &StudyScene,
    measured: &[(Config, &Figures)],
    all: &[Ray],
    repeat: u32,
    context: &Context<'_>,
) -> Result<Option<Advice>, Failure> {
    let ratio = |figures: &Figures| figures.ratio_to_default.median;
    let fastest = measured.iter().min_by(|a, b| ratio(a.1).total_cmp(&ratio(b.1)));
    let (Some((usual, before)), Some((config, after))) = (measured.first(), fastest) else { return Ok(None) };
    let [usual_s, config_s] = duel(scene, [usual, config], all, 2 * repeat + 1, context)?;
    let speedup = Spread::of_ratios(&usual_s, &config_s);
    let more_to_build_s = after.build_seconds.median - before.build_seconds.median;
    let median = |seconds: &[f64]| Spread::of(seconds.iter().copied()).median;
    let less_a_ray_s = (median(&usual_s) - median(&config_s)) / all.len().max(1) as f64;
    let pays_from_rays = (more_to_build_s > 0.0 && less_a_ray_s > 0.0).then(|| more_to_build_s / less_a_ray_s);
    Ok(Some(Advice {
        traversal: config.traversal.name(),
        leaf_primitives: config.leaf_primitives,
        octree_depth: config.depth.levels(),
        is_default: config == usual,
        is_worth_it: config != usual && is_clear(&usual_s, &config_s),
        speedup,
        pays_from_rays,
        memory_ratio: after.bytes.total() as f64 / before.bytes.total().max(1) as f64,
        options: options(config),
    }))
}

/// Whether `after` is less than `before` by a margin that is worth it, and in nine of ten rounds at least less at all.
fn is_clear(before: &[f64], after: &[f64]) -> bool {
    let lost = std::iter::zip(before, after).filter(|(before, after)| after >= before).count();
    Spread::of_ratios(before, after).median > Advice::WORTH_IT && 10 * lost <= before.len()
}

/// The settings as they are written on the command line.
fn options(config: &Config) -> String {
    let mut words = format!("--traversal {} --leaf-primitives {}", config.traversal, config.leaf_primitives);
    if let Depth::Levels(levels) = config.depth {
        let _ = write!(words, " --octree-depth {levels}");
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::traverse::TraversalKind;

    #[test]
    fn one_bad_round_of_eleven_is_forgiven() {
        let after = [1.0; 11];
        let mut before = [1.2; 11];
        before[3] = 0.5;
        assert!(is_clear(&before, &after));
        before[5] = 0.9;
        assert!(!is_clear(&before, &after));
        assert!(!is_clear(&[1.01; 11], &after), "always faster, but by next to nothing");
    }

    #[test]
    fn what_is_left_to_the_tracer_is_not_said() {
        let config = Config { traversal: TraversalKind::Samet, leaf_primitives: 3, depth: Depth::Auto };
        assert_eq!(options(&config), "--traversal samet --leaf-primitives 3");
        let deeper = Config { depth: Depth::Levels(9), ..config };
        assert_eq!(options(&deeper), "--traversal samet --leaf-primitives 3 --octree-depth 9");
    }
}
