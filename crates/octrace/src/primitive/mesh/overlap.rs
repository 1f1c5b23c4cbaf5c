//! Whether a crossing with a triangle may be placed in a box.

use crate::geom::Vec3;

/// Whether the box has points of the triangle's bounding box and of its plane. That is a little more than the triangle
/// itself reaches: a crossing is placed where the line meets the *surface* that stands for the triangle, and on lines
/// that run nearly along the plane that may lie beside the triangle, though never outside these two.
pub(super) fn triangle_reaches_box(corners: [Vec3; 3], center: Vec3, half_extents: Vec3) -> bool {
    let corners = corners.map(|p| p - center);
    let [a, b, c] = corners;
    let touch_along = |axis: Vec3| {
        let reach = axis.abs().dot(half_extents);
        let along = corners.map(|p| axis.dot(p));
        along[0].min(along[1]).min(along[2]) <= reach && -reach <= along[0].max(along[1]).max(along[2])
    };
    [Vec3::X, Vec3::Y, Vec3::Z, (b - a).cross(c - a)].into_iter().all(touch_along)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn touching_counts() {
        let flat = [Vec3::new(0.0, 0.0, 1.0), Vec3::new(4.0, 0.0, 1.0), Vec3::new(0.0, 4.0, 1.0)];
        let check = |center: [f64; 3], expected: bool| {
            assert_eq!(triangle_reaches_box(flat, center.into(), Vec3::splat(1.0)), expected, "{center:?}");
        };
        check([0.0, 0.0, 0.0], true);
        check([0.0, 0.0, 2.0], true);
        check([0.0, 0.0, 2.1], false);
        check([3.0, 3.0, 1.0], true);
        check([3.1, 3.1, 1.0], true);
        check([5.1, 3.1, 1.0], false);
        check([-1.0, 2.0, 1.0], true);
        check([-1.1, 2.0, 1.0], false);
    }
}
