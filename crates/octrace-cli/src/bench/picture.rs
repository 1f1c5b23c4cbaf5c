//! The picture that is timed: one ray a pixel; of what it meets, hit, normal and Lambert's cosine to one light; stored.
//! Nothing else, so that the rate is one of rays.

use crate::interrupt::Interrupt;
use octrace::model::CameraRays;
use octrace::trace::{Backend, Counters, Scratch, TILE_PX, Tiles};
use octrace::{Bounds, Camera, Hit, Light, Ray, Tracer, Vec3};
use std::ops::AddAssign;
use std::sync::{Mutex, PoisonError};

/// How a picture is made, again and again.
pub struct Picture<'a> {
    tracer: &'a Tracer,
    tiles: Option<Tiles<'a>>,
    rays: CameraRays,
    light: Light,
    size_px: (usize, usize),
}

impl<'a> Picture<'a> {
    /// The picture that `camera` takes of what is traced, lit by one light.
    pub fn new(tracer: &'a Tracer, camera: &Camera, light: Light, (width_px, height_px): (u32, u32)) -> Self {
        let rays = camera.rays(width_px, height_px);
        let (right, low) = (f64::from(width_px), f64::from(height_px));
        let corners = [(0.0, 0.0), (right, 0.0), (0.0, low), (right, low)].map(|(x, y)| rays.ray(x, y).origin);
        let tiles = tracer.tiles(&Bounds::around(corners), Backend::best());
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
            let mut scratch = Scratch::default();
            while !interrupt.happened() {
                let Some((band, pixels)) = bands.lock().unwrap_or_else(PoisonError::into_inner).next() else { break };
                self.band(band * TILE_PX, pixels, &mut scratch);
            }
            scratch.counters
        };
        let mut counters = Counters::default();
        if threads <= 1 {
            counters += work();
        } else {
            std::thread::scope(|scope| {
                let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
                for worker in workers {
                    counters.add_assign(worker.join().expect("drawing does not panic"));
                }
            });
        }
        counters
    }

    /// A row of tiles, whose upper edge is at `top`.
    fn band(&self, top: usize, pixels: &mut [f32], scratch: &mut Scratch) {
        let width = self.size_px.0;
        let height = pixels.len() / width;
        for left in (0..width).step_by(TILE_PX) {
            let size = (TILE_PX.min(width - left), height);
            let ray = |x: f64, y: f64| self.rays.ray(left as f64 + x, top as f64 + y);
            self.tile(ray, size, scratch, |x, y, brightness| pixels[y * width + left + x] = brightness);
        }
    }

    /// One tile: the only place that knows how the tracer yields hits.
    fn tile(
        &self,
        ray: impl Fn(f64, f64) -> Ray,
        (width, height): (usize, usize),
        scratch: &mut Scratch,
        mut store: impl FnMut(usize, usize, f32),
    ) {
        let through = |x: usize, y: usize| ray(x as f64 + 0.5, y as f64 + 0.5);
        match &self.tiles {
            Some(tiles) => {
                let hits = tiles.hits(&ray, (0.5, 0.5), (width, height), scratch);
                for (y, row) in hits.iter().enumerate().take(height) {
                    for (x, hit) in row.iter().enumerate().take(width) {
                        store(x, y, self.brightness(&through(x, y), hit.map(|(_, hit)| hit)));
                    }
                }
            }
            None => {
                for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                    let ray = through(x, y);
                    store(x, y, self.brightness(&ray, self.tracer.first_hit_within(&ray, f64::INFINITY, scratch)));
                }
            }
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
