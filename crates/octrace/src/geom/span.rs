//! Roth's intervals: the stretches of a ray inside a solid [Roth 1982].

/// A crossing of the finished solid's surface. Point, normal and material are looked up when asked for, by
/// [`Tracer::surface_point`](crate::Tracer::surface_point). Where several surfaces are crossed at one `t`, one of them is
/// seen; which one depends on the CSG tree alone, not on the acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Ray parameter, finite; a distance in scene units where the direction has unit length.
    pub t: f64,
    /// The leaf of the CSG tree whose surface is crossed, in source order.
    pub leaf: u32,
    /// Which of the surfaces of the program is crossed.
    pub surface: u32,
    /// Whether the ray goes into the solid here (and not out of it).
    pub entering: bool,
    /// Whether the solid's outward normal opposes the stored surface's, as on the wall of a drilled hole.
    pub flipped: bool,
}

/// A stretch of a ray inside a solid. `None` at an end that is infinitely far away.
///
/// Read as half-open, `[enter, exit)`, so that stretches that touch are one and none has zero length. Invariant:
/// `enter.t < exit.t`; the first is `entering`, the second is not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Where the ray goes in; `None` where it has always been inside.
    pub enter: Option<Hit>,
    /// Where it comes out; `None` where it never does.
    pub exit: Option<Hit>,
}

impl Span {
    /// Parameter of the entry, `-inf` where there is none.
    pub fn enter_t(&self) -> f64 {
        self.enter.map_or(f64::NEG_INFINITY, |h| h.t)
    }

    /// Parameter of the exit, `inf` where there is none.
    pub fn exit_t(&self) -> f64 {
        self.exit.map_or(f64::INFINITY, |h| h.t)
    }
}

/// The spans of one ray: ascending, disjoint, not touching, never empty.
pub type Spans = Vec<Span>;

/// Makes spans of the crossings of a line, as they come.
#[derive(Debug)]
pub(crate) struct SpansBuilder {
    spans: Spans,
    inside: bool,
    enter: Option<Hit>,
}

impl SpansBuilder {
    /// A line that comes from inside, or from outside.
    pub fn new(inside: bool) -> Self {
        Self { spans: Spans::new(), inside, enter: None }
    }

    /// The next crossing: at a greater `t` than the one before, and the other way.
    pub fn cross(&mut self, hit: Hit) {
        debug_assert_ne!(hit.entering, self.inside, "crossings alternate");
        if hit.entering {
            self.enter = Some(hit);
        } else {
            self.spans.push(Span { enter: self.enter.take(), exit: Some(hit) });
        }
        self.inside = hit.entering;
    }

    /// The spans, the last one without an end if the line stays inside.
    pub fn finish(mut self) -> Spans {
        if self.inside {
            self.spans.push(Span { enter: self.enter, exit: None });
        }
        self.spans
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Inner loops copy these by the million.
    #[test]
    fn hits_and_spans_stay_small() {
        assert_eq!(size_of::<Hit>(), 24);
        assert_eq!(size_of::<Option<Hit>>(), 24);
        assert_eq!(size_of::<Span>(), 48);
    }

    #[test]
    fn a_line_may_come_from_inside_and_stay_inside() {
        let hit = |t, entering| Hit { t, leaf: 0, surface: 0, entering, flipped: false };
        let ends = |starts_inside, hits: &[Hit]| {
            let mut builder = SpansBuilder::new(starts_inside);
            hits.iter().for_each(|&hit| builder.cross(hit));
            builder.finish().iter().map(|span| (span.enter_t(), span.exit_t())).collect::<Vec<_>>()
        };
        const INF: f64 = f64::INFINITY;
        assert_eq!(ends(false, &[]), []);
        assert_eq!(ends(true, &[]), [(-INF, INF)]);
        assert_eq!(ends(false, &[hit(1.0, true), hit(2.0, false)]), [(1.0, 2.0)]);
        assert_eq!(ends(true, &[hit(1.0, false), hit(2.0, true)]), [(-INF, 1.0), (2.0, INF)]);
    }
}
