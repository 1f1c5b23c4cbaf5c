//! One body of a tracer: its program, its octree, and what they say of a ray.
//!
//! With an octree a ray marches through cells. Should two cells contradict each other (a *leak*, never seen in tests), the
//! ray is traced canonically and counted: whoever asks gets the right answer in any case.

use super::canonical::ends;
use super::march::{March, Stop};
use super::options::{Accel, TracerOptions};
use super::prepared::Prepared;
use super::{Scratch, canonical};
use crate::compile::{Catalog, Constant, Program, Simplified, Simplifier};
use crate::exec::{Cancelled, Exec, with_stack_for};
use crate::geom::{Bounds, Hit, Ray, Span, Spans, SpansBuilder};
use crate::octree::{Octree, build};
use crate::surface::{CellBox, Side};
use crate::traverse::{Step, Traversal, TraversalKind, root_interval};
use std::ops::ControlFlow;
use std::sync::Arc;

/// A compiled body. Rays come *prepared*, see [`super::prepared`].
#[derive(Debug)]
pub(super) struct Body {
    pub program: Program,
    /// The octree, and how it is walked; `None` without acceleration, and where nothing is bounded.
    octree: Option<(Octree, Traversal)>,
    accel: Accel,
    /// How deep the program is nested.
    nesting: usize,
    /// The solids that stand in many places, as bodies of their own.
    prototypes: Arc<[Body]>,
}

impl Body {
    /// Of what is not bounded, only what is in the `room` is accelerated.
    ///
    /// # Errors
    /// If `exec` is cancelled.
    pub fn build(
        program: Program,
        room: &Bounds,
        prototypes: &Arc<[Body]>,
        catalog: &Catalog,
        options: &TracerOptions,
        exec: &Exec,
    ) -> Result<Self, Cancelled> {
        let octree = match options.accel {
            Accel::None => None,
            Accel::Octree => {
                let octree = build(catalog, &program, room, &options.octree, options.traversal.max_depth(), exec)?;
                octree.map(|octree| {
                    let traversal = Traversal::new(options.traversal, &octree);
                    (octree, traversal)
                })
            }
        };
        let nesting = program.nesting();
        Ok(Self { program, octree, accel: options.accel, nesting, prototypes: Arc::clone(prototypes) })
    }

    /// The solids that stand in many places.
    pub fn prototypes(&self) -> &[Body] {
        &self.prototypes
    }

    /// Whether rays walk an octree in the usual way.
    pub fn is_walked_by_default(&self) -> bool {
        self.octree.as_ref().is_some_and(|(_, traversal)| traversal.kind() == TraversalKind::default())
    }

    /// The octree, if there is one.
    pub fn octree(&self) -> Option<&Octree> {
        self.octree_and_traversal().map(|(octree, _)| octree)
    }

    /// The octree and how it is walked, if there is one.
    pub fn octree_and_traversal(&self) -> Option<(&Octree, &Traversal)> {
        self.octree.as_ref().map(|(octree, traversal)| (octree, traversal))
    }

    /// The first crossing of the body's surface at `start < t <= end`.
    pub fn first_hit(
        &self,
        catalog: &Catalog,
        ray: &Prepared,
        (start, end): (f64, f64),
        scratch: &mut Scratch,
    ) -> Option<Hit> {
        match self.crossings(catalog, ray, (start, end), scratch, ControlFlow::Break) {
            ControlFlow::Continue(()) => None,
            ControlFlow::Break(Stop::Done(hit)) => Some(hit),
            ControlFlow::Break(Stop::Leak) => {
                ends(self.canonical_spans(catalog, ray)).find(|hit| start < hit.t && hit.t <= end)
            }
        }
    }

    /// Whether the ray's origin is inside.
    pub fn contains_origin(&self, catalog: &Catalog, ray: &Prepared, scratch: &mut Scratch) -> bool {
        let start = ray.inner(0.0);
        match self.crossings(catalog, ray, (start, f64::INFINITY), scratch, ControlFlow::Break) {
            // Nothing is crossed on the way to infinity: there it is what it is everywhere on the ray.
            ControlFlow::Continue(()) => self.ends_inside(catalog, ray),
            ControlFlow::Break(Stop::Done(hit)) => !hit.entering,
            ControlFlow::Break(Stop::Leak) => {
                self.canonical_spans(catalog, ray).iter().any(|span| span.enter_t() <= start && start < span.exit_t())
            }
        }
    }

