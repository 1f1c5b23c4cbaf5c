//! Rendering in tests.

use octrace::exec::Exec;
use octrace::film::{Background, Film, View, render};
use octrace::model::frame_all;
use octrace::query::occupied_bounds;
use octrace::{Camera, Projection, Scene, Tracer, TracerOptions};

/// Renders the scene, one sample a pixel, with as many threads as given; no cell may contradict another.
pub fn film(
    scene: &Scene,
    size_px: (u32, u32),
    options: &TracerOptions,
    threads: usize,
    camera: impl Fn(&Tracer) -> Camera,
) -> Film {
    let exec = Exec::with_threads(threads);
    let options = TracerOptions { snap: scene.snap, ..*options };
    let tracer = Tracer::build_bodies(&scene.bodies().solids, &options, &exec).expect("nobody cancels");
    let view = View {
        camera: camera(&tracer),
        width_px: size_px.0,
        height_px: size_px.1,
        samples: 1,
        max_bounces: 6,
        background: Background::Scene,
    };
    let (film, stats) = render(scene, &tracer, &view, &exec).expect("nobody cancels");
    assert_eq!(stats.counters.leaks, 0, "cells contradict each other");
    film
}

/// The scene's own camera, or the default view of everything.
pub fn default_camera(scene: &Scene, tracer: &Tracer, size_px: (u32, u32)) -> Camera {
    let perspective = Projection::Perspective { fov_deg: Camera::OPENSCAD_FOV_DEG };
    scene.camera.unwrap_or_else(|| frame_all(&occupied_bounds(tracer), None, perspective, size_px))
}

/// How many pixels differ.
pub fn differing(a: &Film, b: &Film) -> usize {
    std::iter::zip(a.pixels(), b.pixels()).filter(|(a, b)| a != b).count()
}
