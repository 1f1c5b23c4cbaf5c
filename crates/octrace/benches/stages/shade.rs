//! Light: points and normals of hits, and whole frames.

use crate::scenes::{NAMES, RAYS, SIZE_PX, Shot, exec, solid};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use octrace::film::{Background, View, render};
use octrace::{Scene, TracerOptions};

/// Position and normal at every hit of a picture. Rates are of hits.
#[divan::bench(args = NAMES, max_time = 1)]
fn surface_points(bencher: Bencher, name: &str) {
    let shot = Shot::of(&solid(name), &TracerOptions::default());
    let hits: Vec<_> =
        shot.all_rays().into_iter().filter_map(|ray| Some((ray, shot.tracer.first_hit(&ray)?))).collect();
    bencher.counter(ItemsCount::new(hits.len())).bench_local(|| {
        for (ray, hit) in &hits {
            black_box(shot.tracer.surface_point(ray, hit));
        }
    });
}

/// A frame under the default lights, with shadows. Rates are of pixels.
#[divan::bench(args = NAMES, max_time = 2, sample_count = 10)]
fn frames(bencher: Bencher, name: &str) {
    let solid = solid(name);
    let shot = Shot::of(&solid, &TracerOptions::default());
    let scene = Scene::new(solid);
    let view = View {
        camera: shot.camera,
        width_px: SIZE_PX.0 as u32,
        height_px: SIZE_PX.1 as u32,
        samples: 1,
        max_bounces: 8,
        background: Background::Scene,
    };
    bencher.counter(ItemsCount::new(RAYS)).bench_local(|| render(&scene, &shot.tracer, &view, &exec()));
}
