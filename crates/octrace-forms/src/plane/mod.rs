//! Flat shapes: outlines of lines and arcs, trees of boolean operations on them, and what OpenSCAD does with such.

mod affine;
mod boolean;
mod curve;
mod extent;
mod flat;
mod hull;
mod minkowski;
mod offset;
mod outline;
mod resize;

pub use affine::Affine2;
pub use boolean::{Fill, combine, exclusive, region};
pub use extent::Bounds2;
pub use flat::Flat;
pub use hull::hull;
pub use offset::Offset;
pub use outline::Outline;
pub use resize::resize_factors;

/// Why a boundary could not be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PlaneError {
    /// A coordinate is infinite or NaN.
    #[error("an outline has a coordinate that is not finite")]
    NotFinite,
    /// There would be more to do than anybody would wait for.
    #[error("an outline is too complex: {edges} edges that cross each other too often")]
    TooComplex {
        /// The number of edges, curves counted by their chords.
        edges: usize,
    },
}

#[cfg(test)]
mod laws;
#[cfg(test)]
mod openscad;
