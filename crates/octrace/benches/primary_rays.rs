//! What does the octree buy? Building time and primary rays per second on one thread, with the octree and without, for one
//! solid, for one with many holes, and for many solids; beside them, counts that are the same on every machine.
//!
//! `cargo bench -p octrace --bench primary_rays`; rows with certain words only: the same with `-- holes parametric`.

use octrace::exec::Exec;
use octrace::model::{families, frame_all};
use octrace::trace::Scratch;
use octrace::traverse::TraversalKind;
use octrace::{Accel, Projection, Solid, Tracer, TracerOptions};
use std::time::Instant;

const SIZE_PX: (u32, u32) = (1024, 768);

/// Traces every `skip`-th primary ray of a picture of everything and prints a row.
fn run(name: &str, solid: &Solid, accel: Accel, traversal: TraversalKind, skip: usize) {
    let options = TracerOptions { accel, traversal, ..TracerOptions::default() };
    let started = Instant::now();
    let tracer = Tracer::build(solid, &options, &Exec::with_threads(1)).expect("nobody cancels");
    let build = started.elapsed().as_secs_f64();

    let (width, height) = SIZE_PX;
    let camera = frame_all(&tracer.bounds(), None, Projection::Perspective { fov_deg: 22.5 }, SIZE_PX);
    let rays = camera.rays(width, height);
    let mut scratch = Scratch::default();
    let (mut traced, mut hits) = (0_u32, 0_u32);
    let started = Instant::now();
    for i in (0..width * height).step_by(skip) {
        let ray = rays.ray(f64::from(i % width) + 0.5, f64::from(i / width) + 0.5);
        hits += u32::from(tracer.first_hit_within(&ray, f64::INFINITY, &mut scratch).is_some());
        traced += 1;
    }
    let mrays = f64::from(traced) / started.elapsed().as_secs_f64() / 1e6;
    let how = if accel == Accel::None { accel.to_string() } else { traversal.to_string() };
    let per_ray = |count: u64| count as f64 / f64::from(traced);
    println!(
        "{name:<8} {how:<13} {build:>8.2} {mrays:>9.4} {:>8.2} {:>9.2} {:>6.1} %",
        per_ray(scratch.counters.cells),
        per_ray(scratch.counters.surface_tests),
        per_ray(hits.into()) * 100.0
    );
}

fn main() {
    // Cargo passes `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let is_wanted = |row: String| words.iter().all(|word| row.contains(word.as_str()));
    println!("scene    how            build s   Mrays/s  cells/r   tests/r    hit");
    let scenes = [
        ("classic", families::classic(), Some(7)),
        ("holes", families::balls(1_000), Some(997)),
        ("copies", families::copies(10_000), None),
    ];
    for (name, solid, skip_canonical) in scenes {
        for traversal in TraversalKind::ALL.into_iter().filter(|kind| is_wanted(format!("{name} {kind}"))) {
            run(name, &solid, Accel::Octree, traversal, 1);
        }
        if let Some(skip) = skip_canonical.filter(|_| is_wanted(format!("{name} none"))) {
            run(name, &solid, Accel::None, TraversalKind::default(), skip);
        }
    }
}
