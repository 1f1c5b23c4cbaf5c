//! Programs along eight rays: what [`Roots`](super::super::roots::Roots) does for one.
//!
//! Functions for programs of one, two and three levels, one made of the other: recursion could not be compiled for wide
//! registers as a whole. Deeper programs are for scalar code.

use super::PACKETS;
use super::crossing::{Crossed, Rays, crossed_by, plane, quadric};
use super::lanes::{F64s, Isa, LANES, Mask, Number, Stored};
use super::packet::{Origins, Packet};
use crate::compile::{Catalog, Word, node_end};
use crate::geom::Vec3;
use crate::surface::Surface;

/// The most operators above a literal.
pub(super) const MAX_LEVELS: usize = 3;
/// The most words.
pub(super) const MAX_WORDS: usize = 48;

/// Whether a program has no more words and levels than can be evaluated here.
pub(super) fn is_short(words: &[u32]) -> bool {
    words.len() <= MAX_WORDS && levels_at_most(words, MAX_LEVELS)
}

/// What kinds of surfaces a program has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kinds {
    /// Planes and quadrics.
    Plain,
    /// Meshes and tori too: what a line may cross more than twice.
    Toggled,
    /// Others too, which lanes cannot cross.
    Other,
}

/// What kinds of surfaces a program has.
pub(super) fn kinds_of(catalog: &Catalog, words: &[u32]) -> Kinds {
    let kinds = words.iter().filter_map(|&word| surface_of(catalog, word)).map(|surface| match surface {
        Surface::Plane(_) | Surface::Quadric(_) => Kinds::Plain,
        Surface::Mesh(_) | Surface::Torus(_) => Kinds::Toggled,
        Surface::Placed(_) => Kinds::Other,
    });
    kinds.max().unwrap_or(Kinds::Plain)
}

/// The surface of a literal.
#[inline(always)]
pub(super) fn surface_of(catalog: &Catalog, word: u32) -> Option<&Surface> {
    match Word::decode(word) {
        Word::Literal { index, .. } => Some(&catalog.surfaces[catalog.literals[index as usize].surface as usize]),
        Word::And { .. } | Word::Or { .. } => None,
    }
}

fn levels_at_most(words: &[u32], most: usize) -> bool {
    if words.len() <= most {
        return true;
    }
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
pub(super) struct Changes<I: Isa> {
    pub before: Mask<I>,
    pub after: Mask<I>,
    /// The word of the literal that is seen to change it, where it changes.
    pub words: [u32; LANES],
}

/// The crossings of eight rays with one literal, which is plain.
#[inline(always)]
pub(super) fn crossed<I: Isa, N: Number<I>>(catalog: &Catalog, word: u32, rays: &Rays<I, N>) -> Crossed<I> {
    let negated = matches!(Word::decode(word), Word::Literal { negated: true, .. });
    // Not a closure: those may be compiled by themselves, for registers that are not wide.
    let crossed = match surface_of(catalog, word) {
        Some(surface) => crossed_by(surface, rays),
        None => Crossed::nowhere(),
    };
    crossed.negated(negated)
}

/// So many packets are solved for one program before it is looked at what follows.
pub(super) const CHUNK: usize = 8;

/// A [`Crossed`] in memory.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(64))]
struct Row {
    a: Stored,
    b: Stored,
    starts_inside: u8,
}

/// The crossings of a few packets with the literals of a program: one literal after another, since finding out what it is
/// takes as long as crossing eight rays with it.
#[derive(Debug)]
pub(super) struct Solved {
    rows: Box<[[Row; CHUNK]; MAX_WORDS]>,
}

/// The packets whose rays are crossed.
pub(super) struct Solving<'a> {
    pub packets: &'a [Packet; PACKETS],
    /// Which of them.
    pub numbers: &'a [u8],
    /// Where rays start that start at one point.
    pub eye: Vec3,
    /// Where the origin of the surfaces' coordinates is.
    pub offset: Vec3,
}

impl Solving<'_> {
    /// The rays of a packet. (Not a closure: it may be compiled by itself, for registers that are not wide.)
    #[inline(always)]
    fn rays<I: Isa, O: Origins<I>>(&self, slot: usize) -> Rays<I, O::Number> {
        self.packets[self.numbers[slot] as usize].rays::<I, O>(self.eye, self.offset)
    }
}

impl Default for Solved {
    fn default() -> Self {
        Self { rows: Box::new([[Row::default(); CHUNK]; MAX_WORDS]) }
    }
}

