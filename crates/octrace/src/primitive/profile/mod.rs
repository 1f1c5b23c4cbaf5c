//! Regions of the plane that solids are made from by sweeping: bounded by lines and circular arcs.
//!
//! In come closed contours; out comes a checked, immutable [`Profile`], from which prisms and bodies of revolution are
//! made. It knows a *formula* for its region, "all of" and "any of" half-planes and discs, each edge once: that is what is
//! swept (`chain`, `docs/decisions/0008-profiles.md`).

mod chain;
mod clean;
mod clear;
mod corner;
mod crossing;
mod cut;
mod nesting;
mod outline;
mod piece;
mod prepare;
mod top;
mod turning;
mod verify;

pub(crate) use chain::{Join, Step};
pub(crate) use outline::{Island, Outline};

use crate::geom::Vec2;
use nesting::{area, nesting};
use piece::{Piece, contour_of, pieces_of, reverse};

/// The curve from one corner of a contour to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Curve {
    /// A straight line.
    Line,
    /// A part of a circle; the whole circle where the contour has no other edge.
    Arc {
        /// The middle of the circle.
        center: Vec2,
        /// The circle's radius. Both corners lie on the circle, up to rounding.
        radius: f64,
        /// Whether it is walked counter-clockwise about the middle.
        ccw: bool,
    },
}

/// One edge of a contour: a corner and the curve to the next edge's corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The corner that it starts from.
    pub from: Vec2,
    /// How it goes on from there.
    pub curve: Curve,
}

/// A closed curve of lines and arcs: edges, each from its corner to that of the next, the last one to the first corner.
pub type Contour = Vec<Edge>;

/// A bounded region of the plane with an area: what an odd number of its contours surround.
///
/// Invariants: contours do not cross themselves or each other; they may touch. Those with an odd number of others around
/// them (holes) are clockwise, all others counter-clockwise, so that the region is always to the left.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    contours: Vec<Contour>,
    islands: Vec<Island>,
    bounds: (Vec2, Vec2),
}

/// Why contours are not a [`Profile`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// A number is infinite or NaN.
    #[error("contour {contour} has a number that is not finite")]
    NotFinite {
        /// Index of the contour.
        contour: usize,
    },
    /// An arc's radius is not greater than zero, or one of its ends is not on its circle.
    #[error("the arc of contour {contour} from ({}, {}) is not part of its circle", at.x, at.y)]
    NotRound {
        /// Index of the contour.
        contour: usize,
        /// Where the arc starts.
        at: Vec2,
    },
    /// Two contours cross, or a contour crosses itself.
    #[error("contours {contour} and {other} cross at ({}, {})", at.x, at.y)]
    Crossing {
        /// Index of a contour.
        contour: usize,
        /// Index of the other one, or the same.
        other: usize,
        /// Where they cross, up to rounding.
        at: Vec2,
    },
    /// The contours surround nothing.
    #[error("the contours surround no area")]
    Flat,
}

impl Profile {
    /// The region that an odd number of the contours surround.
    ///
    /// What is put right without a word: edges of no length go; lines that go on straight are joined; a contour that comes
    /// to a corner again becomes several; arcs as good as straight become lines; contours are turned as they are nested.
    ///
    /// # Errors
    /// If contours cross, are no contours, or surround nothing: see [`ProfileError`]. Arcs that cross something at an angle, or
    /// by a length, of less than a ten-millionth count as touching it.
    pub fn new(contours: Vec<Contour>) -> Result<Self, ProfileError> {
        let (mut loops, mut owners) = (Vec::new(), Vec::new());
        for (number, contour) in contours.iter().enumerate() {
            for pieces in clean::loops(number, contour)? {
                if is_flat(&pieces) {
                    continue;
                }
                owners.push(number);
                loops.push(pieces);
            }
        }
        if loops.is_empty() {
            return Err(ProfileError::Flat);
        }
        crossing::check(&loops, &owners)?;
        let nesting = nesting(&loops);
        for pieces in &mut loops {
            if area(pieces) < 0.0 {
                reverse(pieces);
            }
        }
        let outlines = loops.iter().map(|pieces| Outline::new(pieces)).collect();
        let bounds = nesting::bounds(&loops.concat());
        let islands = outline::islands(outlines, &nesting);
        for (pieces, (depth, _)) in loops.iter_mut().zip(nesting) {
            if depth % 2 == 1 {
                reverse(pieces);
            }
        }
        Ok(Self { contours: loops.iter().map(|pieces| contour_of(pieces)).collect(), islands, bounds })
    }

    /// The contours.
    pub fn contours(&self) -> &[Contour] {
        &self.contours
    }

    /// The smallest and the largest coordinates.
    pub fn bounds(&self) -> (Vec2, Vec2) {
        self.bounds
    }

    /// Points around all of it.
    pub(crate) fn hull(&self) -> impl Iterator<Item = Vec2> {
        let pieces = self.contours.iter().flat_map(pieces_of);
        pieces.flat_map(|piece| {
            let (low, high) = piece.bounds();
            match piece.is_line() {
                true => [piece.from; 4],
                false => [low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)],
            }
        })
    }

    /// The formula: any of the islands.
    pub(crate) fn islands(&self) -> &[Island] {
        &self.islands
    }
}

/// Whether pieces surround nothing, to rounding: lines all of which are along one.
fn is_flat(pieces: &[Piece]) -> bool {
    let (low, high) = nesting::bounds(pieces);
    let rounding = piece::ROUNDING * low.length().max(high.length()) * (high - low).length();
    let from = pieces.first().map_or(Vec2::ZERO, |piece| piece.from);
    let farthest = pieces.iter().map(|piece| piece.from - from).max_by(|a, b| a.length().total_cmp(&b.length()));
    let along = farthest.unwrap_or(Vec2::ZERO);
    let is_beside = |piece: &Piece| along.cross(piece.from - from).abs() <= rounding;
    area(pieces).abs() <= rounding && pieces.iter().all(is_beside)
}

#[cfg(test)]
mod tests;
