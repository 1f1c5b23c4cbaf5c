//! The hull of discs in parallel planes that are all rounded by a ball of one size: of rings side by side, of posts and
//! plates with rounded edges.
//!
//! It is the hull of the discs, see [`discs`](super::discs), moved out by the ball's radius. Where two circles of one axis
//! make a cylinder or a cone, that moves out and stays one; with the rings around the rims and the flat ends it is a body of
//! revolution ([`turned`]). The straight edges of the flat ends become cylinders. Oblique cones have no
//! such form: strips take their place, with corners on the rings.
//!
//! So the hull is the union of a body of revolution for each axis, of those cylinders, and of the convex polyhedron of the
//! points where facets and strips touch.

use super::super::arcs::Direction;
use super::super::convex::convex;
use super::super::frusta::frustum;
use super::discs::{Disc, Prepared, Slant, slants};
use super::turned::{self, Axis, Ring};
use octrace::{Solid, Vec3};
use std::f64::consts::FRAC_PI_8;

/// Heights, and axes, that differ by less than this share of the size do not differ: files have six digits.
const SAME: f64 = 1e-6;

/// Edges whose faces meet at a smaller angle (radians) are none.
const SHARPEST: f64 = 1e-6;

/// Strips start at least so fine (radians), and are halved so often at most.
const FIRST_STEP: f64 = FRAC_PI_8;
const DEEPEST: u32 = 12;

/// The hull of the discs, rounded by a ball of radius `round`. Strips are within `deviation` of it.
pub(crate) fn hull(discs: &[Disc], round: f64, deviation: f64) -> Solid {
    let Prepared { discs, size, noise } = Prepared::new(discs, SAME);
    let rounding = Rounding { round, deviation, same: SAME * size };
    // A single disc has neither neighbours nor edges.
    let mut on_hull: Vec<Disc> = if discs.len() == 1 { discs.clone() } else { Vec::new() };
    let mut touched = Vec::new();
    let mut parts = Vec::new();
    for slant in slants(&discs, noise) {
        on_hull.extend(slant.discs);
        rounding.touch(&slant, &mut touched);
        let [a, b] = slant.discs;
        if a.radius == 0.0 && b.radius == 0.0 {
            parts.push(frustum((a.center, round), (b.center, round)));
        }
    }
    for edge in edges(&discs, noise) {
        on_hull.extend(edge.discs);
        let ends = edge.discs.map(|disc| disc.rim(edge.outward));
        parts.push(frustum((ends[0], round), (ends[1], round)));
        touched.extend(edge.normals.iter().flat_map(|&n| ends.map(|end| end + n * round)));
    }
    parts.extend(convex(&touched).map(Solid::primitive));
    parts.extend(rounding.columns(&on_hull));
    Solid::union(parts)
}

/// What rounds the discs.
struct Rounding {
    /// The ball's radius.
    round: f64,
    /// How far strips may be off.
    deviation: f64,
    /// Axes closer than this are one.
    same: f64,
}

impl Rounding {
    fn is_coaxial(&self, a: &Disc, b: &Disc) -> bool {
        let offset = b.center - a.center;
        Vec3::new(offset.x, offset.y, 0.0).length() <= self.same
    }

    /// Adds where facets beside a pair of discs touch, and strips between them where no cone is.
    fn touch(&self, slant: &Slant, touched: &mut Vec<Vec3>) {
        let [a, b] = slant.discs;
        touched.extend(slant.arcs.ends().flat_map(|end| self.ruling(slant, end.outward()).ends));
        if self.is_coaxial(&a, &b) || (a.radius == 0.0 && b.radius == 0.0) {
            return;
        }
        for (from, to) in slant.arcs.spans() {
            let at = |angle: f64| (angle, self.ruling(slant, Direction::at(angle).outward()));
            let mut pending = Vec::new();
            let steps = ((to - from) / FIRST_STEP).ceil();
            let stop = |step: u32| at(from + (to - from) * (f64::from(step) / steps));
            pending.extend((0..steps as u32).map(|step| (stop(step), stop(step + 1), 0)));
            while let Some((start, end, depth)) = pending.pop() {
                touched.extend(start.1.ends);
                if depth < DEEPEST && start.1.sagitta(&end.1) > self.deviation {
                    let middle = at(0.5 * (start.0 + end.0));
                    pending.extend([(start, middle, depth + 1), (middle, end, depth + 1)]);
                }
            }
        }
    }

