//! The hull of rings, discs and balls about one axis, exactly.
//!
//! In the half-plane of distance from the axis and height they are circles with centres `(d, z)` and radii `r`: a ring's
//! tube; `d = 0` for a ball; `r = 0` for a disc. A normal at the angle `p` from the horizontal belongs to the circle with
//! the largest `d cos p + z sin p + r`. So each circle has arcs of normals, from which the others cut theirs; where arcs
//! end the hull has tangents, and touches the circle.
//!
//! The hull is the union of the rings and balls that have arcs left, and of the cones between circles through touching
//! points, taken by height: what is between these and the surface is between a chord and its arc, hence in a ring or ball.

use super::super::arcs::Arcs;
use super::super::frusta::between;
use octrace::{Affine, Primitive, Solid, Vec3};

/// A ring, a disc or a ball by its section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ring {
    /// How far the middle of the tube is from the axis; zero or more.
    pub distance: f64,
    /// Height of the middle.
    pub z: f64,
    /// Radius of the tube; zero or more.
    pub radius: f64,
}

/// An axis, with two directions across it. All have length one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    pub origin: Vec3,
    pub direction: Vec3,
    pub sides: [Vec3; 2],
}

/// What is smaller than this, as a share of the size of everything, is rounding.
const NOISE: f64 = 1e-13;

/// The hull of what is about the axis.
pub(crate) fn hull(rings: &[Ring], axis: &Axis) -> Solid {
    let size = rings.iter().map(|r| r.distance + r.radius + r.z.abs()).fold(0.0, f64::max);
    let mut touched: Vec<(f64, f64)> = Vec::new();
    let mut parts = Vec::new();
    for (i, ring) in rings.iter().enumerate() {
        let mut arcs = Arcs::Full;
        arcs.keep(-1.0, 0.0, 0.0, 0.0);
        for (k, other) in rings.iter().enumerate() {
            let same = other == ring;
            if k != i && !(same && i < k) && !arcs.is_empty() {
                let slack = if same { -size } else { ring.radius - other.radius };
                arcs.keep(other.distance - ring.distance, other.z - ring.z, slack, NOISE * size);
            }
        }
        if arcs.is_empty() {
            continue;
        }
        touched.extend(arcs.ends().map(|n| (ring.z + ring.radius * n.sin, ring.distance + ring.radius * n.cos)));
        if ring.radius > 0.0 {
            parts.push(ring.solid(axis));
        }
    }
    touched.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1)));
    // Of touching points at one height the outermost.
    touched.dedup_by(|a, b| a.0 - b.0 <= 1e-12 * size);
    let at = |(z, radius): (f64, f64)| (axis.origin + axis.direction * z, radius);
    parts.extend(touched.windows(2).map(|pair| between(at(pair[0]), at(pair[1]), axis.sides)));
    Solid::union(parts)
}

impl Ring {
    fn solid(&self, axis: &Axis) -> Solid {
        let (primitive, scale) = match self.distance > 0.0 {
            true => (Primitive::Torus { minor: self.radius / self.distance }, self.distance),
            false => (Primitive::Sphere, self.radius),
        };
        let [u, v, w] = [axis.sides[0], axis.sides[1], axis.direction].map(|d| d * scale);
        let row = |axis: usize| Vec3::new(u[axis], v[axis], w[axis]);
        let translation = axis.origin + axis.direction * self.z;
        Solid::primitive(primitive).transform(Affine { rows: [row(0), row(1), row(2)], translation })
    }
}
