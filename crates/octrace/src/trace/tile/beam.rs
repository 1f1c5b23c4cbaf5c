//! What the rays of a tile can reach.
//!
//! A tile's rays fill a *beam*, a pyramid or a prism, of which planes cut the shares of rows and columns of packets. Where a
//! cell lies between those planes tells which packets may reach it. For pruning, the beam is cut into eight parts
//! ([`super::parts`]).

use super::lanes::{F64s, Isa, LANES, Stored, Vector};
use super::layout::{BUNDLE_COLUMNS, BUNDLE_PX, COLUMNS, PACKET_PX, ROWS, packets_in};
use crate::geom::Vec3;
use crate::model::CameraRays;
use crate::octree::Octree;

/// Borders of rows come first, then those of columns.
const FIRST_COLUMN: usize = ROWS + 1;
/// Borders between packets: of rows, of columns, and some to fill up the lanes.
const BORDERS: usize = 2 * LANES;
const _: () = assert!(FIRST_COLUMN + COLUMNS < BORDERS);

/// The outermost borders: the first and the last row's, the first and the last column's.
const OUTERMOST: [usize; 4] = [0, ROWS, FIRST_COLUMN, FIRST_COLUMN + COLUMNS];

/// The beam of one tile.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Beam {
    /// The eye; of parallel rays, where the middle one of the film starts.
    pub eye: Vec3,
    /// Whether all rays are parallel.
    pub parallel: bool,
    /// The direction into the picture, of unit length.
    pub forward: Vec3,
    /// Half a part's extent along x and y: at depth 1, or everywhere if rays are parallel.
    pub half_part: [Vec3; 2],
    /// Normals of the borders, towards higher coordinates.
    normals: [[Stored; 3]; 2],
    /// Heights of the borders over the eye.
    offsets: [Stored; 2],
    /// The sums of the normals' absolute components.
    reaches: [Stored; 2],
    /// For each of the outermost borders the heights of a cell's octants over its middle, if those have half edge 1.
    octants: [Stored; 4],
    /// Origins and directions (as long as depth 1) of the rays in the middles of the parts.
    origins: [Stored; 3],
    directions: [Stored; 3],
}

/// Where a cell lies with respect to the borders.
pub(super) struct Reached {
    /// The packets that may reach it.
    pub packets: u32,
    /// Its middle's heights over the outermost borders.
    heights: [f64; 4],
}

impl Beam {
    /// The beam of the tile whose upper left corner is at `(left, top)`.
    pub fn new(camera: &CameraRays, left: f64, top: f64) -> Self {
        let CameraRays { eye, forward, right, down, orthographic: parallel, .. } = *camera;
        let mut beam = Self { eye, parallel, forward, ..Self::default() };
        let half = |px: usize| px as f64 / 2.0;
        beam.half_part = [right * half(BUNDLE_PX.0), down * half(BUNDLE_PX.1)];
        // A plane through all of a row, or of a column, of the film.
        let row = |y: f64| match parallel {
            true => (forward.cross(right), y * down.dot(forward.cross(right))),
            false => (forward.cross(right) + down.cross(right) * y, 0.0),
        };
        let column = |x: f64| match parallel {
            true => (forward.cross(down), x * right.dot(forward.cross(down))),
            false => (forward.cross(down) + right.cross(down) * x, 0.0),
        };
        let turn = |(normal, offset): (Vec3, f64), towards: Vec3| match normal.dot(towards) < 0.0 {
            true => (-normal, -offset),
            false => (normal, offset),
        };
        let border = |i: usize| match i {
            0..FIRST_COLUMN => turn(row(top + (i * PACKET_PX.1) as f64 - camera.center.1), down),
            _ => turn(column(left + ((i - FIRST_COLUMN).min(COLUMNS) * PACKET_PX.0) as f64 - camera.center.0), right),
        };
        let borders: [(Vec3, f64); BORDERS] = std::array::from_fn(border);
        for (i, (normal, offset)) in borders.into_iter().enumerate() {
            let (half, lane) = (i / LANES, i % LANES);
            for axis in 0..3 {
                beam.normals[half][axis].0[lane] = normal[axis];
            }
            beam.offsets[half].0[lane] = offset;
            beam.reaches[half].0[lane] = normal.abs().dot(Vec3::splat(1.0));
        }
        for (heights, border) in beam.octants.iter_mut().zip(OUTERMOST) {
            let (normal, _) = borders[border];
            *heights = Stored(std::array::from_fn(|octant| normal.dot(Octree::child_center(Vec3::ZERO, 1.0, octant))));
        }
        for part in 0..LANES {
            let x = left + ((part % BUNDLE_COLUMNS) as f64 + 0.5) * BUNDLE_PX.0 as f64 - camera.center.0;
            let y = top + ((part / BUNDLE_COLUMNS) as f64 + 0.5) * BUNDLE_PX.1 as f64 - camera.center.1;
            let offset = right * x + down * y;
            let (origin, direction) = if parallel { (eye + offset, forward) } else { (eye, forward + offset) };
            for axis in 0..3 {
                beam.origins[axis].0[part] = origin[axis];
                beam.directions[axis].0[part] = direction[axis];
            }
        }
        beam
    }

