//! The CSG tree, cut to what fits on a page. Whatever is left out is there as one node, "… n more".

use super::names;
use octrace::model::Node;
use octrace::{Affine, BoolOp, Solid};
use std::collections::VecDeque;

/// What a node of the sketch stands for.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A boolean operator.
    Operator(BoolOp),
    /// A primitive; its number.
    Primitive(usize),
    /// The empty solid.
    Nothing,
    /// An operator whose so many primitives are not shown.
    Folded(BoolOp, usize),
    /// The last so many operands of the node above, with so many primitives.
    More(usize, usize),
}

/// A node of the sketch.
#[derive(Clone, Debug)]
pub struct SketchNode {
    /// What it stands for.
    pub kind: Kind,
    /// The part of the scene's solid that it stands for, in its place.
    pub solid: Solid,
    /// Indices of the operands, in order, behind this one's.
    pub children: Vec<usize>,
    /// The number of its first primitive.
    first_leaf: usize,
    depth: usize,
}

/// Of more operands than fit, so many are shown at most.
const SHOWN: usize = 4;
/// Deeper, nothing is unfolded.
const DEEPEST: usize = 6;

/// The tree, with at most so many nodes that have no operands below them. The root comes first.
pub fn sketch(solid: &Solid, most_tips: usize) -> Vec<SketchNode> {
    let mut nodes = vec![node(solid, Affine::IDENTITY, 0, 0)];
    let (mut tips, mut folded) = (1, VecDeque::from([0]));
    while let Some(index) = folded.pop_front() {
        let Kind::Folded(op, _) = nodes[index].kind else { continue };
        let (inner, map) = bare(&nodes[index].solid);
        let Node::Combine(_, operands) = inner.node() else { continue };
        let operands = operands.clone();
        let (depth, room) = (nodes[index].depth, most_tips + 1 - tips);
        let shown = if operands.len() <= room { operands.len() } else { SHOWN.min(room.saturating_sub(1)) };
        if shown == 0 || depth == DEEPEST {
            continue;
        }
        let mut leaf = nodes[index].first_leaf;
        let mut children = Vec::new();
        for operand in &operands[..shown] {
            let child = node(operand, map, leaf, depth + 1);
            leaf += names::count(operand);
            folded.push_back(nodes.len());
            children.push(nodes.len());
            nodes.push(child);
        }
        if let rest @ [_, ..] = &operands[shown..] {
            // Taken together, the operands of a difference after the first are a union.
            let joined = if op == BoolOp::Difference { BoolOp::Union } else { op };
            let solid = Solid::combine(joined, rest.iter().cloned()).transform(map);
            let kind = Kind::More(rest.len(), names::count(&solid));
            children.push(nodes.len());
            nodes.push(SketchNode { kind, solid, children: Vec::new(), first_leaf: leaf, depth: depth + 1 });
        }
        tips += children.len() - 1;
        nodes[index].children = children;
        nodes[index].kind = Kind::Operator(op);
    }
    nodes
}

/// The solid without the maps and parts around it, and the product of the maps.
fn bare(solid: &Solid) -> (Solid, Affine) {
    let (mut inner, mut map) = (solid, Affine::IDENTITY);
    loop {
        match inner.node() {
            Node::Transform(own, child) => (inner, map) = (child, map * *own),
            Node::Part(_, child) => inner = child,
            _ => return (inner.clone(), map),
        }
    }
}

fn node(solid: &Solid, map: Affine, first_leaf: usize, depth: usize) -> SketchNode {
    let (inner, own) = bare(solid);
    let kind = match inner.node() {
        Node::Primitive(_) => Kind::Primitive(first_leaf),
        Node::Combine(op, _) => Kind::Folded(*op, names::count(&inner)),
        _ => Kind::Nothing,
    };
    SketchNode { kind, solid: inner.transform(map * own), children: Vec::new(), first_leaf, depth }
}

impl SketchNode {
    /// The bare primitive, where it is one.
    pub fn primitive(&self) -> Option<octrace::Primitive> {
        match bare(&self.solid).0.node() {
            Node::Primitive(primitive) => Some(primitive.clone()),
            _ => None,
        }
    }

    /// What it is called.
    pub fn name(&self) -> String {
        match self.kind {
            Kind::Operator(op) | Kind::Folded(op, _) => operator_name(op).into(),
            Kind::Primitive(leaf) => names::name(&bare(&self.solid).0, leaf),
            Kind::Nothing => "empty".into(),
            Kind::More(operands, _) => format!("… {operands} more"),
        }
    }
}

/// The operator in words.
pub fn operator_name(op: BoolOp) -> &'static str {
    match op {
        BoolOp::Union => "union",
        BoolOp::Intersection => "intersection",
        BoolOp::Difference => "difference",
    }
}

/// The operator's sign.
pub fn operator_sign(op: BoolOp) -> &'static str {
    match op {
        BoolOp::Union => "∪",
        BoolOp::Intersection => "∩",
        BoolOp::Difference => "−",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names_of(solid: &Solid, most: usize) -> Vec<String> {
        sketch(solid, most).iter().map(SketchNode::name).collect()
    }

    #[test]
    fn small_trees_are_whole_and_numbered_in_source_order() {
        let solid = (Solid::block() & Solid::sphere().translate([1.0, 0.0, 0.0])) - Solid::cylinder();
        assert_eq!(names_of(&solid, 9), ["difference", "intersection", "cylinder 2", "block 0", "sphere 1"]);
    }

    #[test]
    fn what_does_not_fit_is_counted() {
        let row = Solid::union((0..1000).map(|i| Solid::block().translate([f64::from(i), 0.0, 0.0])));
        let solid = Solid::difference([row, Solid::sphere()]);
        let nodes = sketch(&solid, 9);
        assert_eq!(nodes.iter().filter(|node| node.kind == Kind::More(996, 996)).count(), 1);
        assert!(nodes.iter().any(|node| node.kind == Kind::Primitive(1000)), "the ball's number counts them all");
    }

    #[test]
    fn very_deep_trees_are_cut() {
        let solid = (0..100_000).fold(Solid::block(), |solid, _| (solid - Solid::sphere()).translate([1.0, 0.0, 0.0]));
        let nodes = sketch(&solid, 12);
        assert!(nodes.len() < 30 && nodes.iter().any(|node| matches!(node.kind, Kind::Folded(..))));
    }
}
