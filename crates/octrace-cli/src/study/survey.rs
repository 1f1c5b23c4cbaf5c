//! The first look at every way to trace a scene: can it be built, is it another one at all, what does it count, and does
//! it see what the canonical tracer sees?

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
}

/// The first hit of each ray.
type Hits = Vec<Option<Hit>>;

/// Looks at every configuration. The first one must be such that it can be built.
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
    // What is seen: what the canonical tracer sees, and where it was not asked, what the first configuration sees.
    let mut expected: Option<Hits> = None;
    for config in configs {
        let looked_at = look(scene, config, &surveyed, picture, longest_build_s, context)?;
        if let (one, Some(hits)) = &looked_at {
            let sparse = picture.sparse.iter().map(|&i| &hits[i]);
            let differing = rays::differing(sparse, picture.canonical_hits.iter());
            let others = expected.get_or_insert_with(|| hits.clone());
            for (&i, hit) in std::iter::zip(picture.sparse, picture.canonical_hits) {
                others[i] = *hit;
            }
            let leaks = one.counts.map_or(0, |counts| counts.counters.leaks);
            checked = checked.and(Checked {
                configurations: 1,
                hits: hits.len() as u64,
                canonical_hits: picture.sparse.len() as u64,
                differing: differing.max(rays::differing(hits.iter(), others.iter())),
                leaks,
            });
        }
        surveyed.push(looked_at.0);
        context.progress.advance(1);
    }
    context.progress.end();
    Ok((surveyed, checked))
}

/// Looks at one configuration; the second value is what it sees, if it is to be measured.
fn look(
    scene: &StudyScene,
    config: &Config,
    earlier: &[Surveyed],
    picture: &Picture<'_>,
    longest_build_s: f64,
    context: &Context<'_>,
) -> Result<(Surveyed, Option<Hits>), Failure> {
    let left_out = |status: Status, note: String, build_seconds: Option<f64>| {
        Ok((Surveyed { config: *config, status, note: Some(note), same_as: None, counts: None, build_seconds }, None))
    };
    if let Some(slow) = earlier.iter().find(|other| other.is_too_slow_for(config, longest_build_s)) {
        let note = format!("with depth {} building took {:.1} s", slow.config.depth, slow.build_seconds.unwrap_or(0.0));
        return left_out(Status::TooSlowToBuild, note, None);
    }
    let watch = Stopwatch::start();
    let tracer = context.build(scene, &config.options(scene.snap))?;
    let build_seconds = Some(watch.elapsed());
    let octree = tracer.stats().octree.unwrap_or_default();

    let most = config.traversal.max_depth();
    let is_cut_off = octree.depth == most && config.depth.levels().is_none_or(|levels| levels > most);
    if is_cut_off && config.depth != Depth::Auto {
        let note = format!("{} has {most} levels at most", config.traversal);
        return left_out(Status::NotPossible, note, build_seconds);
    }
    let is_same = |other: &Surveyed| {
        other.config.traversal == config.traversal && other.counts.is_some_and(|counts| counts.octree == octree)
    };
    if let Some(same) = earlier.iter().position(is_same) {
        let Config { leaf_primitives, depth, .. } = earlier[same].config;
        let note = Some(format!("the same octree as with p {leaf_primitives}, depth {depth}"));
        let (status, same_as) = (Status::SameTree, Some(same));
        return Ok((Surveyed { config: *config, status, note, same_as, counts: None, build_seconds }, None));
    }
    let (hits, counters) = rays::trace(&tracer, picture.rays.iter(), context.interrupt)?;
    let counts = Counts {
        octree,
        bytes: bytes_of(&tracer, config),
        counters,
        lengths: Ways::new(&tracer, picture.walking()).lengths(),
    };
    let note = is_cut_off.then(|| format!("{} has {most} levels at most", config.traversal));
    let surveyed = Surveyed {
        config: *config,
        status: Status::Measured,
        note,
        same_as: None,
        counts: Some(counts),
        build_seconds,
    };
    Ok((surveyed, Some(hits)))
}

impl Surveyed {
    /// Whether building this took so long that a deeper octree with the same *p* would take too long.
    fn is_too_slow_for(&self, config: &Config, longest_build_s: f64) -> bool {
        let (Depth::Levels(here), Depth::Levels(there)) = (self.config.depth, config.depth) else { return false };
        let is_slow = self.build_seconds.is_some_and(|seconds| seconds > longest_build_s);
        is_slow && here <= there && self.config.leaf_primitives == config.leaf_primitives && self.config != *config
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
