//! Cubic Bézier curves as circular arcs [Bolton 1975].
//!
//! Two arcs that meet with a common tangent have the ends and the tangents there of a piece of the curve. The piece is
//! halved until they are near enough. So the whole has a tangent everywhere where the curve has one.

use super::Pen;
use octrace::Vec2;

/// A curve is halved no more often than this.
const DEEPEST: u32 = 12;

/// Places at which the distance is taken.
const SAMPLES: u32 = 8;

/// A cubic Bézier curve by its control points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bezier(pub [Vec2; 4]);

impl Bezier {
    pub fn at(&self, t: f64) -> Vec2 {
        let [a, b, c, d] = self.0;
        let s = 1.0 - t;
        a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t)
    }

    fn halves(&self) -> [Self; 2] {
        let [a, b, c, d] = self.0;
        let middle = |p: Vec2, q: Vec2| (p + q) * 0.5;
        let (ab, bc, cd) = (middle(a, b), middle(b, c), middle(c, d));
        let (abc, bcd) = (middle(ab, bc), middle(bc, cd));
        let m = middle(abc, bcd);
        [Self([a, ab, abc, m]), Self([m, bcd, cd, d])]
    }

    /// Unit tangents at both ends: towards the first control point that is not that end.
    fn tangents(&self) -> Option<(Vec2, Vec2)> {
        let [a, b, c, d] = self.0;
        let direction = |v: Vec2| (v.length() > 0.0).then(|| v * (1.0 / v.length()));
        let start = [b, c, d].into_iter().find_map(|p| direction(p - a))?;
        let end = [c, b, a].into_iter().find_map(|p| direction(d - p))?;
        Some((start, end))
    }

    /// Draws arcs no farther from the curve than `tolerance`, from where the pen is.
    pub fn arcs(self, tolerance: f64, pen: &mut Pen) {
        let mut pending = vec![(self, 0)];
        while let Some((piece, depth)) = pending.pop() {
            let end = piece.0[3];
            let flat = piece.within(tolerance * 0.01, |p| distance_to_segment(p, piece.0[0], end));
            let last = depth == DEEPEST;
            match piece.biarc(tolerance) {
                _ if flat => pen.line_to(end),
                Some(arcs) => arcs.into_iter().for_each(|arc| arc.draw(pen)),
                None if last => pen.line_to(end),
                None => pending.extend(piece.halves().into_iter().rev().map(|half| (half, depth + 1))),
            }
        }
    }

    /// Whether the curve keeps within `tolerance` of what `distance` tells the distance from.
    fn within(&self, tolerance: f64, distance: impl Fn(Vec2) -> f64) -> bool {
        (1..SAMPLES).all(|i| distance(self.at(f64::from(i) / f64::from(SAMPLES))) <= tolerance)
    }

    /// Two arcs with this curve's ends and tangents, if they are near enough and each turns less than a right angle.
    fn biarc(&self, tolerance: f64) -> Option<[Arc; 2]> {
        let [a, .., d] = self.0;
        let (start, end) = self.tangents()?;
        let chord = d - a;
        if start.dot(chord) <= 0.0 || end.dot(chord) <= 0.0 || start.dot(end) <= 0.0 {
            return None;
        }
        // Both arcs' tangents from their outer end to where they meet the common one have this length.
        let along = chord.dot(start + end);
        let spread = 2.0 * (1.0 - start.dot(end));
        let squared = chord.dot(chord);
        let reach = squared / (along + (along * along + spread * squared).sqrt());
        let (from_start, from_end) = (a + start * reach, d - end * reach);
        let joint = (from_start + from_end) * 0.5;
        let arcs = [Arc::tangent(a, start, joint), Arc::tangent(d, -end, joint).reversed()];
        let across = from_end - from_start;
        let nearest = |p: Vec2| arcs[usize::from((p - joint).dot(across) > 0.0)].distance(p);
        self.within(tolerance, nearest).then_some(arcs)
    }
}

/// A circular arc, or a line where the radius is too large to matter.
struct Arc {
    from: Vec2,
    to: Vec2,
    /// Middle, radius and whether it goes counter-clockwise.
    circle: Option<(Vec2, f64, bool)>,
}

impl Arc {
    /// The arc from `from`, in the direction `tangent`, to `to`.
    fn tangent(from: Vec2, tangent: Vec2, to: Vec2) -> Self {
        let chord = to - from;
        let sideways = tangent.left().dot(chord);
        let squared = chord.dot(chord);
        // The height of such an arc is an eighth of this, times the length of its chord.
        let bend = 2.0 * sideways / squared.sqrt();
        if bend.abs() < 1e-9 || !bend.is_finite() {
            return Self { from, to, circle: None };
        }
        let reach = squared / (2.0 * sideways);
        Self { from, to, circle: Some((from + tangent.left() * reach, reach.abs(), reach > 0.0)) }
    }

