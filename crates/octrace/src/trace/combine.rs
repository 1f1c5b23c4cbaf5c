//! Boolean combination of span lists [Roth 1982], regularised.
//!
//! As sets of parameters spans are half-open, so lists of them are closed under union, intersection and complement, and
//! nothing of zero length survives. Where several operands change at the same parameter, all of them change at once; the
//! result's end is the one of the *first operand in source order that changes the way the result does*. This rule looks
//! at the operands' values only, and so it says the same of a simplified tree: an operand that simplifying drops is
//! constant in the cell, so it never changes there.

use crate::geom::{Hit, Span, Spans};

/// Combines the span lists of several operands by union (`all == false`) or intersection (`all == true`).
pub fn combine(all: bool, operands: &[Spans]) -> Spans {
    struct Event {
        t: f64,
        operand: usize,
        hit: Hit,
    }
    let mut events = Vec::new();
    let mut inside = 0;
    for (operand, spans) in operands.iter().enumerate() {
        for span in spans {
            match span.enter {
                Some(hit) => events.push(Event { t: hit.t, operand, hit }),
                None => inside += 1,
            }
            if let Some(hit) = span.exit {
                events.push(Event { t: hit.t, operand, hit });
            }
        }
    }
    events.sort_by(|a, b| a.t.total_cmp(&b.t).then(a.operand.cmp(&b.operand)));

    let needed = if all { operands.len() } else { 1 };
    let mut spans = Spans::new();
    let mut enter = None;
    for together in events.chunk_by(|a, b| a.t == b.t) {
        let before = inside >= needed;
        for event in together {
            if event.hit.entering { inside += 1 } else { inside -= 1 }
        }
        let after = inside >= needed;
        if before == after {
            continue;
        }
        let hit = together.iter().find(|e| e.hit.entering == after).map(|e| e.hit);
        if after {
            enter = hit;
        } else {
            spans.push(Span { enter, exit: hit });
            enter = None;
        }
    }
    if inside >= needed {
        spans.push(Span { enter, exit: None });
    }
    spans
}

/// What the ray passes between the spans: the complement. Every end stays the same crossing, entered the other way.
pub fn complement(spans: &[Span]) -> Spans {
    let turned = |hit: Option<Hit>| hit.map(|h| Hit { entering: !h.entering, flipped: !h.flipped, ..h });
    let mut gaps = Spans::new();
    let mut enter = None;
    let mut open = true;
    for span in spans {
        if span.enter.is_some() {
            gaps.push(Span { enter, exit: turned(span.enter) });
        }
        enter = turned(span.exit);
        open = span.exit.is_some();
    }
    if open {
        gaps.push(Span { enter, exit: None });
    }
    gaps
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(leaf: u32, enter: f64, exit: f64) -> Spans {
        let hit = |t, entering| Some(Hit { t, leaf, surface: leaf, entering, flipped: false });
        vec![Span { enter: hit(enter, true), exit: hit(exit, false) }]
    }

    fn ends(spans: &[Span]) -> Vec<(f64, u32, f64, u32)> {
        spans.iter().map(|s| (s.enter_t(), s.enter.unwrap().leaf, s.exit_t(), s.exit.unwrap().leaf)).collect()
    }

    #[test]
    fn touching_spans_become_one() {
        assert_eq!(ends(&combine(false, &[span(0, 1.0, 2.0), span(1, 2.0, 3.0)])), [(1.0, 0, 3.0, 1)]);
    }

    #[test]
    fn what_only_touches_has_nothing_in_common() {
        assert_eq!(combine(true, &[span(0, 1.0, 2.0), span(1, 2.0, 3.0)]), []);
    }

    #[test]
    fn of_coinciding_ends_the_first_operand_is_seen() {
        assert_eq!(ends(&combine(false, &[span(0, 1.0, 2.0), span(1, 1.0, 2.0)])), [(1.0, 0, 2.0, 0)]);
        assert_eq!(ends(&combine(true, &[span(0, 1.0, 4.0), span(1, 1.0, 2.0)])), [(1.0, 0, 2.0, 1)]);
    }

    #[test]
    fn a_solid_minus_itself_is_nothing() {
        let a = span(0, 1.0, 2.0);
        assert_eq!(combine(true, &[a.clone(), complement(&a)]), []);
    }

    #[test]
    fn the_complement_of_the_complement_is_the_same() {
        let a = combine(false, &[span(0, 1.0, 2.0), span(1, 3.0, 4.0)]);
        assert_eq!(complement(&complement(&a)), a);
        assert_eq!(complement(&[]).len(), 1);
        assert_eq!(complement(&complement(&[])), []);
    }
}
