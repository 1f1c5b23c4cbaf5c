//! The rays that go on from where eight rays end: what [`Whitted::branches`] finds for one.

use super::meet::EightMet;
use super::optics::{Branch, Media, Standing};
use super::whitted::{LEAST_WEIGHT, Whitted};
use crate::model::Rgb;
use crate::trace::lanes::{F64s, Isa, LANES, Mask, Stored, Vector};
use crate::trace::{EightHits, EightRays, Task};

/// The reflected and the refracted rays, where there are such.
#[derive(Clone, Copy, Debug)]
pub(super) struct EightBranches {
    /// The number of the eight from which they go on.
    pub from: usize,
    pub reflected: EightRays,
    pub refracted: EightRays,
    /// By what the light along them is multiplied.
    kr: Stored,
    transmission: [Stored; 3],
    /// How much of the pixel they make at most.
    reflected_weight: Stored,
    refracted_weight: Stored,
    /// What is refracted gets into these.
    beyond: [Media; LANES],
}

impl EightBranches {
    /// A reflected ray; it stays in `media`.
    pub fn reflected(&self, lane: usize, media: Media) -> Branch {
        let (factor, weight) = (Rgb::gray(self.kr.0[lane]), self.reflected_weight.0[lane]);
        Branch { ray: self.reflected.ray(lane), media, factor, weight }
    }

    /// A refracted ray.
    pub fn refracted(&self, lane: usize) -> Branch {
        let [r, g, b] = self.transmission.map(|v| v.0[lane]);
        let (factor, weight) = (Rgb::new(r, g, b), self.refracted_weight.0[lane]);
        Branch { ray: self.refracted.ray(lane), media: self.beyond[lane], factor, weight }
    }
}

/// Finds the rays that go on from where many rays end.
pub(super) struct GoOn<'a> {
    pub integrator: &'a Whitted<'a>,
    pub rays: &'a [EightRays],
    pub hits: &'a [EightHits],
    pub met: &'a [EightMet],
    /// Of every ray.
    pub standings: &'a [Standing],
    pub branches: &'a mut Vec<EightBranches>,
}

impl Task for GoOn<'_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { integrator, rays, hits, met, standings, branches } = self;
        for (from, met) in met.iter().enumerate() {
            if met.met == 0 {
                continue;
            }
            let standings = &standings[from * LANES..][..LANES];
            let [kr, kt] = met.materials.pick::<I, 2>(&integrator.materials().branchings);
            let there = Mask::from_bits(met.met);
            let transparent = there & kt.gt(F64s::zero());
            if !(there & kr.gt(F64s::zero()) | transparent).any() {
                continue;
            }
            let mut found = EightBranches {
                from,
                reflected: EightRays::NONE,
                refracted: EightRays::NONE,
                kr: Stored::default(),
                transmission: [Stored::default(); 3],
                reflected_weight: Stored::default(),
                refracted_weight: Stored::default(),
                beyond: [Media::default(); LANES],
            };
            let weight = F64s::<I>::load(&met.weight);
            let mut kr = kr;
            if transparent.any() {
                let ratio = media(integrator, &hits[from], met, transparent.bits(), standings, &mut found.beyond);
                let passes = refracted::<I>(&rays[from], &hits[from], met, transparent, &ratio, &mut found.refracted);
                kr = (transparent & !passes).select(kr + kt, kr);
                let [r, g, b] = met.materials.pick::<I, 3>(&integrator.materials().transmissions);
                let share = weight * r.max(g).max(b);
                found.refracted.lanes = (passes & share.ge(F64s::splat(LEAST_WEIGHT))).bits();
                found.refracted_weight = share.stored();
                found.transmission = [r.stored(), g.stored(), b.stored()];
            }
            let share = weight * kr;
            let counts = there & kr.gt(F64s::zero()) & share.ge(F64s::splat(LEAST_WEIGHT));
            if counts.any() {
                let normal = Vector::<F64s<I>>::load(&met.normal);
                let towards = -Vector::load(&met.toward_viewer);
                let mirrored = towards - normal * (F64s::splat(2.0) * normal.dot(towards));
                (found.reflected.origin, found.reflected.direction) = (met.above, mirrored.stored());
                found.reflected.lanes = counts.bits();
                found.reflected_weight = share.stored();
                found.kr = kr.stored();
            }
            if found.reflected.lanes | found.refracted.lanes != 0 {
                branches.push(found);
            }
        }
    }
}

/// For rays that meet something transparent: the index before it over the one behind, and what they are in behind it.
fn media(
    integrator: &Whitted,
    hits: &EightHits,
    met: &EightMet,
    lanes: u8,
    standings: &[Standing],
    beyond: &mut [Media; LANES],
) -> Stored {
    let mut ratio = Stored([1.0; LANES]);
    for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
        let material = integrator.materials().numbered(met.materials.numbers[lane]);
        let Some((body, hit)) = hits.hit(lane) else { continue };
        (beyond[lane], ratio.0[lane]) = integrator.beyond(&standings[lane].media, (body, hit.entering), material);
    }
    ratio
}

/// Sets the refracted rays; says which are not reflected totally instead. See [`refract`](super::optics::refract).
#[inline(always)]
fn refracted<I: Isa>(
    rays: &EightRays,
    hits: &EightHits,
    met: &EightMet,
    transparent: Mask<I>,
    ratio: &Stored,
    refracted: &mut EightRays,
) -> Mask<I> {
    let (origin, along) = (Vector::<F64s<I>>::load(&rays.origin), Vector::<F64s<I>>::load(&rays.direction));
    let normal = Vector::<F64s<I>>::load(&met.normal);
    let (ratio, one) = (F64s::load(ratio), F64s::splat(1.0));
    let (unit, found) = along.normalized();
    let cosine = -normal.dot(unit);
    let squared = one - ratio * ratio * (one - cosine * cosine);
    let passes = transparent & found & !squared.lt(F64s::zero());
    let bent = unit * ratio + normal * (ratio * cosine - squared.sqrt());
    let (bent, found) = Vector::select(passes, bent, unit).normalized();
    let t = Mask::from_bits(hits.met).select(F64s::load(&hits.t), F64s::zero());
    let position = origin + along * t;
    refracted.origin = (position + normal * -F64s::load(&met.offset)).stored();
    refracted.direction = bent.stored();
    passes & found
}