    /// The same arc, walked the other way.
    fn reversed(self) -> Self {
        Self { from: self.to, to: self.from, circle: self.circle.map(|(c, r, ccw)| (c, r, !ccw)) }
    }

    fn distance(&self, p: Vec2) -> f64 {
        match self.circle {
            Some((center, radius, _)) => ((p - center).length() - radius).abs(),
            None => distance_to_segment(p, self.from, self.to),
        }
    }

    fn draw(self, pen: &mut Pen) {
        match self.circle {
            Some((center, radius, ccw)) if self.from != self.to => pen.arc_to(self.to, center, radius, ccw),
            _ => pen.line_to(self.to),
        }
    }
}

fn distance_to_segment(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let way = b - a;
    let t = (p - a).dot(way) / way.dot(way);
    let nearest = if t > 0.0 { a + way * t.min(1.0) } else { a };
    (p - nearest).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Strokes, signed_area};
    use octrace::{Contour, Curve};

    fn drawn(points: [[f64; 2]; 4], tolerance: f64) -> Contour {
        let [a, b, c, d] = points.map(|[x, y]| Vec2::new(x, y));
        let mut pen = Pen::new(Strokes::Arcs { tolerance });
        pen.move_to(a);
        pen.cubic_to(b, c, d);
        pen.finish().pop().unwrap_or_default()
    }

    /// Area between the curve and its chord, exactly.
    fn area(points: [[f64; 2]; 4]) -> f64 {
        let [a, b, c, d] = points.map(|[x, y]| Vec2::new(x, y));
        // Green's theorem for Bernstein polynomials.
        let sum =
            6.0 * a.cross(b) + 3.0 * a.cross(c) + a.cross(d) + 3.0 * b.cross(c) + 3.0 * b.cross(d) + 6.0 * c.cross(d);
        sum / 20.0 + 0.5 * d.cross(a)
    }

    #[test]
    fn arcs_are_near_and_have_common_tangents() {
        let curves = [
            [[0.0, 0.0], [0.0, 0.55], [0.45, 1.0], [1.0, 1.0]],
            [[0.0, 0.0], [1.0, 2.0], [2.0, -2.0], [3.0, 0.0]],
            [[0.0, 0.0], [4.0, 1.0], [-3.0, 1.0], [1.0, 0.0]],
            [[0.0, 0.0], [0.0, 0.0], [1.0, 3.0], [2.0, 0.0]],
            [[0.0, 0.0], [3.0, 1.0], [3.0, 1.0], [0.0, 2.0]],
        ];
        for points in curves {
            for tolerance in [1e-2, 1e-4, 1e-6] {
                let contour = drawn(points, tolerance);
                let off = (signed_area(std::slice::from_ref(&contour)) - area(points)).abs();
                assert!(off < 6.0 * tolerance, "{points:?} {tolerance} {off}");
                assert!(contour.len() < 400, "{}", contour.len());
                for pair in contour.windows(2) {
                    let tangent = |edge: &octrace::Edge, at: Vec2| match edge.curve {
                        Curve::Line => None,
                        Curve::Arc { center, radius, ccw } => {
                            assert!(((edge.from - center).length() - radius).abs() < 1e-9 * radius.max(1.0));
                            Some((at - center).left() * (if ccw { 1.0 } else { -1.0 } / radius))
                        }
                    };
                    if let (Some(a), Some(b)) = (tangent(&pair[0], pair[1].from), tangent(&pair[1], pair[1].from)) {
                        assert!(a.dot(b) > 1.0 - 1e-6, "{points:?}: a corner at {:?}", pair[1].from);
                    }
                }
            }
        }
    }

    #[test]
    fn straight_curves_are_lines() {
        let mut pen = Pen::new(Strokes::Arcs { tolerance: 1e-3 });
        pen.cubic_to(Vec2::new(1.0, 0.0), Vec2::new(2.0, 0.0), Vec2::new(3.0, 0.0));
        pen.line_to(Vec2::new(0.0, 4.0));
        let contour = pen.finish().pop().unwrap();
        assert!(contour.len() == 3 && contour.iter().all(|edge| edge.curve == Curve::Line));
    }

    #[test]
    fn hostile_curves_come_to_an_end() {
        for x in [1e-300, 1e300, f64::MAX, f64::NAN] {
            drawn([[0.0, 0.0], [x, 0.0], [0.0, x], [1.0, x]], 1e-12);
        }
    }
}
