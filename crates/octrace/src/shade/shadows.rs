//! What stands between many surfaces and a light.
//!
//! Past opaque things one needs to know only whether there is anything. Where light may pass, its way is followed from one
//! transparent surface to the next.

use super::light::EightSeen;
use super::lit::{AddLight, Arrives, EightFactors, SeeLight};
use super::materials::EightMaterials;
use super::meet::{EightMet, offset};
use super::wave::Workshop;
use super::whitted::{LEAST_WEIGHT, MAX_SHADOW_CROSSINGS, Whitted};
use crate::model::Light;
use crate::trace::lanes::{F64s, Isa, Mask, Stored, Vector};
use crate::trace::{EightHits, EightPoints, EightRays, Task, points};

/// The memory of a worker for shadow rays.
#[derive(Debug, Default)]
pub(super) struct Shadows {
    /// The rays to a light: their lanes are those that have not got there.
    rays: Vec<EightRays>,
    /// The lanes with rays to the light.
    lit: Vec<u8>,
    factors: Vec<EightFactors>,
    /// The rays on which something is in the light's way.
    blocked: Vec<u8>,
    hits: Vec<EightHits>,
    /// What share of the light comes through, as far as one knows.
    shares: Vec<[Stored; 3]>,
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
        let count = met.len();
        self.rays.resize(count, EightRays::NONE);
        self.factors.resize(count, [Stored::default(); 3]);
        let (shadows, factors) = (&mut self.rays[..], &mut self.factors[..]);
        workshop.backend.run(SeeLight { integrator, light, met, shadows, factors });
        self.lit.clear();
        self.lit.extend(self.rays.iter().map(|eight| eight.lanes));
        workshop.counts.shadow += self.lit.iter().map(|lanes| u64::from(lanes.count_ones())).sum::<u64>();
        let Workshop { backend, tile, scratch, .. } = workshop;
        self.blocked.resize(count, 0);
        let (tracer, opaque) = (integrator.tracer(), integrator.opaque_bodies());
        tracer.eights_met(opaque, &self.rays, *backend, tile, scratch, &mut self.blocked);
        let is_filtered = integrator.materials().transparent;
        if is_filtered {
            self.follow(integrator, light, workshop);
        }
        let arrives = if is_filtered { Arrives::Share(&self.shares) } else { Arrives::Unless(&self.blocked) };
        let (Light::Point { intensity, .. } | Light::Directional { intensity, .. }) = *light;
        workshop.backend.run(AddLight { intensity, lit: &self.lit, factors: &self.factors, arrives, seen });
    }

    /// Follows rays past transparent things, but for those that are blocked.
    fn follow(&mut self, integrator: &Whitted, light: &Light, workshop: &mut Workshop) {
        let Workshop { backend, tile, scratch, .. } = workshop;
        let Self { rays, hits, shares, blocked, .. } = self;
        hits.resize(rays.len(), EightHits::default());
        shares.clear();
        shares.extend(blocked.iter().map(|blocked| {
            let share = std::array::from_fn(|lane| if blocked >> lane & 1 != 0 { 0.0 } else { 1.0 });
            [Stored(share); 3]
        }));
        for (rays, blocked) in rays.iter_mut().zip(blocked) {
            rays.lanes &= !*blocked;
        }
        let is_bounded = matches!(light, Light::Point { .. });
        let mut crossings = 0;
        while rays.iter().any(|eight| eight.lanes != 0) {
            let bodies = integrator.other_bodies();
            integrator.tracer().eight_hits(bodies, rays, *backend, tile, scratch, hits);
            crossings += 1;
            let is_last = crossings == MAX_SHADOW_CROSSINGS;
            backend.run(Pass { integrator, is_bounded, is_last, hits, rays, shares });
        }
    }
}

/// Lets light pass what rays to it meet first: what [`Whitted::pass`] does for one. Rays that got to the light, or do not
/// get there, are followed no more.
struct Pass<'a> {
    integrator: &'a Whitted<'a>,
    /// Whether the light is at the rays' ends, and not infinitely far away.
    is_bounded: bool,
    /// Whether light passes no more surfaces than this one.
    is_last: bool,
    hits: &'a [EightHits],
    rays: &'a mut [EightRays],
    shares: &'a mut [[Stored; 3]],
}

impl Task for Pass<'_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { integrator, is_bounded, is_last, hits, rays, shares } = self;
        for ((rays, hits), share) in rays.iter_mut().zip(hits).zip(shares) {
            if hits.met == 0 {
                rays.lanes = 0;
            }
            if rays.lanes == 0 {
                continue;
            }
            let met = Mask::<I>::from_bits(hits.met);
            let materials = EightMaterials::of(hits, integrator.materials(), integrator.tracer());
            let [r, g, b] = materials.pick::<I, 3>(&integrator.materials().transmissions);
            let before = Vector::<F64s<I>>::load(share);
            let after = Vector::new(before.x * r, before.y * g, before.z * b);
            let is_faint = after.x.max(after.y).max(after.z).lt(F64s::splat(LEAST_WEIGHT));
            let passes = met & !(is_faint | Mask::splat(is_last));
            let black = Vector::new(F64s::zero(), F64s::zero(), F64s::zero());
            let after = Vector::select(passes, after, black);
            *share = Vector::select(met, after, before).stored();
            rays.lanes = 0;
            if passes.any() {
                go_on::<I>(integrator, is_bounded, passes, hits, rays);
            }
        }
    }
}

/// On from the far side of the surface, towards the same light.
#[inline(always)]
fn go_on<I: Isa>(integrator: &Whitted, is_bounded: bool, passes: Mask<I>, hits: &EightHits, rays: &mut EightRays) {
    let EightPoints { position, normal, rounding } = points::<I>(integrator.tracer(), rays, hits);
    let (origin, direction) = (Vector::<F64s<I>>::load(&rays.origin), Vector::<F64s<I>>::load(&rays.direction));
    let against = normal.dot(direction).lt(F64s::zero());
    let along = Vector::select(against, -normal, normal);
    let t = Mask::from_bits(hits.met).select(F64s::load(&hits.t), F64s::zero());
    let next = position + along * offset::<I>(integrator, direction, t, position, rounding);
    rays.origin = Vector::select(passes, next, origin).stored();
    rays.lanes = passes.bits();
    if is_bounded {
        let end = origin + direction * F64s::load(&rays.end);
        let rest = end - next;
        let is_left = rest.max_abs().gt(F64s::zero());
        rays.direction = Vector::select(passes & is_left, rest, direction).stored();
        rays.lanes = (passes & is_left).bits();
    }
}
