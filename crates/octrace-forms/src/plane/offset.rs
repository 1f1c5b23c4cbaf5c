//! Outlines grown or shrunk, as OpenSCAD's `offset` does it.
//!
//! Every edge is moved to its right by the distance, which is outwards; convex corners get a join, and at reflex ones the
//! curve goes from the end of one edge to the corner itself and on to the start of the next. The curve goes around what is
//! within the distance of the outline, counting turns. To shrink is to grow the other side.

use super::boolean::{Fill, region};
use super::curve::{edges, reversed, sweep, turned};
use super::{Outline, PlaneError};
use octrace::{Contour, Curve, Edge, Vec2};
use std::f64::consts::TAU;

/// How to offset, and how far: outwards where the distance is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Offset {
    /// All points within a distance: convex corners become round. Negative: all points that far from the outside.
    Round {
        /// The distance.
        r: f64,
        /// `None` for true arcs; else the number of facets that a full circle would have, turned as OpenSCAD turns them;
        /// from 3 up to 16384.
        facets: Option<u32>,
    },
    /// All edges moved by a distance, and extended until they meet.
    Delta {
        /// The distance.
        delta: f64,
        /// Whether corners are cut off at that distance instead.
        chamfer: bool,
    },
}

/// What fills the gap between the ends of two moved edges at a convex corner.
#[derive(Clone, Copy, Debug)]
enum Join {
    Arc,
    /// So many for a full turn; the shorter one that is left over comes last, or first.
    Facets(u32, Rest),
    Miter,
    Chamfer,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Rest {
    Last,
    First,
}

/// Edges whose directions differ by less than this angle go on straight: numbers in files have six digits.
const STRAIGHT: f64 = 1e-6;

/// More facets of a full turn than this are not made.
const MOST_FACETS: u32 = 16384;

/// A miter longer than this many times the distance is cut off, as OpenSCAD has it.
const LONGEST_MITER: f64 = 1e6;

impl Outline {
    /// The outline grown or shrunk. Arcs stay arcs, whatever the join: they are neither corners nor straight.
    ///
    /// # Errors
    /// If the distance is not finite, or as for [`region`].
    pub fn offset(&self, offset: Offset) -> Result<Self, PlaneError> {
        let (distance, join) = match offset {
            Offset::Round { r, facets: None } => (r, Join::Arc),
            Offset::Round { r, facets: Some(facets) } => {
                (r, Join::Facets(facets.clamp(3, MOST_FACETS), if r > 0.0 { Rest::Last } else { Rest::First }))
            }
            Offset::Delta { delta, chamfer: false } => (delta, Join::Miter),
            Offset::Delta { delta, chamfer: true } => (delta, Join::Chamfer),
        };
        if !distance.is_finite() {
            return Err(PlaneError::NotFinite);
        }
        if distance == 0.0 || self.is_empty() {
            return Ok(self.clone());
        }
        if distance > 0.0 {
            let grown: Vec<Contour> = self.contours.iter().map(|contour| moved(contour, distance, join)).collect();
            region(&grown, Fill::Positive)
        } else {
            let outside = |contour: &Contour| moved(&reversed(contour), -distance, join);
            let shrunk: Vec<Contour> = self.contours.iter().map(outside).collect();
            region(&shrunk, Fill::Negative)
        }
    }
}

/// One edge moved to the right: what its ends become, and the curve between.
struct Moved {
    corner: Vec2,
    /// Unit vectors to the right at its start and its end.
    normals: [Vec2; 2],
    /// The length of a line; 0 for an arc.
    length: f64,
    curve: MovedCurve,
}

enum MovedCurve {
    Line,
    Arc {
        center: Vec2,
        radius: f64,
        ccw: bool,
    },
    /// An arc bent to the right as tightly as the distance, or more: all that it moves over is around its middle.
    Middle(Vec2),
}

fn right(v: Vec2) -> Vec2 {
    let length = v.length();
    if length > 0.0 { Vec2::new(v.y / length, -v.x / length) } else { Vec2::ZERO }
}

fn moved_edge(edge: &Edge, to: Vec2, distance: f64) -> Moved {
    let corner = edge.from;
    match edge.curve {
        Curve::Line => {
            let along = to - corner;
            Moved { corner, normals: [right(along); 2], length: along.length(), curve: MovedCurve::Line }
        }
        Curve::Arc { center, radius, ccw } => {
            let sign = if ccw { 1.0 } else { -1.0 };
            let normals = [corner, to].map(|p| (p - center) * (sign / radius));
            let radius = radius + sign * distance;
            let curve = if radius > 0.0 { MovedCurve::Arc { center, radius, ccw } } else { MovedCurve::Middle(center) };
            Moved { corner, normals, length: 0.0, curve }
        }
    }
}

/// The closed curve that a contour becomes.
fn moved(contour: &Contour, distance: f64, join: Join) -> Contour {
    if let [Edge { curve: Curve::Arc { center, radius, ccw }, .. }] = contour[..] {
        // A circle has no corners; a hole that is filled up goes around nothing.
        let radius = if ccw { radius + distance } else { radius - distance };
        let from = center + Vec2::new(radius, 0.0);
        return if radius > 0.0 { vec![Edge { from, curve: Curve::Arc { center, radius, ccw } }] } else { Vec::new() };
    }
    let edges: Vec<Moved> = edges(contour)
        .filter(|(edge, to)| edge.from != *to || edge.curve != Curve::Line)
        .map(|(edge, to)| moved_edge(&edge, to, distance))
        .collect();
    let count = edges.len();
    let crossings: Vec<Option<Vec2>> =
        (0..count).map(|i| crossing(&edges[(i + count - 1) % count], &edges[i], distance)).collect();
    let mut result = Contour::with_capacity(2 * count);
    let line_from = |from: Vec2, result: &mut Contour| result.push(Edge { from, curve: Curve::Line });
    for (i, edge) in edges.iter().enumerate() {
        let next = (i + 1) % count;
        let start = edge.corner + edge.normals[0] * distance;
        match edge.curve {
            MovedCurve::Line => line_from(crossings[i].unwrap_or(start), &mut result),
            MovedCurve::Arc { center, radius, ccw } => {
                result.push(Edge { from: start, curve: Curve::Arc { center, radius, ccw } });
            }
            MovedCurve::Middle(center) => {
                // From the corner through the middle to the next corner: out and back where edges are tangent.
                line_from(edge.corner, &mut result);
                line_from(center, &mut result);
                line_from(edges[next].corner, &mut result);
            }
        }
        if crossings[next].is_none() {
            around_corner(edge, &edges[next], distance, join, &mut result);
        }
    }
    without_repeats(result)
}

/// How the curve goes from the end of a moved edge around the corner to the start of the next, both excluded.
fn around_corner(edge: &Moved, next: &Moved, distance: f64, join: Join, result: &mut Contour) {
    let mut line_from = |from: Vec2| result.push(Edge { from, curve: Curve::Line });
    let (corner, a, b) = (next.corner, edge.normals[1], next.normals[0]);
    let (sine, cosine) = (a.cross(b), a.dot(b));
    let [from_middle, to_middle] = [edge, next].map(|edge| matches!(edge.curve, MovedCurve::Middle(_)));
    if sine > STRAIGHT || (sine >= -STRAIGHT && cosine < 0.0) {
        joined(corner, a, b, distance, join, result);
        if to_middle {
            result.push(Edge { from: corner + b * distance, curve: Curve::Line });
        }
    } else if !from_middle && (to_middle || sine < -STRAIGHT) {
        line_from(corner + a * distance);
        line_from(corner);
    }
}

/// Where two lines that meet at a reflex corner cross after they were moved, if no farther than half-way. There the curve may
/// go from one to the other at once: what it leaves out is moved over by both, and by halves of lines that leave nothing else
/// out there.
fn crossing(edge: &Moved, next: &Moved, distance: f64) -> Option<Vec2> {
    let (a, b) = (edge.normals[1], next.normals[0]);
    let (sine, cosine) = (a.cross(b), a.dot(b));
    let shortened = distance * -sine / (1.0 + cosine);
    let cross = sine < -STRAIGHT && 2.0 * shortened <= edge.length.min(next.length);
    cross.then(|| next.corner + (a + b) * (distance / (1.0 + cosine)))
}

/// The join about a corner from one normal to the next, without its last corner.
fn joined(corner: Vec2, a: Vec2, b: Vec2, distance: f64, join: Join, result: &mut Contour) {
    let (sine, cosine) = (a.cross(b), a.dot(b));
    let from = corner + a * distance;
    let mut line_from = |from: Vec2| result.push(Edge { from, curve: Curve::Line });
    match join {
        Join::Arc => result.push(Edge { from, curve: Curve::Arc { center: corner, radius: distance, ccw: true } }),
        Join::Facets(facets, rest) => {
            // As many whole steps as fit best, but for one, and what is left.
            let step = TAU / f64::from(facets);
            let steps = (sweep(Vec2::ZERO, true, a, b) / step).round().max(1.0);
            line_from(from);
            let mut i = 1.0;
            while i < steps {
                let normal = if rest == Rest::Last { turned(a, step * i) } else { turned(b, step * (i - steps)) };
                line_from(corner + normal * distance);
                i += 1.0;
            }
        }
        Join::Miter if 1.0 + cosine > 2.0 / (LONGEST_MITER * LONGEST_MITER) => {
            line_from(from);
            line_from(corner + (a + b) * (distance / (1.0 + cosine)));
        }
        Join::Miter | Join::Chamfer => {
            // Cut off by a line at the distance, across the middle between the two.
            let along = libm::tan(libm::atan2(sine, cosine) * 0.25);
            line_from(from);
            line_from(corner + (a + a.left() * along) * distance);
            line_from(corner + (b - b.left() * along) * distance);
        }
    }
}

/// Takes out edges that lead nowhere.
fn without_repeats(contour: Contour) -> Contour {
    let kept = edges(&contour).filter(|(edge, to)| edge.from != *to || edge.curve != Curve::Line);
    kept.map(|(edge, _)| edge).collect()
}

#[cfg(test)]
mod tests;
