//! Whether a triangle touches a box, by separating axes [Akenine-Möller 2001].

use crate::geom::Vec3;

/// Whether the triangle and the box have a point in common. Degenerate triangles are segments and points.
pub(super) fn triangle_touches_box(corners: [Vec3; 3], center: Vec3, half_extents: Vec3) -> bool {
    let corners = corners.map(|p| p - center);
    let [a, b, c] = corners;
    let edges = [b - a, c - b, a - c];
    let touch_along = |axis: Vec3| {
        let reach = axis.abs().dot(half_extents);
        let along = corners.map(|p| axis.dot(p));
        along[0].min(along[1]).min(along[2]) <= reach && -reach <= along[0].max(along[1]).max(along[2])
    };
    let units = [Vec3::X, Vec3::Y, Vec3::Z];
    units.into_iter().all(touch_along)
        && touch_along(edges[0].cross(edges[1]))
        && units.into_iter().all(|unit| edges.into_iter().all(|edge| touch_along(unit.cross(edge))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn touching_counts() {
        let flat = [Vec3::new(0.0, 0.0, 1.0), Vec3::new(4.0, 0.0, 1.0), Vec3::new(0.0, 4.0, 1.0)];
        let check = |center: [f64; 3], expected: bool| {
            assert_eq!(triangle_touches_box(flat, center.into(), Vec3::splat(1.0)), expected, "{center:?}");
        };
        check([0.0, 0.0, 0.0], true);
        check([0.0, 0.0, 2.0], true);
        check([0.0, 0.0, 2.1], false);
        check([3.0, 3.0, 1.0], true);
        check([3.1, 3.1, 1.0], false);
        check([-1.0, 2.0, 1.0], true);
        check([-1.1, 2.0, 1.0], false);
    }
}
