//! Multi-resolution Bresenham in space [Comba-Persiano, §4.2]: Bresenham's line on cells of different size, in integers
//! throughout the walk. The plane form, which is easier to follow and can be drawn, is in `traverse::plane`.
//!
//! The ray is put on a lattice of 2^31 units along the root's edge. Axes along which it runs downwards are mirrored, so
//! that every direction part is positive (a vanishing one becomes one unit). With `r` the vector from the ray to the cell's
//! far corner, three *errors* are kept:
//!
//! ```text
//! exy = rx dy - ry dx     > 0 where the ray meets the far y face strictly before the far x face
//! exz = rx dz - rz dx     the same for z and x
//! eyz = ry dz - rz dy     the same for z and y
//! ```
//!
//! They are the line's moments about the corner, so they do not change along the ray. A move across a face adds a multiple
//! of the direction that is a shift by the cell's size; changing the resolution halves or doubles that size: *refinement*
//! when the ray enters a subdivided neighbour, *integration* when it must ascend to find the neighbour, as Samet does.
//!
//! The lattice line is off the ray by some two units at most, far less than the margin with which cells are classified.
//! Parameters of the cells' ends are those of the lattice line, so the intervals tile the ray in the order of the integers.

use super::samet::Parents;
use super::{Step, cell_of};
use crate::geom::{Ray, Vec3};
use crate::octree::{CellWord, Kind, Octree};
use std::ops::ControlFlow;

/// Lattice units along the root's edge, as a power of two. Products of two coordinates and their differences fit 64 bits.
const LATTICE_BITS: u32 = 31;
const EDGE: i64 = 1 << LATTICE_BITS;

/// The ray on the lattice, mirrored so that it ascends along every axis.
struct Line {
    /// Octant bits of the axes that are mirrored.
    mirrored: usize,
    start: [i64; 3],
    direction: [i64; 3],
    /// Parameter of the start, and ray parameter for each lattice parameter.
    t_start: f64,
    t_scale: f64,
}

impl Line {
    fn new(octree: &Octree, ray: &Ray, t_in: f64) -> Self {
        let unit = 2.0 * octree.half / EDGE as f64;
        let low = octree.center - Vec3::splat(octree.half);
        let largest = ray.direction.max_abs();
        let (mut mirrored, mut start, mut direction) = (0, [0; 3], [0; 3]);
        for axis in 0..3 {
            let d = ray.direction[axis];
            let place = (((ray.origin[axis] + t_in * d) - low[axis]) / unit).round().clamp(0.0, EDGE as f64) as i64;
            start[axis] = place;
            direction[axis] = ((d.abs() / largest * EDGE as f64).round() as i64).max(1);
            if d < 0.0 {
                mirrored |= 1 << axis;
                start[axis] = EDGE - place;
            }
        }
        Self { mirrored, start, direction, t_start: t_in, t_scale: unit * EDGE as f64 / largest }
    }

    /// The ray parameter at which the line is at `height` along `axis`.
    fn t_at(&self, axis: usize, height: i64) -> f64 {
        self.t_start + (height - self.start[axis]) as f64 / self.direction[axis] as f64 * self.t_scale
    }
}

/// A cell of the tree with the errors at its far corner. Octants are mirrored as the line is.
struct Cell<'a> {
    octree: &'a Octree,
    line: &'a Line,
    /// The cell is child `octant` of `branch`, and `1 << size_log` units wide.
    branch: u32,
    octant: usize,
    size_log: u32,
    /// Its low corner, on the mirrored lattice.
    corner: [i64; 3],
    exy: i64,
    exz: i64,
    eyz: i64,
}

