//! Whether a path crosses another one in one of its corners, where arcs are involved: told by the order in which the four
//! ways from there leave a small circle around it.

use super::crossing::TOUCH;
use super::piece::{Circle, Piece};
use crate::geom::Vec2;

/// The circle is this part of the shortest of the four pieces.
const CIRCLE: f64 = 1.0 / 1024.0;

/// Where a path of two pieces crosses a piece with its corner: in that, or in the corner before it, which `before` comes to.
/// `touch` is how near counts as on it.
pub(super) fn crosses_in_corner(before: &Piece, piece: &Piece, path: [&Piece; 2], touch: f64) -> Option<Vec2> {
    let at = path[1].from;
    let is_near = |p: Vec2| (p - at).length() <= touch;
    let is_at_corner = is_near(piece.from) && !piece.is_whole();
    if !is_at_corner && (is_near(piece.to) && !piece.is_whole() || !is_on(piece, at, touch)) {
        return None;
    }
    let backward = if is_at_corner { before } else { piece };
    if [path[0], path[1], backward, piece].iter().all(|piece| piece.is_line()) {
        // These are decided exactly.
        return None;
    }
    let shortest = [path[0], path[1], backward, piece].map(size).into_iter().fold(f64::INFINITY, f64::min);
    let mut radius = shortest * CIRCLE;
    if !is_at_corner && !piece.is_whole() {
        let room = (piece.from - at).length().min((piece.to - at).length());
        radius = radius.min(0.5 * room);
    }
    let slack = TOUCH.max(4.0 * touch / radius);
    if slack > 0.1 {
        return None;
    }
    let come = leaves(path[0], at, radius, false)?;
    let go = leaves(path[1], at, radius, true)?;
    let (back, ahead) = (leaves(backward, at, radius, false)?, leaves(piece, at, radius, true)?);
    let is_left = |ray: Vec2| is_between(ahead, ray, back, slack);
    (is_left(come)? != is_left(go)?).then_some(at)
}

/// The length of a piece, or the radius of its circle where that is less.
fn size(piece: &Piece) -> f64 {
    match (piece.circle, piece.is_whole()) {
        (Some(Circle { radius, .. }), true) => radius,
        (Some(Circle { radius, .. }), false) => radius.min(piece.chord().length()),
        (None, _) => piece.chord().length(),
    }
}

/// Whether a point is on a piece, its ends left out.
fn is_on(piece: &Piece, p: Vec2, touch: f64) -> bool {
    match piece.circle {
        Some(Circle { center, radius, .. }) => ((p - center).length() - radius).abs() <= touch && piece.has(p),
        None => {
            let along = piece.chord();
            let (length, s) = (along.length(), (p - piece.from).dot(along));
            0.0 < s && s < length * length && along.cross(p - piece.from).abs() <= touch * length
        }
    }
}

/// The unit vector to where a piece, followed ahead or back from a point on it, is at that distance.
fn leaves(piece: &Piece, at: Vec2, distance: f64, ahead: bool) -> Option<Vec2> {
    let tangent = if ahead { piece.tangent(at) } else { -piece.tangent(at) };
    let unit = tangent * (1.0 / tangent.length());
    let Some(Circle { radius, ccw, .. }) = piece.circle else { return Some(unit) };
    let sine = distance / (2.0 * radius);
    if sine >= 1.0 {
        return None;
    }
    // A chord is turned from the tangent by half the angle of its arc, to the side to which the arc bends.
    let side = if ccw == ahead { unit.left() } else { -unit.left() };
    Some(unit * (1.0 - sine * sine).sqrt() + side * sine)
}

/// Whether turning left from `from` one meets `ray` before `to`; `None` where it is along either.
fn is_between(from: Vec2, ray: Vec2, to: Vec2, slack: f64) -> Option<bool> {
    let is_along = |other: Vec2| ray.cross(other).abs() <= slack && ray.dot(other) > 0.0;
    if is_along(from) || is_along(to) {
        return None;
    }
    let angle = |v: Vec2| {
        let angle = libm::atan2(from.cross(v), from.dot(v));
        if angle < 0.0 { angle + 2.0 * std::f64::consts::PI } else { angle }
    };
    Some(angle(ray) < angle(to))
}
