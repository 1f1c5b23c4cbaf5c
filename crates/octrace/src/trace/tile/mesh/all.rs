//! All crossings of eight lines ahead of their starts, and where they change between outside and inside.

use super::Toggles;
use super::search::Find;
use super::triangle::Hits;
use crate::primitive::Mesh;
use crate::trace::tile::lanes::{F64s, Isa, LANES, Stored};

/// So many crossings of a line are kept; lines with more are for scalar code.
const MOST: usize = 24;

/// A crossing.
#[derive(Clone, Copy, Debug, Default)]
struct Met {
    t: f64,
    triangle: u32,
    entering: bool,
}

/// Crossings that were found so far, in no order.
#[derive(Clone, Debug)]
pub(super) struct All {
    met: [[Met; MOST]; LANES],
    counts: [usize; LANES],
    /// Lanes whose lines have more.
    pub overflowed: u8,
    /// Nothing is wanted beyond these.
    end: Stored,
}

impl Default for All {
    fn default() -> Self {
        Self {
            met: [[Met::default(); MOST]; LANES],
            counts: [0; LANES],
            overflowed: 0,
            end: Stored([f64::INFINITY; LANES]),
        }
    }
}

impl All {
    /// Forgets everything.
    pub fn begin(&mut self, end: Stored) {
        (self.counts, self.overflowed, self.end) = ([0; LANES], 0, end);
    }

    fn push(&mut self, lanes: u8, entering: u8, t: &Stored, triangle: u32) {
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
            match self.met[lane].get_mut(self.counts[lane]) {
                Some(place) => {
                    *place = Met { t: t.0[lane], triangle, entering: entering >> lane & 1 != 0 };
                    self.counts[lane] += 1;
                }
                None => self.overflowed |= 1 << lane,
            }
        }
    }

    /// Where the lines of some lanes toggle; `outside` are those that start outside. The same as [`Mesh::toggles`].
    pub fn toggles(&mut self, mesh: &Mesh, lanes: u8, outside: u8, toggles: &mut Toggles) {
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
            let met = &mut self.met[lane][..self.counts[lane]];
            met.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.triangle.cmp(&b.triangle)));
            let sum: i32 = met.iter().map(|met| if met.entering { 1 } else { -1 }).sum();
            // In the end the line is outside.
            let mut winding = if outside >> lane & 1 != 0 { 0 } else { -sum };
            let mut count = 0;
            toggles.begin(lane, winding > 0, self.end.0[lane]);
            for together in met.chunk_by(|a, b| a.t == b.t) {
                let was_inside = winding > 0;
                winding += together.iter().map(|met| if met.entering { 1 } else { -1 }).sum::<i32>();
                let inside = winding > 0;
                let seen = together.iter().find(|met| met.entering == inside);
                if let (true, Some(seen)) = (inside != was_inside, seen) {
                    if !toggles.push(lane, count, seen.t, mesh.facet(seen.triangle)) {
                        break;
                    }
                    count += 1;
                }
            }
        }
    }
}

impl<I: Isa> Find<I> for All {
    #[inline(always)]
    fn found(&mut self, Hits { lanes, entering, t }: Hits<I>, number: u32) {
        self.push(lanes.bits(), entering.bits(), &t.stored(), number);
    }

    #[inline(always)]
    fn end(&self) -> F64s<I> {
        F64s::load(&self.end)
    }
}
