//! Affine maps of the plane.

use octrace::{Affine, Vec2};
use std::ops::Mul;

/// An affine map of the plane: `p` goes to `p.x * x + p.y * y + translation`. `a * b` first does `b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine2 {
    /// Where the unit vector along x goes.
    pub x: Vec2,
    /// Where the unit vector along y goes.
    pub y: Vec2,
    /// Where the origin goes.
    pub translation: Vec2,
}

impl Affine2 {
    /// The map that moves nothing.
    pub const IDENTITY: Self = Self { x: Vec2::new(1.0, 0.0), y: Vec2::new(0.0, 1.0), translation: Vec2::ZERO };

    /// Moves everything by `v`.
    pub const fn translation(v: Vec2) -> Self {
        Self { translation: v, ..Self::IDENTITY }
    }

    /// Scales about the origin, by axis. A zero factor makes the map singular.
    pub const fn scale(by: Vec2) -> Self {
        Self { x: Vec2::new(by.x, 0.0), y: Vec2::new(0.0, by.y), translation: Vec2::ZERO }
    }

    /// What a map of space does to the x and y of points in the plane z = 0; where they go along z is dropped.
    pub fn of_space(map: &Affine) -> Self {
        let column = |axis| {
            let c = map.column(axis);
            Vec2::new(c.x, c.y)
        };
        Self { x: column(0), y: column(1), translation: Vec2::new(map.translation.x, map.translation.y) }
    }

    /// Where the point `p` goes.
    pub fn point(&self, p: Vec2) -> Vec2 {
        self.vector(p) + self.translation
    }

    /// Where the direction `d` goes; its length counts.
    pub fn vector(&self, d: Vec2) -> Vec2 {
        self.x * d.x + self.y * d.y
    }

    /// The factor by which areas grow, negative where the map mirrors.
    pub fn determinant(&self) -> f64 {
        self.x.cross(self.y)
    }

    /// The map that undoes this one; `None` where there is none to working precision or a number is not finite.
    pub fn inverse(&self) -> Option<Self> {
        let det = self.determinant();
        let area = self.x.length() * self.y.length();
        if !(self.is_finite() && det.is_finite() && area.is_finite()) || det.abs() <= area * 1e-14 {
            return None;
        }
        let linear = Self {
            x: Vec2::new(self.y.y, -self.x.y) * (1.0 / det),
            y: Vec2::new(-self.y.x, self.x.x) * (1.0 / det),
            translation: Vec2::ZERO,
        };
        let inverse = Self { translation: -linear.vector(self.translation), ..linear };
        inverse.is_finite().then_some(inverse)
    }

    /// The factor by which all lengths grow, where it is the same in all directions; mirrors are similarities too.
    ///
    /// Matrices in files have six digits, so what differs by less than [`Self::UNEVEN`] is the same.
    pub fn similarity(&self) -> Option<f64> {
        self.nearest_similarity().map(|(_, factor)| factor)
    }

    /// The similarity that a map with the digits of a file stands for, and the factor by which its lengths grow.
    pub(crate) fn nearest_similarity(&self) -> Option<(Self, f64)> {
        let (x, y) = (self.x.length(), self.y.length());
        let factor = self.determinant().abs().sqrt();
        let skew = self.x.dot(self.y).abs();
        let even = (x - y).abs() <= Self::UNEVEN * factor && skew <= Self::UNEVEN * factor * factor;
        if !(even && factor > 0.0 && factor.is_finite()) {
            return None;
        }
        // What turns and scales at once has columns (a, b) and (-b, a), mirrored (b, -a).
        let sign = if self.determinant() < 0.0 { -1.0 } else { 1.0 };
        let column = Vec2::new((self.x.x + sign * self.y.y) * 0.5, (self.x.y - sign * self.y.x) * 0.5);
        Some((Self { x: column, y: column.left() * sign, translation: self.translation }, column.length()))
    }

    /// How far, as a share, a map may stretch one direction more than another and still keep circles circles.
    pub const UNEVEN: f64 = 1e-5;

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        [self.x, self.y, self.translation].iter().all(|v| v.x.is_finite() && v.y.is_finite())
    }
}

impl Mul for Affine2 {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self { x: self.vector(o.x), y: self.vector(o.y), translation: self.point(o.translation) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::Vec3;

    const SHEAR: Affine2 =
        Affine2 { x: Vec2::new(2.0, 0.0), y: Vec2::new(1.0, 1.0), translation: Vec2::new(3.0, -1.0) };

    #[test]
    fn an_inverse_undoes_and_flat_maps_have_none() {
        let p = Vec2::new(5.0, 7.0);
        assert_eq!(SHEAR.inverse().map(|i| i.point(SHEAR.point(p))), Some(p));
        assert_eq!((SHEAR.inverse().expect("it is invertible") * SHEAR).x, Vec2::new(1.0, 0.0));
        assert_eq!(Affine2::scale(Vec2::new(1.0, 0.0)).inverse(), None);
        assert_eq!(Affine2::scale(Vec2::new(f64::NAN, 1.0)).inverse(), None);
    }

    #[test]
    fn turns_and_mirrors_are_similarities_shears_are_not() {
        let turn = Affine2::of_space(&Affine::rotation_deg(Vec3::new(0.0, 0.0, 30.0)));
        assert!((turn.similarity().expect("a turn") - 1.0).abs() < 1e-15);
        assert_eq!(Affine2::scale(Vec2::new(-2.0, 2.0)).similarity(), Some(2.0));
        assert_eq!(Affine2::scale(Vec2::new(2.0, 2.001)).similarity(), None);
        assert_eq!(SHEAR.similarity(), None);
        assert_eq!(Affine2::scale(Vec2::ZERO).similarity(), None);
    }
}
