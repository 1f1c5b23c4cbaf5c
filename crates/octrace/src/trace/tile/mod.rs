//! Tiles of coherent rays, traced together: a picture's camera rays, sixteen by sixteen.
//!
//! A tile goes through the octree once. At every branch the octants are parted by what each block of four by four rays can
//! reach; in leaves, programs are evaluated for eight rays at once. What is found is what the march of each ray by itself
//! finds ([`super::march`]), bit for bit; rays that are unusual in any way are traced by that.

mod crossing;
mod dispatch;
mod frustum;
mod lanes;
mod program;
mod walk;

pub use dispatch::Backend;

use super::prepared::Prepared;
use super::roots::hit_of;
use super::{Scratch, Tracer};
use crate::geom::{Bounds, Hit, Ray, Vec3};
use crate::surface::{CellBox, Side, Surface};
use crossing::Rays;
use dispatch::walk_on;
use frustum::Frustum;
use lanes::{LANES, Mask};
use walk::{Packet, Scenery};

/// Pixels along the edge of a tile.
pub const TILE_PX: usize = 16;
/// Pixels along the edge of a block.
const BLOCK_PX: usize = 4;
/// Blocks along the edge of a tile.
const BLOCKS: usize = TILE_PX / BLOCK_PX;
/// Rays of a packet along x, and along y.
const PACKET_PX: (usize, usize) = (4, 2);
/// Packets along x.
const ACROSS: usize = TILE_PX / PACKET_PX.0;
/// Packets in a tile.
const PACKETS: usize = TILE_PX * TILE_PX / LANES;

/// The block that a packet belongs to.
#[inline(always)]
fn packet_block(packet: usize) -> usize {
    packet / ACROSS * PACKET_PX.1 / BLOCK_PX * BLOCKS + packet % ACROSS * PACKET_PX.0 / BLOCK_PX
}

/// The pixel of a ray.
#[inline(always)]
fn pixel_of(packet: usize, lane: usize) -> (usize, usize) {
    let x = packet % ACROSS * PACKET_PX.0 + lane % PACKET_PX.0;
    let y = packet / ACROSS * PACKET_PX.1 + lane / PACKET_PX.0;
    (x, y)
}

/// What a ray meets: the body and the hit.
pub type TileHit = Option<(usize, Hit)>;
/// What the rays of a tile meet, by row and column.
pub type TileHits = [[TileHit; TILE_PX]; TILE_PX];

/// A way to trace the tiles of one picture.
#[derive(Clone, Debug)]
pub struct Tiles<'a> {
    tracer: &'a Tracer,
    /// For each body, whether rays set out outside of it.
    start_outside: Vec<bool>,
    backend: Backend,
}

impl Tracer {
    /// How to trace a picture's camera rays in tiles; `None` where each must be traced by itself: without octrees, for
    /// meshes, with another traversal than the default, and if the rays' origins, all in the box `origins`, are not clearly on one side of everything, or far away.
    pub fn tiles(&self, origins: &Bounds, backend: Backend) -> Option<Tiles<'_>> {
        let has_meshes = self.catalog.surfaces.iter().any(|surface| matches!(surface, Surface::Mesh(_)));
        let is_near = |origin: Vec3| Prepared::new(&Ray { origin, direction: Vec3::Z }, &self.bounds()).is_as_given();
        let one_by_one = self.bodies.iter().any(|body| !body.is_walked_by_default());
        if has_meshes || one_by_one || !is_near(origins.min) || !is_near(origins.max) {
            return None;
        }
        let coordinates = origins.min.max_abs().max(origins.max.max_abs());
        let margin = Vec3::splat(1e-9 * (self.bounds().size().max_abs() + coordinates));
        let around = CellBox::new(origins.center(), origins.size() * 0.5 + margin);
        let start_outside = self.bodies.iter().map(|body| match body.classify(&self.catalog, &around) {
            Side::Outside => body.octree().map(|_| true),
            Side::Inside => body.octree().map(|_| false),
            Side::Crossing => None,
        });
        Some(Tiles { tracer: self, start_outside: start_outside.collect::<Option<_>>()?, backend })
    }
}

impl Tiles<'_> {
    /// The first crossings of a tile's rays with any body, as [`Tracer::first_body_hit`] finds them: row by row, of `size`
    /// pixels, at most [`TILE_PX`] each way.
    ///
    /// `ray(x, y)` is the ray through a point of the tile, `offset` the point of each pixel. Rays have unit directions; they
    /// come from one point or are parallel, and straight lines of pixels lie in planes.
    pub fn hits(
        &self,
        ray: impl Fn(f64, f64) -> Ray,
        offset: (f64, f64),
        size: (usize, usize),
        scratch: &mut Scratch,
    ) -> TileHits {
        let at = |x: usize, y: usize| ray(x as f64 + offset.0, y as f64 + offset.1);
        let mut hits = [[None; TILE_PX]; TILE_PX];
        let mut alone = [[true; TILE_PX]; TILE_PX];
        if let Some(frustum) = Frustum::new(&ray) {
            let packets: [Packet; PACKETS] = std::array::from_fn(|packet| {
                let mut rays = Rays::default();
                let mut wanted = Mask::NONE;
                for lane in 0..LANES {
                    let (x, y) = pixel_of(packet, lane);
                    rays.set(lane, &at(x, y));
                    wanted.set(lane, x < size.0 && y < size.1);
                }
                Packet::new(rays, wanted)
            });
            alone = [[false; TILE_PX]; TILE_PX];
            for (number, body) in self.tracer.bodies.iter().enumerate() {
                let Some(octree) = body.octree() else { continue };
                let wanted = self.start_outside[number];
                let (catalog, program) = (&self.tracer.catalog, &body.program);
                let mut packets = packets;
                let scenery = Scenery { catalog, program, octree, frustum: &frustum, wanted };
                let work = walk_on(self.backend, &scenery, &mut packets);
                scratch.counters.cells += work.cells;
                scratch.counters.surface_tests += work.surface_tests;
                for (index, packet) in packets.iter().enumerate() {
                    for lane in 0..LANES {
                        let (x, y) = pixel_of(index, lane);
                        let t = packet.t.0[lane];
                        alone[y][x] |= packet.given_up.get(lane);
                        if t < hits[y][x].map_or(f64::INFINITY, |(_, hit): (usize, Hit)| hit.t) {
                            let ray = packet.rays.lane(lane);
                            hits[y][x] = Some((number, hit_of(catalog, packet.words[lane] as u32, &ray, t, wanted)));
                        }
                    }
                }
            }
        }
        for y in 0..size.1 {
            for x in 0..size.0 {
                if alone[y][x] {
                    hits[y][x] = self.tracer.first_body_hit(&at(x, y), f64::INFINITY, scratch);
                }
            }
        }
        hits
    }
}
