//! Whether swept solids are convex, and convex parts of those that are not.

use super::edge::{flattened, right_of_axis, size};
use super::mesh::covered;
use crate::space::contour::convex_corners;
use octrace::{Contour, Curve, Vec2, Vec3};
use std::f64::consts::TAU;

/// Whether a prism over the contours is convex.
pub(crate) fn is_convex(contours: &[Contour]) -> bool {
    let [contour] = contours else { return false };
    let corners = flattened(std::slice::from_ref(contour), 1e-4 * size(contours)).concat();
    let (n, size) = (corners.len(), size(contours));
    let turn = |i: usize| {
        let [a, b, c] = [0, 1, 2].map(|k| corners[(i + k) % n]);
        (b - a).cross(c - b)
    };
    let turned: f64 = (0..n)
        .map(|i| {
            let [a, b, c] = [0, 1, 2].map(|k| corners[(i + k) % n]);
            libm::atan2((b - a).cross(c - b), (b - a).dot(c - b))
        })
        .sum();
    (0..n).all(|i| turn(i) >= -1e-9 * size * size) && turned < 1.5 * TAU
}

/// Whether the body of revolution is convex: with its mirror image, what is right of the axis fills its hull.
pub(crate) fn is_convex_revolution(contours: &[Contour]) -> bool {
    let [contour] = contours else { return false };
    let polygon = flattened(std::slice::from_ref(contour), 1e-4 * size(contours)).concat();
    let right = right_of_axis(&polygon);
    let doubled_area = |corners: &[Vec2]| {
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(p, q)| p.cross(*q)).sum::<f64>()
    };
    let mirrored = right.iter().map(|p| Vec2::new(-p.x, p.y));
    let hull = convex_corners(right.iter().copied().chain(mirrored).collect());
    doubled_area(&hull) <= 2.0 * doubled_area(&right) * (1.0 + 1e-6)
}

/// The corners of convex prisms that make up a prism with straight edges; `None` where there are arcs.
pub(crate) fn straight_parts(contours: &[Contour], top: f64) -> Option<Vec<Vec<Vec3>>> {
    if contours.iter().flatten().any(|edge| edge.curve != Curve::Line) {
        return None;
    }
    let polygons = flattened(contours, 1.0);
    let both = |p: Vec2| [Vec3::new(p.x, p.y, 0.0), Vec3::new(p.x * top, p.y * top, 1.0)];
    if is_convex(contours) {
        return Some(vec![polygons.concat().into_iter().flat_map(both).collect()]);
    }
    let corners = polygons.concat();
    let (_, cover) = covered(&polygons);
    Some(cover.iter().map(|t| t.iter().filter_map(|&i| corners.get(i)).copied().flat_map(both).collect()).collect())
}
