//! The render loop: tiles are the unit of threads, progress and interruption; the film does not depend on their order.

use super::Film;
use super::tile::{TileCamera, TilePixels, Worker};
use crate::exec::{Cancelled, Exec};
use crate::model::{Camera, DEFAULT_AMBIENT, DEFAULT_BACKGROUND, Rgb, Scene, default_lights};
use crate::shade::{Lighting, RayCounts, RayTree, Recorder, Whitted};
use crate::trace::{Backend, Counters, Scratch, Tracer};
use rayon::prelude::*;
use std::ops::AddAssign;

/// What is seen where nothing is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// What the scene says, or the default.
    Scene,
    /// This colour.
    Color(Rgb),
    /// Nothing: the film stays transparent. Mirrors see the scene's background.
    Transparent,
}

/// What to render: everything here changes pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// From where.
    pub camera: Camera,
    /// Pixels in a row.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
    /// Rays for each pixel; one goes through its middle, more are spread evenly over it.
    pub samples: u32,
    /// How often a ray may be reflected or refracted.
    pub max_bounces: u32,
    /// What is seen where nothing is.
    pub background: Background,
}

/// What rendering took, in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderStats {
    /// Rays by kind.
    pub rays: RayCounts,
    /// Cells, surfaces and leaks.
    pub counters: Counters,
}

/// Renders the scene. The tracer must have been built from the scene's solid, or from its bodies.
///
/// # Errors
/// If `exec` is cancelled.
pub fn render(scene: &Scene, tracer: &Tracer, view: &View, exec: &Exec) -> Result<(Film, RenderStats), Cancelled> {
    render_by(Backend::best(), scene, tracer, view, exec)
}

/// As [`render`], as compiled for that backend.
fn render_by(
    backend: Backend,
    scene: &Scene,
    tracer: &Tracer,
    view: &View,
    exec: &Exec,
) -> Result<(Film, RenderStats), Cancelled> {
    let integrator = integrator(scene, tracer, view);
    let rays = view.camera.rays(view.width_px, view.height_px);
    let together = tracer.tiles(&rays, (view.width_px, view.height_px), backend);
    let camera = TileCamera { tracer, rays, backend, together };
    let mut pixels = vec![[0.0; 4]; view.width_px as usize * view.height_px as usize];
    let tiles = TilePixels::of_film(&mut pixels, view.width_px as usize);

    exec.progress.begin("rendering", tiles.len() as u64);
    let stats: Result<RenderStats, Cancelled> = exec.install(|| {
        tiles
            .into_par_iter()
            .map_init(Worker::default, |worker, tile| {
                exec.cancel.check()?;
                let stats = worker.render(&integrator, &camera, view.samples, tile);
                exec.progress.advance(1);
                Ok(stats)
            })
            .try_reduce(RenderStats::default, |mut sum, stats| {
                sum += stats;
                Ok(sum)
            })
    });
    exec.progress.end();
    Ok((Film::new(view.width_px, view.height_px, pixels), stats?))
}

/// Every ray that is traced for the middle of pixel `(x, y)`, and the light that comes along it.
pub fn ray_tree(scene: &Scene, tracer: &Tracer, view: &View, (x, y): (u32, u32)) -> RayTree {
    let ray = view.camera.rays(view.width_px, view.height_px).ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
    let mut recorder = Recorder::default();
    let integrator = integrator(scene, tracer, view);
    let mut scratch = Scratch::default();
    let first = tracer.first_body_hit(&ray, f64::INFINITY, &mut scratch);
    integrator.camera_ray(&ray, first, &mut scratch, &mut recorder);
    recorder.tree
}

fn integrator<'a>(scene: &'a Scene, tracer: &'a Tracer, view: &View) -> Whitted<'a> {
    let scene_background = scene.background.unwrap_or(DEFAULT_BACKGROUND);
    let lighting = Lighting {
        lights: if scene.lights.is_empty() { default_lights(&view.camera) } else { scene.lights.clone() },
        ambient: scene.ambient.unwrap_or(DEFAULT_AMBIENT),
        background: match view.background {
            Background::Color(color) => color,
            Background::Scene | Background::Transparent => scene_background,
        },
        transparent: view.background == Background::Transparent,
    };
    Whitted::new(scene, tracer, lighting, &scene.bodies(), view.max_bounces)
}

