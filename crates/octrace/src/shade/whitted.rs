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
use crate::model::{Light, Material, Rgb, Scene};
use crate::trace::{Scratch, SurfacePoint, Tracer};
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
struct Media {
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

impl<'a> Whitted<'a> {
    /// Light for the scene as the tracer knows it. `body_ior` is the index of refraction inside each body of the tracer,
    /// as [`Scene::bodies`] says.
    pub fn new(scene: &'a Scene, tracer: &'a Tracer, lighting: Lighting, body_ior: Vec<f64>, max_bounces: u32) -> Self {
        let size = tracer.bounds().size().max_abs();
        Self { scene, tracer, lighting, body_ior, max_bounces, size }
    }

    /// Light along a camera ray that meets `first`; `watch` sees every ray that is traced for it.
    pub(crate) fn camera_ray(
        &self,
        ray: &Ray,
        first: Option<(usize, Hit)>,
        scratch: &mut Scratch,
        counts: &mut RayCounts,
        watch: &mut impl Watch,
    ) -> Seen {
        counts.camera += 1;
        let mut media = Media::default();
        let may_start_inside = self.tracer.is_unbounded() || self.tracer.bounds().contains(ray.origin);
        if self.tracer.bodies() > 1 && may_start_inside {
            for body in 0..self.tracer.bodies() {
                if self.tracer.body_contains(body, ray.origin, scratch) {
                    media = media.enter(body);
                }
            }
        }
        watch.sets_out(RayKind::Camera, ray, Rgb::WHITE);
        let seen = Path { integrator: self, scratch, counts, watch }.seen(ray, first, media, 0, 1.0, true);
        watch.returns(seen.color);
        seen
    }

    fn ior(&self, media: &Media) -> f64 {
        media.inside().last().map_or(1.0, |&body| self.body_ior.get(usize::from(body)).copied().unwrap_or(1.0))
    }
}

/// One tree of rays.
struct Path<'a, 'b, W> {
    integrator: &'b Whitted<'a>,
    scratch: &'b mut Scratch,
    counts: &'b mut RayCounts,
    watch: &'b mut W,
}

impl<W: Watch> Path<'_, '_, W> {
    /// Light along a ray.
    fn radiance(&mut self, ray: &Ray, media: Media, bounce: u32, weight: f64, direct: bool) -> Seen {
        let first = self.integrator.tracer.first_body_hit(ray, f64::INFINITY, self.scratch);
        self.seen(ray, first, media, bounce, weight, direct)
    }

    /// Light along a ray that meets `first`. `direct` says that the ray comes from the camera, if through glass.
    fn seen(
        &mut self,
        ray: &Ray,
        first: Option<(usize, Hit)>,
        media: Media,
        bounce: u32,
        weight: f64,
        direct: bool,
    ) -> Seen {
        let Whitted { tracer, lighting, .. } = self.integrator;
        let Some((body, hit)) = first else {
            return match direct && lighting.transparent {
                true => Seen { color: Rgb::BLACK, alpha: 0.0 },
                false => Seen { color: lighting.background, alpha: 1.0 },
            };
        };
        let point = tracer.surface_point(ray, &hit);
        self.watch.meets(&hit, &point);
        let material = self.integrator.scene.material(point.part);
        let toward_viewer = -ray.direction.normalized().unwrap_or(Vec3::Z);
        let normal = if point.normal.dot(toward_viewer) < 0.0 { -point.normal } else { point.normal };
        let offset = self.integrator.offset(ray, &hit, &point);
        let above = point.position + normal * offset;

        let mut color = self.local(&material, above, normal, toward_viewer);
        let mut alpha = 1.0;
        let (mut kr, mut refraction) = (material.kr, None);
        if material.is_transparent() {
            let beyond = if hit.entering { media.enter(body) } else { media.leave(body) };
            // A transparent leaf of an opaque body refracts by its own index.
            let (n1, n2) = match (self.integrator.ior(&media), self.integrator.ior(&beyond)) {
                (1.0, 1.0) if hit.entering => (1.0, material.ior),
                (1.0, 1.0) => (material.ior, 1.0),
                pair => pair,
            };
            match refract(ray.direction, normal, n1 / n2) {
                Some(direction) => {
                    let below = point.position + normal * -offset;
                    refraction = Some((Ray { origin: below, direction }, beyond));
                }
                None => kr += material.kt,
            }
        }
        if let Some((refracted, beyond)) = refraction {
            let filter = material.transmission();
            let share = weight * filter.max_component();
            if bounce < self.integrator.max_bounces && share >= LEAST_WEIGHT {
                self.counts.refracted += 1;
                self.watch.sets_out(RayKind::Refracted, &refracted, filter);
                let seen = self.radiance(&refracted, beyond, bounce + 1, share, direct);
                self.watch.returns(seen.color);
                color += seen.color * filter;
                alpha -= material.kt * (1.0 - seen.alpha);
            }
        }
        if kr > 0.0 && bounce < self.integrator.max_bounces && weight * kr >= LEAST_WEIGHT {
            self.counts.reflected += 1;
            let reflected = Ray { origin: above, direction: mirror(-toward_viewer, normal) };
            self.watch.sets_out(RayKind::Reflected, &reflected, Rgb::gray(kr));
            let seen = self.radiance(&reflected, media, bounce + 1, weight * kr, false);
            self.watch.returns(seen.color);
            color += seen.color * kr;
        }
        Seen { color, alpha: alpha.clamp(0.0, 1.0) }
    }

