//! What stands between many surfaces and a light.
//!
//! Past opaque things one needs to know only whether there is anything. Where light may pass, the first thing in its way is
//! looked at: if light passes that, its way is followed to the end.

use super::light::EightSeen;
use super::lit::{AddLight, EightFactors, SeeLight};
use super::meet::EightMet;
use super::wave::Workshop;
use super::whitted::{LightsWay, Whitted};
use crate::model::{Light, Rgb};
use crate::trace::lanes::{LANES, Stored};
use crate::trace::{EightHits, EightRays, RayTo, TileHit};

/// The memory of a worker for shadow rays.
#[derive(Debug, Default)]
pub(super) struct Shadows {
    rays: Vec<EightRays>,
    factors: Vec<EightFactors>,
    /// The rays on which something is in the light's way.
    blocked: Vec<u8>,
    hits: Vec<EightHits>,
    /// The ways of light past transparent things, and the ray and the lane to which each leads.
    ways: Vec<(usize, usize, LightsWay)>,
    rest: Vec<RayTo>,
    rest_hits: Vec<TileHit>,
}

impl Shadows {
    /// Adds a light where it arrives.
    pub fn add_light(
        &mut self,
        integrator: &Whitted,
        light: &Light,
        met: &[EightMet],
        seen: &mut [EightSeen],
        workshop: &mut Workshop,
    ) {
        if self.rays.len() < met.len() {
            self.rays.resize(met.len(), EightRays::NONE);
            self.factors.resize(met.len(), [Stored::default(); 3]);
            self.blocked.resize(met.len(), 0);
            self.hits.resize(met.len(), EightHits::default());
        }
        let count = met.len();
        let (shadows, factors) = (&mut self.rays[..count], &mut self.factors[..count]);
        workshop.backend.run(SeeLight { integrator, light, met, shadows, factors });
        workshop.counts.shadow += shadows.iter().map(|eight| u64::from(eight.lanes.count_ones())).sum::<u64>();
        match integrator.filters() {
            true => self.trace_filtered(integrator, count, workshop),
            false => {
                let Workshop { backend, tile, scratch, .. } = workshop;
                let blocked = &mut self.blocked[..count];
                integrator.tracer().eights_met(&self.rays[..count], *backend, tile, scratch, blocked);
            }
        }
        let (Light::Point { intensity, .. } | Light::Directional { intensity, .. }) = *light;
        let (shadows, factors, blocked) = (&self.rays[..count], &self.factors[..count], &self.blocked[..count]);
        workshop.backend.run(AddLight { intensity, shadows, factors, blocked, seen });
        for (number, lane, LightsWay { share, .. }) in self.ways.drain(..) {
            let [r, g, b] = self.factors[number].map(|factor| factor.0[lane]);
            let mut sum = seen[number].lane(lane);
            sum.color += intensity * share * Rgb::new(r, g, b);
            seen[number].put(lane, sum);
        }
    }

    /// Traces shadow rays, and follows those that transparent things let pass.
    fn trace_filtered(&mut self, integrator: &Whitted, count: usize, workshop: &mut Workshop) {
        let Self { rays, blocked, hits, ways, rest, rest_hits, .. } = self;
        let Workshop { backend, tile, scratch, .. } = workshop;
        let (rays, hits) = (&rays[..count], &mut hits[..count]);
        integrator.tracer().eight_hits(rays, *backend, tile, scratch, hits);
        for (number, (rays, hits)) in rays.iter().zip(&*hits).enumerate() {
            blocked[number] = hits.met;
            for lane in (0..LANES).filter(|lane| hits.met >> lane & 1 != 0) {
                if integrator.material_of(hits.leaves[lane]).is_transparent() {
                    let mut way = LightsWay::new(&rays.ray(lane), rays.end.0[lane]);
                    integrator.pass(&mut way, hits.hit(lane));
                    ways.push((number, lane, way));
                }
            }
        }
        loop {
            rest.clear();
            rest.extend(ways.iter().filter_map(|(_, _, way)| way.rest));
            if rest.is_empty() {
                break;
            }
            rest_hits.clear();
            rest_hits.resize(rest.len(), None);
            integrator.tracer().first_hits_into(rest, *backend, tile, scratch, rest_hits);
            for ((_, _, way), hit) in ways.iter_mut().filter(|(_, _, way)| way.rest.is_some()).zip(&*rest_hits) {
                integrator.pass(way, *hit);
            }
        }
    }
}
