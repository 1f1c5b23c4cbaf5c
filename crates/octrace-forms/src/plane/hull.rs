//! Convex hulls of outlines.
//!
//! Fine chords tell which pieces of which circles the hull touches, and in which order; the tangents between them are then
//! computed from the circles themselves. So hulls of lines and arcs are of lines and arcs again.

mod samples;

use super::Outline;
use super::boolean::without_straight_corners;
use super::curve::{signed_area, sweep};
use super::outline::full_circle;
use octrace::{Contour, Curve, Edge, Vec2};
use robust::orient2d;
use samples::{CHORDS_PER_TURN, Circle, convex, coord, samples};
use std::f64::consts::{PI, TAU};

/// How often arcs are looked for that no sample told of, and among how many pairs of circles and lines at most.
const ROUNDS: usize = 8;
const MOST_PAIRS: usize = 1_000_000;

/// What a hull touches: a corner, or an arc from its first to its last sample.
#[derive(Clone, Copy, Debug)]
struct Touched {
    circle: Option<usize>,
    first: Vec2,
    last: Vec2,
}

/// The smallest convex region around all the outlines; empty where that has no area.
pub fn hull<'a>(outlines: impl IntoIterator<Item = &'a Outline>) -> Outline {
    let (circles, samples) = samples(outlines.into_iter().flat_map(|outline| &outline.contours));
    let corners = convex(samples).into_iter();
    let mut touched = joined(&circles, corners.map(|s| Touched { circle: s.circle, first: s.at, last: s.at }));
    if let [Touched { circle: Some(circle), first, last }] = touched[..]
        && circles[circle].goes_on(last, first)
        && first != last
    {
        return Outline { contours: vec![full_circle(circles[circle].center, circles[circle].radius)] };
    }
    let mut rounds = ROUNDS;
    loop {
        let lines: Vec<[Vec2; 2]> =
            (0..touched.len()).map(|i| tangent(&circles, &touched[i], &touched[(i + 1) % touched.len()])).collect();
        let before = |i: usize| lines[(i + lines.len() - 1) % lines.len()][1];
        // A corner where the lines turn right is within the hull: the curve that ends there bulges out beside it. A curve
        // that is touched before its first sample and after its last one, by more than samples are apart, is not: those
        // beside it bulge more than their chords.
        let passed = |i: usize| {
            let piece = &touched[i];
            if before(i) == lines[i][0] {
                let from = lines[(i + lines.len() - 1) % lines.len()][0];
                return orient2d(coord(from), coord(lines[i][0]), coord(lines[i][1])) < 0.0;
            }
            let turn = |circle: &Circle| sweep(circle.center, true, before(i), lines[i][0]);
            piece.circle.is_some_and(|c| turn(&circles[c]) > span(&circles[c], piece) + PI)
        };
        let kept: Vec<Touched> = (0..touched.len()).filter(|&i| !passed(i)).map(|i| touched[i]).collect();
        if kept.len() < touched.len() && kept.len() > 1 {
            touched = joined(&circles, kept);
            continue;
        }
        if rounds > 0 {
            rounds -= 1;
            let more = with_missed(&circles, &touched, &lines);
            if more.len() > touched.len() {
                touched = joined(&circles, more);
                continue;
            }
        }
        let mut contour = Contour::with_capacity(2 * touched.len());
        for (i, piece) in touched.iter().enumerate() {
            if let Some(circle) = piece.circle.map(|c| &circles[c])
                && before(i) != lines[i][0]
                && !passed(i)
            {
                let curve = Curve::Arc { center: circle.center, radius: circle.radius, ccw: true };
                contour.push(Edge { from: before(i), curve });
            }
            if lines[i][0] != lines[i][1] {
                contour.push(Edge { from: lines[i][0], curve: Curve::Line });
            }
        }
        let contour = without_straight_corners(contour);
        return if signed_area(&contour) > 0.0 { Outline { contours: vec![contour] } } else { Outline::EMPTY };
    }
}

