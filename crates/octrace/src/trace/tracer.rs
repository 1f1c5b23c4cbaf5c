//! The tracer: a compiled scene that answers rays.

use super::body::Body;
use super::combine::combine;
use super::options::TracerOptions;
use super::prepared::Prepared;
use super::roots::Roots;
use super::stats::Counters;
use super::sweep::Sweep;
use crate::compile::{Catalog, CompileReport, Constant, Op, compile_unless_cancelled, program_text};
use crate::exec::{Cancelled, Exec};
use crate::geom::{Bounds, Hit, Ray, Spans, Vec3};
use crate::model::{PartId, Solid};
use crate::octree::Octree;
use crate::surface::{CellBox, Side, Surface};
use crate::traverse::Traversal;
use std::ops::Range;
use std::sync::Arc;

/// Scratch memory of a worker, and what it counted.
#[derive(Debug, Default)]
pub struct Scratch {
    pub(super) roots: Roots,
    pub(super) sweep: Sweep,
    /// What was counted since the scratch was made.
    pub counters: Counters,
}

/// What is where a ray hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The point.
    pub position: Vec3,
    /// The finished solid's outward unit normal; against the ray at a cone's very apex.
    pub normal: Vec3,
    /// How far rounding may have put the point off the surface: see [`Surface::rounding`].
    pub rounding: f64,
    /// The part that the surface belongs to, if to any.
    pub part: Option<PartId>,
}

/// A compiled solid that answers rays: immutable, shareable between threads.
///
/// A tracer can hold several *bodies* that share space, glass with something inside for example. They are compiled
/// together, so that coincident faces of different bodies are known to coincide; each keeps its own boundary. Of questions
/// that name no body, hits are those of any body's surface, also inside another body; all others ask the union.
#[derive(Debug)]
pub struct Tracer {
    pub(super) catalog: Catalog,
    pub(super) bodies: Vec<Body>,
    /// Whether all surfaces are planes and quadrics; those of solids that stand in many places too.
    pub(super) only_plain: bool,
    report: CompileReport,
    bounds: Bounds,
}

impl Tracer {
    /// Compiles one solid.
    ///
    /// # Errors
    /// If `exec` is cancelled.
    pub fn build(solid: &Solid, options: &TracerOptions, exec: &Exec) -> Result<Self, Cancelled> {
        Self::build_bodies(std::slice::from_ref(solid), options, exec)
    }

    /// Compiles several bodies together.
    ///
    /// # Errors
    /// If `exec` is cancelled.
    pub fn build_bodies(bodies: &[Solid], options: &TracerOptions, exec: &Exec) -> Result<Self, Cancelled> {
        exec.install(|| Self::build_here(bodies, options, exec))
    }

    /// As [`build_bodies`](Self::build_bodies), with the threads that are there.
    fn build_here(bodies: &[Solid], options: &TracerOptions, exec: &Exec) -> Result<Self, Cancelled> {
        let compiled = compile_unless_cancelled(bodies, options.snap, options.copies, &exec.cancel)?;
        let bounds = compiled.bodies.iter().fold(Bounds::EMPTY, |all, body| all.union(body.bounds));
        let catalog = compiled.catalog;
        let none: Arc<[Body]> = Arc::new([]);
        let prototypes = catalog
            .prototypes
            .iter()
            .map(|prototype| &prototype.program)
            .map(|program| Body::build(program.clone(), &program.bounds, &none, &catalog, options, exec));
        let prototypes = prototypes.collect::<Result<Arc<[Body]>, Cancelled>>()?;
        let bodies = compiled
            .bodies
            .into_iter()
            .map(|program| {
                // A floor beside bounded things is accelerated where those are.
                let room = if program.bounds.is_empty() { bounds } else { program.bounds };
                Body::build(program, &room, &prototypes, &catalog, options, exec)
            })
            .collect::<Result<_, Cancelled>>()?;
        let only_plain =
            !catalog.surfaces.iter().any(|surface| matches!(surface, Surface::Torus(_) | Surface::Mesh(_)));
        Ok(Self { catalog, bodies, only_plain, report: compiled.report, bounds })
    }

    /// How many bodies there are.
    pub fn bodies(&self) -> usize {
        self.bodies.len()
    }

    /// Where the ray first crosses the solid's surface, at `t > 0`: into it or, from inside, out of it. Not at `t = 0`: a
    /// ray that starts on a surface leaves it. A ray along a face is on one side of it by the tie rule of half-open
    /// intervals; one that only touches crosses nothing.
    pub fn first_hit(&self, ray: &Ray) -> Option<Hit> {
        self.first_hit_within(ray, f64::INFINITY, &mut Scratch::default())
    }

    /// As [`first_hit`](Self::first_hit), up to and including `t = end`.
    pub fn first_hit_within(&self, ray: &Ray, end: f64, scratch: &mut Scratch) -> Option<Hit> {
        self.first_body_hit(ray, end, scratch).map(|(_, hit)| hit)
    }

    /// The first crossing of any body's surface at `0 < t <= end`, and which body's; the first body's where several are
    /// crossed at once.
    pub fn first_body_hit(&self, ray: &Ray, end: f64, scratch: &mut Scratch) -> Option<(usize, Hit)> {
        self.first_hit_of(0..self.bodies.len(), ray, end, scratch)
    }

