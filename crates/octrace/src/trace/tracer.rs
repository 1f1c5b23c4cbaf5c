//! The tracer: a compiled scene that answers rays.

use super::canonical;
use super::combine::combine;
use super::march::{March, Stop};
use super::prepared::Prepared;
use super::report::{RayReport, VisitedCell};
use super::roots::Roots;
use crate::compile::{Catalog, CompileReport, Constant, Program, compile, program_text};
use crate::exec::{Cancelled, Exec, with_stack_for};
use crate::geom::{Bounds, Hit, Ray, Span, Spans, Vec3};
use crate::model::{PartId, Solid};
use crate::octree::{BuildOptions, Octree, OctreeStats, build};
use crate::surface::Side;
use crate::traverse::TraversalKind;
use std::fmt;
use std::ops::ControlFlow;
use std::str::FromStr;

/// Whether rays are accelerated. It never changes an answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Accel {
    /// Not at all: the canonical tracer [Comba-Persiano, §2.2].
    None,
    /// By the octree-CSG [Comba-Persiano, §3].
    #[default]
    Octree,
}

/// A name that is no acceleration's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no acceleration is called `{0}`")]
pub struct UnknownAccel(String);

impl FromStr for Accel {
    type Err = UnknownAccel;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name {
            "none" => Ok(Self::None),
            "octree" => Ok(Self::Octree),
            other => Err(UnknownAccel(other.into())),
        }
    }
}

impl fmt::Display for Accel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::None => "none",
            Self::Octree => "octree",
        })
    }
}

/// How a tracer is built. Of these only [`snap`](Self::snap) changes what is traced.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TracerOptions {
    /// Whether and how rays are accelerated.
    pub accel: Accel,
    /// How the octree is walked.
    pub traversal: TraversalKind,
    /// When to stop cutting cells.
    pub octree: BuildOptions,
    /// Import tolerance, relative to the size of everything bounded; see [`Scene::snap`](crate::model::Scene::snap).
    pub snap: f64,
}

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

/// Scratch memory of a worker, and what it counted.
#[derive(Debug, Default)]
pub struct Scratch {
    roots: Roots,
    /// What was counted since the scratch was made.
    pub counters: Counters,
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

/// What is where a ray hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The point.
    pub position: Vec3,
    /// The finished solid's outward unit normal; against the ray at a cone's very apex.
    pub normal: Vec3,
    /// The part that the surface belongs to, if to any.
    pub part: Option<PartId>,
}

/// A compiled solid that answers rays: immutable, shareable between threads.
///
/// A tracer can hold several *bodies* that share space, glass with something inside for example. They are compiled
/// together, so that coincident faces of different bodies are known to coincide; each keeps its own boundary. Questions
/// that name no body ask the union of all.
#[derive(Debug)]
pub struct Tracer {
    catalog: Catalog,
    bodies: Vec<Body>,
    options: TracerOptions,
    report: CompileReport,
    bounds: Bounds,
}

#[derive(Debug)]
struct Body {
    program: Program,
    octree: Option<Octree>,
    /// How deep the program is nested.
    nesting: usize,
}

impl Body {
    /// The spans of the whole line, without the octree.
    fn canonical_spans(&self, catalog: &Catalog, prepared: &Prepared) -> Spans {
        let program = if prepared.passes_by { &self.program.outer } else { &self.program.whole };
        with_stack_for(self.nesting, || canonical::spans(catalog, program, &prepared.ray))
    }

