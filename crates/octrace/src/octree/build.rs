//! Building: every cell hands its children only what survived in it.

use super::subtree::Subtree;
use super::{CellWord, Octree};
use crate::compile::{Catalog, Constant, Entry, Program, Split, Splitter, without_repeats};
use crate::exec::{Cancelled, Exec};
use crate::geom::Vec3;
use crate::surface::Octants;
use rayon::prelude::*;
use std::ops::Range;

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

/// Builds the octree of a body, no deeper than `max_depth` (at most [`BuildOptions::MAX_DEPTH`]); `None` where nothing in it
/// is bounded.
///
/// # Errors
/// If `exec` is cancelled.
pub fn build(
    catalog: &Catalog,
    program: &Program,
    options: &BuildOptions,
    max_depth: u32,
    exec: &Exec,
) -> Result<Option<Octree>, Cancelled> {
    let bounds = program.bounds;
    let Constant::Words(words) = &program.whole else { return Ok(None) };
    if bounds.is_empty() {
        return Ok(None);
    }
    let largest = bounds.size().max_abs();
    let farthest = bounds.min.max_abs().max(bounds.max.max_abs());
    // Faces love round numbers. A cube of an odd size in an odd place keeps cell walls off them.
    let half = short((0.5 * 1.0737 * largest).max(farthest * 1e-9).max(f64::MIN_POSITIVE * 1e30));
    let center = bounds.center() + Vec3::new(0.0137, 0.0113, 0.0127) * half;
    let center = Vec3::from(center.to_array().map(|c| (c / half * 1024.0).round() / 1024.0 * half));
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
        depth: 0,
        surfaces_classified: 0,
    };

    exec.progress.begin("building the octree", PROGRESS_STEPS);
    let mut splitter = Splitter::default();
    let words = without_repeats(catalog, words);
    let mut entries: Vec<Entry> = words.iter().map(|&word| Entry::new(catalog, word)).collect();
    let whole = 0..entries.len();
    let split = splitter.split(catalog, &mut entries, whole, &Octants::all(&octree.grown(center, half)), 1);
    let reduced = &entries[split.ranges[0].clone()];
    let budget = match options.depth {
        Some(_) => u64::MAX,
        None => MOST_WORDS_READ_AT_LEAST + MOST_WORDS_READ * reduced.len() as u64,
    };
    let builder = Builder {
        catalog,
        octree: &octree,
        leaf_surfaces: options.leaf_surfaces,
        depth,
        by_cost: options.depth.is_none(),
        exec,
    };
    let result = match (split.inside, split.outside) {
        (0, 0) => builder.top_cell(reduced, Place { center, half, level: 0 }, budget),
        (inside, _) => Ok(Part::constant(inside != 0)),
    };
    exec.progress.end();
    let part = result?;
    let mut tree = Subtree::default();
    octree.surfaces_classified = splitter.classified + part.classified;
    octree.root = part.assemble(&mut tree);
    octree.branches = tree.branches;
    octree.programs = tree.programs;
    octree.depth = tree.depth;
    Ok(Some(octree))
}

/// The number rounded up to eight binary digits. With few digits in the root's place and size, the planes of all cells are
/// computed without rounding, whatever the way (as long as the root is not extremely far from the origin).
fn short(v: f64) -> f64 {
    let (fraction, exponent) = libm::frexp(v);
    libm::ldexp((fraction * 256.0).ceil() / 256.0, exponent)
}

/// Where no depth is asked for, cutting may read every word of the program so many times. Where surfaces lie apart from each other, as they
/// mostly do, a tenth of it is enough; where all are everywhere, cutting would go on for nothing. Every cell has its share,
/// by the length of its program: whatever is spent in one corner, no other goes short.
const MOST_WORDS_READ: u64 = 4000;
/// And so many words for small programs.
const MOST_WORDS_READ_AT_LEAST: u64 = 1 << 18;

/// Progress is counted in cells of this level.
const PROGRESS_LEVEL: u32 = 3;
const PROGRESS_STEPS: u64 = 1 << (3 * PROGRESS_LEVEL);
/// Children of cells with so many words are built in parallel.
const PARALLEL_WORDS: usize = 256;

/// Where a cell is.
#[derive(Clone, Copy)]
struct Place {
    center: Vec3,
    half: f64,
    level: u32,
}

impl Place {
    fn child(self, octant: usize) -> Self {
        let half = self.half / 2.0;
        Self { center: Octree::child_center(self.center, half, octant), half, level: self.level + 1 }
    }
}

/// How many words are read to cut a cell.
fn cost_of_cutting(words: usize) -> u64 {
    8 * words as u64
}

/// The part of a budget for a child with so many words of all.
fn share(budget: u64, words: usize, all: usize) -> u64 {
    (u128::from(budget) * words as u128 / all.max(1) as u128) as u64
}

struct Builder<'a> {
    catalog: &'a Catalog,
    /// Only for its geometry.
    octree: &'a Octree,
    leaf_surfaces: usize,
    depth: u32,
    /// Whether cells are cut only where that is expected to pay.
    by_cost: bool,
    exec: &'a Exec,
}

