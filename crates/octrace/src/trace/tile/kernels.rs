//! What eight rays do in a cell: where they come through it, and what they meet there.
//!
//! Each kind of leaf has a kernel, which is compiled as a function of its own and is told which packets to look at.

use super::crossing::Crossed;
use super::lanes::{F64s, Isa, Kernel, LANES, Mask, Number, Stored};
use super::packet::{Origins, Packet};
use super::program::{CHUNK, Solving, crossed};
use super::walk::{Scenery, Walk};
use crate::geom::Vec3;

/// A cube.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cube {
    pub center: Vec3,
    pub half: f64,
}

/// The stretches of eight rays in a cell.
#[derive(Clone, Copy)]
pub(super) struct Stretch<I: Isa> {
    pub t_in: F64s<I>,
    pub t_out: F64s<I>,
}

impl<I: Isa, O: Origins<I>> Walk<'_, '_, I, O> {
    /// Which open rays of a packet come through a cube between two depths, and their stretches there.
    #[inline(always)]
    pub(super) fn crossing(&self, number: usize, cube: Cube, (near, far): (f64, f64)) -> (Mask<I>, Stretch<I>) {
        let packet = &self.packets[number];
        let half = Vec3::splat(cube.half);
        let mut stretch = self.stretch(packet, (cube.center - half, cube.center + half));
        let per_depth = F64s::load(&packet.per_depth);
        // Where two slabs meet, both have the same number.
        stretch.t_in = stretch.t_in.max(F64s::splat(near) * per_depth);
        stretch.t_out = stretch.t_out.min(F64s::splat(far) * per_depth).min(F64s::load(&packet.t));
        (Mask::from_bits(packet.open) & stretch.t_in.le(stretch.t_out), stretch)
    }

    /// The rays' stretches of a box, given by its lowest and its highest corner.
    #[inline(always)]
    pub(super) fn stretch(&self, packet: &Packet, (low, high): (Vec3, Vec3)) -> Stretch<I> {
        let origin = O::of(packet, self.beam.eye, self.scenery.offset);
        let (mut t_in, mut t_out) = (F64s::zero(), F64s::infinity());
        for (origin, axis) in [(origin.x, 0), (origin.y, 1), (origin.z, 2)] {
            let inverse = F64s::<I>::load(&packet.inverse[axis]);
            let low = (O::Number::from_one(low[axis]) - origin).lanes() * inverse;
            let high = (O::Number::from_one(high[axis]) - origin).lanes() * inverse;
            let forward = inverse.gt(F64s::zero());
            // A ray in one of the planes has no number there, and no bound.
            t_in = t_in.max(forward.select(low, high));
            t_out = t_out.min(forward.select(high, low));
        }
        Stretch { t_in, t_out }
    }

    /// A stretch with a program of one literal, which is plain.
    #[inline(always)]
    pub(super) fn single(&mut self, word: u32, number: usize, here: Mask<I>, Stretch { t_in, t_out }: Stretch<I>) {
        let rays = self.packets[number].rays::<I, O>(self.beam.eye, self.scenery.offset);
        let crossed = crossed(self.scenery.catalog, word, &rays);
        self.single_crossed(word, crossed, number, here, Stretch { t_in, t_out });
    }

    /// A stretch with a program of one literal, which is crossed there.
    #[inline(always)]
    pub(super) fn single_crossed(
        &mut self,
        word: u32,
        crossed: Crossed<I>,
        number: usize,
        here: Mask<I>,
        Stretch { t_in, t_out }: Stretch<I>,
    ) {
        self.scratch.counters.surface_tests += u64::from(here.bits().count_ones());
        let wanted = self.scenery.wanted;
        let starts_wanted = crossed.starts_inside ^ Mask::splat(!wanted);
        // Two crossings at one place cancel each other.
        let (a, b) = (crossed.a, crossed.b);
        let two_sides = a.lt(b);
        let turn = starts_wanted.select(b, a);
        // Already there, and not since just now.
        let between = two_sides & a.lt(t_in) & t_in.lt(b) & !starts_wanted;
        let beyond = starts_wanted & !(two_sides & a.le(t_in) & t_in.le(b));
        let leaked = here & (between | beyond);
        let found = here & !leaked & two_sides & turn.ge(t_in) & turn.le(t_out) & turn.lt(F64s::infinity());
        self.packets[number].meet::<I>(found, turn, [word; LANES], &self.scenery);
        if leaked.any() {
            self.packets[number].leak(leaked, t_in);
        }
    }

    /// Stretches of some packets with a plain program.
    #[inline(always)]
    pub(super) fn program(&mut self, words: &[u32], chunk: &Chunk) {
        let Scenery { catalog, offset, .. } = self.scenery;
        let numbers = &chunk.numbers[..chunk.count];
        let solving = Solving { packets: self.packets, numbers, eye: self.beam.eye, offset };
        self.solved.solve::<I, O>(catalog, words, &solving);
        for slot in 0..chunk.count {
            let here = Mask::from_bits(chunk.here[slot]);
            let (t_in, t_out) = (F64s::load(&chunk.t_in[slot]), F64s::load(&chunk.t_out[slot]));
            self.solved_program(words, (slot, chunk.numbers[slot] as usize), here, Stretch { t_in, t_out });
        }
    }

