//! What measuring asks of a solid.

use super::ceiling::ceiling;
use crate::compile::{Constant, Simplified, Simplifier};
use crate::geom::{Bounds, Ray, Vec3};
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

    /// The place of a box, in which that is known of the solid, that may be in the solid and is farthest along `up`, an axis
    /// or against one; `None` if for sure nothing of the solid is there. Nothing of the solid is farther.
    fn ceiling(&self, region: &Self::Region, bounds: &Bounds, up: Vec3) -> Option<Vec3>;
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
        let program = |words: &Constant| Local { words: words.clone(), offset: Vec3::ZERO };
        Programs(self.programs().map(program).collect())
    }

    fn narrow(&self, around: &Programs, bounds: &Bounds) -> Option<Programs> {
        let mut simplifier = Simplifier::default();
        let left: Vec<Local> =
            around.0.iter().filter_map(|local| local.narrow(self, bounds, &mut simplifier)).collect();
        (!left.is_empty()).then_some(Programs(left))
    }

    fn ceiling(&self, region: &Programs, bounds: &Bounds, up: Vec3) -> Option<Vec3> {
        let places = region.0.iter().filter_map(|local| {
            let cell = local.cell(bounds);
            let place = match &local.words {
                Constant::Words(words) => ceiling(self.catalog(), words, &cell, up)?,
                Constant::Everywhere(_) => top_corner(&cell, up),
            };
            Some(place + local.offset)
        });
        places.max_by(|a, b| up.dot(*a).total_cmp(&up.dot(*b)))
    }
}

/// The corner of a box that is farthest along `up`.
fn top_corner(cell: &CellBox, up: Vec3) -> Vec3 {
    let towards = |axis: usize| if up[axis] < 0.0 { -cell.half[axis] } else { cell.half[axis] };
    cell.center + Vec3::new(towards(0), towards(1), towards(2))
}

/// What is left of a tracer's programs in a box: those of bodies that are not empty there.
pub(super) struct Programs(Vec<Local>);

/// A program in a box, in coordinates whose origin is at `offset`.
#[derive(Clone)]
struct Local {
    words: Constant,
    offset: Vec3,
}

impl Local {
    fn cell(&self, bounds: &Bounds) -> CellBox {
        CellBox::new(bounds.center() - self.offset, bounds.size() * 0.5)
    }

    /// What is left of it in a smaller box; `None` if nothing is.
    fn narrow(&self, tracer: &Tracer, bounds: &Bounds, simplifier: &mut Simplifier) -> Option<Self> {
        let Constant::Words(words) = &self.words else { return Some(self.clone()) };
        let catalog = tracer.catalog();
        let mut reduced = Vec::new();
        match simplifier.simplify(catalog, words, &self.cell(bounds), &mut reduced) {
            Simplified::Constant(false) => return None,
            Simplified::Constant(true) => return Some(Self { words: Constant::Everywhere(true), ..*self }),
            Simplified::Reduced => {}
        }
        let alone = if let [word] = reduced[..] { catalog.placed_by(word) } else { None };
        let Some(placed) = alone else { return Some(Self { words: Constant::Words(reduced.into()), ..*self }) };
        // Nothing but a solid that is stored once.
        let words = catalog.prototype(placed).program.whole.clone();
        Self { words, offset: self.offset + placed.offset }.narrow(tracer, bounds, simplifier)
    }
}
