//! The formulas of a profile's contours, and how contours with holes are put together.

use super::chain::Step;
use super::nesting::bounds;
use super::piece::Piece;
use super::verify::verified;
use crate::geom::Vec2;

/// What one contour surrounds, holes not yet taken out.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outline {
    /// Its formula.
    pub steps: Vec<Step>,
    /// Whether the formula is that of a convex contour: all of its edges.
    pub is_convex: bool,
    /// Lines around it, walked counter-clockwise: below, to the right, above, to the left.
    pub frame: [(Vec2, Vec2); 4],
    /// The numbers of its edges, for an estimate.
    pub edges: usize,
}

/// A contour and the holes in it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Island {
    /// The outer contour.
    pub outer: Outline,
    /// What is taken out.
    pub holes: Vec<Outline>,
}

impl Outline {
    /// The outline of a contour that is walked counter-clockwise.
    pub(super) fn new(pieces: &[Piece]) -> Self {
        let (steps, is_convex) = verified(pieces);
        Self { steps, is_convex, frame: frame(pieces), edges: pieces.len() }
    }
}

/// Puts contours, with how many are around them and the innermost of those, into their places.
pub(super) fn islands(outlines: Vec<Outline>, nesting: &[(usize, Option<usize>)]) -> Vec<Island> {
    let mut holes: Vec<Vec<Outline>> = vec![Vec::new(); outlines.len()];
    let mut outer = Vec::new();
    for (number, (outline, &(depth, around))) in outlines.into_iter().zip(nesting).enumerate() {
        match around {
            Some(around) if depth % 2 == 1 => holes[around].push(outline),
            _ => outer.push((number, outline)),
        }
    }
    outer.into_iter().map(|(number, outer)| Island { outer, holes: std::mem::take(&mut holes[number]) }).collect()
}

/// The box around a contour, through its corners; where an arc reaches farther than they do, at a distance: lines that
/// touch arcs would be taken for them by some rays.
fn frame(pieces: &[Piece]) -> [(Vec2, Vec2); 4] {
    const DISTANCE: f64 = 1.0 / 64.0;
    let (low, high) = bounds(pieces);
    let room = (high - low) * DISTANCE;
    let corner = |pick: fn(Vec2) -> f64, choose: fn(f64, f64) -> f64| {
        pieces.iter().filter(|piece| !piece.is_whole()).map(|piece| pick(piece.from)).reduce(choose)
    };
    let x = |p: Vec2| p.x;
    let y = |p: Vec2| p.y;
    let side = |corner: Option<f64>, end: f64, room: f64| if corner == Some(end) { end } else { end + room };
    let (left, right) = (side(corner(x, f64::min), low.x, -room.x), side(corner(x, f64::max), high.x, room.x));
    let (below, above) = (side(corner(y, f64::min), low.y, -room.y), side(corner(y, f64::max), high.y, room.y));
    let corners = [(left, below), (right, below), (right, above), (left, above)].map(|(x, y)| Vec2::new(x, y));
    [0, 1, 2, 3].map(|i| (corners[i], corners[(i + 1) % 4]))
}
