//! Whitted's illumination model [Whitted 1980; Comba-Persiano, §2.3]:
//!
//! ```text
//! I = Ka Ia C + Kd C sum_j I_j (N.L_j) + Ks sum_j I_j (S.R_j)^n + Kr Is + Kt It
//! ```
//!
//! `Ia` is the ambient light, `I_j` what arrives of light `j` (nothing in the shadow, filtered through glass), `Is` comes
//! along the reflected ray and `It` along the refracted one; `C` is the body colour. Where refraction is impossible (total
//! internal reflection), its share goes to the reflection.

use super::light::{Lighting, Seen};
use super::materials::{Materials, ambient_of};
use super::optics::{Branch, Media, Standing, mirror, refract};
use crate::geom::{Hit, Ray, Vec3};
use crate::model::{Bodies, Light, Material, Rgb, Scene};
use crate::num::power_of_fraction;
use crate::trace::{RayTo, Scratch, SurfacePoint, Tracer};
use std::ops::Range;

/// The integrator.
#[derive(Debug)]
pub(crate) struct Whitted<'a> {
    tracer: &'a Tracer,
    lighting: Lighting,
    materials: Materials,
    /// Index of refraction inside each body of the tracer.
    body_ior: Vec<f64>,
    /// The first so many bodies let no light pass.
    opaque: usize,
    max_bounces: u32,
    /// Of everything bounded.
    size: f64,
}

/// Rays that contribute less than this are not traced, those to lights too: less than half the darkest step of an 8-bit sRGB film (1 / 255 / 12.92).
pub(super) const LEAST_WEIGHT: f64 = 1.0 / 8192.0;

/// New rays start this far off their surface, relative to what rounding may put it off there ([`SurfacePoint::rounding`], in
/// units of [`f64::EPSILON`]): 2^12 times as far. So tiny things cast shadows beside huge ones, and far from the origin.
pub(super) const OFFSET: f64 = 1.0 / (1_u64 << 40) as f64;

/// And at most this far, relative to the scene's size, coordinates and distances: some 2^20 roundings. That is where new rays
/// start where first order says nothing, at apexes and where maps squash.
pub(super) const MOST_OFFSET: f64 = 1.0 / (1_u64 << 32) as f64;

/// A shadow ray may pass this many transparent surfaces.
pub(super) const MAX_SHADOW_CROSSINGS: u32 = 64;

/// Highlights that are fainter than `exp` of minus this, less than a millionth, are left out: nobody sees them.
pub(super) const FAINT: f64 = 14.0;

/// A surface that a ray meets, ready to be lit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met<'a> {
    pub position: Vec3,
    pub material: &'a Material,
    pub toward_viewer: Vec3,
    /// Towards the side that is seen.
    pub normal: Vec3,
    /// Where new rays start on that side, and how far off the surface that is.
    pub above: Vec3,
    pub offset: f64,
}

/// What a light would bring to a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lit {
    /// The ray to the light, which is at `reach`.
    pub shadow: Ray,
    pub reach: f64,
    pub intensity: Rgb,
    /// By what arriving light is multiplied on its way to the viewer.
    pub factor: Rgb,
}

/// A surface's way to a light, past transparent things.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightsWay {
    /// What share of the light comes through, as far as one knows.
    pub share: Rgb,
    /// What has not been looked at.
    pub rest: Option<RayTo>,
    crossings: u32,
}

impl LightsWay {
    /// To the light at `t = reach`.
    pub fn new(ray: &Ray, reach: f64) -> Self {
        Self { share: Rgb::WHITE, rest: Some(RayTo { ray: *ray, end: reach }), crossings: 0 }
    }
}

impl<'a> Whitted<'a> {
    /// Light for the scene as the tracer knows it. `bodies` are those of the tracer.
    pub fn new(scene: &'a Scene, tracer: &'a Tracer, lighting: Lighting, bodies: &Bodies, max_bounces: u32) -> Self {
        let size = tracer.bounds().size().max_abs();
        let materials = Materials::new(scene, lighting.ambient);
        let opaque = match bodies.opaque.len() == tracer.bodies() {
            true => bodies.opaque.iter().take_while(|opaque| **opaque).count(),
            // All of the scene is one body.
            false => 0,
        };
        Self { tracer, lighting, materials, body_ior: bodies.ior.clone(), opaque, max_bounces, size }
    }

