//! Many rays at once that need not have anything in common: shadow rays, mirror images, queries.
//!
//! Rays whose directions have the same signs meet the cells of an octree in the same order. They are put together, eight to a
//! packet, and packets to a tile; so those that are asked for one after another should be near each other. Eights most of
//! whose rays agree stay as they are.

use super::dispatch::{Backend, Task};
use super::eight::{EightHits, EightRays};
use super::lanes::{Isa, LANES};
use super::packet::Own;
use super::sort::{Alike, Sort};
use super::walk::{Lead, Scenery, walk};
use super::{PACKETS, RayTile, TileHit};
use crate::compile::{Constant, Program};
use crate::geom::{Bounds, Ray, Vec3};
use crate::trace::prepared::Usual;
use crate::trace::{Scratch, Tracer};
use std::ops::Range;

/// A ray, and up to which parameter it is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayTo {
    /// The ray.
    pub ray: Ray,
    /// Crossings beyond this parameter do not count.
    pub end: f64,
}

/// Rays, and the bodies that they may meet.
#[derive(Clone, Copy)]
struct Asked<'a> {
    bodies: &'a Range<usize>,
    rays: &'a [EightRays],
}

/// What is to be found out.
enum Answers<'a> {
    /// What rays meet.
    Hits(&'a mut [EightHits]),
    /// Which rays meet anything, a bit for each lane.
    Met(&'a mut [u8]),
}

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
        let mut eights = std::mem::take(&mut tile.eights);
        let mut found = std::mem::take(&mut tile.found);
        by_eights(rays, &mut eights);
        found.resize(eights.len(), EightHits::default());
        self.eight_hits(0..self.bodies.len(), &eights, backend, tile, scratch, &mut found);
        for index in 0..rays.len() {
            hits[index] = found[index / LANES].hit(index % LANES);
        }
        (tile.eights, tile.found) = (eights, found);
    }

    /// Which rays meet any body at all, for a slice as long as `rays`: whether [`first_hits_into`](Self::first_hits_into) has
    /// a hit for each, in less time. It is what shadows ask for.
    ///
    /// # Panics
    /// If the slice is shorter.
    pub fn blocked_into(
        &self,
        rays: &[RayTo],
        backend: Backend,
        tile: &mut RayTile,
        scratch: &mut Scratch,
        blocked: &mut [bool],
    ) {
        let mut eights = std::mem::take(&mut tile.eights);
        let mut met = std::mem::take(&mut tile.met);
        by_eights(rays, &mut eights);
        met.resize(eights.len(), 0);
        self.eights_met(0..self.bodies.len(), &eights, backend, tile, scratch, &mut met);
        for index in 0..rays.len() {
            blocked[index] = met[index / LANES] >> (index % LANES) & 1 != 0;
        }
        (tile.eights, tile.met) = (eights, met);
    }

    /// As [`blocked_into`](Self::blocked_into), of rays by eights: a bit for each lane. Whoever makes rays by eights saves
    /// putting them together; those of an eight, and eights one after another, should be near each other.
    ///
    /// # Panics
    /// If the slice is shorter than `rays`.
    pub fn eights_blocked_into(
        &self,
        rays: &[EightRays],
        backend: Backend,
        tile: &mut RayTile,
        scratch: &mut Scratch,
        blocked: &mut [u8],
    ) {
        self.eights_met(0..self.bodies.len(), rays, backend, tile, scratch, &mut blocked[..rays.len()]);
    }

    /// As [`first_hits_into`](Self::first_hits_into), by eights, with some bodies.
    pub(crate) fn eight_hits(
        &self,
        bodies: Range<usize>,
        rays: &[EightRays],
        backend: Backend,
        tile: &mut RayTile,
        scratch: &mut Scratch,
        hits: &mut [EightHits],
    ) {
        for hits in &mut *hits {
            hits.forget();
        }
        self.stream(Asked { bodies: &bodies, rays }, backend, tile, scratch, &mut Answers::Hits(hits));
    }

    /// Which rays meet any of some bodies: a bit for each lane.
    pub(crate) fn eights_met(
        &self,
        bodies: Range<usize>,
        rays: &[EightRays],
        backend: Backend,
        tile: &mut RayTile,
        scratch: &mut Scratch,
        met: &mut [u8],
    ) {
        met.fill(0);
        self.stream(Asked { bodies: &bodies, rays }, backend, tile, scratch, &mut Answers::Met(met));
    }

    fn stream(&self, asked: Asked, backend: Backend, tile: &mut RayTile, scratch: &mut Scratch, answers: &mut Answers) {
        let mut sorted = std::mem::take(&mut tile.sorted);
        let Asked { bodies, rays } = asked;
        if bodies.is_empty() {
            return;
        }
        let together = self.bodies[bodies.clone()].iter().all(|body| body.is_walked_by_default());
        let usual = together.then(|| Usual::new(&self.bounds()));
        let room = if bodies.len() < self.bodies.len() { self.room_of(bodies) } else { None };
        backend.run(Sort { usual, room, rays, sorted: &mut sorted });
        for number in sorted.alone.drain(..) {
            let (eight, lane) = (number as usize / LANES, number as usize % LANES);
            self.answer_alone(asked, (eight, lane), scratch, answers);
        }
        for (signs, Alike { together, loose }) in sorted.alike.iter_mut().enumerate() {
            let (mut left, mut loose_left) = (&together[..], &loose[..]);
            while !(left.is_empty() && loose_left.is_empty()) {
                let (now, loose_now);
                (now, left) = left.split_at(left.len().min(PACKETS));
                (loose_now, loose_left) = loose_left.split_at(loose_left.len().min((PACKETS - now.len()) * LANES));
                let packed = Packed { asked, together: now, loose: loose_now };
                tile.load_loose(&packed);
                backend.run(TraceStream { tracer: self, signs, packed, tile, scratch, answers });
                self.answer_others(&packed, tile, scratch, answers);
            }
            together.clear();
            loose.clear();
        }
        tile.sorted = sorted;
    }

    /// A box that holds some bodies, if they are bounded, with some room to spare.
    fn room_of(&self, bodies: &Range<usize>) -> Option<Bounds> {
        self.bodies[bodies.clone()].iter().try_fold(Bounds::EMPTY, |room, body| {
            let Program { outer, bounds, .. } = &body.program;
            let spare = body.octree().map_or(0.0, |octree| 1e-3 * octree.half);
            let around = Bounds { min: bounds.min - Vec3::splat(spare), max: bounds.max + Vec3::splat(spare) };
            (*outer == Constant::Everywhere(false)).then(|| room.union(around))
        })
    }

    /// What those rays met that were loose, or given up.
    fn answer_others(&self, packed: &Packed, tile: &RayTile, scratch: &mut Scratch, answers: &mut Answers) {
        let Packed { asked, together, loose } = *packed;
        for (&(number, lanes), packet) in together.iter().zip(&tile.packets) {
            let mut left = packet.given_up & lanes;
            while left != 0 {
                self.answer_alone(asked, (number as usize, left.trailing_zeros() as usize), scratch, answers);
                left &= left - 1;
            }
        }
        for (place, &number) in loose.iter().enumerate() {
            let (packet, from) = (together.len() + place / LANES, place % LANES);
            let (number, lane) = (number as usize / LANES, number as usize % LANES);
            match answers {
                _ if tile.packets[packet].given_up >> from & 1 != 0 => {
                    self.answer_alone(asked, (number, lane), scratch, answers);
                }
                Answers::Hits(hits) => hits[number].set(lane, tile.hit(self, packet, from)),
                Answers::Met(met) => met[number] |= (tile.packets[packet].met >> from & 1) << lane,
            }
        }
    }

    /// Traces a ray by itself.
    #[cold]
    fn answer_alone(
        &self,
        Asked { bodies, rays }: Asked,
        (number, lane): (usize, usize),
        scratch: &mut Scratch,
        answers: &mut Answers,
    ) {
        let eight = &rays[number];
        let hit = self.first_hit_of(bodies.clone(), &eight.ray(lane), eight.end.0[lane], scratch);
        match answers {
            Answers::Hits(hits) => hits[number].set(lane, hit),
            Answers::Met(met) => met[number] |= u8::from(hit.is_some()) << lane,
        }
    }
}

