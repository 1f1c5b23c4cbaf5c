//! Building: every cell hands its children only what survived in it.

use super::subtree::Subtree;
use super::{CellWord, Octree};
use crate::compile::{Catalog, Constant, Program, Simplified, Simplifier, Word, without_repeats};
use crate::exec::{Cancelled, Exec};
use crate::geom::Vec3;
use crate::surface::CellBox;
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
    let builder = Builder {
        catalog,
        octree: &octree,
        leaf_surfaces: options.leaf_surfaces,
        depth,
        by_cost: options.depth.is_none(),
        exec,
    };
    let mut simplifier = Simplifier::default();
    let mut reduced = Vec::new();
    let words = without_repeats(catalog, words);
    let result = match simplifier.simplify(catalog, &words, &octree.grown(center, half), &mut reduced) {
        Simplified::Constant(inside) => Ok(Subtree::constant(inside)),
        Simplified::Reduced => {
            let budget = match options.depth {
                Some(_) => u64::MAX,
                None => MOST_WORDS_READ_AT_LEAST + MOST_WORDS_READ * reduced.len() as u64,
            };
            builder.top_cell(&reduced, Place { center, half, level: 0 }, budget)
        }
    };
    exec.progress.end();
    let tree = result?;
    octree.root = tree.root;
    octree.branches = tree.branches;
    octree.programs = tree.programs;
    octree.depth = tree.depth;
    octree.surfaces_classified = tree.classified + simplifier.classified;
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
/// Cells above this level are built in parallel, each child for itself.
const PARALLEL_LEVELS: u32 = 3;

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
fn cost_of_cutting(words: &[u32]) -> u64 {
    8 * words.len() as u64
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
    /// Builds a cell near the root: its children in parallel.
    fn top_cell(&self, words: &[u32], place: Place, budget: u64) -> Result<Subtree, Cancelled> {
        self.exec.cancel.check()?;
        if self.is_leaf(words, place.level, budget) {
            self.advance(place.level);
            return Ok(Subtree::leaf(words, place.level));
        }
        let mut tree = Subtree::constant(false);
        if place.level >= PARALLEL_LEVELS {
            let mut simplifier = Simplifier::default();
            let mut stack = words.to_vec();
            let end = stack.len();
            tree.root = self.cell(&mut tree, &mut simplifier, &mut stack, 0..end, place, budget)?;
            tree.classified = simplifier.classified;
            return Ok(tree);
        }
        let simplified: Vec<(Simplified, Vec<u32>, u64)> = (0..8)
            .into_par_iter()
            .map(|octant| {
                let mut reduced = Vec::new();
                let mut simplifier = Simplifier::default();
                let cell = self.grown(place.child(octant));
                let simplified = simplifier.simplify(self.catalog, words, &cell, &mut reduced);
                (simplified, reduced, simplifier.classified)
            })
            .collect();
        let lengths: Vec<usize> = simplified.iter().map(|(_, reduced, _)| reduced.len()).collect();
        if !self.pays(words.len(), lengths.iter().copied()) {
            let mut tree = Subtree::leaf(words, place.level);
            tree.classified = simplified.iter().map(|(_, _, classified)| classified).sum();
            self.advance(place.level);
            return Ok(tree);
        }
        let left = budget - cost_of_cutting(words);
        let all: usize = lengths.iter().sum();
        let children: Vec<Result<Subtree, Cancelled>> = simplified
            .into_par_iter()
            .enumerate()
            .map(|(octant, (simplified, reduced, classified))| {
                let mut child = match simplified {
                    Simplified::Constant(inside) => {
                        self.advance(place.level + 1);
                        Subtree::constant(inside)
                    }
                    Simplified::Reduced => {
                        self.top_cell(&reduced, place.child(octant), share(left, reduced.len(), all))?
                    }
                };
                child.classified += classified;
                Ok(child)
            })
            .collect();
        let index = tree.branches.len();
        tree.branches.push([CellWord::OUTSIDE; 8]);
        for (octant, child) in children.into_iter().enumerate() {
            let word = tree.adopt(child?);
            tree.branches[index][octant] = word;
        }
        tree.root = tree.join(index);
        Ok(tree)
    }

    /// Builds a cell whose program is the range `program` of `stack`; leaves the stack as it was.
    fn cell(
        &self,
        tree: &mut Subtree,
        simplifier: &mut Simplifier,
        stack: &mut Vec<u32>,
        program: Range<usize>,
        place: Place,
        budget: u64,
    ) -> Result<CellWord, Cancelled> {
        let words = &stack[program.clone()];
        if self.is_leaf(words, place.level, budget) {
            tree.depth = tree.depth.max(place.level);
            self.advance(place.level);
            return Ok(tree.intern(words));
        }
        self.exec.cancel.check()?;
        let left = budget - cost_of_cutting(words);
        let bottom = stack.len();
        let mut reduced = Vec::new();
        let mut children = [CellWord::OUTSIDE; 8];
        let mut ranges: [Range<usize>; 8] = Default::default();
        for (octant, range) in ranges.iter_mut().enumerate() {
            reduced.clear();
            let cell = self.grown(place.child(octant));
            match simplifier.simplify(self.catalog, &stack[program.clone()], &cell, &mut reduced) {
                Simplified::Constant(inside) => {
                    children[octant] = if inside { CellWord::INSIDE } else { CellWord::OUTSIDE };
                }
                Simplified::Reduced => {
                    *range = stack.len()..stack.len() + reduced.len();
                    stack.extend_from_slice(&reduced);
                }
            }
        }
        if !self.pays(program.len(), ranges.iter().map(Range::len)) {
            stack.truncate(bottom);
            tree.depth = tree.depth.max(place.level);
            self.advance(place.level);
            return Ok(tree.intern(&stack[program]));
        }
        let all = stack.len() - bottom;
        let index = tree.branches.len();
        tree.branches.push(children);
        for (octant, range) in ranges.into_iter().enumerate() {
            if range.is_empty() {
                self.advance(place.level + 1);
                continue;
            }
            let budget = share(left, range.len(), all);
            let word = self.cell(tree, simplifier, stack, range, place.child(octant), budget)?;
            tree.branches[index][octant] = word;
        }
        stack.truncate(bottom);
        if place.level == PROGRESS_LEVEL {
            self.exec.progress.advance(1);
        }
        Ok(tree.join(index))
    }

    /// The cell's box with its margin.
    fn grown(&self, place: Place) -> CellBox {
        self.octree.grown(place.center, place.half)
    }

    /// Counts a finished cell that is not cut: as many steps as it has cells of the progress level.
    fn advance(&self, level: u32) {
        if level <= PROGRESS_LEVEL {
            self.exec.progress.advance(1 << (3 * (PROGRESS_LEVEL - level)));
        }
    }

    fn is_leaf(&self, words: &[u32], level: u32, budget: u64) -> bool {
        level >= self.depth || cost_of_cutting(words) > budget || self.surfaces_at_most(words)
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
    fn surfaces_at_most(&self, words: &[u32]) -> bool {
        let mut seen = [0; BuildOptions::MAX_LEAF_SURFACES];
        let mut count = 0;
        for &word in words {
            if let Word::Literal { index, .. } = Word::decode(word) {
                let surface = self.catalog.literals[index as usize].surface;
                if !seen[..count].contains(&surface) {
                    if count == self.leaf_surfaces.min(seen.len()) {
                        return false;
                    }
                    seen[count] = surface;
                    count += 1;
                }
            }
        }
        true
    }
}
