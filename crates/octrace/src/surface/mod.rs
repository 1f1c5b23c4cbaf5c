//! Surfaces: what primitives are made of. A block is the intersection of six half-spaces, a cylinder that of a quadric
//! and two half-spaces. A surface divides space into an inside and an outside; a ray crosses it at some parameters.
//!
//! Every tracer in this crate gets its numbers from here, from the same operations in the same order. That is why their
//! answers can be compared bit for bit.

mod crossings;
mod plane;
mod quadric;

pub use crossings::{Crossings, Sides};
pub use plane::Plane;
pub use quadric::{Quadric, QuadricKind};

use crate::geom::{Ray, Vec3};

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
}

/// A surface in scene space.
#[derive(Clone, Debug)]
pub enum Surface {
    /// A plane; its inside is a half-space.
    Plane(Plane),
    /// Ellipsoid, elliptic cylinder or elliptic double cone.
    Quadric(Quadric),
}

impl Surface {
    /// Where the line of the ray crosses the surface, over all `t` from minus to plus infinity: appends the ascending
    /// parameters and returns whether the line comes from inside.
    pub fn crossings(&self, ray: &Ray, params: &mut Vec<f64>) -> bool {
        let crossings = match self {
            Self::Plane(plane) => plane.crossings(ray),
            Self::Quadric(quadric) => quadric.crossings(ray),
        };
        params.extend_from_slice(crossings.params());
        crossings.starts_inside()
    }

    /// Which surface is seen where the line crosses this one (its own index is `own`) at `t`, into it (`entering`) or out
    /// of it; and whether that surface's outward side is this one's inside.
    pub fn facet_at(&self, own: u32, _ray: &Ray, _t: f64, _entering: bool) -> (u32, bool) {
        (own, false)
    }

    /// Where the box lies. Conservative: `Outside` and `Inside` are said only where it is so, up to rounding, which is
    /// for the caller's margin to cover.
    pub fn classify(&self, cell: &CellBox) -> Side {
        match self {
            Self::Plane(plane) => plane.classify(cell),
            Self::Quadric(quadric) => quadric.classify(cell),
        }
    }

    /// The outward normal at a point of the surface, not normalised; zero at a cone's apex.
    pub fn gradient(&self, p: Vec3) -> Vec3 {
        match self {
            Self::Plane(plane) => plane.normal,
            Self::Quadric(quadric) => quadric.gradient(p),
        }
    }

    /// Roughly the distance of `p` from the surface (first order), in scene units.
    pub fn distance(&self, p: Vec3) -> f64 {
        match self {
            Self::Plane(plane) => (plane.normal.dot(p) - plane.offset).abs(),
            Self::Quadric(quadric) => quadric.distance(p),
        }
    }
}
