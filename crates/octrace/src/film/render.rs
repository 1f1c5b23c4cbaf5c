//! The render loop: tiles are the unit of threads, progress and interruption; the film does not depend on their order.

use super::Film;
use super::develop::Develop;
use crate::exec::{Cancelled, Exec};
use crate::model::{Camera, CameraRays, DEFAULT_AMBIENT, DEFAULT_BACKGROUND, Rgb, Scene, default_lights};
use crate::shade::{EightSeen, Lighting, RayCounts, RayTree, Recorder, Wave, Whitted, Workshop};
use crate::trace::{
    Backend, Counters, EightHits, EightRays, PACKETS as EIGHTS, RayTile, Scratch, Tiles, Tracer, lane_of,
};
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

const TILE_PX: u32 = crate::trace::TILE_PX as u32;

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
    let (width, height) = (view.width_px, view.height_px);
    let tiles_across = width.div_ceil(TILE_PX);
    let tiles = tiles_across * height.div_ceil(TILE_PX);
    let tile_origin = |tile: u32| ((tile % tiles_across) * TILE_PX, (tile / tiles_across) * TILE_PX);

    exec.progress.begin("rendering", u64::from(tiles));
    let rendered: Result<Vec<Tile>, Cancelled> = exec.install(|| {
        (0..tiles)
            .into_par_iter()
            .map_init(Worker::default, |worker, tile| {
                exec.cancel.check()?;
                let tile = Tile::render(&integrator, &camera, view, tile_origin(tile), worker);
                exec.progress.advance(1);
                Ok(tile)
            })
            .collect()
    });
    exec.progress.end();

    let mut pixels = vec![[0.0; 4]; width as usize * height as usize];
    let mut stats = RenderStats::default();
    for (tile, number) in rendered?.iter().zip(0..) {
        let (left, top) = tile_origin(number);
        for (row, y) in tile.pixels.chunks(tile.width as usize).zip(top..) {
            let start = y as usize * width as usize + left as usize;
            pixels[start..start + row.len()].copy_from_slice(row);
        }
        stats += tile.stats;
    }
    Ok((Film::new(width, height, pixels), stats))
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

/// Camera rays, and what they meet.
struct TileCamera<'a> {
    tracer: &'a Tracer,
    rays: CameraRays,
    backend: Backend,
    /// How tiles are traced together, if they can be.
    together: Option<Tiles<'a>>,
}

/// The memory of a worker.
#[derive(Debug, Default)]
struct Worker {
    scratch: Scratch,
    rays: RayTile,
    wave: Wave,
    sums: Vec<EightSeen>,
}

struct Tile {
    width: u32,
    pixels: Vec<[f32; 4]>,
    stats: RenderStats,
}

impl Tile {
    fn render(
        integrator: &Whitted,
        camera: &TileCamera,
        view: &View,
        corner: (u32, u32),
        Worker { scratch, rays, wave, sums }: &mut Worker,
    ) -> Self {
        let size = ((view.width_px - corner.0).min(TILE_PX), (view.height_px - corner.1).min(TILE_PX));
        let samples = view.samples.max(1);
        let mut stats = RenderStats::default();
        scratch.counters = Counters::default();
        sums.clear();
        for sample in 0..samples {
            camera.trace(corner, size, sample_place(sample, samples), (rays, scratch), wave.camera_rays(EIGHTS));
            let mut workshop = Workshop { backend: camera.backend, tile: rays, scratch, counts: &mut stats.rays };
            let seen = wave.light(integrator, &mut workshop);
            if sample == 0 {
                sums.extend_from_slice(seen);
                continue;
            }
            for (sum, seen) in sums.iter_mut().zip(seen) {
                sum.add(seen);
            }
        }
        let share = 1.0 / f64::from(samples);
        let mut pixels = vec![[0.0; 4]; (size.0 * size.1) as usize];
        camera.backend.run(Develop { seen: sums, share, width: size.0 as usize, pixels: &mut pixels });
        stats.counters = scratch.counters;
        Self { width: size.0, pixels, stats }
    }
}

impl TileCamera<'_> {
    /// What the rays through a place of each pixel of a tile meet.
    fn trace(
        &self,
        corner: (u32, u32),
        size: (u32, u32),
        place: (f64, f64),
        (tile, scratch): (&mut RayTile, &mut Scratch),
        (rays, hits): (&mut [EightRays], &mut [EightHits]),
    ) {
        if let Some(tiles) = &self.together {
            tiles.trace(corner, size, place, tile, scratch);
            tiles.eights(tile, rays, hits);
            return;
        }
        for (rays, hits) in rays.iter_mut().zip(&mut *hits) {
            (rays.lanes, hits.met) = (0, 0);
        }
        for (x, y) in (0..size.1).flat_map(|y| (0..size.0).map(move |x| (x, y))) {
            let ray = self.rays.ray(f64::from(corner.0 + x) + place.0, f64::from(corner.1 + y) + place.1);
            let (eight, lane) = lane_of(x as usize, y as usize);
            rays[eight].put(lane, &ray, f64::INFINITY);
            hits[eight].set(lane, self.tracer.first_body_hit(&ray, f64::INFINITY, scratch));
        }
    }
}

/// Where in its pixel a sample lies: the middle for a single one, else a rank-1 lattice by the golden ratio.
fn sample_place(sample: u32, samples: u32) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    if samples == 1 {
        return (0.5, 0.5);
    }
    let i = f64::from(sample);
    ((i + 0.5) / f64::from(samples), (0.5 + i * GOLDEN).fract())
}
