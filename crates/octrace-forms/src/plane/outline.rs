//! A region of the plane by its boundary.

use super::boolean::{Fill, region};
use super::curve::{angle, chords_per_turn, corners, edges, reversed, signed_area, sweep};
use super::{Affine2, PlaneError};
use crate::Tolerance;
use octrace::{Contour, Curve, Edge, Vec2};

/// A bounded region of the plane; maybe without a point.
///
/// Invariants: contours do not cross themselves or each other, but may touch; the region is to the left of each. So outer
/// contours are counter-clockwise and holes are clockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// The boundary.
    pub contours: Vec<Contour>,
}

impl Outline {
    /// The region without a point.
    pub const EMPTY: Self = Self { contours: Vec::new() };

    /// A disc about the origin; empty unless the radius is positive and finite.
    pub fn circle(radius: f64) -> Self {
        if !(radius > 0.0 && radius.is_finite()) {
            return Self::EMPTY;
        }
        Self { contours: vec![full_circle(Vec2::ZERO, radius)] }
    }

    /// A rectangle along the axes between two opposite corners; empty where it has no area.
    pub fn rectangle(a: Vec2, b: Vec2) -> Self {
        let (min, max) = (Vec2::new(a.x.min(b.x), a.y.min(b.y)), Vec2::new(a.x.max(b.x), a.y.max(b.y)));
        let area = (max.x - min.x) * (max.y - min.y);
        if !(area > 0.0 && area.is_finite()) {
            return Self::EMPTY;
        }
        Self { contours: vec![straight(&[min, Vec2::new(max.x, min.y), max, Vec2::new(min.x, max.y)])] }
    }

    /// What an odd number of closed polygons surround. They may cross, touch and repeat.
    ///
    /// # Errors
    /// See [`region`].
    pub fn polygon(paths: &[Vec<Vec2>]) -> Result<Self, PlaneError> {
        let contours: Vec<Contour> = paths.iter().map(|path| straight(path)).collect();
        region(&contours, Fill::EvenOdd)
    }

    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        self.contours.is_empty()
    }

    /// The area.
    pub fn area(&self) -> f64 {
        self.contours.iter().map(signed_area).sum()
    }

    /// Whether all edges are straight.
    pub fn is_polygon(&self) -> bool {
        self.contours.iter().flatten().all(|edge| edge.curve == Curve::Line)
    }

    /// Whether `p` is in the region. On the boundary the answer is one of the two.
    pub fn contains(&self, p: Vec2) -> bool {
        let turns = self.contours.iter().flat_map(edges).map(|(edge, to)| winding_angle(&edge, to, p));
        turns.sum::<f64>().abs() > std::f64::consts::PI
    }

    /// The region moved by `map`; empty where the map flattens it. Similarities keep arcs. Under other maps they become
    /// chords, at most the tolerance away from where they should be.
    pub fn moved(&self, map: &Affine2, tolerance: Tolerance) -> Self {
        if map.inverse().is_none() {
            return Self::EMPTY;
        }
        if *map == Affine2::IDENTITY {
            return self.clone();
        }
        let kept = if self.is_polygon() { Some((*map, 1.0)) } else { map.nearest_similarity() };
        let Some((map, factor)) = kept else {
            // Lengths grow at most by the longer column times the root of two.
            let stretch = map.x.length().max(map.y.length()) * std::f64::consts::SQRT_2;
            let size = self.bounds_moved(map).map_or(0.0, |b| b.diagonal());
            let chords = |radius: f64| chords_per_turn(radius, tolerance.relative * size / stretch);
            return self.with_chords(chords).moved(map, tolerance);
        };
        let mirrored = map.determinant() < 0.0;
        let edge = |edge: &Edge| {
            let curve = match edge.curve {
                Curve::Line => Curve::Line,
                Curve::Arc { center, radius, ccw } => {
                    Curve::Arc { center: map.point(center), radius: radius * factor, ccw: ccw != mirrored }
                }
            };
            Edge { from: map.point(edge.from), curve }
        };
        let contours = self.contours.iter().map(|contour| {
            let contour: Contour = contour.iter().map(edge).collect();
            if mirrored { reversed(&contour) } else { contour }
        });
        Self { contours: contours.collect() }
    }

    /// The region with chords for arcs, at most the tolerance away from them. The chords' corners are on the arcs.
    pub fn polygonised(&self, tolerance: Tolerance) -> Self {
        let size = self.bounds().map_or(0.0, |b| b.diagonal());
        self.with_chords(|radius| chords_per_turn(radius, tolerance.relative * size))
    }

    /// The region with chords for arcs, `per_turn` for a full circle: from 3 up to 16384.
    pub fn with_facets(&self, per_turn: u32) -> Self {
        self.with_chords(|_| per_turn.clamp(3, 16384) as usize)
    }

    fn with_chords(&self, per_turn: impl Fn(f64) -> usize) -> Self {
        let contour = |contour: &Contour| {
            let mut points = Vec::with_capacity(contour.len());
            edges(contour).for_each(|(edge, to)| corners(&edge, to, &per_turn, &mut points));
            straight(&points)
        };
        Self { contours: self.contours.iter().map(contour).filter(|c| c.len() > 2).collect() }
    }

    /// The region with its holes filled.
    pub fn filled(&self) -> Result<Self, PlaneError> {
        let outer: Vec<Contour> = self.contours.iter().filter(|c| signed_area(c) > 0.0).cloned().collect();
        region(&outer, Fill::NonZero)
    }
}

/// The contour with these corners and straight edges.
pub(crate) fn straight(corners: &[Vec2]) -> Contour {
    corners.iter().map(|&from| Edge { from, curve: Curve::Line }).collect()
}

/// A circle, counter-clockwise, as one edge.
pub(crate) fn full_circle(center: Vec2, radius: f64) -> Contour {
    let from = center + Vec2::new(radius, 0.0);
    vec![Edge { from, curve: Curve::Arc { center, radius, ccw: true } }]
}

/// The angle through which the edge is seen to turn from `p`.
fn winding_angle(edge: &Edge, to: Vec2, p: Vec2) -> f64 {
    let chord = |a: Vec2, b: Vec2| libm::atan2((a - p).cross(b - p), (a - p).dot(b - p));
    let Curve::Arc { center, radius, ccw } = edge.curve else { return chord(edge.from, to) };
    let turn = sweep(center, ccw, edge.from, to);
    let q = p - center;
    if q.dot(q) >= radius * radius {
        // From outside, an arc's view angle is that of its ends, halved until it is below half a turn.
        let quarter = |i: f64| center + super::curve::turned(edge.from - center, turn * i * 0.25);
        let points = [edge.from, quarter(1.0), quarter(2.0), quarter(3.0), to];
        return points.windows(2).map(|w| chord(w[0], w[1])).sum();
    }
    // From inside, the view turns the way the arc does.
    let seen = angle(to - p) - angle(edge.from - p);
    let tau = std::f64::consts::TAU;
    if edge.from == to {
        return turn;
    }
    match (ccw, seen < 0.0) {
        (true, true) => seen + tau,
        (false, false) => seen - tau,
        _ => seen,
    }
}
