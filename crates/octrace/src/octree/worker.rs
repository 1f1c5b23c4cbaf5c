//! Building one subtree, cell after cell.

use super::build::{BuildOptions, Builder, PROGRESS_LEVEL, cost_of_cutting, share};
use super::subtree::Subtree;
use super::{CellWord, Octree};
use crate::compile::{Boxes, Entry, LatticeCell, Split, Splitter};
use crate::exec::Cancelled;
use crate::geom::Vec3;
use crate::surface::Octants;
use std::ops::Range;

/// Where a cell is.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub center: Vec3,
    pub half: f64,
    pub on_lattice: LatticeCell,
    pub level: u32,
}

impl Place {
    pub fn child(self, octant: usize) -> Self {
        let half = self.half / 2.0;
        Self {
            center: Octree::child_center(self.center, half, octant),
            half,
            on_lattice: self.on_lattice.child(octant),
            level: self.level + 1,
        }
    }
}

/// What is left of the program in a cell.
#[derive(Clone)]
pub(super) struct Reduced {
    /// Where it is on a stack.
    pub range: Range<usize>,
    /// How many words it has, those in items included.
    pub words: usize,
    pub with_items: bool,
}

impl Reduced {
    pub fn of(split: &Split, octant: usize) -> Self {
        let with_items = split.with_items >> octant & 1 == 1;
        Self { range: split.ranges[octant].clone(), words: split.words[octant], with_items }
    }
}

/// Builds a subtree, one cell after the other.
#[derive(Default)]
pub(super) struct Worker {
    pub tree: Subtree,
    pub splitter: Splitter,
    /// Programs of the cells on the way down, and of their children.
    pub stack: Vec<Entry>,
    /// Scratch memory for counting surfaces.
    seen: Vec<u32>,
}

impl Worker {
    /// A worker with programs on its stack.
    pub fn new(stack: Vec<Entry>) -> Self {
        Self { stack, ..Self::default() }
    }

    /// Builds a cell; leaves the stack as it was.
    pub fn cell(
        &mut self,
        builder: &Builder,
        mut reduced: Reduced,
        place: Place,
        budget: u64,
    ) -> Result<CellWord, Cancelled> {
        let bottom = self.stack.len();
        let Some(split) = self.cut(builder, &mut reduced, place, budget)? else {
            builder.advance(place.level);
            let leaf = self.tree.leaf(&self.stack[reduced.range], place.level);
            self.stack.truncate(bottom);
            return Ok(leaf);
        };
        let left = budget - cost_of_cutting(reduced.words);
        let all = split.words.iter().sum();
        let index = self.tree.branches.len();
        self.tree.branches.push([CellWord::OUTSIDE; 8]);
        for octant in 0..8 {
            let word = match split.constant(octant) {
                Some(inside) => {
                    builder.advance(place.level + 1);
                    if inside { CellWord::INSIDE } else { CellWord::OUTSIDE }
                }
                None => {
                    let budget = share(left, split.words[octant], all);
                    self.cell(builder, Reduced::of(&split, octant), place.child(octant), budget)?
                }
            };
            self.tree.branches[index][octant] = word;
        }
        self.stack.truncate(bottom);
        if place.level == PROGRESS_LEVEL {
            builder.exec.progress.advance(1);
        }
        Ok(self.tree.join(index))
    }

    /// The programs of a cell's children, on top of the stack. `None` where the cell is to be a leaf: `reduced` is then what
    /// it holds.
    pub fn cut(
        &mut self,
        builder: &Builder,
        reduced: &mut Reduced,
        place: Place,
        budget: u64,
    ) -> Result<Option<Split>, Cancelled> {
        if reduced.with_items {
            reduced.range = builder.items.open_for_cell(&mut self.stack, reduced.range.clone(), &place.on_lattice);
        }
        let is_mixed = self.is_mixed(builder, reduced.range.clone());
        let is_leaf = place.level >= builder.depth
            || cost_of_cutting(reduced.words) > budget
            || !is_mixed && self.surfaces_at_most(builder, reduced.range.clone());
        if !is_leaf {
            builder.exec.cancel.check()?;
            let boxes = Boxes {
                octants: Octants::new(place.center, place.half / 2.0, builder.margin),
                items: Some((builder.items, place.on_lattice)),
            };
            let top = self.stack.len();
            let split = self.splitter.split(builder.catalog, &mut self.stack, reduced.range.clone(), &boxes, u8::MAX);
            if is_mixed || builder.pays(reduced.words, split.words) {
                return Ok(Some(split));
            }
            self.stack.truncate(top);
        }
        if reduced.with_items {
            reduced.range = builder.items.open_all(&mut self.stack, reduced.range.clone());
        }
        Ok(None)
    }

    /// Whether a whole solid is but a part of a program. Cells are cut until it is all that there is.
    fn is_mixed(&self, builder: &Builder, program: Range<usize>) -> bool {
        if builder.catalog.prototypes.is_empty() || program.len() == 1 {
            return false;
        }
        let mut entries = self.stack[program].iter().flat_map(|item| builder.items.meaning(item));
        entries.any(|entry| builder.catalog.placed_by(entry.word).is_some())
    }

    /// Whether a program has no more different surfaces than a leaf may.
    fn surfaces_at_most(&mut self, builder: &Builder, program: Range<usize>) -> bool {
        let most = builder.leaf_surfaces.min(BuildOptions::MAX_LEAF_SURFACES);
        self.seen.clear();
        for item in &self.stack[program] {
            for entry in builder.items.meaning(item).iter().filter(|entry| entry.is_literal()) {
                if !self.seen.contains(&entry.surface) {
                    if self.seen.len() == most {
                        return false;
                    }
                    self.seen.push(entry.surface);
                }
            }
        }
        true
    }
}
