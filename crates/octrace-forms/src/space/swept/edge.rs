//! Edges of contours: arcs as angles, as corners, and what crosses a height.

use crate::space::round::fragments;
use octrace::geom::sin_cos_deg;
use octrace::{Contour, Curve, Edge, Vec2};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// An edge as it is walked: from, to, and the curve.
#[derive(Clone, Copy, Debug)]
pub(in crate::space) struct Walk {
    pub from: Vec2,
    pub to: Vec2,
    pub curve: Curve,
}

impl Walk {
    /// Angle at which an arc starts, and how far it goes, counter-clockwise positive (radians); `None` for lines.
    pub fn sweep(&self) -> Option<(f64, f64)> {
        let Curve::Arc { center, ccw, .. } = self.curve else { return None };
        let angle = |p: Vec2| libm::atan2(p.y - center.y, p.x - center.x);
        let (start, end) = (angle(self.from), angle(self.to));
        let ahead = if ccw { end - start } else { start - end };
        // An edge that comes back to where it started is the whole circle.
        let ahead = if self.from == self.to { TAU } else { ahead.rem_euclid(TAU) };
        Some((start, if ccw { ahead } else { -ahead }))
    }

    /// The direction, of length one, in which it starts.
    pub fn tangent_at_start(&self) -> Vec2 {
        self.tangent(self.from)
    }

    /// The direction, of length one, in which it ends.
    pub fn tangent_at_end(&self) -> Vec2 {
        self.tangent(self.to)
    }

    fn tangent(&self, at: Vec2) -> Vec2 {
        let along = match self.curve {
            Curve::Arc { center, ccw, .. } => {
                let side = at - center;
                if ccw { Vec2::new(-side.y, side.x) } else { Vec2::new(side.y, -side.x) }
            }
            Curve::Line => self.to - self.from,
        };
        along * (1.0 / along.dot(along).sqrt())
    }

    /// Whether an arc has the point of its circle at this angle (radians).
    pub fn has(&self, angle: f64) -> bool {
        let Some((start, ahead)) = self.sweep() else { return false };
        let turned = if ahead > 0.0 { angle - start } else { start - angle };
        turned.rem_euclid(TAU) <= ahead.abs()
    }

    /// The point that is the farthest to the left, or a corner.
    pub fn leftmost(&self) -> f64 {
        match self.curve {
            Curve::Arc { center, radius, .. } if self.has(PI) => center.x - radius,
            _ => self.from.x,
        }
    }

    /// The point that is the farthest to the right, or a corner.
    pub fn rightmost(&self) -> f64 {
        match self.curve {
            Curve::Arc { center, radius, .. } if self.has(0.0) => center.x + radius,
            _ => self.from.x,
        }
    }

    /// Where the edge crosses a height, by x. `is_behind` says on which side of it a y is.
    pub fn crossings(&self, height: f64, is_behind: impl Fn(f64) -> bool) -> Vec<f64> {
        let (p, q) = (self.from, self.to);
        let Curve::Arc { center, radius, ccw } = self.curve else {
            let crosses = is_behind(p.y) != is_behind(q.y);
            let share = ((height - p.y) / (q.y - p.y)).clamp(0.0, 1.0);
            return crosses.then_some(p.x + (q.x - p.x) * share).into_iter().collect();
        };
        // Walked up and down by turns, from one end or turning point to the next.
        let Some((start, ahead)) = self.sweep() else { return Vec::new() };
        let turning = |angle: f64| {
            let turned = if ccw { angle - start } else { start - angle };
            let turned = turned.rem_euclid(TAU);
            (0.0 < turned && turned < ahead.abs()).then_some(turned)
        };
        let mut stops: Vec<(f64, f64)> = [(FRAC_PI_2, radius), (-FRAC_PI_2, -radius)]
            .into_iter()
            .filter_map(|(angle, rise)| Some((turning(angle)?, center.y + rise)))
            .collect();
        stops.push((0.0, p.y));
        stops.push((ahead.abs(), q.y));
        stops.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let across = (radius * radius - (height - center.y) * (height - center.y)).max(0.0).sqrt();
        let crossing = |pair: &[(f64, f64)]| {
            let middle = 0.5 * (pair[0].0 + pair[1].0);
            let right = libm::cos(start + if ccw { middle } else { -middle }) > 0.0;
            let crosses = is_behind(pair[0].1) != is_behind(pair[1].1);
            crosses.then_some(if right { center.x + across } else { center.x - across })
        };
        stops.windows(2).filter_map(crossing).collect()
    }

    /// Corners in place of the edge, its end left out: an arc gets points a little outside of it, so that areas are right.
    pub fn flatten(&self, deviation: f64, corners: &mut Vec<Vec2>) {
        let (Some((start, ahead)), Curve::Arc { center, radius, .. }) = (self.sweep(), self.curve) else {
            corners.push(self.from);
            return;
        };
        let n = fragments(radius, deviation);
        let (steps, whole) = ((f64::from(n) * ahead.abs() / TAU).ceil().max(1.0), ahead.abs() == TAU);
        // Of the sectors between corners, with the area of those of the circle.
        let step = (ahead / steps).abs();
        let outside = radius * if step < FRAC_PI_2 { (step / libm::sin(step)).sqrt() } else { 1.0 };
        if !whole {
            corners.push(self.from);
        }
        let first = if whole { 0 } else { 1 };
        corners.extend((first..steps as u32).map(|i| {
            let (s, c) = sin_cos_deg((start + ahead * (f64::from(i) / steps)).to_degrees());
            center + Vec2::new(c, s) * outside
        }));
    }
}

/// The edges of a contour, each with where it ends.
pub(in crate::space) fn walk(contour: &Contour) -> impl Iterator<Item = Walk> + '_ {
    let next = contour.iter().cycle().skip(1);
    contour.iter().zip(next).map(|(&Edge { from, curve }, next)| Walk { from, to: next.from, curve })
}

/// The contours as polygons whose edges are within `deviation` of them, with the same areas.
pub(super) fn flattened(contours: &[Contour], deviation: f64) -> Vec<Vec<Vec2>> {
    let polygon = |contour: &Contour| {
        let mut corners = Vec::new();
        walk(contour).for_each(|edge| edge.flatten(deviation, &mut corners));
        corners
    };
    contours.iter().map(polygon).collect()
}

/// The larger side of the box around the contours, roughly.
pub(super) fn size(contours: &[Contour]) -> f64 {
    let mut reach = (Vec2::new(f64::INFINITY, f64::INFINITY), Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
    for p in flattened(contours, f64::INFINITY).concat() {
        reach.0 = Vec2::new(reach.0.x.min(p.x), reach.0.y.min(p.y));
        reach.1 = Vec2::new(reach.1.x.max(p.x), reach.1.y.max(p.y));
    }
    (reach.1.x - reach.0.x).max(reach.1.y - reach.0.y).max(0.0)
}

/// The part of a polygon with x >= 0.
pub(super) fn right_of_axis(polygon: &[Vec2]) -> Vec<Vec2> {
    let mut kept = Vec::with_capacity(polygon.len() + 2);
    let next = polygon.iter().cycle().skip(1);
    for (&p, &q) in polygon.iter().zip(next) {
        if p.x >= 0.0 {
            kept.push(p);
        }
        if (p.x < 0.0) != (q.x < 0.0) {
            kept.push(Vec2::new(0.0, p.y + (q.y - p.y) * (p.x / (p.x - q.x))));
        }
    }
    kept
}