    /// A packet's stretch with a program whose literals' crossings are known, in that slot.
    #[inline(always)]
    pub(super) fn solved_program(
        &mut self,
        words: &[u32],
        (slot, number): (usize, usize),
        here: Mask<I>,
        Stretch { t_in, t_out }: Stretch<I>,
    ) {
        let wanted = self.scenery.wanted;
        self.scratch.counters.surface_tests += words.len() as u64 * u64::from(here.bits().count_ones());
        let solved = self.solved.packet(words, slot);
        let packet = &mut self.packets[number];
        // Infinite for rays that are done.
        let mut t = here.select(t_in, F64s::infinity());
        loop {
            t = solved.bound::<I>(t, wanted);
            let pending = t.le(t_out) & t.lt(F64s::infinity());
            if !pending.any() {
                break;
            }
            let changes = solved.changes::<I>(t);
            let arrived = pending & (changes.after ^ Mask::splat(!wanted));
            let turned = changes.before ^ changes.after;
            packet.meet::<I>(arrived & turned, t, changes.words, &self.scenery);
            let leaked = arrived & !turned;
            if leaked.any() {
                packet.leak(leaked, t_in);
            }
            if arrived.bits() == pending.bits() {
                break;
            }
            t = arrived.select(F64s::infinity(), t);
        }
    }

    /// A stretch with a program that needs scalar code.
    #[inline(always)]
    pub(super) fn one_by_one(
        &mut self,
        words: &[u32],
        number: usize,
        here: Mask<I>,
        Stretch { t_in, t_out }: Stretch<I>,
    ) {
        let (t_in, t_out) = (t_in.stored(), t_out.stored());
        let rays = self.packets[number].rays::<I, O>(self.beam.eye, self.scenery.offset);
        let origin = rays.origin.map(|v| v.lanes().stored());
        let packet = &mut self.packets[number];
        let (stretch, meshes) = ((&origin, &t_in, &t_out), self.meshes.of(number));
        packet.one_by_one(&self.scenery, words, here.bits(), stretch, meshes, self.scratch);
    }
}

/// Some packets' stretches.
#[derive(Debug, Default)]
pub(super) struct Chunk {
    pub count: usize,
    pub numbers: [u8; CHUNK],
    /// The rays that it is about.
    pub here: [u8; CHUNK],
    pub t_in: [Stored; CHUNK],
    pub t_out: [Stored; CHUNK],
}

impl Chunk {
    #[inline(always)]
    pub(super) fn push<I: Isa>(&mut self, number: usize, here: Mask<I>, Stretch { t_in, t_out }: Stretch<I>) {
        self.numbers[self.count] = number as u8;
        self.here[self.count] = here.bits();
        self.t_in[self.count] = t_in.stored();
        self.t_out[self.count] = t_out.stored();
        self.count += 1;
    }
}

/// A leaf with one literal, which is plain.
pub(super) struct Single<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    pub walk: &'a mut Walk<'b, 'c, I, O>,
    pub word: u32,
    pub packets: u32,
    pub cube: Cube,
    pub depths: (f64, f64),
}

impl<I: Isa, O: Origins<I>> Kernel for Single<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        for number in bits_of(self.packets) {
            let (here, stretch) = self.walk.crossing(number, self.cube, self.depths);
            if here.any() {
                self.walk.single(self.word, number, here, stretch);
            }
        }
    }
}

/// A leaf with a plain program.
pub(super) struct Several<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    pub walk: &'a mut Walk<'b, 'c, I, O>,
    pub words: &'a [u32],
    pub packets: u32,
    pub cube: Cube,
    pub depths: (f64, f64),
}

impl<I: Isa, O: Origins<I>> Kernel for Several<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        let mut chunk = self.walk.chunk.take().unwrap_or_default();
        chunk.count = 0;
        for number in bits_of(self.packets) {
            let (here, stretch) = self.walk.crossing(number, self.cube, self.depths);
            if here.any() {
                chunk.push(number, here, stretch);
                if chunk.count == CHUNK {
                    self.walk.program(self.words, &chunk);
                    chunk.count = 0;
                }
            }
        }
        if chunk.count > 0 {
            self.walk.program(self.words, &chunk);
        }
        *self.walk.chunk = Some(chunk);
    }
}

/// A leaf with surfaces that lanes cannot cross.
pub(super) struct OneByOne<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    pub walk: &'a mut Walk<'b, 'c, I, O>,
    pub words: &'a [u32],
    pub packets: u32,
    pub cube: Cube,
    pub depths: (f64, f64),
}

impl<I: Isa, O: Origins<I>> Kernel for OneByOne<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        for number in bits_of(self.packets) {
            let (here, stretch) = self.walk.crossing(number, self.cube, self.depths);
            if here.any() {
                self.walk.by_scalar_code(self.words, number, here, stretch);
            }
        }
    }
}

/// What cannot be: all is inside where rays come from outside.
pub(super) struct GiveUp<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    pub walk: &'a mut Walk<'b, 'c, I, O>,
    pub packets: u32,
    pub cube: Cube,
    pub depths: (f64, f64),
}

impl<I: Isa, O: Origins<I>> Kernel for GiveUp<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        for number in bits_of(self.packets) {
            let (here, stretch) = self.walk.crossing(number, self.cube, self.depths);
            self.walk.packets[number].leak(here, stretch.t_in);
        }
    }
}

/// The places of the bits that are set, from the lowest on.
#[inline(always)]
pub(super) fn bits_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = bits.trailing_zeros();
        bits &= bits.wrapping_sub(1);
        (lowest < u32::BITS).then_some(lowest as usize)
    })
}
