//! Questions about a finished solid: one file or folder for each.

pub mod measure;
mod occupied;

pub use measure::{MeasureError, MeasureOptions, Measures, measure};
pub use occupied::{occupied_bounds, occupied_bounds_closely};
