//! Ways to walk an octree along a ray [Comba-Persiano, §4]. A traversal yields cells in order and knows nothing of
//! primitives.
//!
//! Whatever the way, the parameter intervals of the cells tile the ray: each starts with the number with which the last one
//! ended. Which cell a ray is in near a corner may be told differently by different traversals; cells are classified with
//! a margin that makes this harmless.

mod bresenham;
mod fujimoto;
mod glassner;
mod lattice;
mod parametric;
pub mod plane;
mod samet;
#[cfg(test)]
mod tests;
mod wyvill_kunii;

use crate::geom::{Bounds, Ray, Vec3};
use crate::octree::{Cell, CellWord, Kind, Octree};
use std::fmt;
use std::ops::ControlFlow;
use std::str::FromStr;

/// One cell on a ray's way.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// What the cell is.
    pub cell: Cell<'a>,
    /// Where the ray enters it: exactly where it left the cell before.
    pub t_in: f64,
    /// Where the ray leaves it.
    pub t_out: f64,
    /// The middle of the cell.
    pub center: Vec3,
    /// Half the cell's edge.
    pub half: f64,
}

/// Which traversal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TraversalKind {
    /// Top down by the parameters of the cells' middle planes, front to back.
    Parametric,
    /// Leaves in a hash table by their linear code; the next cell by looking up a point beyond the exit face
    /// [Glassner 1984].
    Glassner,
    /// A pointer tree; the next cell by descending from the root [Wyvill-Kunii-Shirai 1986].
    WyvillKunii,
    /// The complete octree as a regular grid in a table addressed by the linear code; neighbours by arithmetic on the code
    /// [Fujimoto 1986; Gargantini 1982].
    Fujimoto,
    /// Neighbours by ascending to the common ancestor and descending mirrored [Samet 1982].
    Samet,
    /// The paper's own: Bresenham's line on cells of different size, in integers [Comba-Persiano, §4.2]. The default: by
    /// measurement the fastest on large models, and as fast as any on small ones.
    #[default]
    Bresenham,
}

impl TraversalKind {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Bresenham, Self::Glassner, Self::WyvillKunii, Self::Fujimoto, Self::Samet, Self::Parametric];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Parametric => "parametric",
            Self::Glassner => "glassner",
            Self::WyvillKunii => "wyvill-kunii",
            Self::Fujimoto => "fujimoto",
            Self::Samet => "samet",
            Self::Bresenham => "bresenham",
        }
    }

    /// Whether it walks the tree of cells itself. Otherwise its tables stand for the tree, of which it needs nothing more
    /// than the leaves' programs.
    pub const fn needs_tree(self) -> bool {
        !matches!(self, Self::Glassner | Self::Fujimoto)
    }

    /// The deepest octree that it can walk.
    pub const fn max_depth(self) -> u32 {
        match self {
            Self::Fujimoto => fujimoto::MAX_DEPTH,
            _ => crate::octree::BuildOptions::MAX_DEPTH,
        }
    }
}

impl fmt::Display for TraversalKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name that is no traversal's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no traversal is called `{0}`")]
pub struct UnknownTraversal(String);

impl FromStr for TraversalKind {
    type Err = UnknownTraversal;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(|| UnknownTraversal(name.into()))
    }
}

/// A way to walk one octree, with the tables that it needs beside the tree.
#[derive(Clone, Debug)]
pub struct Traversal(Tables);

#[derive(Clone, Debug)]
enum Tables {
    Parametric,
    Glassner(glassner::LinearOctree),
    WyvillKunii,
    Fujimoto(fujimoto::Grid),
    Samet(samet::Parents),
    Bresenham(samet::Parents),
}

impl Traversal {
    /// Which traversal it is.
    pub fn kind(&self) -> TraversalKind {
        match self.0 {
            Tables::Parametric => TraversalKind::Parametric,
            Tables::Glassner(_) => TraversalKind::Glassner,
            Tables::WyvillKunii => TraversalKind::WyvillKunii,
            Tables::Fujimoto(_) => TraversalKind::Fujimoto,
            Tables::Samet(_) => TraversalKind::Samet,
            Tables::Bresenham(_) => TraversalKind::Bresenham,
        }
    }

    /// Makes the tables that this traversal needs.
    ///
    /// # Panics
    /// If the octree is deeper than [`TraversalKind::max_depth`].
    pub fn new(kind: TraversalKind, octree: &Octree) -> Self {
        Self(match kind {
            TraversalKind::Parametric => Tables::Parametric,
            TraversalKind::Glassner => Tables::Glassner(glassner::LinearOctree::new(octree)),
            TraversalKind::WyvillKunii => Tables::WyvillKunii,
            TraversalKind::Fujimoto => Tables::Fujimoto(fujimoto::Grid::new(octree)),
            TraversalKind::Samet => Tables::Samet(samet::Parents::new(octree)),
            TraversalKind::Bresenham => Tables::Bresenham(samet::Parents::new(octree)),
        })
    }

