//! A tree of boxes over numbered items, to find those that a query may concern.
//!
//! Its nodes are small, so that much of it stays near: the boxes are single precision, in coordinates in which all of the tree
//! is a cube of edge 2 about the origin. They are a little larger than what is in them, by more than rounding comes to.

mod build;

pub(super) use build::GROWTH_BY_COORDINATES;

use crate::geom::{Bounds, Vec3};
use std::ops::ControlFlow;

/// A binary tree of boxes in a flat array, over items that are numbered in the order of its leaves.
#[derive(Clone, Debug)]
pub(crate) struct BoxTree {
    nodes: Vec<Node>,
    frame: Frame,
    bounds: Bounds,
}

/// A box, and what is in it.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Node {
    /// The corner with the smallest coordinates, in the tree's frame.
    pub low: [f32; 3],
    /// Number of items of a leaf, zero for a branch; above that, in a branch, the axis along which its children lie.
    tag: u32,
    /// The corner with the largest coordinates.
    pub high: [f32; 3],
    /// A leaf's first item; how much farther on a branch's second child is. Its first child is the next node.
    link: u32,
}

/// What is below a node.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Below {
    /// The second child is so much farther on than the branch itself, the first is the next node. Along that axis the first
    /// one's items are lower.
    Branch { second: u32, axis: usize },
    /// So many items from the first on.
    Leaf { first: u32, count: u32 },
}

/// Where the boxes of a tree have their origin, and how long their unit is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub center: Vec3,
    pub scale: f64,
}

impl Node {
    const AXIS: u32 = 30;

    fn leaf(low: [f32; 3], high: [f32; 3], first: u32, count: u32) -> Self {
        Self { low, tag: count, high, link: first }
    }

    fn branch(low: [f32; 3], high: [f32; 3], axis: usize) -> Self {
        Self { low, tag: (axis as u32) << Self::AXIS, high, link: 0 }
    }

    /// What is below it.
    #[inline(always)]
    pub fn below(&self) -> Below {
        let count = self.tag & ((1 << Self::AXIS) - 1);
        match count {
            0 => Below::Branch { second: self.link, axis: (self.tag >> Self::AXIS) as usize },
            _ => Below::Leaf { first: self.link, count },
        }
    }
}

impl Frame {
    /// A box of the tree in the world's coordinates.
    #[inline]
    fn bounds_of(&self, node: &Node) -> Bounds {
        let point = |p: [f32; 3]| self.center + Vec3::from(p.map(f64::from)) * self.scale;
        Bounds::new(point(node.low), point(node.high))
    }
}

impl BoxTree {
    /// No way down is longer.
    pub const MOST_LEVELS: usize = 64;

    /// The box around all items.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// The root first; none where there are no items.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Where the nodes' boxes are.
    pub fn frame(&self) -> Frame {
        self.frame
    }

    /// Calls `item` for every item in a leaf all of whose boxes, from the root down, `enter` accepts; stops when `item`
    /// breaks. An item's own box is not looked at.
    pub fn visit<B>(
        &self,
        mut enter: impl FnMut(&Bounds) -> bool,
        mut item: impl FnMut(u32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        let mut waiting = [0_u32; Self::MOST_LEVELS];
        let mut count = usize::from(!self.nodes.is_empty());
        while count > 0 {
            count -= 1;
            let mut number = waiting[count];
            while let Some(node) = self.nodes.get(number as usize) {
                if !enter(&self.frame.bounds_of(node)) {
                    break;
                }
                match node.below() {
                    Below::Branch { second, .. } => {
                        waiting[count] = number + second;
                        count += 1;
                        number += 1;
                    }
                    Below::Leaf { first, count } => {
                        (first..first + count).try_for_each(&mut item)?;
                        break;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }
}

/// A tree over items as they are numbered by whoever has them.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    tree: BoxTree,
    /// The items, those of a leaf in a row.
    order: Vec<u32>,
}

impl Bvh {
    /// The tree over items with these boxes, numbered as they come.
    pub fn build(boxes: &[Bounds]) -> Self {
        let (tree, order) = BoxTree::build(boxes.len(), 0.0, |item| boxes[item]);
        Self { tree, order }
    }

    /// The box around all items.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }

    /// As [`BoxTree::visit`].
    pub fn visit<B>(
        &self,
        enter: impl FnMut(&Bounds) -> bool,
        mut item: impl FnMut(u32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        self.tree.visit(enter, |place| item(self.order[place as usize]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Items whose boxes hold `x`, by the tree.
    fn found(boxes: &[Bounds], x: f64) -> Vec<u32> {
        let mut found = Vec::new();
        let holds = |b: &Bounds| b.min.x <= x && x <= b.max.x;
        let _ = Bvh::build(boxes).visit::<()>(holds, |i| {
            if holds(&boxes[i as usize]) {
                found.push(i);
            }
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        found
    }

    fn row(count: u32, scale: f64, shift: f64) -> Vec<Bounds> {
        let boxes = (0..count).map(|i| {
            let x = f64::from(i * 37 % 50);
            Bounds::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 1.5, 1.0, 1.0))
        });
        boxes.map(|b| Bounds::new(b.min * scale + Vec3::X * shift, b.max * scale + Vec3::X * shift)).collect()
    }

    #[test]
    fn finds_what_a_scan_finds() {
        for (scale, shift) in [(1.0, 0.0), (1e-200, 0.0), (1e200, 0.0), (1.0, 1e9), (1e-3, 1e12)] {
            for count in [0, 1, 4, 5, 9, 100, 1000] {
                let boxes = row(count, scale, shift);
                for x in [-1.0, 0.0, 1.0, 7.25, 49.0, 51.5, 60.0].map(|x| x * scale + shift) {
                    let scan: Vec<u32> = (0..boxes.len() as u32)
                        .filter(|&i| boxes[i as usize].min.x <= x && x <= boxes[i as usize].max.x)
                        .collect();
                    assert_eq!(found(&boxes, x), scan, "{count} boxes, x = {x}");
                }
            }
        }
    }

    #[test]
    fn equal_boxes_do_not_make_it_deep() {
        let boxes = vec![Bounds::new(Vec3::ZERO, Vec3::splat(1.0)); 10_000];
        assert_eq!(found(&boxes, 0.5).len(), 10_000);
    }

    #[test]
    fn boxes_ever_smaller_do_not_make_it_deep() {
        let boxes: Vec<Bounds> = (0..900)
            .map(|i| {
                let x = libm::ldexp(1.0, -i);
                Bounds::new(Vec3::X * x, Vec3::X * x)
            })
            .collect();
        assert_eq!(found(&boxes, 1.0), [0]);
    }
}
