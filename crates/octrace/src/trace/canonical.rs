//! The canonical tracer [Roth 1982; Comba-Persiano, §2.2]: every primitive is met with every ray, the span lists are
//! combined up the tree. No octree, no short cuts: the reference for everything else.

use super::combine::combine;
use super::roots::hit_of;
use crate::compile::{Catalog, Constant, Word, node_end};
use crate::geom::{Ray, Span, Spans};

/// The spans of the whole line of the ray in the program.
pub(crate) fn spans(catalog: &Catalog, program: &Constant, ray: &Ray) -> Spans {
    match program {
        Constant::Everywhere(false) => Spans::new(),
        Constant::Everywhere(true) => vec![Span { enter: None, exit: None }],
        Constant::Words(words) => node_spans(catalog, words, 0, ray),
    }
}

fn node_spans(catalog: &Catalog, words: &[u32], at: usize, ray: &Ray) -> Spans {
    let (len, all) = match Word::decode(words[at]) {
        Word::Literal { .. } => return literal_spans(catalog, words[at], ray),
        Word::And { len } => (len as usize, true),
        Word::Or { len } => (len as usize, false),
    };
    let end = at + 1 + len;
    let mut operands = Vec::new();
    let mut child = at + 1;
    while child < end {
        operands.push(node_spans(catalog, words, child, ray));
        child = node_end(words, child);
    }
    combine(all, &operands)
}

fn literal_spans(catalog: &Catalog, word: u32, ray: &Ray) -> Spans {
    let Word::Literal { index, negated } = Word::decode(word) else {
        unreachable!("called for literals only");
    };
    let surface = catalog.literals[index as usize].surface;
    let mut params = Vec::new();
    let starts_inside = negated ^ catalog.surfaces[surface as usize].crossings(&catalog.surfaces, ray, &mut params);
    let mut spans = Spans::new();
    let mut enter = None;
    let mut inside = starts_inside;
    for together in params.chunk_by(|a, b| a == b) {
        if together.len() % 2 == 0 {
            continue;
        }
        let hit = Some(hit_of(catalog, word, ray, together[0], !inside));
        if inside {
            spans.push(Span { enter, exit: hit });
            enter = None;
        } else {
            enter = hit;
        }
        inside = !inside;
    }
    if inside {
        spans.push(Span { enter, exit: None });
    }
    spans
}
