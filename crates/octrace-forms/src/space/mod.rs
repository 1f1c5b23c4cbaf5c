//! Solids made of solids other than by boolean operations: hulls, Minkowski sums, shadows and sections.
//!
//! In come trees of primitives; out come trees of primitives. Curved surfaces stay what they are wherever the result has a
//! form in planes, quadrics and tori.

mod arcs;
mod bounds;
mod contour;
mod convex;
mod fold;
mod frusta;
mod hull;
mod leaves;
mod mesh;
mod minkowski;
mod pieces;
mod round;
mod rounding;
mod section;
mod shadow;
mod slab;
mod slab_sum;
mod sums;
mod swept;
mod turned_sum;

pub use bounds::{bounds, resize, tight_bounds};
pub use hull::{hull, hull_with_corners};
pub use mesh::{TriangleMesh, mesh};
pub use minkowski::minkowski;
pub use section::section;
pub use shadow::shadow;

use crate::plane::PlaneError;

/// Why a solid could not be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SpaceError {
    /// A solid goes on for ever.
    #[error("an operand is unbounded")]
    Unbounded,
    /// A mesh is not closed, or its sheets meet in a way that has no inside.
    #[error("the boundary of an operand could not be found: a polyhedron in it is not a clean solid")]
    NotASolid,
    /// An outline has too many edges, or numbers that are none.
    #[error(transparent)]
    Plane(#[from] PlaneError),
    /// The sum of two solids has too many parts.
    #[error("the operands have too many faces for their Minkowski sum to be made")]
    TooMuch,
    /// The box around an operand could not be measured.
    #[error("the size of an operand could not be measured")]
    Unmeasured,
}

impl From<round::Unbounded> for SpaceError {
    fn from(_: round::Unbounded) -> Self {
        Self::Unbounded
    }
}