/// Rays whose directions have the same signs, as many as go into a tile: those that are together first.
#[derive(Clone, Copy)]
struct Packed<'a> {
    asked: Asked<'a>,
    together: &'a [(u32, u8)],
    loose: &'a [u32],
}

impl RayTile {
    /// Takes loose rays.
    fn load_loose(&mut self, packed: &Packed) {
        let packets = &mut self.packets[packed.together.len()..];
        for packet in &mut *packets {
            packet.forget();
        }
        for (packet, loose) in packets.iter_mut().zip(packed.loose.chunks(LANES)) {
            for lane in 0..LANES {
                // Lanes without a ray of their own shall hold nothing unusual either.
                let number = loose[lane.min(loose.len() - 1)] as usize;
                packet.follow_one(lane, &packed.asked.rays[number / LANES], number % LANES);
            }
            packet.wanted = u8::MAX >> (LANES - loose.len());
        }
    }
}

/// Finds the answers for rays, but for those that are loose or given up: what those met is left in the tile.
struct TraceStream<'a, 'b, 'c> {
    tracer: &'a Tracer,
    signs: usize,
    packed: Packed<'a>,
    tile: &'a mut RayTile,
    scratch: &'a mut Scratch,
    answers: &'b mut Answers<'c>,
}

impl Task for TraceStream<'_, '_, '_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self {
            tracer,
            signs,
            packed: Packed { asked: Asked { bodies, rays }, together, .. },
            tile,
            scratch,
            answers,
        } = self;
        tile.from_eye = false;
        for (packet, &(number, lanes)) in tile.packets.iter_mut().zip(together) {
            packet.follow::<I>(&rays[number as usize], lanes);
        }
        for packet in tile.packets.iter_mut().filter(|packet| packet.wanted != 0) {
            packet.prepare::<I>();
        }
        follow::<I>(tracer, bodies, signs, tile, scratch);
        for (packet, &(number, lanes)) in tile.packets.iter().zip(together) {
            let number = number as usize;
            match answers {
                Answers::Hits(hits) => hits[number].take::<I>(&tracer.catalog, &rays[number], packet, lanes),
                Answers::Met(met) => met[number] |= packet.met & !packet.given_up & lanes,
            }
        }
    }
}

/// Follows the rays of a tile through the bodies.
#[inline(always)]
fn follow<I: Isa>(tracer: &Tracer, bodies: &Range<usize>, signs: usize, tile: &mut RayTile, scratch: &mut Scratch) {
    tile.bundles.forget();
    tile.meshes.forget();
    for number in bodies.clone() {
        let Some(octree) = tracer.bodies[number].octree() else { continue };
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

/// Puts rays together, eight by eight.
fn by_eights(rays: &[RayTo], eights: &mut Vec<EightRays>) {
    eights.clear();
    eights.extend(rays.chunks(LANES).map(|rays| {
        let mut eight = EightRays::NONE;
        for (lane, RayTo { ray, end }) in rays.iter().enumerate() {
            eight.put(lane, ray, *end);
        }
        eight.fill_up();
        eight
    }));
}