impl Solved {
    /// Crosses some packets' rays with every literal of a plain program.
    #[inline(always)]
    pub fn solve<I: Isa, O: Origins<I>>(&mut self, catalog: &Catalog, words: &[u32], packets: &Solving) {
        for (rows, &word) in self.rows.iter_mut().zip(words) {
            let negated = matches!(Word::decode(word), Word::Literal { negated: true, .. });
            let rows = &mut rows[..packets.numbers.len().min(CHUNK)];
            match surface_of(catalog, word) {
                Some(Surface::Plane(surface)) => {
                    for (slot, row) in rows.iter_mut().enumerate() {
                        *row = Row::new(plane(surface, &packets.rays::<I, O>(slot)).negated(negated));
                    }
                }
                Some(Surface::Quadric(surface)) => {
                    for (slot, row) in rows.iter_mut().enumerate() {
                        *row = Row::new(quadric(surface, &packets.rays::<I, O>(slot)).negated(negated));
                    }
                }
                Some(Surface::Torus(_) | Surface::Mesh(_) | Surface::Placed(_)) | None => {}
            }
        }
    }

    /// Sets the crossings of the first packet of a chunk with the literal at a place of the program.
    #[inline(always)]
    pub fn put<I: Isa>(&mut self, at: usize, crossed: Crossed<I>) {
        self.rows[at][0] = Row::new(crossed);
    }

    /// A packet, by its place in the chunk, with that program.
    #[inline(always)]
    pub fn packet<'a>(&'a self, words: &'a [u32], slot: usize) -> SolvedPacket<'a> {
        SolvedPacket { rows: &self.rows, words, slot }
    }
}

impl Row {
    #[inline(always)]
    fn new<I: Isa>(crossed: Crossed<I>) -> Self {
        let Crossed { starts_inside, a, b } = crossed;
        Self { a: a.stored(), b: b.stored(), starts_inside: starts_inside.bits() }
    }

    #[inline(always)]
    fn crossed<I: Isa>(&self) -> Crossed<I> {
        let starts_inside = Mask::from_bits(self.starts_inside);
        Crossed { starts_inside, a: F64s::load(&self.a), b: F64s::load(&self.b) }
    }
}

/// The crossings of eight rays with the literals of a program.
#[derive(Clone, Copy)]
pub(super) struct SolvedPacket<'a> {
    rows: &'a [[Row; CHUNK]; MAX_WORDS],
    words: &'a [u32],
    slot: usize,
}

impl SolvedPacket<'_> {
    /// Parameters `>= t` before which the program is not inside (`wanted`), or outside; the very ones from which on it is,
    /// unless it is nowhere near that simple. If they are `t`, it is there.
    #[inline(always)]
    pub fn bound<I: Isa>(&self, t: F64s<I>, wanted: bool) -> F64s<I> {
        self.bound_3(0, t, wanted)
    }

    /// How the program's value changes at `t`; see [`Roots::change`](super::super::roots::Roots::change).
    #[inline(always)]
    pub fn changes<I: Isa>(&self, t: F64s<I>) -> Changes<I> {
        self.changes_3(0, t)
    }

    #[inline(always)]
    fn bound_0<I: Isa>(&self, at: usize, t: F64s<I>, wanted: bool) -> F64s<I> {
        self.rows[at][self.slot].crossed().next(t, wanted)
    }

    #[inline(always)]
    fn changes_0<I: Isa>(&self, at: usize, t: F64s<I>) -> Changes<I> {
        let row = self.rows[at][self.slot].crossed();
        Changes { before: row.before(t), after: row.after(t), words: [self.words[at]; LANES] }
    }
}

/// Functions for programs of one level more than those that they are made of.
macro_rules! level {
    ($bound:ident, $changes:ident, $bound_below:ident, $changes_below:ident) => {
        impl SolvedPacket<'_> {
            #[inline(always)]
            fn $bound<I: Isa>(&self, at: usize, t: F64s<I>, wanted: bool) -> F64s<I> {
                let is_and = match Word::decode(self.words[at]) {
                    Word::Literal { .. } => return self.bound_0(at, t, wanted),
                    Word::And { .. } => true,
                    Word::Or { .. } => false,
                };
                let end = node_end(self.words, at);
                // One child is enough, or all must agree: then the last one counts.
                let one = is_and != wanted;
                let mut bound = if one { F64s::infinity() } else { t };
                let mut child = at + 1;
                while child < end {
                    let next = self.$bound_below(child, t, wanted);
                    bound = if one { bound.min(next) } else { bound.max(next) };
                    child = node_end(self.words, child);
                }
                bound
            }

            #[inline(always)]
            fn $changes<I: Isa>(&self, at: usize, t: F64s<I>) -> Changes<I> {
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
                    let turns = change.before ^ change.after;
                    let (enters, leaves) = (turns & change.after, turns & change.before);
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

level!(bound_1, changes_1, bound_0, changes_0);
level!(bound_2, changes_2, bound_1, changes_1);
level!(bound_3, changes_3, bound_2, changes_2);
