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
    let integrator = integrator(scene, tracer, view);
    let rays = view.camera.rays(view.width_px, view.height_px);
    let backend = Backend::best();
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
    Whitted::new(scene, tracer, lighting, scene.bodies().ior, view.max_bounces)
}

impl AddAssign for RenderStats {
    fn add_assign(&mut self, o: Self) {
        self.rays += o.rays;
        self.counters += o.counters;
    }
}
