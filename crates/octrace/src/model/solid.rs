//! The CSG tree as modelled [Roth 1982; Comba-Persiano, §2.1].

use super::PartId;
use crate::geom::{Affine, Vec3};
use crate::primitive::{Primitive, Profile};
use std::collections::HashMap;
use std::ops::{Add, BitAnd, BitOr, Sub};
use std::sync::Arc;

/// A regularised boolean operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BoolOp {
    /// What is in any operand.
    Union,
    /// What is in every operand.
    Intersection,
    /// What is in the first operand and in none of the others.
    Difference,
}

/// A solid: a CSG tree, immutable and cheap to clone (clones share the tree).
///
/// ```
/// use octrace::Solid;
/// let plate = Solid::block().scale([40.0, 30.0, 5.0]);
/// let hole = Solid::cylinder().scale([3.0, 3.0, 5.0]).translate([20.0, 15.0, 0.0]);
/// let drilled = plate - hole;
/// ```
#[derive(Clone, Debug)]
pub struct Solid(Arc<Node>);

/// One node of a [`Solid`].
#[derive(Debug)]
pub enum Node {
    /// Nothing at all.
    Empty,
    /// A primitive in its own coordinates.
    Primitive(Primitive),
    /// The child, moved by an invertible map.
    Transform(Affine, Solid),
    /// The children, combined in this order.
    Combine(BoolOp, Vec<Solid>),
    /// The child; its leaves that belong to no part yet belong to this one.
    Part(PartId, Solid),
}

impl Solid {
    /// The solid without a point.
    pub fn empty() -> Self {
        Self(Arc::new(Node::Empty))
    }

    /// The given primitive, in its own coordinates.
    pub fn primitive(primitive: impl Into<Primitive>) -> Self {
        Self(Arc::new(Node::Primitive(primitive.into())))
    }

    /// The paper's BLOCK: the unit cube in the first octant, a corner at the origin.
    pub fn block() -> Self {
        Self::primitive(Primitive::Block)
    }

    /// The paper's SPHERE: the unit ball about the origin.
    pub fn sphere() -> Self {
        Self::primitive(Primitive::Sphere)
    }

    /// The paper's CYLINDER: radius 1, height 1, base on z = 0, about the z axis.
    pub fn cylinder() -> Self {
        Self::primitive(Primitive::Cylinder)
    }

    /// The paper's PLANE: the unbounded half-space z >= 0.
    pub fn half_space() -> Self {
        Self::primitive(Primitive::HalfSpace)
    }

    /// What is above a profile in the xy plane, up to z = 1.
    pub fn prism(profile: impl Into<Arc<Profile>>) -> Self {
        Self::primitive(Primitive::Prism { profile: profile.into(), top: 1.0 })
    }

    /// What a profile sweeps around the z axis: its x is the distance from the axis, its y is z. What it has to the left of its
    /// y axis is cut off.
    pub fn revolution(profile: impl Into<Arc<Profile>>) -> Self {
        Self::primitive(Primitive::Revolution(profile.into()))
    }

    /// What is in any of the solids; empty for none.
    pub fn union(solids: impl IntoIterator<Item = Solid>) -> Self {
        Self::combine(BoolOp::Union, solids)
    }

    /// What is in all of the solids; empty for none.
    pub fn intersection(solids: impl IntoIterator<Item = Solid>) -> Self {
        Self::combine(BoolOp::Intersection, solids)
    }

    /// What is in the first of the solids and in none of the others; empty for none.
    pub fn difference(solids: impl IntoIterator<Item = Solid>) -> Self {
        Self::combine(BoolOp::Difference, solids)
    }

    /// The solids combined by `op`, in this order; empty for none.
    pub fn combine(op: BoolOp, solids: impl IntoIterator<Item = Solid>) -> Self {
        let mut solids: Vec<Solid> = solids.into_iter().collect();
        match solids.len() {
            0 => Self::empty(),
            1 => solids.remove(0),
            _ => Self(Arc::new(Node::Combine(op, solids))),
        }
    }

