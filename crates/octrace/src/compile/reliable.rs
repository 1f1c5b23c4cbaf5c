//! Where primitives are, rounding included, and walls around those that rounding would show elsewhere.
//!
//! Surfaces know their map's inverse only, and rays are taken through it. Of a map that squashes space at an angle, as
//! `|map| |inverse|` tells, the inverse is imprecise, and what it makes of a ray from afar is off by much more than its
//! point on the surface: by more than the margins of cells, in the worst case. A *fence* of six planes keeps what is seen of
//! such a primitive where the primitive is, for all tracers alike. Usual primitives have none.

use super::face::Face;
use super::facets::Faces;
use crate::geom::{Affine, Bounds, Vec3};
use crate::primitive::Primitive;
use crate::surface::Plane;

/// Roundings on the way through a map.
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

/// Rays start so many sizes of the scene away; those from farther away are restarted near it.
const FAR: f64 = 64.0;

/// A box around the primitive as its surfaces have it. What an imprecise inverse does to the primitive's points, moved
/// there and back, comes on top.
pub(super) fn reliable_bounds(primitive: &Primitive, map: &Affine, inverse: &Affine) -> Bounds {
    let bounds = primitive.bounds(map);
    let local = primitive.bounds(&Affine::IDENTITY);
    if !local.is_bounded() {
        return bounds;
    }
    let farthest = local.min.abs().max(local.max.abs());
    let off = off(map, inverse, applied(map, farthest) + map.translation.abs());
    if off.max_abs() <= usual(&bounds) { bounds } else { Bounds::new(bounds.min - off, bounds.max + off) }
}

/// The box that keeps a primitive, which has those [`reliable_bounds`], from being seen elsewhere; `None` where rounding
/// does not show it elsewhere anyway.
pub(super) fn fence(bounds: &Bounds, map: &Affine, inverse: &Affine) -> Option<Bounds> {
    if bounds.is_empty() || !bounds.is_bounded() {
        return None;
    }
    let size = bounds.size().max_abs();
    // Larger scenes have rays from farther away, and larger margins.
    let off = off(map, inverse, Vec3::splat(FAR * size) + bounds.center().abs());
    let usual = usual(bounds);
    // Also where a number is NaN.
    let is_usual = off.max_abs() <= usual;
    (!is_usual).then(|| bounds.grown(usual))
}

/// What the margins of cells cover.
fn usual(bounds: &Bounds) -> f64 {
    1e-9 * bounds.size().max_abs() + 1e-13 * bounds.min.max_abs().max(bounds.max.max_abs())
}

/// How far off a point of the scene comes back that is moved there and back, by coordinates.
fn off(map: &Affine, inverse: &Affine, point: Vec3) -> Vec3 {
    applied(map, applied(inverse, point) * ROUNDINGS)
}

/// How far the linear part takes what is not farther than `to`, by coordinates.
fn applied(map: &Affine, to: Vec3) -> Vec3 {
    Vec3::from(map.rows.map(|row| row.abs().dot(to)))
}

/// Adds the six sides of a box.
pub(super) fn add_walls(faces: &mut Faces, bounds: &Bounds) {
    for axis in 0..3 {
        for (height, sign) in [(bounds.min[axis], -1.0), (bounds.max[axis], 1.0)] {
            let mut normal = Vec3::ZERO;
            normal[axis] = sign;
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let corners = [(false, false), (true, false), (true, true), (false, true)].map(|(far_u, far_v)| {
                let mut corner = Vec3::ZERO;
                corner[axis] = height;
                corner[u] = if far_u { bounds.max[u] } else { bounds.min[u] };
                corner[v] = if far_v { bounds.max[v] } else { bounds.min[v] };
                corner
            });
            faces.push(Face::Plane { plane: Plane { normal, offset: sign * height }, corners });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fence_of(map: Affine) -> Option<Bounds> {
        let inverse = map.inverse().expect("a map that can be undone");
        fence(&reliable_bounds(&Primitive::Sphere, &map, &inverse), &map, &inverse)
    }

    #[test]
    fn only_what_is_squashed_at_an_angle_a_lot_is_fenced() {
        let turned = Affine::rotation_deg(Vec3::new(20.0, 30.0, 40.0));
        let flat = |by: f64| Affine::scale(Vec3::new(1.0, 1.0, by));
        assert_eq!(fence_of(turned), None);
        assert_eq!(fence_of(Affine::translation(Vec3::splat(1e6)) * turned * flat(0.01)), None);
        assert_eq!(fence_of(turned * flat(1e-12)), None, "turned when it is flat");
        assert_eq!(fence_of(flat(1e-3) * turned), None, "not a lot");
        let Bounds { min, max } = fence_of(flat(1e-7) * turned).expect("walls");
        assert!((max - min).max_abs() < 2.0 + 1e-6);
    }
}
