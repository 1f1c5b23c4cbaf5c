//! Rays.

use super::{Affine, Vec3};

/// A half-line: the points `origin + t * direction` for `t >= 0`. The direction may have any non-zero length; `t` is a
/// distance only where that length is one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where the ray starts.
    pub origin: Vec3,
    /// Where it goes; finite and not zero.
    pub direction: Vec3,
}

impl Ray {
    /// The ray from `origin` along `direction`.
    ///
    /// # Panics
    /// If a number is not finite, or the direction is zero.
    pub fn new(origin: impl Into<Vec3>, direction: impl Into<Vec3>) -> Self {
        let (origin, direction) = (origin.into(), direction.into());
        Self::checked(origin, direction).expect("a ray needs a finite origin and a finite direction that is not zero")
    }

    /// The ray from `origin` along `direction`, or `None` where a number is not finite or the direction is zero.
    pub fn checked(origin: Vec3, direction: Vec3) -> Option<Self> {
        (origin.is_finite() && direction.is_finite() && direction != Vec3::ZERO).then_some(Self { origin, direction })
    }

    /// The point at parameter `t`.
    pub fn at(&self, t: f64) -> Vec3 {
        self.origin + self.direction * t
    }

    /// The same ray seen from another coordinate system; parameters stay what they are.
    pub fn transformed(&self, map: &Affine) -> Self {
        Self { origin: map.point(self.origin), direction: map.vector(self.direction) }
    }
}
