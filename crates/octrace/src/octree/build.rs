//! Building: every cell hands its children only what survived in it.

use super::subtree::Subtree;
use super::worker::{Place, Reduced, Worker};
use super::{CellWord, Octree};
use crate::compile::{
    Boxes, Catalog, Constant, Entry, Items, Lattice, LatticeCell, Program, node_end, without_repeats,
};
use crate::exec::{Cancelled, Exec};
use crate::geom::{Bounds, Vec3};
use crate::surface::Octants;
use rayon::prelude::*;

/// When to stop cutting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildOptions {
    /// A cell with this many different surfaces or fewer is a leaf: the paper's *p*, which counts primitives (a block has six
    /// surfaces). More than [`MAX_LEAF_SURFACES`](Self::MAX_LEAF_SURFACES) count as that many.
    pub leaf_surfaces: usize,
    /// Levels below the root at most, as the paper has it. `None` leaves that to the expected cost of rays, and bounds the
    /// work of building (`docs/decisions/0004-when-to-stop.md`).
    pub depth: Option<u32>,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self { leaf_surfaces: 3, depth: None }
    }
}

impl BuildOptions {
    /// The most surfaces that a leaf above the greatest depth can be allowed.
    pub const MAX_LEAF_SURFACES: usize = 64;
    /// The deepest octree that can be asked for; cells must stay large compared to their margin.
    pub const MAX_DEPTH: u32 = 20;
}

/// Builds the octree of a body around a `room`, which holds all of it that is bounded, no deeper than `max_depth` (at most
/// [`BuildOptions::MAX_DEPTH`]); `None` where the room is empty, or the body all or nothing.
///
/// # Errors
/// If `exec` is cancelled.
pub fn build(
    catalog: &Catalog,
    program: &Program,
    room: &Bounds,
    options: &BuildOptions,
    max_depth: u32,
    exec: &Exec,
) -> Result<Option<Octree>, Cancelled> {
    let Constant::Words(words) = &program.whole else { return Ok(None) };
    if room.is_empty() {
        return Ok(None);
    }
    let largest = room.size().max_abs();
    let farthest = room.min.max_abs().max(room.max.max_abs());
    // Faces love round numbers. A cube of an odd size in an odd place keeps cell walls off them; it is hardly larger than
    // what is in it, lest rays come through cells before they come to anything.
    let half = short((0.5 * 1.004 * largest).max(farthest * 1e-9).max(f64::MIN_POSITIVE * 1e30));
    let center = room.center() + Vec3::new(0.001_37, 0.001_13, 0.001_27) * half;
    let center = Vec3::from(center.to_array().map(|c| (c / half * 8192.0).round() / 8192.0 * half));
    // Hits are computed to some 1e-14 of the distances involved; the margin leaves plenty.
    let margin = (1e-8 * half).max(1e-12 * farthest);

    let depth = options.depth.unwrap_or(BuildOptions::MAX_DEPTH).min(max_depth);
    let mut octree = Octree {
        center,
        half,
        margin,
        root: CellWord::OUTSIDE,
        branches: Vec::new(),
        programs: Vec::new(),
        has_mixed_leaves: false,
        depth: 0,
        surfaces_classified: 0,
    };

    exec.progress.begin("building the octree", PROGRESS_STEPS);
    let words = without_repeats(catalog, words);
    let lattice = Lattice { corner: center - Vec3::splat(half), edge: 2.0 * half, margin: 2.0 * margin };
    let entries = words.iter().map(|&word| Entry::new(catalog, word)).collect();
    let items = Items::new(catalog, entries, &lattice);
    let mut worker = Worker::new(items.program());
    let boxes = Boxes { octants: Octants::all(&octree.grown(center, half)), items: Some((&items, LatticeCell::WHOLE)) };
    let whole = 0..worker.stack.len();
    let split = worker.splitter.split(catalog, &mut worker.stack, whole, &boxes, 1);
    let budget = match options.depth {
        Some(_) => u64::MAX,
        None => MOST_WORDS_READ_AT_LEAST + MOST_WORDS_READ * split.words[0] as u64,
    };
    let builder = Builder {
        catalog,
        items: &items,
        margin,
        leaf_surfaces: options.leaf_surfaces,
        depth,
        by_cost: options.depth.is_none(),
        exec,
    };
    let result = match split.constant(0) {
        Some(inside) => Ok(Part::constant(inside)),
        None => {
            let place = Place { center, half, on_lattice: LatticeCell::ROOT, level: 0 };
            builder.top_cell(&worker.stack, Reduced::of(&split, 0), place, budget)
        }
    };
    exec.progress.end();
    let part = result?;
    let mut tree = Subtree::default();
    octree.surfaces_classified = worker.splitter.classified + part.classified;
    octree.root = part.assemble(&mut tree);
    octree.branches = tree.branches;
    octree.programs = tree.programs;
    octree.depth = tree.depth;
    octree.has_mixed_leaves = has_mixed_leaves(catalog, &octree.programs);
    Ok(Some(octree))
}

/// Whether a whole solid is but a part of one of the programs, which follow each other.
fn has_mixed_leaves(catalog: &Catalog, programs: &[u32]) -> bool {
    let mut at = 0;
    while at < programs.len() && !catalog.prototypes.is_empty() {
        let end = node_end(programs, at);
        if end > at + 1 && programs[at..end].iter().any(|&word| catalog.placed_by(word).is_some()) {
            return true;
        }
        at = end;
    }
    false
}

/// The number rounded up to eleven binary digits. With few digits in the root's place and size, the planes of all cells are
/// computed without rounding, whatever the way (as long as the root is not extremely far from the origin).
fn short(v: f64) -> f64 {
    let (fraction, exponent) = libm::frexp(v);
    libm::ldexp((fraction * 2048.0).ceil() / 2048.0, exponent)
}

