//! Roughly where the solid is: good enough to point a camera at it.

use crate::compile::{Constant, Simplified, Simplifier};
use crate::geom::{Bounds, Vec3};
use crate::surface::CellBox;
use crate::trace::Tracer;

/// How often the box around everything is halved: the answer is up to 1/64 of it too large on each side.
const ROUGHLY: u32 = 6;
/// The same where it is to be close: 1/512.
const CLOSELY: u32 = 9;

/// A box around the solid's bounded parts: tighter than [`Tracer::bounds`], which does not know what differences cut away,
/// and quicker than [`measure`](super::measure()), which knows exactly. The same for every acceleration.
///
/// Cost: as a few levels of an octree.
pub fn occupied_bounds(tracer: &Tracer) -> Bounds {
    occupied(tracer, ROUGHLY)
}

/// The same, more closely: hardly too large by a pixel of an ordinary picture.
///
/// Cost: a little more, as only cells at the outermost ends of the solid are divided further.
pub fn occupied_bounds_closely(tracer: &Tracer) -> Bounds {
    occupied(tracer, CLOSELY)
}

fn occupied(tracer: &Tracer, levels: u32) -> Bounds {
    let bounds = tracer.bounds();
    if bounds.is_empty() {
        return bounds;
    }
    let mut occupied = Bounds::EMPTY;
    let half = bounds.size() * 0.5;
    for words in tracer.programs().filter_map(|program| match program {
        Constant::Words(words) => Some(words),
        Constant::Everywhere(_) => None,
    }) {
        let mut search = Search { tracer, simplifier: Simplifier::default(), occupied };
        search.cell(words, bounds.center(), half, levels);
        occupied = search.occupied;
    }
    if occupied.is_empty() { bounds } else { occupied.intersection(bounds) }
}

struct Search<'a> {
    tracer: &'a Tracer,
    simplifier: Simplifier,
    occupied: Bounds,
}

impl Search<'_> {
    fn cell(&mut self, words: &[u32], center: Vec3, half: Vec3, levels_left: u32) {
        let cell = Bounds::new(center - half, center + half);
        if self.occupied.contains(cell.min) && self.occupied.contains(cell.max) {
            return;
        }
        let mut reduced = Vec::new();
        let bounds = CellBox::new(center, half);
        match self.simplifier.simplify(self.tracer.catalog(), words, &bounds, &mut reduced) {
            Simplified::Constant(false) => {}
            Simplified::Reduced if levels_left > 0 => {
                let half = half * 0.5;
                for octant in 0..8 {
                    let side = |bit: i32, h: f64| if octant & bit == 0 { -h } else { h };
                    let offset = Vec3::new(side(1, half.x), side(2, half.y), side(4, half.z));
                    self.cell(&reduced, center + offset, half, levels_left - 1);
                }
            }
            Simplified::Constant(true) | Simplified::Reduced => self.occupied = self.occupied.union(cell),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exec::Exec;
    use crate::model::Solid;
    use crate::trace::TracerOptions;

    #[test]
    fn what_is_cut_away_does_not_count() {
        let half = Solid::block() - Solid::block().scale([0.5, 2.0, 2.0]).translate([0.5, -0.5, -0.5]);
        let tracer = Tracer::build(&half, &TracerOptions::default(), &Exec::with_threads(1)).expect("nobody cancels");
        assert_eq!(tracer.bounds().max.x, 1.0);
        let occupied = occupied_bounds(&tracer);
        assert!((0.5..0.52).contains(&occupied.max.x), "{occupied:?}");
        assert_eq!((occupied.min, occupied.max.y, occupied.max.z), (Vec3::ZERO, 1.0, 1.0));
        assert!((0.5..0.503).contains(&occupied_bounds_closely(&tracer).max.x));
    }
}
