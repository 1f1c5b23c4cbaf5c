//! Parts of a circle of directions that are left when others were cut away.

use std::f64::consts::{PI, TAU};

/// What is shorter than this (radians) is nothing: where four tangent points lie in a plane the surfaces along the
/// diagonals have directions of this width by rounding alone.
const SHORTEST: f64 = 1e-9;

/// A direction in the plane, with its angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Direction {
    pub cos: f64,
    pub sin: f64,
    /// Radians; which turn is for the arc to say.
    angle: f64,
}

impl Direction {
    /// The direction of an angle (radians).
    pub fn at(angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self { cos, sin, angle }
    }
}

/// A set of directions.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Arcs {
    /// All there are.
    Full,
    /// From the first to the second of each pair, counter-clockwise. The angle of the second is the larger one.
    Some(Vec<(Direction, Direction)>),
}

impl Arcs {
    /// Whether nothing is left.
    pub fn is_empty(&self) -> bool {
        matches!(self, Self::Some(arcs) if arcs.is_empty())
    }

    /// The set without a direction.
    pub const NONE: Self = Self::Some(Vec::new());

    /// Where the arcs start and end.
    pub fn ends(&self) -> impl Iterator<Item = Direction> {
        let arcs = match self {
            Self::Full => &[],
            Self::Some(arcs) => arcs.as_slice(),
        };
        arcs.iter().flat_map(|&(from, to)| [from, to])
    }

    /// The arcs by the angles (radians) of their starts and ends.
    pub fn spans(&self) -> Vec<(f64, f64)> {
        match self {
            Self::Full => vec![(0.0, TAU)],
            Self::Some(arcs) => arcs.iter().map(|(from, to)| (from.angle, to.angle)).collect(),
        }
    }

    /// Keeps the directions with `a cos + b sin <= c`. Numbers below `noise` are zero.
    pub fn keep(&mut self, a: f64, b: f64, c: f64, noise: f64) {
        let steepness = (a * a + b * b).sqrt();
        if c >= steepness - noise {
            return;
        }
        if c <= -steepness {
            *self = Self::NONE;
            return;
        }
        // The directions at the limit, by sines and not by angles, so that right angles are right.
        let (p, q, cos) = (a / steepness, b / steepness, c / steepness);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let (middle, half) = (libm::atan2(b, a), libm::acos(cos));
        let from = Direction { cos: cos * p - sin * q, sin: cos * q + sin * p, angle: middle + half };
        let to = Direction { cos: cos * p + sin * q, sin: cos * q - sin * p, angle: middle - half + TAU };
        let kept = match self {
            Self::Full => vec![(from, to)],
            Self::Some(arcs) => arcs.iter().flat_map(|&arc| common(arc, (from, to))).collect(),
        };
        *self = Self::Some(kept);
        if let Self::Some(arcs) = self {
            arcs.retain(|(from, to)| to.angle - from.angle > SHORTEST);
        }
    }
}

/// What two arcs have in common, in the turns of the first one: up to two arcs.
fn common(
    (from, to): (Direction, Direction),
    (other_from, other_to): (Direction, Direction),
) -> impl Iterator<Item = (Direction, Direction)> {
    let nearest = ((from.angle - other_from.angle) / TAU).round();
    [-1.0, 0.0, 1.0].into_iter().filter_map(move |turns| {
        let moved = |d: Direction| Direction { angle: d.angle + (nearest + turns) * TAU, ..d };
        let (a, b) = (moved(other_from), moved(other_to));
        let low = if a.angle > from.angle { a } else { from };
        let high = if b.angle < to.angle { b } else { to };
        (high.angle > low.angle).then_some((low, high))
    })
}

const _: () = assert!(SHORTEST < PI);

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether the direction of an angle is in the set.
    fn has(arcs: &Arcs, angle: f64) -> bool {
        match arcs {
            Arcs::Full => true,
            Arcs::Some(arcs) => arcs.iter().any(|(a, b)| {
                [-2.0, -1.0, 0.0, 1.0, 2.0].iter().any(|t| a.angle <= angle + t * TAU && angle + t * TAU <= b.angle)
            }),
        }
    }

    #[test]
    fn cuts_are_right_at_right_angles() {
        let mut arcs = Arcs::Full;
        arcs.keep(1.0, 0.0, 0.0, 0.0);
        arcs.keep(0.0, 1.0, 0.0, 0.0);
        let ends: Vec<(f64, f64)> = arcs.ends().map(|d| (d.cos, d.sin)).collect();
        assert_eq!(ends, [(-1.0, 0.0), (0.0, -1.0)]);
    }

    #[test]
    fn any_cuts_leave_what_passes_all_tests() {
        for seed in 0..400_u32 {
            let number = |k: u32| f64::from((seed * 7 + k * 13).wrapping_mul(2_654_435_769) >> 16 & 15) - 8.0;
            let cuts: Vec<[f64; 3]> =
                (0..4).map(|k| [number(3 * k), number(3 * k + 1), number(3 * k + 2).abs() * 0.9 - 1.0]).collect();
            let mut arcs = Arcs::Full;
            cuts.iter().for_each(|&[a, b, c]| arcs.keep(a, b, c, 0.0));
            for step in 0..360 {
                let d = Direction::at(f64::from(step) * 0.0174 - PI);
                let slack = cuts.iter().map(|[a, b, c]| c - a * d.cos - b * d.sin).fold(f64::INFINITY, f64::min);
                if slack.abs() > 1e-6 {
                    assert_eq!(has(&arcs, d.angle), slack > 0.0, "{cuts:?} at {}: {arcs:?}", d.angle);
                }
            }
        }
    }
}
