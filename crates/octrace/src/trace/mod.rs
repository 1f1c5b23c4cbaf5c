//! Rays against programs: the canonical tracer, and the one that goes through the octree.

mod canonical;
mod combine;
mod march;
mod prepared;
mod report;
mod roots;
mod tracer;

pub use combine::{combine, complement};
pub use report::{RayReport, VisitedCell};
pub use tracer::{Accel, Counters, Scratch, SurfacePoint, Tracer, TracerOptions, TracerStats, UnknownAccel};
