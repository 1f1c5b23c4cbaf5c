//! Exact ray tracing of CSG solids, straight from the CSG tree, with no meshing.
//!
//! The whole way, from a tree to a picture: a [`Solid`] is put into a [`Scene`]; a [`Tracer`] compiles it, builds an octree
//! in which each cell keeps only what matters there, and answers rays; [`film::render`] lights what the rays hit.
//!
//! ```
//! use octrace::exec::Exec;
//! use octrace::film::{Background, View, render};
//! use octrace::model::frame_all;
//! use octrace::{Material, Part, PartId, Projection, Ray, Rgb, Scene, Solid, Tracer, TracerOptions};
//!
//! // A drilled block. The ends of the hole lie in the block's faces: no matter.
//! let hole = Solid::cylinder().scale([0.25, 0.25, 1.0]).translate([0.5, 0.5, 0.0]);
//! let solid = (Solid::block() - hole).part(PartId(0));
//! let brass = Part { material: Material::metal(Rgb::from_srgb([0.8, 0.6, 0.3])) };
//! let scene = Scene { parts: vec![brass], ..Scene::new(solid) };
//!
//! let exec = Exec::default();
//! let tracer = Tracer::build(&scene.solid, &TracerOptions::default(), &exec)?;
//!
//! // Rays: first hits, and all the stretches inside.
//! let down = Ray::new([0.125, 0.125, 4.0], [0.0, 0.0, -1.0]);
//! assert_eq!(tracer.first_hit(&down).map(|hit| hit.t), Some(3.0)); // exact, not nearly
//! assert_eq!(tracer.spans(&down).len(), 1);
//! assert!(tracer.spans(&Ray::new([0.5, 0.5, 4.0], [0.0, 0.0, -1.0])).is_empty());
//!
//! // A picture.
//! let perspective = Projection::Perspective { fov_deg: 22.5 };
//! let camera = frame_all(&tracer.bounds(), None, perspective, (64, 48));
//! let view = View {
//!     camera,
//!     width_px: 64,
//!     height_px: 48,
//!     samples: 1,
//!     max_bounces: 4,
//!     background: Background::Scene,
//! };
//! let (film, stats) = render(&scene, &tracer, &view, &exec)?;
//! assert_eq!(film.to_rgba8().len(), 64 * 48 * 4);
//! assert_eq!(stats.rays.camera, 64 * 48);
//! # Ok::<(), octrace::exec::Cancelled>(())
//! ```
//!
//! Everything is `f64`, immutable once built, and the same to the bit on every machine and for any number of threads. The
//! crate opens no files, prints nothing and reads no clock: `octrace-read` reads files, `octrace-cli` is the command.

pub mod compile;
pub mod exec;
pub mod film;
pub mod geom;
pub mod model;
mod num;
pub mod octree;
pub mod primitive;
pub mod query;
pub mod shade;
pub mod surface;
pub mod trace;
pub mod traverse;

pub use geom::{Affine, Bounds, Hit, Ray, Span, Spans, Vec2, Vec3};
pub use model::{BoolOp, Camera, Light, Material, Part, PartId, Projection, Rgb, Scene, Solid};
pub use primitive::{Contour, Curve, Edge, Polyhedron, PolyhedronError, Primitive, Profile, ProfileError};
pub use trace::{Accel, Tracer, TracerOptions};

/// The examples of the README are tested with those of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
