//! From the tree to the tracer: what does a primitive cost?

use crate::scenes::{NAMES, exec, solid};
use divan::Bencher;
use divan::counter::ItemsCount;
use octrace::compile::{Copies, compile};
use octrace::{Tracer, TracerOptions};

fn primitives(name: &str) -> ItemsCount {
    ItemsCount::new(compile(&[solid(name)], 0.0, Copies::Shared).catalog.leaves.len())
}

/// The tree becomes a program.
#[divan::bench(args = NAMES, max_time = 2)]
fn compiling(bencher: Bencher, name: &str) {
    let bodies = [solid(name)];
    bencher.counter(primitives(name)).bench_local(|| compile(&bodies, 0.0, Copies::Shared));
}

/// The same, and the program is cut up in an octree.
#[divan::bench(args = NAMES, max_time = 2, sample_count = 10)]
fn building(bencher: Bencher, name: &str) {
    let solid = solid(name);
    let options = TracerOptions::default();
    bencher.counter(primitives(name)).bench_local(|| Tracer::build(&solid, &options, &exec()));
}
