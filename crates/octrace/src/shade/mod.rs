//! From hits to light.

mod whitted;

pub use whitted::{Lighting, RayCounts, Whitted};
