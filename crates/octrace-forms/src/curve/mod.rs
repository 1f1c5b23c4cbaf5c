//! Drawing outlines with a pen, as fonts and drawings describe them: lines, arcs and Bézier curves.
//!
//! In come strokes of a pen, out come closed contours of lines and circular arcs. Béziers become arcs, tangent to each
//! other, within a tolerance; or chords, as many as asked for.

mod biarc;
mod ellipse;

pub(crate) use ellipse::EllipticArc;

use biarc::Bezier;
use octrace::{Contour, Curve, Edge, Vec2};

/// Closed curves that may cross themselves and each other.
pub type Paths = Vec<Contour>;

/// What Bézier curves are drawn with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strokes {
    /// Circular arcs and lines, no farther from the curve than this (units of the drawing).
    Arcs {
        /// The largest distance.
        tolerance: f64,
    },
    /// So many chords for each curve, at equal steps of its parameter.
    Chords(u32),
}

/// Collects strokes to closed contours.
#[derive(Debug)]
pub(crate) struct Pen {
    strokes: Strokes,
    paths: Paths,
    contour: Contour,
    start: Vec2,
    at: Vec2,
}

impl Pen {
    pub fn new(strokes: Strokes) -> Self {
        Self { strokes, paths: Vec::new(), contour: Vec::new(), start: Vec2::ZERO, at: Vec2::ZERO }
    }

    /// Begins a contour; the one before is closed.
    pub fn move_to(&mut self, p: Vec2) {
        self.close();
        (self.start, self.at) = (p, p);
    }

    pub fn line_to(&mut self, p: Vec2) {
        if p != self.at {
            self.contour.push(Edge { from: self.at, curve: Curve::Line });
            self.at = p;
        }
    }

    /// A part of a circle; the whole one where it ends at its start. Circles of no size are points.
    pub fn arc_to(&mut self, p: Vec2, center: Vec2, radius: f64, ccw: bool) {
        if radius <= 0.0 {
            return self.line_to(p);
        }
        self.contour.push(Edge { from: self.at, curve: Curve::Arc { center, radius, ccw } });
        self.at = p;
    }

    /// A quadratic Bézier curve.
    pub fn quad_to(&mut self, c: Vec2, p: Vec2) {
        match self.strokes {
            Strokes::Arcs { .. } => {
                let third = |end: Vec2| end + (c - end) * (2.0 / 3.0);
                self.cubic_to(third(self.at), third(p), p);
            }
            Strokes::Chords(n) => {
                let from = self.at;
                for i in 1..=n {
                    let t = f64::from(i) / f64::from(n);
                    let s = 1.0 - t;
                    self.line_to(if i == n { p } else { from * (s * s) + c * (2.0 * s * t) + p * (t * t) });
                }
            }
        }
    }

    /// A cubic Bézier curve.
    pub fn cubic_to(&mut self, c1: Vec2, c2: Vec2, p: Vec2) {
        match self.strokes {
            Strokes::Arcs { tolerance } => Bezier([self.at, c1, c2, p]).arcs(tolerance, self),
            Strokes::Chords(n) => self.cubic_as_chords(c1, c2, p, n),
        }
    }

    /// So many chords of a cubic Bézier curve.
    pub fn cubic_as_chords(&mut self, c1: Vec2, c2: Vec2, p: Vec2, n: u32) {
        let bezier = Bezier([self.at, c1, c2, p]);
        (1..=n).for_each(|i| self.line_to(if i == n { p } else { bezier.at(f64::from(i) / f64::from(n)) }));
    }

    /// Closes the contour with a line, unless it is closed.
    pub fn close(&mut self) {
        self.line_to(self.start);
        let contour = std::mem::take(&mut self.contour);
        // Two lines there and back enclose nothing.
        if contour.len() > 2 || contour.iter().any(|edge| edge.curve != Curve::Line) {
            self.paths.push(contour);
        }
    }

    /// Where the pen is.
    pub fn at(&self) -> Vec2 {
        self.at
    }

    pub fn finish(mut self) -> Paths {
        self.close();
        self.paths
    }
}

/// The middle and radius of the arc from `a` to `b` that turns by four times the angle whose tangent is `bulge`:
/// counter-clockwise where that is positive. `None` where the ends are one, or the arc is a line.
pub(crate) fn bulged(a: Vec2, b: Vec2, bulge: f64) -> Option<(Vec2, f64)> {
    let chord = b - a;
    if bulge == 0.0 || chord == Vec2::ZERO {
        return None;
    }
    // From the chord's middle, to its left by half its length over the tangent of half the turn.
    let height = 0.5 * (1.0 - bulge * bulge) / (2.0 * bulge);
    let center = (a + b) * 0.5 + chord.left() * height;
    let radius = chord.length() * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
    (center.x.is_finite() && center.y.is_finite() && radius.is_finite()).then_some((center, radius))
}

/// The area that closed curves surround: what is left of them counts, what is right of them counts negative.
pub fn signed_area(paths: &[Contour]) -> f64 {
    paths.iter().map(contour_area).sum()
}