    /// What may reach a cell with that middle and half edge.
    #[inline(always)]
    pub fn reached<I: Isa>(&self, center: Vec3, half: f64) -> Reached {
        let from_eye = Vector::<F64s<I>>::from_one(center - self.eye);
        let (rows, above_rows, below_rows) = self.side::<I>(0, from_eye, half);
        let (columns, above_columns, below_columns) = self.side::<I>(1, from_eye, half);
        let heights = [rows.stored(), columns.stored()];
        let above = u32::from(above_rows) | u32::from(above_columns) << LANES;
        let below = u32::from(below_rows) | u32::from(below_columns) << LANES;
        let between = above & below >> 1;
        let rows = between & ((1 << ROWS) - 1);
        let columns = between >> FIRST_COLUMN & ((1 << COLUMNS) - 1);
        Reached {
            packets: packets_in(rows, columns),
            heights: OUTERMOST.map(|border| heights[border / LANES].0[border % LANES]),
        }
    }

    /// For one half of the borders: the height over each, and whether a cube reaches above it, and below.
    #[inline(always)]
    fn side<I: Isa>(&self, i: usize, from_eye: Vector<F64s<I>>, half: f64) -> (F64s<I>, u8, u8) {
        let [x, y, z] = &self.normals[i];
        let normal = Vector::new(F64s::load(x), F64s::load(y), F64s::load(z));
        let height = normal.dot(from_eye) - F64s::load(&self.offsets[i]);
        let reach = F64s::load(&self.reaches[i]) * F64s::splat(half);
        (height, height.gt(-reach).bits(), height.lt(reach).bits())
    }

    /// The octants of that cell which anything may reach.
    #[inline(always)]
    pub fn octants<I: Isa>(&self, cell: &Reached, child_half: f64, margin: f64) -> u8 {
        let mut octants = u8::MAX;
        for (i, border) in OUTERMOST.into_iter().enumerate() {
            let height = F64s::<I>::splat(cell.heights[i]) + F64s::load(&self.octants[i]) * F64s::splat(child_half);
            let reach = self.reaches[border / LANES].0[border % LANES] * (child_half + margin);
            octants &= match i % 2 == 0 {
                true => height.gt(F64s::splat(-reach)),
                false => height.lt(F64s::splat(reach)),
            }
            .bits();
        }
        octants
    }

    /// The rays in the middles of the parts: their origins and directions.
    #[inline(always)]
    pub fn middles<I: Isa>(&self) -> (Vector<F64s<I>>, Vector<F64s<I>>) {
        let load = |[x, y, z]: &[Stored; 3]| Vector::new(F64s::load(x), F64s::load(y), F64s::load(z));
        (load(&self.origins), load(&self.directions))
    }

    /// Whether parts between those depths are so much deeper than wide that it pays to cut them.
    #[inline(always)]
    pub fn is_deep(&self, near: f64, far: f64) -> bool {
        let width = if self.parallel { 1.0 } else { far };
        0.5 * (far - near) > 4.0 * self.half_part[0].max_abs() * width
    }

    /// Between which depths a cell lies; nothing is in front of the first depth that rays have.
    #[inline(always)]
    pub fn depths(&self, center: Vec3, half: f64) -> (f64, f64) {
        let middle = (center - self.eye).dot(self.forward);
        let reach = half * self.forward.abs().dot(Vec3::splat(1.0));
        ((middle - reach).max(0.0), middle + reach)
    }
}
