//! Bodies of revolution seen along their axis.

use super::edge::walk;
use octrace::Contour;

/// Between which distances from the axis a body of revolution is, at a height, closed: just above it and just below it.
/// Corners closer to the height than `level` are at that height.
pub(crate) fn rings_at(contours: &[Contour], height: f64, level: f64) -> Vec<(f64, f64)> {
    let mut rings: Vec<(f64, f64)> = Vec::new();
    for above in [true, false] {
        let is_behind = |y: f64| if above { y <= height + level } else { y < height - level };
        let mut crossed: Vec<f64> =
            contours.iter().flat_map(walk).flat_map(|edge| edge.crossings(height, is_behind)).collect();
        crossed.sort_unstable_by(f64::total_cmp);
        let pairs = crossed.as_chunks::<2>().0.iter().map(|[a, b]| (a.max(0.0), *b));
        rings.extend(pairs.filter(|(inner, outer)| inner < outer));
    }
    rings.dedup();
    rings.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    rings.dedup();
    rings
}

/// Between which distances from the axis the outer contours are.
pub(crate) fn reaches(contours: &[Contour]) -> Vec<(f64, f64)> {
    let reach = |contour: &Contour| {
        let mut reach = (f64::INFINITY, f64::NEG_INFINITY);
        for edge in walk(contour) {
            for x in [edge.from.x, edge.leftmost(), edge.rightmost()] {
                reach = (reach.0.min(x), reach.1.max(x));
            }
        }
        (reach.0.max(0.0), reach.1)
    };
    contours.iter().map(reach).filter(|(inner, outer)| inner < outer).collect()
}
