//! Camera rays: in tiles, one by one, and along the cells alone.

use crate::scenes::{NAMES, RAYS, SIZE_PX, Shot, solid, tiles};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use octrace::TracerOptions;
use octrace::trace::{Backend, RayTile, RayTo, Scratch, TILE_PX};
use octrace::traverse::{TraversalKind, root_interval};
use std::ops::ControlFlow;

/// A picture in tiles, as the machine does it best.
#[divan::bench(args = NAMES, max_time = 2)]
fn in_tiles(bencher: Bencher, name: &str) {
    let shot = Shot::of(&solid(name), &TracerOptions::default());
    draw(bencher, &shot, Backend::best());
}

/// Finds the hits of a whole picture.
pub fn draw(bencher: Bencher, shot: &Shot, backend: Backend) {
    let (width, height) = SIZE_PX;
    let tiled = shot.tracer.tiles(&shot.rays, (width as u32, height as u32), backend);
    let tiled = tiled.expect("these scenes are traced in tiles");
    let (mut tile, mut scratch) = (RayTile::default(), Scratch::default());
    bencher.counter(ItemsCount::new(RAYS)).bench_local(|| {
        for corner in tiles() {
            tiled.trace(corner, (TILE_PX as u32, TILE_PX as u32), (0.5, 0.5), &mut tile, &mut scratch);
            black_box(tiled.hit(&tile, (0, 0)));
        }
    });
}

/// The same rays as a stream, of which nothing is known but that neighbours are near.
#[divan::bench(args = NAMES, max_time = 2)]
fn in_streams(bencher: Bencher, name: &str) {
    let shot = Shot::of(&solid(name), &TracerOptions::default());
    let rays: Vec<RayTo> = shot.all_rays().into_iter().map(|ray| RayTo { ray, end: f64::INFINITY }).collect();
    let (mut tile, mut scratch) = (RayTile::default(), Scratch::default());
    let mut hits = vec![None; RAYS];
    bencher.counter(ItemsCount::new(RAYS)).bench_local(|| {
        shot.tracer.first_hits_into(&rays, Backend::best(), &mut tile, &mut scratch, &mut hits);
        black_box(&hits);
    });
}

/// The same rays, each by itself.
#[divan::bench(args = NAMES, max_time = 2)]
fn one_by_one(bencher: Bencher, name: &str) {
    let shot = Shot::of(&solid(name), &TracerOptions::default());
    let rays = shot.all_rays();
    let mut scratch = Scratch::default();
    bencher.counter(ItemsCount::new(RAYS)).bench_local(|| {
        for ray in &rays {
            black_box(shot.tracer.first_hit_within(ray, f64::INFINITY, &mut scratch));
        }
    });
}

/// The walk through all cells of the root cube, nothing done in any. Rates are of cells.
#[divan::bench(args = TraversalKind::ALL.map(TraversalKind::name), max_time = 2)]
fn walking(bencher: Bencher, traversal: &str) {
    let traversal = traversal.parse().expect("it is one of all");
    let shot = Shot::of(&solid("swiss-1000"), &TracerOptions { traversal, ..TracerOptions::default() });
    let (octree, traversal) = shot.tracer.octrees().next().expect("one body has one octree");
    let mut rays = shot.all_rays();
    rays.retain(|ray| root_interval(octree, ray).is_some_and(|(t_in, t_out)| t_in < t_out));
    let walk = || {
        let mut cells = 0_u64;
        for ray in &rays {
            let Some((t_in, t_out)) = root_interval(octree, ray) else { continue };
            let _ = traversal.walk(octree, ray, t_in, t_out, |step| {
                black_box(step.t_out);
                cells += 1;
                ControlFlow::<()>::Continue(())
            });
        }
        cells
    };
    bencher.counter(ItemsCount::new(walk())).bench_local(walk);
}
