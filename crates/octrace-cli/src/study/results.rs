//! What a study finds, as plain data: what `--json` writes and the report shows. `docs/command-line.md` explains the
//! keys.

use super::machine::Machine;
use crate::statistics::Spread;
use octrace::octree::OctreeStats;
use serde::Serialize;

/// One whole study.
#[derive(Clone, Debug, Serialize)]
pub struct Study {
    /// The program's version.
    pub octrace: &'static str,
    /// The command line.
    pub command: String,
    /// When it was finished, UTC.
    pub date: String,
    /// How long it took, in seconds.
    pub seconds: f64,
    /// On what.
    pub machine: Machine,
    /// How it was measured.
    pub settings: Settings,
    /// What was compared, and whether all was equal.
    pub checked: Checked,
    /// Scene by scene.
    pub scenes: Vec<SceneReport>,
    /// Trees against grids with the same smallest cell.
    pub memory: Vec<MemoryRow>,
}

/// How it was measured.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Settings {
    /// Pixels per row.
    pub width: u32,
    /// Rows; each pixel has one ray, from the camera.
    pub height: u32,
    /// Rounds of timing.
    pub repeat: u32,
    /// Threads that build, trace and walk.
    pub threads: usize,
}

/// Hits that were compared bit for bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Checked {
    /// Ways to trace scenes.
    pub configurations: u64,
    /// Rays whose results were compared with those of another way.
    pub hits: u64,
    /// Of these, those compared with the canonical tracer.
    pub canonical_hits: u64,
    /// Rays with another result. Anything but 0 is a defect.
    pub differing: u64,
    /// Rays that an octree handed to the canonical tracer. Anything but 0 is a defect.
    pub leaks: u64,
}

impl Checked {
    /// Both together.
    pub fn and(self, o: Self) -> Self {
        Self {
            configurations: self.configurations + o.configurations,
            hits: self.hits + o.hits,
            canonical_hits: self.canonical_hits + o.canonical_hits,
            differing: self.differing + o.differing,
            leaks: self.leaks + o.leaks,
        }
    }
}

/// What was found out about a scene.
#[derive(Clone, Debug, Serialize)]
pub struct SceneReport {
    /// A short name, or the file's.
    pub name: String,
    /// What it is.
    pub description: String,
    /// The family that it belongs to, if to any.
    pub family: Option<&'static str>,
    /// Primitives in the tree.
    pub primitives: usize,
    /// Different surfaces.
    pub surfaces: usize,
    /// Boolean operations on top of one another.
    pub tree_depth: usize,
    /// Rays of the picture.
    pub rays: usize,
    /// What the comparison of hits says.
    pub checked: Checked,
    /// Without octree.
    pub canonical: Canonical,
    /// With octrees; the default settings first.
    pub runs: Vec<Run>,
    /// Which settings suit the scene, where more than the default ones were tried.
    pub advice: Option<Advice>,
}

/// The canonical tracer on a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Canonical {
    /// Rays that it was given, spread over the picture: all of them, or as many as do not take too long.
    pub rays_traced: usize,
    /// Compiling the program.
    pub build_seconds: Spread,
    /// Time for one ray.
    pub ns_per_ray: Spread,
    /// Time for all rays of the picture, at that rate.
    pub picture_seconds: Spread,
    /// Millions of rays a second.
    pub mrays_per_second: f64,
    /// Surfaces of primitives that each ray is tested against.
    pub surface_tests_per_ray: f64,
    /// Its time over that of the default settings.
    pub ratio_to_default: Spread,
}

/// One way to trace a scene through an octree.
#[derive(Clone, Debug, Serialize)]
pub struct Run {
    /// How the octree is walked.
    pub traversal: &'static str,
    /// The paper's *p*, in surfaces.
    pub leaf_primitives: usize,
    /// The depth asked for; null where the tracer chose.
    pub octree_depth: Option<u32>,
    /// Whether these are the default settings.
    pub is_default: bool,
    /// Whether it was measured, or why not.
    pub status: Status,
    /// Something to know about it.
    pub note: Option<String>,
    /// Where in the list of runs the one with the very same octree is.
    pub same_as: Option<usize>,
    /// What was measured.
    pub figures: Option<Figures>,
}

/// Whether a way to trace was measured, or why not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// It was.
    Measured,
    /// The traversal cannot walk an octree of that depth.
    NotPossible,
    /// The octree is the very one of settings that were measured.
    SameTree,
    /// Building shallower octrees takes too long already.
    TooSlowToBuild,
}

