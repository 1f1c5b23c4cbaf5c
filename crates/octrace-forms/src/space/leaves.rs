//! The leaves of a union.

use octrace::model::Node;
use octrace::{Affine, BoolOp, Primitive, Solid};

/// What a union is made of, placed in its coordinates.
#[derive(Debug)]
pub(crate) enum Leaf<'a> {
    /// A primitive.
    Primitive(&'a Primitive),
    /// A difference or an intersection.
    Other(&'a Solid),
}

impl Leaf<'_> {
    /// The leaf as a solid where it stands.
    pub fn placed(&self, map: &Affine) -> Solid {
        match self {
            Self::Primitive(primitive) => Solid::primitive((*primitive).clone()).transform(*map),
            Self::Other(solid) => (*solid).clone().transform(*map),
        }
    }
}

/// Whether a primitive was moved so far, or made so large or thin, that it is nothing: then rays do not see it either.
pub(crate) fn is_nothing(primitive: &Primitive, map: &Affine) -> bool {
    map.inverse().is_none_or(|inverse| primitive.exceeds_numbers(&primitive.bounds(map), &inverse))
}

/// All that the union of the solids is made of, in the order of the tree. Parts do not count.
pub(crate) fn leaves(solids: &[Solid]) -> Vec<(Affine, Leaf<'_>)> {
    let mut pending: Vec<(Affine, &Solid)> = solids.iter().rev().map(|s| (Affine::IDENTITY, s)).collect();
    let mut leaves = Vec::new();
    while let Some((map, solid)) = pending.pop() {
        match solid.node() {
            Node::Empty => {}
            Node::Primitive(primitive) if is_nothing(primitive, &map) => {}
            Node::Primitive(primitive) => leaves.push((map, Leaf::Primitive(primitive))),
            Node::Transform(inner, child) => pending.push((map * *inner, child)),
            Node::Part(_, child) => pending.push((map, child)),
            Node::Combine(BoolOp::Union, children) => pending.extend(children.iter().rev().map(|c| (map, c))),
            Node::Combine(..) => leaves.push((map, Leaf::Other(solid))),
        }
    }
    leaves
}
