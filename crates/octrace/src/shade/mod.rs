//! From hits to light.

mod whitted;

pub use whitted::RayCounts;
pub(crate) use whitted::{Lighting, Whitted};
