//! Whether contours cross, each other or themselves. They may touch: in corners, along edges, where arcs are tangent.

use super::ProfileError;
use super::corner::crosses_in_corner;
use super::piece::{Circle, Piece, orientation};
use crate::geom::{Bounds, Vec2, Vec3};
use crate::primitive::Bvh;
use std::ops::ControlFlow;

/// Where arcs cross something is computed, not decided exactly: crossings nearer than this to the end of an edge, in parts of
/// the profile's size, and angles and overlaps smaller than this, are touches.
pub(super) const TOUCH: f64 = 1e-7;

/// Finds two edges that cross. `owners` tells of every loop which contour it belongs to.
pub(super) fn check(loops: &[Vec<Piece>], owners: &[usize]) -> Result<(), ProfileError> {
    let pieces = loops.concat();
    let mut edges: Vec<Place> = Vec::with_capacity(pieces.len());
    for (pieces, &owner) in loops.iter().zip(owners) {
        let (first, count) = (edges.len(), pieces.len());
        edges.extend((0..count).map(|i| Place { owner, before: first + (i + count - 1) % count }));
    }
    let boxes: Vec<Bounds> = pieces
        .iter()
        .map(|piece| {
            let (low, high) = piece.bounds();
            Bounds::new(Vec3::new(low.x, low.y, 0.0), Vec3::new(high.x, high.y, 0.0))
        })
        .collect();
    let tree = Bvh::build(&boxes);
    let touch = TOUCH * tree.bounds().diagonal();
    for (i, piece) in pieces.iter().enumerate() {
        let reach = Bounds::new(boxes[i].min - Vec3::splat(touch), boxes[i].max + Vec3::splat(touch));
        let meets = |other: &Bounds| !reach.intersection(*other).is_empty();
        let found = tree.visit(meets, |j| {
            let j = j as usize;
            if j == i || !meets(&boxes[j]) {
                return ControlFlow::Continue(());
            }
            let (before, path) = (&pieces[edges[i].before], [&pieces[edges[j].before], &pieces[j]]);
            let at = if j > i { crossing(piece, &pieces[j], touch) } else { None };
            let at = at.or_else(|| passes(before, piece, path));
            match at.or_else(|| crosses_in_corner(before, piece, path, touch)) {
                Some(at) => ControlFlow::Break((edges[i].owner, edges[j].owner, at)),
                None => ControlFlow::Continue(()),
            }
        });
        if let ControlFlow::Break((contour, other, at)) = found {
            return Err(ProfileError::Crossing { contour, other, at });
        }
    }
    Ok(())
}

/// Where a piece is: the contour, and the number of the piece before it.
#[derive(Clone, Copy)]
struct Place {
    owner: usize,
    before: usize,
}

/// Where a path of two lines crosses with its corner: in a line, or in the corner before that. (Where there are arcs, see
/// [`corner`](super::corner).)
fn passes(before: &Piece, line: &Piece, path: [&Piece; 2]) -> Option<Vec2> {
    let at = path[1].from;
    if !(line.is_line() && path.iter().all(|piece| piece.is_line())) || at == line.to {
        return None;
    }
    let from = match at == line.from {
        true if before.is_line() => before.from,
        true => return None,
        false => line.from,
    };
    if at != line.from {
        let along = line.chord();
        let s = (at - line.from).dot(along);
        if orientation(line.from, line.to, at) != 0.0 || !(0.0 < s && s < along.dot(along)) {
            return None;
        }
    }
    // On which side of the way from `from` by `at` to the line's end.
    let turn = orientation(from, at, line.to);
    let is_beside = |p: Vec2, sign: f64| {
        let (one, other) = (orientation(from, at, p) * sign > 0.0, orientation(at, line.to, p) * sign > 0.0);
        if turn * sign > 0.0 { one && other } else { one || other }
    };
    let (come, go) = (path[0].from, path[1].to);
    let crosses =
        |a: Vec2, b: Vec2| is_beside(a, 1.0) && !is_beside(a, -1.0) && is_beside(b, -1.0) && !is_beside(b, 1.0);
    (crosses(come, go) || crosses(go, come)).then_some(at)
}

/// Where two pieces cross.
fn crossing(a: &Piece, b: &Piece, touch: f64) -> Option<Vec2> {
    let is_inner = |piece: &Piece, p: Vec2| {
        let is_clear = |end: Vec2| (p - end).length() > touch;
        piece.is_whole() || (is_clear(piece.from) && is_clear(piece.to))
    };
    let is_on = |piece: &Piece, p: Vec2| match piece.circle {
        Some(_) => piece.has(p),
        None => {
            let along = piece.chord();
            let s = (p - piece.from).dot(along);
            0.0 < s && s < along.dot(along)
        }
    };
    let common = match (a.circle, b.circle) {
        (None, None) => return lines_cross(a, b),
        (Some(circle), None) => with_line(&circle, b.from, b.chord(), touch),
        (None, Some(circle)) => with_line(&circle, a.from, a.chord(), touch),
        (Some(one), Some(other)) => with_circle(&one, &other, touch),
    }?;
    common.into_iter().find(|&p| is_on(a, p) && is_on(b, p) && is_inner(a, p) && is_inner(b, p))
}

fn lines_cross(a: &Piece, b: &Piece) -> Option<Vec2> {
    let opposite = |s: f64, t: f64| (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0);
    let (from, to) = (orientation(a.from, a.to, b.from), orientation(a.from, a.to, b.to));
    let crosses = opposite(from, to) && opposite(orientation(b.from, b.to, a.from), orientation(b.from, b.to, a.to));
    crosses.then(|| b.from + b.chord() * (from / (from - to)))
}

/// Where a line passes through a circle; `None` where it misses or touches.
fn with_line(circle: &Circle, from: Vec2, along: Vec2, touch: f64) -> Option<[Vec2; 2]> {
    let unit = along * (1.0 / along.length());
    let foot = from + unit * unit.dot(circle.center - from);
    let depth = circle.radius - (foot - circle.center).length();
    let half = (depth * (2.0 * circle.radius - depth)).max(0.0).sqrt();
    (depth > touch * TOUCH && half > touch).then(|| [foot - unit * half, foot + unit * half])
}

/// Where two circles cross; `None` where they miss, touch, or are the same.
fn with_circle(a: &Circle, b: &Circle, touch: f64) -> Option<[Vec2; 2]> {
    let apart = b.center - a.center;
    let distance = apart.length();
    if distance <= touch * TOUCH {
        return None;
    }
    let unit = apart * (1.0 / distance);
    // How far along from a's centre the common chord is.
    let along = (distance * distance + (a.radius - b.radius) * (a.radius + b.radius)) / (2.0 * distance);
    let half = ((a.radius - along) * (a.radius + along)).max(0.0).sqrt();
    let foot = a.center + unit * along;
    (half > touch).then(|| [foot - unit.left() * half, foot + unit.left() * half])
}
