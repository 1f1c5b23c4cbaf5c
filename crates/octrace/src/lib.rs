//! Exact ray tracing of CSG solids, straight from the CSG tree, with no meshing.

pub mod compile;
pub mod exec;
pub mod film;
pub mod geom;
pub mod model;
pub mod num;
pub mod octree;
pub mod primitive;
pub mod query;
pub mod shade;
pub mod surface;
pub mod trace;
pub mod traverse;

pub use geom::{Affine, Bounds, Hit, Ray, Span, Spans, Vec3};
pub use model::{BoolOp, Camera, Light, Material, Part, PartId, Projection, Rgb, Scene, Solid};
pub use primitive::{Polyhedron, PolyhedronError, Primitive};
pub use trace::{Accel, Tracer, TracerOptions};
