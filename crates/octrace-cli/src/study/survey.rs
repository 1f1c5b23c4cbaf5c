//! The first look at every way to trace a scene: can it be built, is it another one at all, what does it count, and
//! does it see what the canonical tracer sees?

use super::context::Context;
use super::plan::{Config, Depth};
use super::rays;
use super::results::{Bytes, Checked, Status};
use super::scenes::StudyScene;
use super::walk::{Lengths, Ways};
use crate::failure::Failure;
use crate::stats::Stopwatch;
use octrace::octree::OctreeStats;
use octrace::trace::Counters;
use octrace::{Hit, Ray, Tracer};

/// A way to trace, and what the first look at it says.
pub struct Surveyed {
    /// The settings.
    pub config: Config,
    /// Whether it is to be measured, and if not, why.
    pub status: Status,
    /// Something to know about it.
    pub note: Option<String>,
    /// The place among all of the one with the very same octree.
    pub same_as: Option<usize>,
    /// What was counted, where it is to be measured.
    pub counts: Option<Counts>,
    /// How long it took to build, if it was.
    build_seconds: Option<f64>,
}

/// What is the same each time, and on every machine.
#[derive(Clone, Copy)]
pub struct Counts {
    /// The octrees together.
    pub octree: OctreeStats,
    /// Memory.
    pub bytes: Bytes,
    /// Of all rays of the picture.
    pub counters: Counters,
    /// Of the ways of the rays that walk.
    pub lengths: Lengths,
}

/// The first hit of each ray.
type Hits = Vec<Option<Hit>>;

/// A scene's picture, and what the canonical tracer sees of it.
pub struct Picture<'a> {
    /// All rays.
    pub rays: &'a [Ray],
    /// Which of them the canonical tracer was given.
    pub sparse: &'a [usize],
    /// What it saw.
    pub canonical_hits: &'a [Option<Hit>],
}

impl Picture<'_> {
    /// The rays that walk the octree with nothing done in the cells: as good as all, and sooner over.
    pub fn walking(&self) -> impl Iterator<Item = &Ray> + Clone {
        const EVERY: usize = 3;
        self.rays.iter().step_by(EVERY)
    }

    /// What the canonical tracer sees, and where it was not asked, these hits.
    fn expected(&self, mut hits: Hits) -> Hits {
        for (&i, hit) in std::iter::zip(self.sparse, self.canonical_hits) {
            hits[i] = *hit;
        }
        hits
    }
}

/// Looks at every configuration; says what the comparison of their hits comes to.
pub fn survey(
    scene: &StudyScene,
    configs: &[Config],
    picture: &Picture<'_>,
    longest_build_s: f64,
    context: &Context<'_>,
) -> Result<(Vec<Surveyed>, Checked), Failure> {
    context.progress.begin("comparing hits", configs.len() as u64);
    let mut surveyed: Vec<Surveyed> = Vec::new();
    let mut checked = Checked::default();
    let mut expected: Option<Hits> = None;
    for config in configs {
        let (mut one, tracer) = look(scene, config, &surveyed, longest_build_s, context)?;
        if let Some(tracer) = tracer {
            let (hits, counters) = rays::trace(&tracer, picture.rays.iter(), context.interrupt)?;
            one.counts = Some(Counts {
                octree: tracer.stats().octree.unwrap_or_default(),
                bytes: bytes_of(&tracer, config),
                counters,
                lengths: Ways::new(&tracer, picture.walking()).lengths(),
            });
            let expected = expected.get_or_insert_with(|| picture.expected(hits.clone()));
            checked = checked.and(Checked {
                configurations: 1,
                hits: hits.len() as u64,
                canonical_hits: picture.sparse.len() as u64,
                differing: rays::differing(hits.iter(), expected.iter()),
                leaks: counters.leaks,
            });
        }
        surveyed.push(one);
        context.progress.advance(1);
    }
    context.progress.end();
    Ok((surveyed, checked))
}

