//! What each stage costs, from the CSG tree to light: compiling, building, tiles of rays, single rays, walking, the kernels
//! in leaves, shading. One question a file. Reading is measured in `octrace-read`.
//!
//! `cargo bench -p octrace` runs all; `cargo bench -p octrace -- tiles` what has that in its name. Rates are of primitives or
//! rays; one thread. For a whole program's figures beside what the machine could do, see `octrace bench`; for settings and
//! traversals side by side, `octrace study`.

mod build;
mod kernels;
mod rays;
mod scenes;
mod shade;

fn main() {
    divan::main();
}
