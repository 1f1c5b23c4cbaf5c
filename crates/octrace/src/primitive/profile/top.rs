//! The corner that is farthest in a direction.

use super::nesting::bounds;
use super::piece::{Piece, ROUNDING, higher};
use crate::geom::Vec2;

/// The farthest of the points seen so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Top {
    up: Vec2,
    /// The point.
    pub at: Vec2,
    /// How far it is, to rounding.
    pub height: f64,
}

impl Top {
    pub fn new(up: Vec2, at: Vec2) -> Self {
        Self { up, at, height: up.dot(at) }
    }

    /// Takes a point if it is farther, or as far and more to the right; right in any case.
    pub fn rise(&mut self, to: Vec2) -> bool {
        let new = Self::new(self.up, to);
        let slack = ROUNDING * (self.up.x * to.x).abs().max((self.up.y * to.y).abs()).max(self.height.abs());
        let is_higher = if (new.height - self.height).abs() > slack {
            new.height > self.height
        } else {
            let side = higher(self.up, to, self.at);
            side > 0.0 || (side == 0.0 && higher(-self.up.left(), to, self.at) > 0.0)
        };
        if is_higher {
            *self = new;
        }
        is_higher
    }
}

/// Boxes around pieces that follow each other, so as not to look at all of them.
#[derive(Debug)]
pub(super) struct Blocks {
    boxes: Vec<(Vec2, Vec2)>,
}

impl Blocks {
    const SIZE: usize = 64;

    pub fn new(pieces: &[Piece]) -> Self {
        Self { boxes: pieces.chunks(Self::SIZE).map(bounds).collect() }
    }

    /// The first piece from `i` on that is not in a block all of which is lower.
    pub fn next_up(&self, mut i: usize, top: &Top) -> usize {
        while i.is_multiple_of(Self::SIZE) {
            let Some(&(low, high)) = self.boxes.get(i / Self::SIZE) else { break };
            let x = if top.up.x > 0.0 { high.x } else { low.x } * top.up.x;
            let y = if top.up.y > 0.0 { high.y } else { low.y } * top.up.y;
            if x + y + ROUNDING * (x.abs() + y.abs() + top.height.abs()) >= top.height {
                break;
            }
            i += Self::SIZE;
        }
        i
    }
}