    /// Ambient, diffuse and specular light at a point.
    fn local(&mut self, material: &Material, above: Vec3, normal: Vec3, toward_viewer: Vec3) -> Rgb {
        let Whitted { lighting, .. } = self.integrator;
        let mut sum = material.color * lighting.ambient * material.ka;
        for (number, light) in lighting.lights.iter().enumerate() {
            let (to_light, reach, intensity) = match *light {
                Light::Point { position, intensity } => (position - above, 1.0, intensity),
                Light::Directional { direction, intensity } => (-direction, f64::INFINITY, intensity),
            };
            let Some(unit) = to_light.normalized() else { continue };
            let cosine = normal.dot(unit);
            if cosine <= 0.0 {
                continue;
            }
            let highlight = toward_viewer.dot(mirror(-unit, normal)).max(0.0);
            let specular = if material.ks > 0.0 { material.ks * libm::pow(highlight, material.shininess) } else { 0.0 };
            let factor = material.color * (material.kd * cosine) + Rgb::gray(specular);
            if factor.max_component() <= 0.0 {
                continue;
            }
            let shadow = Ray { origin: above, direction: to_light };
            self.watch.sets_out(RayKind::Shadow { light: number }, &shadow, intensity * factor);
            let share = self.unshadowed(&shadow, reach);
            self.watch.returns(share);
            let arriving = intensity * share;
            sum += arriving * factor;
        }
        sum
    }

    /// What share of light comes through to the ray's origin from `t = reach`.
    fn unshadowed(&mut self, ray: &Ray, reach: f64) -> Rgb {
        let Whitted { scene, tracer, .. } = self.integrator;
        self.counts.shadow += 1;
        let mut share = Rgb::WHITE;
        let mut ray = *ray;
        let mut reach = reach;
        for _ in 0..MAX_SHADOW_CROSSINGS {
            let Some((_, hit)) = tracer.first_body_hit(&ray, reach, self.scratch) else {
                return share;
            };
            let point = tracer.surface_point(&ray, &hit);
            self.watch.meets(&hit, &point);
            share = share * scene.material(point.part).transmission();
            if share.max_component() < LEAST_WEIGHT {
                return Rgb::BLACK;
            }
            // On from the far side of the surface, towards the same light.
            let along = if point.normal.dot(ray.direction) < 0.0 { -point.normal } else { point.normal };
            let end = ray.at(reach);
            ray.origin = point.position + along * self.integrator.offset(&ray, &hit, &point);
            if reach.is_finite() {
                ray.direction = end - ray.origin;
                reach = 1.0;
            }
            if ray.direction == Vec3::ZERO {
                return share;
            }
        }
        Rgb::BLACK
    }
}

impl Whitted<'_> {
    /// How far a ray that starts at a hit must start off the surface, so as not to meet it again.
    fn offset(&self, ray: &Ray, hit: &Hit, point: &SurfacePoint) -> f64 {
        let travelled = hit.t * ray.direction.max_abs();
        OFFSET * self.size.max(point.position.max_abs()).max(travelled)
    }
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
