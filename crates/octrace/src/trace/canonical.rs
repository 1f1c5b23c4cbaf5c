//! The canonical tracer [Roth 1982; Comba-Persiano, §2.2]: every primitive is met with every ray, the span lists are
//! combined up the tree. No octree, no short cuts: the reference for everything else.

use super::combine::combine;
use super::roots::hit_of;
use crate::compile::{Catalog, Constant, Op, Word, node_end};
use crate::geom::{Ray, Spans, SpansBuilder};

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

/// The spans in the literal that `word` is: use `index` of a surface, or what that leaves.
fn literal_spans(catalog: &Catalog, word: u32, index: u32, negated: bool, ray: &Ray) -> Spans {
    let surface = catalog.literals[index as usize].surface;
    let mut params = Vec::new();
    let mut inside = negated ^ catalog.surfaces[surface as usize].crossings(&catalog.surfaces, ray, &mut params);
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
