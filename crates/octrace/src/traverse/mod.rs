//! Ways to walk an octree along a ray. A traversal yields cells in order and knows nothing of primitives.

mod parametric;

use crate::geom::{Ray, Vec3};
use crate::octree::{Cell, Octree};
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
    #[default]
    Parametric,
}

impl TraversalKind {
    /// All of them.
    pub const ALL: [Self; 1] = [Self::Parametric];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Parametric => "parametric",
        }
    }

    /// Shows `visit` the cells that the ray meets between `t_in` and `t_out`, in order, until it breaks off. The
    /// intervals of the cells tile `[t_in, t_out]`; both must lie where the ray is in the root cube.
    pub fn walk<B>(
        self,
        octree: &Octree,
        ray: &Ray,
        t_in: f64,
        t_out: f64,
        visit: impl FnMut(Step<'_>) -> ControlFlow<B>,
    ) -> ControlFlow<B> {
        match self {
            Self::Parametric => parametric::walk(octree, ray, t_in, t_out, visit),
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

/// The interval in which the ray is in the root cube; `None` where it misses it.
pub fn root_interval(octree: &Octree, ray: &Ray) -> Option<(f64, f64)> {
    let (mut t_in, mut t_out) = (f64::NEG_INFINITY, f64::INFINITY);
    let bounds = octree.bounds();
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
