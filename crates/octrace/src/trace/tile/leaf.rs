//! Leaves: their programs are pruned for the parts of a tile's beam and cut in depth, then evaluated.

use super::bundles::LEAST_PRUNED;
use super::kernels::{Cube, GiveUp, OneByOne, Several, Single, bits_of};
use super::lanes::Isa;
use super::layout::{bundles_of, packets_of};
use super::mesh::Toggled;
use super::packet::Origins;
use super::parts::Parts;
use super::program::{Kinds, is_short};
use super::prune::Pruned;
use super::walk::Walk;
use crate::geom::Vec3;

/// Programs are pruned where there would be so many words to evaluate at least, for all packets together; for fewer it takes
/// longer than it saves.
const PRUNED_FROM: u32 = 100;

/// Those for streams are pruned from so many on.
const STREAM_PRUNED_FROM: u32 = 60;

/// A slab is cut in two so many times at most.
pub(super) const MAX_CUTS: usize = 4;

/// What lies between two depths of a leaf, for some parts of the beam.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    words: Pruned,
    near: f64,
    far: f64,
    parts: u8,
    cuts: usize,
}

/// Slabs that wait for their turn.
pub(super) type Slabs = [Slab; MAX_CUTS + 1];

impl Slab {
    pub const NOTHING: Self = Self { words: Pruned::NOTHING, near: 0.0, far: 0.0, parts: 0, cuts: 0 };
}

impl<I: Isa, O: Origins<I>> Walk<'_, '_, I, O> {
    /// A leaf, for those packets.
    ///
    /// What the beam's parts see of it is pruned; where more than one surface is left, the parts are cut in depth, and the
    /// nearer half goes first.
    #[inline(always)]
    pub(super) fn leaf(&mut self, words: &[u32], packets: u32, center: Vec3, half: f64) {
        if !is_short(words) {
            self.give_up_in(packets, Cube { center, half }, (0.0, f64::INFINITY));
            return;
        }
        let cube = Cube { center, half };
        if packets.count_ones() * (words.len() as u32) < PRUNED_FROM {
            self.evaluate(words, packets, cube, (0.0, f64::INFINITY));
            return;
        }
        let (margin, offset) = (self.scenery.octree.margin, self.scenery.offset);
        let (near, far) = self.beam.depths(center + offset, half + margin);
        self.slabs[0] = Slab { words: Pruned::new(words), near, far, parts: u8::MAX, cuts: 0 };
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let Slab { words, near, far, parts, cuts } = self.slabs[count];
            let parts = parts & bundles_of(packets & self.open);
            if parts == 0 {
                continue;
            }
            let region = Parts::<I, _>::of_beam(self.beam, (near, far), margin, offset);
            self.known.learn(self.scenery.catalog, words.words(), &region);
            let (always, never) = self.known.decided();
            let (settled, leaked) = if self.scenery.wanted { (never, always) } else { (always, never) };
            if leaked & !settled & parts != 0 {
                self.give_up_in(packets & packets_of(leaked & parts), cube, (near, far));
            }
            let undecided = parts & !(settled | leaked);
            let can_be_cut = cuts < MAX_CUTS && self.beam.is_deep(near, far);
            let crowded = if can_be_cut { self.known.crowded(words.words(), undecided) } else { 0 };
            self.evaluate_pruned(words.words(), undecided & !crowded, packets, cube, (near, far));
            if crowded != 0 {
                let words = self.known.pruned(words.words(), crowded);
                let middle = 0.5 * (near + far);
                self.slabs[count] = Slab { words, near: middle, far, parts: crowded, cuts: cuts + 1 };
                self.slabs[count + 1] = Slab { words, near, far: middle, parts: crowded, cuts: cuts + 1 };
                count += 2;
            }
        }
    }

    /// A leaf, for those packets of a stream. What bundles see of it is pruned, if they are not too wide for it.
    #[inline(always)]
    pub(super) fn leaf_of_stream(&mut self, words: &[u32], packets: u32, cube: Cube, signs: usize) {
        let everywhere = (0.0, f64::INFINITY);
        if !is_short(words) {
            self.give_up_in(packets, cube, everywhere);
            return;
        }
        let narrow = match packets.count_ones() * (words.len() as u32) {
            0..STREAM_PRUNED_FROM => 0,
            _ => {
                self.bundles.know::<I>(self.packets, signs);
                packets_of(self.bundles.narrow::<I>(LEAST_PRUNED, cube.half))
            }
        };
        if packets & !narrow != 0 {
            self.evaluate(words, packets & !narrow, cube, everywhere);
        }
        let packets = packets & narrow;
        if packets == 0 {
            return;
        }
        let (margin, offset) = (self.scenery.octree.margin, self.scenery.offset);
        let passage = self.bundles.passage::<I>(signs, cube, offset);
        let here = passage.bundles & bundles_of(packets);
        self.known.learn(self.scenery.catalog, words, &self.bundles.parts(&passage, margin, offset));
        let (always, never) = self.known.decided();
        let (settled, leaked) = if self.scenery.wanted { (never, always) } else { (always, never) };
        if leaked & !settled & here != 0 {
            self.give_up_in(packets & packets_of(leaked & here), cube, everywhere);
        }
        self.evaluate_pruned(words, here & !(settled | leaked), packets, cube, everywhere);
    }

    /// Evaluates what is left of a leaf's program in some parts.
    #[inline(always)]
    fn evaluate_pruned(&mut self, words: &[u32], parts: u8, packets: u32, cube: Cube, depths: (f64, f64)) {
        let mut left = parts;
        while left != 0 {
            let alike = self.known.alike(words, left);
            let pruned = self.known.pruned(words, left & left.wrapping_neg());
            self.evaluate(pruned.words(), packets & packets_of(alike), cube, depths);
            left &= !alike;
        }
    }

    /// Evaluates a leaf's program for those packets.
    pub(super) fn evaluate(&mut self, words: &[u32], packets: u32, cube: Cube, depths: (f64, f64)) {
        match (self.scenery.kinds_of(words), words) {
            (Kinds::Plain, &[word]) => I::call(Single { walk: self, word, packets, cube, depths }),
            (Kinds::Plain, _) => I::call(Several { walk: self, words, packets, cube, depths }),
            (Kinds::Toggled, _) => I::call(Toggled { walk: self, words, packets, cube, depths }),
            (Kinds::Other, _) => I::call(OneByOne { walk: self, words, packets, cube, depths }),
        }
        self.close(packets);
    }

    /// Takes note of which of those packets have no open rays any more.
    pub(super) fn close(&mut self, packets: u32) {
        for number in bits_of(packets) {
            self.open &= !(u32::from(self.packets[number].open == 0) << number);
        }
    }

    /// Leaves to scalar code the open rays of those packets that come through a cell.
    #[inline(always)]
    pub(super) fn give_up_in(&mut self, packets: u32, cube: Cube, depths: (f64, f64)) {
        I::call(GiveUp { walk: self, packets, cube, depths });
        self.close(packets);
    }
}
