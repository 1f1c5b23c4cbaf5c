//! How far outlines reach.

use super::curve::{edges, sweep};
use super::{Affine2, Outline};
use octrace::{Curve, Edge, Vec2};

/// A rectangle along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds2 {
    /// The corner with the smallest coordinates.
    pub min: Vec2,
    /// The corner with the largest coordinates.
    pub max: Vec2,
}

impl Bounds2 {
    /// Lengths of the sides.
    pub fn size(&self) -> Vec2 {
        self.max - self.min
    }

    /// The length of the diagonal.
    pub fn diagonal(&self) -> f64 {
        self.size().length()
    }

    /// The smallest rectangle around both.
    pub fn union(self, o: Self) -> Self {
        Self {
            min: Vec2::new(self.min.x.min(o.min.x), self.min.y.min(o.min.y)),
            max: Vec2::new(self.max.x.max(o.max.x), self.max.y.max(o.max.y)),
        }
    }

    /// What is in both; `None` where that is nothing or only a line.
    pub fn intersection(self, o: Self) -> Option<Self> {
        let min = Vec2::new(self.min.x.max(o.min.x), self.min.y.max(o.min.y));
        let max = Vec2::new(self.max.x.min(o.max.x), self.max.y.min(o.max.y));
        (min.x < max.x && min.y < max.y).then_some(Self { min, max })
    }
}

/// The smallest and the largest of `direction · p` over an edge.
fn edge_extent(edge: &Edge, to: Vec2, direction: Vec2) -> (f64, f64) {
    let (a, b) = (direction.dot(edge.from), direction.dot(to));
    let (mut lo, mut hi) = (a.min(b), a.max(b));
    let Curve::Arc { center, radius, ccw } = edge.curve else { return (lo, hi) };
    let length = direction.length();
    if length == 0.0 {
        return (lo, hi);
    }
    let total = sweep(center, ccw, edge.from, to).abs();
    let top = direction * (radius / length);
    let reaches = |p: Vec2| total >= std::f64::consts::TAU || sweep(center, ccw, edge.from, p).abs() <= total;
    let middle = direction.dot(center);
    if reaches(center + top) {
        hi = hi.max(middle + radius * length);
    }
    if reaches(center - top) {
        lo = lo.min(middle - radius * length);
    }
    (lo, hi)
}

impl Outline {
    /// The smallest and the largest of `direction · p` over the region; `None` where it is empty.
    pub fn extent(&self, direction: Vec2) -> Option<(f64, f64)> {
        let parts = self.contours.iter().flat_map(edges).map(|(edge, to)| edge_extent(&edge, to, direction));
        parts.reduce(|(lo, hi), (l, h)| (lo.min(l), hi.max(h)))
    }

    /// The smallest rectangle around the region; `None` where it is empty.
    pub fn bounds(&self) -> Option<Bounds2> {
        self.bounds_moved(&Affine2::IDENTITY)
    }

    /// The smallest rectangle around the region after it was moved by `map`; `None` where it is empty.
    pub fn bounds_moved(&self, map: &Affine2) -> Option<Bounds2> {
        let (left, right) = self.extent(Vec2::new(map.x.x, map.y.x))?;
        let (low, high) = self.extent(Vec2::new(map.x.y, map.y.y))?;
        let at = map.translation;
        Some(Bounds2 { min: Vec2::new(left, low) + at, max: Vec2::new(right, high) + at })
    }
}
