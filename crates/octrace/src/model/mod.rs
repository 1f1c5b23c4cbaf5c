//! What is asked for: the CSG tree and how it is lit and seen. Checked, then immutable.

mod bodies;
mod camera;
mod color;
pub mod families;
mod light;
mod look;
mod material;
mod scene;
mod solid;

pub use bodies::Bodies;
pub use camera::{Camera, CameraRays, Projection};
pub use color::{Rgb, linear_to_srgb, srgb_to_linear};
pub use light::Light;
pub use look::{DEFAULT_AMBIENT, DEFAULT_BACKGROUND, default_lights, frame_all};
pub use material::{Material, Part, PartId};
pub use scene::Scene;
pub use solid::{BoolOp, Node, Solid};
