//! Tori: rings of one radius all around, moved by any affine map.

use super::{CellBox, Crossings, Side};
use crate::geom::{Affine, Ray, Vec3};
use crate::num::{Precision, bracketed_root, cubic_roots};

/// Which part of a torus' surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TorusKind {
    /// What the ball sweeps: all points nearer than `minor` to the circle of radius 1 about the z axis in the plane z = 0.
    Outer,
    /// The lemon-shaped surface inside a torus with `minor > 1`: all points nearer than `minor` to *every* point of that
    /// circle. (For these, the *farthest* one is what counts below.)
    Inner,
}

impl TorusKind {
    /// Where the circle passes through the half-plane in which a point is: on the point's side of the axis, or beyond.
    pub(crate) fn ring(self) -> f64 {
        match self {
            Self::Outer => 1.0,
            Self::Inner => -1.0,
        }
    }
}

/// A torus or its inner surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// Which part of the surface.
    pub kind: TorusKind,
    /// Radius of the tube.
    pub minor: f64,
    /// From scene space to the torus' own coordinates.
    pub to_local: Affine,
}

/// A line in the torus' coordinates: `near + s along`, with the unit vector `along`, from the point nearest to the centre.
struct Line {
    near: Vec3,
    along: Vec3,
    minor: f64,
    /// See [`TorusKind::ring`].
    ring: f64,
}

impl Line {
    /// `g = (ρ - 1)² + z² - minor²`, negative inside, with `ρ² = x² + y²`; and Newton's step to where it is zero.
    ///
    /// With `h = (ρ + 1)² + z² - minor²` the torus' polynomial is `f = g h`. The zeros of `h` are the inner surface; there `h`
    /// takes the place of `g`. And where rounding makes `f` lose the thin tubes, `g` keeps them.
    fn value(&self, s: f64) -> (f64, f64) {
        let p = self.near + self.along * s;
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        let from_ring = rho - self.ring;
        let value = from_ring * from_ring + p.z * p.z - self.minor * self.minor;
        let outwards = p.x * self.along.x + p.y * self.along.y;
        // Half the slope, times ρ.
        let slope = from_ring * outwards + p.z * self.along.z * rho;
        (value, -value * rho / (2.0 * slope))
    }

    /// The stretch in the ball and in the slab around the torus; `None` where they are missed, or touched only.
    fn range(&self) -> Option<(f64, f64)> {
        let outer = self.ring + self.minor;
        let reach = match outer > 0.0 {
            // The tips of the inner surface are farther from the middle than its equator.
            true if self.ring < 0.0 => (outer * (self.minor + 1.0) - self.near.dot(self.near)).max(0.0).sqrt(),
            true => (outer * outer - self.near.dot(self.near)).max(0.0).sqrt(),
            false => return None,
        };
        let (mut lo, mut hi) = (-reach, reach);
        if self.along.z == 0.0 {
            if self.near.z.abs() >= self.minor {
                return None;
            }
        } else {
            let ends = [(-self.minor - self.near.z) / self.along.z, (self.minor - self.near.z) / self.along.z];
            lo = lo.max(ends[0].min(ends[1]));
            hi = hi.min(ends[0].max(ends[1]));
        }
        (lo < hi).then_some((lo, hi))
    }
}

