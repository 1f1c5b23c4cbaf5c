//! Tori, kept as meshes are.

use super::Toggles;
use crate::surface::Torus;
use crate::trace::tile::crossing::Rays;
use crate::trace::tile::lanes::{Isa, Kernel, Mask, Number};
use crate::trace::tile::torus::torus;

/// Finds the toggles of a packet's rays with a torus.
pub(super) struct LearnTorus<'a, I: Isa, N: Number<I>> {
    pub torus: &'a Torus,
    pub rays: Rays<I, N>,
    /// Rays that matter.
    pub lanes: u8,
    /// Whether the first toggle is enough.
    pub only_first: bool,
    pub toggles: &'a mut Toggles,
}

impl<I: Isa, N: Number<I>> Kernel for LearnTorus<'_, I, N> {
    #[inline(always)]
    fn run(self) {
        let Self { torus: surface, rays, lanes, only_first, toggles } = self;
        let (found, unusual) = torus(surface, &rays, Mask::from_bits(lanes), only_first);
        let mut odd = unusual;
        for (t, next) in found.t.iter().zip(&found.t[1..]) {
            // Two crossings at one place, of a torus that is tiny where it is looked at from.
            odd = odd | t.is_finite() & next.le(*t);
        }
        (toggles.lanes, toggles.odd, toggles.starts_inside) = (lanes, odd.bits() & lanes, 0);
        for (place, t) in toggles.t.iter_mut().zip(found.t) {
            *place = t.stored();
        }
        toggles.until = found.until.stored();
    }
}