impl Cell<'_> {
    fn word(&self) -> CellWord {
        self.octree.branches[self.branch as usize][self.octant ^ self.line.mirrored]
    }

    /// The axis across which the line leaves the cell; of several at once, the first.
    fn exit_axis(&self) -> usize {
        if self.exy <= 0 && self.exz <= 0 {
            0
        } else if self.exy > 0 && self.eyz <= 0 {
            1
        } else {
            2
        }
    }

    /// Moves the errors by one cell size along an axis, onward (`sign` 1) or back (-1).
    fn shift(&mut self, axis: usize, sign: i64) {
        let [dx, dy, dz] = self.line.direction.map(|d| (d << self.size_log) * sign);
        match axis {
            0 => {
                self.exy += dy;
                self.exz += dz;
            }
            1 => {
                self.exy -= dx;
                self.eyz += dz;
            }
            _ => {
                self.exz -= dx;
                self.eyz -= dy;
            }
        }
        self.corner[axis] += sign << self.size_log;
    }

    /// Integration: the cell becomes the branch that it belongs to, whose far corner is that of the high child.
    fn integrate(&mut self, branch: u32, octant: usize) {
        for axis in 0..3 {
            if self.octant >> axis & 1 == 0 {
                self.shift(axis, 1);
                // The far corner moved; the low corner is the same.
                self.corner[axis] -= 1 << self.size_log;
            } else {
                self.corner[axis] -= 1 << self.size_log;
            }
        }
        self.size_log += 1;
        self.branch = branch;
        self.octant = octant;
    }

    /// Refinement: the cell becomes the child that the line enters by the face across `entered`, or in which the start
    /// lies.
    fn refine(&mut self, branch: u32, entered: Option<usize>) {
        self.size_log -= 1;
        let k = self.size_log;
        let [dx, dy, dz] = self.line.direction;
        // Whether the line is beyond the middle along one axis where it enters across another.
        let beyond = |error: i64, d: i64, d_entered: i64| error >= (d << (k + 1)) - (d_entered << k);
        let bits = match entered {
            Some(0) => [false, beyond(self.exy, dy, dx), beyond(self.exz, dz, dx)],
            Some(1) => [beyond(-self.exy, dx, dy), false, beyond(self.eyz, dz, dy)],
            Some(_) => [beyond(-self.exz, dx, dz), beyond(-self.eyz, dy, dz), false],
            None => [0, 1, 2].map(|axis| self.line.start[axis] - self.corner[axis] >= 1 << k),
        };
        self.branch = branch;
        self.octant = 0;
        for (axis, high) in bits.into_iter().enumerate() {
            if high {
                self.octant |= 1 << axis;
                self.corner[axis] += 1 << k;
            } else {
                self.shift(axis, -1);
                self.corner[axis] += 1 << k;
            }
        }
    }

    /// Down to the cell that the line is in.
    fn descend(&mut self, entered: Option<usize>) {
        while let Kind::Branch(branch) = self.word().kind() {
            self.refine(branch, entered);
        }
    }

    /// Across the face, to a neighbour as large as the cell or larger; false beyond the root.
    fn advance(&mut self, parents: &Parents, axis: usize) -> bool {
        let bit = 1 << axis;
        while self.octant & bit != 0 {
            let Some((branch, octant)) = parents.above(self.branch) else { return false };
            self.integrate(branch, octant ^ self.line.mirrored);
        }
        self.octant |= bit;
        self.shift(axis, 1);
        true
    }

    /// The cell's middle and half its edge, in the scene.
    fn geometry(&self) -> (Vec3, f64) {
        let octree = self.octree;
        let unit = 2.0 * octree.half / EDGE as f64;
        let half = (1_i64 << self.size_log) as f64 / 2.0;
        let mut center = octree.center;
        for axis in 0..3 {
            let middle = self.corner[axis] as f64 + half - EDGE as f64 / 2.0;
            let middle = if self.line.mirrored >> axis & 1 == 1 { -middle } else { middle };
            center[axis] += middle * unit;
        }
        (center, half * unit)
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
    let line = Line::new(octree, ray, t_in);
    let [rx, ry, rz] = line.start.map(|p| EDGE - p);
    let [dx, dy, dz] = line.direction;
    let mut cell = Cell {
        octree,
        line: &line,
        branch: root,
        octant: 0,
        size_log: LATTICE_BITS,
        corner: [0; 3],
        exy: rx * dy - ry * dx,
        exz: rx * dz - rz * dx,
        eyz: ry * dz - rz * dy,
    };
    cell.refine(root, None);
    cell.descend(None);
    let mut t = t_in;
    loop {
        let (center, half) = cell.geometry();
        let here = cell_of(octree, cell.word());
        let axis = cell.exit_axis();
        let far = cell.corner[axis] + (1 << cell.size_log);
        let leave = line.t_at(axis, far).max(t);
        let goes_on = leave < t_out && cell.advance(parents, axis);
        let t_end = if goes_on { leave } else { t_out };
        visit(Step { cell: here, t_in: t, t_out: t_end, center, half })?;
        if !goes_on {
            return ControlFlow::Continue(());
        }
        cell.descend(Some(axis));
        t = leave;
    }
}

/// The line on the lattice in exact numbers of the scene, for tests.
#[cfg(test)]
pub(super) struct ExactLine {
    pub origin: [num_rational::BigRational; 3],
    pub direction: [num_rational::BigRational; 3],
}

/// The line that [`walk`] follows; its parameters are the ray's.
#[cfg(test)]
pub(super) fn lattice_line(octree: &Octree, ray: &Ray, t_in: f64) -> ExactLine {
    use num_rational::BigRational;
    let exact = |v: f64| BigRational::from_float(v).expect("a finite number");
    let line = Line::new(octree, ray, t_in);
    let unit = exact(2.0 * octree.half) / BigRational::from_integer(EDGE.into());
    // One unit of the lattice parameter is `t_scale` of the ray's.
    let direction = [0, 1, 2].map(|axis| {
        let d = BigRational::from_integer(line.direction[axis].into()) * &unit / exact(line.t_scale);
        if line.mirrored >> axis & 1 == 1 { -d } else { d }
    });
    let origin = [0, 1, 2].map(|axis| {
        let place = if line.mirrored >> axis & 1 == 1 { EDGE - line.start[axis] } else { line.start[axis] };
        let low = exact(octree.center[axis] - octree.half);
        low + BigRational::from_integer(place.into()) * &unit - &direction[axis] * exact(line.t_start)
    });
    ExactLine { origin, direction }
}
