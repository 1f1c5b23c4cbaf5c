//! One scene, measured: surveyed, checked, timed, and what it all comes to.

use super::advice::advise;
use super::context::Context;
use super::plan::{Config, Plan};
use super::rays;
use super::results::{Canonical, Figures, Run, SceneReport, Walk};
use super::rounds::{Times, rounds};
use super::scenes::{Family, StudyScene};
use super::survey::{Counts, Picture, Surveyed, survey};
use crate::failure::Failure;
use crate::framing::Framing;
use crate::statistics::Spread;
use octrace::trace::TracerStats;
use octrace::traverse::TraversalKind;
use octrace::{Accel, TracerOptions};

/// Measures a scene.
pub fn study_scene(scene: &StudyScene, plan: &Plan, context: &Context<'_>) -> Result<SceneReport, Failure> {
    let options = TracerOptions { accel: Accel::None, snap: scene.snap, ..TracerOptions::default() };
    let canonical = context.build(scene, &options)?;
    let camera = Framing::default().camera_for(&canonical, scene.camera, plan.size_px);
    let all = rays::of_picture(&camera, plan.size_px);
    let stats = canonical.stats();
    let sparse = rays::spread(plan.canonical_rays(stats.literals), all.len());
    let (canonical_hits, counters) = rays::trace(&canonical, sparse.iter().map(|&i| &all[i]), context.interrupt)?;
    let canonical_tests = counters.surface_tests;
    drop(canonical);

    let picture = Picture { rays: &all, sparse: &sparse, canonical_hits: &canonical_hits };
    let configs = plan.configs(scene, stats.literals);
    let (surveyed, checked) = survey(scene, &configs, &picture, plan.longest_build_s(), context)?;
    let measurable: Vec<(Config, Counts)> = surveyed.iter().filter_map(|one| Some((one.config, one.counts?))).collect();
    let to_time: Vec<Config> = measurable.iter().map(|(config, _)| *config).collect();
    let (times, canonical_times) = rounds(scene, &to_time, &picture, plan.repeat, context)?;

    let yardstick = Yardstick { rays: all.len(), sparse: sparse.len(), usual: &times[0], canonical: &canonical_times };
    let figures: Vec<Figures> = std::iter::zip(&measurable, &times)
        .map(|((config, counts), times)| yardstick.figures(config, counts, times))
        .collect();
    let candidates: Vec<(Config, &Figures)> = std::iter::zip(to_time, &figures).collect();
    let advice = if plan.chooses(scene) { advise(scene, &candidates, &all, plan.repeat, context)? } else { None };
    let TracerStats { primitives, surfaces, .. } = stats;
    Ok(SceneReport {
        name: scene.name.clone(),
        description: scene.description.clone(),
        family: scene.family.map(Family::name),
        primitives,
        surfaces,
        tree_depth: scene.tree_depth,
        rays: all.len(),
        checked,
        canonical: yardstick.canonical(canonical_tests),
        runs: runs(&surveyed, &figures),
        advice,
    })
}

/// Every configuration with its figures, which are those of the measured ones, in order.
fn runs(surveyed: &[Surveyed], figures: &[Figures]) -> Vec<Run> {
    let mut figures = figures.iter();
    let run = |one: &Surveyed| Run {
        traversal: one.config.traversal.name(),
        leaf_primitives: one.config.leaf_primitives,
        octree_depth: one.config.depth.levels(),
        is_default: one.config == Config::default(),
        status: one.status,
        note: one.note.clone(),
        same_as: one.same_as,
        figures: if one.counts.is_some() { figures.next().cloned() } else { None },
    };
    surveyed.iter().map(run).collect()
}

/// What times are divided by, and compared with.
struct Yardstick<'a> {
    rays: usize,
    sparse: usize,
    usual: &'a Times,
    canonical: &'a Times,
}

impl Yardstick<'_> {
    /// Nanoseconds a ray, round by round.
    fn ns_per_ray(times: &Times, rays: usize) -> Vec<f64> {
        times.trace_s.iter().map(|seconds| seconds * 1e9 / rays.max(1) as f64).collect()
    }

    fn figures(&self, config: &Config, counts: &Counts, times: &Times) -> Figures {
        let Counts { octree, bytes, counters, lengths } = counts;
        let ns = Self::ns_per_ray(times, self.rays);
        let ns_per_ray = Spread::of(ns.iter().copied());
        let per = |count: u64, things: u64| count as f64 / things.max(1) as f64;
        let walk = Spread::of(times.walk_s.iter().map(|seconds| seconds * 1e9));
        let takes_every_cell = config.traversal == TraversalKind::Fujimoto && lengths.grid_steps > 0;
        let steps = takes_every_cell.then_some(lengths.grid_steps);
        Figures {
            octree: octree.into(),
            bytes: *bytes,
            build_seconds: Spread::of(times.build_s.iter().copied()),
            ns_per_ray,
            picture_seconds: ns_per_ray.times(self.rays as f64 / 1e9),
            mrays_per_second: 1e3 / ns_per_ray.median,
            cells_per_ray: per(counters.cells, self.rays as u64),
            surface_tests_per_ray: per(counters.surface_tests, self.rays as u64),
            walk: Walk {
                cells_per_ray: per(lengths.cells, lengths.rays),
                ns_per_cell: walk.times(1.0 / lengths.cells.max(1) as f64),
                grid_steps_per_ray: steps.map(|steps| per(steps, lengths.rays)),
                ns_per_grid_step: steps.map(|steps| walk.times(1.0 / steps as f64)),
            },
            ratio_to_default: Spread::of_ratios(&ns, &Self::ns_per_ray(self.usual, self.rays)),
            speedup_over_canonical: Spread::of_ratios(&Self::ns_per_ray(self.canonical, self.sparse), &ns),
        }
    }

    fn canonical(&self, surface_tests: u64) -> Canonical {
        let ns = Self::ns_per_ray(self.canonical, self.sparse);
        let ns_per_ray = Spread::of(ns.iter().copied());
        Canonical {
            rays_traced: self.sparse,
            build_seconds: Spread::of(self.canonical.build_s.iter().copied()),
            ns_per_ray,
            picture_seconds: ns_per_ray.times(self.rays as f64 / 1e9),
            mrays_per_second: 1e3 / ns_per_ray.median,
            surface_tests_per_ray: surface_tests as f64 / self.sparse.max(1) as f64,
            ratio_to_default: Spread::of_ratios(&ns, &Self::ns_per_ray(self.usual, self.rays)),
        }
    }
}
