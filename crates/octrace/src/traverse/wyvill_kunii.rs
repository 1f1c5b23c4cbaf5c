//! A pointer tree, descended from the root for every cell [Wyvill-Kunii-Shirai 1986].
//!
//! The exit point of a cell lies on one of its faces; the next cell is the one that holds the point a little further. Here
//! the descent asks "has the ray passed this branch's middle plane at that parameter?" instead of comparing coordinates:
//! the same decision, without a distance to move the point by.

use super::{Step, cell_of, exit, octant_at};
use crate::geom::Ray;
use crate::octree::{Kind, Octree};
use std::ops::ControlFlow;

pub(super) fn walk<B>(
    octree: &Octree,
    ray: &Ray,
    t_in: f64,
    t_out: f64,
    mut visit: impl FnMut(Step<'_>) -> ControlFlow<B>,
) -> ControlFlow<B> {
    let mut t = t_in;
    loop {
        let (mut word, mut center, mut half) = (octree.root, octree.center, octree.half);
        while let Kind::Branch(index) = word.kind() {
            let octant = octant_at(ray, center, t);
            half /= 2.0;
            center = Octree::child_center(center, half, octant);
            word = octree.branches[index as usize][octant];
        }
        // Planes that have been passed are behind the cell, so it is left later than it is entered.
        let leave = exit(ray, center, half).0.clamp(t, t_out);
        visit(Step { cell: cell_of(octree, word), t_in: t, t_out: leave, center, half })?;
        if leave >= t_out || leave <= t {
            return ControlFlow::Continue(());
        }
        t = leave;
    }
}
