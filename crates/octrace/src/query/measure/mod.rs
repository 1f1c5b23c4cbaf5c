//! How much is there, and where: volume, centroid and bounding box.
//!
//! First the box: corners, ridges and round tops are searched for with rays, and boxes cut smaller and smaller prove that
//! nothing sticks out further (`extent`). Then the volume, by adding up the chords of parallel rays over that box (`volume`).

mod body;
mod ceiling;
mod climb;
mod extent;
mod shadow;
mod volume;

use crate::exec::{Cancelled, Exec};
use crate::geom::{Bounds, Vec3};
use crate::trace::Tracer;
use body::Body;

/// How exactly to measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasureOptions {
    /// The volume's error to be reached, relative to the volume.
    pub tolerance: f64,
    /// At most so many rays; where these do not suffice, [`Measures::converged`] says so.
    pub max_rays: u64,
}

impl Default for MeasureOptions {
    /// Four digits; 50 million rays.
    fn default() -> Self {
        Self { tolerance: 1e-4, max_rays: 50_000_000 }
    }
}

/// What was measured, in scene units. Errors are estimates on the safe side, of two or three standard deviations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// The volume; zero for the empty solid.
    pub volume: f64,
    /// How far the volume may be off.
    pub volume_error: f64,
    /// The centre of mass of the solid filled evenly; `None` where there is no volume.
    pub centroid: Option<Vec3>,
    /// How far the centroid may be off.
    pub centroid_error: f64,
    /// The smallest axis-aligned box around the solid, empty for the empty solid. Something is known to be at each of
    /// its sides; it is at most [`bbox_error`](Self::bbox_error) too small.
    pub bbox: Bounds,
    /// How far the solid may reach out of [`bbox`](Self::bbox).
    pub bbox_error: f64,
    /// Whether the volume's error is within the tolerance.
    pub converged: bool,
    /// Rays traced.
    pub rays: u64,
}

/// Why a solid could not be measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeasureError {
    /// The work was interrupted.
    #[error("interrupted")]
    Cancelled,
    /// The solid has no finite volume.
    #[error("the solid is unbounded, so it has no volume and no bounding box")]
    Unbounded,
}

impl From<Cancelled> for MeasureError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Measures the solid by tracing rays through it. The same bits for any number of threads.
///
/// # Errors
/// If the solid is unbounded, or `exec` is cancelled.
pub fn measure(tracer: &Tracer, options: &MeasureOptions, exec: &Exec) -> Result<Measures, MeasureError> {
    if tracer.is_unbounded() {
        return Err(MeasureError::Unbounded);
    }
    Ok(measure_body(tracer, options, exec)?)
}

fn measure_body(body: &impl Body, options: &MeasureOptions, exec: &Exec) -> Result<Measures, Cancelled> {
    exec.install(|| {
        let extent = extent::extent(body, exec)?;
        let integral = volume::integrate(body, &extent.possible, options, exec)?;
        Ok(Measures {
            volume: integral.volume,
            volume_error: integral.volume_error,
            centroid: integral.centroid,
            centroid_error: integral.centroid_error,
            bbox: extent.confirmed,
            bbox_error: extent.error(),
            converged: integral.converged,
            rays: extent.rays + integral.rays,
        })
    })
}

#[cfg(test)]
mod tests;