    /// Shows `visit` the cells of the octree, which must be the one that the tables were made for, that the ray meets
    /// between `t_in` and `t_out`, in order, until it breaks off. The intervals of the cells tile `[t_in, t_out]`; both
    /// must lie where the ray is in the root cube.
    pub fn walk<B>(
        &self,
        octree: &Octree,
        ray: &Ray,
        t_in: f64,
        t_out: f64,
        visit: impl FnMut(Step<'_>) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        match &self.0 {
            Tables::Parametric => parametric::walk(octree, ray, t_in, t_out, visit),
            Tables::Glassner(linear) => glassner::walk(linear, octree, ray, t_in, t_out, visit),
            Tables::WyvillKunii => wyvill_kunii::walk(octree, ray, t_in, t_out, visit),
            Tables::Fujimoto(grid) => fujimoto::walk(grid, octree, ray, t_in, t_out, visit),
            Tables::Samet(parents) => samet::walk(parents, octree, ray, t_in, t_out, visit),
            Tables::Bresenham(parents) => bresenham::walk(parents, octree, ray, t_in, t_out, visit),
        }
    }

    /// Memory of the tables beside the tree, in bytes.
    pub fn bytes(&self) -> usize {
        match &self.0 {
            Tables::Parametric | Tables::WyvillKunii => 0,
            Tables::Glassner(linear) => linear.bytes(),
            Tables::Fujimoto(grid) => grid.bytes(),
            Tables::Samet(parents) | Tables::Bresenham(parents) => parents.bytes(),
        }
    }
}

/// The interval in which the ray is in the root cube; `None` where it misses it.
pub fn root_interval(octree: &Octree, ray: &Ray) -> Option<(f64, f64)> {
    interval(&octree.bounds(), ray)
}

/// The interval in which the ray is in a box; `None` where it misses it.
pub(crate) fn interval(bounds: &Bounds, ray: &Ray) -> Option<(f64, f64)> {
    let (mut t_in, mut t_out) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (o, d) = (ray.origin[axis], ray.direction[axis]);
        let (low, high) = (bounds.min[axis], bounds.max[axis]);
        if is_parallel(d) {
            if o < low || o > high {
                return None;
            }
            continue;
        }
        let (a, b) = ((low - o) / d, (high - o) / d);
        t_in = t_in.max(a.min(b));
        t_out = t_out.min(a.max(b));
    }
    (t_in < t_out).then_some((t_in, t_out))
}

/// Whether a direction part is too small to matter: no ray gets anywhere along it.
fn is_parallel(d: f64) -> bool {
    d.abs() < 1e-290
}

/// What a word that is no branch stands for.
fn cell_of(octree: &Octree, word: CellWord) -> Cell<'_> {
    match word.kind() {
        Kind::Inside => Cell::Inside,
        Kind::Leaf(program) => Cell::Leaf(octree.program(program)),
        Kind::Outside | Kind::Branch(_) => Cell::Outside,
    }
}

/// Where the ray passes the plane at `height` across `axis`; infinite, with the sign that puts it on the right side, where
/// it never does.
#[inline]
fn plane_t(ray: &Ray, axis: usize, height: f64) -> f64 {
    let (o, d) = (ray.origin[axis], ray.direction[axis]);
    if is_parallel(d) { if o < height { f64::INFINITY } else { f64::NEG_INFINITY } } else { (height - o) / d }
}

/// The side of a cell on which the ray leaves it: where, and across which axis.
#[inline]
fn exit(ray: &Ray, center: Vec3, half: f64) -> (f64, usize) {
    let mut first = (f64::INFINITY, 0);
    for axis in 0..3 {
        let d = ray.direction[axis];
        if is_parallel(d) {
            continue;
        }
        let face = if d > 0.0 { center[axis] + half } else { center[axis] - half };
        let t = (face - ray.origin[axis]) / d;
        if t < first.0 {
            first = (t, axis);
        }
    }
    first
}

/// The child of the branch about `center` in which the ray is from `t` on.
#[inline]
fn octant_at(ray: &Ray, center: Vec3, t: f64) -> usize {
    (0..3).fold(0, |octant, axis| {
        let passed = t >= plane_t(ray, axis, center[axis]);
        let downwards = ray.direction[axis] < 0.0 && !is_parallel(ray.direction[axis]);
        octant | usize::from(passed != downwards) << axis
    })
}
