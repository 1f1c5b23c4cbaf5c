//! Whitted's illumination model [Whitted 1980; Comba-Persiano, §2.3]:
//!
//! ```text
//! I = Ka Ia C + Kd C sum_j I_j (N.L_j) + Ks sum_j I_j (S.R_j)^n + Kr Is + Kt It
//! ```
//!
//! `Ia` is the ambient light, `I_j` what arrives of light `j` (nothing in the shadow, filtered through glass), `Is` comes
//! along the reflected ray and `It` along the refracted one; `C` is the body colour. Where refraction is impossible (total
//! internal reflection), its share goes to the reflection.

use super::ray_tree::{RayKind, Watch};
use crate::geom::{Hit, Ray, Vec3};
use crate::model::{Light, Material, PartId, Rgb, Scene};
use crate::num::power_of_fraction;
use crate::trace::{RayTo, Scratch, SurfacePoint, Tracer};
use std::ops::AddAssign;

/// What lights the scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lighting {
    /// The sources.
    pub lights: Vec<Light>,
    /// Ambient light `Ia`.
    pub ambient: Rgb,
    /// What a ray sees that meets nothing.
    pub background: Rgb,
    /// Whether such camera rays leave the film transparent instead.
    pub transparent: bool,
}

/// How many rays were traced, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// From the camera.
    pub camera: u64,
    /// Towards lights.
    pub shadow: u64,
    /// Reflected.
    pub reflected: u64,
    /// Refracted.
    pub refracted: u64,
}

impl AddAssign for RayCounts {
    fn add_assign(&mut self, o: Self) {
        let Self { camera, shadow, reflected, refracted } = o;
        self.camera += camera;
        self.shadow += shadow;
        self.reflected += reflected;
        self.refracted += refracted;
    }
}

/// The integrator.
#[derive(Debug)]
pub(crate) struct Whitted<'a> {
    scene: &'a Scene,
    tracer: &'a Tracer,
    lighting: Lighting,
    /// Index of refraction inside each body of the tracer.
    body_ior: Vec<f64>,
    max_bounces: u32,
    /// How far new rays start off the surface, per unit of the numbers involved.
    size: f64,
    /// What parts without a material are made of.
    default_material: Material,
}

/// Rays that contribute less than this are not traced: less than half the darkest step of an 8-bit sRGB film (1 / 255 / 12.92).
const LEAST_WEIGHT: f64 = 1.0 / 8192.0;

/// New rays start this far off their surface, relative to coordinates and distances: some 2^20 roundings, far more than a
/// hit may be off, far less than one sees.
const OFFSET: f64 = 1.0 / (1_u64 << 32) as f64;

/// A shadow ray may pass this many transparent surfaces.
const MAX_SHADOW_CROSSINGS: u32 = 64;

/// Light along a ray, and how much of the film it covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Seen {
    pub color: Rgb,
    pub alpha: f64,
}

/// The transparent bodies that a ray is inside, in the order in which it went in.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Media {
    bodies: [u16; Self::MAX],
    count: usize,
}

impl Media {
    /// Nested deeper, bodies no longer bend light.
    const MAX: usize = 8;

    fn inside(&self) -> &[u16] {
        &self.bodies[..self.count]
    }

    fn enter(mut self, body: usize) -> Self {
        if self.count < Self::MAX {
            self.bodies[self.count] = body as u16;
            self.count += 1;
        }
        self
    }

    fn leave(mut self, body: usize) -> Self {
        if let Some(at) = self.inside().iter().rposition(|&b| usize::from(b) == body) {
            self.bodies.copy_within(at + 1..self.count, at);
            self.count -= 1;
        }
        self
    }
}

/// A surface that a ray meets, ready to be lit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met<'a> {
    pub point: SurfacePoint,
    pub material: &'a Material,
    toward_viewer: Vec3,
    /// Towards the side that is seen.
    normal: Vec3,
    /// Where new rays start on that side, and how far off the surface that is.
    above: Vec3,
    offset: f64,
}

impl Met<'_> {
    /// Whether light comes along other rays too, from a mirror image or from behind.
    pub fn goes_on(&self) -> bool {
        self.material.kr > 0.0 || self.material.is_transparent()
    }
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

/// A ray that goes on from a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Branch {
    pub ray: Ray,
    pub media: Media,
    /// By what the light along it is multiplied.
    pub factor: Rgb,
    /// How much of the pixel it makes at most.
    pub weight: f64,
}

