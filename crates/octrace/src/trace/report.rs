//! One ray explained.

use super::prepared::Prepared;
use super::{SurfacePoint, Tracer};
use crate::compile::{Constant, program_text};
use crate::geom::{Bounds, Hit, Ray, Spans, Vec3};
use crate::octree::Cell;
use std::fmt;

/// A cell on a ray's way.
#[derive(Clone, Debug, PartialEq)]
pub struct VisitedCell {
    /// Whose octree it belongs to.
    pub body: usize,
    /// Where the ray enters it.
    pub t_in: f64,
    /// Where the ray leaves it.
    pub t_out: f64,
    /// The cell.
    pub bounds: Bounds,
    /// What is left of the program in it, for people to read.
    pub program: String,
}

/// Everything that happens to one ray.
#[derive(Clone, Debug, PartialEq)]
pub struct RayReport {
    /// The ray.
    pub ray: Ray,
    /// The cells that it meets from `t = 0` on, in order.
    pub cells: Vec<VisitedCell>,
    /// The spans of its whole line.
    pub spans: Spans,
    /// The first hit from `t = 0` on, and what is there.
    pub hit: Option<(Hit, SurfacePoint)>,
}

impl Tracer {
    /// Everything that happens to one ray.
    pub fn explain(&self, ray: &Ray) -> RayReport {
        let prepared = Prepared::new(ray, &self.bounds());
        let mut cells = Vec::new();
        for (number, body) in self.bodies.iter().enumerate() {
            body.visit_cells(&prepared.ray, prepared.inner(0.0), |step| {
                let program = match step.cell {
                    Cell::Leaf(words) => Constant::Words(words.into()),
                    Cell::Inside => Constant::Everywhere(true),
                    Cell::Outside => Constant::Everywhere(false),
                };
                let half = Vec3::splat(step.half);
                cells.push(VisitedCell {
                    body: number,
                    t_in: prepared.outer(step.t_in),
                    t_out: prepared.outer(step.t_out),
                    bounds: Bounds::new(step.center - half, step.center + half),
                    program: program_text(&self.catalog, &program),
                });
            });
        }
        let hit = self.first_hit(ray);
        RayReport { ray: *ray, cells, spans: self.spans(ray), hit: hit.map(|hit| (hit, self.surface_point(ray, &hit))) }
    }
}

impl fmt::Display for RayReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [ox, oy, oz] = self.ray.origin.to_array();
        let [dx, dy, dz] = self.ray.direction.to_array();
        writeln!(f, "ray from {ox} {oy} {oz} along {dx} {dy} {dz}")?;
        writeln!(f, "cells:{}", if self.cells.is_empty() { " none" } else { "" })?;
        for cell in &self.cells {
            let size = cell.bounds.size().x;
            let c = cell.bounds.center();
            writeln!(
                f,
                "  t {:.6} to {:.6}: cell of size {size:.6} about {:.6} {:.6} {:.6}",
                cell.t_in, cell.t_out, c.x, c.y, c.z
            )?;
            for line in cell.program.lines() {
                writeln!(f, "    {line}")?;
            }
        }
        writeln!(f, "spans:{}", if self.spans.is_empty() { " none" } else { "" })?;
        let end = |f: &mut fmt::Formatter<'_>, hit: &Option<Hit>, none: &str| match hit {
            Some(hit) => write!(f, "{} (surface {}, leaf {})", hit.t, hit.surface, hit.leaf),
            None => f.write_str(none),
        };
        for span in &self.spans {
            f.write_str("  ")?;
            end(f, &span.enter, "-inf")?;
            f.write_str(" to ")?;
            end(f, &span.exit, "inf")?;
            writeln!(f)?;
        }
        match &self.hit {
            None => writeln!(f, "no hit"),
            Some((hit, point)) => {
                let (p, n) = (point.position, point.normal);
                writeln!(f, "hit at t {}: surface {}, leaf {}", hit.t, hit.surface, hit.leaf)?;
                writeln!(f, "  point {} {} {}", p.x, p.y, p.z)?;
                writeln!(f, "  normal {} {} {}", n.x, n.y, n.z)
            }
        }
    }
}
