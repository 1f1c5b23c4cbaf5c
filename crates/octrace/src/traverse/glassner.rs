//! Leaves in a hash table, keyed by their linear code with a leading one for the level [Glassner 1984].
//!
//! Only cells that are not empty are stored. The next cell is the one that holds the exit point, moved across the exit face;
//! it is looked up level by level. Where no level has it, it is empty, and its size must be found: it is the largest block
//! about the point that holds no stored cell, which its neighbours in the sorted list of codes tell.

use super::lattice::{Place, code_of, for_each_leaf, geometry};
use super::{Step, cell_of, exit, is_parallel};
use crate::geom::Ray;
use crate::octree::{CellWord, Octree};
use rustc_hash::FxHashMap;
use std::ops::ControlFlow;

/// The cells that are not empty, by code.
#[derive(Clone, Debug)]
pub(super) struct LinearOctree {
    depth: u32,
    cells: FxHashMap<u64, CellWord>,
    /// The code of each stored cell's first smallest cell, ascending, and its level.
    codes: Vec<(u64, u32)>,
}

impl LinearOctree {
    pub fn new(octree: &Octree) -> Self {
        let depth = octree.depth();
        let mut linear = Self { depth, cells: FxHashMap::default(), codes: Vec::new() };
        for_each_leaf(octree, depth, |place, word| {
            if word != CellWord::OUTSIDE {
                let code = code_of(place.corner);
                linear.cells.insert(linear.key(code, place.level), word);
                linear.codes.push((code, place.level));
            }
        });
        linear.codes.sort_unstable();
        linear
    }

    pub fn bytes(&self) -> usize {
        self.cells.capacity() * (size_of::<(u64, CellWord)>() + 1) + size_of_val(&self.codes[..])
    }

    /// The code cut to its level, behind a one.
    fn key(&self, code: u64, level: u32) -> u64 {
        1 << (3 * level) | code >> (3 * (self.depth - level))
    }

    /// The cell that holds a smallest cell.
    fn find(&self, at: [u32; 3]) -> (Place, CellWord) {
        let code = code_of(at);
        let place = |level: u32| {
            let shift = self.depth - level;
            Place { corner: at.map(|c| c >> shift << shift), level }
        };
        for level in (0..=self.depth).rev() {
            if let Some(&word) = self.cells.get(&self.key(code, level)) {
                return (place(level), word);
            }
        }
        // Empty: one level below the deepest block that it shares with a stored cell.
        let next = self.codes.partition_point(|&(stored, _)| stored < code);
        let neighbours = [next.checked_sub(1), Some(next)];
        let shared = neighbours.into_iter().flatten().filter_map(|i| self.codes.get(i)).map(|&(stored, _)| {
            let differing = stored ^ code;
            self.depth - (64 - differing.leading_zeros()).div_ceil(3)
        });
        (place(shared.max().map_or(0, |level| level + 1)), CellWord::OUTSIDE)
    }
}

pub(super) fn walk<B>(
    linear: &LinearOctree,
    octree: &Octree,
    ray: &Ray,
    t_in: f64,
    t_out: f64,
    mut visit: impl FnMut(Step<'_>) -> ControlFlow<B>,
) -> ControlFlow<B> {
    let size = 1_u32 << linear.depth;
    let unit = 2.0 * octree.half / f64::from(size);
    let low = octree.bounds().min;
    // The coordinate along an axis of the point at `t`, in smallest cells.
    let index = |axis: usize, t: f64| {
        let (o, d) = (ray.origin[axis], ray.direction[axis]);
        let along = ((if is_parallel(d) { o } else { o + t * d }) - low[axis]) / unit;
        // On a plane the ray is on its way to the other side.
        if d < 0.0 && !is_parallel(d) { along.ceil() - 1.0 } else { along.floor() }
    };
    let mut at = [0, 1, 2].map(|axis| index(axis, t_in).clamp(0.0, f64::from(size - 1)) as u32);
    let mut t = t_in;
    loop {
        let (place, word) = linear.find(at);
        let (center, half) = geometry(octree, linear.depth, place);
        let (leave, across) = exit(ray, center, half);
        let leave = leave.clamp(t, t_out);
        let side = 1 << (linear.depth - place.level);
        // Across the exit face; along the face the point stays within the cell.
        let forward = ray.direction[across] > 0.0;
        let next = if forward { place.corner[across].checked_add(side) } else { place.corner[across].checked_sub(1) };
        let next = next.filter(|&c| c < size && leave < t_out);
        let t_end = if next.is_some() { leave } else { t_out };
        visit(Step { cell: cell_of(octree, word), t_in: t, t_out: t_end, center, half })?;
        let Some(next) = next else { return ControlFlow::Continue(()) };
        t = leave;
        at = [0, 1, 2].map(|axis| {
            let first = f64::from(place.corner[axis]);
            index(axis, t).clamp(first, first + f64::from(side - 1)) as u32
        });
        at[across] = next;
    }
}
