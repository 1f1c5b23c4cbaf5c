//! The picture that is timed: one ray a pixel; of what it meets, hit, normal and Lambert's cosine; stored. Nothing else, so
//! that the rate is one of rays. And the same picture if each pixel were told which surface it shows: the limit.

use crate::interrupt::Interrupt;
use octrace::model::CameraRays;
use octrace::trace::{Backend, Brightness, Counters, RayTile, Scratch, TILE_PX, Tiles, Told};
use octrace::{Camera, Light, Tracer, Vec3};
use std::sync::{Mutex, PoisonError};

/// How a picture is made, again and again.
pub struct Picture<'a> {
    tracer: &'a Tracer,
    /// How rays are traced together, if they can be.
    tiles: Option<Tiles<'a>>,
    rays: CameraRays,
    /// Where light comes from.
    light: Vec3,
    size_px: (usize, usize),
}

/// What one thread works with.
#[derive(Default)]
struct Worker {
    scratch: Scratch,
    tile: RayTile,
    shaded: Brightness,
}

impl<'a> Picture<'a> {
    /// The picture that `camera` takes of what is traced, with light from where `light` is, as the camera's target sees it.
    pub fn new(tracer: &'a Tracer, camera: &Camera, light: Light, (width_px, height_px): (u32, u32)) -> Self {
        let rays = camera.rays(width_px, height_px);
        let tiles = tracer.tiles(&rays, (width_px, height_px), Backend::best());
        let toward = match light {
            Light::Point { position, .. } => position - camera.at,
            Light::Directional { direction, .. } => -direction,
        };
        let light = toward.normalized().unwrap_or(Vec3::Z);
        Self { tracer, tiles, rays, light, size_px: (width_px as usize, height_px as usize) }
    }

    /// Room for a picture.
    pub fn pixels(&self) -> Vec<f32> {
        vec![0.0; self.size_px.0 * self.size_px.1]
    }

    /// Draws it, and says what was counted; with one thread, in this very one.
    pub fn draw(&self, pixels: &mut [f32], threads: usize, interrupt: &Interrupt) -> Counters {
        let bands = Mutex::new(self.bands(pixels));
        let work = || {
            let mut worker = Worker::default();
            while !interrupt.happened() {
                let Some((top, band)) = bands.lock().unwrap_or_else(PoisonError::into_inner).next() else { break };
                for left in self.lefts() {
                    self.shade((left, top), &mut worker);
                    self.put(&worker.shaded, left, band);
                }
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

    /// Which surface each pixel shows, tile by tile; `None` where rays are not traced together.
    pub fn told(&self) -> Option<Vec<Told>> {
        self.tiles.as_ref()?;
        let mut worker = Worker::default();
        let corners = (0..self.size_px.1).step_by(TILE_PX).flat_map(|top| self.lefts().map(move |left| (left, top)));
        let tell = |corner| {
            self.shade(corner, &mut worker);
            Tiles::told(&worker.tile)
        };
        Some(corners.map(tell).collect())
    }

    /// Draws the picture, with one thread, from what [`told`](Self::told) said: nothing need be searched for.
    pub fn draw_told(&self, told: &[Told], pixels: &mut [f32]) {
        let Some(tiles) = &self.tiles else { return };
        let Worker { mut tile, mut shaded, .. } = Worker::default();
        let mut told = told.iter();
        for (top, band) in self.bands(pixels) {
            for (left, told) in std::iter::zip(self.lefts(), told.by_ref()) {
                tiles.brightness_if_told((left as u32, top as u32), self.light, told, &mut tile, &mut shaded);
                self.put(&shaded, left, band);
            }
        }
    }

    /// Rows of tiles: the upper edge, and the pixels.
    fn bands<'p>(&self, pixels: &'p mut [f32]) -> impl Iterator<Item = (usize, &'p mut [f32])> + Send + use<'p> {
        pixels.chunks_mut(self.size_px.0 * TILE_PX).enumerate().map(|(band, pixels)| (band * TILE_PX, pixels))
    }

    /// The left edges of the tiles in a row.
    fn lefts(&self) -> impl Iterator<Item = usize> + use<> {
        (0..self.size_px.0).step_by(TILE_PX)
    }

    /// Traces and shades a tile.
    fn shade(&self, (left, top): (usize, usize), worker: &mut Worker) {
        let Worker { scratch, tile, shaded } = worker;
        match &self.tiles {
            Some(tiles) => tiles.brightness((left as u32, top as u32), self.light, tile, scratch, shaded),
            None => {
                for (at, pixel) in shaded.0.iter_mut().enumerate() {
                    let (x, y) = (left + at % TILE_PX, top + at / TILE_PX);
                    *pixel = self.brightness(x as f64 + 0.5, y as f64 + 0.5, scratch);
                }
            }
        }
    }

    /// What one ray sees: Lambert's cosine.
    fn brightness(&self, x: f64, y: f64, scratch: &mut Scratch) -> f32 {
        let ray = self.rays.ray(x, y);
        let Some(hit) = self.tracer.first_hit_within(&ray, f64::INFINITY, scratch) else {
            return Brightness::BACKGROUND;
        };
        let normal = self.tracer.surface_point(&ray, &hit).normal;
        let seen = if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
        seen.dot(self.light).max(0.0) as f32
    }

    /// Puts a tile's pixels into its band, as far as they are in the picture.
    fn put(&self, tile: &Brightness, left: usize, band: &mut [f32]) {
        let width = TILE_PX.min(self.size_px.0 - left);
        for (row, tile_row) in std::iter::zip(band.chunks_mut(self.size_px.0), tile.0.chunks(TILE_PX)) {
            row[left..left + width].copy_from_slice(&tile_row[..width]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::scenes::built_in;
    use super::*;
    use crate::interrupt::Interrupt;
    use octrace::exec::Exec;
    use octrace::{Accel, TracerOptions};

    const SIZE_PX: (u32, u32) = (100, 75);

    fn check(names: &[&str], accel: Accel, examine: impl Fn(&Picture<'_>, &[f32])) {
        for name in names {
            let scene = built_in(name).expect("it is built in").scene;
            let options = TracerOptions { accel, ..TracerOptions::default() };
            let tracer = Tracer::build_bodies(&scene.bodies().solids, &options, &Exec::default()).expect("uncancelled");
            let camera = scene.camera.expect("it names one");
            let picture = Picture::new(&tracer, &camera, scene.lights[0], SIZE_PX);
            let mut pixels = picture.pixels();
            picture.draw(&mut pixels, 1, &Interrupt::never());
            assert!(pixels.iter().filter(|&&v| v != Brightness::BACKGROUND).count() > 1_000, "{name} is seen");
            examine(&picture, &pixels);
        }
    }

    #[test]
    fn threads_are_invisible() {
        check(&["classic", "menger-3", "grid-100"], Accel::Octree, |picture, expected| {
            let mut pixels = picture.pixels();
            picture.draw(&mut pixels, 3, &Interrupt::never());
            assert_eq!(pixels, expected);
        });
    }

    #[test]
    fn the_limit_is_one_of_the_same_picture() {
        check(&["classic", "menger-3", "grid-100"], Accel::Octree, |picture, expected| {
            let told = picture.told().expect("these scenes are traced in tiles");
            let mut pixels = picture.pixels();
            picture.draw_told(&told, &mut pixels);
            assert_eq!(pixels, expected);
        });
    }

    #[test]
    fn without_tiles_there_is_no_limit() {
        check(&["classic"], Accel::None, |picture, _| assert!(picture.told().is_none()));
    }
}
