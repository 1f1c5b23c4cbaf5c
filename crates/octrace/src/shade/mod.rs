//! From hits to light.

mod branch;
mod light;
mod lit;
mod materials;
mod meet;
mod optics;
mod path;
mod ray_tree;
mod shadows;
mod wave;
mod whitted;

pub use light::RayCounts;
pub(crate) use light::{EightSeen, Lighting};
pub(crate) use ray_tree::Recorder;
pub use ray_tree::{RayKind, RayTree, TracedRay};
pub(crate) use wave::{Wave, Workshop};
pub(crate) use whitted::Whitted;
