//! Neighbours by ascending to the common ancestor and descending mirrored [Samet 1982].

use super::{Step, cell_of, exit, octant_at};
use crate::geom::{Ray, Vec3};
use crate::octree::{CellWord, Kind, Octree};
use std::ops::ControlFlow;

/// For every branch the branch above it, and which of its children it is.
#[derive(Clone, Debug)]
pub(super) struct Parents(Vec<u32>);

impl Parents {
    const NONE: u32 = u32::MAX;

    pub fn new(octree: &Octree) -> Self {
        let mut parents = vec![Self::NONE; octree.branches.len()];
        for (branch, children) in octree.branches.iter().enumerate() {
            for (octant, child) in children.iter().enumerate() {
                if let Kind::Branch(index) = child.kind() {
                    parents[index as usize] = (branch as u32) << 3 | octant as u32;
                }
            }
        }
        Self(parents)
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.0[..])
    }

    /// The branch above, and the child of it that `branch` is; `None` at the root.
    #[inline]
    pub fn above(&self, branch: u32) -> Option<(u32, usize)> {
        let parent = self.0[branch as usize];
        (parent != Self::NONE).then_some((parent >> 3, (parent & 7) as usize))
    }
}

/// A place in the tree: child `octant` of `branch`.
#[derive(Clone, Copy, Debug)]
struct Slot {
    branch: u32,
    octant: usize,
    center: Vec3,
    half: f64,
}

impl Slot {
    fn word(&self, octree: &Octree) -> CellWord {
        octree.branches[self.branch as usize][self.octant]
    }

    /// The middle of the branch that the slot belongs to.
    fn branch_center(&self) -> Vec3 {
        Octree::child_center(self.center, self.half, !self.octant & 7)
    }

    fn sibling(&self, octant: usize) -> Self {
        Self { octant, center: Octree::child_center(self.branch_center(), self.half, octant), ..*self }
    }

    fn child(&self, branch: u32, octant: usize) -> Self {
        let half = self.half / 2.0;
        Self { branch, octant, center: Octree::child_center(self.center, half, octant), half }
    }
}

pub(super) fn walk<B>(
    parents: &Parents,
    octree: &Octree,
    ray: &Ray,
    t_in: f64,
    t_out: f64,
    mut visit: impl FnMut(Step<'_>) -> ControlFlow<B>,
) -> ControlFlow<B> {
    let Kind::Branch(root) = octree.root.kind() else {
        let cell = cell_of(octree, octree.root);
        return visit(Step { cell, t_in, t_out, center: octree.center, half: octree.half });
    };
    let top = Slot { branch: root, octant: 0, center: octree.center, half: octree.half };
    let mut slot = descend(octree, ray, top.child(root, octant_at(ray, octree.center, t_in)), t_in, None);
    let mut t = t_in;
    loop {
        let (leave, across) = exit(ray, slot.center, slot.half);
        let leave = leave.clamp(t, t_out);
        let next =
            if leave < t_out { neighbour(parents, octree, slot, across, ray.direction[across] > 0.0) } else { None };
        let t_end = if next.is_some() { leave } else { t_out };
        let cell = cell_of(octree, slot.word(octree));
        visit(Step { cell, t_in: t, t_out: t_end, center: slot.center, half: slot.half })?;
        let Some(next) = next else { return ControlFlow::Continue(()) };
        t = leave;
        slot = descend(octree, ray, next, t, Some((across, ray.direction[across] > 0.0)));
    }
}

/// The neighbour across a face: as large as the cell, or larger; `None` beyond the root.
fn neighbour(parents: &Parents, octree: &Octree, mut slot: Slot, axis: usize, forward: bool) -> Option<Slot> {
    let bit = 1 << axis;
    // Ascend as long as the cell lies on the side towards which to go, noting the way.
    let mut way = [0_u8; 32];
    let mut levels = 0;
    while (slot.octant & bit != 0) == forward {
        way[levels] = slot.octant as u8;
        levels += 1;
        let (branch, octant) = parents.above(slot.branch)?;
        slot = Slot { branch, octant, center: slot.branch_center(), half: slot.half * 2.0 };
    }
    // Across the middle of the common ancestor, and down the same way, mirrored.
    slot = slot.sibling(slot.octant ^ bit);
    for &octant in way[..levels].iter().rev() {
        let Kind::Branch(branch) = slot.word(octree).kind() else { break };
        slot = slot.child(branch, usize::from(octant) ^ bit);
    }
    Some(slot)
}

/// Down to the cell in which the ray is from `t` on; across the face by which it came in, the near child.
fn descend(octree: &Octree, ray: &Ray, mut slot: Slot, t: f64, entered: Option<(usize, bool)>) -> Slot {
    while let Kind::Branch(branch) = slot.word(octree).kind() {
        let mut octant = octant_at(ray, slot.center, t);
        if let Some((axis, forward)) = entered {
            let bit = 1 << axis;
            octant = if forward { octant & !bit } else { octant | bit };
        }
        slot = slot.child(branch, octant);
    }
    slot
}
