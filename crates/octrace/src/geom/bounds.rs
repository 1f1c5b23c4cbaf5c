//! Axis-aligned boxes.

use super::{Affine, Vec3};

/// An axis-aligned box, possibly empty, possibly unbounded. Empty where some `min` exceeds its `max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub min: Vec3,
    /// The corner with the largest coordinates.
    pub max: Vec3,
}

impl Bounds {
    /// The box without a point.
    pub const EMPTY: Self = Self { min: Vec3::splat(f64::INFINITY), max: Vec3::splat(f64::NEG_INFINITY) };
    /// All of space.
    pub const ALL: Self = Self { min: Vec3::splat(f64::NEG_INFINITY), max: Vec3::splat(f64::INFINITY) };

    /// The box with these two corners, `min` first.
    pub const fn new(min: Vec3, max: Vec3) -> Self {
        Self { min, max }
    }

    /// The smallest box around some points.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Self { min: b.min.min(p), max: b.max.max(p) })
    }

    /// Whether the box has no point.
    pub fn is_empty(&self) -> bool {
        !(self.min.x <= self.max.x && self.min.y <= self.max.y && self.min.z <= self.max.z)
    }

    /// Whether the box is more than a rectangle, a line or a point; never where it is empty.
    pub fn has_volume(&self) -> bool {
        self.min.x < self.max.x && self.min.y < self.max.y && self.min.z < self.max.z
    }

    /// Whether the point is in the box or on its surface.
    pub fn contains(&self, p: Vec3) -> bool {
        self.min.min(p) == self.min && self.max.max(p) == self.max
    }

    /// Whether the box is empty or has finite corners.
    pub fn is_bounded(&self) -> bool {
        self.is_empty() || (self.min.is_finite() && self.max.is_finite())
    }

    /// The smallest box around both.
    pub fn union(self, o: Self) -> Self {
        match (self.is_empty(), o.is_empty()) {
            (true, _) => o,
            (_, true) => self,
            _ => Self { min: self.min.min(o.min), max: self.max.max(o.max) },
        }
    }

    /// The box reaching so much farther in every direction; an empty one stays so.
    pub fn grown(self, by: f64) -> Self {
        if self.is_empty() { self } else { Self { min: self.min - Vec3::splat(by), max: self.max + Vec3::splat(by) } }
    }

    /// What both have in common.
    pub fn intersection(self, o: Self) -> Self {
        Self { min: self.min.max(o.min), max: self.max.min(o.max) }
    }

    /// The centre of a bounded box; NaN for an empty one.
    pub fn center(&self) -> Vec3 {
        (self.min + self.max) * 0.5
    }

    /// Edge lengths; zero for an empty box.
    pub fn size(&self) -> Vec3 {
        if self.is_empty() { Vec3::ZERO } else { self.max - self.min }
    }

    /// A bounded box cut in two across its longest edge.
    pub fn halves(&self) -> [Self; 2] {
        let longest = self.size().largest_axis();
        let (mut low, mut high) = (*self, *self);
        low.max[longest] = self.center()[longest];
        high.min[longest] = self.center()[longest];
        [low, high]
    }

    /// Length of the diagonal; zero for an empty box.
    pub fn diagonal(&self) -> f64 {
        self.size().length()
    }

    /// The box around the image of this one under `map`. An unbounded box becomes all of space.
    pub fn transformed(&self, map: &Affine) -> Self {
        if self.is_empty() {
            return Self::EMPTY;
        }
        if !self.is_bounded() {
            return Self::ALL;
        }
        let corner = |i: usize| {
            Vec3::new(
                if i & 1 == 0 { self.min.x } else { self.max.x },
                if i & 2 == 0 { self.min.y } else { self.max.y },
                if i & 4 == 0 { self.min.z } else { self.max.z },
            )
        };
        Self::around((0..8).map(|i| map.point(corner(i))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_is_neutral_in_unions() {
        let unit = Bounds::new(Vec3::ZERO, Vec3::splat(1.0));
        assert_eq!(unit.union(Bounds::EMPTY), unit);
        assert_eq!(Bounds::EMPTY.union(unit), unit);
        assert!(unit.intersection(Bounds::EMPTY).is_empty());
        assert!(!Bounds::ALL.is_bounded());
    }
}