/// Where a ray stands in its tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    pub media: Media,
    pub bounce: u32,
    /// How much of the pixel it makes at most.
    pub weight: f64,
    /// Whether it comes from the camera, if through glass.
    pub direct: bool,
}

impl Standing {
    /// The standing of a ray that goes on from the end of this one.
    pub fn of(self, branch: &Branch, refracted: bool) -> Self {
        let Branch { media, weight, .. } = *branch;
        Self { media, bounce: self.bounce + 1, weight, direct: self.direct && refracted }
    }
}

impl<'a> Whitted<'a> {
    /// Light for the scene as the tracer knows it. `body_ior` is the index of refraction inside each body of the tracer,
    /// as [`Scene::bodies`] says.
    pub fn new(scene: &'a Scene, tracer: &'a Tracer, lighting: Lighting, body_ior: Vec<f64>, max_bounces: u32) -> Self {
        let size = tracer.bounds().size().max_abs();
        let default_material = scene.material(None);
        Self { scene, tracer, lighting, body_ior, max_bounces, size, default_material }
    }

    /// Light along a camera ray that meets `first`; `watch` sees every ray that is traced for it. One ray after another:
    /// for whole tiles see [`super::Wave`], which makes the same of them.
    pub(crate) fn camera_ray(
        &self,
        ray: &Ray,
        first: Option<(usize, Hit)>,
        scratch: &mut Scratch,
        watch: &mut impl Watch,
    ) -> Seen {
        let standing = self.camera_standing(ray, scratch);
        watch.sets_out(RayKind::Camera, ray, Rgb::WHITE);
        let seen = Path { integrator: self, scratch, watch }.seen(ray, first, standing);
        watch.returns(seen.color);
        seen
    }

