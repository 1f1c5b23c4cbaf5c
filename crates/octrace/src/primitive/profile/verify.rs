//! A formula is tried before it leaves: beside the edges of its contour it must say inside to the left, outside to the right.
//!
//! Cutting chains ([`chain`](super::chain)) is proven for lines; with arcs it rests on how chords and curves turn at corners,
//! which rounding may blur. So formulas of contours with arcs are tried at points close to the middle and to the ends of every
//! piece. Where one fails, arcs are halved, which brings chords closer to curves, and the formula is made anew; in the end
//! chords take the place of arcs, so finely that no picture shows it.

use super::chain::{Join, Step, formula};
use super::nesting::bounds;
use super::piece::{Circle, Piece};
use crate::geom::Vec2;

/// Contours with more pieces than this are not tried: the time it takes grows with the square.
const MOST: usize = 2_000;
/// How often arcs are halved.
const HALVINGS: usize = 4;
/// Where on a piece it is tried, and how far from it, as shares of the piece's length.
const PROBES: [(f64, f64); 4] = [(1.0 / 64.0, 1.0 / 512.0), (0.5, 1.0 / 512.0), (0.5, 0.5), (63.0 / 64.0, 1.0 / 512.0)];
/// What chords may be off by, in sizes of the contour, if nothing else helps.
const TOLERANCE: f64 = 1e-6;

/// The formula of what is inside a simple contour, walked counter-clockwise, and whether it is convex.
pub(super) fn verified(pieces: &[Piece]) -> (Vec<Step>, bool) {
    let first = formula(pieces);
    let has_arcs = pieces.iter().any(|piece| !piece.is_line());
    if first.1 || !has_arcs || pieces.len() > MOST || holds(&first.0, pieces) {
        return first;
    }
    let mut halved = pieces.to_vec();
    for _ in 0..HALVINGS {
        halved = halved.iter().flat_map(halves).collect();
        let (steps, is_convex) = formula(&halved);
        if holds(&steps, pieces) {
            return (steps, is_convex);
        }
    }
    let (low, high) = bounds(pieces);
    let off = TOLERANCE * (high - low).length();
    let chords: Vec<Piece> = pieces.iter().flat_map(|piece| chords(piece, off)).collect();
    formula(&chords)
}

fn halves(piece: &Piece) -> Vec<Piece> {
    if piece.is_line() { vec![*piece] } else { piece.cut(piece.middle()).to_vec() }
}

/// Lines in place of an arc, `off` from it at most.
fn chords(piece: &Piece, off: f64) -> Vec<Piece> {
    const MOST_CHORDS: f64 = 4096.0;
    let (Some(Circle { center, radius, .. }), Some((angle, _))) = (piece.circle, piece.sweep()) else {
        return vec![*piece];
    };
    let step = 2.0 * libm::acos((1.0 - off / radius).max(0.0));
    let count = (angle.abs() / step).ceil().clamp(1.0, MOST_CHORDS) as usize;
    let arm = piece.from - center;
    let corner = |i: usize| match i {
        0 => piece.from,
        _ if i == count => piece.to,
        _ => {
            let (sine, cosine) = libm::sincos(angle * (i as f64 / count as f64));
            center + arm * cosine + arm.left() * sine
        }
    };
    (0..count).map(|i| Piece { from: corner(i), to: corner(i + 1), circle: None }).collect()
}

/// Whether a formula is right beside all pieces of its contour.
pub(super) fn holds(steps: &[Step], pieces: &[Piece]) -> bool {
    let (low, high) = bounds(pieces);
    let (size, closes) = ((high - low).length(), closes(steps));
    let boxes: Vec<(Vec2, Vec2)> = pieces.iter().map(Piece::bounds).collect();
    pieces.iter().enumerate().all(|(number, piece)| {
        PROBES.into_iter().all(|(share, reach)| {
            let Some((at, length)) = place(piece, share) else { return true };
            // Halfway to the next piece, and so close that it is beside this one.
            let most = 2.0 * length * reach;
            let others = pieces.iter().zip(&boxes).enumerate().filter(|&(other, _)| other != number);
            let room = others
                .filter(|(_, (_, (low, high)))| is_near(*low, *high, at, most))
                .map(|(_, (other, _))| distance(other, at))
                .fold(most, f64::min);
            let step = room / 2.0;
            if step < 1e-10 * size {
                return true;
            }
            let tangent = piece.tangent(at);
            let beside = tangent.left() * (step / tangent.length());
            says(steps, &closes, at + beside) && !says(steps, &closes, at - beside)
        })
    })
}

/// The point at a share of a piece, and how long the piece is. `None` for what has no length.
fn place(piece: &Piece, share: f64) -> Option<(Vec2, f64)> {
    match (piece.circle, piece.sweep()) {
        (Some(Circle { center, .. }), Some((angle, radius))) => {
            let (sine, cosine) = libm::sincos(angle * share);
            let arm = piece.from - center;
            Some((center + arm * cosine + arm.left() * sine, radius * angle.abs().min(1.0)))
        }
        _ => Some((piece.from + piece.chord() * share, piece.chord().length())),
    }
    .filter(|&(_, length)| length > 0.0)
}

fn is_near(low: Vec2, high: Vec2, p: Vec2, reach: f64) -> bool {
    low.x - reach < p.x && p.x < high.x + reach && low.y - reach < p.y && p.y < high.y + reach
}

/// From a point to a piece.
fn distance(piece: &Piece, p: Vec2) -> f64 {
    let ends = (p - piece.from).length().min((p - piece.to).length());
    let Some(Circle { center, radius, .. }) = piece.circle else {
        let chord = piece.chord();
        let share = ((p - piece.from).dot(chord) / chord.dot(chord)).clamp(0.0, 1.0);
        return (p - (piece.from + chord * share)).length();
    };
    let arm = p - center;
    let length = arm.length();
    if length > 0.0 && piece.has(center + arm * (radius / length)) {
        return (length - radius).abs();
    }
    ends
}

/// For every step that opens something, the one that closes it.
fn closes(steps: &[Step]) -> Vec<usize> {
    let (mut closes, mut open) = (vec![0; steps.len()], Vec::new());
    for (i, step) in steps.iter().enumerate() {
        match step {
            Step::Open(_) => open.push(i),
            Step::Close => {
                if let Some(opened) = open.pop() {
                    closes[opened] = i;
                }
            }
            _ => {}
        }
    }
    closes
}

/// What a formula says of a point.
fn says(steps: &[Step], closes: &[usize], p: Vec2) -> bool {
    // What is open: how it joins, and where it ends.
    let mut open: Vec<(Join, usize)> = Vec::new();
    let (mut i, mut value) = (0, false);
    while let Some(step) = steps.get(i) {
        match *step {
            Step::Open(join) => {
                open.push((join, closes[i]));
                value = join == Join::All;
                i += 1;
                continue;
            }
            Step::Close => {
                open.pop();
            }
            Step::Left(a, b) => value = (b - a).cross(p - a) > 0.0,
            Step::Disc { center, radius, inside } => value = ((p - center).length() < radius) == inside,
        }
        i += 1;
        // A value that decides what is open ends it.
        while let Some(&(join, close)) = open.last() {
            if value == (join == Join::All) {
                break;
            }
            open.pop();
            i = close + 1;
        }
    }
    value
}
