//! The pure walk: rays through the whole root cube, with nothing done in any cell. What one step of a traversal costs.

use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::stats::Stopwatch;
use octrace::octree::Octree;
use octrace::traverse::{Traversal, root_interval};
use octrace::{Ray, Tracer};
use std::hint::black_box;
use std::ops::ControlFlow;

/// Rays that meet an octree's root cube, and the interval in which they are in it.
struct Way<'a> {
    octree: &'a Octree,
    traversal: &'a Traversal,
    rays: Vec<(Ray, f64, f64)>,
}

/// What rays have before them in a tracer's octrees.
pub struct Ways<'a>(Vec<Way<'a>>);

/// What lies on these ways.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lengths {
    /// Rays that meet an octree.
    pub rays: u64,
    /// Cells of octrees.
    pub cells: u64,
    /// Cells of regular grids as fine as the octrees' smallest cells.
    pub grid_steps: u64,
}

impl<'a> Ways<'a> {
    /// The ways of the rays from where they start, or enter, to where they leave.
    pub fn new<'r>(tracer: &'a Tracer, rays: impl Iterator<Item = &'r Ray> + Clone) -> Self {
        let way = |(octree, traversal)| {
            let inside = |ray: &Ray| {
                let (t_in, t_out) = root_interval(octree, ray)?;
                let t_in = t_in.max(0.0);
                (t_in < t_out).then_some((*ray, t_in, t_out))
            };
            Way { octree, traversal, rays: rays.clone().filter_map(inside).collect() }
        };
        Self(tracer.octrees().map(way).collect())
    }

    /// Counts what lies on them.
    pub fn lengths(&self) -> Lengths {
        let mut lengths = Lengths::default();
        for way in &self.0 {
            lengths.rays += way.rays.len() as u64;
            lengths.cells += way.rays.iter().map(|ray| way.cells(ray)).sum::<u64>();
            lengths.grid_steps += way.rays.iter().map(|ray| way.grid_steps(ray)).sum::<u64>();
        }
        lengths
    }

    /// How long walking them takes, in seconds.
    pub fn time(&self, interrupt: &Interrupt) -> Result<f64, Failure> {
        let watch = Stopwatch::start();
        for way in &self.0 {
            for ray in &way.rays {
                if interrupt.happened() {
                    return Err(Failure::Interrupted);
                }
                black_box(way.cells(ray));
            }
        }
        Ok(watch.elapsed())
    }
}

impl Way<'_> {
    fn cells(&self, &(ray, t_in, t_out): &(Ray, f64, f64)) -> u64 {
        let mut cells = 0;
        let _ = self.traversal.walk(self.octree, &ray, t_in, t_out, |step| {
            black_box(step.t_out);
            cells += 1;
            ControlFlow::<()>::Continue(())
        });
        cells
    }

    /// One, and one for each plane between cells that is passed.
    fn grid_steps(&self, &(ray, t_in, t_out): &(Ray, f64, f64)) -> u64 {
        let bounds = self.octree.bounds();
        let size = f64::from(1_u32 << self.octree.depth());
        let (from, to) = (ray.at(t_in), ray.at(t_out));
        let planes = (0..3).map(|axis| {
            let unit = (bounds.max[axis] - bounds.min[axis]) / size;
            let index = |at: f64| ((at - bounds.min[axis]) / unit).floor().clamp(0.0, size - 1.0);
            (index(to[axis]) - index(from[axis])).abs() as u64
        });
        1 + planes.sum::<u64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::exec::Exec;
    use octrace::model::families::balls;
    use octrace::octree::BuildOptions;
    use octrace::{TracerOptions, Vec3};

    #[test]
    fn a_complete_octree_has_a_grids_steps() {
        // With more balls than a leaf may hold in every cell, all eight cells are leaves: no smaller ones are allowed.
        let octree = BuildOptions { leaf_surfaces: 1, depth: Some(1) };
        let options = TracerOptions { octree, ..TracerOptions::default() };
        let tracer = Tracer::build(&balls(1_000), &options, &Exec::with_threads(1)).unwrap();
        let center = tracer.octrees().next().unwrap().0.bounds().center();
        let along = |direction: Vec3, aside: Vec3| Ray { origin: center - direction * 100.0 + aside, direction };
        let aside = Vec3::new(0.3, 0.2, 0.1);
        let rays = [along(Vec3::X, aside), along(Vec3::new(1.0, 1.0, 0.1), aside), along(Vec3::X, Vec3::Y * 1e3)];
        let lengths = Ways::new(&tracer, rays.iter()).lengths();
        assert_eq!(lengths, Lengths { rays: 2, cells: 6, grid_steps: 6 });
    }
}
