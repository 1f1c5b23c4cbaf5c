//! One tree of rays after the other, from the root down: for those who want to look at every ray. What [`super::Wave`] makes
//! of a whole tile is held to this.

use super::light::Seen;
use super::optics::{Branch, Standing};
use super::ray_tree::{RayKind, Watch};
use super::whitted::{LightsWay, Lit, Met, Whitted};
use crate::geom::{Hit, Ray};
use crate::model::Rgb;
use crate::trace::{RayTo, Scratch};

impl Whitted<'_> {
    /// Light along a camera ray that meets `first`; `watch` sees every ray that is traced for it. One ray after another:
    /// for whole tiles see [`super::Wave`], which makes the same of them.
    pub(crate) fn camera_ray(
        &self,
        ray: &Ray,
        first: Option<(usize, Hit)>,
        scratch: &mut Scratch,
        watch: &mut impl Watch,
    ) -> Seen {
        let standing = self.camera_standing(ray.origin, scratch);
        watch.sets_out(RayKind::Camera, ray, Rgb::WHITE);
        let seen = Path { integrator: self, scratch, watch }.seen(ray, first, standing);
        watch.returns(seen.color);
        seen
    }

    /// What share of light comes through to the ray's origin from `t = reach`.
    fn unshadowed(&self, ray: &Ray, reach: f64, scratch: &mut Scratch, watch: &mut impl Watch) -> Rgb {
        if let Some((_, hit)) = self.tracer().first_hit_of(self.opaque_bodies(), ray, reach, scratch) {
            watch.meets(&hit, &self.tracer().surface_point(ray, &hit));
            return Rgb::BLACK;
        }
        let mut way = LightsWay::new(ray, reach);
        while let Some(RayTo { ray, end }) = way.rest {
            let hit = self.tracer().first_hit_of(self.other_bodies(), &ray, end, scratch);
            if let Some((hit, point)) = self.pass(&mut way, hit) {
                watch.meets(&hit, &point);
            }
        }
        way.share
    }
}

/// One tree of rays, from the root down.
struct Path<'a, 'b, W> {
    integrator: &'b Whitted<'a>,
    scratch: &'b mut Scratch,
    watch: &'b mut W,
}

impl<W: Watch> Path<'_, '_, W> {
    /// Light along a ray that meets `first`.
    fn seen(&mut self, ray: &Ray, first: Option<(usize, Hit)>, standing: Standing) -> Seen {
        let Some((body, hit)) = first else {
            return self.integrator.nothing(standing.direct);
        };
        let point = self.integrator.tracer().surface_point(ray, &hit);
        self.watch.meets(&hit, &point);
        let met = self.integrator.met(ray, &hit, &point);
        let mut seen = Seen { color: self.local(&met, standing.weight), alpha: 1.0 };
        let (refracted, reflected) = self.integrator.branches(ray, (body, hit), &met, &standing);
        if let Some(branch) = refracted {
            let behind = self.along(RayKind::Refracted, &branch, standing.of(&branch, true));
            seen.refract(behind, branch.factor, met.material.kt);
        }
        if let Some(branch) = reflected {
            let mirrored = self.along(RayKind::Reflected, &branch, standing.of(&branch, false));
            seen.reflect(mirrored, branch.factor);
        }
        seen
    }

    /// Light along a ray that goes on from a surface.
    fn along(&mut self, kind: RayKind, branch: &Branch, standing: Standing) -> Seen {
        self.watch.sets_out(kind, &branch.ray, branch.factor);
        let first = self.integrator.tracer().first_body_hit(&branch.ray, f64::INFINITY, self.scratch);
        let seen = self.seen(&branch.ray, first, standing);
        self.watch.returns(seen.color);
        seen
    }

    /// Ambient, diffuse and specular light at a point.
    fn local(&mut self, met: &Met, weight: f64) -> Rgb {
        let integrator = self.integrator;
        let mut sum = integrator.ambient(met);
        for (number, light) in integrator.lights().iter().enumerate() {
            let Some(Lit { shadow, reach, intensity, factor }) = integrator.lit(met, light, weight) else { continue };
            self.watch.sets_out(RayKind::Shadow { light: number }, &shadow, intensity * factor);
            let share = integrator.unshadowed(&shadow, reach, self.scratch, self.watch);
            self.watch.returns(share);
            sum += intensity * share * factor;
        }
        sum
    }
}