fn contour_area(contour: &Contour) -> f64 {
    let ends = contour.iter().cycle().skip(1).map(|edge| edge.from);
    let sides = contour.iter().zip(ends).map(|(edge, to)| {
        let triangle = 0.5 * edge.from.cross(to);
        let Curve::Arc { center, radius, ccw } = edge.curve else { return triangle };
        let (a, b) = (edge.from - center, to - center);
        let turn = match libm::atan2(a.cross(b), a.dot(b)) {
            // A whole circle.
            0.0 if edge.from == to => std::f64::consts::TAU * if ccw { 1.0 } else { -1.0 },
            turn if ccw && turn < 0.0 => turn + std::f64::consts::TAU,
            turn if !ccw && turn > 0.0 => turn - std::f64::consts::TAU,
            turn => turn,
        };
        // The segment between chord and arc.
        triangle + 0.5 * (radius * radius * turn - a.cross(b))
    });
    sides.sum()
}

/// Lower left and upper right corner of the smallest box around curves.
pub fn extent(paths: &[Contour]) -> Option<(Vec2, Vec2)> {
    let mut corners: Option<(Vec2, Vec2)> = None;
    let mut include = |p: Vec2| {
        let (low, high) = corners.unwrap_or((p, p));
        corners = Some((Vec2::new(low.x.min(p.x), low.y.min(p.y)), Vec2::new(high.x.max(p.x), high.y.max(p.y))));
    };
    for contour in paths {
        let ends = contour.iter().cycle().skip(1).map(|edge| edge.from);
        for (edge, to) in contour.iter().zip(ends) {
            include(edge.from);
            let Curve::Arc { center, radius, ccw } = edge.curve else { continue };
            let (first, last) = if ccw { (edge.from, to) } else { (to, edge.from) };
            for way in
                [Vec2::new(radius, 0.0), Vec2::new(0.0, radius), Vec2::new(-radius, 0.0), Vec2::new(0.0, -radius)]
            {
                // Counter-clockwise arcs are to the right of their chord.
                if first == last || (last - first).cross(center + way - first) < 0.0 {
                    include(center + way);
                }
            }
        }
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_count_with_their_segments() {
        let radius = 2.0;
        let center = Vec2::new(1.0, 5.0);
        let half =
            |from: f64, ccw| Edge { from: center + Vec2::new(from, 0.0), curve: Curve::Arc { center, radius, ccw } };
        let full = 4.0 * std::f64::consts::PI;
        assert!((signed_area(&[vec![half(2.0, true)]]) - full).abs() < 1e-12);
        assert!((signed_area(&[vec![half(2.0, false), half(-2.0, false)]]) + full).abs() < 1e-12);
        let edges = vec![half(2.0, true), Edge { from: center - Vec2::new(2.0, 0.0), curve: Curve::Line }];
        assert!((signed_area(&[edges]) - full / 2.0).abs() < 1e-12);
    }

    #[test]
    fn the_extent_of_arcs_goes_beyond_their_ends() {
        let arc = |from: [f64; 2], ccw| Edge {
            from: Vec2::new(from[0], from[1]),
            curve: Curve::Arc { center: Vec2::ZERO, radius: 5.0, ccw },
        };
        let back = Edge { from: Vec2::new(4.0, 3.0), curve: Curve::Line };
        let corners = |contour: Contour| extent(&[contour]).map(|(a, b)| [a.x, a.y, b.x, b.y]);
        assert_eq!(corners(vec![arc([-3.0, 4.0], false), back]), Some([-3.0, 3.0, 4.0, 5.0]));
        assert_eq!(corners(vec![arc([-3.0, 4.0], true), back]), Some([-5.0, -5.0, 5.0, 4.0]));
        assert_eq!(corners(vec![arc([5.0, 0.0], true)]), Some([-5.0, -5.0, 5.0, 5.0]));
        assert_eq!(extent(&[]), None);
    }

    #[test]
    fn a_bulge_of_one_is_half_a_circle() {
        let (a, b) = (Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0));
        assert_eq!(bulged(a, b, 1.0), Some((Vec2::new(2.0, 0.0), 2.0)));
        // A quarter, counter-clockwise: the middle is to the left of the chord.
        let (center, radius) = bulged(a, b, libm::tan(std::f64::consts::PI / 8.0)).unwrap();
        assert!((center - Vec2::new(2.0, 2.0)).length() < 1e-12 && (radius - 8.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(bulged(a, a, 1.0), None);
        assert_eq!(bulged(a, b, 0.0), None);
    }

    #[test]
    fn a_circle_of_no_size_is_nothing() {
        let mut pen = Pen::new(Strokes::Arcs { tolerance: 1e-6 });
        let p = Vec2::new(1.0, 2.0);
        pen.move_to(p);
        pen.arc_to(p, p, 0.0, true);
        assert!(pen.finish().is_empty());
    }

    #[test]
    fn chords_are_as_many_as_asked_for() {
        let mut pen = Pen::new(Strokes::Chords(4));
        pen.move_to(Vec2::ZERO);
        pen.quad_to(Vec2::new(1.0, 0.0), Vec2::new(1.0, 1.0));
        pen.cubic_to(Vec2::new(1.0, 2.0), Vec2::new(0.0, 2.0), Vec2::new(0.0, 1.0));
        assert_eq!(pen.finish()[0].len(), 9);
    }
}
