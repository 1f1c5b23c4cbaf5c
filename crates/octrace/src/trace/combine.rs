//! Boolean combination of span lists [Roth 1982], regularised.
//!
//! As sets of parameters spans are half-open, so lists of them are closed under union, intersection and complement, and
//! nothing of zero length survives. Where several operands change at the same parameter, all of them change at once; the
//! result's end is the one of the *first operand in source order that changes the way the result does*. This rule looks
//! at the operands' values only, and so it says the same of a simplified tree: an operand that simplifying drops is
//! constant in the cell, so it never changes there.

use crate::compile::Op;
use crate::geom::{Hit, Spans, SpansBuilder};

/// Combines the span lists of several operands by intersection (`And`) or union (`Or`).
pub(super) fn combine(op: Op, operands: &[Spans]) -> Spans {
    struct Event {
        operand: usize,
        hit: Hit,
    }
    let mut events = Vec::new();
    let mut inside = 0;
    for (operand, spans) in operands.iter().enumerate() {
        inside += usize::from(spans.first().is_some_and(|span| span.enter.is_none()));
        let ends = spans.iter().flat_map(|span| [span.enter, span.exit]).flatten();
        events.extend(ends.map(|hit| Event { operand, hit }));
    }
    events.sort_by(|a, b| a.hit.t.total_cmp(&b.hit.t).then(a.operand.cmp(&b.operand)));

    let needed = match op {
        Op::And => operands.len(),
        Op::Or => 1,
    };
    let mut before = inside >= needed;
    let mut spans = SpansBuilder::new(before);
    for together in events.chunk_by(|a, b| a.hit.t == b.hit.t) {
        for event in together {
            if event.hit.entering { inside += 1 } else { inside -= 1 }
        }
        let after = inside >= needed;
        if before != after {
            let seen = together.iter().find(|event| event.hit.entering == after);
            spans.cross(seen.expect("the result changes the way some operand does").hit);
        }
        before = after;
    }
    spans.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Span;

    fn span(leaf: u32, enter: f64, exit: f64) -> Spans {
        let hit = |t, entering| Some(Hit { t, leaf, surface: leaf, entering, flipped: false });
        vec![Span { enter: hit(enter, true), exit: hit(exit, false) }]
    }

    fn ends(spans: &[Span]) -> Vec<(f64, u32, f64, u32)> {
        spans.iter().map(|s| (s.enter_t(), s.enter.unwrap().leaf, s.exit_t(), s.exit.unwrap().leaf)).collect()
    }

    /// All of the line but that.
    fn outside(spans: &[Span]) -> Spans {
        let ends = spans.iter().flat_map(|span| [span.enter, span.exit]).flatten();
        let mut gaps = SpansBuilder::new(spans.first().is_none_or(|span| span.enter.is_some()));
        ends.for_each(|hit| gaps.cross(Hit { entering: !hit.entering, ..hit }));
        gaps.finish()
    }

    #[test]
    fn touching_spans_become_one() {
        assert_eq!(ends(&combine(Op::Or, &[span(0, 1.0, 2.0), span(1, 2.0, 3.0)])), [(1.0, 0, 3.0, 1)]);
    }

    #[test]
    fn what_only_touches_has_nothing_in_common() {
        assert_eq!(combine(Op::And, &[span(0, 1.0, 2.0), span(1, 2.0, 3.0)]), []);
    }

    #[test]
    fn of_coinciding_ends_the_first_operand_is_seen() {
        assert_eq!(ends(&combine(Op::Or, &[span(0, 1.0, 2.0), span(1, 1.0, 2.0)])), [(1.0, 0, 2.0, 0)]);
        assert_eq!(ends(&combine(Op::And, &[span(0, 1.0, 4.0), span(1, 1.0, 2.0)])), [(1.0, 0, 2.0, 1)]);
    }

    #[test]
    fn a_solid_minus_itself_is_nothing() {
        let a = span(0, 1.0, 2.0);
        assert_eq!(combine(Op::And, &[a.clone(), outside(&a)]), []);
        assert_eq!(combine(Op::Or, &[a.clone(), outside(&a)]), [Span { enter: None, exit: None }]);
    }

    #[test]
    fn combining_nothing_is_the_neutral_set() {
        assert_eq!(combine(Op::Or, &[]), []);
        assert_eq!(combine(Op::And, &[]), [Span { enter: None, exit: None }]);
    }
}