    pub(super) fn tracer(&self) -> &'a Tracer {
        self.tracer
    }

    pub(super) fn lights(&self) -> &[Light] {
        &self.lighting.lights
    }

    /// How a camera ray sets out.
    pub(super) fn camera_standing(&self, ray: &Ray, scratch: &mut Scratch) -> Standing {
        let mut media = Media::default();
        if self.tracer.bodies() > 1 && (self.tracer.is_unbounded() || self.tracer.bounds().contains(ray.origin)) {
            for body in 0..self.tracer.bodies() {
                if self.tracer.body_contains(body, ray.origin, scratch) {
                    media = media.enter(body);
                }
            }
        }
        Standing { media, bounce: 0, weight: 1.0, direct: true }
    }

    /// As [`Scene::material`].
    fn material(&self, part: Option<PartId>) -> &Material {
        part.and_then(|PartId(index)| self.scene.parts.get(index as usize))
            .map_or(&self.default_material, |part| &part.material)
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

    /// What a ray meets.
    pub(super) fn met(&self, ray: &Ray, hit: &Hit) -> Met<'_> {
        let point = self.tracer.surface_point(ray, hit);
        let material = self.material(point.part);
        let toward_viewer = -ray.direction.normalized().unwrap_or(Vec3::Z);
        let normal = if point.normal.dot(toward_viewer) < 0.0 { -point.normal } else { point.normal };
        let offset = self.offset(ray, hit, &point);
        Met { point, material, toward_viewer, normal, above: point.position + normal * offset, offset }
    }

    /// The ambient light of a surface.
    pub(super) fn ambient(&self, met: &Met) -> Rgb {
        met.material.color * self.lighting.ambient * met.material.ka
    }

    /// What a light brings to a surface if nothing is in its way: diffuse and specular.
    pub(super) fn lit(&self, met: &Met, light: &Light) -> Option<Lit> {
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
        (factor.max_component() > 0.0).then_some(Lit { shadow, reach, intensity, factor })
    }

    /// The refracted and the reflected ray, where there are such.
    pub(super) fn branches(
        &self,
        ray: &Ray,
        (body, hit): (usize, Hit),
        met: &Met,
        standing: &Standing,
    ) -> (Option<Branch>, Option<Branch>) {
        let Met { point, material, toward_viewer, normal, above, offset } = met;
        let Standing { media, bounce, weight, .. } = *standing;
        let (mut kr, mut refracted) = (material.kr, None);
        if material.is_transparent() {
            let beyond = if hit.entering { media.enter(body) } else { media.leave(body) };
            // A transparent leaf of an opaque body refracts by its own index.
            let (n1, n2) = match (self.ior(&media), self.ior(&beyond)) {
                (1.0, 1.0) if hit.entering => (1.0, material.ior),
                (1.0, 1.0) => (material.ior, 1.0),
                pair => pair,
            };
            match refract(ray.direction, *normal, n1 / n2) {
                Some(direction) => {
                    let ray = Ray { origin: point.position + *normal * -offset, direction };
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

    /// What share of light comes through to the ray's origin from `t = reach`.
    fn unshadowed(&self, ray: &Ray, reach: f64, scratch: &mut Scratch, watch: &mut impl Watch) -> Rgb {
        let mut way = LightsWay::new(ray, reach);
        while let Some(RayTo { ray, end }) = way.rest {
            let hit = self.tracer.first_body_hit(&ray, end, scratch);
            if let Some((hit, point)) = self.pass(&mut way, hit) {
                watch.meets(&hit, &point);
            }
        }
        way.share
    }

    /// Follows a light's way past what the rest of it meets first; says what that is.
    pub(super) fn pass(&self, way: &mut LightsWay, first: Option<(usize, Hit)>) -> Option<(Hit, SurfacePoint)> {
        let RayTo { mut ray, end: mut reach } = way.rest.take()?;
        let (_, hit) = first?;
        let point = self.tracer.surface_point(&ray, &hit);
        way.share = way.share * self.material(point.part).transmission();
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
        OFFSET * self.size.max(point.position.max_abs()).max(travelled)
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
        let met = self.integrator.met(ray, &hit);
        self.watch.meets(&hit, &met.point);
        let mut seen = Seen { color: self.local(&met), alpha: 1.0 };
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
        let first = self.integrator.tracer.first_body_hit(&branch.ray, f64::INFINITY, self.scratch);
        let seen = self.seen(&branch.ray, first, standing);
        self.watch.returns(seen.color);
        seen
    }

    /// Ambient, diffuse and specular light at a point.
    fn local(&mut self, met: &Met) -> Rgb {
        let integrator = self.integrator;
        let mut sum = integrator.ambient(met);
        for (number, light) in integrator.lights().iter().enumerate() {
            let Some(Lit { shadow, reach, intensity, factor }) = integrator.lit(met, light) else { continue };
            self.watch.sets_out(RayKind::Shadow { light: number }, &shadow, intensity * factor);
            let share = integrator.unshadowed(&shadow, reach, self.scratch, self.watch);
            self.watch.returns(share);
            sum += intensity * share * factor;
        }
        sum
    }
}

impl Seen {
    /// Adds what is seen along the refracted ray: `through` is the share of light that comes from there.
    pub(super) fn refract(&mut self, behind: Self, factor: Rgb, through: f64) {
        self.color += behind.color * factor;
        self.alpha = (self.alpha - through * (1.0 - behind.alpha)).clamp(0.0, 1.0);
    }

    /// Adds what is seen along the reflected ray.
    pub(super) fn reflect(&mut self, mirrored: Self, factor: Rgb) {
        self.color += mirrored.color * factor;
    }
}

/// The highlight, to the power of the material's shininess.
fn power(highlight: f64, material: &Material) -> f64 {
    /// `exp(-14)` is less than a millionth: nobody sees that.
    const FAINT: f64 = 14.0;
    // The logarithm of x is at most x - 1.
    if material.ks <= 0.0 || material.shininess * (1.0 - highlight) > FAINT {
        return 0.0;
    }
    power_of_fraction(highlight, material.shininess)
}

/// The direction after reflection at a plane with this normal.
fn mirror(direction: Vec3, normal: Vec3) -> Vec3 {
    direction - normal * (2.0 * normal.dot(direction))
}

/// Snell's law: the unit direction behind a surface whose normal opposes `direction`; `ratio` is the index before over
/// the one behind. `None` where all light is reflected.
fn refract(direction: Vec3, normal: Vec3, ratio: f64) -> Option<Vec3> {
    let direction = direction.normalized()?;
    let cosine = -normal.dot(direction);
    let squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if squared < 0.0 {
        return None;
    }
    (direction * ratio + normal * (ratio * cosine - squared.sqrt())).normalized()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_media_do_not_bend() {
        let d = Vec3::new(0.6, 0.0, -0.8);
        let through = refract(d, Vec3::Z, 1.0).unwrap();
        assert!((through - d).length() < 1e-15);
    }

    #[test]
    fn glass_bends_towards_the_normal_and_reflects_totally_beyond_the_critical_angle() {
        let d = Vec3::new(0.6, 0.0, -0.8);
        let into_glass = refract(d, Vec3::Z, 1.0 / 1.5).unwrap();
        assert!((into_glass.x - 0.4).abs() < 1e-15);
        assert_eq!(refract(Vec3::new(0.8, 0.0, -0.6), Vec3::Z, 1.5), None);
    }
}
