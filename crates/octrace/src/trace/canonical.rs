//! The canonical tracer [Roth 1982; Comba-Persiano, §2.2]: every primitive is met with every ray, the span lists are
//! combined up the tree. No octree, no short cuts: the reference for everything else. Of a solid that stands in many places,
//! each copy is met by the ray in the solid's own coordinates.

use super::combine::combine;
use super::roots::hit_of;
use crate::compile::{Catalog, Constant, Op, Word, node_end};
use crate::geom::{Hit, Ray, Spans, SpansBuilder};
use crate::surface::Placed;

/// The spans of the whole line of the ray in the program.
pub(super) fn spans(catalog: &Catalog, program: &Constant, ray: &Ray) -> Spans {
    match program {
        Constant::Everywhere(inside) => SpansBuilder::new(*inside).finish(),
        Constant::Words(words) => node_spans(catalog, words, 0, ray),
    }
}

fn node_spans(catalog: &Catalog, words: &[u32], at: usize, ray: &Ray) -> Spans {
    let (op, len) = match Word::decode(words[at]) {
        Word::Literal { index, negated } => return literal_spans(catalog, words[at], index, negated, ray),
        Word::And { len } => (Op::And, len as usize),
        Word::Or { len } => (Op::Or, len as usize),
    };
    let end = at + 1 + len;
    let mut operands = Vec::new();
    let mut child = at + 1;
    while child < end {
        operands.push(node_spans(catalog, words, child, ray));
        child = node_end(words, child);
    }
    combine(op, &operands)
}

/// The spans in one of a solid's copies. (They are operands of unions, never negated.)
pub(super) fn copy_spans(catalog: &Catalog, placed: &Placed, ray: &Ray) -> Spans {
    let mut spans = spans(catalog, &catalog.prototype(placed).program.whole, &placed.ray(ray));
    for hit in spans.iter_mut().flat_map(|span| [&mut span.enter, &mut span.exit]).flatten() {
        *hit = catalog.hit_of_copy(placed, *hit);
    }
    spans
}

/// The ends of spans, in the order of the line.
pub(super) fn ends(spans: Spans) -> impl Iterator<Item = Hit> {
    spans.into_iter().flat_map(|span| [span.enter, span.exit]).flatten()
}

/// The spans in the literal that `word` is: use `index` of a surface, or what that leaves.
fn literal_spans(catalog: &Catalog, word: u32, index: u32, negated: bool, ray: &Ray) -> Spans {
    if let Some(placed) = catalog.placed_by(word) {
        return copy_spans(catalog, placed, ray);
    }
    let literal = catalog.literal(index);
    let mut params = Vec::new();
    let mut inside = negated ^ literal.surface.crossings(&catalog.surfaces, &literal.ray(ray), &mut params);
    let mut spans = SpansBuilder::new(inside);
    for together in params.chunk_by(|a, b| a == b) {
        // Crossings at one parameter cancel each other in pairs.
        if together.len() % 2 == 1 {
            inside = !inside;
            spans.cross(hit_of(catalog, word, ray, together[0], inside));
        }
    }
    spans.finish()
}
