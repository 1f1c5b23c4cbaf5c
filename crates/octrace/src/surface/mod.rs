//! Surfaces: what primitives are made of. A block is the intersection of six half-spaces, a cylinder that of a quadric
//! and two half-spaces. A surface divides space into an inside and an outside; a ray crosses it at some parameters.
//!
//! Every tracer in this crate gets its numbers from here, from the same operations in the same order. That is why their
//! answers can be compared bit for bit.

mod crossings;
mod enclosure;
mod extent;
mod octants;
mod placed;
mod plane;
mod quadric;
mod rounding;
mod torus;

pub use crossings::{Crossings, Sides};
pub(crate) use octants::halves;
pub use octants::{OctantSides, Octants};
pub use placed::Placed;
pub use plane::Plane;
pub use quadric::{Quadric, QuadricKind};
pub use torus::{Torus, TorusKind};

use crate::geom::{Ray, Vec3};
use crate::primitive::{Crossing, Mesh};
use std::sync::Arc;

/// Where a box lies with respect to a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// No point of the box is in the set.
    Outside,
    /// Every point of the box is in the set.
    Inside,
    /// Some may be and some may not.
    Crossing,
}

/// An axis-aligned box by its middle and half its edges, as classification wants it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellBox {
    /// The middle.
    pub center: Vec3,
    /// Half the edge lengths.
    pub half: Vec3,
    /// How far off, in scene units, rounding may have put the points that are said to be in the box. In the coordinates of
    /// a surface that was squashed at an angle this becomes an error across the surface too, and is accounted for there.
    pub rounding: f64,
}

impl CellBox {
    /// What rounding does is this part of a margin.
    pub(crate) const ROUNDING_IN_MARGINS: f64 = 1.0 / 64.0;

    /// A box, for points that are known to be in it.
    pub fn new(center: Vec3, half: Vec3) -> Self {
        Self { center, half, rounding: 0.0 }
    }

    /// A box with a margin all around that amply covers what rounding does to points in it.
    pub fn with_margin(center: Vec3, half: Vec3, margin: f64) -> Self {
        Self { center, half: half + Vec3::splat(margin), rounding: margin * Self::ROUNDING_IN_MARGINS }
    }

    /// How far each of the coordinates to which `rows` are the linear part may be from the box's middle, and how far off
    /// rounding may have put them.
    pub(crate) fn reach(&self, rows: &[Vec3; 3]) -> (Vec3, Vec3) {
        let reach = rows.map(|row| row.abs().dot(self.half));
        let rounding = rows.map(|row| row.abs().dot(Vec3::splat(self.rounding)));
        (Vec3::from(reach) + Vec3::from(rounding), Vec3::from(rounding))
    }
}

/// A surface in scene space.
#[derive(Clone, Debug)]
pub enum Surface {
    /// A plane; its inside is a half-space.
    Plane(Plane),
    /// Ellipsoid, elliptic cylinder or elliptic double cone.
    Quadric(Quadric),
    /// Torus, ring or spindle, or the inner surface of a spindle.
    Torus(Torus),
    /// The boundary of a polyhedron that is not convex. Its faces lie in planes that are surfaces too.
    Mesh(Arc<Mesh>),
    /// A whole solid that is stored once and stands in several places.
    Placed(Placed),
}

impl Surface {
    /// Where the line of the ray crosses the surface, over all `t` from minus to plus infinity: appends the ascending
    /// parameters and returns whether the line comes from inside. `all` is the catalogue that the surface belongs to.
    /// (Those of a solid that is stored once are for the tracer to find, who has its program.)
    pub fn crossings(&self, all: &[Surface], ray: &Ray, params: &mut Vec<f64>) -> bool {
        let crossings = match self {
            Self::Plane(plane) => plane.crossings(ray),
            Self::Quadric(quadric) => quadric.crossings(ray),
            Self::Torus(torus) => torus.crossings(ray),
            Self::Mesh(mesh) => {
                let mut toggles = Vec::new();
                mesh_toggles(mesh, all, ray, &mut toggles);
                params.extend(toggles.iter().map(|toggle| toggle.t));
                return false;
            }
            Self::Placed(_) => return false,
        };
        params.extend_from_slice(crossings.params());
        crossings.starts_inside()
    }

