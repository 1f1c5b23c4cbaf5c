//! From text to scene: how many bytes a second? `cargo bench -p octrace-read`; rates are of bytes.

use divan::Bencher;
use divan::counter::BytesCount;
use octrace_read::{ReadOptions, Source, read_scene, syntax};
use std::fmt::Write;

fn main() {
    divan::main();
}

const NAMES: [&str; 2] = ["balls", "dump"];

/// A thousand holes in a block: as written by hand, or as OpenSCAD dumps it.
fn source(name: &str) -> Source {
    let mut text = String::from("difference() {\n\tcube(size = [40, 30, 5], center = false);\n");
    for i in 0..1_000 {
        let (x, y) = (f64::from(i % 40) + 0.123_456, f64::from(i / 40) + 0.5);
        let written = match name {
            "balls" => writeln!(text, "\ttranslate([{x}, {y}, 2.5]) sphere(r = 0.4);"),
            _ => writeln!(
                text,
                "\tmultmatrix([[1, 0, 0, {x:.5}], [0, 1, 0, {y}], [0, 0, 1, -1], [0, 0, 0, 1]]) {{\n\
                 \t\tcylinder($fn = 0, $fa = 12, $fs = 2, h = 7, r1 = 0.4, r2 = 0.4, center = false);\n\t}}"
            ),
        };
        written.expect("strings take all");
    }
    Source::new("bench.csg", text + "}\n")
}

/// Text becomes a tree of nodes.
#[divan::bench(args = NAMES, max_time = 2)]
fn parsing(bencher: Bencher, name: &str) {
    let source = source(name);
    bencher.counter(BytesCount::of_str(source.text())).bench_local(|| syntax::parse(&source));
}

/// The same, and the nodes get their meaning.
#[divan::bench(args = NAMES, max_time = 2)]
fn reading(bencher: Bencher, name: &str) {
    let source = source(name);
    let options = ReadOptions::default();
    bencher.counter(BytesCount::of_str(source.text())).bench_local(|| read_scene(&source, &options));
}
