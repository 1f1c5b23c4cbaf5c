//! Points that tell which circles a hull touches, and their hull.

use crate::plane::curve::{edges, sweep, turned};
use octrace::{Contour, Curve, Vec2};
use robust::{Coord, orient2d};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Chords of a full turn.
pub(super) const CHORDS_PER_TURN: f64 = 512.0;

/// A circle with the arcs of it that there are: from one point counter-clockwise to another, all of it where they are equal.
#[derive(Clone, Debug)]
pub(super) struct Circle {
    pub(super) center: Vec2,
    pub(super) radius: f64,
    pub(super) arcs: Vec<[Vec2; 2]>,
}

impl Circle {
    /// The point itself, of the circle, if it is on one of the arcs; the end of an arc if that is where it is, up to rounding.
    pub(super) fn covered(&self, p: Vec2) -> Option<Vec2> {
        let close = self.radius * 1e-9;
        if let Some(&end) = self.arcs.iter().flatten().find(|&&end| (end - p).length() <= close) {
            return Some(end);
        }
        let covers = |&[from, to]: &[Vec2; 2]| sweep(self.center, true, from, p) <= sweep(self.center, true, from, to);
        self.arcs.iter().any(covers).then_some(p)
    }

    /// Whether the way from one point counter-clockwise to another is no longer than between samples.
    pub(super) fn goes_on(&self, from: Vec2, to: Vec2) -> bool {
        from == to || sweep(self.center, true, from, to) < 1.5 * TAU / CHORDS_PER_TURN
    }
}

/// A point of the boundary, with the circle that it is on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) at: Vec2,
    pub(super) circle: Option<usize>,
}

/// Corners, and points of all arcs that bulge outwards.
pub(super) fn samples<'a>(contours: impl Iterator<Item = &'a Contour>) -> (Vec<Circle>, Vec<Sample>) {
    let mut circles: Vec<Circle> = Vec::new();
    let mut known = BTreeMap::new();
    let mut samples = Vec::new();
    for (edge, to) in contours.flat_map(edges) {
        samples.push(Sample { at: edge.from, circle: None });
        let Curve::Arc { center, radius, ccw: true } = edge.curve else { continue };
        let key = [center.x, center.y, radius].map(f64::to_bits);
        let index = *known.entry(key).or_insert_with(|| {
            circles.push(Circle { center, radius, arcs: Vec::new() });
            circles.len() - 1
        });
        circles[index].arcs.push([edge.from, to]);
        let turn = sweep(center, true, edge.from, to);
        let count = (turn / TAU * CHORDS_PER_TURN).ceil().max(2.0);
        let mut i = 0.0;
        while i <= count {
            // The ends are what they are, to the bit.
            let between = center + turned(edge.from - center, turn * (i / count));
            let at = if i == 0.0 {
                edge.from
            } else if i == count {
                to
            } else {
                between
            };
            samples.push(Sample { at, circle: Some(index) });
            i += 1.0;
        }
    }
    samples.retain(|sample| sample.at.x.is_finite() && sample.at.y.is_finite());
    (circles, samples)
}

pub(super) fn coord(p: Vec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// The corners of the convex hull, counter-clockwise, none on a line between others: Andrew's monotone chain.
pub(super) fn convex(mut samples: Vec<Sample>) -> Vec<Sample> {
    // Where points coincide one on a circle comes first and stays.
    let order = |s: &Sample| s.circle.unwrap_or(usize::MAX);
    let by_place = |a: &Sample, b: &Sample| a.at.x.total_cmp(&b.at.x).then(a.at.y.total_cmp(&b.at.y));
    samples.sort_by(|a, b| by_place(a, b).then(order(a).cmp(&order(b))));
    samples.dedup_by(|a, b| a.at == b.at);
    if samples.len() < 3 {
        return Vec::new();
    }
    let mut hull = chain(samples.iter().copied());
    hull.extend(chain(samples.iter().rev().copied()));
    hull
}

/// The right side of the hull of sorted points, without the last of them.
fn chain(samples: impl Iterator<Item = Sample>) -> Vec<Sample> {
    let mut chain: Vec<Sample> = Vec::new();
    for next in samples {
        while let [.., a, b] = &chain[..] {
            if orient2d(coord(a.at), coord(b.at), coord(next.at)) > 0.0 {
                break;
            }
            chain.pop();
        }
        chain.push(next);
    }
    chain.pop();
    chain
}
