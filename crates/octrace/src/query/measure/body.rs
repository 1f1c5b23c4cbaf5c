//! What measuring asks of a solid.

use crate::geom::{Bounds, Ray};
use crate::surface::Side;
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

    /// A box around it, not necessarily tight.
    fn bounds(&self) -> Bounds;

    /// Replaces `chords` by those of the whole line, ascending and disjoint.
    fn chords(&self, ray: &Ray, scratch: &mut Self::Scratch, chords: &mut Vec<Chord>);

    /// Whether nothing of the solid is in the box, for sure.
    fn is_outside(&self, bounds: &Bounds) -> bool;
}

impl Body for Tracer {
    type Scratch = Scratch;

    fn bounds(&self) -> Bounds {
        self.bounds()
    }

    fn chords(&self, ray: &Ray, scratch: &mut Scratch, chords: &mut Vec<Chord>) {
        chords.clear();
        let spans = self.spans_with(ray, scratch);
        chords.extend(spans.iter().map(|s| Chord { start: s.enter_t(), end: s.exit_t() }));
    }

    fn is_outside(&self, bounds: &Bounds) -> bool {
        self.classify_box(bounds) == Side::Outside
    }
}
