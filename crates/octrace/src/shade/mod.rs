//! From hits to light.

mod ray_tree;
mod wave;
mod whitted;

pub(crate) use ray_tree::Recorder;
pub use ray_tree::{RayKind, RayTree, TracedRay};
pub(crate) use wave::{Wave, Workshop};
pub use whitted::RayCounts;
pub(crate) use whitted::{Lighting, Seen, Whitted};
