//! Which contours are around which.

use super::piece::{Piece, orientation};
use crate::geom::Vec2;

/// Whether a point is in what closed pieces surround; `None` for a point on them.
pub(super) fn contains(pieces: &[Piece], p: Vec2) -> Option<bool> {
    let mut inside = false;
    for piece in pieces {
        if p == piece.from {
            return None;
        }
        if !piece.is_whole() {
            let (a, b) = (piece.from, piece.to);
            let side = orientation(a, b, p);
            let (low, high) = (a.y.min(b.y), a.y.max(b.y));
            if side == 0.0 && piece.is_line() {
                let is_beside = a.x.min(b.x) <= p.x && p.x <= a.x.max(b.x);
                if is_beside && low <= p.y && p.y <= high {
                    return None;
                }
            }
            // Of a ray to the right, half-open at corners.
            inside ^= low <= p.y && p.y < high && (side > 0.0) == (b.y > a.y) && side != 0.0;
        }
        if let Some(circle) = piece.circle {
            let off = (p - circle.center).length() - circle.radius;
            if off.abs() <= 1e-9 * circle.radius && (piece.has(p) || piece.is_whole()) {
                return None;
            }
            inside ^= off < 0.0 && (piece.is_whole() || is_left(piece, p) != circle.ccw);
        }
    }
    Some(inside)
}

/// Whether a point is to the left of a chord. On the chord itself: as a ray to the right counts it.
fn is_left(piece: &Piece, p: Vec2) -> bool {
    let (side, along) = (orientation(piece.from, piece.to, p), piece.chord());
    side > 0.0 || (side == 0.0 && (along.y < 0.0 || (along.y == 0.0 && along.x > 0.0)))
}

/// For every contour, how many others are around it, and the innermost of them.
pub(super) fn nesting(contours: &[Vec<Piece>]) -> Vec<(usize, Option<usize>)> {
    let boxes: Vec<(Vec2, Vec2)> = contours.iter().map(|pieces| bounds(pieces)).collect();
    let areas: Vec<f64> = contours.iter().map(|pieces| area(pieces).abs()).collect();
    let is_around = |outer: usize, inner: usize| {
        let ((low, high), (own_low, own_high)) = (boxes[outer], boxes[inner]);
        let fits = low.x <= own_low.x && low.y <= own_low.y && own_high.x <= high.x && own_high.y <= high.y;
        // Of two that coincide, the first is the outer one.
        let is_larger = (areas[outer], inner) > (areas[inner], outer);
        fits && is_larger && holds(&contours[outer], &contours[inner])
    };
    (0..contours.len())
        .map(|inner| {
            let around: Vec<usize> =
                (0..contours.len()).filter(|&outer| outer != inner && is_around(outer, inner)).collect();
            let innermost = around.iter().copied().min_by(|&a, &b| areas[a].total_cmp(&areas[b]).then(b.cmp(&a)));
            (around.len(), innermost)
        })
        .collect()
}

/// Whether a contour that does not cross another is inside it: any point that is not on the other tells.
fn holds(outer: &[Piece], inner: &[Piece]) -> bool {
    let corners = inner.iter().map(|piece| piece.from);
    let middles = inner.iter().map(|piece| piece.middle());
    // Where all of these are on the other contour: points beside the edges.
    let beside = inner.iter().map(|piece| {
        let (middle, chord) = (piece.middle(), piece.tangent(piece.middle()));
        middle + chord.left() * (1e-6 / chord.length() * (piece.to - piece.from).length().max(1e-3 * chord.length()))
    });
    corners.chain(middles).chain(beside).find_map(|p| contains(outer, p)).unwrap_or(true)
}

/// The signed area, positive where a contour is walked counter-clockwise.
pub(super) fn area(pieces: &[Piece]) -> f64 {
    let origin = pieces.first().map_or(Vec2::ZERO, |piece| piece.from);
    pieces.iter().map(|piece| piece.doubled_area(origin)).sum::<f64>() / 2.0
}

/// The smallest and the largest coordinates.
pub(super) fn bounds(pieces: &[Piece]) -> (Vec2, Vec2) {
    let (mut low, mut high) =
        (Vec2::new(f64::INFINITY, f64::INFINITY), Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
    for (l, h) in pieces.iter().map(|piece| piece.bounds()) {
        low = Vec2::new(low.x.min(l.x), low.y.min(l.y));
        high = Vec2::new(high.x.max(h.x), high.y.max(h.y));
    }
    (low, high)
}
