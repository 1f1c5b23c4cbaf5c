//! Tiles of coherent rays, traced together: a picture's camera rays, sixteen by sixteen.
//!
//! A tile goes through the octree once. At every branch the octants are parted by what each block of four by four rays can
//! reach; in leaves, programs are evaluated for eight rays at once. What is found is what the march of each ray by itself
//! finds ([`super::march`]), bit for bit; rays that are unusual in any way are traced by that.

mod beam;
mod bundles;
mod copy;
mod crossing;
mod dispatch;
mod eight;
mod kernels;
mod lambert;
pub(crate) mod lanes;
mod layout;
mod leaf;
mod mesh;
mod outer;
mod packet;
mod parts;
mod points;
mod program;
mod prune;
mod roots;
mod sort;
mod stream;
mod torus;
mod walk;

pub use dispatch::Backend;
pub(crate) use dispatch::Task;
pub(crate) use eight::EightHits;
pub use eight::EightRays;
pub use lambert::{Brightness, Told};
pub use lanes::{LANES, Stored};
pub(crate) use layout::{PACKET_PX, PACKETS, corner_of, lane_of};
pub(crate) use points::{EightPoints, points};
pub use stream::RayTo;

use super::prepared::Prepared;
use super::roots::hit_of;
use super::{Scratch, Tracer};
use crate::compile::Catalog;
use crate::geom::{Bounds, Hit, Ray, Vec3};
use crate::model::CameraRays;
use crate::surface::{CellBox, Side};
use beam::Beam;
use bundles::Bundles;
use kernels::Chunk;
use lanes::{F64s, Isa, Vector};
use leaf::{MAX_CUTS, Slab, Slabs};
use mesh::MeshMemo;
use packet::{Common, Own, Packet};
use program::Solved;
use sort::Sorted;
use walk::{Lead, Scenery, Waiting, walk};

/// Pixels along the edge of a tile.
pub const TILE_PX: usize = 16;
/// What a ray meets: the body and the hit.
pub type TileHit = Option<(usize, Hit)>;

/// The rays of one tile and what they meet; memory to be used for one tile after another.
#[derive(Debug)]
pub struct RayTile {
    packets: [Packet; PACKETS],
    beam: Beam,
    bundles: Bundles,
    /// Whether all rays start at the beam's eye.
    from_eye: bool,
    waiting: [Waiting; Waiting::MOST],
    solved: Solved,
    meshes: MeshMemo,
    slabs: Slabs,
    chunk: Option<Box<Chunk>>,
    /// What the rays met that were traced by themselves, by packet and lane.
    alone: Vec<(u16, TileHit)>,
    /// Rays of a stream, and memory to put them in.
    sorted: Sorted,
    eights: Vec<EightRays>,
    found: Vec<EightHits>,
    met: Vec<u8>,
}

impl Default for RayTile {
    fn default() -> Self {
        Self {
            packets: [Packet::default(); PACKETS],
            beam: Beam::default(),
            bundles: Bundles::default(),
            from_eye: false,
            waiting: [Waiting::NOTHING; Waiting::MOST],
            solved: Solved::default(),
            meshes: MeshMemo::default(),
            slabs: [Slab::NOTHING; MAX_CUTS + 1],
            chunk: None,
            alone: Vec::new(),
            sorted: Sorted::default(),
            eights: Vec::new(),
            found: Vec::new(),
            met: Vec::new(),
        }
    }
}

/// A way to trace the tiles of one picture.
#[derive(Clone, Debug)]
pub struct Tiles<'a> {
    tracer: &'a Tracer,
    camera: CameraRays,
    /// For each body, whether rays set out outside of it.
    start_outside: Vec<bool>,
    backend: Backend,
}

impl Tracer {
    /// How to trace a picture's camera rays in tiles; `None` where each must be traced by itself: without octrees, with
    /// another traversal than the default, and if the places where rays start are not clearly on one side of everything, or
    /// are far away. `size_px` is the size of the film.
    pub fn tiles(&self, camera: &CameraRays, size_px: (u32, u32), backend: Backend) -> Option<Tiles<'_>> {
        let edge = |size: u32| [0.0, f64::from(size)];
        let corners = edge(size_px.0).into_iter().flat_map(|x| edge(size_px.1).map(|y| camera.ray(x, y).origin));
        let origins = Bounds::around(corners);
        let is_near = |origin: Vec3| Prepared::new(&Ray { origin, direction: Vec3::Z }, &self.bounds()).is_as_given();
        let one_by_one = self.bodies.iter().any(|body| !body.is_walked_by_default());
        if one_by_one || !is_near(origins.min) || !is_near(origins.max) {
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
        let start_outside = start_outside.collect::<Option<_>>()?;
        Some(Tiles { tracer: self, camera: *camera, start_outside, backend })
    }
}