    /// The spans of the ray's whole line.
    pub fn spans(&self, catalog: &Catalog, ray: &Prepared, scratch: &mut Scratch) -> Spans {
        let mut spans: Option<SpansBuilder> = None;
        let stop: ControlFlow<Stop<()>> =
            self.crossings(catalog, ray, (f64::NEG_INFINITY, f64::INFINITY), scratch, |hit| {
                spans.get_or_insert_with(|| SpansBuilder::new(!hit.entering)).cross(hit);
                ControlFlow::Continue(())
            });
        match (stop, spans) {
            (ControlFlow::Break(_), _) => self.canonical_spans(catalog, ray),
            (ControlFlow::Continue(()), Some(spans)) => spans.finish(),
            (ControlFlow::Continue(()), None) if self.ends_inside(catalog, ray) => {
                vec![Span { enter: None, exit: None }]
            }
            (ControlFlow::Continue(()), None) => Spans::new(),
        }
    }

    /// The spans of the whole line, without the octree.
    fn canonical_spans(&self, catalog: &Catalog, ray: &Prepared) -> Spans {
        let program = if ray.passes_by { &self.program.outer } else { &self.program.whole };
        with_stack_for(self.nesting, || canonical::spans(catalog, program, &ray.ray))
    }

    /// Whether the line ends inside, far away from everything bounded. (Nearer, the outer program may have crossings that
    /// the solid has not.)
    fn ends_inside(&self, catalog: &Catalog, ray: &Prepared) -> bool {
        let outer = with_stack_for(self.nesting, || canonical::spans(catalog, &self.program.outer, &ray.ray));
        outer.last().is_some_and(|span| span.exit.is_none())
    }

    /// Shows `on_hit` the crossings after `start` up to `end`, by the acceleration chosen.
    fn crossings<B>(
        &self,
        catalog: &Catalog,
        ray: &Prepared,
        (start, end): (f64, f64),
        scratch: &mut Scratch,
        mut on_hit: impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<Stop<B>> {
        if self.accel == Accel::None || ray.passes_by {
            scratch.counters.surface_tests += catalog.literals.len() as u64;
            for hit in ends(self.canonical_spans(catalog, ray)).filter(|hit| start < hit.t && hit.t <= end) {
                if let ControlFlow::Break(done) = on_hit(hit) {
                    return ControlFlow::Break(Stop::Done(done));
                }
            }
            return ControlFlow::Continue(());
        }
        let mut march = March::new(catalog, &self.prototypes, &ray.ray, scratch);
        let stop = march.along(&self.program, self.octree_and_traversal(), (start, end), on_hit);
        if let ControlFlow::Break(Stop::Leak) = stop {
            scratch.counters.leaks += 1;
        }
        stop
    }

    /// Shows `visit` the cells that the ray meets from `start` on; none where there is no octree.
    pub fn visit_cells(&self, ray: &Ray, start: f64, mut visit: impl FnMut(Step<'_>)) {
        let Some((octree, traversal)) = &self.octree else { return };
        let Some((root_in, root_out)) = root_interval(octree, ray) else { return };
        let t_in = root_in.max(start);
        if t_in <= root_out {
            let _ = traversal.walk(octree, ray, t_in, root_out, |step| {
                visit(step);
                ControlFlow::<()>::Continue(())
            });
        }
    }

    /// Where a box lies with respect to the body; `Crossing` may be either.
    pub fn classify(&self, catalog: &Catalog, cell: &CellBox) -> Side {
        let words = match &self.program.whole {
            Constant::Everywhere(true) => return Side::Inside,
            Constant::Everywhere(false) => return Side::Outside,
            Constant::Words(words) => words,
        };
        match Simplifier::default().simplify(catalog, words, cell, &mut Vec::new()) {
            Simplified::Constant(true) => Side::Inside,
            Simplified::Constant(false) => Side::Outside,
            Simplified::Reduced => Side::Crossing,
        }
    }
}
