//! Minkowski sums of convex things, by corners, circles, balls and rings.

use super::convex::convex;
use super::hull::{STRIPS, square};
use super::round::{Extremes, Round};
use crate::Tolerance;
use octrace::Vec3;

impl Extremes {
    /// The sum of two convex things.
    pub fn plus(&self, other: &Self, tolerance: Tolerance) -> Self {
        let mut sum = Self::default();
        for &a in &self.points {
            sum.points.extend(other.points.iter().map(|&b| a + b));
            sum.rounds.extend(other.rounds.iter().map(|round| round.moved(a)));
        }
        for a in &self.rounds {
            sum.rounds.extend(other.points.iter().map(|&b| a.moved(b)));
            for b in &other.rounds {
                match a.plus(b) {
                    Some(round) => sum.rounds.push(round),
                    None => return self.with_corners(tolerance).plus(&other.with_corners(tolerance), tolerance),
                }
            }
        }
        sum
    }

    /// The same with corners only, within the tolerance.
    fn with_corners(&self, tolerance: Tolerance) -> Self {
        let (deviation, mut points) = (STRIPS * tolerance.relative * self.size(), self.points.clone());
        self.rounds.iter().for_each(|round| round.points_on(deviation, &mut points));
        Self { points: convex(&points).map_or(points, |p| p.points().to_vec()), rounds: Vec::new() }
    }
}

impl Round {
    fn moved(self, by: Vec3) -> Self {
        let mut moved = self;
        match &mut moved {
            Self::Ellipse { center, .. } | Self::Ellipsoid { center, .. } | Self::Ring { center, .. } => {
                *center += by;
            }
        }
        moved
    }

    /// The sum, where it is of one of these kinds.
    fn plus(&self, other: &Self) -> Option<Self> {
        let ball = |&[u, v, w]: &[Vec3; 3]| (square(u, v) && square(v, w) && square(u, w)).then(|| u.length());
        match (self, other) {
            (Self::Ellipsoid { center: a, axes: u }, Self::Ellipsoid { center: b, axes: v }) => {
                let larger = 1.0 + ball(v)? / ball(u)?;
                Some(Self::Ellipsoid { center: *a + *b, axes: u.map(|axis| axis * larger) })
            }
            (Self::Ellipse { center: a, axes: u }, Self::Ellipse { center: b, axes: v }) => {
                let (n, m) = (u[0].cross(u[1]).normalized()?, v[0].cross(v[1]).normalized()?);
                let parallel = n.cross(m).length() <= 1e-5;
                let larger = 1.0 + v[0].length() / u[0].length();
                (parallel && square(u[0], u[1]) && square(v[0], v[1]))
                    .then(|| Self::Ellipse { center: *a + *b, axes: u.map(|axis| axis * larger) })
            }
            (Self::Ellipse { center: a, axes: [u, v] }, Self::Ellipsoid { center: b, axes }) => {
                let minor = ball(axes)? / u.length();
                let axis = u.cross(*v).normalized()? * u.length();
                square(*u, *v).then_some(Self::Ring { center: *a + *b, axes: [*u, *v, axis], minor })
            }
            (Self::Ring { center: a, axes: [u, v, w], minor }, Self::Ellipsoid { center: b, axes }) => {
                let more = ball(axes)? / ball(&[*u, *v, *w])?;
                Some(Self::Ring { center: *a + *b, axes: [*u, *v, *w], minor: minor + more })
            }
            (Self::Ellipsoid { .. }, Self::Ellipse { .. } | Self::Ring { .. }) => other.plus(self),
            _ => None,
        }
    }
}
