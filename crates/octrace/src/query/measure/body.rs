//! What measuring asks of a solid.

use crate::compile::{Constant, Simplified, Simplifier};
use crate::geom::{Bounds, Ray};
use crate::surface::CellBox;
use crate::trace::{Scratch, Tracer};

/// A stretch of a ray inside a solid, as parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Chord {
    pub start: f64,
    pub end: f64,
}

/// A bounded solid that can be measured: a [`Tracer`], and the analytic solids of the tests.
pub(super) trait Body: Sync {
    /// Memory of one worker.
    type Scratch: Default;
    /// What is known of it in a box.
    type Region;

    /// A box around it, not necessarily tight.
    fn bounds(&self) -> Bounds;

    /// Replaces `chords` by those of the whole line, ascending and disjoint.
    fn chords(&self, ray: &Ray, scratch: &mut Self::Scratch, chords: &mut Vec<Chord>);

    /// What is known of the solid everywhere.
    fn whole(&self) -> Self::Region;

    /// What is known of the solid in a box, by what is known in a box around it; `None` if for sure nothing of the solid
    /// is there.
    fn narrow(&self, around: &Self::Region, bounds: &Bounds) -> Option<Self::Region>;
}

impl Body for Tracer {
    type Scratch = Scratch;
    type Region = Programs;

    fn bounds(&self) -> Bounds {
        self.bounds()
    }

    fn chords(&self, ray: &Ray, scratch: &mut Scratch, chords: &mut Vec<Chord>) {
        chords.clear();
        let spans = self.spans_with(ray, scratch);
        chords.extend(spans.iter().map(|s| Chord { start: s.enter_t(), end: s.exit_t() }));
    }

    fn whole(&self) -> Programs {
        Programs(self.programs().cloned().collect())
    }

    fn narrow(&self, around: &Programs, bounds: &Bounds) -> Option<Programs> {
        let cell = CellBox::new(bounds.center(), bounds.size() * 0.5);
        let mut simplifier = Simplifier::default();
        let mut left = Vec::new();
        for program in &around.0 {
            let Constant::Words(words) = program else {
                left.push(program.clone());
                continue;
            };
            let mut reduced = Vec::new();
            match simplifier.simplify(self.catalog(), words, &cell, &mut reduced) {
                Simplified::Constant(false) => {}
                Simplified::Constant(true) => left.push(Constant::Everywhere(true)),
                Simplified::Reduced => left.push(Constant::Words(reduced.into())),
            }
        }
        left.retain(|program| *program != Constant::Everywhere(false));
        (!left.is_empty()).then_some(Programs(left))
    }
}

/// What is left of a tracer's programs in a box: those of bodies that are not empty there.
pub(super) struct Programs(Vec<Constant>);