    /// The solid moved by `map`. A map that has no inverse flattens it to a regularised nothing: the empty solid.
    pub fn transform(self, map: Affine) -> Self {
        if map.inverse().is_none() {
            return Self::empty();
        }
        if map == Affine::IDENTITY {
            return self;
        }
        Self(Arc::new(Node::Transform(map, self)))
    }

    /// The solid moved by `(x, y, z)`.
    pub fn translate(self, by: impl Into<Vec3>) -> Self {
        self.transform(Affine::translation(by.into()))
    }

    /// The solid turned by these degrees about X, then Y, then Z.
    pub fn rotate(self, angles_deg: impl Into<Vec3>) -> Self {
        self.transform(Affine::rotation_deg(angles_deg.into()))
    }

    /// The solid scaled about the origin, by axis.
    pub fn scale(self, by: impl Into<Vec3>) -> Self {
        self.transform(Affine::scale(by.into()))
    }

    /// The solid with every leaf that belongs to no part yet put into `part`.
    pub fn part(self, part: PartId) -> Self {
        Self(Arc::new(Node::Part(part, self)))
    }

    /// The solid with no leaf belonging to any part. Trees that are shared stay shared.
    pub fn unpainted(&self) -> Self {
        fn strip(solid: &Solid, done: &mut HashMap<usize, Solid>) -> Solid {
            const RED_ZONE: usize = 64 << 10;
            const SEGMENT: usize = 4 << 20;
            if let Some(known) = done.get(&solid.id()) {
                return known.clone();
            }
            let bare = stacker::maybe_grow(RED_ZONE, SEGMENT, || match solid.node() {
                Node::Empty | Node::Primitive(_) => solid.clone(),
                Node::Transform(map, child) => Solid(Arc::new(Node::Transform(*map, strip(child, done)))),
                Node::Part(_, child) => strip(child, done),
                Node::Combine(op, children) => {
                    let children = children.iter().map(|child| strip(child, done)).collect();
                    Solid(Arc::new(Node::Combine(*op, children)))
                }
            });
            done.insert(solid.id(), bare.clone());
            bare
        }
        strip(self, &mut HashMap::new())
    }

    /// The topmost node of the tree.
    pub fn node(&self) -> &Node {
        &self.0
    }

    /// An address that clones share and different trees do not, to recognise repeated subtrees.
    pub fn id(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }
}

impl Drop for Node {
    /// Takes deep trees apart without recursion.
    fn drop(&mut self) {
        fn take(node: &mut Node, into: &mut Vec<Solid>) {
            match node {
                Node::Empty | Node::Primitive(_) => {}
                Node::Transform(_, child) | Node::Part(_, child) => {
                    if !matches!(*child.0, Node::Empty | Node::Primitive(_)) {
                        into.push(std::mem::replace(child, Solid::empty()));
                    }
                }
                Node::Combine(_, children) => into.append(children),
            }
        }
        let mut pending = Vec::new();
        take(self, &mut pending);
        while let Some(mut solid) = pending.pop() {
            if let Some(node) = Arc::get_mut(&mut solid.0) {
                take(node, &mut pending);
            }
        }
    }
}

/// Union.
impl Add for Solid {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::union([self, o])
    }
}

/// Union.
impl BitOr for Solid {
    type Output = Self;
    fn bitor(self, o: Self) -> Self {
        Self::union([self, o])
    }
}

/// Intersection.
impl BitAnd for Solid {
    type Output = Self;
    fn bitand(self, o: Self) -> Self {
        Self::intersection([self, o])
    }
}

/// Difference.
impl Sub for Solid {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::difference([self, o])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_very_deep_tree_is_dropped_without_overflow() {
        let mut solid = Solid::block();
        for i in 0..1_000_000 {
            solid = if i % 2 == 0 { solid.translate([1.0, 0.0, 0.0]) } else { solid - Solid::sphere() };
        }
        drop(solid);
    }

    #[test]
    fn flattening_maps_leave_nothing() {
        assert!(matches!(Solid::block().scale([1.0, 1.0, 0.0]).node(), Node::Empty));
    }
}
