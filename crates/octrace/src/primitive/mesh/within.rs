//! Between which parameters a line may cross a triangle that it is known to pass.

use crate::geom::{Bounds, Ray, Vec3};

/// The parameters for which the line is in the box grown by `slack`, which it is known to pass.
pub(super) fn reach(ray: &Ray, bounds: &Bounds, slack: f64) -> (f64, f64) {
    let slab = |axis: usize| {
        let (o, d) = (ray.origin[axis], ray.direction[axis]);
        let (a, b) = ((bounds.min[axis] - slack - o) / d, (bounds.max[axis] + slack - o) / d);
        (a.min(b), a.max(b))
    };
    let along = ray.direction.largest_axis();
    let (mut low, mut high) = slab(along);
    for (a, b) in [(along + 1) % 3, (along + 2) % 3].map(slab) {
        // Rounding may put a line beside the box, though only just. The interval never becomes empty, nor infinite.
        // Along a line parallel to the axis' planes these are infinite or NaN.
        if a.is_finite() && b.is_finite() {
            low = low.max(a).min(high);
            high = high.min(b).max(low);
        }
    }
    (low, high)
}

/// What is left of an interval of parameters between the triangle's edges, moved outwards by `slack`. For a line that all
/// but lies in the triangle's plane its box does not tell: the line may leave the triangle and still be in the box.
pub(super) fn within(ray: &Ray, corners: [Vec3; 3], slack: f64, (mut low, mut high): (f64, f64)) -> (f64, f64) {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    for i in 0..3 {
        // Positive on the triangle's side of the edge.
        let inwards = normal.cross(corners[(i + 1) % 3] - corners[i]);
        let slope = inwards.dot(ray.direction);
        let t = -(inwards.dot(ray.origin - corners[i]) + slack * inwards.length()) / slope;
        if t.is_finite() && slope > 0.0 {
            low = low.max(t).min(high);
        } else if t.is_finite() {
            high = high.min(t).max(low);
        }
    }
    (low, high)
}