impl AddAssign for RenderStats {
    fn add_assign(&mut self, o: Self) {
        self.rays += o.rays;
        self.counters += o.counters;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vec3;
    use crate::model::{Light, Material, Part, PartId, Projection, Solid};
    use crate::primitive::Primitive;
    use crate::trace::{Accel, TracerOptions};

    /// Glass within glass, mirrors, things that lanes cannot cross, and a floor; lights of both kinds.
    fn scene() -> Scene {
        let materials = [
            Material::matte(Rgb::new(0.3, 0.4, 0.9)),
            Material::glass(Rgb::new(0.9, 1.0, 0.8)),
            Material { ior: 1.3, ..Material::glass(Rgb::new(1.0, 0.7, 0.7)) },
            Material::metal(Rgb::new(0.7, 0.5, 0.2)),
            Material::mirror(Rgb::WHITE),
        ];
        let floor = Solid::half_space().scale([1.0, 1.0, -1.0]).translate([0.0, 0.0, -1.0]);
        let lens = Solid::sphere() & Solid::sphere().translate([0.0, 1.2, 0.0]);
        let drilled = Solid::block().scale([1.5; 3]) - Solid::sphere().scale([0.6; 3]).translate([0.7, 0.1, 0.8]);
        let solid = Solid::union([
            floor.part(PartId(0)),
            Solid::sphere().translate([-1.2, 0.0, 0.0]).part(PartId(1)),
            Solid::sphere().scale([0.5; 3]).translate([-1.2, 0.0, 0.1]).part(PartId(2)),
            lens.translate([0.6, -1.5, -0.3]).part(PartId(1)),
            Solid::primitive(Primitive::Torus { minor: 0.3 })
                .rotate([50.0, 20.0, 0.0])
                .translate([0.5, 1.5, 0.3])
                .part(PartId(3)),
            Solid::primitive(Primitive::Cone { top: 0.2 }).translate([2.2, 0.5, -1.0]).part(PartId(4)),
            drilled.translate([-0.8, 2.5, -1.0]).part(PartId(3)),
            Solid::block().translate([-3.5, 1.0, -1.0]),
        ]);
        let lights = vec![
            Light::Point { position: Vec3::new(5.0, -6.0, 8.0), intensity: Rgb::gray(0.6) },
            Light::Directional { direction: Vec3::new(1.0, 0.5, -2.0), intensity: Rgb::new(0.3, 0.3, 0.2) },
            Light::Point { position: Vec3::new(-1.2, 0.2, 0.1), intensity: Rgb::new(0.2, 0.1, 0.3) },
        ];
        Scene { parts: materials.map(|material| Part { material }).to_vec(), lights, ..Scene::new(solid) }
    }

    fn view(projection: Projection, samples: u32) -> View {
        let camera = Camera { eye: Vec3::new(0.6, -7.0, 1.5), at: Vec3::new(0.1, 0.0, 0.1), up: Vec3::Z, projection };
        View { camera, width_px: 45, height_px: 37, samples, max_bounces: 5, background: Background::Transparent }
    }

    #[test]
    fn all_backends_render_what_one_ray_after_another_sees() {
        let (scene, exec) = (scene(), Exec::with_threads(1));
        let solids = scene.bodies().solids;
        let tracer = Tracer::build_bodies(&solids, &TracerOptions::default(), &exec).expect("nobody cancels");
        for projection in [Projection::Perspective { fov_deg: 35.0 }, Projection::Orthographic { height: 5.0 }] {
            let view = view(projection, 1);
            for backend in Backend::ALL {
                let (film, _) = render_by(backend, &scene, &tracer, &view, &exec).expect("nobody cancels");
                for (number, pixel) in (0..).zip(film.pixels()) {
                    let at = (number % view.width_px, number / view.width_px);
                    let Rgb { r, g, b } = ray_tree(&scene, &tracer, &view, at).rays[0].light;
                    assert_eq!(pixel[..3], [r, g, b].map(|v| v as f32), "{at:?}, {backend:?}, {projection:?}");
                }
            }
        }
    }

    #[test]
    fn neither_backend_nor_octree_is_seen_in_many_samples() {
        let (scene, exec) = (scene(), Exec::with_threads(2));
        let solids = scene.bodies().solids;
        let view = view(Projection::Perspective { fov_deg: 35.0 }, 3);
        let mut films = Vec::new();
        for accel in [Accel::Octree, Accel::None] {
            let options = TracerOptions { accel, ..TracerOptions::default() };
            let tracer = Tracer::build_bodies(&solids, &options, &exec).expect("nobody cancels");
            for backend in Backend::ALL {
                films.push(render_by(backend, &scene, &tracer, &view, &exec).expect("nobody cancels").0);
            }
        }
        assert!(films.iter().all(|film| *film == films[0]));
    }
}
