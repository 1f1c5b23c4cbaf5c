//! The leaves of the CSG tree, each in its own coordinate system [Comba-Persiano, §2.1].

mod bvh;
mod mesh;
mod polyhedron;
mod profile;

pub(crate) use bvh::{Below, BoxTree, Bvh, Node};
pub use mesh::{Crossing, Mesh, MovedFace, SurfaceRef};
pub(crate) use mesh::{Facet, MeshPlane, MeshTriangle, TINY, UNCERTAIN};
pub use polyhedron::{FacePlane, Polyhedron, PolyhedronError, Triangle};
pub use profile::{Contour, Curve, Edge, Profile, ProfileError};
pub(crate) use profile::{Join, Outline, Step};

use crate::geom::{Affine, Bounds, Vec3};
use std::sync::Arc;

/// A primitive solid in primitive space.
#[derive(Clone, Debug, PartialEq)]
pub enum Primitive {
    /// The unit cube in the first octant, a corner at the origin.
    Block,
    /// The unit ball about the origin.
    Sphere,
    /// Radius 1, height 1, base on z = 0, about the z axis.
    Cylinder,
    /// The unbounded half-space z >= 0.
    HalfSpace,
    /// A cone or frustum about the z axis: radius 1 at z = 0, radius `top` at z = 1, `0 <= top < 1`.
    Cone {
        /// Radius at z = 1.
        top: f64,
    },
    /// A ring about the z axis in the plane z = 0: major radius 1, minor radius `minor`, `0 < minor`.
    Torus {
        /// Radius of the tube.
        minor: f64,
    },
    /// A closed polyhedron, convex or not.
    Polyhedron(Arc<Polyhedron>),
    /// What is above the profile in the xy plane, up to z = 1; on the way it is scaled about the z axis, by 1 at z = 0 and by
    /// `top` at z = 1, `0 <= top <= 1`.
    Prism {
        /// The base.
        profile: Arc<Profile>,
        /// Scale at z = 1.
        top: f64,
    },
    /// What a profile sweeps around the z axis: its x is the distance from the axis, its y is z. What it has to the left of its
    /// y axis is cut off.
    Revolution(Arc<Profile>),
}

impl From<Polyhedron> for Primitive {
    fn from(p: Polyhedron) -> Self {
        Self::Polyhedron(Arc::new(p))
    }
}

impl Primitive {
    /// Lengths from the inverse of this up to this are told apart; what is larger or thinner is nothing. Then the fourth
    /// powers that finding crossings takes are numbers, whatever the ray.
    pub const LONGEST: f64 = 1e30;

    /// Whether the primitive is too large, too far away, or too thin to calculate with where it was moved: in a box
    /// `bounds`, by a map with that inverse.
    pub fn exceeds_numbers(&self, bounds: &Bounds, inverse: &Affine) -> bool {
        let thin = match self {
            Self::HalfSpace => return false,
            Self::Torus { minor } => *minor < 1.0 / Self::LONGEST,
            Self::Revolution(profile) => profile.bounds().1.x < 1.0 / Self::LONGEST,
            Self::Prism { top, .. } => !(0.0..=1.0).contains(top),
            _ => false,
        };
        let farthest = bounds.min.max_abs().max(bounds.max.max_abs());
        let steepest = inverse.rows.iter().map(|row| row.max_abs()).fold(0.0, f64::max);
        // Also where a number is NaN.
        thin || !(farthest <= Self::LONGEST && steepest <= Self::LONGEST)
    }

    /// The smallest axis-aligned box around the primitive after it was moved by `map`.
    pub fn bounds(&self, map: &Affine) -> Bounds {
        // Half-extent of the image of a disc of radius r in the xy plane, by axis.
        let disc = |r: f64| {
            let extent = |row: Vec3| (row.x * row.x + row.y * row.y).sqrt() * r;
            Vec3::new(extent(map.rows[0]), extent(map.rows[1]), extent(map.rows[2]))
        };
        let frustum = |top: f64| {
            let low = map.translation;
            let high = low + map.column(2);
            Bounds::new(low - disc(1.0), low + disc(1.0)).union(Bounds::new(high - disc(top), high + disc(top)))
        };
        match self {
            Self::Block => Bounds::new(Vec3::ZERO, Vec3::splat(1.0)).transformed(map),
            Self::Sphere => {
                let extent = Vec3::new(map.rows[0].length(), map.rows[1].length(), map.rows[2].length());
                Bounds::new(map.translation - extent, map.translation + extent)
            }
            Self::Cylinder => frustum(1.0),
            Self::Cone { top } => frustum(*top),
            Self::HalfSpace => Bounds::ALL,
            Self::Torus { minor } => {
                let tube = Vec3::new(map.rows[0].length(), map.rows[1].length(), map.rows[2].length()) * *minor;
                let extent = disc(1.0) + tube;
                Bounds::new(map.translation - extent, map.translation + extent)
            }
            Self::Polyhedron(p) => Bounds::around(p.points().iter().map(|&q| map.point(q))),
            Self::Prism { profile, top } => {
                let at = |z: f64, scale: f64| profile.hull().map(move |p| Vec3::new(p.x * scale, p.y * scale, z));
                Bounds::around(at(0.0, 1.0).chain(at(1.0, *top)).map(|p| map.point(p)))
            }
            Self::Revolution(profile) => {
                let (low, high) = profile.bounds();
                if high.x <= 0.0 {
                    return Bounds::EMPTY;
                }
                let end = |z: f64| map.translation + map.column(2) * z;
                let around = |p: Vec3| Bounds::new(p - disc(high.x), p + disc(high.x));
                around(end(low.y)).union(around(end(high.y)))
            }
        }
    }
}
