//! Building: every cell hands its children only what survived in it.

use super::{CellWord, Kind, Octree};
use crate::compile::{Catalog, Constant, Program, Simplified, Simplifier, Word, node_end, without_repeats};
use crate::exec::{Cancelled, Exec};
use crate::geom::Vec3;
use rayon::prelude::*;
use std::collections::HashMap;

/// When to stop cutting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildOptions {
    /// A cell with this many different surfaces or fewer is a leaf: the paper's *p*, which counts primitives (a block has six
    /// surfaces). More than [`MAX_LEAF_SURFACES`](Self::MAX_LEAF_SURFACES) count as that many.
    pub leaf_surfaces: usize,
    /// Levels below the root; `None` chooses by the number of surfaces.
    pub depth: Option<u32>,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self { leaf_surfaces: 6, depth: None }
    }
}

impl BuildOptions {
    /// The most surfaces that a leaf above the greatest depth can be allowed.
    pub const MAX_LEAF_SURFACES: usize = 64;
    /// The deepest octree that can be asked for; cells must stay large compared to their margin.
    pub const MAX_DEPTH: u32 = 20;

    fn depth_for(&self, literals: usize, max_depth: u32) -> u32 {
        let by_size = ((literals.max(1) as f64).log2() / 3.0).ceil() as u32 + 3;
        self.depth.unwrap_or(by_size).min(max_depth)
    }
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