    pub(super) fn tracer(&self) -> &'a Tracer {
        self.tracer
    }

    /// The bodies that let no light pass. Whatever is in light's way elsewhere, those that are on the straight way to the
    /// light keep it off.
    pub(super) fn opaque_bodies(&self) -> Range<usize> {
        0..self.opaque
    }

    /// All others.
    pub(super) fn other_bodies(&self) -> Range<usize> {
        self.opaque..self.tracer.bodies()
    }

    pub(super) fn lights(&self) -> &[Light] {
        &self.lighting.lights
    }

    pub(super) fn materials(&self) -> &Materials {
        &self.materials
    }

    pub(super) fn max_bounces(&self) -> u32 {
        self.max_bounces
    }

    pub(super) fn size(&self) -> f64 {
        self.size
    }

    /// How a camera ray sets out.
    pub(super) fn camera_standing(&self, origin: Vec3, scratch: &mut Scratch) -> Standing {
        let mut media = Media::default();
        if self.tracer.bodies() > 1 && (self.tracer.is_unbounded() || self.tracer.bounds().contains(origin)) {
            for body in 0..self.tracer.bodies() {
                if self.tracer.body_contains(body, origin, scratch) {
                    media = media.enter(body);
                }
            }
        }
        Standing { media, bounce: 0, weight: 1.0, direct: true }
    }

    fn ior(&self, media: &Media) -> f64 {
        media.inside().last().map_or(1.0, |&body| self.body_ior.get(usize::from(body)).copied().unwrap_or(1.0))
    }

    /// What is seen along a ray that meets nothing.
    pub(super) fn nothing(&self, direct: bool) -> Seen {
        match direct && self.lighting.transparent {
            true => Seen { color: Rgb::BLACK, alpha: 0.0 },
            false => Seen { color: self.lighting.background, alpha: 1.0 },
        }
    }

    /// What a ray meets at that point.
    pub(super) fn met(&self, ray: &Ray, hit: &Hit, point: &SurfacePoint) -> Met<'_> {
        let position = point.position;
        let material = self.materials.of(point.part);
        let toward_viewer = -ray.direction.normalized().unwrap_or(Vec3::Z);
        let normal = if point.normal.dot(toward_viewer) < 0.0 { -point.normal } else { point.normal };
        let offset = self.offset(ray, hit, point);
        Met { position, material, toward_viewer, normal, above: position + normal * offset, offset }
    }

    /// The ambient light of a surface.
    pub(super) fn ambient(&self, met: &Met) -> Rgb {
        ambient_of(met.material, self.lighting.ambient)
    }

    /// What a light brings to a surface if nothing is in its way: diffuse and specular. The surface makes so much of the pixel
    /// at most: `weight`.
    pub(super) fn lit(&self, met: &Met, light: &Light, weight: f64) -> Option<Lit> {
        let Met { material, toward_viewer, normal, above, .. } = met;
        let (to_light, reach, intensity) = match *light {
            Light::Point { position, intensity } => (position - *above, 1.0, intensity),
            Light::Directional { direction, intensity } => (-direction, f64::INFINITY, intensity),
        };
        let unit = to_light.normalized()?;
        let cosine = normal.dot(unit);
        if cosine <= 0.0 {
            return None;
        }
        let highlight = toward_viewer.dot(mirror(-unit, *normal)).max(0.0);
        let specular = material.ks * power(highlight, material);
        let factor = material.color * (material.kd * cosine) + Rgb::gray(specular);
        let shadow = Ray { origin: *above, direction: to_light };
        let most = factor.max_component() * intensity.max_component() * weight;
        (most >= LEAST_WEIGHT).then_some(Lit { shadow, reach, intensity, factor })
    }

    /// The refracted and the reflected ray, where there are such.
    pub(super) fn branches(
        &self,
        ray: &Ray,
        (body, hit): (usize, Hit),
        met: &Met,
        standing: &Standing,
    ) -> (Option<Branch>, Option<Branch>) {
        let Met { position, material, toward_viewer, normal, above, offset } = met;
        let Standing { media, bounce, weight, .. } = *standing;
        let (mut kr, mut refracted) = (material.kr, None);
        if material.is_transparent() {
            let (beyond, ratio) = self.beyond(&media, (body, hit.entering), material);
            match refract(ray.direction, *normal, ratio) {
                Some(direction) => {
                    let ray = Ray { origin: *position + *normal * -offset, direction };
                    let factor = material.transmission();
                    let weight = weight * factor.max_component();
                    refracted = Some(Branch { ray, media: beyond, factor, weight });
                }
                None => kr += material.kt,
            }
        }
        let mirrored = || Ray { origin: *above, direction: mirror(-*toward_viewer, *normal) };
        let reflected =
            (kr > 0.0).then(|| Branch { ray: mirrored(), media, factor: Rgb::gray(kr), weight: weight * kr });
        let counts = |branch: &Branch| bounce < self.max_bounces && branch.weight >= LEAST_WEIGHT;
        (refracted.filter(counts), reflected.filter(counts))
    }

    /// What a ray is in behind the surface of a body, of a transparent material; and the index before it over the one behind.
    pub(super) fn beyond(&self, media: &Media, (body, entering): (usize, bool), material: &Material) -> (Media, f64) {
        let beyond = if entering { media.enter(body) } else { media.leave(body) };
        // A transparent leaf of an opaque body refracts by its own index.
        let (n1, n2) = match (self.ior(media), self.ior(&beyond)) {
            (1.0, 1.0) if entering => (1.0, material.ior),
            (1.0, 1.0) => (material.ior, 1.0),
            pair => pair,
        };
        (beyond, n1 / n2)
    }

    /// Follows a light's way past what the rest of it meets first; says what that is.
    pub(super) fn pass(&self, way: &mut LightsWay, first: Option<(usize, Hit)>) -> Option<(Hit, SurfacePoint)> {
        let RayTo { mut ray, end: mut reach } = way.rest.take()?;
        let (_, hit) = first?;
        let point = self.tracer.surface_point(&ray, &hit);
        way.share = way.share * self.materials.of(point.part).transmission();
        way.crossings += 1;
        if way.share.max_component() < LEAST_WEIGHT || way.crossings == MAX_SHADOW_CROSSINGS {
            way.share = Rgb::BLACK;
            return Some((hit, point));
        }
        // On from the far side of the surface, towards the same light.
        let along = if point.normal.dot(ray.direction) < 0.0 { -point.normal } else { point.normal };
        let end = ray.at(reach);
        ray.origin = point.position + along * self.offset(&ray, &hit, &point);
        if reach.is_finite() {
            ray.direction = end - ray.origin;
            reach = 1.0;
        }
        way.rest = (ray.direction != Vec3::ZERO).then_some(RayTo { ray, end: reach });
        Some((hit, point))
    }

    /// How far a ray that starts at a hit must start off the surface, so as not to meet it again.
    fn offset(&self, ray: &Ray, hit: &Hit, point: &SurfacePoint) -> f64 {
        let travelled = hit.t * ray.direction.max_abs();
        let most = MOST_OFFSET * self.size.max(point.position.max_abs()).max(travelled);
        let offset = OFFSET * point.rounding;
        if offset > 0.0 && offset < most { offset } else { most }
    }
}

/// The highlight, to the power of the material's shininess.
fn power(highlight: f64, material: &Material) -> f64 {
    // The logarithm of x is at most x - 1.
    if material.ks <= 0.0 || material.shininess * (1.0 - highlight) > FAINT {
        return 0.0;
    }
    power_of_fraction(highlight, material.shininess)
}
