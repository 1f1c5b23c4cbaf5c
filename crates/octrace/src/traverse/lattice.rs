//! Cells by numbers: integer coordinates on the lattice of an octree's finest cells, and linear codes that interleave them.

use crate::geom::Vec3;
use crate::octree::{CellWord, Kind, Octree};

/// A cell's level, and the coordinates of its low corner in units of the smallest cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub corner: [u32; 3],
    pub level: u32,
}

/// Spreads the low 21 bits of a coordinate to every third bit.
fn spread(v: u32) -> u64 {
    let mut v = u64::from(v) & 0x1f_ffff;
    v = (v | v << 32) & 0x001f_0000_0000_ffff;
    v = (v | v << 16) & 0x001f_0000_ff00_00ff;
    v = (v | v << 8) & 0x100f_00f0_0f00_f00f;
    v = (v | v << 4) & 0x10c3_0c30_c30c_30c3;
    (v | v << 2) & 0x1249_2492_4924_9249
}

/// The linear octal code: three bits a level, the path from the root [Gargantini 1982].
pub(super) fn code_of(coordinates: [u32; 3]) -> u64 {
    spread(coordinates[0]) | spread(coordinates[1]) << 1 | spread(coordinates[2]) << 2
}

/// The middle and half the edge of a cell, for an octree with `depth` levels.
pub(super) fn geometry(octree: &Octree, depth: u32, place: Place) -> (Vec3, f64) {
    let unit = octree.half / f64::from(1_u32 << depth) * 2.0;
    let half = octree.half / f64::from(1_u32 << place.level);
    let low = octree.center - Vec3::splat(octree.half);
    let corner = place.corner.map(f64::from);
    (low + Vec3::from(corner) * unit + Vec3::splat(half), half)
}

/// Shows every cell that is no branch, in the order of the linear codes.
pub(super) fn for_each_leaf(octree: &Octree, depth: u32, mut visit: impl FnMut(Place, CellWord)) {
    let mut pending = vec![(octree.root, Place { corner: [0; 3], level: 0 })];
    while let Some((word, place)) = pending.pop() {
        let Kind::Branch(index) = word.kind() else {
            visit(place, word);
            continue;
        };
        let level = place.level + 1;
        let side = 1 << (depth - level);
        for octant in (0..8).rev() {
            let corner = [0, 1, 2].map(|axis| place.corner[axis] + side * (octant as u32 >> axis & 1));
            pending.push((octree.branches[index as usize][octant], Place { corner, level }));
        }
    }
}
