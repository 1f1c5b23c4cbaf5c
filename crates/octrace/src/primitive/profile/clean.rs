//! Contours as they come in, made fit: without edges of no length, corners in straight lines and corners met twice.

use super::ProfileError;
use super::piece::{Circle, Piece, orientation, pieces_of};
use super::{Contour, Curve};
use crate::geom::Vec2;
use rustc_hash::FxHashMap;

/// Both ends of an arc are on its circle up to this part of the radius.
const OFF_CIRCLE: f64 = 1e-6;

/// An arc that bulges by less than this part of its chord is a straight line: its circle is so large that rounding would
/// move it by more.
const FLAT: f64 = 1e-8;

/// The simple loops that a contour consists of: closed walks that meet each of their corners once.
pub(super) fn loops(number: usize, contour: &Contour) -> Result<Vec<Vec<Piece>>, ProfileError> {
    for edge in contour {
        let finite = |p: Vec2| p.x.is_finite() && p.y.is_finite();
        let (is_finite, is_round) = match edge.curve {
            Curve::Line => (true, true),
            Curve::Arc { center, radius, .. } => (finite(center) && radius.is_finite(), radius > 0.0),
        };
        if !(finite(edge.from) && is_finite) {
            return Err(ProfileError::NotFinite { contour: number });
        }
        if !is_round {
            return Err(ProfileError::NotRound { contour: number, at: edge.from });
        }
    }
    let mut pieces = pieces_of(contour);
    if let [Piece { circle: Some(circle), .. }] = pieces[..] {
        let from = circle.center + Vec2::new(circle.radius, 0.0);
        return Ok(vec![vec![Piece { from, to: from, circle: Some(circle) }]]);
    }
    pieces.retain(|piece| !piece.is_whole());
    for piece in &mut pieces {
        let Some(Circle { center, radius, .. }) = piece.circle else { continue };
        let is_off = |p: Vec2| ((p - center).length() - radius).abs() > OFF_CIRCLE * radius;
        if is_off(piece.from) || is_off(piece.to) {
            return Err(ProfileError::NotRound { contour: number, at: piece.from });
        }
        let chord = piece.chord();
        if piece.sweep().is_some_and(|(angle, _)| angle.abs() < 1.0) && chord.length() < 8.0 * FLAT * radius {
            piece.circle = None;
        }
    }
    let mut loops = parted(pieces);
    for pieces in &mut loops {
        straighten(pieces);
    }
    loops.retain(|pieces| match pieces[..] {
        [a, b] => !(a.is_line() && b.is_line()),
        [piece] => piece.is_whole() && !piece.is_line(),
        _ => !pieces.is_empty(),
    });
    Ok(loops)
}

/// Parts a closed walk where it comes to a corner again.
fn parted(pieces: Vec<Piece>) -> Vec<Vec<Piece>> {
    // Adding zero turns -0 into 0.
    let key = |p: Vec2| [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()];
    let mut loops = Vec::new();
    let mut walk: Vec<Piece> = Vec::with_capacity(pieces.len());
    // For the corners of the walk, which piece starts there.
    let mut starts: FxHashMap<[u64; 2], usize> = FxHashMap::default();
    for piece in pieces {
        starts.insert(key(piece.from), walk.len());
        walk.push(piece);
        if let Some(&start) = starts.get(&key(piece.to)) {
            let closed = walk.split_off(start);
            for piece in &closed {
                starts.remove(&key(piece.from));
            }
            loops.push(closed);
        }
    }
    loops
}

/// Joins lines that go on straight, and takes out those that go to and fro.
fn straighten(pieces: &mut Vec<Piece>) {
    let mut kept: Vec<Piece> = Vec::with_capacity(pieces.len());
    for &piece in pieces.iter() {
        kept.push(piece);
        join_last(&mut kept);
    }
    // Where the end meets the beginning.
    while kept.len() > 2 {
        let (first, last) = (kept[0], kept[kept.len() - 1]);
        if !is_straight(&last, &first) {
            break;
        }
        kept.remove(0);
        let end = kept.len() - 1;
        kept[end].to = first.to;
        if kept[end].is_whole() {
            kept.pop();
        }
        join_last(&mut kept);
    }
    *pieces = kept;
}

fn join_last(kept: &mut Vec<Piece>) {
    while let [.., before, last] = kept[..] {
        if !is_straight(&before, &last) {
            return;
        }
        kept.truncate(kept.len() - 2);
        if before.from != last.to {
            kept.push(Piece { from: before.from, to: last.to, circle: None });
        }
    }
}

fn is_straight(a: &Piece, b: &Piece) -> bool {
    a.is_line() && b.is_line() && orientation(a.from, a.to, b.to) == 0.0
}
