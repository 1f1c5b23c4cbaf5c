//! Parts of a long program that stand for themselves while cells are large.
//!
//! An operand that is false outside a box (in an `Or`) or true outside a box (in an `And`: a complement) need not be looked
//! at, as long as cells are larger than it is, beyond that box: the operand is an *item*, one entry in place of many. Boxes
//! are those of the surfaces as they are stored, put together by the rules of the operators; they lie on a lattice of 2¹⁶
//! steps along each edge of the root cell, a little beyond what they hold. Where a cell has become small, or little is left
//! in it, items are opened: what they stand for takes their place.

use super::split::{Entry, node_end_of};
use super::{Catalog, Word};
use crate::geom::{Bounds, Vec3};
use crate::surface::halves;
use std::ops::Range;

/// Steps of the lattice along an edge of the root.
const STEPS: u32 = 1 << 16;

/// A box on the lattice, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct LatticeBox {
    low: [u16; 3],
    high: [u16; 3],
}

impl LatticeBox {
    /// What is no item has this box.
    const NONE: Self = Self { low: [1; 3], high: [0; 3] };

    fn union(self, o: Self) -> Self {
        let zip = |a: [u16; 3], b: [u16; 3], f: fn(u16, u16) -> u16| std::array::from_fn(|i| f(a[i], b[i]));
        match (self.is_empty(), o.is_empty()) {
            (true, _) => o,
            (_, true) => self,
            _ => Self { low: zip(self.low, o.low, u16::min), high: zip(self.high, o.high, u16::max) },
        }
    }

    fn intersection(self, o: Self) -> Self {
        let low = std::array::from_fn(|i| self.low[i].max(o.low[i]));
        Self { low, high: std::array::from_fn(|i| self.high[i].min(o.high[i])) }
    }

    fn is_empty(self) -> bool {
        (0..3).any(|i| self.low[i] > self.high[i])
    }

    /// Its longest edge, in steps. (Some boxes are slabs, which cells see all along: they are not worth being items.)
    fn longest(self) -> u32 {
        let edge = |i: usize| u32::from(self.high[i] - self.low[i]) + 1;
        edge(0).max(edge(1)).max(edge(2))
    }
}

/// Where the lattice is.
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    /// The root's corner with the smallest coordinates.
    pub corner: Vec3,
    /// The root's edge.
    pub edge: f64,
    /// By how much, in scene units, a box reaches beyond what it holds.
    pub margin: f64,
}

impl Lattice {
    fn around(&self, bounds: &Bounds) -> LatticeBox {
        // Beyond the root all is at its wall; conversion to integers saturates.
        let step = |v: f64| (v / self.edge * f64::from(STEPS)) as u16;
        let (low, high) = (bounds.min - self.corner, bounds.max - self.corner);
        LatticeBox {
            low: low.to_array().map(|v| step(v - self.margin)),
            high: high.to_array().map(|v| step(v + self.margin)),
        }
    }
}

/// A cell on the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LatticeCell {
    corner: [u32; 3],
    edge: u32,
}

impl LatticeCell {
    /// The root.
    pub const ROOT: Self = Self { corner: [0; 3], edge: STEPS };

    /// For boxes that are not octants of a cell: no item is left out.
    pub const WHOLE: Self = Self { corner: [0; 3], edge: 1 };

    /// One of its octants. A cell of one step is its own child.
    pub fn child(self, octant: usize) -> Self {
        let edge = self.edge / 2;
        let corner = std::array::from_fn(|i| self.corner[i] + if octant >> i & 1 == 1 { edge } else { 0 });
        if edge == 0 { self } else { Self { corner, edge } }
    }
}

/// A program whose operands may be items, and their boxes.
#[derive(Debug)]
pub struct Items {
    /// The program, without items.
    entries: Vec<Entry>,
    /// For every node of it the box outside which it is constant, if it may be an item.
    boxes: Vec<LatticeBox>,
}

impl Items {
    /// Shorter programs have none.
    const SHORT: usize = 256;
    /// Literals are items only among so many operands.
    const MANY: usize = 64;
    /// Programs of so many words are opened altogether.
    const FEW_WORDS: usize = 400;
    /// Of programs with fewer entries all items are opened, one level.
    const FEW_ENTRIES: usize = 16;

    /// Finds the items of a program.
    pub fn new(catalog: &Catalog, entries: Vec<Entry>, lattice: &Lattice) -> Self {
        let boxes = if entries.len() <= Self::SHORT { Vec::new() } else { boxes(catalog, &entries, lattice) };
        Self { entries, boxes }
    }

