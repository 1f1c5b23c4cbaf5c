//! The first crossing of each of eight lines that come from outside: mostly all that one wants to know.

use super::search::Find;
use super::triangle::Hits;
use crate::trace::tile::lanes::{F64s, Isa, LANES, Mask, Stored};

/// The first crossings that were found so far.
pub(super) struct First<I: Isa> {
    /// Where they are; where nothing was found, the end of what is of interest.
    pub t: F64s<I>,
    pub found: Mask<I>,
    /// How often more lines go in there than out.
    pub winding: F64s<I>,
    /// The first triangle there that is entered, by its number.
    pub triangles: [u32; LANES],
}

impl<I: Isa> First<I> {
    const NONE: u32 = u32::MAX;

    #[inline(always)]
    pub fn up_to(end: F64s<I>) -> Self {
        Self { t: end, found: Mask::splat(false), winding: F64s::zero(), triangles: [Self::NONE; LANES] }
    }
}

/// Several triangles at one parameter: the winding there, and the first of them that is entered.
#[cold]
#[inline(never)]
fn together(
    (lanes, entering): (u8, u8),
    number: u32,
    winding: &Stored,
    triangles: &[u32; LANES],
) -> (Stored, [u32; LANES]) {
    let (mut winding, mut triangles) = (*winding, *triangles);
    for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
        if entering >> lane & 1 != 0 {
            winding.0[lane] += 1.0;
            triangles[lane] = triangles[lane].min(number);
        } else {
            winding.0[lane] -= 1.0;
        }
    }
    (winding, triangles)
}

impl<I: Isa> Find<I> for First<I> {
    #[inline(always)]
    fn found(&mut self, Hits { lanes, entering, t }: Hits<I>, number: u32) {
        let same = lanes & self.found & t.ge(self.t);
        if same.any() {
            let (winding, triangles) =
                together((same.bits(), entering.bits()), number, &self.winding.stored(), &self.triangles);
            (self.winding, self.triangles) = (F64s::load(&winding), triangles);
        }
        let first = lanes & !same;
        let (in_, out) = (F64s::splat(1.0), F64s::splat(-1.0));
        self.t = first.select(t, self.t);
        self.winding = first.select(entering.select(in_, out), self.winding);
        let numbers = entering.select_words([number; LANES], [Self::NONE; LANES]);
        self.triangles = first.select_words(numbers, self.triangles);
        self.found = self.found | first;
    }

    #[inline(always)]
    fn end(&self) -> F64s<I> {
        self.t
    }
}
