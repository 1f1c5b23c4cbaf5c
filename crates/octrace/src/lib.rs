//! Exact ray tracing of CSG solids, straight from the CSG tree, with no meshing.

pub mod geom;
pub mod model;
pub mod primitive;

pub use geom::{Affine, Bounds, Hit, Ray, Span, Spans, Vec3};
pub use model::{BoolOp, Camera, Light, Material, Part, PartId, Projection, Rgb, Scene, Solid};
pub use primitive::{Polyhedron, PolyhedronError, Primitive};
