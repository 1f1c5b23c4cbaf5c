//! Minkowski sums of outlines: all sums of a point of the one and a point of the other.
//!
//! A sum with a disc is a round offset; of two convex outlines, one of them a polygon, the sum is the hull of copies of the
//! other at the polygon's corners. Both are exact for lines and arcs. Everything else is united from pieces: copies of each
//! at a corner of each contour of the other, and a parallelogram for each pair of edges; arcs become chords for that.

use super::boolean::{Fill, region};
use super::curve::{chords_per_turn, corners, edges};
use super::outline::straight;
use super::{Affine2, Offset, Outline, PlaneError, hull};
use crate::Tolerance;
use octrace::{Contour, Curve, Edge, Vec2};

/// More pairs of edges than this are too many.
const MOST_PAIRS: usize = 400_000;

impl Outline {
    /// The sum of this and another outline; empty where one of them is.
    ///
    /// # Errors
    /// As for [`region`]. Outlines with holes or dents, both, may have too many pairs of edges.
    pub fn minkowski(&self, other: &Self, tolerance: Tolerance) -> Result<Self, PlaneError> {
        if self.is_empty() || other.is_empty() {
            return Ok(Self::EMPTY);
        }
        for (shape, disc) in [(self, other), (other, self)] {
            if let Some((center, radius)) = disc.as_disc() {
                let rounded = shape.offset(Offset::Round { r: radius, facets: None })?;
                return Ok(rounded.moved(&Affine2::translation(center), tolerance));
            }
        }
        let count = |outline: &Self| outline.contours.iter().map(Vec::len).sum::<usize>();
        for (shape, polygon) in [(self, other), (other, self)] {
            let few = count(shape).saturating_mul(count(polygon)) <= MOST_PAIRS;
            if few && polygon.is_polygon() && polygon.is_convex() && shape.is_convex() {
                let copy = |edge: &Edge| shape.moved(&Affine2::translation(edge.from), tolerance);
                let copies: Vec<Self> = polygon.contours.iter().flatten().map(copy).collect();
                return Ok(hull(&copies));
            }
        }
        let size = [self, other].iter().filter_map(|o| o.bounds()).map(|b| b.diagonal()).fold(0.0, f64::max);
        let straightened = |outline: &Self| -> Vec<Vec<Vec2>> {
            let per_turn = |radius: f64| chords_per_turn(radius, tolerance.relative * size);
            let points = |contour: &Contour| {
                let mut points = Vec::new();
                edges(contour).for_each(|(edge, to)| corners(&edge, to, per_turn, &mut points));
                points
            };
            outline.contours.iter().map(points).collect()
        };
        sum_of_polygons(&straightened(self), &straightened(other))
    }

    /// Centre and radius, where the outline is one circle.
    pub fn as_disc(&self) -> Option<(Vec2, f64)> {
        let [contour] = &self.contours[..] else { return None };
        match contour[..] {
            [Edge { curve: Curve::Arc { center, radius, ccw: true }, .. }] => Some((center, radius)),
            _ => None,
        }
    }

    /// Whether the line between any two of its points is within, up to rounding.
    pub fn is_convex(&self) -> bool {
        let area = self.area();
        self.contours.len() < 2 && hull([self]).area() - area <= area * 1e-12
    }
}

/// The sum of two regions bounded by polygons.
///
/// A point is in the sum if the one region and the other, turned over and moved there, have a point in common. Then their
/// boundaries cross somewhere, or a whole contour of one is within the other.
fn sum_of_polygons(a: &[Vec<Vec2>], b: &[Vec<Vec2>]) -> Result<Outline, PlaneError> {
    let count = |polygons: &[Vec<Vec2>]| polygons.iter().map(Vec::len).sum::<usize>();
    let pairs = count(a).saturating_mul(count(b));
    if pairs > MOST_PAIRS {
        return Err(PlaneError::TooComplex { edges: pairs });
    }
    let mut pieces: Vec<Contour> = Vec::with_capacity(pairs);
    for (whole, other) in [(a, b), (b, a)] {
        for &at in other.iter().filter_map(|polygon| polygon.first()) {
            let copy = |polygon: &Vec<Vec2>| straight(&polygon.iter().map(|&p| p + at).collect::<Vec<_>>());
            pieces.extend(whole.iter().map(copy));
        }
    }
    for (p, q) in a.iter().flat_map(|polygon| sides(polygon)) {
        for (r, s) in b.iter().flat_map(|polygon| sides(polygon)) {
            let turn = (q - p).cross(s - r);
            let mut piece = straight(&[p + r, q + r, q + s, p + s]);
            if turn < 0.0 {
                piece.reverse();
            }
            if turn != 0.0 {
                pieces.push(piece);
            }
        }
    }
    region(&pieces, Fill::Positive)
}