    /// Whether the line ends inside, far away from everything bounded. (Nearer, the outer program may have crossings that
    /// the solid has not.)
    fn ends_inside(&self, catalog: &Catalog, ray: &Ray) -> bool {
        let outer = with_stack_for(self.nesting, || canonical::spans(catalog, &self.program.outer, ray));
        outer.last().is_some_and(|span| span.exit.is_none())
    }
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
        let compiled = compile(bodies, options.snap);
        let bounds = compiled.bodies.iter().fold(Bounds::EMPTY, |all, body| all.union(body.bounds));
        let catalog = compiled.catalog;
        let build_octree = |program: &Program| match options.accel {
            Accel::None => Ok(None),
            Accel::Octree => exec.install(|| build(&catalog, program, &options.octree, exec)),
        };
        let bodies = compiled
            .bodies
            .into_iter()
            .map(|program| Ok(Body { octree: build_octree(&program)?, nesting: program.nesting(), program }))
            .collect::<Result<_, Cancelled>>()?;
        Ok(Self { catalog, bodies, options: *options, report: compiled.report, bounds })
    }

    /// How many bodies there are.
    pub fn bodies(&self) -> usize {
        self.bodies.len()
    }

    /// Where the ray first crosses the solid's surface, at `t > 0`: into it or, from inside, out of it.
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
        let mut first: Option<(usize, Hit)> = None;
        for body in 0..self.bodies.len() {
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
        let hit = match self.accelerated(body, &prepared, (start, end), scratch, ControlFlow::Break) {
            ControlFlow::Continue(()) => None,
            ControlFlow::Break(Stop::Done(hit)) => Some(hit),
            ControlFlow::Break(Stop::Leak) => self.bodies[body]
                .canonical_spans(&self.catalog, &prepared)
                .into_iter()
                .flat_map(|span| [span.enter, span.exit])
                .flatten()
                .find(|hit| start < hit.t && hit.t <= end),
        };
        hit.and_then(|hit| prepared.outer_hit(hit))
    }

    /// Whether the point is in the solid. Points of the surface are in or out as half-open intervals have it.
    pub fn contains(&self, point: Vec3) -> bool {
        (0..self.bodies.len()).any(|body| self.body_contains(body, point, &mut Scratch::default()))
    }

    /// Whether the point is in one body.
    pub fn body_contains(&self, body: usize, point: Vec3, scratch: &mut Scratch) -> bool {
        // A direction that no face is likely to contain.
        let ray = Ray { origin: point, direction: Vec3::new(0.5773, 0.5131, 0.6351) };
        let prepared = Prepared::new(&ray, &self.bounds);
        let start = prepared.inner(0.0);
        match self.accelerated(body, &prepared, (start, f64::INFINITY), scratch, ControlFlow::Break) {
            ControlFlow::Continue(()) => {
                // Nothing is crossed on the way to infinity: there it is what it is everywhere on the ray.
                self.bodies[body].ends_inside(&self.catalog, &prepared.ray)
            }
            ControlFlow::Break(Stop::Done(hit)) => !hit.entering,
            ControlFlow::Break(Stop::Leak) => self.bodies[body]
                .canonical_spans(&self.catalog, &prepared)
                .iter()
                .any(|span| span.enter_t() <= start && start < span.exit_t()),
        }
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
        combine(false, &operands)
    }

    /// The spans of the ray's whole line in one body.
    pub fn body_spans(&self, body: usize, ray: &Ray, scratch: &mut Scratch) -> Spans {
        let prepared = Prepared::new(ray, &self.bounds);
        let mut hits = Vec::new();
        let stop: ControlFlow<Stop<()>> =
            self.accelerated(body, &prepared, (f64::NEG_INFINITY, f64::INFINITY), scratch, |hit| {
                hits.push(hit);
                ControlFlow::Continue(())
            });
        let spans = if stop.is_break() {
            self.bodies[body].canonical_spans(&self.catalog, &prepared)
        } else if hits.is_empty() {
            match self.bodies[body].ends_inside(&self.catalog, &prepared.ray) {
                true => vec![Span { enter: None, exit: None }],
                false => Spans::new(),
            }
        } else {
            spans_of(&hits)
        };
        prepared.outer_spans(spans)
    }

    /// Shows `on_hit` a body's crossings after `start` up to `end`, by the acceleration chosen.
    fn accelerated<B>(
        &self,
        body: usize,
        prepared: &Prepared,
        (start, end): (f64, f64),
        scratch: &mut Scratch,
        mut on_hit: impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<Stop<B>> {
        let Body { program, octree, nesting } = &self.bodies[body];
        let Scratch { roots, counters } = scratch;
        if self.options.accel == Accel::None || prepared.passes_by {
            counters.surface_tests += self.catalog.literals.len() as u64;
            for span in self.bodies[body].canonical_spans(&self.catalog, prepared) {
                for hit in [span.enter, span.exit].into_iter().flatten() {
                    if start < hit.t
                        && hit.t <= end
                        && let ControlFlow::Break(done) = on_hit(hit)
                    {
                        return ControlFlow::Break(Stop::Done(done));
                    }
                }
            }
            return ControlFlow::Continue(());
        }
        let mut march = March::new(&self.catalog, &prepared.ray, roots, counters);
        let traversal = self.options.traversal;
        let stop = with_stack_for(*nesting, || march.along(program, octree.as_ref(), traversal, (start, end), on_hit));
        if let ControlFlow::Break(Stop::Leak) = stop {
            counters.leaks += 1;
        }
        stop
    }

    /// Position, normal and part at a hit of this ray.
    pub fn surface_point(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let position = ray.at(hit.t);
        let gradient = self.catalog.surfaces[hit.surface as usize].gradient(position);
        let normal = match gradient.normalized() {
            Some(normal) if hit.flipped => -normal,
            Some(normal) => normal,
            None => {
                let against = -ray.direction.normalized().unwrap_or(Vec3::Z);
                if hit.entering { against } else { -against }
            }
        };
        SurfacePoint { position, normal, part: self.catalog.leaves[hit.leaf as usize].part }
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
        use crate::compile::{Simplified, Simplifier};
        use crate::surface::CellBox;
        let cell = CellBox { center: bounds.center(), half: bounds.size() * 0.5 };
        let mut result = Side::Outside;
        for body in &self.bodies {
            let side = match &body.program.whole {
                Constant::Everywhere(true) => Side::Inside,
                Constant::Everywhere(false) => Side::Outside,
                Constant::Words(words) => {
                    match Simplifier::default().simplify(&self.catalog, words, &cell, &mut Vec::new()) {
                        Simplified::Constant(true) => Side::Inside,
                        Simplified::Constant(false) => Side::Outside,
                        Simplified::Reduced => Side::Crossing,
                    }
                }
            };
            match side {
                Side::Inside => return Side::Inside,
                Side::Crossing => result = Side::Crossing,
                Side::Outside => {}
            }
        }
        result
    }

    /// What the programs refer to.
    pub(crate) fn catalog(&self) -> &Catalog {
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

    /// What the tracer is made of, in numbers.
    pub fn stats(&self) -> TracerStats {
        let octrees: Vec<OctreeStats> =
            self.bodies.iter().filter_map(|b| b.octree.as_ref()).map(Octree::stats).collect();
        let octree = octrees.into_iter().reduce(|a, b| OctreeStats {
            branches: a.branches + b.branches,
            leaves: a.leaves + b.leaves,
            outside: a.outside + b.outside,
            inside: a.inside + b.inside,
            depth: a.depth.max(b.depth),
            program_words: a.program_words + b.program_words,
            bytes: a.bytes + b.bytes,
            surfaces_classified: a.surfaces_classified + b.surfaces_classified,
        });
        TracerStats {
            bodies: self.bodies.len(),
            primitives: self.catalog.leaves.len(),
            surfaces: self.catalog.surfaces.len(),
            literals: self.catalog.literals.len(),
            octree,
        }
    }

    /// The program of each body for people to read.
    pub fn program_text(&self) -> String {
        self.bodies.iter().map(|body| program_text(&self.catalog, &body.program.whole)).collect()
    }

    /// Everything that happens to one ray.
    pub fn explain(&self, ray: &Ray) -> RayReport {
        let prepared = Prepared::new(ray, &self.bounds);
        let mut cells = Vec::new();
        for (body, Body { octree, .. }) in self.bodies.iter().enumerate() {
            let Some(octree) = octree else { continue };
            let Some((root_in, root_out)) = crate::traverse::root_interval(octree, &prepared.ray) else { continue };
            let t_in = root_in.max(prepared.inner(0.0));
            if t_in > root_out {
                continue;
            }
            let _ = self.options.traversal.walk(octree, &prepared.ray, t_in, root_out, |step| {
                let program = match step.cell {
                    crate::octree::Cell::Leaf(words) => program_text(&self.catalog, &Constant::Words(words.into())),
                    crate::octree::Cell::Inside => "everywhere\n".into(),
                    crate::octree::Cell::Outside => "nothing\n".into(),
                };
                let half = Vec3::splat(step.half);
                cells.push(VisitedCell {
                    body,
                    t_in: prepared.outer(step.t_in),
                    t_out: prepared.outer(step.t_out),
                    bounds: Bounds::new(step.center - half, step.center + half),
                    program,
                });
                ControlFlow::<()>::Continue(())
            });
        }
        let hit = self.first_hit(ray);
        RayReport { ray: *ray, cells, spans: self.spans(ray), hit: hit.map(|hit| (hit, self.surface_point(ray, &hit))) }
    }
}

fn spans_of(hits: &[Hit]) -> Spans {
    let mut spans = Spans::new();
    let mut enter = None;
    let mut open = hits.first().is_some_and(|hit| !hit.entering);
    for &hit in hits {
        if hit.entering {
            enter = Some(hit);
            open = true;
        } else {
            spans.push(Span { enter, exit: Some(hit) });
            enter = None;
            open = false;
        }
    }
    if open {
        spans.push(Span { enter, exit: None });
    }
    spans
}
