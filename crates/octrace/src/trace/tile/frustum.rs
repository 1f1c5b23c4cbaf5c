//! What a tile of rays can reach: wedges between planes, for all eight octants of a cell at once.

use super::lanes::{F64s, LANES, Mask};
use super::{BLOCK_PX, BLOCKS, TILE_PX};
use crate::geom::{Ray, Vec3};
use crate::octree::Octree;

/// A plane that parts blocks of pixels: with `normal . p - offset` positive on the side of the higher coordinates.
#[derive(Clone, Copy, Debug)]
struct Border {
    normal: Vec3,
    offset: f64,
    /// For every octant the height of its centre above that of the cell's, for a cell with octants of half edge 1.
    heights: F64s,
    /// Half the height of a cube of half edge 1.
    reach: f64,
}

/// Blocks in one direction, between borders.
type Borders = [Border; BLOCKS + 1];

/// The borders between a tile's blocks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frustum {
    columns: Borders,
    rows: Borders,
}

impl Border {
    /// The plane through two rays from one point, or parallel ones; `above` is a ray on its positive side.
    fn new(a: &Ray, b: &Ray, above: &Ray) -> Option<Self> {
        let apart = b.origin - a.origin;
        let normal = match apart == Vec3::ZERO {
            true => a.direction.cross(b.direction),
            false => a.direction.cross(apart),
        };
        let normal = normal.normalized()?;
        let towards = (above.origin - a.origin).dot(normal) + above.direction.dot(normal);
        let normal = if towards < 0.0 { -normal } else { normal };
        let mut heights = [0.0; LANES];
        for (octant, height) in heights.iter_mut().enumerate() {
            *height = normal.dot(Octree::child_center(Vec3::ZERO, 1.0, octant));
        }
        let reach = normal.abs().dot(Vec3::splat(1.0));
        Some(Self { normal, offset: normal.dot(a.origin), heights: F64s(heights), reach })
    }

    /// Of which octants some is above the plane, and of which some is below.
    #[inline(always)]
    fn sides(&self, center: Vec3, child_half: f64, margin: f64) -> (Mask, Mask) {
        let height = F64s::splat(self.normal.dot(center) - self.offset) + self.heights * F64s::splat(child_half);
        let reach = F64s::splat(self.reach * child_half + margin);
        (height.gt(-reach), height.lt(reach))
    }
}

impl Frustum {
    /// The frustum of a tile whose rays are `ray(x, y)`, with `x` and `y` up to [`TILE_PX`]; `None` where its rays do not
    /// spread.
    pub fn new(ray: impl Fn(f64, f64) -> Ray) -> Option<Self> {
        let last = TILE_PX as f64;
        let at = |i: usize| (i * BLOCK_PX) as f64;
        let column = |i: usize| Border::new(&ray(at(i), 0.0), &ray(at(i), last), &ray(at(i) + 1.0, 0.5 * last));
        let row = |i: usize| Border::new(&ray(0.0, at(i)), &ray(last, at(i)), &ray(0.5 * last, at(i) + 1.0));
        let borders = |border: &dyn Fn(usize) -> Option<Border>| -> Option<Borders> {
            Some([border(0)?, border(1)?, border(2)?, border(3)?, border(4)?])
        };
        Some(Self { columns: borders(&column)?, rows: borders(&row)? })
    }

    /// For every octant of a cell the blocks that may reach it.
    #[inline(always)]
    pub fn reached(&self, center: Vec3, child_half: f64, margin: f64) -> [u16; LANES] {
        let between = |borders: &Borders| {
            let sides = borders.map(|border| border.sides(center, child_half, margin));
            let mut masks = [0_u16; LANES];
            for i in 0..BLOCKS {
                let inside = sides[i].0 & sides[i + 1].1;
                for (octant, mask) in masks.iter_mut().enumerate() {
                    *mask |= u16::from(inside.get(octant)) << i;
                }
            }
            masks
        };
        let (columns, rows) = (between(&self.columns), between(&self.rows));
        std::array::from_fn(|octant| {
            // A bit for each row, four apart, times the bits of the columns.
            let rows = rows[octant];
            let apart = (rows & 1) | (rows & 2) << 3 | (rows & 4) << 6 | (rows & 8) << 9;
            apart * columns[octant]
        })
    }
}
