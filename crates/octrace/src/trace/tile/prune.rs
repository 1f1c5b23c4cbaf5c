//! What is left of a leaf's program for a tile's rays.
//!
//! Of a cell that is larger than a tile, the tile's rays see a sliver. Surfaces are classified against eight parts of it at
//! once ([`super::parts`]), and boolean algebra does the rest. No literal takes the place of another, so what is seen where
//! several are crossed at once stays the same.

use super::lanes::{Isa, LANES};
use super::parts::{Across, Parts};
use super::program::{MAX_LEVELS, MAX_WORDS, surface_of};
use crate::compile::{Catalog, Word, node_end};
use crate::surface::Surface;

/// What a program is in eight parts of space: for each of its nodes a bit for each part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    /// Where the node is true.
    always: [u8; MAX_WORDS],
    /// Where it is false.
    never: [u8; MAX_WORDS],
}

impl Known {
    pub fn nothing() -> Self {
        Self { always: [0; MAX_WORDS], never: [0; MAX_WORDS] }
    }

    /// Finds out about a program of at most [`MAX_WORDS`] words.
    #[inline(always)]
    pub fn learn<I: Isa, A: Across<I>>(&mut self, catalog: &Catalog, words: &[u32], parts: &Parts<I, A>) {
        // Children come behind their operators.
        for at in (0..words.len().min(MAX_WORDS)).rev() {
            let (always, never) = match Word::decode(words[at]) {
                Word::Literal { negated, .. } => {
                    let (inside, outside) = match surface_of(catalog, words[at]) {
                        Some(Surface::Plane(plane)) => parts.plane(plane),
                        Some(Surface::Quadric(quadric)) => parts.quadric(quadric),
                        Some(Surface::Torus(torus)) => parts.torus(torus),
                        Some(Surface::Mesh(_) | Surface::Placed(_)) | None => (0, 0),
                    };
                    if negated { (outside, inside) } else { (inside, outside) }
                }
                operator => {
                    let is_and = matches!(operator, Word::And { .. });
                    let (mut all, mut any) = (u8::MAX, 0);
                    let mut child = at + 1;
                    while child < node_end(words, at) {
                        let (agreeing, absorbing) = match is_and {
                            true => (self.always[child], self.never[child]),
                            false => (self.never[child], self.always[child]),
                        };
                        (all, any) = (all & agreeing, any | absorbing);
                        child = node_end(words, child);
                    }
                    if is_and { (all, any) } else { (any, all) }
                }
            };
            (self.always[at], self.never[at]) = (always, never);
        }
    }

    /// Where the whole program is true, and where it is false.
    #[inline(always)]
    pub fn decided(&self) -> (u8, u8) {
        (self.always[0], self.never[0])
    }

    /// Those of `among` where all of the program is as in the lowest of them.
    #[inline(always)]
    pub fn alike(&self, words: &[u32], among: u8) -> u8 {
        let first = among & among.wrapping_neg();
        let same = |bits: u8| if bits & first == 0 { !bits } else { bits };
        let mut alike = among;
        for at in 0..words.len() {
            alike &= same(self.always[at]) & same(self.never[at]);
        }
        alike
    }

    /// Those of `among` where more than one literal matters.
    #[inline(always)]
    pub fn crowded(&self, words: &[u32], among: u8) -> u8 {
        let (mut one, mut more) = (0, 0);
        for (at, &word) in words.iter().enumerate() {
            if matches!(Word::decode(word), Word::Literal { .. }) {
                let matters = !(self.always[at] | self.never[at]);
                more |= one & matters;
                one |= matters;
            }
        }
        more & among
    }

    /// What is left of the program in some parts.
    pub fn pruned(&self, words: &[u32], parts: u8) -> Pruned {
        let mut left = Pruned::NOTHING;
        let mut at = 0;
        // Operators that are open: their header's place, how many children they have so far, and their end.
        let mut open: [(usize, usize, usize); MAX_LEVELS] = [(0, 0, usize::MAX); MAX_LEVELS];
        let mut levels = 0;
        loop {
            while levels > 0 && at >= open[levels - 1].2 {
                levels -= 1;
                let (header, children, _) = open[levels];
                left.close(header, children);
            }
            if at >= words.len() {
                return left;
            }
            if self.always[at] & parts == parts || self.never[at] & parts == parts {
                at = node_end(words, at);
                continue;
            }
            if levels > 0 {
                open[levels - 1].1 += 1;
            }
            if !matches!(Word::decode(words[at]), Word::Literal { .. }) {
                open[levels] = (left.len, 0, node_end(words, at));
                levels += 1;
            }
            left.words[left.len] = words[at];
            left.len += 1;
            at += 1;
        }
    }
}

/// A pruned program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pruned {
    words: [u32; MAX_WORDS],
    len: usize,
}

impl Pruned {
    pub const NOTHING: Self = Self { words: [0; MAX_WORDS], len: 0 };

    /// The program as it is.
    pub fn new(words: &[u32]) -> Self {
        let mut pruned = Self { len: words.len(), ..Self::NOTHING };
        pruned.words[..words.len()].copy_from_slice(words);
        pruned
    }

    pub fn words(&self) -> &[u32] {
        &self.words[..self.len]
    }

    /// All children of the operator at `header` are there: so many.
    fn close(&mut self, header: usize, children: usize) {
        if children == 1 {
            self.words.copy_within(header + 1..self.len, header);
            self.len -= 1;
            return;
        }
        let len = (self.len - header - 1) as u32;
        self.words[header] = match Word::decode(self.words[header]) {
            Word::And { .. } => Word::And { len },
            _ => Word::Or { len },
        }
        .encode();
    }
}

const _: () = assert!(LANES == u8::BITS as usize);
