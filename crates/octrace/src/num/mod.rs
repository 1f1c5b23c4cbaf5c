//! Numbers: finding roots, powers.

mod power;
mod roots;

pub use power::power_of_fraction;
pub(crate) use power::series as power_series;
pub use roots::{bracketed_root, cubic_roots};