/// Puts in arcs that are beyond a line of the hull, although no sample of theirs is: where they are, and touched farthest.
fn with_missed(circles: &[Circle], touched: &[Touched], lines: &[[Vec2; 2]]) -> Vec<Touched> {
    let mut more = Vec::with_capacity(touched.len());
    for (i, piece) in touched.iter().enumerate() {
        more.push(*piece);
        let [from, to] = lines[i];
        let length = (to - from).length();
        if length == 0.0 || circles.len().saturating_mul(touched.len()) > MOST_PAIRS {
            continue;
        }
        let outwards = -(to - from).left() * (1.0 / length);
        let beyond = |&c: &usize| outwards.dot(circles[c].center - from) + circles[c].radius;
        // What is beyond by rounding only is on the line.
        let clear = |c: &usize| beyond(c) > (length + circles[*c].radius) * 1e-11;
        let next = touched[(i + 1) % touched.len()].circle;
        let others = (0..circles.len()).filter(|&c| Some(c) != piece.circle && Some(c) != next).filter(clear);
        let on_an_arc = others.filter_map(|c| {
            let at = circles[c].covered(circles[c].center + outwards * circles[c].radius)?;
            Some((beyond(&c), Touched { circle: Some(c), first: at, last: at }))
        });
        more.extend(on_an_arc.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, missed)| missed));
    }
    more
}

fn span(circle: &Circle, piece: &Touched) -> f64 {
    if piece.first == piece.last { 0.0 } else { sweep(circle.center, true, piece.first, piece.last) }
}

/// Pieces of one circle that follow each other without a gap become one.
fn joined(circles: &[Circle], pieces: impl IntoIterator<Item = Touched>) -> Vec<Touched> {
    let goes_on = |last: &Touched, next: &Touched| {
        last.circle.is_some_and(|c| next.circle == Some(c) && circles[c].goes_on(last.last, next.first))
    };
    let mut joined: Vec<Touched> = Vec::new();
    for next in pieces {
        match joined.last_mut() {
            Some(last) if goes_on(last, &next) => last.last = next.last,
            _ => joined.push(next),
        }
    }
    if let [first, .., last] = &mut joined[..]
        && goes_on(last, first)
    {
        first.first = last.first;
        joined.pop();
    }
    joined
}

/// The line that the hull goes along from one curve to the next.
fn tangent(circles: &[Circle], from: &Touched, to: &Touched) -> [Vec2; 2] {
    let mut ends = [from.circle.map(|c| &circles[c]), to.circle.map(|c| &circles[c])];
    let samples = [from.last, to.first];
    if from.circle == to.circle {
        return samples;
    }
    // Where a tangent would touch beyond an arc's end, the hull touches the end.
    loop {
        let round = |i: usize| ends[i].map_or((samples[i], 0.0), |circle: &Circle| (circle.center, circle.radius));
        let Some(line) = outer_tangent(round(0), round(1)) else {
            // One circle is within the other, which is touched at an end of an arc.
            let outer = usize::from(round(1).1 > round(0).1);
            if ends[outer].take().is_none() {
                return samples;
            }
            continue;
        };
        let touched = [0, 1].map(|i| {
            let Some(circle) = ends[i] else { return Some(samples[i]) };
            let near = (line[i] - samples[i]).length() < 2.0 * circle.radius * TAU / CHORDS_PER_TURN;
            if near { circle.covered(line[i]) } else { None }
        });
        match touched {
            [Some(a), Some(b)] => return [a, b],
            // Beyond both: once the one that is touched at its end is held, the other may be right.
            [None, None] => {
                let at_its_end =
                    ends[0].is_some_and(|circle| circle.arcs.iter().flatten().any(|&end| end == samples[0]));
                ends[usize::from(!at_its_end)] = None;
            }
            [None, _] => ends[0] = None,
            [_, None] => ends[1] = None,
        }
    }
}

/// Where a line with both circles to its left, or points, touches them. `None` where one is within the other.
fn outer_tangent((a, r): (Vec2, f64), (b, s): (Vec2, f64)) -> Option<[Vec2; 2]> {
    let between = b - a;
    let distance = between.length();
    if distance <= (r - s).abs() {
        return None;
    }
    let along = between * (1.0 / distance);
    let tilt = (r - s) / distance;
    let normal = along * tilt - along.left() * ((1.0 - tilt) * (1.0 + tilt)).sqrt();
    Some([a + normal * r, b + normal * s])
}

#[cfg(test)]
mod tests;