impl Builder<'_> {
    /// Builds a cell with a long program: its children in parallel.
    fn top_cell(&self, program: &[Entry], place: Place, budget: u64) -> Result<Part, Cancelled> {
        let mut splitter = Splitter::default();
        let mut stack = program.to_vec();
        let program = 0..stack.len();
        let large = program.len() >= PARALLEL_WORDS && !self.is_leaf(&stack, place.level, budget);
        let cut = if large { self.cut(&mut splitter, &mut stack, program.clone(), place)? } else { None };
        let Some((split, all)) = cut else {
            let mut tree = Subtree::default();
            let root = self.cell(&mut tree, &mut splitter, &mut stack, program, place, budget)?;
            return Ok(Part { cells: Cells::Tree(tree, root), classified: splitter.classified });
        };
        let left = budget - cost_of_cutting(program.len());
        let children: Vec<Result<Part, Cancelled>> = (0..8)
            .into_par_iter()
            .map(|octant| match split.constant(octant) {
                Some(inside) => {
                    self.advance(place.level + 1);
                    Ok(Part::constant(inside))
                }
                None => {
                    let program = &stack[split.ranges[octant].clone()];
                    self.top_cell(program, place.child(octant), share(left, program.len(), all))
                }
            })
            .collect();
        let children = children.into_iter().collect::<Result<Vec<Part>, Cancelled>>()?;
        let classified = splitter.classified + children.iter().map(|child| child.classified).sum::<u64>();
        Ok(Part { cells: Cells::Branch(children), classified })
    }

    /// Builds a cell whose program is the range `program` of `stack`; leaves the stack as it was.
    fn cell(
        &self,
        tree: &mut Subtree,
        splitter: &mut Splitter,
        stack: &mut Vec<Entry>,
        program: Range<usize>,
        place: Place,
        budget: u64,
    ) -> Result<CellWord, Cancelled> {
        let leaf = self.is_leaf(&stack[program.clone()], place.level, budget);
        let bottom = stack.len();
        let cut = if leaf { None } else { self.cut(splitter, stack, program.clone(), place)? };
        let Some((split, all)) = cut else {
            self.advance(place.level);
            return Ok(tree.leaf(&stack[program], place.level));
        };
        let left = budget - cost_of_cutting(program.len());
        let index = tree.branches.len();
        tree.branches.push([CellWord::OUTSIDE; 8]);
        for octant in 0..8 {
            let word = match split.constant(octant) {
                Some(inside) => {
                    self.advance(place.level + 1);
                    if inside { CellWord::INSIDE } else { CellWord::OUTSIDE }
                }
                None => {
                    let program = split.ranges[octant].clone();
                    let budget = share(left, program.len(), all);
                    self.cell(tree, splitter, stack, program, place.child(octant), budget)?
                }
            };
            tree.branches[index][octant] = word;
        }
        stack.truncate(bottom);
        if place.level == PROGRESS_LEVEL {
            self.exec.progress.advance(1);
        }
        Ok(tree.join(index))
    }

    /// The programs of a cell's children, on top of the stack, and how many words they have together. `None`, and the stack
    /// as it was, where it does not pay to cut the cell.
    fn cut(
        &self,
        splitter: &mut Splitter,
        stack: &mut Vec<Entry>,
        program: Range<usize>,
        place: Place,
    ) -> Result<Option<(Split, usize)>, Cancelled> {
        self.exec.cancel.check()?;
        let (bottom, words) = (stack.len(), program.len());
        let octants = Octants::new(place.center, place.half / 2.0, self.octree.margin);
        let split = splitter.split(self.catalog, stack, program, &octants, u8::MAX);
        if self.pays(words, split.ranges.iter().map(Range::len)) {
            let all = split.ranges.iter().map(Range::len).sum();
            return Ok(Some((split, all)));
        }
        stack.truncate(bottom);
        Ok(None)
    }

    /// Counts a finished cell that is not cut: as many steps as it has cells of the progress level.
    fn advance(&self, level: u32) {
        if level <= PROGRESS_LEVEL {
            self.exec.progress.advance(1 << (3 * (PROGRESS_LEVEL - level)));
        }
    }

    fn is_leaf(&self, program: &[Entry], level: u32, budget: u64) -> bool {
        level >= self.depth || cost_of_cutting(program.len()) > budget || self.surfaces_at_most(program)
    }

    /// Whether rays are expected to be faster in the children, whose programs have those lengths (0 where a child is all
    /// inside or all outside), than in a leaf with a program of so many words.
    ///
    /// A ray that meets a cube meets each of its octants with a probability of 1/4 (Cauchy: the ratio of surfaces), and some
    /// end before they get there.
    fn pays(&self, words: usize, children: impl Iterator<Item = usize>) -> bool {
        /// A step to the next cell takes as long as so many words of a program.
        const STEP: f64 = 2.0;
        /// The share of rays through a cell that get to a certain child.
        const REACHED: f64 = 0.2;
        /// With longer programs there is always something to gain, if not at once.
        const LONG: usize = 64;
        let cut = REACHED * children.map(|words| STEP + words as f64).sum::<f64>();
        !self.by_cost || words > LONG || cut < STEP + words as f64
    }

    /// Whether a program has no more different surfaces than a leaf may.
    fn surfaces_at_most(&self, program: &[Entry]) -> bool {
        let mut seen = [0; BuildOptions::MAX_LEAF_SURFACES];
        let mut count = 0;
        for entry in program.iter().filter(|entry| entry.is_literal()) {
            if !seen[..count].contains(&entry.surface) {
                if count == self.leaf_surfaces.min(seen.len()) {
                    return false;
                }
                seen[count] = entry.surface;
                count += 1;
            }
        }
        true
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