fn sides(polygon: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::BoolOp;
    use std::f64::consts::PI;

    fn p(x: f64, y: f64) -> Vec2 {
        Vec2::new(x, y)
    }

    fn polygon(corners: &[(f64, f64)]) -> Outline {
        Outline::polygon(&[corners.iter().map(|&(x, y)| p(x, y)).collect()]).expect("simple")
    }

    fn check(a: &Outline, b: &Outline, area: f64) -> Outline {
        let sum = a.minkowski(b, Tolerance::default()).expect("simple");
        assert!((sum.area() - area).abs() <= 1e-11 * area, "{} {area} {sum:?}", sum.area());
        let turned = b.minkowski(a, Tolerance::default()).expect("simple");
        assert!((turned.area() - area).abs() <= 1e-11 * area, "{} {area}", turned.area());
        sum
    }

    /// Areas that OpenSCAD 2021.01 finds for these.
    #[test]
    fn areas_are_openscads() {
        let l = polygon(&[(0.0, 0.0), (20.0, 0.0), (20.0, 5.0), (8.0, 5.0), (8.0, 15.0), (0.0, 15.0)]);
        let ring = {
            let square = |half: f64| Outline::rectangle(p(-half, -half), p(half, half));
            super::super::combine(BoolOp::Difference, &[&square(10.0), &square(5.0)]).expect("simple")
        };
        check(&l, &polygon(&[(0.0, 0.0), (3.0, 0.0), (0.0, 2.0)]), 265.0);
        check(&l, &polygon(&[(0.0, 0.0), (6.0, 0.0), (6.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)]), 344.0);
        check(&ring, &polygon(&[(0.0, 0.0), (3.0, 1.0), (1.0, 2.0)]), 446.5);
        let two = |a: Outline, b: Outline| super::super::combine(BoolOp::Union, &[&a, &b]).expect("simple");
        let square = |x: f64, y: f64, w: f64| Outline::rectangle(p(x, y), p(x + w, y + w));
        let squares = two(square(0.0, 0.0, 4.0), square(10.0, 0.0, 2.0));
        check(&squares, &two(square(0.0, 0.0, 1.0), square(0.0, 8.0, 1.0)), 68.0);
    }

    #[test]
    fn discs_round_and_convex_outlines_keep_their_arcs() {
        let square = Outline::rectangle(p(0.0, 0.0), p(4.0, 4.0));
        let disc = Outline::circle(1.0).moved(&Affine2::translation(p(9.0, 0.0)), Tolerance::default());
        let rounded = check(&square, &disc, 16.0 + 16.0 + PI);
        assert_eq!(rounded.bounds().map(|b| b.min), Some(p(8.0, -1.0)));
        let larger = check(&rounded, &Outline::rectangle(p(0.0, 0.0), p(2.0, 1.0)), 6.0 * 5.0 + 22.0 + PI);
        assert_eq!(larger.contours[0].len(), 8);
    }

    #[test]
    fn a_frame_in_a_hole_counts() {
        // A small frame in a large one's hole, and neither's boundary crosses the other's.
        let frame = |half: f64, hole: f64| {
            let square = |half: f64| Outline::rectangle(p(-half, -half), p(half, half));
            super::super::combine(BoolOp::Difference, &[&square(half), &square(hole)]).expect("simple")
        };
        check(&frame(10.0, 8.0), &frame(2.0, 1.0), 24.0 * 24.0 - 12.0 * 12.0);
    }
}
