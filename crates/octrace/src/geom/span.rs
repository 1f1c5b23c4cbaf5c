//! Roth's intervals: the stretches of a ray inside a solid [Roth 1982].

/// A crossing of the finished solid's surface. Point, normal and material are looked up when asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Ray parameter; a distance in scene units where the direction has unit length.
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
/// Read as half-open, `[enter, exit)`, so that stretches that touch are one. Invariant: `enter.t < exit.t`.
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
