//! What there is to know of one edge of a contour: how far it turns, where its middle is, what area it adds.

use octrace::{Contour, Curve, Edge, Vec2};
use std::f64::consts::{PI, TAU};

/// The edges of a contour with the corners that they go to.
pub(crate) fn edges(contour: &Contour) -> impl Iterator<Item = (Edge, Vec2)> {
    let count = contour.len();
    (0..count).map(move |i| (contour[i], contour[if i + 1 == count { 0 } else { i + 1 }].from))
}

/// The angle of a direction, from -π to π.
pub(crate) fn angle(d: Vec2) -> f64 {
    libm::atan2(d.y, d.x)
}

/// The angle through which one turns on a circle about `center` from `from` to `to`: positive to the left, negative to the
/// right, a full turn where the two are the same point.
pub(crate) fn sweep(center: Vec2, ccw: bool, from: Vec2, to: Vec2) -> f64 {
    if from == to {
        return if ccw { TAU } else { -TAU };
    }
    let (a, b) = (from - center, to - center);
    let turn = libm::atan2(a.cross(b), a.dot(b));
    match (ccw, turn < 0.0) {
        (true, true) => turn + TAU,
        (false, false) => turn - TAU,
        _ => turn,
    }
}

/// `v` turned to the left by an angle.
pub(crate) fn turned(v: Vec2, angle: f64) -> Vec2 {
    let (s, c) = libm::sincos(angle);
    Vec2::new(c * v.x - s * v.y, s * v.x + c * v.y)
}

/// The area that a contour surrounds, negative where it is clockwise.
pub(crate) fn signed_area(contour: &Contour) -> f64 {
    // About a corner, so that nothing cancels far from the origin.
    let Some(origin) = contour.first().map(|edge| edge.from) else { return 0.0 };
    let double = |(edge, to): (Edge, Vec2)| {
        let chord = (edge.from - origin).cross(to - origin);
        match edge.curve {
            Curve::Line => chord,
            Curve::Arc { center, radius, ccw } => {
                let turn = sweep(center, ccw, edge.from, to);
                chord + radius * radius * (turn - libm::sin(turn))
            }
        }
    };
    edges(contour).map(double).sum::<f64>() * 0.5
}

/// The contour walked the other way.
pub(crate) fn reversed(contour: &Contour) -> Contour {
    let mut result: Contour = edges(contour)
        .map(|(edge, to)| {
            let curve = match edge.curve {
                Curve::Line => Curve::Line,
                Curve::Arc { center, radius, ccw } => Curve::Arc { center, radius, ccw: !ccw },
            };
            Edge { from: to, curve }
        })
        .collect();
    result.reverse();
    result
}

/// The number of equal chords of a circle none of which is farther than `tolerance` from it; at least eight.
pub(crate) fn chords_per_turn(radius: f64, tolerance: f64) -> usize {
    const MOST: f64 = 65536.0;
    // A chord of half angle a is radius * (1 - cos a) <= radius * a² / 2 away.
    let count = PI * (radius / (2.0 * tolerance)).sqrt();
    if count < MOST { (count.ceil() as usize).max(8) } else { MOST as usize }
}

/// Corners of a chain of chords along the edge, without its last corner. Where `facets` is given it is the number of
/// chords of a full turn.
pub(crate) fn corners(edge: &Edge, to: Vec2, per_turn: impl Fn(f64) -> usize, into: &mut Vec<Vec2>) {
    into.push(edge.from);
    let Curve::Arc { center, radius, ccw } = edge.curve else { return };
    let turn = sweep(center, ccw, edge.from, to);
    let chords = (turn.abs() / TAU * per_turn(radius) as f64 - 1e-9).ceil().max(1.0);
    let start = edge.from - center;
    let mut i = 1.0;
    while i < chords {
        into.push(center + turned(start, turn * (i / chords)));
        i += 1.0;
    }
}
