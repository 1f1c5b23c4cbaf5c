//! What is done in a leaf: a program that is not cut up at all, evaluated for every ray of a picture; by kind of machine.
//! Beside it, the crossings of single rays with single surfaces.

use crate::rays::draw;
use crate::scenes::{RAYS, Shot};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use octrace::model::families::classic;
use octrace::octree::BuildOptions;
use octrace::trace::Backend;
use octrace::{Solid, TracerOptions};

const NAMES: [&str; 4] = ["ball", "block", "cylinder", "classic"];

fn shot(name: &str) -> Shot {
    let solid = match name {
        "ball" => Solid::sphere(),
        "block" => Solid::block(),
        "cylinder" => Solid::cylinder(),
        _ => classic(),
    };
    let octree = BuildOptions { leaf_surfaces: 64, depth: Some(0) };
    Shot::of(&solid, &TracerOptions { octree, ..TracerOptions::default() })
}

fn draw_on(bencher: Bencher, name: &str, backend: Backend) {
    if backend.is_available() {
        draw(bencher, &shot(name), backend);
    }
}

/// One leaf, eight lanes in one register.
#[divan::bench(args = NAMES, max_time = 1)]
fn leaf_avx512(bencher: Bencher, name: &str) {
    draw_on(bencher, name, Backend::Avx512);
}

/// One leaf, eight lanes in two registers.
#[divan::bench(args = NAMES, max_time = 1)]
fn leaf_avx2(bencher: Bencher, name: &str) {
    draw_on(bencher, name, Backend::Avx2);
}

/// One leaf, for any machine.
#[divan::bench(args = NAMES, max_time = 1)]
fn leaf_portable(bencher: Bencher, name: &str) {
    draw_on(bencher, name, Backend::Portable);
}

/// All surfaces of a solid against single rays. Rates are of pairs.
#[divan::bench(args = NAMES, max_time = 1)]
fn crossings(bencher: Bencher, name: &str) {
    let shot = shot(name);
    let surfaces = &shot.tracer.catalog().surfaces;
    let rays = shot.all_rays();
    let mut params = Vec::new();
    bencher.counter(ItemsCount::new(RAYS * surfaces.len())).bench_local(|| {
        for ray in &rays {
            for surface in surfaces {
                params.clear();
                black_box(surface.crossings(surfaces, ray, &mut params));
            }
        }
    });
}
