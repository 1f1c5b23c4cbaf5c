//! What a light would bring to where eight rays end: what [`Whitted::lit`] does for one.

use super::light::EightSeen;
use super::meet::EightMet;
use super::whitted::{FAINT, LEAST_WEIGHT, Whitted};
use crate::model::{Light, Rgb};
use crate::trace::lanes::{F64s, Isa, Mask, Stored, Vector};
use crate::trace::{EightRays, Task};

/// By what a light that arrives is multiplied on its way to the viewer.
pub(super) type EightFactors = [Stored; 3];

/// Finds the rays from surfaces to a light, and what the light is multiplied by if it arrives.
pub(super) struct SeeLight<'a> {
    pub integrator: &'a Whitted<'a>,
    pub light: &'a Light,
    pub met: &'a [EightMet],
    /// In the lanes of surfaces that the light reaches if nothing is in its way.
    pub shadows: &'a mut [EightRays],
    pub factors: &'a mut [EightFactors],
}

impl Task for SeeLight<'_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { integrator, light, met, shadows, factors } = self;
        let (Light::Point { intensity, .. } | Light::Directional { intensity, .. }) = *light;
        let brightest = intensity.max_component();
        for ((met, shadow), factor) in met.iter().zip(shadows).zip(factors) {
            shadow.lanes = 0;
            if met.met == 0 {
                continue;
            }
            let above = Vector::<F64s<I>>::load(&met.above);
            let (to_light, reach) = match *light {
                Light::Point { position, .. } => (Vector::from_one(position) - above, 1.0),
                Light::Directional { direction, .. } => (Vector::from_one(-direction), f64::INFINITY),
            };
            let (unit, found) = to_light.normalized();
            let cosine = Vector::load(&met.normal).dot(unit);
            let facing = Mask::from_bits(met.met) & found & cosine.gt(F64s::zero());
            if !facing.any() {
                continue;
            }
            let [r, g, b] = weights(integrator, met, unit, cosine, facing);
            let most = r.max(g).max(b) * F64s::splat(brightest) * F64s::load(&met.weight);
            let lit = facing & most.ge(F64s::splat(LEAST_WEIGHT));
            shadow.lanes = lit.bits();
            (shadow.origin, shadow.direction) = (met.above, to_light.stored());
            shadow.end = F64s::<I>::splat(reach).stored();
            *factor = [r.stored(), g.stored(), b.stored()];
        }
    }
}

/// The weights of a light from the direction `unit`, diffuse and specular, where it faces the surface.
#[inline(always)]
fn weights<I: Isa>(
    integrator: &Whitted,
    met: &EightMet,
    unit: Vector<F64s<I>>,
    cosine: F64s<I>,
    facing: Mask<I>,
) -> [F64s<I>; 3] {
    let [r, g, b, kd, ks, shininess] = met.materials.pick::<I, 6>(&integrator.materials().coats);
    let normal = Vector::<F64s<I>>::load(&met.normal);
    let towards = -unit;
    let mirrored = towards - normal * (F64s::splat(2.0) * normal.dot(towards));
    let highlight = F64s::zero().max(Vector::load(&met.toward_viewer).dot(mirrored));
    let is_faint = (shininess * (F64s::splat(1.0) - highlight)).gt(F64s::splat(FAINT));
    let bright = facing & ks.gt(F64s::zero()) & !is_faint;
    let mut specular = ks * F64s::zero();
    if bright.any() {
        specular = ks * bright.select(highlight.power_of_fraction(shininess), F64s::zero());
    }
    let diffuse = kd * cosine;
    [r * diffuse + specular, g * diffuse + specular, b * diffuse + specular]
}

/// What share of a light arrives.
#[derive(Clone, Copy, Debug)]
pub(super) enum Arrives<'a> {
    /// All, but on those rays on which something is in the way.
    Unless(&'a [u8]),
    /// So much: red, green, blue.
    Share(&'a [[Stored; 3]]),
}

/// Adds a light where it arrives.
pub(super) struct AddLight<'a> {
    pub intensity: Rgb,
    /// The rays to the light.
    pub lit: &'a [u8],
    pub factors: &'a [EightFactors],
    pub arrives: Arrives<'a>,
    pub seen: &'a mut [EightSeen],
}

impl Task for AddLight<'_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { intensity: Rgb { r, g, b }, lit, factors, arrives, seen } = self;
        for (number, seen) in seen.iter_mut().enumerate() {
            let lit = Mask::<I>::from_bits(lit[number]);
            if !lit.any() {
                continue;
            }
            let share = match arrives {
                Arrives::Unless(blocked) => {
                    let share = Mask::<I>::from_bits(blocked[number]).select(F64s::zero(), F64s::splat(1.0));
                    Vector::new(share, share, share)
                }
                Arrives::Share(share) => Vector::load(&share[number]),
            };
            let factor = Vector::<F64s<I>>::load(&factors[number]);
            let color = Vector::<F64s<I>>::load(&seen.color);
            let sum = Vector::new(
                color.x + F64s::splat(r) * share.x * factor.x,
                color.y + F64s::splat(g) * share.y * factor.y,
                color.z + F64s::splat(b) * share.z * factor.z,
            );
            seen.color = Vector::select(lit, sum, color).stored();
        }
    }
}
