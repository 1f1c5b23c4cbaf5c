//! Rays by eights, and what they meet: what whoever has many rays hands in and gets back. Each is an array for every number,
//! so that lanes can work on it.

use super::TileHit;
use super::lanes::{F64s, Isa, LANES, Mask, Stored};
use super::mesh::hit_of_facet;
use super::packet::Packet;
use crate::compile::{Catalog, Word};
use crate::geom::{Hit, Ray, Vec3};
use crate::surface::Surface;
use crate::trace::roots::hit_of;

/// Eight rays, each followed up to a parameter.
#[derive(Clone, Copy, Debug)]
pub struct EightRays {
    /// Where they start: x, y and z.
    pub origin: [Stored; 3],
    /// Where they go: x, y and z, of any length.
    pub direction: [Stored; 3],
    /// Crossings beyond these parameters do not count.
    pub end: Stored,
    /// The lanes that hold rays, a bit for each; what the others hold does not matter, but numbers unlike the rest cost time.
    pub lanes: u8,
}

/// What eight rays meet first.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct EightHits {
    /// The lanes that meet something. What the others hold does not matter.
    pub met: u8,
    pub t: Stored,
    pub bodies: [u32; LANES],
    pub surfaces: [u32; LANES],
    pub leaves: [u32; LANES],
    pub entering: u8,
    pub flipped: u8,
}

/// A point or a direction of one lane.
fn lane_of_three(v: &[Stored; 3], lane: usize) -> Vec3 {
    Vec3::new(v[0].0[lane], v[1].0[lane], v[2].0[lane])
}

impl EightRays {
    /// No rays.
    pub const NONE: Self = Self {
        origin: [Stored([0.0; LANES]); 3],
        direction: [Stored([1.0; LANES]); 3],
        end: Stored([0.0; LANES]),
        lanes: 0,
    };

    /// The ray of a lane.
    ///
    /// # Panics
    /// If there is no such lane.
    pub fn ray(&self, lane: usize) -> Ray {
        Ray { origin: lane_of_three(&self.origin, lane), direction: lane_of_three(&self.direction, lane) }
    }

    /// Sets the ray of a lane, which is followed up to `end`.
    ///
    /// # Panics
    /// If there is no such lane.
    pub fn put(&mut self, lane: usize, ray: &Ray, end: f64) {
        for axis in 0..3 {
            self.origin[axis].0[lane] = ray.origin[axis];
            self.direction[axis].0[lane] = ray.direction[axis];
        }
        self.end.0[lane] = end;
        self.lanes |= 1 << lane;
    }

    /// Puts copies of the last ray into the lanes behind it, so that they hold nothing unusual; they remain without rays.
    pub fn fill_up(&mut self) {
        let (lanes, count) = (self.lanes, LANES - self.lanes.leading_zeros() as usize);
        if (1..LANES).contains(&count) {
            let (last, end) = (self.ray(count - 1), self.end.0[count - 1]);
            for lane in count..LANES {
                self.put(lane, &last, end);
            }
            self.lanes = lanes;
        }
    }
}

impl EightHits {
    /// What the ray of a lane meets.
    pub fn hit(&self, lane: usize) -> TileHit {
        let is = |bits: u8| bits >> lane & 1 != 0;
        is(self.met).then(|| {
            let (surface, leaf) = (self.surfaces[lane], self.leaves[lane]);
            let (entering, flipped) = (is(self.entering), is(self.flipped));
            (self.bodies[lane] as usize, Hit { t: self.t.0[lane], leaf, surface, entering, flipped })
        })
    }

    /// Nothing is met.
    #[inline(always)]
    pub fn forget(&mut self) {
        (self.met, self.entering, self.flipped) = (0, 0, 0);
    }

    /// Takes over what some rays of a packet met, each in its lane.
    #[inline(always)]
    pub(super) fn take<I: Isa>(&mut self, catalog: &Catalog, rays: &EightRays, packet: &Packet, lanes: u8) {
        let mut left = packet.met & !packet.given_up & lanes;
        while left != 0 {
            // All lanes that met the same literal.
            let word = packet.words[left.trailing_zeros() as usize & (LANES - 1)];
            let same = left & !I::differing(&packet.words, word);
            left &= !same;
            let Word::Literal { index, negated } = Word::decode(word) else { continue };
            let literal = catalog.literal(index);
            if let Surface::Mesh(_) | Surface::Placed(_) = literal.surface {
                self.take_facets(catalog, rays, packet, word, same);
                continue;
            }
            let mask = Mask::<I>::from_bits(same);
            self.t = mask.select(F64s::load(&packet.t), F64s::load(&self.t)).stored();
            self.bodies = mask.select_words(packet.bodies, self.bodies);
            self.surfaces = mask.select_words([literal.stored + literal.surface_shift; LANES], self.surfaces);
            self.leaves = mask.select_words([literal.leaf; LANES], self.leaves);
            self.met |= same;
            self.entering = self.entering & !same | packet.entering & same;
            self.flipped = if negated { self.flipped | same } else { self.flipped & !same };
        }
    }

    /// Takes over what some rays met, all the same mesh: it has many surfaces.
    #[inline(never)]
    fn take_facets(&mut self, catalog: &Catalog, rays: &EightRays, packet: &Packet, word: u32, lanes: u8) {
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
            let (t, entering) = (packet.t.0[lane], packet.entering >> lane & 1 != 0);
            let known = hit_of_facet(catalog, word, packet.facets[lane], t, entering);
            let hit = known.unwrap_or_else(|| hit_of(catalog, word, &rays.ray(lane), t, entering));
            self.set(lane, Some((packet.bodies[lane] as usize, hit)));
        }
    }

    /// Sets what the ray of a lane meets.
    pub fn set(&mut self, lane: usize, hit: TileHit) {
        let set = |bits: &mut u8, v: bool| *bits = *bits & !(1 << lane) | u8::from(v) << lane;
        set(&mut self.met, hit.is_some());
        if let Some((body, Hit { t, leaf, surface, entering, flipped })) = hit {
            self.t.0[lane] = t;
            self.bodies[lane] = body as u32;
            (self.surfaces[lane], self.leaves[lane]) = (surface, leaf);
            set(&mut self.entering, entering);
            set(&mut self.flipped, flipped);
        }
    }
}
