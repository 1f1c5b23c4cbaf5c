//! Contours for shadows and sections.

use super::hull::square;
use super::round::{fragments, swelling};
use crate::plane::{Flat, Outline};
use octrace::geom::sin_cos_deg;
use octrace::{Affine, BoolOp, Contour, Curve, Edge, Vec2, Vec3};
use std::sync::Arc;

/// The region with these contours.
pub(super) fn region(contours: Vec<Contour>) -> Flat {
    Flat::Outline(Arc::new(Outline { contours }))
}

/// Nothing.
pub(super) fn nothing() -> Flat {
    region(Vec::new())
}

/// A closed walk along straight lines.
pub(super) fn polygon(corners: impl IntoIterator<Item = Vec2>) -> Contour {
    corners.into_iter().map(|from| Edge { from, curve: Curve::Line }).collect()
}

/// The plan view of a point.
pub(super) fn plan(p: Vec3) -> Vec2 {
    Vec2::new(p.x, p.y)
}

/// The convex polygon around points; nothing where they are in a line.
pub(super) fn convex_polygon(points: Vec<Vec2>) -> Flat {
    let corners = convex_corners(points);
    if corners.is_empty() { nothing() } else { region(vec![polygon(corners)]) }
}

/// The corners of the convex polygon around points, counter-clockwise; none where they are in a line.
pub(super) fn convex_corners(mut points: Vec<Vec2>) -> Vec<Vec2> {
    points.retain(|p| p.x.is_finite() && p.y.is_finite());
    points.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return Vec::new() };
    // Turns smaller than this are none.
    let flat = 1e-12 * (last - first).dot(last - first);
    let chain = |points: &mut dyn Iterator<Item = Vec2>| {
        let mut chain: Vec<Vec2> = Vec::new();
        for p in points {
            while let &[.., a, b] = chain.as_slice()
                && (b - a).cross(p - b) <= flat
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut corners = chain(&mut points.iter().copied());
    corners.extend(chain(&mut points.iter().rev().copied()));
    if corners.len() < 3 { Vec::new() } else { corners }
}

/// A circle, counter-clockwise, or clockwise for a hole.
pub(super) fn circle(center: Vec2, radius: f64, ccw: bool) -> Contour {
    vec![Edge { from: center + Vec2::new(radius, 0.0), curve: Curve::Arc { center, radius, ccw } }]
}

/// Rings about the axis of a map that turns them, by the radii between which they lie. They may overlap.
pub(super) fn rings(radii: &[(f64, f64)], map: &Affine) -> Flat {
    let (center, scale) = (plan(map.translation), map.column(0).length());
    let ring = |&(inner, outer): &(f64, f64)| {
        let hole = (inner > 0.0).then(|| circle(center, inner * scale, false));
        region(std::iter::once(circle(center, outer * scale, true)).chain(hole).collect())
    };
    match radii {
        [] => nothing(),
        [one] => ring(one),
        _ => Flat::Combined(BoolOp::Union, radii.iter().map(ring).collect()),
    }
}

/// An ellipse by its centre and two half-axes, or any two conjugate ones: a circle, or else a polygon that is within
/// `deviation` of it.
pub(super) fn ellipse(center: Vec2, [a, b]: [Vec2; 2], deviation: f64) -> Flat {
    let [u, v] = [a, b].map(|axis| Vec3::new(axis.x, axis.y, 0.0));
    if square(u, v) {
        return region(vec![circle(center, u.length(), true)]);
    }
    convex_polygon(ring(center, [a, b], deviation))
}

/// Points around an ellipse, with its area between them.
pub(super) fn ring(center: Vec2, [a, b]: [Vec2; 2], deviation: f64) -> Vec<Vec2> {
    let n = fragments((a.dot(a) + b.dot(b)).sqrt(), deviation);
    let swelling = swelling(n);
    let corner = |i: u32| {
        let (s, c) = sin_cos_deg(360.0 * f64::from(i) / f64::from(n));
        center + (a * c + b * s) * swelling
    };
    (0..n).map(corner).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Whether a point is in a flat shape made of circles and polygons.
    pub fn contains(flat: &Flat, p: Vec2) -> bool {
        match flat {
            Flat::Outline(outline) => outline.contours.iter().filter(|c| is_around(c, p)).count() % 2 == 1,
            Flat::Moved(..) => unreachable!("nothing here is moved"),
            Flat::Combined(op, shapes) => {
                let mut inside = shapes.iter().map(|shape| contains(shape, p));
                match op {
                    BoolOp::Union => inside.any(|b| b),
                    BoolOp::Intersection => inside.all(|b| b),
                    BoolOp::Difference => inside.next() == Some(true) && !inside.any(|b| b),
                }
            }
        }
    }

    fn is_around(contour: &Contour, p: Vec2) -> bool {
        if let [Edge { curve: Curve::Arc { center, radius, .. }, .. }] = contour.as_slice() {
            return (p - *center).length() < *radius;
        }
        let next = contour.iter().cycle().skip(1);
        let crossings = contour.iter().zip(next).filter(|(a, b)| {
            let (a, b) = (a.from, b.from);
            (a.y <= p.y) != (b.y <= p.y) && (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
        });
        crossings.count() % 2 == 1
    }

    /// Compares the area, as found by counting points of a net.
    pub fn check(flat: &Flat, area: f64) {
        let (net, half) = (700, 6.0);
        let at = |i: i32| half * (2.0 * (f64::from(i) + 0.5) / f64::from(net) - 1.0) + 1e-4;
        let points = (0..net).flat_map(|i| (0..net).map(move |j| Vec2::new(at(i), at(j))));
        let found = points.filter(|&p| contains(flat, p)).count() as f64 * (2.0 * half / f64::from(net)).powi(2);
        assert!((found - area).abs() < 0.02 * area.max(1.0), "{found} is not {area}: {flat:?}");
    }

    #[test]
    fn convex_polygons_have_corners_only() {
        let square = (0..25).map(|i| Vec2::new(f64::from(i % 5), f64::from(i / 5))).collect();
        let flat = convex_polygon(square);
        let Flat::Outline(outline) = &flat else { panic!() };
        let corners: Vec<[f64; 2]> = outline.contours[0].iter().map(|e| [e.from.x, e.from.y]).collect();
        assert_eq!(corners, [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
        let line = (0..5).map(|i| Vec2::new(f64::from(i), f64::from(i) * 0.1)).collect();
        let flat = convex_polygon(line);
        let Flat::Outline(outline) = &flat else { panic!() };
        assert!(outline.contours.is_empty());
    }
}
