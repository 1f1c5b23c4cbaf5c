//! What is swept from profiles, prisms and bodies of revolution: what their hulls depend on, their convex parts, their
//! meshes, and their sections across the axis.

mod convexity;
mod edge;
mod mesh;
mod plan;
mod rings;
#[cfg(test)]
mod tests;

pub(crate) use convexity::{is_convex, is_convex_revolution, straight_parts};
pub(super) use edge::{Walk, walk};
pub(crate) use mesh::{prism_mesh, revolution_mesh};
pub(crate) use rings::{reaches, rings_at};