/// What was measured of one way to trace.
#[derive(Clone, Debug, Serialize)]
pub struct Figures {
    /// The octree.
    pub octree: OctreeFigures,
    /// Memory.
    pub bytes: Bytes,
    /// From the solid to the tracer: program, octree, the traversal's tables.
    pub build_seconds: Spread,
    /// Time for one ray.
    pub ns_per_ray: Spread,
    /// Time for all rays of the picture.
    pub picture_seconds: Spread,
    /// Millions of rays a second.
    pub mrays_per_second: f64,
    /// Cells visited until the hit.
    pub cells_per_ray: f64,
    /// Surfaces of primitives evaluated until the hit.
    pub surface_tests_per_ray: f64,
    /// The walk by itself.
    pub walk: Walk,
    /// Its time over that of the default settings: below 1 it is faster.
    pub ratio_to_default: Spread,
    /// The canonical tracer's time over its time: so many times as fast.
    pub speedup_over_canonical: Spread,
}

/// The pure walk through the whole root cube, nothing done in any cell.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Walk {
    /// Cells on a ray's way through the root.
    pub cells_per_ray: f64,
    /// Time of the walk by its cells.
    pub ns_per_cell: Spread,
    /// Steps in the grid on the way; only where the traversal takes every cell of a grid.
    pub grid_steps_per_ray: Option<f64>,
    /// Time of the walk by these.
    pub ns_per_grid_step: Option<Spread>,
}

impl Walk {
    /// Time of one step, whatever a step is for the traversal.
    pub fn ns_per_step(&self) -> Spread {
        self.ns_per_grid_step.unwrap_or(self.ns_per_cell)
    }
}

/// How large an octree is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct OctreeFigures {
    /// Levels below the root.
    pub depth: u32,
    /// Cells with eight children.
    pub branches: usize,
    /// Cells with a program.
    pub leaves: usize,
    /// Cells without a point of the solid.
    pub outside: usize,
    /// Cells that are all solid.
    pub inside: usize,
    /// Words in the leaves' programs, equal ones counted once.
    pub program_words: usize,
}

impl OctreeFigures {
    /// Cells of all kinds.
    pub fn nodes(&self) -> usize {
        self.branches + self.leaves + self.outside + self.inside
    }
}

impl From<&OctreeStats> for OctreeFigures {
    fn from(stats: &OctreeStats) -> Self {
        let OctreeStats { branches, leaves, outside, inside, depth, program_words, .. } = *stats;
        Self { branches, leaves, outside, inside, depth, program_words }
    }
}

/// What a traversal needs in memory while tracing, beside the surfaces themselves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Bytes {
    /// The tree of cells; 0 where the traversal's tables stand for it.
    pub tree: usize,
    /// The traversal's tables: parents, hash table or grid.
    pub tables: usize,
    /// The leaves' programs.
    pub programs: usize,
}

impl Bytes {
    /// All of it.
    pub fn total(&self) -> usize {
        self.tree + self.tables + self.programs
    }
}

/// Settings that suit a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Advice {
    /// How the octree is walked.
    pub traversal: &'static str,
    /// `--leaf-primitives`.
    pub leaf_primitives: usize,
    /// `--octree-depth`; null to leave it to the tracer.
    pub octree_depth: Option<u32>,
    /// Whether these are the default settings: no others were faster.
    pub is_default: bool,
    /// Whether these settings gain enough to bother: when measured once more, in nine of ten rounds at least they were
    /// faster than the default ones, and in the middle by more than [`Advice::WORTH_IT`].
    pub is_worth_it: bool,
    /// The default settings' time over theirs, in rounds of their own: so many times as fast.
    pub speedup: Spread,
    /// Rays after which they have made up for building longer; null if they take no longer, or never do.
    pub pays_from_rays: Option<f64>,
    /// Memory, over that of the default settings.
    pub memory_ratio: f64,
    /// The options, as they are written on the command line.
    pub options: String,
}

impl Advice {
    /// What is gained must exceed this.
    pub const WORTH_IT: f64 = 1.03;
}

/// What a traversal's tables take for one octree, and a complete grid for the same smallest cell.
#[derive(Clone, Debug, Serialize)]
pub struct MemoryRow {
    /// The scene.
    pub scene: String,
    /// The paper's *p*, in surfaces.
    pub leaf_primitives: usize,
    /// Levels below the root.
    pub depth: u32,
    /// Cells of the octree.
    pub nodes: usize,
    /// Memory for `bresenham`.
    pub bresenham: Bytes,
    /// Memory for `glassner`.
    pub glassner: Bytes,
    /// Memory for `fujimoto`.
    pub fujimoto: Bytes,
    /// Whether the grid was made, and not only computed: it has eight times as many cells with each level.
    pub grid_was_made: bool,
    /// `fujimoto`'s memory over `bresenham`'s, without the leaves' programs, which both need.
    pub grid_over_tree: f64,
}
