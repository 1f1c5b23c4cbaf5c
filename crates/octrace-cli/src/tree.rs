//! The CSG tree in words. Trees may be deep beyond any stack, so nothing here recurses.

use octrace::model::Node;
use octrace::{BoolOp, Primitive, Profile, Solid};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// How many nodes of each kind a tree has.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct NodeCounts {
    leaves: BTreeMap<&'static str, usize>,
    inner: BTreeMap<&'static str, usize>,
    depth: usize,
}

impl NodeCounts {
    /// Counts the nodes of `solid`.
    pub fn of(solid: &Solid) -> Self {
        let mut counts = Self::default();
        walk(solid, |depth, node| {
            counts.depth = counts.depth.max(depth + 1);
            let kinds = match node {
                Node::Empty | Node::Primitive(_) => &mut counts.leaves,
                _ => &mut counts.inner,
            };
            *kinds.entry(name(node)).or_default() += 1;
        });
        counts
    }
}

impl fmt::Display for NodeCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |kinds: &BTreeMap<&str, usize>| {
            let words: Vec<String> = kinds.iter().map(|(kind, count)| format!("{kind} {count}")).collect();
            if words.is_empty() { "none".to_owned() } else { words.join(", ") }
        };
        write!(f, "depth {}; leaves: {}; inner nodes: {}", self.depth, list(&self.leaves), list(&self.inner))
    }
}

/// The whole tree, a line per node. Below [`DEEPEST_INDENT`] the depth is given as a number.
pub fn print(solid: &Solid) -> String {
    let mut text = String::new();
    walk(solid, |depth, node| {
        let indent = "  ".repeat(depth.min(DEEPEST_INDENT) + 1);
        text += &indent;
        if depth > DEEPEST_INDENT {
            text += &format!("[{depth}] ");
        }
        text += &line(node);
        text.push('\n');
    });
    text
}

/// Lines of a deep tree must not grow without end.
const DEEPEST_INDENT: usize = 40;

fn walk(solid: &Solid, mut visit: impl FnMut(usize, &Node)) {
    let mut pending = vec![(0, solid)];
    while let Some((depth, solid)) = pending.pop() {
        visit(depth, solid.node());
        match solid.node() {
            Node::Empty | Node::Primitive(_) => {}
            Node::Transform(_, child) | Node::Part(_, child) => pending.push((depth + 1, child)),
            Node::Combine(_, children) => pending.extend(children.iter().rev().map(|child| (depth + 1, child))),
        }
    }
}

/// The kind of a node.
pub fn name(node: &Node) -> &'static str {
    match node {
        Node::Empty => "empty",
        Node::Primitive(primitive) => match primitive {
            Primitive::Block => "block",
            Primitive::Sphere => "sphere",
            Primitive::Cylinder => "cylinder",
            Primitive::HalfSpace => "halfspace",
            Primitive::Cone { .. } => "cone",
            Primitive::Torus { .. } => "torus",
            Primitive::Polyhedron(_) => "polyhedron",
            Primitive::Prism { .. } => "prism",
            Primitive::Revolution(_) => "revolution",
        },
        Node::Transform(..) => "transform",
        Node::Combine(BoolOp::Union, _) => "union",
        Node::Combine(BoolOp::Intersection, _) => "intersection",
        Node::Combine(BoolOp::Difference, _) => "difference",
        Node::Part(..) => "part",
    }
}

fn edges(profile: &Profile) -> usize {
    profile.contours().iter().map(Vec::len).sum()
}

fn line(node: &Node) -> String {
    let name = name(node);
    match node {
        Node::Empty | Node::Combine(..) => name.to_owned(),
        Node::Primitive(primitive) => match primitive {
            Primitive::Cone { top } => format!("{name} top={top}"),
            Primitive::Torus { minor } => format!("{name} minor={minor}"),
            Primitive::Polyhedron(p) => format!("{name} of {} faces", p.faces().len()),
            Primitive::Prism { profile, top: 1.0 } => format!("{name} of {} edges", edges(profile)),
            Primitive::Prism { profile, top } => format!("{name} of {} edges top={top}", edges(profile)),
            Primitive::Revolution(profile) => format!("{name} of {} edges", edges(profile)),
            _ => name.to_owned(),
        },
        Node::Transform(map, _) => {
            let rows: Vec<String> = (0..3)
                .map(|i| format!("[{} {} {} {}]", map.rows[i].x, map.rows[i].y, map.rows[i].z, map.translation[i]))
                .collect();
            format!("{name} {}", rows.join(" "))
        }
        Node::Part(part, _) => format!("{name} {}", part.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_tree() {
        let solid = Solid::block() - Solid::cylinder().translate([1.0, 2.0, 3.0]);
        assert_eq!(
            print(&solid),
            "  difference\n    block\n    transform [1 0 0 1] [0 1 0 2] [0 0 1 3]\n      cylinder\n"
        );
        let counts = NodeCounts::of(&solid).to_string();
        assert_eq!(counts, "depth 3; leaves: block 1, cylinder 1; inner nodes: difference 1, transform 1");
    }

    #[test]
    fn a_very_deep_tree() {
        let solid = (0..100_000).fold(Solid::block(), |solid, _| solid - Solid::sphere());
        let text = print(&solid);
        assert!(text.contains("[99999] difference") && text.len() < 30_000_000, "{}", text.len());
    }
}
