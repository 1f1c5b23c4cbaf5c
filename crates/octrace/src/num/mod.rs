//! Numbers: finding roots.

mod roots;

pub use roots::{bracketed_root, cubic_roots};
