//! Points, maps, boxes and rays; spans of rays and their ends.

mod bounds;
mod plane;
mod ray;
mod span;
mod transform;
mod vector;

pub use bounds::Bounds;
pub use plane::Vec2;
pub use ray::Ray;
pub(crate) use span::SpansBuilder;
pub use span::{Hit, Span, Spans};
pub use transform::{Affine, sin_cos_deg};
pub use vector::Vec3;
