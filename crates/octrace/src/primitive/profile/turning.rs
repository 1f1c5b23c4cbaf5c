//! How paths turn: which way, and how far.

use super::piece::{Piece, orientation};
use crate::geom::Vec2;

/// Sines of angles smaller than this are roundings in the coordinates that came in.
const STRAIGHT: f64 = 1e-10;

/// How a path turns, as far as it was followed.
pub(super) struct Turning {
    /// Positive to the left.
    pub angle: f64,
    /// Whether nothing turned to the right so far.
    pub to_the_left: bool,
    /// Whether nothing turned to the left so far.
    pub to_the_right: bool,
}

impl Turning {
    pub fn none() -> Self {
        Self { angle: 0.0, to_the_left: true, to_the_right: true }
    }

    /// At a corner, from one direction into another. `exact` is on the side to which it turns, if that is known.
    pub fn corner(&mut self, from: Vec2, to: Vec2, exact: Option<f64>) {
        let (sine, cosine) = (from.cross(to), from.dot(to));
        let size = from.length() * to.length() * STRAIGHT;
        if sine.abs() <= size && cosine > 0.0 && exact.is_none() {
            return;
        }
        let side = exact.unwrap_or(if sine.abs() <= size { 0.0 } else { sine });
        self.to_the_left &= side > 0.0 || (side == 0.0 && cosine > 0.0);
        self.to_the_right &= side < 0.0 || (side == 0.0 && cosine > 0.0);
        self.angle += libm::atan2(sine, cosine);
    }

    /// Between two pieces.
    pub fn between(&mut self, before: &Piece, behind: &Piece) {
        let lines = before.is_line() && behind.is_line();
        let exact = lines.then(|| orientation(before.from, before.to, behind.to));
        self.corner(before.tangent(before.to), behind.tangent(behind.from), exact);
    }

    /// Along a piece.
    pub fn along(&mut self, piece: &Piece) {
        if let Some((angle, _)) = piece.sweep() {
            self.angle += angle;
            self.to_the_left &= angle > 0.0;
            self.to_the_right &= angle < 0.0;
        }
    }

    pub fn is_both(&self) -> bool {
        !(self.to_the_left || self.to_the_right)
    }
}

/// Whether a closed contour, walked counter-clockwise, is convex.
pub(super) fn is_convex(pieces: &[Piece]) -> bool {
    let mut turning = Turning::none();
    for (i, piece) in pieces.iter().enumerate() {
        turning.along(piece);
        turning.between(piece, &pieces[(i + 1) % pieces.len()]);
        if !turning.to_the_left {
            return false;
        }
    }
    turning.angle < 3.0 * std::f64::consts::PI
}
