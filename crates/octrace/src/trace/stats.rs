//! What tracing took and what a tracer is made of, in numbers.

use super::Tracer;
use super::body::Body;
use crate::compile::Prototype;
use crate::octree::{Octree, OctreeStats};
use std::ops::AddAssign;

/// Counts of what was done, for statistics and tests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Octree cells visited.
    pub cells: u64,
    /// Words of programs evaluated: crossings of rays with surfaces, nearly.
    pub surface_tests: u64,
    /// Rays that had to be traced canonically since cells contradicted each other. Always zero, as far as anyone knows.
    pub leaks: u64,
}

impl AddAssign for Counters {
    fn add_assign(&mut self, o: Self) {
        let Self { cells, surface_tests, leaks } = o;
        self.cells += cells;
        self.surface_tests += surface_tests;
        self.leaks += leaks;
    }
}

/// What a tracer is made of, in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TracerStats {
    /// Bodies: one, and one more for each transparent material.
    pub bodies: usize,
    /// Primitives.
    pub primitives: usize,
    /// Copies of solids that are stored once.
    pub copies: usize,
    /// Different surfaces; those of copies count once.
    pub surfaces: usize,
    /// Uses of surfaces by primitives, those of copies too.
    pub literals: usize,
    /// The octrees, those of solids with copies too, summed up; the depth is that of the deepest.
    pub octree: Option<OctreeStats>,
}

impl Tracer {
    /// What the tracer is made of, in numbers.
    pub fn stats(&self) -> TracerStats {
        let prototypes = self.bodies.first().map_or(&[][..], Body::prototypes);
        let octrees = self.bodies.iter().chain(prototypes).filter_map(Body::octree).map(Octree::stats);
        let copies: u32 = self.catalog.prototypes.iter().map(|prototype| prototype.copies).sum();
        let more_literals = |prototype: &Prototype| prototype.literals() * (prototype.copies as usize - 1);
        let literals = self.catalog.literals.len() - copies as usize;
        TracerStats {
            bodies: self.bodies.len(),
            primitives: self.catalog.leaves.len(),
            copies: copies as usize,
            surfaces: self.catalog.surfaces.len() - copies as usize,
            literals: literals + self.catalog.prototypes.iter().map(more_literals).sum::<usize>(),
            octree: octrees.reduce(OctreeStats::and),
        }
    }
}
