//! Simplifying a program in a box [Wyvill-Kunii-Shirai 1986; Comba-Persiano, §3].
//!
//! A surface that misses the box, or has all of it inside, is a constant there; boolean algebra does the rest:
//! `A ∪ 0 = A`, `A ∩ 0 = 0`, `A ∩ 1 = A` and so on. A surface that has already been decided on the way
//! down (one of the latest, lest long lists are searched again and again) counts as a constant for what comes later: `P ∩ (¬P ∪ Q) = P ∩ Q`. Only *later* nodes may profit: the visible one
//! of several surfaces crossed at once is the first in source order (see `trace::combine`), and so it stays the same.

use super::{Catalog, Word, nesting, node_end};
use crate::exec::with_stack_for;
use crate::surface::{CellBox, Side};

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
    /// Surfaces decided by the nodes above: what their literals are, for whatever comes later.
    known: Vec<(u32, bool)>,
    /// How many surfaces were classified against boxes.
    pub classified: u64,
}

/// Of the known surfaces, so many are looked at.
const LATEST: usize = 64;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Node {
    False,
    True,
    Kept,
}

impl Simplifier {
    /// Simplifies `words` in the box `cell`, whose margin is the caller's business, and appends what is left to `out`,
    /// which may not alias `words`.
    pub fn simplify(&mut self, catalog: &Catalog, words: &[u32], cell: &CellBox, out: &mut Vec<u32>) -> Simplified {
        self.known.clear();
        // Every level takes two words at least.
        let levels = if words.len() <= 128 { 0 } else { nesting(words) };
        let mut run = Run { catalog, cell, words, out, simplifier: self };
        match with_stack_for(levels, || run.node(0)) {
            Node::False => Simplified::Constant(false),
            Node::True => Simplified::Constant(true),
            Node::Kept => Simplified::Reduced,
        }
    }
}

struct Run<'a> {
    catalog: &'a Catalog,
    cell: &'a CellBox,
    words: &'a [u32],
    out: &'a mut Vec<u32>,
    simplifier: &'a mut Simplifier,
}

impl Run<'_> {
    fn node(&mut self, at: usize) -> Node {
        match Word::decode(self.words[at]) {
            Word::Literal { index, negated } => self.literal(index, negated, self.words[at]),
            Word::And { len } => self.operator(at, len as usize, true),
            Word::Or { len } => self.operator(at, len as usize, false),
        }
    }

    fn literal(&mut self, index: u32, negated: bool, word: u32) -> Node {
        let surface = self.catalog.literals[index as usize].surface;
        let constant = |inside: bool| if inside != negated { Node::True } else { Node::False };
        let mut known = self.simplifier.known.iter().rev().take(LATEST);
        if let Some(&(_, inside)) = known.find(|&&(known, _)| known == surface) {
            return constant(inside);
        }
        self.simplifier.classified += 1;
        match self.catalog.surfaces[surface as usize].classify(self.cell) {
            Side::Inside => constant(true),
            Side::Outside => constant(false),
            Side::Crossing => {
                self.out.push(word);
                Node::Kept
            }
        }
    }

    fn operator(&mut self, at: usize, len: usize, is_and: bool) -> Node {
        let (absorbing, neutral) = if is_and { (Node::False, Node::True) } else { (Node::True, Node::False) };
        let header = self.out.len();
        let known_before = self.simplifier.known.len();
        self.out.push(0);
        let mut kept = 0;
        let (mut child, end) = (at + 1, at + 1 + len);
        let mut result = Node::Kept;
        while child < end {
            let start = self.out.len();
            let node = self.node(child);
            if node == absorbing {
                self.out.truncate(header);
                result = absorbing;
                break;
            }
            if node == Node::Kept {
                kept += self.splice(start, is_and);
            }
            child = node_end(self.words, child);
        }
        self.simplifier.known.truncate(known_before);
        if result != Node::Kept {
            return result;
        }
        match kept {
            0 => {
                self.out.truncate(header);
                neutral
            }
            1 => {
                self.out.remove(header);
                Node::Kept
            }
            _ => {
                let len = (self.out.len() - header - 1) as u32;
                self.out[header] = if is_and { Word::And { len } } else { Word::Or { len } }.encode();
                Node::Kept
            }
        }
    }

    /// Makes the child just written at `start` part of its operator; returns how many children it is.
    fn splice(&mut self, start: usize, is_and: bool) -> usize {
        match (Word::decode(self.out[start]), is_and) {
            (Word::And { .. }, true) | (Word::Or { .. }, false) => {
                self.out.remove(start);
                // Its literals are siblings now.
                let mut at = start;
                while at < self.out.len() {
                    self.learn(self.out[at], is_and);
                    at = node_end(self.out, at);
                }
                2
            }
            _ => {
                self.learn(self.out[start], is_and);
                1
            }
        }
    }

    /// Notes what a kept literal is wherever its later siblings matter: true in an `And`, false in an `Or`.
    fn learn(&mut self, word: u32, is_and: bool) {
        if let Word::Literal { index, negated } = Word::decode(word) {
            let surface = self.catalog.literals[index as usize].surface;
            self.simplifier.known.push((surface, is_and != negated));
        }
    }
}