/// Whether a configuration is to be measured; the tracer, if it is.
fn look(
    scene: &StudyScene,
    config: &Config,
    earlier: &[Surveyed],
    longest_build_s: f64,
    context: &Context<'_>,
) -> Result<(Surveyed, Option<Tracer>), Failure> {
    let mut one = Surveyed {
        config: *config,
        status: Status::Measured,
        note: None,
        same_as: None,
        counts: None,
        build_seconds: None,
    };
    if let Some((slow, seconds)) = earlier.iter().find_map(|other| other.too_slow_for(config, longest_build_s)) {
        one.status = Status::TooSlowToBuild;
        one.note = Some(format!("with depth {slow} building took {seconds:.1} s"));
        return Ok((one, None));
    }
    let watch = Stopwatch::start();
    let tracer = context.build(scene, &config.options(scene.snap))?;
    one.build_seconds = Some(watch.elapsed());
    let octree = tracer.stats().octree.unwrap_or_default();

    let most = config.traversal.max_depth();
    if octree.depth == most && config.depth.levels().is_none_or(|levels| levels > most) {
        one.note = Some(format!("{} has {most} levels at most", config.traversal));
        if config.depth != Depth::Auto {
            one.status = Status::NotPossible;
            return Ok((one, None));
        }
    }
    let is_same = |other: &Surveyed| {
        other.config.traversal == config.traversal && other.counts.is_some_and(|counts| counts.octree == octree)
    };
    if let Some(same) = earlier.iter().position(is_same) {
        let Config { leaf_primitives, depth, .. } = earlier[same].config;
        one.status = Status::SameTree;
        one.same_as = Some(same);
        one.note = Some(format!("the same octree as with p {leaf_primitives}, depth {depth}"));
        return Ok((one, None));
    }
    Ok((one, Some(tracer)))
}

impl Surveyed {
    /// If building this took so long that a deeper octree with the same *p* would take too long: its depth, and how
    /// long.
    fn too_slow_for(&self, config: &Config, longest_build_s: f64) -> Option<(Depth, f64)> {
        let (Depth::Levels(here), Depth::Levels(there)) = (self.config.depth, config.depth) else { return None };
        let seconds = self.build_seconds.filter(|&seconds| seconds > longest_build_s)?;
        (here < there && self.config.leaf_primitives == config.leaf_primitives).then_some((self.config.depth, seconds))
    }
}

/// Memory that tracing needs with these settings.
pub fn bytes_of(tracer: &Tracer, config: &Config) -> Bytes {
    let octree = tracer.stats().octree.unwrap_or_default();
    let programs = octree.program_words * size_of::<u32>();
    let tree = if config.traversal.needs_tree() { octree.bytes - programs } else { 0 };
    let tables = tracer.octrees().map(|(_, traversal)| traversal.bytes()).sum();
    Bytes { tree, tables, programs }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_canonical_tracer_has_the_last_word() {
        let hit = |t: f64| Some(Hit { t, leaf: 0, surface: 0, entering: true, flipped: false });
        let picture = Picture { rays: &[], sparse: &[1], canonical_hits: &[hit(2.0)] };
        assert_eq!(picture.expected(vec![hit(1.0), hit(1.0), None]), [hit(1.0), hit(2.0), None]);
    }

    #[test]
    fn slow_is_slow_for_deeper_octrees_only() {
        let config = |levels: u32| Config { depth: Depth::Levels(levels), ..Config::default() };
        let slow = Surveyed {
            config: config(6),
            status: Status::Measured,
            note: None,
            same_as: None,
            counts: None,
            build_seconds: Some(5.0),
        };
        assert_eq!(slow.too_slow_for(&config(7), 4.0), Some((Depth::Levels(6), 5.0)));
        let other_p = Config { leaf_primitives: 1, ..config(7) };
        for fine in [config(6), config(5), Config::default(), other_p] {
            assert_eq!(slow.too_slow_for(&fine, 4.0), None);
        }
        assert_eq!(slow.too_slow_for(&config(7), 10.0), None);
    }
}