impl Tiles<'_> {
    /// Finds the first crossings of a tile's rays with any body, as [`Tracer::first_body_hit`] finds them. The tile's upper
    /// left pixel is `corner`; it has `size` pixels, at most [`TILE_PX`] each way; `place` is where in each pixel its ray
    /// goes through, from 0 to 1. [`hit`](Self::hit) tells what they met.
    pub fn trace(
        &self,
        corner: (u32, u32),
        size: (u32, u32),
        place: (f64, f64),
        tile: &mut RayTile,
        scratch: &mut Scratch,
    ) {
        self.backend.run(TraceTile { tiles: self, corner, size, place, tile, scratch });
        tile.alone.clear();
        for packet in 0..PACKETS {
            let mut left = tile.packets[packet].given_up;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                let ray = tile.ray(packet, lane);
                let hit = self.tracer.first_body_hit(&ray, f64::INFINITY, scratch);
                tile.alone.push(((packet * LANES + lane) as u16, hit));
            }
        }
    }

    /// The ray of a pixel of the tile.
    pub fn ray(&self, tile: &RayTile, (x, y): (usize, usize)) -> Ray {
        let (packet, lane) = lane_of(x, y);
        tile.ray(packet, lane)
    }

    /// The rays of the tile, [`PACKETS`] eights of them, and what they met; a pixel's is where [`lane_of`] says.
    pub(crate) fn eights(&self, tile: &RayTile, rays: &mut [EightRays], hits: &mut [EightHits]) {
        self.backend.run(TakeTile { catalog: &self.tracer.catalog, tile, rays, hits });
        for &(number, hit) in &tile.alone {
            hits[usize::from(number) / LANES].set(usize::from(number) % LANES, hit);
        }
    }

    /// What the ray of a pixel of the tile met.
    pub fn hit(&self, tile: &RayTile, (x, y): (usize, usize)) -> TileHit {
        let (number, lane) = lane_of(x, y);
        let packet = &tile.packets[number];
        if packet.given_up >> lane & 1 != 0 {
            let index = (number * LANES + lane) as u16;
            return tile.alone.iter().find(|(alone, _)| *alone == index).and_then(|(_, hit)| *hit);
        }
        tile.hit(self.tracer, number, lane)
    }
}

impl RayTile {
    /// One of its rays.
    fn ray(&self, packet: usize, lane: usize) -> Ray {
        let packet = &self.packets[packet];
        let at = |v: &[Stored; 3]| Vec3::new(v[0].0[lane], v[1].0[lane], v[2].0[lane]);
        let origin = if self.from_eye { self.beam.eye } else { at(&packet.origin) };
        Ray { origin, direction: at(&packet.direction) }
    }

    /// What a ray met that was not given up.
    fn hit(&self, tracer: &Tracer, number: usize, lane: usize) -> TileHit {
        let packet = &self.packets[number];
        if packet.met >> lane & 1 == 0 {
            return None;
        }
        let (t, entering) = (packet.t.0[lane], packet.entering >> lane & 1 != 0);
        let (word, facet) = (packet.words[lane], packet.facets[lane]);
        let known = mesh::hit_of_facet(&tracer.catalog, word, facet, t, entering);
        let hit = known.unwrap_or_else(|| hit_of(&tracer.catalog, word, &self.ray(number, lane), t, entering));
        Some((packet.bodies[lane] as usize, hit))
    }
}

/// [`Tiles::trace`], but for the rays that are given up.
struct TraceTile<'a, 'b> {
    tiles: &'b Tiles<'a>,
    corner: (u32, u32),
    size: (u32, u32),
    place: (f64, f64),
    tile: &'b mut RayTile,
    scratch: &'b mut Scratch,
}

impl Task for TraceTile<'_, '_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { tiles, corner, size, place, tile, scratch } = self;
        let corner = (f64::from(corner.0), f64::from(corner.1));
        tile.beam = Beam::new(&tiles.camera, corner.0, corner.1);
        tile.from_eye = !tiles.camera.orthographic;
        tile.meshes.forget();
        let lanes_in = |number: usize| {
            let mut wanted = 0;
            for lane in 0..LANES {
                let (left, top) = corner_of(number);
                let (x, y) = (left + lane % PACKET_PX.0, top + lane / PACKET_PX.0);
                wanted |= u8::from(x < size.0 as usize && y < size.1 as usize) << lane;
            }
            wanted
        };
        let is_whole = size.0 as usize >= TILE_PX && size.1 as usize >= TILE_PX;
        for (number, packet) in tile.packets.iter_mut().enumerate() {
            let wanted = if is_whole { u8::MAX } else { lanes_in(number) };
            packet.set_out::<I>(&tiles.camera, number, corner, place, wanted);
        }
        for (number, body) in tiles.tracer.bodies.iter().enumerate() {
            let Some(octree) = body.octree() else { continue };
            for packet in &mut tile.packets {
                packet.open = packet.wanted & !packet.given_up;
                packet.started_there = 0;
            }
            let scenery = Scenery::of(tiles.tracer, number, octree, tiles.start_outside[number]);
            match tiles.camera.orthographic {
                true => walk::<I, Own>(scenery, Lead::Beam, tile, scratch),
                false => walk::<I, Common>(scenery, Lead::Beam, tile, scratch),
            }
            for packet in &mut tile.packets {
                // The camera is on one side of everything.
                packet.given_up |= packet.started_there;
            }
        }
    }
}

/// [`Tiles::eights`], but for the rays that were given up.
struct TakeTile<'a> {
    catalog: &'a Catalog,
    tile: &'a RayTile,
    rays: &'a mut [EightRays],
    hits: &'a mut [EightHits],
}

impl Task for TakeTile<'_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { catalog, tile, rays, hits } = self;
        let eye = Vector::<F64s<I>>::from_one(tile.beam.eye).stored();
        let end = F64s::<I>::infinity().stored();
        for ((packet, rays), hits) in tile.packets.iter().zip(rays).zip(hits) {
            rays.origin = if tile.from_eye { eye } else { packet.origin };
            (rays.direction, rays.end, rays.lanes) = (packet.direction, end, packet.wanted);
            hits.forget();
            hits.take::<I>(catalog, rays, packet, packet.wanted);
        }
    }
}