    /// The whole program, with items.
    pub fn program(&self) -> Vec<Entry> {
        let mut program = Vec::new();
        self.open(0, None, |_| true, &mut program);
        program
    }

    /// The boxes among the octants of a cell in which the item is constant, if the cell's octants can be told apart.
    #[inline(always)]
    pub(super) fn missed(&self, item: Entry, cell: &LatticeCell) -> u8 {
        let LatticeBox { low, high } = self.boxes[item.node()];
        if cell.edge < 2 {
            return 0;
        }
        let met = |axis: usize| {
            let middle = cell.corner[axis] + cell.edge / 2;
            halves(axis, [u32::from(low[axis]) < middle, u32::from(high[axis]) >= middle])
        };
        !(met(0) & met(1) & met(2))
    }

    /// How many words an entry stands for.
    #[inline]
    pub(super) fn words_of(&self, entry: Entry) -> usize {
        if entry.is_item() { node_end_of(&self.entries, entry.node()) - entry.node() } else { 1 }
    }

    /// What an entry stands for.
    pub fn meaning<'a>(&'a self, entry: &'a Entry) -> &'a [Entry] {
        match entry.is_item() {
            true => &self.entries[entry.node()..node_end_of(&self.entries, entry.node())],
            false => std::slice::from_ref(entry),
        }
    }

    /// Opens what need not stay closed in a cell: puts the program, if anything changes, on top of the stack.
    pub fn open_for_cell(&self, stack: &mut Vec<Entry>, program: Range<usize>, cell: &LatticeCell) -> Range<usize> {
        let words: usize = stack[program.clone()].iter().map(|&entry| self.words_of(entry)).sum();
        if words <= Self::FEW_WORDS {
            return self.open_all(stack, program);
        }
        let stays_closed = |node: usize| self.boxes[node].longest() < cell.edge;
        let mut program = self.open_where(stack, program, |node| !stays_closed(node), stays_closed);
        while program.len() < Self::FEW_ENTRIES && stack[program.clone()].iter().any(|entry| entry.is_item()) {
            program = self.open_where(stack, program, |_| true, stays_closed);
        }
        program
    }

    /// Opens all items, and all in them.
    pub fn open_all(&self, stack: &mut Vec<Entry>, program: Range<usize>) -> Range<usize> {
        self.open_where(stack, program, |_| true, |_| false)
    }

    /// Opens items that are to be opened; in them, those that do not stay closed.
    fn open_where(
        &self,
        stack: &mut Vec<Entry>,
        program: Range<usize>,
        is_opened: impl Fn(usize) -> bool,
        stays_closed: impl Fn(usize) -> bool,
    ) -> Range<usize> {
        if !stack[program.clone()].iter().any(|entry| entry.is_item() && is_opened(entry.node())) {
            return program;
        }
        let start = stack.len();
        // Operators written and not ended: whether it is an `And`, its place, and where it ends in the old program.
        let mut open: Vec<(bool, usize, usize)> = Vec::new();
        for at in program.clone() {
            end_operators(&mut open, at, stack);
            let entry = stack[at];
            if entry.is_item() && is_opened(entry.node()) {
                let above = open.last().map(|&(is_and, ..)| is_and);
                self.open(entry.node(), above, &stays_closed, stack);
                continue;
            }
            if let Some(is_and) = kind(entry) {
                open.push((is_and, stack.len(), node_end_of(stack, at)));
            }
            stack.push(entry);
        }
        end_operators(&mut open, program.end, stack);
        start..stack.len()
    }

    /// Writes a node below an operator of some kind, its operands as items where they are some and stay closed.
    fn open(&self, node: usize, above: Option<bool>, stays_closed: impl Fn(usize) -> bool, out: &mut Vec<Entry>) {
        let mut open: Vec<(bool, usize, usize)> = Vec::new();
        let end = node_end_of(&self.entries, node);
        let mut at = node;
        while at < end {
            end_operators(&mut open, at, out);
            let entry = self.entries[at];
            if at > node && self.is_item(at) && stays_closed(at) {
                // The operator above, wherever it was written: its operands are true outside their boxes in an `And`.
                let is_and = open.last().map_or(above == Some(true), |&(is_and, ..)| is_and);
                out.push(Entry::item(at, is_and));
                at = node_end_of(&self.entries, at);
                continue;
            }
            match kind(entry) {
                // An operator below its own kind adds its operands to it.
                Some(is_and) if at == node && above == Some(is_and) => {}
                Some(is_and) => {
                    open.push((is_and, out.len(), node_end_of(&self.entries, at)));
                    out.push(entry);
                }
                None => out.push(entry),
            }
            at += 1;
        }
        end_operators(&mut open, end, out);
    }

