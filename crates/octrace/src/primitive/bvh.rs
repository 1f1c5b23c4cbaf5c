//! A tree of boxes over numbered items, to find those that a query may concern.

use crate::geom::Bounds;
use std::ops::ControlFlow;

/// Up to so many items share a leaf.
const LEAF_ITEMS: usize = 4;

/// A binary tree of boxes in a flat array. Depends on the items' boxes and order only.
#[derive(Clone, Debug)]
pub(crate) struct Bvh {
    nodes: Vec<Node>,
    /// The items, those of a leaf in a row.
    order: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// Number of items of a leaf; zero for a branch.
    count: u32,
    /// A leaf's first place in `order`; a branch's second child. Its first child is the next node.
    link: u32,
}

impl Bvh {
    /// The tree over items with these boxes, numbered as they come.
    pub fn build(boxes: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: (0..boxes.len() as u32).collect() };
        // What is still to be built: a stretch of `order`, and the branch whose second child it is.
        let mut pending = vec![(0..boxes.len(), None::<usize>)];
        while let Some((stretch, parent)) = pending.pop() {
            let number = tree.nodes.len();
            if let Some(parent) = parent {
                tree.nodes[parent].link = number as u32;
            }
            let items = &mut tree.order[stretch.clone()];
            let bounds = items.iter().fold(Bounds::EMPTY, |b, &i| b.union(boxes[i as usize]));
            if items.len() <= LEAF_ITEMS {
                tree.nodes.push(Node { bounds, count: items.len() as u32, link: stretch.start as u32 });
                continue;
            }
            let middle = stretch.start + split(items, boxes);
            tree.nodes.push(Node { bounds, count: 0, link: 0 });
            pending.push((middle..stretch.end, Some(number)));
            pending.push((stretch.start..middle, None));
        }
        tree
    }

    /// The box around all items.
    pub fn bounds(&self) -> Bounds {
        self.nodes[0].bounds
    }

    /// Calls `item` for every item in a leaf all of whose boxes, from the root down, `enter` accepts; stops when `item`
    /// breaks. An item's own box is not looked at.
    pub fn visit<B>(
        &self,
        mut enter: impl FnMut(&Bounds) -> bool,
        mut item: impl FnMut(u32) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        // Each level halves the number of items, so 2^32 items make 32 levels.
        let mut waiting = [0_u32; 40];
        let mut depth = 0;
        let mut number = 0;
        loop {
            let node = &self.nodes[number];
            let entered = enter(&node.bounds);
            if entered && node.count == 0 && !self.order.is_empty() {
                waiting[depth] = node.link;
                depth += 1;
                number += 1;
                continue;
            }
            if entered {
                let first = node.link as usize;
                for &i in &self.order[first..first + node.count as usize] {
                    item(i)?;
                }
            }
            if depth == 0 {
                return ControlFlow::Continue(());
            }
            depth -= 1;
            number = waiting[depth] as usize;
        }
    }
}

/// Orders items along the axis on which their centres spread most, and returns the place of the middle one.
fn split(items: &mut [u32], boxes: &[Bounds]) -> usize {
    let center = |i: u32| boxes[i as usize].center();
    let axis = Bounds::around(items.iter().map(|&i| center(i))).size().largest_axis();
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |&a, &b| center(a)[axis].total_cmp(&center(b)[axis]).then(a.cmp(&b)));
    middle
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vec3;

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

    #[test]
    fn finds_what_a_scan_finds() {
        for count in [0, 1, 4, 5, 9, 100, 1000] {
            let boxes: Vec<Bounds> = (0..count)
                .map(|i| {
                    let x = f64::from(i * 37 % 50);
                    Bounds::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 1.5, 1.0, 1.0))
                })
                .collect();
            for x in [-1.0, 0.0, 1.0, 7.25, 49.0, 51.5, 60.0] {
                let scan: Vec<u32> = (0..boxes.len() as u32)
                    .filter(|&i| boxes[i as usize].min.x <= x && x <= boxes[i as usize].max.x)
                    .collect();
                assert_eq!(found(&boxes, x), scan, "{count} boxes, x = {x}");
            }
        }
    }

    #[test]
    fn equal_boxes_do_not_make_it_deep() {
        let boxes = vec![Bounds::new(Vec3::ZERO, Vec3::splat(1.0)); 10_000];
        assert_eq!(found(&boxes, 0.5).len(), 10_000);
    }
}
