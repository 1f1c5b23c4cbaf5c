//! Which triangles a line passes through, decided exactly.
//!
//! Space is sheared so that the ray runs along an axis, and then seen along that axis [Woop, Benthin, Wald 2013]. A
//! corner's place in that picture depends on the corner and the ray alone, so triangles that share it see it at the same
//! place; from there on every decision is exact. Where the ray runs through an edge or a corner in the picture, it is
//! taken to pass by at `(e, e*e)` for an infinitely small `e > 0`.

use crate::geom::{Bounds, Ray, Vec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// A ray's whole line, and the sheared picture that has it at the origin.
pub(super) struct Line {
    origin: Vec3,
    /// Axes of the picture, and the axis along which to look.
    axes: [usize; 3],
    /// Direction along the picture's axes where it is one along the third.
    shear: [f64; 2],
    /// More than rounding can make of places in the picture.
    room: f64,
}

impl Line {
    /// The line of a ray, for points whose coordinates are no larger than `farthest`.
    pub fn new(ray: &Ray, farthest: f64) -> Self {
        let along = ray.direction.largest_axis();
        let (mut u, mut v) = ((along + 1) % 3, (along + 2) % 3);
        let advance = ray.direction[along];
        // Looking the other way mirrors the picture; exchanging its axes undoes that.
        if advance < 0.0 {
            (u, v) = (v, u);
        }
        let shear = [ray.direction[u] / advance, ray.direction[v] / advance];
        let room = ROOM * (2.0 * farthest + ray.origin.max_abs()) + TINY;
        Self { origin: ray.origin, axes: [u, v, along], shear, room }
    }

    /// Where the point appears in the picture.
    fn project(&self, p: Vec3) -> [f64; 2] {
        let [u, v, w] = self.axes;
        let along = p[w] - self.origin[w];
        let place = [p[u] - self.origin[u] - self.shear[0] * along, p[v] - self.origin[v] - self.shear[1] * along];
        // Decisions are exact as long as no product underflows.
        place.map(|x| if x.abs() < TINY { 0.0 } else { x })
    }

    /// Whether the line may pass through a triangle with corners in this box: false only where [`Self::crosses`] is
    /// `None` for all of them.
    pub fn may_touch(&self, bounds: &Bounds) -> bool {
        // Two ways out: the box's shadow lies beside the origin along an axis of the picture, or across the shear, where
        // the shadow is thinnest.
        let center = bounds.center();
        let half = (bounds.max - bounds.min) * 0.5;
        let [u, v, w] = self.axes;
        let offset = [u, v, w].map(|axis| center[axis] - self.origin[axis]);
        let [x, y] = [0, 1].map(|i| offset[i] - self.shear[i] * offset[2]);
        let [steep_x, steep_y] = self.shear.map(f64::abs);
        x.abs() <= half[u] + steep_x * half[w] + self.room && y.abs() <= half[v] + steep_y * half[w] + self.room && {
            let across = self.shear[0] * offset[1] - self.shear[1] * offset[0];
            across.abs() <= steep_x * half[v] + steep_y * half[u] + self.room
        }
    }

    /// Whether the line passes through the triangle and if so, whether it goes in (the corners, counter-clockwise from
    /// outside, appear clockwise) or out.
    pub fn crosses(&self, corners: [Vec3; 3]) -> Option<bool> {
        let [a, b, c] = corners.map(|p| self.project(p));
        let beside = |i: usize| (a[i] > 0.0 && b[i] > 0.0 && c[i] > 0.0) || (a[i] < 0.0 && b[i] < 0.0 && c[i] < 0.0);
        if beside(0) || beside(1) {
            return None;
        }
        let left = is_left(a, b)?;
        (is_left(b, c)? == left && is_left(c, a)? == left).then_some(!left)
    }
}

/// Products of numbers from here on have all their digits, and so have the errors of these products.
pub(crate) const TINY: f64 = 1e-140;

/// Rounding errors in this module are below eight units in the last place of the largest number.
pub(super) const ROOM: f64 = 16.0 * f64::EPSILON;

/// Each product is off by half a unit in its last place, and so is the difference of two; twice that is certain.
pub(crate) const UNCERTAIN: f64 = 4.0 * f64::EPSILON;

/// Whether the origin, nudged by `(e, e*e)`, lies to the left of the way from `a` to `b`. `None` where they are equal.
///
/// The way back always gives the opposite answer, and so the three sides of all triangles of a closed surface agree.
fn is_left(a: [f64; 2], b: [f64; 2]) -> Option<bool> {
    let [p, q] = [a[0] * b[1], a[1] * b[0]];
    let mut side = p - q;
    if side.abs() <= UNCERTAIN * (p.abs() + q.abs()) {
        side = orient2d(Coord { x: a[0], y: a[1] }, Coord { x: b[0], y: b[1] }, Coord { x: 0.0, y: 0.0 });
    }
    // With the nudge, the side is a.x*b.y - a.y*b.x + e*(a.y - b.y) + e*e*(b.x - a.x).
    if side != 0.0 {
        Some(side > 0.0)
    } else if a[1] != b[1] {
        Some(a[1] > b[1])
    } else if a[0] != b[0] {
        Some(b[0] > a[0])
    } else {
        None
    }
}

/// Whether a point lies behind a triangle, on the side from which its corners appear clockwise; exact.
pub(super) fn is_behind(corners: [Vec3; 3], point: Vec3) -> bool {
    let [a, b, c, p] = [corners[0], corners[1], corners[2], point].map(|p| Coord3D { x: p.x, y: p.y, z: p.z });
    orient3d(a, b, c, p) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_are_antisymmetric_also_where_all_is_in_line() {
        let lattice = |n: i32| [f64::from(n % 5 - 2), f64::from(n / 5 - 2)];
        for a in (0..25).map(lattice) {
            for b in (0..25).map(lattice) {
                assert_eq!(is_left(a, b), is_left(b, a).map(|left| !left), "{a:?} {b:?}");
                assert_eq!(is_left(a, b).is_none(), a == b);
            }
        }
    }

    #[test]
    fn left_is_left() {
        assert_eq!(is_left([1.0, -1.0], [1.0, 1.0]), Some(true));
        assert_eq!(is_left([-1.0, -1.0], [-1.0, 1.0]), Some(false));
    }

    #[test]
    fn going_up_through_a_triangle_seen_from_above_goes_out() {
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let through = |direction: [f64; 3]| Line::new(&Ray::new([0.2, 0.2, 0.0], direction), 1.0).crosses(triangle);
        assert_eq!(through([0.0, 0.0, 2.0]), Some(false));
        assert_eq!(through([0.0, 0.0, -2.0]), Some(true));
        assert_eq!(through([-1.0, -1.0, -0.5]), Some(true));
        assert_eq!(through([1.0, 0.0, 0.0]), None);
        assert!(is_behind(triangle, Vec3::new(0.2, 0.2, -1.0)));
    }
}
