//! Cones and cylinders between two circles.

use octrace::{Affine, Primitive, Solid, Vec3};

/// Radii that differ by less than this share are equal: a cone has its apex in reach.
const EQUAL: f64 = 1e-9;

/// Two unit vectors across `axis`, which has length one, and each other. For an axis of coordinates they are axes, too.
pub(crate) fn across(axis: Vec3) -> [Vec3; 2] {
    let least = match (axis.x.abs(), axis.y.abs(), axis.z.abs()) {
        (x, y, z) if x <= y && x <= z => Vec3::X,
        (_, y, z) if y <= z => Vec3::Y,
        _ => Vec3::Z,
    };
    let u = least.cross(axis);
    let u = u.normalized().unwrap_or(u);
    [u, axis.cross(u)]
}

/// The body between two circles, by centre and radius, about the line through both centres; nothing where both radii are
/// zero, or the centres are one.
pub(crate) fn frustum(a: (Vec3, f64), b: (Vec3, f64)) -> Solid {
    match (b.0 - a.0).normalized() {
        Some(axis) => between(a, b, across(axis)),
        None => Solid::empty(),
    }
}

/// The body between two circles in parallel planes spanned by `plane`, two unit vectors across each other: a cylinder or
/// a cone, oblique where the line through the centres is not across the planes.
pub(crate) fn between(a: (Vec3, f64), b: (Vec3, f64), plane: [Vec3; 2]) -> Solid {
    let ((foot, large), (head, small)) = if a.1 >= b.1 { (a, b) } else { (b, a) };
    let primitive = match small / large {
        ratio if ratio >= 1.0 - EQUAL => Primitive::Cylinder,
        top => Primitive::Cone { top },
    };
    if !(large > 0.0 && large.is_finite()) {
        return Solid::empty();
    }
    let [u, v] = plane.map(|side| side * large);
    let up = head - foot;
    let row = |axis: usize| Vec3::new(u[axis], v[axis], up[axis]);
    let map = Affine { rows: [row(0), row(1), row(2)], translation: foot };
    Solid::primitive(primitive).transform(map)
}