/// Where no depth is asked for, cutting may read every word of the program so many times. Where surfaces lie apart from each other, as they
/// mostly do, a tenth of it is enough; where all are everywhere, cutting would go on for nothing. Every cell has its share,
/// by the length of its program: whatever is spent in one corner, no other goes short.
const MOST_WORDS_READ: u64 = 4000;
/// And so many words for small programs.
const MOST_WORDS_READ_AT_LEAST: u64 = 1 << 18;

/// Progress is counted in cells of this level.
pub(super) const PROGRESS_LEVEL: u32 = 3;
const PROGRESS_STEPS: u64 = 1 << (3 * PROGRESS_LEVEL);
/// Children of cells with so many words are built in parallel.
const PARALLEL_WORDS: usize = 1024;

/// How many words are read to cut a cell.
pub(super) fn cost_of_cutting(words: usize) -> u64 {
    8 * words as u64
}

/// The part of a budget for a child with so many words of all.
pub(super) fn share(budget: u64, words: usize, all: usize) -> u64 {
    (u128::from(budget) * words as u128 / all.max(1) as u128) as u64
}

/// What all workers share.
pub(super) struct Builder<'a> {
    pub catalog: &'a Catalog,
    pub items: &'a Items,
    pub margin: f64,
    pub leaf_surfaces: usize,
    pub depth: u32,
    /// Whether cells are cut only where that is expected to pay.
    pub by_cost: bool,
    pub exec: &'a Exec,
}

impl Builder<'_> {
    /// Builds a cell whose program is on that stack; if it is a long one, its children in parallel.
    fn top_cell(&self, stack: &[Entry], reduced: Reduced, place: Place, budget: u64) -> Result<Part, Cancelled> {
        let mut worker = Worker::new(stack[reduced.range.clone()].to_vec());
        let mut reduced = Reduced { range: 0..reduced.range.len(), ..reduced };
        if reduced.words < PARALLEL_WORDS {
            let root = worker.cell(self, reduced, place, budget)?;
            return Ok(Part { cells: Cells::Tree(worker.tree, root), classified: worker.splitter.classified });
        }
        let Some(split) = worker.cut(self, &mut reduced, place, budget)? else {
            let root = worker.tree.leaf(&worker.stack[reduced.range], place.level);
            self.advance(place.level);
            return Ok(Part { cells: Cells::Tree(worker.tree, root), classified: worker.splitter.classified });
        };
        let left = budget - cost_of_cutting(reduced.words);
        let all = split.words.iter().sum();
        let children: Vec<Result<Part, Cancelled>> = (0..8)
            .into_par_iter()
            .map(|octant| match split.constant(octant) {
                Some(inside) => {
                    self.advance(place.level + 1);
                    Ok(Part::constant(inside))
                }
                None => {
                    let budget = share(left, split.words[octant], all);
                    self.top_cell(&worker.stack, Reduced::of(&split, octant), place.child(octant), budget)
                }
            })
            .collect();
        let children = children.into_iter().collect::<Result<Vec<Part>, Cancelled>>()?;
        let classified = worker.splitter.classified + children.iter().map(|child| child.classified).sum::<u64>();
        Ok(Part { cells: Cells::Branch(children), classified })
    }

    /// Counts a finished cell that is not cut: as many steps as it has cells of the progress level.
    pub fn advance(&self, level: u32) {
        if level <= PROGRESS_LEVEL {
            self.exec.progress.advance(1 << (3 * (PROGRESS_LEVEL - level)));
        }
    }

    /// Whether rays are expected to be faster in the children, whose programs have those lengths (0 where a child is all
    /// inside or all outside), than in a leaf with a program of so many words.
    ///
    /// A ray that meets a cube meets each of its octants with a probability of 1/4 (Cauchy: the ratio of surfaces), and some
    /// end before they get there.
    pub fn pays(&self, words: usize, children: [usize; 8]) -> bool {
        /// A step to the next cell takes as long as so many words of a program.
        const STEP: f64 = 2.0;
        /// The share of rays through a cell that get to a certain child.
        const REACHED: f64 = 0.2;
        /// With longer programs there is always something to gain, if not at once: what is small and in the middle of a
        /// cell is in all of its children.
        const LONG: usize = 12;
        let cut = REACHED * children.iter().map(|&words| STEP + words as f64).sum::<f64>();
        !self.by_cost || words > LONG || cut < STEP + words as f64
    }
}

/// A part of the tree, and how often a surface was classified to build it.
struct Part {
    cells: Cells,
    classified: u64,
}

enum Cells {
    /// With its root.
    Tree(Subtree, CellWord),
    /// The eight parts of a branch.
    Branch(Vec<Part>),
}

impl Part {
    /// A part of one cell, all inside or all outside.
    fn constant(inside: bool) -> Self {
        let root = if inside { CellWord::INSIDE } else { CellWord::OUTSIDE };
        Self { cells: Cells::Tree(Subtree::default(), root), classified: 0 }
    }

    /// Moves everything into one tree; returns the root.
    fn assemble(self, tree: &mut Subtree) -> CellWord {
        match self.cells {
            Cells::Tree(part, root) => tree.adopt(part, root),
            Cells::Branch(children) => {
                let index = tree.branches.len();
                tree.branches.push([CellWord::OUTSIDE; 8]);
                for (octant, child) in children.into_iter().enumerate() {
                    let word = child.assemble(tree);
                    tree.branches[index][octant] = word;
                }
                tree.join(index)
            }
        }
    }
}
