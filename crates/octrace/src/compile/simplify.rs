//! Simplifying a program in one box: [`Splitter`] for those who ask box by box.

use super::{Boxes, Catalog, Entry, Splitter};
use crate::surface::{CellBox, Octants};

/// What is left of a program in a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Simplified {
    /// The box is all inside (`true`) or all outside.
    Constant(bool),
    /// The reduced program was appended.
    Reduced,
}

/// Simplifies programs; keeps its scratch memory between calls.
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
        let split = self.splitter.split(catalog, &mut self.stack, 0..words.len(), &boxes, 1);
        match split.constant(0) {
            Some(inside) => Simplified::Constant(inside),
            None => {
                out.extend(self.stack[split.ranges[0].clone()].iter().map(|entry| entry.word));
                Simplified::Reduced
            }
        }
    }
}
