//! What is measured, and from where it is seen.

use octrace::exec::Exec;
use octrace::model::{CameraRays, families, frame_all};
use octrace::trace::TILE_PX;
use octrace::{Camera, Projection, Ray, Solid, Tracer, TracerOptions};

/// Pixels of a picture: whole tiles.
pub const SIZE_PX: (usize, usize) = (256, 192);
/// Rays of a picture.
pub const RAYS: usize = SIZE_PX.0 * SIZE_PX.1;

/// From few surfaces to many; differences with much in one place, copies with little.
pub const NAMES: [&str; 6] = ["classic", "plate", "swiss-1000", "swiss-10000", "grid-100", "grid-1000"];

/// The solid of that name.
pub fn solid(name: &str) -> Solid {
    match name {
        "classic" => families::classic(),
        "plate" => families::plate(20),
        "swiss-1000" => families::swiss(1_000),
        "swiss-10000" => families::swiss(10_000),
        "grid-100" => families::grid([5, 5, 4]),
        "grid-1000" => families::grid([10, 10, 10]),
        other => panic!("no scene is called {other}"),
    }
}

/// One thread.
pub fn exec() -> Exec {
    Exec::with_threads(1)
}

/// A tracer, and a picture of all that it traces.
pub struct Shot {
    pub tracer: Tracer,
    pub camera: Camera,
    pub rays: CameraRays,
}

impl Shot {
    /// Of a solid, with these settings.
    pub fn of(solid: &Solid, options: &TracerOptions) -> Self {
        let tracer = Tracer::build(solid, options, &exec()).expect("nobody cancels");
        let (width, height) = (SIZE_PX.0 as u32, SIZE_PX.1 as u32);
        let perspective = Projection::Perspective { fov_deg: 22.5 };
        let camera = frame_all(&tracer.bounds(), None, perspective, (width, height));
        Self { rays: camera.rays(width, height), tracer, camera }
    }

    /// The rays through the middles of all pixels.
    pub fn all_rays(&self) -> Vec<Ray> {
        let at = |i: usize| self.rays.ray((i % SIZE_PX.0) as f64 + 0.5, (i / SIZE_PX.0) as f64 + 0.5);
        (0..RAYS).map(at).collect()
    }
}

/// The upper left corners of a picture's tiles.
pub fn tiles() -> impl Iterator<Item = (u32, u32)> {
    let starts = |size: usize| (0..size).step_by(TILE_PX).map(|start| start as u32);
    starts(SIZE_PX.1).flat_map(move |top| starts(SIZE_PX.0).map(move |left| (left, top)))
}
