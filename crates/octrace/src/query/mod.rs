//! Questions about a finished solid: one file or folder for each.

pub mod measure;

pub use measure::{MeasureError, MeasureOptions, Measures, measure};
