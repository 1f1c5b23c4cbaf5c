//! Numbers: finding roots, powers, linear programs.

mod linear;
mod power;
mod roots;

pub(crate) use linear::{HalfSpace, farthest};
pub use power::power_of_fraction;
pub(crate) use power::series as power_series;
pub(crate) use roots::MOST_STEPS;
pub use roots::{Precision, bracketed_root, cubic_roots};