    /// Where the box lies. Conservative: `Outside` and `Inside` are said only where it is so, up to rounding, which is
    /// for the caller's margin to cover.
    pub fn classify(&self, cell: &CellBox) -> Side {
        match self {
            Self::Plane(plane) => plane.classify(cell),
            Self::Quadric(quadric) => quadric.classify(cell),
            Self::Torus(torus) => torus.classify(cell),
            Self::Placed(placed) => placed.classify(cell),
            Self::Mesh(mesh) => {
                if mesh.touches_box(cell.center, cell.half) {
                    Side::Crossing
                } else if mesh.contains(cell.center) {
                    Side::Inside
                } else {
                    Side::Outside
                }
            }
        }
    }

    /// Which simple surface is seen where the line crosses this one (its own index is `own`) at `t`, into it (`entering`)
    /// or out of it; and whether that surface's outward side is this one's inside.
    pub fn facet_at(&self, own: u32, all: &[Surface], ray: &Ray, t: f64, entering: bool) -> (u32, bool) {
        match self {
            Self::Plane(_) | Self::Quadric(_) | Self::Torus(_) | Self::Placed(_) => (own, false),
            Self::Mesh(mesh) => {
                let seen = mesh.triangle_at(ray, |surface| plane_t(all, surface, ray), t, entering);
                let face = mesh.surface(seen.unwrap_or(0));
                (face.surface, face.flipped)
            }
        }
    }

    /// Whether both are the same simple surface, to the bit.
    pub(crate) fn same_numbers(&self, other: &Surface) -> bool {
        match (self, other) {
            (Self::Plane(a), Self::Plane(b)) => a == b,
            (Self::Quadric(a), Self::Quadric(b)) => a == b,
            (Self::Torus(a), Self::Torus(b)) => a == b,
            _ => false,
        }
    }

    /// The outward normal at a point of a simple surface, not normalised; zero at a cone's apex, where a torus closes
    /// in one point, and for a mesh or a whole solid, whose faces' surfaces are asked instead.
    pub fn gradient(&self, p: Vec3) -> Vec3 {
        match self {
            Self::Plane(plane) => plane.normal,
            Self::Quadric(quadric) => quadric.gradient(p),
            Self::Torus(torus) => torus.gradient(p),
            Self::Mesh(_) | Self::Placed(_) => Vec3::ZERO,
        }
    }

    /// Roughly the distance of `p` from a simple surface (first order), in scene units; infinite for a mesh or a whole solid.
    pub fn distance(&self, p: Vec3) -> f64 {
        match self {
            Self::Plane(plane) => (plane.normal.dot(p) - plane.offset).abs(),
            Self::Quadric(quadric) => quadric.distance(p),
            Self::Torus(torus) => torus.distance(p),
            Self::Mesh(_) | Self::Placed(_) => f64::INFINITY,
        }
    }
}

/// Where the ray meets the plane with that number; NaN where it does not.
fn plane_t(all: &[Surface], surface: u32, ray: &Ray) -> f64 {
    match &all[surface as usize] {
        Surface::Plane(plane) => plane.crossings(ray).params().first().map_or(f64::NAN, |&t| t),
        _ => f64::NAN,
    }
}

/// Where the line goes into a mesh and out of it: what there is to know of it, in `toggles`.
pub(crate) fn mesh_toggles(mesh: &Mesh, all: &[Surface], ray: &Ray, toggles: &mut Vec<Crossing>) {
    mesh.toggles(ray, |surface| plane_t(all, surface, ray), toggles);
    for toggle in toggles {
        // Turns -0 into 0: equal parameters shall have equal bits.
        toggle.t += 0.0;
    }
}