    /// As [`first_body_hit`](Self::first_body_hit), of some bodies.
    pub(crate) fn first_hit_of(
        &self,
        bodies: Range<usize>,
        ray: &Ray,
        end: f64,
        scratch: &mut Scratch,
    ) -> Option<(usize, Hit)> {
        let mut first: Option<(usize, Hit)> = None;
        for body in bodies {
            let end = first.map_or(end, |(_, hit)| hit.t);
            let hit = self.body_hit(body, ray, end, scratch);
            if let Some(hit) = hit
                && first.is_none_or(|(_, other)| hit.t < other.t)
            {
                first = Some((body, hit));
            }
        }
        first
    }

    /// The first crossing of one body's surface at `0 < t <= end`.
    pub fn body_hit(&self, body: usize, ray: &Ray, end: f64, scratch: &mut Scratch) -> Option<Hit> {
        let prepared = Prepared::new(ray, &self.bounds);
        let (start, end) = (prepared.inner(0.0), prepared.inner(end));
        let hit = self.bodies[body].first_hit(&self.catalog, &prepared, (start, end), scratch);
        hit.and_then(|hit| prepared.outer_hit_ahead(hit))
    }

    /// Whether the point is in the solid. Points of the surface are in or out as half-open intervals have it.
    pub fn contains(&self, point: Vec3) -> bool {
        (0..self.bodies.len()).any(|body| self.body_contains(body, point, &mut Scratch::default()))
    }

    /// Whether the point is in one body.
    pub fn body_contains(&self, body: usize, point: Vec3, scratch: &mut Scratch) -> bool {
        // A direction that no face is likely to contain.
        let ray = Ray { origin: point, direction: Vec3::new(0.5773, 0.5131, 0.6351) };
        self.bodies[body].contains_origin(&self.catalog, &Prepared::new(&ray, &self.bounds), scratch)
    }

    /// The spans of the ray's whole line in the solid, from minus to plus infinity.
    pub fn spans(&self, ray: &Ray) -> Spans {
        self.spans_with(ray, &mut Scratch::default())
    }

    /// As [`spans`](Self::spans), with the worker's scratch memory.
    pub fn spans_with(&self, ray: &Ray, scratch: &mut Scratch) -> Spans {
        if let [_] = self.bodies[..] {
            return self.body_spans(0, ray, scratch);
        }
        let operands: Vec<Spans> = (0..self.bodies.len()).map(|body| self.body_spans(body, ray, scratch)).collect();
        combine(Op::Or, &operands)
    }

    /// The spans of the ray's whole line in one body.
    pub fn body_spans(&self, body: usize, ray: &Ray, scratch: &mut Scratch) -> Spans {
        let prepared = Prepared::new(ray, &self.bounds);
        prepared.outer_spans(self.bodies[body].spans(&self.catalog, &prepared, scratch))
    }

    /// Position, normal and part at a hit of this ray.
    pub fn surface_point(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let position = ray.at(hit.t);
        let (surface, offset) = self.catalog.surface(hit.surface);
        let local = Ray { origin: ray.origin - offset, ..*ray }.at(hit.t);
        let gradient = surface.gradient(local);
        let rounding = surface.rounding(local, ray.origin.abs() + (ray.direction * hit.t).abs());
        let normal = match gradient.normalized() {
            Some(normal) if hit.flipped => -normal,
            Some(normal) => normal,
            None => {
                let against = -ray.direction.normalized().unwrap_or(Vec3::Z);
                if hit.entering { against } else { -against }
            }
        };
        SurfacePoint { position, normal, rounding, part: self.catalog.leaves[hit.leaf as usize].part }
    }

    /// A box around everything that is bounded; empty where nothing is.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Whether the solid reaches outside [`bounds`](Self::bounds), as half-spaces do.
    pub fn is_unbounded(&self) -> bool {
        self.bodies.iter().any(|body| body.program.outer != Constant::Everywhere(false))
    }

    /// Where a box lies with respect to the solid. `Outside` and `Inside` are certain; `Crossing` may be either.
    pub fn classify_box(&self, bounds: &Bounds) -> Side {
        let cell = CellBox::new(bounds.center(), bounds.size() * 0.5);
        let mut result = Side::Outside;
        for body in &self.bodies {
            match body.classify(&self.catalog, &cell) {
                Side::Inside => return Side::Inside,
                Side::Crossing => result = Side::Crossing,
                Side::Outside => {}
            }
        }
        result
    }

    /// The octree of each body that has one, and how it is walked: for whoever wants to look at or to time the walk by
    /// itself.
    pub fn octrees(&self) -> impl Iterator<Item = (&Octree, &Traversal)> {
        self.bodies.iter().filter_map(Body::octree_and_traversal)
    }

    /// What the programs refer to.
    pub fn catalog(&self) -> &Catalog {
        &self.catalog
    }

    /// The program of each body.
    pub(crate) fn programs(&self) -> impl Iterator<Item = &Constant> {
        self.bodies.iter().map(|body| &body.program.whole)
    }

    /// What joining coincident surfaces did.
    pub fn compile_report(&self) -> &CompileReport {
        &self.report
    }

    /// The program of each body, and of each solid with copies, for people to read.
    pub fn program_text(&self) -> String {
        let bodies = self.bodies.iter().map(|body| program_text(&self.catalog, &body.program.whole));
        let solids = self.catalog.prototypes.iter().enumerate().map(|(number, prototype)| {
            let copies = prototype.copies;
            format!("solid {number}, {copies} copies\n{}", program_text(&self.catalog, &prototype.program.whole))
        });
        bodies.chain(solids).collect()
    }
}
