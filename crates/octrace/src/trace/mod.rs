//! Rays against programs: the canonical tracer, and the one that goes through the octree.

mod body;
mod canonical;
mod cells;
mod combine;
mod march;
mod options;
mod prepared;
mod report;
mod roots;
mod stats;
mod sweep;
mod tile;
mod tracer;

pub use cells::OctreeCell;
pub use options::{Accel, TracerOptions, UnknownAccel};
pub use report::{RayReport, VisitedCell};
pub use stats::{Counters, TracerStats};
pub use tile::{Backend, Brightness, EightRays, LANES, RayTile, RayTo, Stored, TILE_PX, TileHit, Tiles, Told};
pub(crate) use tile::{EightHits, EightPoints, PACKET_PX, PACKETS, Task, corner_of, lane_of, lanes, points};
pub use tracer::{Scratch, SurfacePoint, Tracer};
