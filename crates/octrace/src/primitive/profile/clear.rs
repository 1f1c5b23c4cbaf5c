//! Whether what goes on beyond a cut is clear of the rest of a chain: in doubt it is not.

use super::piece::Piece;
use crate::geom::Vec2;

/// Sines of angles smaller than this are not relied upon.
pub(super) const CLEAR: f64 = 1e-5;

/// Whether a ray surely misses a piece: the piece, its bulge included, is on one side of it or behind it. The piece may start
/// from the ray's beginning.
pub(super) fn misses(from: Vec2, ray: Vec2, piece: &Piece) -> bool {
    let ray = ray * (1.0 / ray.length());
    let ends = [piece.from - from, piece.to - from];
    let size = ends[0].length().max(ends[1].length());
    let slack = CLEAR * size;
    let is_beyond = |side: Vec2| {
        let arc = piece.circle.filter(|circle| piece.has(circle.center - side * circle.radius));
        let lowest = arc.map_or(f64::INFINITY, |circle| (circle.center - side * circle.radius - from).dot(side));
        let at_start = |end: &Vec2| end.length() <= CLEAR * size;
        let is_above = |end: &Vec2| at_start(end) || end.dot(side) > slack;
        lowest > slack && ends.iter().all(is_above)
    };
    [ray.left(), -ray.left(), -ray].into_iter().any(is_beyond)
}

/// Whether two rays surely do not meet.
pub(super) fn rays_miss(p: Vec2, a: Vec2, q: Vec2, b: Vec2) -> bool {
    let sine = a.cross(b) / (a.length() * b.length());
    if sine.abs() < CLEAR {
        // Nearly parallel: they are apart, or are not relied upon.
        return a.dot(b) < 0.0 && (q - p).dot(a) < 0.0;
    }
    let (t, u) = ((q - p).cross(b) / a.cross(b), (q - p).cross(a) / a.cross(b));
    t < 0.0 || u < 0.0
}
