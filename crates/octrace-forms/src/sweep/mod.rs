//! Solids swept from flat shapes: along a line, straight or twisted, and around an axis.
//!
//! What a straight sweep makes of lines and arcs has an exact form: prisms and bodies of revolution. A twisted one has
//! not, and is a polyhedron; so is everything that is to have OpenSCAD's own facets.

mod layers;
mod linear;
mod rotate;
mod slices;

pub use linear::{LinearExtrude, linear_extrude};
pub use rotate::{RotateExtrude, rotate_extrude};
pub use slices::{Fragments, fragments};

use crate::Tolerance;
use crate::plane::{Affine2, Flat, Outline, PlaneError};
use octrace::{PolyhedronError, Profile, ProfileError};
use std::sync::Arc;

/// Why nothing could be swept.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// The shape reaches across the axis that it is to be turned about.
    #[error("the shape lies on both sides of the axis: x goes from {from} to {to}")]
    AcrossAxis {
        /// Smallest x.
        from: f64,
        /// Largest x.
        to: f64,
    },
    /// The boundary of the shape cannot be computed.
    #[error(transparent)]
    Plane(#[from] PlaneError),
    /// The outline is not sound.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The polyhedron is not sound.
    #[error(transparent)]
    Polyhedron(#[from] PolyhedronError),
}

/// The shape as it is to be swept: itself, or its boundary where an operand stands for the whole plane, so that shapes are cut
/// out of it and what is left cut out again. Swept, such operands would be of a size at which nothing is found.
fn resolved(shape: &Flat, tolerance: Tolerance) -> Result<Flat, SweepError> {
    const PLANE: f64 = 1e4;
    let leaf = |outline: &Arc<Outline>, map: &Affine2| -> Result<(f64, f64), SweepError> {
        let size = outline.moved(map, tolerance).bounds().map(|bounds| bounds.diagonal());
        Ok(size.map_or((f64::INFINITY, 0.0), |size| (size, size)))
    };
    let (least, most) = shape.fold(leaf, |_, sizes| {
        Ok(sizes.iter().fold((f64::INFINITY, 0.0), |all, size| (all.0.min(size.0), all.1.max(size.1))))
    })?;
    Ok(if most > PLANE * least { Flat::Outline(shape.outline(tolerance)?) } else { shape.clone() })
}

/// The profile that an outline is; `None` where it has no area.
///
/// Curves that all but touch may cross by a rounding of what decided how they hang together. Then chords have to do.
fn profile(outline: &Outline, tolerance: Tolerance) -> Result<Option<Arc<Profile>>, SweepError> {
    let made = match Profile::new(outline.contours.clone()) {
        Err(ProfileError::Crossing { .. }) => Profile::new(outline.polygonised(tolerance).contours),
        made => made,
    };
    match made {
        Ok(profile) => Ok(Some(Arc::new(profile))),
        Err(ProfileError::Flat) => Ok(None),
        Err(error) => Err(error.into()),
    }
}
