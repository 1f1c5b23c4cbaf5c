//! What tracing took and what a tracer is made of, in numbers.

use super::Tracer;
use super::body::Body;
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
    /// Different surfaces.
    pub surfaces: usize,
    /// Uses of surfaces by primitives.
    pub literals: usize,
    /// The octrees, summed up; the depth is that of the deepest.
    pub octree: Option<OctreeStats>,
}

impl Tracer {
    /// What the tracer is made of, in numbers.
    pub fn stats(&self) -> TracerStats {
        let octrees = self.bodies.iter().filter_map(Body::octree).map(Octree::stats);
        TracerStats {
            bodies: self.bodies.len(),
            primitives: self.catalog.leaves.len(),
            surfaces: self.catalog.surfaces.len(),
            literals: self.catalog.literals.len(),
            octree: octrees.reduce(OctreeStats::and),
        }
    }
}
