//! What lies before and behind the octree's root: what is left of the program there, if anything.

use super::kernels::{Chunk, Stretch, bits_of};
use super::lanes::{F64s, Isa, Kernel, Mask};
use super::packet::Origins;
use super::program::{CHUNK, is_short};
use super::walk::Walk;
use crate::compile::Constant;
use crate::geom::Bounds;

impl<I: Isa, O: Origins<I>> Walk<'_, '_, I, O> {
    /// The stretches before the octree's root.
    #[inline(always)]
    pub(super) fn before(&mut self) {
        self.outer(|t_in, _, passes| {
            // Rays that miss the root are followed to the end at once.
            let t_out = passes.select(t_in, F64s::infinity());
            (F64s::zero().lt(t_out), Stretch { t_in: F64s::zero(), t_out })
        });
    }

    /// The stretches behind the octree's root.
    #[inline(always)]
    pub(super) fn behind(&mut self) {
        self.outer(|_, t_out, passes| (passes, Stretch { t_in: t_out, t_out: F64s::infinity() }));
    }

    /// Stretches outside the octree's root: what `stretch` makes of those inside.
    #[inline(always)]
    fn outer(&mut self, stretch: impl Fn(F64s<I>, F64s<I>, Mask<I>) -> (Mask<I>, Stretch<I>)) {
        let Bounds { min, max } = self.scenery.octree.bounds();
        let words = match &self.scenery.program.outer {
            Constant::Everywhere(inside) if *inside == self.scenery.wanted => None,
            Constant::Everywhere(_) => return,
            Constant::Words(words) => Some(&**words).filter(|words| is_short(words) && self.scenery.is_plain(words)),
        };
        let mut chunk = self.chunk.take().unwrap_or_default();
        chunk.count = 0;
        for number in bits_of(self.open) {
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
        self.walk.program(self.words, self.chunk);
    }
}
