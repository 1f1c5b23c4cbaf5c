//! Simplifying a program in one box: [`Splitter`] for those who ask box by box.

use super::{Boxes, Catalog, Constant, Entry, Splitter, Word};
use crate::surface::{CellBox, Octants, Placed, Surface};
use std::ops::Range;

/// What is left of a program in a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Simplified {
    /// The box is all inside (`true`) or all outside.
    Constant(bool),
    /// The reduced program was appended.
    Reduced,
}

/// Simplifies programs, those of copies too where nothing else is left; keeps its scratch memory between calls.
#[derive(Debug, Default)]
pub struct Simplifier {
    splitter: Splitter,
    stack: Vec<Entry>,
}

impl Simplifier {
    /// Simplifies `words` in the box `cell`, whose margin is the caller's business, and appends what is left to `out`,
    /// which may not alias `words`.
    pub fn simplify(&mut self, catalog: &Catalog, words: &[u32], cell: &CellBox, out: &mut Vec<u32>) -> Simplified {
        self.stack.clear();
        self.stack.extend(words.iter().map(|&word| Entry::new(catalog, word)));
        let boxes = Boxes { octants: Octants::all(cell), items: None };
        let mut split = self.splitter.split(catalog, &mut self.stack, 0..words.len(), &boxes, 1);
        if let (None, Some(placed)) = (split.constant(0), self.only_copy(catalog, &split.ranges[0])) {
            let prototype = catalog.prototype(placed);
            if let Constant::Words(words) = &prototype.program.whole {
                let shift = prototype.literal_shift(placed.copy);
                self.stack.clear();
                self.stack.extend(words.iter().map(|&word| Entry::new(catalog, Word::shifted(word, shift))));
                split = self.splitter.split(catalog, &mut self.stack, 0..words.len(), &boxes, 1);
            }
        }
        match split.constant(0) {
            Some(inside) => Simplified::Constant(inside),
            None => {
                out.extend(self.stack[split.ranges[0].clone()].iter().map(|entry| entry.word));
                Simplified::Reduced
            }
        }
    }

    /// The copy of a solid that a program is.
    fn only_copy<'a>(&self, catalog: &'a Catalog, program: &Range<usize>) -> Option<&'a Placed> {
        let [entry] = self.stack.get(program.clone())? else { return None };
        match catalog.surfaces.get(entry.surface as usize)? {
            Surface::Placed(placed) => Some(placed),
            _ => None,
        }
    }
}