    let literals = words.iter().filter(|&&w| matches!(Word::decode(w), Word::Literal { .. })).count();
    let depth = options.depth_for(literals, max_depth);
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
    let builder = Builder { catalog, octree: &octree, leaf_surfaces: options.leaf_surfaces, depth, exec };
    let mut simplifier = Simplifier::default();
    let mut reduced = Vec::new();
    let result =
        match simplifier.simplify(catalog, &without_repeats(catalog, words), &octree.grown(center, half), &mut reduced)
        {
            Simplified::Constant(inside) => Ok(Subtree::constant(inside)),
            Simplified::Reduced => builder.top_cell(&reduced, center, half, 0),
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

/// Progress is counted in cells of this level.
const PROGRESS_LEVEL: u32 = 3;
const PROGRESS_STEPS: u64 = 1 << (3 * PROGRESS_LEVEL);
/// Cells above this level are built in parallel, each child for itself.
const PARALLEL_LEVELS: u32 = 3;

/// A part of the tree with tables of its own.
struct Subtree {
    root: CellWord,
    branches: Vec<[CellWord; 8]>,
    programs: Vec<u32>,
    /// Offsets of the programs so far; equal ones are stored once.
    interned: HashMap<Box<[u32]>, u32>,
    depth: u32,
    classified: u64,
}

impl Subtree {
    fn constant(inside: bool) -> Self {
        Self {
            root: if inside { CellWord::INSIDE } else { CellWord::OUTSIDE },
            branches: Vec::new(),
            programs: Vec::new(),
            interned: HashMap::new(),
            depth: 0,
            classified: 0,
        }
    }

    /// The word for the branch just finished: if all its children are empty, or all full, it is what they are, and goes.
    fn join(&mut self, index: usize) -> CellWord {
        let children = self.branches[index];
        let uniform = children[0] == CellWord::OUTSIDE || children[0] == CellWord::INSIDE;
        if uniform && index + 1 == self.branches.len() && children.iter().all(|&child| child == children[0]) {
            self.branches.pop();
            return children[0];
        }
        CellWord::branch(index as u32)
    }

    fn intern(&mut self, program: &[u32]) -> CellWord {
        if let Some(&offset) = self.interned.get(program) {
            return CellWord::leaf(offset);
        }
        let offset = self.programs.len() as u32;
        self.programs.extend_from_slice(program);
        self.interned.insert(program.into(), offset);
        CellWord::leaf(offset)
    }

    /// Takes over another subtree's tables; returns its root as seen from here.
    fn adopt(&mut self, other: Subtree) -> CellWord {
        let first_branch = self.branches.len() as u32;
        let mut moved: HashMap<u32, CellWord> = HashMap::new();
        let mut relocate = |tree: &mut Self, word: CellWord| match word.kind() {
            Kind::Branch(index) => CellWord::branch(first_branch + index),
            Kind::Leaf(offset) => *moved.entry(offset).or_insert_with(|| {
                let start = offset as usize;
                tree.intern(&other.programs[start..node_end(&other.programs, start)])
            }),
            Kind::Outside | Kind::Inside => word,
        };
        for branch in &other.branches {
            let branch = branch.map(|word| relocate(self, word));
            self.branches.push(branch);
        }
        self.depth = self.depth.max(other.depth);
        self.classified += other.classified;
        relocate(self, other.root)
    }
}

struct Builder<'a> {
    catalog: &'a Catalog,
    /// Only for its geometry.
    octree: &'a Octree,
    leaf_surfaces: usize,
    depth: u32,
    exec: &'a Exec,
}

impl Builder<'_> {
    /// Builds a cell near the root: its children in parallel.
    fn top_cell(&self, words: &[u32], center: Vec3, half: f64, level: u32) -> Result<Subtree, Cancelled> {
        self.exec.cancel.check()?;
        let mut tree = Subtree::constant(false);
        if self.is_leaf(words, level) {
            tree.root = tree.intern(words);
            tree.depth = level;
            self.advance(level);
            return Ok(tree);
        }
        if level >= PARALLEL_LEVELS {
            let mut simplifier = Simplifier::default();
            let mut stack = words.to_vec();
            let end = stack.len();
            tree.root = self.cell(&mut tree, &mut simplifier, &mut stack, (0, end), center, half, level)?;
            tree.classified = simplifier.classified;
            return Ok(tree);
        }
        let child_half = half / 2.0;
        let children: Vec<Result<Subtree, Cancelled>> = (0..8)
            .into_par_iter()
            .map(|octant| {
                let child_center = Octree::child_center(center, child_half, octant);
                let mut reduced = Vec::new();
                let mut simplifier = Simplifier::default();
                let cell = self.octree.grown(child_center, child_half);
                let mut child = match simplifier.simplify(self.catalog, words, &cell, &mut reduced) {
                    Simplified::Constant(inside) => {
                        self.advance(level + 1);
                        Subtree::constant(inside)
                    }
                    Simplified::Reduced => self.top_cell(&reduced, child_center, child_half, level + 1)?,
                };
                child.classified += simplifier.classified;
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
    #[expect(clippy::too_many_arguments, reason = "the recursion's state, spelled out")]
    fn cell(
        &self,
        tree: &mut Subtree,
        simplifier: &mut Simplifier,
        stack: &mut Vec<u32>,
        program: (usize, usize),
        center: Vec3,
        half: f64,
        level: u32,
    ) -> Result<CellWord, Cancelled> {
        if self.is_leaf(&stack[program.0..program.1], level) {
            tree.depth = tree.depth.max(level);
            self.advance(level);
            return Ok(tree.intern(&stack[program.0..program.1]));
        }
        self.exec.cancel.check()?;
        let index = tree.branches.len();
        tree.branches.push([CellWord::OUTSIDE; 8]);
        let child_half = half / 2.0;
        let mut reduced = Vec::new();
        for octant in 0..8 {
            let child_center = Octree::child_center(center, child_half, octant);
            let cell = self.octree.grown(child_center, child_half);
            reduced.clear();
            let simplified = simplifier.simplify(self.catalog, &stack[program.0..program.1], &cell, &mut reduced);
            tree.branches[index][octant] = match simplified {
                Simplified::Constant(inside) => {
                    self.advance(level + 1);
                    if inside { CellWord::INSIDE } else { CellWord::OUTSIDE }
                }
                Simplified::Reduced => {
                    let start = stack.len();
                    stack.extend_from_slice(&reduced);
                    let range = (start, stack.len());
                    let word = self.cell(tree, simplifier, stack, range, child_center, child_half, level + 1)?;
                    stack.truncate(start);
                    word
                }
            };
        }
        if level == PROGRESS_LEVEL {
            self.exec.progress.advance(1);
        }
        Ok(tree.join(index))
    }

    /// Counts a finished cell that is not cut: as many steps as it has cells of the progress level.
    fn advance(&self, level: u32) {
        if level <= PROGRESS_LEVEL {
            self.exec.progress.advance(1 << (3 * (PROGRESS_LEVEL - level)));
        }
    }

    fn is_leaf(&self, words: &[u32], level: u32) -> bool {
        level >= self.depth || self.surfaces_at_most(words)
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
