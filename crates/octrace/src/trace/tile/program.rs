//! Programs along eight rays: what [`Roots`](super::super::roots::Roots) does for one.
//!
//! Functions for programs of one, two and three levels, one made of the other: recursion could not be compiled for wide
//! registers as a whole. Deeper programs are for scalar code.

use super::crossing::{Crossed, Rays, plane, quadric};
use super::lanes::{F64s, LANES, Mask};
use crate::compile::{Catalog, Word, node_end};
use crate::surface::Surface;

/// The most operators above a literal.
const MAX_LEVELS: usize = 3;
/// The most words.
const MAX_WORDS: usize = 48;

/// Whether a program can be evaluated here.
pub(super) fn is_plain(catalog: &Catalog, words: &[u32]) -> bool {
    words.len() <= MAX_WORDS
        && levels_at_most(words, MAX_LEVELS)
        && words.iter().all(|&word| is_plain_word(catalog, word))
}

fn is_plain_word(catalog: &Catalog, word: u32) -> bool {
    match Word::decode(word) {
        Word::Literal { index, .. } => {
            let surface = catalog.literals[index as usize].surface;
            matches!(catalog.surfaces[surface as usize], Surface::Plane(_) | Surface::Quadric(_))
        }
        Word::And { .. } | Word::Or { .. } => true,
    }
}

fn levels_at_most(words: &[u32], most: usize) -> bool {
    let mut ends = [0; MAX_LEVELS];
    let mut open = 0;
    for (at, &word) in words.iter().enumerate() {
        while open > 0 && ends[open - 1] <= at {
            open -= 1;
        }
        if let Word::And { len } | Word::Or { len } = Word::decode(word) {
            if open == most {
                return false;
            }
            ends[open] = at + 1 + len as usize;
            open += 1;
        }
    }
    true
}

/// How a program's value changes at eight parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Changes {
    pub before: Mask,
    pub after: Mask,
    /// The word of the literal that is seen to change it, where it changes.
    pub words: [u64; LANES],
}

/// The crossings of eight rays with the literals of a program.
#[derive(Debug)]
pub(super) struct Solved<'a> {
    words: &'a [u32],
    rows: [Crossed; MAX_WORDS],
}

impl<'a> Solved<'a> {
    pub fn empty() -> Self {
        let nowhere = Crossed { starts_inside: Mask::NONE, a: F64s::INFINITY, b: F64s::INFINITY };
        Self { words: &[], rows: [nowhere; MAX_WORDS] }
    }

    /// Crosses the rays with every literal of a plain program.
    #[inline(always)]
    pub fn solve(&mut self, catalog: &Catalog, words: &'a [u32], rays: &Rays) {
        self.words = words;
        for (row, &word) in self.rows.iter_mut().zip(words) {
            if let Word::Literal { index, negated } = Word::decode(word) {
                let surface = catalog.literals[index as usize].surface;
                *row = match &catalog.surfaces[surface as usize] {
                    Surface::Plane(surface) => plane(surface, rays),
                    Surface::Quadric(surface) => quadric(surface, rays),
                    Surface::Torus(_) | Surface::Mesh(_) => *row,
                }
                .negated(negated);
            }
        }
    }

    /// The first parameters `>= t` from which on the program is inside (`wanted`) or outside.
    #[inline(always)]
    pub fn next(&self, t: F64s, wanted: bool) -> F64s {
        self.next_3(0, t, wanted)
    }

    /// How the program's value changes at `t`; see [`Roots::change`](super::super::roots::Roots::change).
    #[inline(always)]
    pub fn changes(&self, t: F64s) -> Changes {
        self.changes_3(0, t)
    }

    #[inline(always)]
    fn next_0(&self, at: usize, t: F64s, wanted: bool) -> F64s {
        self.rows[at].next(t, wanted)
    }

    #[inline(always)]
    fn changes_0(&self, at: usize, t: F64s) -> Changes {
        let row = &self.rows[at];
        Changes { before: row.before(t), after: row.after(t), words: [u64::from(self.words[at]); LANES] }
    }
}

/// Functions for programs of one level more than those that they are made of.
macro_rules! level {
    ($next:ident, $changes:ident, $next_below:ident, $changes_below:ident) => {
        impl Solved<'_> {
            #[inline(always)]
            fn $next(&self, at: usize, t: F64s, wanted: bool) -> F64s {
                let is_and = match Word::decode(self.words[at]) {
                    Word::Literal { .. } => return self.next_0(at, t, wanted),
                    Word::And { .. } => true,
                    Word::Or { .. } => false,
                };
                let end = node_end(self.words, at);
                let mut child = at + 1;
                if is_and != wanted {
                    // One child is enough.
                    let mut least = F64s::INFINITY;
                    while child < end {
                        least = least.min(self.$next_below(child, t, wanted));
                        child = node_end(self.words, child);
                    }
                    return least;
                }
                // All children must agree.
                let mut t = t;
                loop {
                    let start = t;
                    child = at + 1;
                    while child < end {
                        t = self.$next_below(child, t, wanted);
                        child = node_end(self.words, child);
                    }
                    if t.eq(start).all() {
                        return t;
                    }
                }
            }

            #[inline(always)]
            fn $changes(&self, at: usize, t: F64s) -> Changes {
                let is_and = match Word::decode(self.words[at]) {
                    Word::Literal { .. } => return self.changes_0(at, t),
                    Word::And { .. } => true,
                    Word::Or { .. } => false,
                };
                let end = node_end(self.words, at);
                let (mut before, mut after) = (Mask::splat(is_and), Mask::splat(is_and));
                // The first children that change in either direction.
                let (mut first_in, mut first_out) = ([0; LANES], [0; LANES]);
                let (mut no_in, mut no_out) = (Mask::splat(true), Mask::splat(true));
                let mut child = at + 1;
                while child < end {
                    let change = self.$changes_below(child, t);
                    let (enters, leaves) = (!change.before & change.after, change.before & !change.after);
                    first_in = (no_in & enters).select_words(change.words, first_in);
                    first_out = (no_out & leaves).select_words(change.words, first_out);
                    (no_in, no_out) = (no_in & !enters, no_out & !leaves);
                    (before, after) = match is_and {
                        true => (before & change.before, after & change.after),
                        false => (before | change.before, after | change.after),
                    };
                    child = node_end(self.words, child);
                }
                Changes { before, after, words: after.select_words(first_in, first_out) }
            }
        }
    };
}

level!(next_1, changes_1, next_0, changes_0);
level!(next_2, changes_2, next_1, changes_1);
level!(next_3, changes_3, next_2, changes_2);
