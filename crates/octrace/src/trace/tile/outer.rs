//! What lies before and behind the octree's root: what is left of the program there, if anything.

use super::kernels::{Chunk, Stretch, bits_of};
use super::lanes::{F64s, Isa, Kernel, Mask};
use super::layout::packets_of;
use super::packet::Origins;
use super::parts::Parts;
use super::program::{CHUNK, Kinds, is_short};
use super::walk::{Lead, Scenery, Walk};
use crate::compile::Constant;
use crate::geom::Bounds;

/// What is left of the program outside the octree's root.
#[derive(Clone, Copy)]
enum Left<'a> {
    /// Nothing that rays could come to.
    Nothing,
    /// A program that lanes can evaluate.
    Plain(&'a [u32]),
    /// Something else.
    Other,
}

impl<'a> Scenery<'a> {
    #[inline(always)]
    fn left_outside(&self) -> Left<'a> {
        match &self.program.outer {
            Constant::Everywhere(inside) if *inside == self.wanted => Left::Other,
            Constant::Everywhere(_) => Left::Nothing,
            Constant::Words(words) if is_short(words) && self.kinds_of(words) == Kinds::Plain => Left::Plain(words),
            Constant::Words(_) => Left::Other,
        }
    }
}

impl<I: Isa, O: Origins<I>> Walk<'_, '_, I, O> {
    /// The stretches before the octree's root, of rays that come to it.
    #[inline(always)]
    pub(super) fn before(&mut self, lead: Lead) {
        let Bounds { min, max } = self.scenery.octree.bounds();
        let (mut packets, mut farthest) = (0, F64s::zero());
        for number in bits_of(self.open) {
            let packet = &self.packets[number];
            let Stretch { t_in, t_out } = self.stretch(packet, (min, max));
            let here = Mask::from_bits(packet.open) & t_in.le(t_out) & F64s::zero().lt(t_in);
            packets |= u32::from(here.any()) << number;
            farthest = here.select(farthest.max(t_in), farthest);
        }
        if let (Left::Plain(words), Lead::Beam, true) = (self.scenery.left_outside(), lead, packets != 0) {
            // Rays are no shorter than they are deep.
            let farthest = farthest.stored().0.into_iter().fold(0.0, f64::max);
            let parts =
                Parts::<I, _>::of_beam(self.beam, (0.0, farthest), self.scenery.octree.margin, self.scenery.offset);
            self.known.learn(self.scenery.catalog, words, &parts);
            let (always, never) = self.known.decided();
            packets &= !packets_of(if self.scenery.wanted { never } else { always });
        }
        self.outer(packets, |t_in, _, passes| {
            (passes & F64s::zero().lt(t_in), Stretch { t_in: F64s::zero(), t_out: t_in })
        });
    }

    /// The stretches behind the octree's root; all of those rays that do not come to it.
    #[inline(always)]
    pub(super) fn behind(&mut self) {
        self.outer(self.open, |_, t_out, passes| {
            (Mask::splat(true), Stretch { t_in: passes.select(t_out, F64s::zero()), t_out: F64s::infinity() })
        });
    }

    /// Stretches outside the octree's root: what `stretch` makes of those inside.
    #[inline(always)]
    fn outer(&mut self, packets: u32, stretch: impl Fn(F64s<I>, F64s<I>, Mask<I>) -> (Mask<I>, Stretch<I>)) {
        let Bounds { min, max } = self.scenery.octree.bounds();
        let words = match self.scenery.left_outside() {
            _ if packets == 0 => return,
            Left::Nothing => return,
            Left::Plain(words) => Some(words),
            Left::Other => None,
        };
        let mut chunk = self.chunk.take().unwrap_or_default();
        chunk.count = 0;
        for number in bits_of(packets) {
            let Stretch { t_in, t_out } = self.stretch(&self.packets[number], (min, max));
            let (rays, stretch) = stretch(t_in, t_out, t_in.le(t_out));
            let here = rays & Mask::from_bits(self.packets[number].open);
            match words {
                _ if !here.any() => {}
                Some(words) => {
                    chunk.push(number, here, stretch);
                    if chunk.count == CHUNK {
                        I::call(Outer { walk: self, words, chunk: &chunk });
                        chunk.count = 0;
                    }
                }
                None => self.packets[number].leak(here, stretch.t_in),
            }
        }
        if let Some(words) = words.filter(|_| chunk.count > 0) {
            I::call(Outer { walk: self, words, chunk: &chunk });
        }
        *self.chunk = Some(chunk);
        self.count_open();
    }
}

/// Stretches outside the octree's root, with a plain program.
struct Outer<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    walk: &'a mut Walk<'b, 'c, I, O>,
    words: &'a [u32],
    chunk: &'a Chunk,
}

impl<I: Isa, O: Origins<I>> Kernel for Outer<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        match *self.words {
            [word] => {
                for slot in 0..self.chunk.count {
                    let (number, here) = (self.chunk.numbers[slot] as usize, Mask::from_bits(self.chunk.here[slot]));
                    let (t_in, t_out) = (F64s::load(&self.chunk.t_in[slot]), F64s::load(&self.chunk.t_out[slot]));
                    self.walk.single(word, number, here, Stretch { t_in, t_out });
                }
            }
            _ => self.walk.program(self.words, self.chunk),
        }
    }
}