    fn is_item(&self, node: usize) -> bool {
        self.boxes.get(node).is_some_and(|&found| found != LatticeBox::NONE)
    }
}

/// Whether an operator is an `And`; `None` for a literal.
fn kind(entry: Entry) -> Option<bool> {
    match Word::decode(entry.word) {
        Word::Literal { .. } => None,
        Word::And { .. } => Some(true),
        Word::Or { .. } => Some(false),
    }
}

/// Sets the lengths of the operators that end at `at`.
fn end_operators(open: &mut Vec<(bool, usize, usize)>, at: usize, out: &mut [Entry]) {
    while let Some((is_and, header, _)) = open.pop_if(|&mut (_, _, end)| end <= at) {
        let len = (out.len() - header - 1) as u32;
        out[header].word = if is_and { Word::And { len } } else { Word::Or { len } }.encode();
    }
}

/// For every node the box outside which it is neutral to the operator above it, if it is worth being an item.
fn boxes(catalog: &Catalog, entries: &[Entry], lattice: &Lattice) -> Vec<LatticeBox> {
    // For every node where it may be true, and where it may be false.
    let mut places = vec![[LatticeBox::NONE; 2]; entries.len()];
    let mut boxes = vec![LatticeBox::NONE; entries.len()];
    for at in (0..entries.len()).rev() {
        let is_and = match Word::decode(entries[at].word) {
            Word::Literal { negated, .. } => {
                let (inside, outside) = catalog.surfaces[entries[at].surface as usize].extents();
                let (inside, outside) = (lattice.around(&inside), lattice.around(&outside));
                places[at] = if negated { [outside, inside] } else { [inside, outside] };
                continue;
            }
            Word::And { .. } => true,
            Word::Or { .. } => false,
        };
        let end = node_end_of(entries, at);
        let (mut narrow, mut wide): (Option<LatticeBox>, LatticeBox) = (None, LatticeBox::NONE);
        let mut operands = 0;
        let mut operand = at + 1;
        while operand < end {
            let [truth, falsehood] = places[operand];
            let (meet, join) = if is_and { (truth, falsehood) } else { (falsehood, truth) };
            narrow = Some(narrow.map_or(meet, |narrow| narrow.intersection(meet)));
            wide = wide.union(join);
            operands += 1;
            operand = node_end_of(entries, operand);
        }
        let narrow = narrow.unwrap_or(LatticeBox::NONE);
        places[at] = if is_and { [narrow, wide] } else { [wide, narrow] };
        let mut operand = at + 1;
        while operand < end {
            let own = places[operand][usize::from(is_and)];
            let is_literal = node_end_of(entries, operand) == operand + 1;
            if (operands >= Items::MANY || !is_literal) && !own.is_empty() && own.longest() < STEPS / 2 {
                boxes[operand] = own;
            }
            operand = node_end_of(entries, operand);
        }
    }
    boxes
}

#[cfg(test)]
mod tests {
    use super::super::{Constant, Copies, compile};
    use super::*;
    use crate::model::families::copies;

    #[test]
    fn a_program_with_items_is_short_and_opens_to_what_it_was() {
        let compiled = compile(&[copies(100)], 0.0, Copies::Apart);
        let body = &compiled.bodies[0];
        let Constant::Words(words) = &body.whole else { panic!("a program") };
        let entries: Vec<Entry> = words.iter().map(|&word| Entry::new(&compiled.catalog, word)).collect();
        let lattice = Lattice { corner: body.bounds.min, edge: body.bounds.size().max_abs(), margin: 1e-6 };
        let items = Items::new(&compiled.catalog, entries.clone(), &lattice);
        let mut stack = items.program();
        assert_eq!(stack.len(), 101, "one for each copy, and the operator");
        let closed = 0..stack.len();
        assert_eq!(closed.clone().map(|i| items.words_of(stack[i])).sum::<usize>(), words.len());
        let opened = items.open_all(&mut stack, closed.clone());
        assert_eq!(stack[opened], entries);
        // In the first octant there are no more than 6 by 6 copies.
        let first: usize =
            closed.filter(|&i| stack[i].is_item() && items.missed(stack[i], &LatticeCell::ROOT) & 1 == 0).count();
        assert!((25..=36).contains(&first), "{first}");
    }
}
