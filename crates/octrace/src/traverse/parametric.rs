//! Top down, front to back: a branch's interval is cut where the ray passes the branch's three middle planes.
//!
//! All that is ever compared are parameters, and a child's interval ends with the very number with which the next one's
//! begins. So the intervals tile the ray by construction, whatever rounding does to the planes.

use super::{Step, cell_of, octant_at, plane_t};
use crate::geom::{Ray, Vec3};
use crate::octree::{CellWord, Kind, Octree};
use std::ops::ControlFlow;

pub(super) fn walk<B>(
    octree: &Octree,
    ray: &Ray,
    t_in: f64,
    t_out: f64,
    mut visit: impl FnMut(Step<'_>) -> ControlFlow<B>,
) -> ControlFlow<B> {
    cell(octree, ray, (octree.root, octree.center, octree.half), (t_in, t_out), &mut visit)
}

/// Walks one cell; as deep as the octree is.
fn cell<B>(
    octree: &Octree,
    ray: &Ray,
    (word, center, half): (CellWord, Vec3, f64),
    (t_in, t_out): (f64, f64),
    visit: &mut impl FnMut(Step<'_>) -> ControlFlow<B>,
) -> ControlFlow<B> {
    let Kind::Branch(index) = word.kind() else {
        return visit(Step { cell: cell_of(octree, word), t_in, t_out, center, half });
    };
    let children = &octree.branches[index as usize];
    let child_half = half / 2.0;
    let (cuts, count) = cuts(ray, center, t_in, t_out);
    let mut start = t_in;
    for end in cuts[..count].iter().copied().chain([t_out]) {
        let octant = octant_at(ray, center, start);
        let child = (children[octant], Octree::child_center(center, child_half, octant), child_half);
        cell(octree, ray, child, (start, end), visit)?;
        start = end;
    }
    ControlFlow::Continue(())
}

/// The different parameters strictly between `t_in` and `t_out` at which the ray passes a middle plane, ascending.
fn cuts(ray: &Ray, center: Vec3, t_in: f64, t_out: f64) -> ([f64; 3], usize) {
    let mut cuts = [0.0; 3];
    let mut count = 0;
    for axis in 0..3 {
        let t = plane_t(ray, axis, center[axis]);
        if !(t_in < t && t < t_out) {
            continue;
        }
        let at = cuts[..count].iter().position(|&c| c >= t).unwrap_or(count);
        if at < count && cuts[at] == t {
            continue;
        }
        cuts.copy_within(at..count, at + 1);
        cuts[at] = t;
        count += 1;
    }
    (cuts, count)
}
