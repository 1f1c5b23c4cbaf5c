//! The picture that is timed: one ray a pixel; of what it meets, hit, normal and Lambert's cosine to one light; stored.
//! Nothing else, so that the rate is one of rays.

use crate::interrupt::Interrupt;
use octrace::model::CameraRays;
use octrace::trace::{Backend, Counters, RayTile, Scratch, TILE_PX, Tiles};
use octrace::{Camera, Hit, Light, Ray, Tracer, Vec3};
use std::sync::{Mutex, PoisonError};

/// How a picture is made, again and again.
pub struct Picture<'a> {
    tracer: &'a Tracer,
    tiles: Option<Tiles<'a>>,
    rays: CameraRays,
    light: Light,
    size_px: (usize, usize),
}

/// What one thread works with.
#[derive(Default)]
struct Worker {
    scratch: Scratch,
    tile: RayTile,
}

impl<'a> Picture<'a> {
    /// The picture that `camera` takes of what is traced, lit by one light.
    pub fn new(tracer: &'a Tracer, camera: &Camera, light: Light, (width_px, height_px): (u32, u32)) -> Self {
        let rays = camera.rays(width_px, height_px);
        let tiles = tracer.tiles(&rays, (width_px, height_px), Backend::best());
        Self { tracer, tiles, rays, light, size_px: (width_px as usize, height_px as usize) }
    }

    /// Room for a picture.
    pub fn pixels(&self) -> Vec<f32> {
        vec![0.0; self.size_px.0 * self.size_px.1]
    }

    /// Draws it, and says what was counted; with one thread, in this very one.
    pub fn draw(&self, pixels: &mut [f32], threads: usize, interrupt: &Interrupt) -> Counters {
        let bands = Mutex::new(pixels.chunks_mut(self.size_px.0 * TILE_PX).enumerate());
        let work = || {
            let mut worker = Worker::default();
            while !interrupt.happened() {
                let Some((band, pixels)) = bands.lock().unwrap_or_else(PoisonError::into_inner).next() else { break };
                self.band(band * TILE_PX, pixels, &mut worker);
            }
            worker.scratch.counters
        };
        let mut counters = Counters::default();
        if threads <= 1 {
            counters += work();
        } else {
            std::thread::scope(|scope| {
                let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
                for worker in workers {
                    counters += worker.join().expect("drawing does not panic");
                }
            });
        }
        counters
    }

    /// A row of tiles, whose upper edge is at `top`.
    fn band(&self, top: usize, pixels: &mut [f32], worker: &mut Worker) {
        let width = self.size_px.0;
        let height = pixels.len() / width;
        for left in (0..width).step_by(TILE_PX) {
            let size = (TILE_PX.min(width - left), height);
            self.tile((left, top), size, worker, |x, y, brightness| pixels[y * width + left + x] = brightness);
        }
    }

    /// One tile: the only place that knows how the tracer yields hits.
    fn tile(
        &self,
        (left, top): (usize, usize),
        (width, height): (usize, usize),
        worker: &mut Worker,
        mut store: impl FnMut(usize, usize, f32),
    ) {
        let Worker { scratch, tile } = worker;
        if let Some(tiles) = &self.tiles {
            tiles.trace((left as u32, top as u32), (width as u32, height as u32), (0.5, 0.5), tile, scratch);
        }
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let ray = self.rays.ray((left + x) as f64 + 0.5, (top + y) as f64 + 0.5);
            let hit = match &self.tiles {
                Some(tiles) => tiles.hit(tile, (x, y)).map(|(_, hit)| hit),
                None => self.tracer.first_hit_within(&ray, f64::INFINITY, scratch),
            };
            store(x, y, self.brightness(&ray, hit));
        }
    }

    /// Lambert's cosine; nothing where nothing is, or away from the light.
    fn brightness(&self, ray: &Ray, hit: Option<Hit>) -> f32 {
        let Some(hit) = hit else { return 0.0 };
        let point = self.tracer.surface_point(ray, &hit);
        let to_light = match self.light {
            Light::Point { position, .. } => position - point.position,
            Light::Directional { direction, .. } => -direction,
        };
        let unit = to_light.normalized().unwrap_or(Vec3::ZERO);
        point.normal.dot(unit).max(0.0) as f32
    }
}
