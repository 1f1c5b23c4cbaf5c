//! The complete octree as a regular grid, its cells in a table addressed by the linear code; a three-dimensional DDA
//! steps from cell to cell, and finds the next one's code by arithmetic on the code itself [Fujimoto 1986;
//! Gargantini 1982].
//!
//! A leaf of the octree fills many cells of the grid. The walk takes every one of them, but shows each leaf once.

use super::lattice::{Place, code_of, for_each_leaf, geometry};
use super::{Step, cell_of, is_parallel, plane_t};
use crate::geom::Ray;
use crate::octree::{CellWord, Octree};
use std::ops::ControlFlow;

/// The grid has `8^depth` cells, five bytes each.
pub(super) const MAX_DEPTH: u32 = 8;

/// A cell for every code.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    depth: u32,
    words: Vec<CellWord>,
    levels: Vec<u8>,
}

impl Grid {
    pub fn new(octree: &Octree) -> Self {
        let depth = octree.depth();
        assert!(depth <= MAX_DEPTH, "a complete octree of depth {depth} does not fit");
        let cells = 1_usize << (3 * depth);
        let mut grid = Self { depth, words: vec![CellWord::OUTSIDE; cells], levels: vec![0; cells] };
        for_each_leaf(octree, depth, |place, word| {
            let start = code_of(place.corner) as usize;
            let end = start + (1 << (3 * (depth - place.level)));
            grid.words[start..end].fill(word);
            grid.levels[start..end].fill(place.level as u8);
        });
        grid
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.words[..]) + size_of_val(&self.levels[..])
    }
}

/// Every third bit: those of the first axis.
const FIRST_AXIS: u64 = 0x1249_2492_4924_9249;

/// The code one cell further along an axis: the other axes' bits are filled so that the carry runs through them.
fn further(code: u64, axis: usize) -> u64 {
    let bits = FIRST_AXIS << axis;
    ((code | !bits).wrapping_add(1) & bits) | (code & !bits)
}

/// The code one cell back.
fn back(code: u64, axis: usize) -> u64 {
    let bits = FIRST_AXIS << axis;
    ((code & bits).wrapping_sub(1) & bits) | (code & !bits)
}

pub(super) fn walk<B>(
    grid: &Grid,
    octree: &Octree,
    ray: &Ray,
    t_in: f64,
    t_out: f64,
    mut visit: impl FnMut(Step<'_>) -> ControlFlow<B>,
) -> ControlFlow<B> {
    let size = 1_u32 << grid.depth;
    let unit = 2.0 * octree.half / f64::from(size);
    let low = octree.bounds().min;
    let passes = |axis: usize, line: u32| plane_t(ray, axis, low[axis] + f64::from(line) * unit);
    let forward = [0, 1, 2].map(|axis| ray.direction[axis] > 0.0 || is_parallel(ray.direction[axis]));

    // The first cell: by halving, as the planes are passed.
    let mut at = [0, 1, 2].map(|axis| {
        let (mut first, mut count) = (0, size);
        while count > 1 {
            count /= 2;
            let middle = first + count;
            if (t_in >= passes(axis, middle)) == forward[axis] {
                first = middle;
            }
        }
        first
    });
    let mut code = code_of(at);
    let line_ahead = |at: [u32; 3], axis: usize| if forward[axis] { at[axis] + 1 } else { at[axis] };
    let mut ahead = [0, 1, 2]
        .map(|axis| if is_parallel(ray.direction[axis]) { f64::INFINITY } else { passes(axis, line_ahead(at, axis)) });
    let mut leaf_t = t_in;
    let shift_of = |code: u64| 3 * (grid.depth - u32::from(grid.levels[code as usize]));
    loop {
        let mut across = usize::from(ahead[1] < ahead[0]);
        if ahead[2] < ahead[across] {
            across = 2;
        }
        let leave = ahead[across].max(leaf_t);
        let here = code;
        let last = leave >= t_out || if forward[across] { at[across] + 1 == size } else { at[across] == 0 };
        if !last {
            if forward[across] {
                at[across] += 1;
                code = further(code, across);
            } else {
                at[across] -= 1;
                code = back(code, across);
            }
            ahead[across] = passes(across, line_ahead(at, across));
            let shift = shift_of(here);
            if here >> shift == code >> shift {
                continue;
            }
        }
        let level = u32::from(grid.levels[here as usize]);
        let block = here >> shift_of(here) << shift_of(here);
        let (center, half) = geometry(octree, grid.depth, Place { corner: coordinates_of(block), level });
        let end = if last { t_out } else { leave };
        let cell = cell_of(octree, grid.words[here as usize]);
        visit(Step { cell, t_in: leaf_t, t_out: end, center, half })?;
        if last {
            return ControlFlow::Continue(());
        }
        leaf_t = leave;
    }
}

/// The coordinates that a code interleaves.
fn coordinates_of(code: u64) -> [u32; 3] {
    [0, 1, 2].map(|axis| {
        let mut v = code >> axis & FIRST_AXIS;
        v = (v | v >> 2) & 0x10c3_0c30_c30c_30c3;
        v = (v | v >> 4) & 0x100f_00f0_0f00_f00f;
        v = (v | v >> 8) & 0x001f_0000_ff00_00ff;
        v = (v | v >> 16) & 0x001f_0000_0000_ffff;
        (v | v >> 32) as u32 & 0x1f_ffff
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_by_arithmetic_on_the_code() {
        let at = [5, 12, 7];
        let code = code_of(at);
        assert_eq!(coordinates_of(code), at);
        for axis in 0..3 {
            let mut next = at;
            next[axis] += 1;
            assert_eq!(further(code, axis), code_of(next));
            assert_eq!(back(code_of(next), axis), code);
        }
    }
}
