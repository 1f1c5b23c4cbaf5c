//! The cells of an octree, for people to look at.

use super::Tracer;
use crate::geom::{Bounds, Vec3};
use crate::octree::{Cell, Kind, Octree};

/// A cell that is not divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OctreeCell<'a> {
    /// How many times the root was divided; 0 is the root.
    pub level: u32,
    /// Which cell of its level it is, counted along each axis.
    pub index: [u32; 3],
    /// The cell's cube, without the margin with which it was classified.
    pub bounds: Bounds,
    /// What it holds; programs refer to [`Tracer::catalog`].
    pub cell: Cell<'a>,
}

impl Tracer {
    /// The root cube of a body's octree; `None` where there is no octree.
    pub fn octree_bounds(&self, body: usize) -> Option<Bounds> {
        self.bodies[body].octree().map(Octree::bounds)
    }

    /// Shows `visit` the undivided cells of a body's octree that `wanted` lets through, itself and all cells that it lies in.
    pub fn visit_octree(
        &self,
        body: usize,
        mut wanted: impl FnMut(&Bounds) -> bool,
        mut visit: impl FnMut(&OctreeCell<'_>),
    ) {
        let Some(octree) = self.bodies[body].octree() else { return };
        let mut pending = vec![(octree.root, 0, [0; 3], octree.center, octree.half)];
        while let Some((word, level, index, center, half)) = pending.pop() {
            let bounds = Bounds::new(center - Vec3::splat(half), center + Vec3::splat(half));
            if !wanted(&bounds) {
                continue;
            }
            let cell = match word.kind() {
                Kind::Outside => Cell::Outside,
                Kind::Inside => Cell::Inside,
                Kind::Leaf(program) => Cell::Leaf(octree.program(program)),
                Kind::Branch(branch) => {
                    let half = half / 2.0;
                    pending.extend((0..8).rev().map(|octant| {
                        let index = [0, 1, 2].map(|axis| index[axis] << 1 | (octant as u32 >> axis & 1));
                        let word = octree.branches[branch as usize][octant];
                        (word, level + 1, index, Octree::child_center(center, half, octant), half)
                    }));
                    continue;
                }
            };
            visit(&OctreeCell { level, index, bounds, cell });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exec::Exec;
    use crate::model::Solid;
    use crate::octree::BuildOptions;
    use crate::trace::TracerOptions;

    #[test]
    fn the_cells_fill_the_root_and_their_indices_tell_where_they_are() {
        let octree = BuildOptions { depth: Some(3), leaf_surfaces: 1 };
        let options = TracerOptions { octree, ..TracerOptions::default() };
        let tracer = Tracer::build(&Solid::sphere(), &options, &Exec::with_threads(1)).expect("nobody cancels");
        let root = tracer.octree_bounds(0).expect("a ball is bounded");
        let (mut volume, mut kinds) = (0.0, [0; 3]);
        tracer.visit_octree(
            0,
            |_| true,
            |found| {
                let size = root.size().x / f64::from(1_u32 << found.level);
                let corner = root.min + Vec3::from(found.index.map(f64::from)) * size;
                assert!((corner - found.bounds.min).max_abs() < 1e-12 && (found.bounds.size().x - size).abs() < 1e-12);
                volume += size * size * size;
                kinds[match found.cell {
                    Cell::Outside => 0,
                    Cell::Inside => 1,
                    Cell::Leaf(_) => 2,
                }] += 1;
            },
        );
        assert!((volume / root.size().x.powi(3) - 1.0).abs() < 1e-12);
        let stats = tracer.stats().octree.expect("there is one");
        assert_eq!(kinds, [stats.outside, stats.inside, stats.leaves]);
    }
}