impl Torus {
    /// See [`Surface::crossings`](super::Surface::crossings). A line that only touches, to working precision, crosses
    /// nothing.
    ///
    /// The parameters at which `f` turns are the roots of a cubic. Between two of them `f` has one root at most, and so
    /// has `g` (see `Line::value`), whose sign at the turns tells whether: it is the surface itself that decides, not
    /// the coefficients of a polynomial.
    pub fn crossings(&self, ray: &Ray) -> Crossings {
        let (origin, direction) = (self.to_local.point(ray.origin), self.to_local.vector(ray.direction));
        let length = direction.length();
        let t_near = -origin.dot(direction) / (length * length);
        let near = origin + direction * t_near;
        let line = Line { near, along: direction / length, minor: self.minor, ring: self.kind.ring() };
        let Some((lo, hi)) = line.range() else {
            return Crossings::none(false);
        };

        // f(s) = (s² + k)² - 4 (a s² + 2 b s + c), since `near` is perpendicular to `along`.
        let along = line.along;
        let k = near.dot(near) + (1.0 - self.minor) * (1.0 + self.minor);
        let a = along.x * along.x + along.y * along.y;
        let b = near.x * along.x + near.y * along.y;
        let size = 1.0 + self.minor;
        // Where f turns it is flat, so its sign there is that of a place nearby.
        let tolerance = 1e-10 * size;
        let (turns, count) = cubic_roots(k - 2.0 * a, -2.0 * b, (lo, hi), Precision { tolerance, noise: 0.0 });

        // Points are computed to a few roundings of the coordinates that go into them, and g has the slope 2 minor. A
        // turn where g is zero to that precision touches the surface, or is itself the root of a longer stretch.
        let rounding = 2.0 * self.minor * (4.0 * f64::EPSILON);
        let touch = rounding * (size + origin.max_abs());
        let precision = Precision { tolerance: f64::EPSILON / 16.0 * size, noise: rounding * size };
        let mut crossings = Crossings::none(false);
        let (mut from, mut value_from, mut inside) = (lo, line.value(lo).0, false);
        for (i, s) in turns[..count].iter().copied().chain(std::iter::once(hi)).enumerate() {
            let value = line.value(s).0;
            // The ball and the slab end outside.
            let is_end = i == count;
            if !is_end && value.abs() <= touch {
                continue;
            }
            if (!is_end && value < 0.0) != inside {
                // As if g were a parabola that turns at an end where f does.
                let start = match is_end {
                    true => from + (s - from) * (value_from / (value_from - value)).sqrt(),
                    false => s - (s - from) * (value / (value - value_from)).sqrt(),
                };
                let root = bracketed_root(|s| line.value(s), (from, s), start, inside, precision);
                crossings.push(t_near + root / length);
                inside = !inside;
            }
            (from, value_from) = (s, value);
        }
        crossings
    }

    /// See [`Surface::classify`](super::Surface::classify).
    ///
    /// In local coordinates the cell is a parallelepiped `q + sum u_i e_i`, `|u_i| <= 1`. Three enclosures of the distance
    /// from the ring's circle are intersected: by the ball around the cell, since no distance changes faster than the
    /// place; by interval arithmetic on the coordinates; and by the slope at `q` with a bound of the curvature.
    pub fn classify(&self, cell: &CellBox) -> Side {
        let q = self.to_local.point(cell.center);
        let ring = self.kind.ring();
        let rho = (q.x * q.x + q.y * q.y).sqrt();
        let distance = ring_distance(rho - ring, q.z);
        let edges = [0, 1, 2].map(|axis| self.to_local.column(axis) * cell.half[axis]);
        let corners = [
            edges[0] + edges[1] + edges[2],
            edges[0] + edges[1] - edges[2],
            edges[0] - edges[1] + edges[2],
            edges[0] - edges[1] - edges[2],
        ];
        let (reach, rounding) = cell.reach(&self.to_local.rows);
        let radius = corners.iter().map(|c| c.length()).fold(0.0, f64::max) + rounding.length();
        let (mut low, mut high) = (distance - radius, distance + radius);

        // The distance's second derivatives are 1/distance across the tube and at most 1/ρ in magnitude around the ring.
        let least_rho = rho - radius;
        if least_rho > 0.0 && low > 0.0 {
            let normal = ring_normal(q, rho, ring) / distance;
            let slope: f64 = edges.iter().map(|edge| normal.dot(*edge).abs()).sum::<f64>() + rounding.length();
            let bend = radius * radius / 2.0;
            let fine = (distance - slope - bend / least_rho, distance + slope + bend / low.min(least_rho));
            (low, high) = (low.max(fine.0), high.min(fine.1));
        }

        let least = Vec3::new(q.x.abs(), q.y.abs(), q.z.abs()) - reach;
        let most = q.abs() + reach;
        let (rho_low, rho_high) = (flat_length(least.x.max(0.0), least.y.max(0.0)), flat_length(most.x, most.y));
        let from_ring = (rho_low - ring).max(ring - rho_high).max(0.0);
        low = low.max(flat_length(from_ring, least.z.max(0.0)));
        high = high.min(flat_length((rho_high - ring).max(ring - rho_low), most.z));

        if low >= self.minor {
            Side::Outside
        } else if high <= self.minor {
            Side::Inside
        } else {
            Side::Crossing
        }
    }

