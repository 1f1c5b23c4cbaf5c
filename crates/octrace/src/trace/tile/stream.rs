//! Many rays at once that need not have anything in common: shadow rays, mirror images, queries.
//!
//! Rays whose directions have the same signs meet the cells of an octree in the same order. They are put together, eight to a
//! packet, and packets to a tile; so those that are asked for one after another should be near each other.

use super::dispatch::{Backend, Task};
use super::lanes::{Isa, LANES};
use super::packet::Own;
use super::walk::{Lead, Scenery, walk};
use super::{PACKETS, RayTile, TileHit};
use crate::geom::Ray;
use crate::trace::prepared::Usual;
use crate::trace::{Scratch, Tracer};

/// A ray, and up to which parameter it is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayTo {
    /// The ray.
    pub ray: Ray,
    /// Crossings beyond this parameter do not count.
    pub end: f64,
}

/// The most rays of one tile.
const MOST: usize = PACKETS * LANES;

impl Tracer {
    /// The first crossings of many rays with any body, in the order of the rays: each what
    /// [`first_body_hit`](Self::first_body_hit) says of it. Fastest for rays that are near their neighbours in the list.
    pub fn first_hits(
        &self,
        rays: &[RayTo],
        backend: Backend,
        tile: &mut RayTile,
        scratch: &mut Scratch,
    ) -> Vec<TileHit> {
        let mut hits = vec![None; rays.len()];
        self.first_hits_into(rays, backend, tile, scratch, &mut hits);
        hits
    }

    /// As [`first_hits`](Self::first_hits), into a slice as long as `rays`.
    ///
    /// # Panics
    /// If the slice is shorter.
    pub fn first_hits_into(
        &self,
        rays: &[RayTo],
        backend: Backend,
        tile: &mut RayTile,
        scratch: &mut Scratch,
        hits: &mut [TileHit],
    ) {
        let together = self.bodies.iter().all(|body| body.is_walked_by_default());
        let usual = Usual::new(&self.bounds());
        let mut by_signs = std::mem::take(&mut tile.by_signs);
        for (index, RayTo { ray, end }) in rays.iter().enumerate() {
            let is_usual = together && usual.holds(ray) && *end > 0.0;
            if !is_usual {
                hits[index] = self.first_body_hit(ray, *end, scratch);
                continue;
            }
            let bit = |axis: usize| usize::from(ray.direction[axis].is_sign_negative()) << axis;
            let signs = bit(0) | bit(1) | bit(2);
            by_signs[signs].push(index as u32);
            if by_signs[signs].len() == MOST {
                self.trace_alike(signs, rays, &by_signs[signs], backend, tile, scratch, hits);
                by_signs[signs].clear();
            }
        }
        for (signs, indices) in by_signs.iter_mut().enumerate() {
            if !indices.is_empty() {
                self.trace_alike(signs, rays, indices, backend, tile, scratch, hits);
                indices.clear();
            }
        }
        tile.by_signs = by_signs;
    }

    /// Traces rays whose directions have the same signs.
    #[expect(clippy::too_many_arguments, reason = "all of what its only caller has")]
    fn trace_alike(
        &self,
        signs: usize,
        rays: &[RayTo],
        indices: &[u32],
        backend: Backend,
        tile: &mut RayTile,
        scratch: &mut Scratch,
        hits: &mut [TileHit],
    ) {
        tile.from_eye = false;
        for packet in &mut tile.packets {
            (packet.wanted, packet.met, packet.given_up) = (0, 0, 0);
        }
        for (place, &index) in indices.iter().enumerate() {
            let RayTo { ray, end } = rays[index as usize];
            tile.packets[place / LANES].put(place % LANES, &ray, end);
        }
        backend.run(TraceStream { tracer: self, signs, tile, scratch });
        for (place, &index) in indices.iter().enumerate() {
            let (packet, lane) = (place / LANES, place % LANES);
            let RayTo { ray, end } = rays[index as usize];
            hits[index as usize] = match tile.packets[packet].given_up >> lane & 1 {
                0 => tile.hit(self, packet, lane),
                _ => self.first_body_hit(&ray, end, scratch),
            };
        }
    }
}

/// Rays whose directions have the same signs.
struct TraceStream<'a> {
    tracer: &'a Tracer,
    signs: usize,
    tile: &'a mut RayTile,
    scratch: &'a mut Scratch,
}

impl Task for TraceStream<'_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { tracer, signs, tile, scratch } = self;
        for packet in tile.packets.iter_mut().filter(|packet| packet.wanted != 0) {
            packet.invert::<I>();
        }
        for (number, body) in tracer.bodies.iter().enumerate() {
            let Some(octree) = body.octree() else { continue };
            for packet in &mut tile.packets {
                packet.open = packet.wanted & !packet.given_up;
                packet.started_there = 0;
            }
            // First those that start outside; it turns out which do not.
            for wanted in [true, false] {
                let scenery = Scenery::of(tracer, number, octree, wanted);
                walk::<I, Own>(scenery, Lead::Signs(signs), tile, scratch);
                let mut some_started_inside = false;
                for packet in &mut tile.packets {
                    some_started_inside |= packet.started_there != 0;
                    packet.open = packet.started_there;
                    packet.started_there = 0;
                    if !wanted {
                        // On neither side, as it seems.
                        packet.given_up |= packet.open;
                    }
                }
                if !some_started_inside {
                    break;
                }
            }
        }
    }
}
