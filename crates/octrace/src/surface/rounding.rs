//! How far off a surface its points may be by rounding.

use super::{Plane, Quadric, Surface, Torus};
use crate::geom::{Affine, Vec3};

impl Surface {
    /// How far rounding may put the point `p` of a simple surface off it, to first order and in units of
    /// [`f64::EPSILON`]; `reach` is the sum of the magnitudes of what the point's coordinates were computed from. Relative to
    /// the numbers that matter there, which the scene's size is not. No number, or infinite, where nothing is known.
    pub fn rounding(&self, p: Vec3, reach: Vec3) -> f64 {
        match self {
            Self::Plane(plane) => plane.rounding(reach),
            Self::Quadric(quadric) => quadric.rounding(p, reach),
            Self::Torus(torus) => torus.rounding(p, reach),
            Self::Mesh(_) | Self::Placed(_) => f64::INFINITY,
        }
    }
}

impl Plane {
    /// See [`Surface::rounding`].
    pub(crate) fn rounding(&self, reach: Vec3) -> f64 {
        self.normal.abs().dot(reach) + self.offset.abs()
    }
}

impl Quadric {
    /// See [`Surface::rounding`]: what the coordinates' roundings make of `f`, by its slope.
    fn rounding(&self, p: Vec3, reach: Vec3) -> f64 {
        let (s, c0) = self.kind.coefficients();
        let q = self.to_local.point(p);
        let slope = Vec3::new(2.0 * q.x, 2.0 * q.y, 2.0 * s * q.z);
        let off = slope.abs().dot(reach_of(&self.to_local, reach)) + c0.abs();
        off / self.to_local.transposed_vector(slope).length()
    }
}

impl Torus {
    /// See [`Surface::rounding`].
    fn rounding(&self, p: Vec3, reach: Vec3) -> f64 {
        let slope = self.local_gradient(p);
        let own = Vec3::splat(1.0 + self.minor);
        slope.abs().dot(reach_of(&self.to_local, reach) + own) / self.to_local.transposed_vector(slope).length()
    }
}

/// The sum of the magnitudes of what coordinates are computed from, behind a map.
fn reach_of(map: &Affine, reach: Vec3) -> Vec3 {
    Vec3::from(map.rows.map(|row| row.abs().dot(reach))) + map.translation.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::QuadricKind;

    #[test]
    fn what_is_far_or_large_is_rounded_more() {
        let ball = |radius: f64, center: Vec3| {
            let to_local = (Affine::translation(center) * Affine::scale(Vec3::splat(radius))).inverse();
            Surface::Quadric(Quadric { kind: QuadricKind::Sphere, to_local: to_local.expect("it has a size") })
        };
        let at = |surface: Surface, p: Vec3| surface.rounding(p, p.abs());
        let near = at(ball(1.0, Vec3::ZERO), Vec3::X);
        assert!((1.0..2.0).contains(&near), "{near}");
        let far = at(ball(1.0, Vec3::new(1e6, 0.0, 0.0)), Vec3::new(1e6 + 1.0, 0.0, 0.0));
        assert!((1e6..4e6).contains(&far), "{far}");
        // A ball as large as a planet, that ends at the origin.
        let large = at(ball(1e6, Vec3::new(-1e6, 0.0, 0.0)), Vec3::ZERO);
        assert!((0.5e6..4e6).contains(&large), "{large}");
        let floor = Surface::Plane(Plane { normal: Vec3::Z, offset: 0.25 });
        assert_eq!(at(floor, Vec3::new(1e9, 0.0, 0.25)), 0.5, "what is along a plane does not matter");
    }
}