    /// See [`Surface::gradient`](super::Surface::gradient). Zero on the ring's circle.
    pub fn gradient(&self, p: Vec3) -> Vec3 {
        self.to_local.transposed_vector(self.local_gradient(p))
    }

    /// The same in the torus' own coordinates.
    pub(super) fn local_gradient(&self, p: Vec3) -> Vec3 {
        let q = self.to_local.point(p);
        ring_normal(q, flat_length(q.x, q.y), self.kind.ring()) * 2.0
    }

    /// See [`Surface::distance`](super::Surface::distance).
    pub fn distance(&self, p: Vec3) -> f64 {
        let q = self.to_local.point(p);
        let distance = ring_distance(flat_length(q.x, q.y) - self.kind.ring(), q.z);
        let off = (distance - self.minor).abs();
        // The gradient is that of the squared distance.
        if off == 0.0 { 0.0 } else { off * (2.0 * distance) / self.gradient(p).length() }
    }
}

fn flat_length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// Distance from the ring's circle, which is `from_ring` away across the axis.
fn ring_distance(from_ring: f64, z: f64) -> f64 {
    flat_length(from_ring, z)
}

/// From the point of the ring's circle that counts to `q`; along z only where `q` is on the axis and all are equally near.
fn ring_normal(q: Vec3, rho: f64, ring: f64) -> Vec3 {
    let outwards = if rho > 0.0 { (rho - ring) / rho } else { 0.0 };
    Vec3::new(q.x * outwards, q.y * outwards, q.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn params(minor: f64, origin: [f64; 3], direction: [f64; 3]) -> Vec<f64> {
        let crossings =
            Torus { kind: TorusKind::Outer, minor, to_local: Affine::IDENTITY }.crossings(&Ray::new(origin, direction));
        assert!(!crossings.starts_inside());
        crossings.params().to_vec()
    }

    #[test]
    fn a_line_in_the_plane_of_the_ring_crosses_four_times() {
        assert_eq!(params(0.5, [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0]), [2.5, 3.5, 4.5, 5.5]);
        assert_eq!(params(0.5, [0.0, 8.0, 0.0], [0.0, -2.0, 0.0]), [3.25, 3.75, 4.25, 4.75]);
    }

    #[test]
    fn a_line_along_the_axis_passes_through_the_hole() {
        assert_eq!(params(0.5, [0.0, 0.0, -4.0], [0.0, 0.0, 1.0]), []);
        assert_eq!(params(0.5, [0.25, 0.0, -4.0], [0.0, 0.0, 1.0]), []);
        assert_eq!(params(0.5, [1.0, 0.0, -4.0], [0.0, 0.0, 1.0]), [3.5, 4.5]);
    }

    #[test]
    fn a_touch_is_no_crossing() {
        // The outer equator, the inner one from inside the tube, the top circle, the rim of the hole.
        assert_eq!(params(0.5, [1.5, -4.0, 0.0], [0.0, 1.0, 0.0]), []);
        assert_eq!(params(0.5, [0.5, -4.0, 0.0], [0.0, 1.0, 0.0]).len(), 2);
        assert_eq!(params(0.5, [-4.0, 0.0, 0.5], [1.0, 0.0, 0.0]), []);
        assert_eq!(params(0.5, [0.5, 0.0, -4.0], [0.0, 0.0, 1.0]), []);
    }

    #[test]
    fn a_touch_is_none_at_any_angle() {
        for angle in 0..360 {
            let (sin, cos) = crate::geom::sin_cos_deg(f64::from(angle));
            let at = |radius: f64| [radius * cos + 4.0 * sin, radius * sin - 4.0 * cos, 0.0];
            assert_eq!(params(0.3, at(1.3), [-sin, cos, 0.0]), [], "outside, at {angle} degrees");
            assert_eq!(params(0.3, at(0.7), [-sin, cos, 0.0]).len(), 2, "at the rim of the hole, at {angle} degrees");
        }
    }

    #[test]
    fn a_line_that_touches_twice_crosses_nothing() {
        // Villarceau's plane: y = z / sqrt(3) touches the tube of minor 1/2 above and below; so does its line x = 0.
        let (sin, cos) = (0.5, 0.75_f64.sqrt());
        assert_eq!(params(0.5, [0.0, -4.0 * cos, -4.0 * sin], [0.0, cos, sin]), []);
    }

    #[test]
    fn a_spindle_has_no_surface_inside() {
        // On the axis the surface ends in dimples at z = ±sqrt(minor² - 1).
        let on_axis = params(1.25, [0.0, 0.0, -4.0], [0.0, 0.0, 1.0]);
        assert_eq!(on_axis.len(), 2);
        assert!((on_axis[0] - 3.25).abs() < 1e-15 && (on_axis[1] - 4.75).abs() < 1e-15, "{on_axis:?}");
        assert_eq!(params(1.25, [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0]), [1.75, 6.25]);
        assert_eq!(params(1.25, [-4.0, 0.0, 1.0], [1.0, 0.0, 0.0]).len(), 4, "across both dimples' rims");
    }

    #[test]
    fn the_inner_surface_is_a_lemon() {
        let lemon = Torus { kind: TorusKind::Inner, minor: 1.25, to_local: Affine::IDENTITY };
        let params = |origin: [f64; 3], direction: [f64; 3]| {
            let crossings = lemon.crossings(&Ray::new(origin, direction));
            assert!(!crossings.starts_inside());
            crossings.params().to_vec()
        };
        assert_eq!(params([-4.0, 0.0, 0.0], [1.0, 0.0, 0.0]), [3.75, 4.25], "the equator has the radius 1/4");
        let on_axis = params([0.0, 0.0, -4.0], [0.0, 0.0, 1.0]);
        assert_eq!(on_axis.len(), 2, "the tips are at z = ±3/4");
        assert!((on_axis[0] - 3.25).abs() < 1e-15 && (on_axis[1] - 4.75).abs() < 1e-15, "{on_axis:?}");
        assert_eq!(params([0.25, -4.0, 0.0], [0.0, 1.0, 0.0]), [], "a touch");
        assert_eq!(params([-4.0, 0.0, 0.75], [1.0, 0.0, 0.0]), [], "past the tip");
        assert_eq!(lemon.gradient(Vec3::X * 0.25).normalized(), Some(Vec3::X));
        let none = Torus { minor: 1.0, ..lemon };
        assert_eq!(none.crossings(&Ray::new([-4.0, 0.0, 0.0], [1.0, 0.0, 0.0])), Crossings::none(false));
    }

    #[test]
    fn a_horn_torus_closes_in_one_point() {
        assert_eq!(params(1.0, [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0]), [2.0, 6.0]);
        assert_eq!(params(1.0, [0.0, 0.0, -4.0], [0.0, 0.0, 1.0]), []);
    }

    #[test]
    fn gradients_point_outwards() {
        let torus = Torus { kind: TorusKind::Outer, minor: 0.5, to_local: Affine::scale(Vec3::splat(0.5)) };
        for (at, outwards) in [(Vec3::X * 3.0, Vec3::X), (Vec3::X, -Vec3::X), (Vec3::new(0.0, 2.0, -1.0), -Vec3::Z)] {
            assert_eq!(torus.gradient(at).normalized(), Some(outwards));
            assert_eq!(torus.distance(at), 0.0);
            assert!((torus.distance(at + outwards * 1e-3) - 1e-3).abs() < 1e-15);
        }
    }

    #[test]
    fn classification_is_right_for_cells_in_and_out() {
        let torus = Torus { kind: TorusKind::Outer, minor: 0.5, to_local: Affine::IDENTITY };
        let classify = |x: f64, half: f64| torus.classify(&CellBox::new(Vec3::X * x, Vec3::splat(half)));
        assert_eq!(classify(0.0, 0.3), Side::Outside, "in the hole");
        assert_eq!(classify(1.0, 0.28), Side::Inside);
        assert_eq!(classify(1.0, 0.4), Side::Crossing);
        assert_eq!(classify(2.0, 0.45), Side::Outside);
        assert_eq!(classify(1.5, 0.01), Side::Crossing);
        assert_eq!(classify(0.0, 9.0), Side::Crossing);
    }
}