    /// Where the plane with this normal, seen from above, touches.
    fn ruling(&self, slant: &Slant, outward: Vec3) -> Ruling {
        let normal = slant.normal(outward);
        let normal = normal / normal.length();
        Ruling { ends: slant.discs.map(|disc| disc.rim(outward) + normal * self.round), normal }
    }

    /// Bodies of revolution about the axes of the discs.
    fn columns(&self, on_hull: &[Disc]) -> Vec<Solid> {
        let mut columns: Vec<Vec<Disc>> = Vec::new();
        for disc in on_hull {
            match columns.iter_mut().find(|column| self.is_coaxial(&column[0], disc)) {
                Some(column) if column.contains(disc) => {}
                Some(column) => column.push(*disc),
                None => columns.push(vec![*disc]),
            }
        }
        let body = |column: &Vec<Disc>| {
            let ring = |d: &Disc| Ring { distance: d.radius, z: d.center.z, radius: self.round };
            let foot = column[0].center;
            let axis = Axis { origin: Vec3::new(foot.x, foot.y, 0.0), direction: Vec3::Z, sides: [Vec3::X, Vec3::Y] };
            turned::hull(&column.iter().map(ring).collect::<Vec<Ring>>(), &axis)
        };
        columns.iter().map(body).collect()
    }
}

/// A straight line on the hull, along which a plane touches it.
#[derive(Clone, Copy, Debug)]
struct Ruling {
    ends: [Vec3; 2],
    normal: Vec3,
}

impl Ruling {
    /// How far the hull is from the strip between two rulings, about: what a circle is that turns by as much.
    fn sagitta(&self, other: &Self) -> f64 {
        let chord = |side: usize| (other.ends[side] - self.ends[side]).length();
        let turn = (other.normal - self.normal).length();
        chord(0).max(chord(1)) * turn / 8.0
    }
}

/// A straight edge between two discs at one height, and the normals of the faces that meet there.
struct Edge {
    discs: [Disc; 2],
    /// From the middles of the discs to the edge.
    outward: Vec3,
    normals: [Vec3; 2],
}

/// All such edges.
fn edges(discs: &[Disc], noise: f64) -> Vec<Edge> {
    let pairs = discs.iter().enumerate().flat_map(|(i, a)| discs[i + 1..].iter().map(move |b| [a, b]));
    let level = pairs.filter(|[a, b]| a.center.z == b.center.z);
    level.flat_map(|pair| tangents(pair).into_iter().filter_map(move |t| edge(pair, t, discs, noise))).collect()
}

/// The directions in which two discs at one height reach equally far.
fn tangents([a, b]: [&Disc; 2]) -> Vec<Vec3> {
    let offset = b.center - a.center;
    let (Some(along), length) = (offset.normalized(), offset.length()) else { return Vec::new() };
    let cos = (a.radius - b.radius) / length;
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let left = Vec3::Z.cross(along);
    vec![along * cos + left * sin, along * cos - left * sin]
}

/// The edge on that side of two discs at one height, if planes through it have all others behind them.
fn edge([a, b]: [&Disc; 2], outward: Vec3, discs: &[Disc], noise: f64) -> Option<Edge> {
    // Normals are `outward + Z s`; the slopes s for which a plane has all discs behind it are between these.
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let along = Vec3::Z.cross(outward);
    for other in discs.iter().filter(|&other| other != a && other != b) {
        let offset = other.center - a.center;
        let beyond = offset.dot(outward) + other.radius - a.radius;
        if offset.z > 0.0 {
            high = high.min(-beyond / offset.z);
        } else if offset.z < 0.0 {
            low = low.max(-beyond / offset.z);
        } else if beyond.abs() <= noise {
            // Of edges in a row the longest one will do.
            let (at, end) = (offset.dot(along), (b.center - a.center).dot(along));
            if at < end.min(0.0) || at > end.max(0.0) {
                return None;
            }
        } else if beyond > 0.0 {
            return None;
        }
    }
    let normal = |slope: f64| match slope.is_finite() {
        true => (outward + Vec3::Z * slope) / (1.0 + slope * slope).sqrt(),
        false => Vec3::Z * slope.signum(),
    };
    let normals = [normal(low), normal(high)];
    (high > low && (normals[1] - normals[0]).length() > SHARPEST).then_some(Edge { discs: [*a, *b], outward, normals })
}
