//! Forms that are not primitives, made of them: outlines in the plane and what is done with them, text, solids swept from
//! outlines, hulls and Minkowski sums, and files with meshes, drawings and height fields.
//!
//! What curves is kept curved wherever that has an exact form; where it has none, [`Tolerance`] says how far a polygon may
//! be from the truth.

pub mod curve;
pub mod files;
pub mod plane;
pub mod space;
pub mod sweep;
pub mod text;

/// How far, at most, something with corners may lie from the curve that it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// As a share of the size of the thing at hand (the diagonal of its box).
    pub relative: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { relative: 1e-4 }
    }
}
