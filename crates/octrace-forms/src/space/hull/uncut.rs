//! Holes that a hull does not see.
//!
//! The hull of a difference is that of its first operand if nothing that counts for it is taken away: if all corners of the
//! first operand's hull are in the boundary of the difference as well. Then curved things need not be given up.

use super::super::convex::convex;
use super::super::leaves::{Leaf, leaves};
use super::super::mesh::{TriangleMesh, corners};
use super::super::round::Extremes;
use crate::Tolerance;
use octrace::model::Node;
use octrace::{Affine, BoolOp, Solid, Vec3};
use std::collections::HashSet;

/// What the hull of the difference depends on, if that is what the hull of its first operand depends on. `boundary` is the
/// mesh of the difference.
pub(super) fn uncut(difference: &Solid, boundary: &TriangleMesh, tolerance: Tolerance) -> Option<Extremes> {
    let minuend = first_operand(difference)?;
    let mut extremes = Extremes::default();
    for (map, leaf) in leaves(std::slice::from_ref(&minuend)) {
        let Leaf::Primitive(primitive) = leaf else { return None };
        extremes.add(primitive, &map, tolerance).ok()?;
    }
    // Adding zero makes -0.0 equal to 0.0 to the bit.
    let bits = |p: &Vec3| (*p + Vec3::ZERO).to_array().map(f64::to_bits);
    let kept: HashSet<[u64; 3]> = boundary.points.iter().map(bits).collect();
    let hull = convex(&corners(&minuend, difference, tolerance))?;
    hull.points().iter().all(|p| kept.contains(&bits(p))).then_some(extremes)
}

/// What others are taken away from, where it stands.
fn first_operand(difference: &Solid) -> Option<Solid> {
    let (mut map, mut solid, mut found) = (Affine::IDENTITY, difference, false);
    loop {
        match solid.node() {
            Node::Transform(inner, child) => (map, solid) = (map * *inner, child),
            Node::Part(_, child) => solid = child,
            Node::Combine(BoolOp::Difference, children) => (solid, found) = (children.first()?, true),
            _ => return found.then(|| solid.clone().transform(map)),
        }
    }
}
