//! Where eight rays meet surfaces, made ready to be lit: what [`Whitted::met`] does for one.

use super::light::EightSeen;
use super::materials::EightMaterials;
use super::optics::Standing;
use super::whitted::{MOST_OFFSET, OFFSET, Whitted};
use crate::geom::Vec3;
use crate::trace::lanes::{F64s, Isa, LANES, Mask, Stored, Vector};
use crate::trace::{EightHits, EightPoints, EightRays, Task, points};

/// What eight rays meet, ready to be lit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EightMet {
    /// The lanes that meet something. What the others hold are numbers of no extreme size.
    pub met: u8,
    pub toward_viewer: [Stored; 3],
    /// Towards the side that is seen.
    pub normal: [Stored; 3],
    /// Where new rays start on that side, and how far off the surface that is.
    pub above: [Stored; 3],
    pub offset: Stored,
    /// How much of the pixel the rays make at most.
    pub weight: Stored,
    pub materials: EightMaterials,
}

/// Finds out what many rays meet, and what is seen of it without any light's help: what shines by ambient light, and the
/// background.
pub(super) struct Meet<'a> {
    pub integrator: &'a Whitted<'a>,
    pub rays: &'a [EightRays],
    pub hits: &'a [EightHits],
    /// Which rays come from the camera, if through glass.
    pub direct: &'a [u8],
    /// Of every ray, if any light goes on.
    pub standings: &'a [Standing],
    pub met: &'a mut [EightMet],
    pub seen: &'a mut [EightSeen],
}

impl Task for Meet<'_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { integrator, rays, hits, direct, standings, met, seen } = self;
        let (of_direct, of_others) = (integrator.nothing(true), integrator.nothing(false));
        for number in 0..rays.len() {
            let (rays, hits, met, seen) = (&rays[number], &hits[number], &mut met[number], &mut seen[number]);
            let is_direct = Mask::<I>::from_bits(direct[number]);
            let nothing = [
                is_direct.select(F64s::splat(of_direct.color.r), F64s::splat(of_others.color.r)),
                is_direct.select(F64s::splat(of_direct.color.g), F64s::splat(of_others.color.g)),
                is_direct.select(F64s::splat(of_direct.color.b), F64s::splat(of_others.color.b)),
            ];
            let alpha = is_direct.select(F64s::splat(of_direct.alpha), F64s::splat(of_others.alpha));
            met.met = hits.met;
            if hits.met == 0 {
                let [r, g, b] = nothing;
                *seen = EightSeen { color: [r.stored(), g.stored(), b.stored()], alpha: alpha.stored() };
                continue;
            }
            met.materials = EightMaterials::of(hits, integrator.materials(), integrator.tracer());
            surface::<I>(integrator, rays, hits, met);
            met.weight = weights(standings.get(number * LANES..));
            let there = Mask::<I>::from_bits(hits.met);
            let ambient = met.materials.pick::<I, 3>(&integrator.materials().ambients);
            for axis in 0..3 {
                seen.color[axis] = there.select(ambient[axis], nothing[axis]).stored();
            }
            seen.alpha = there.select(F64s::splat(1.0), alpha).stored();
        }
    }
}

/// How much of the pixel eight rays make at most, if they are not the camera's.
#[inline(always)]
fn weights(standings: Option<&[Standing]>) -> Stored {
    let mut weights = Stored([1.0; LANES]);
    for (weight, standing) in weights.0.iter_mut().zip(standings.unwrap_or_default()) {
        *weight = standing.weight;
    }
    weights
}

/// As [`Whitted::met`], but for the material.
#[inline(always)]
fn surface<I: Isa>(integrator: &Whitted, rays: &EightRays, hits: &EightHits, met: &mut EightMet) {
    let EightPoints { position, normal, rounding } = points::<I>(integrator.tracer(), rays, hits);
    let direction = Vector::<F64s<I>>::load(&rays.direction);
    let (unit, found) = direction.normalized();
    let toward_viewer = -Vector::select(found, unit, Vector::from_one(Vec3::Z));
    let from_behind = normal.dot(toward_viewer).lt(F64s::zero());
    let normal = Vector::select(from_behind, -normal, normal);
    let t = Mask::from_bits(hits.met).select(F64s::load(&hits.t), F64s::zero());
    let offset = offset::<I>(integrator, direction, t, position, rounding);
    met.toward_viewer = toward_viewer.stored();
    met.normal = normal.stored();
    met.above = (position + normal * offset).stored();
    met.offset = offset.stored();
}

/// As [`Whitted::offset`].
#[inline(always)]
pub(super) fn offset<I: Isa>(
    integrator: &Whitted,
    direction: Vector<F64s<I>>,
    t: F64s<I>,
    position: Vector<F64s<I>>,
    rounding: F64s<I>,
) -> F64s<I> {
    let travelled = t * direction.max_abs();
    let most = F64s::splat(MOST_OFFSET) * F64s::splat(integrator.size()).max(position.max_abs()).max(travelled);
    let offset = F64s::splat(OFFSET) * rounding;
    (offset.gt(F64s::zero()) & offset.lt(most)).select(offset, most)
}
