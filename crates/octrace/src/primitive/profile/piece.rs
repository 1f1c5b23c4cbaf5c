//! One edge of a contour with both of its ends: tangents, extreme points, areas.

use super::{Contour, Curve, Edge};
use crate::geom::Vec2;
use robust::{Coord, Coord3D, orient2d, orient3d};

/// The circle that an arc is a part of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Circle {
    pub center: Vec2,
    pub radius: f64,
    /// Whether the arc is walked counter-clockwise about the middle.
    pub ccw: bool,
}

/// A line or an arc from one point to another; a whole circle where both are the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub from: Vec2,
    pub to: Vec2,
    /// `None`: a straight line.
    pub circle: Option<Circle>,
}

/// The edges of a contour, each with both ends.
pub(super) fn pieces_of(contour: &Contour) -> Vec<Piece> {
    let next = contour.iter().cycle().skip(1);
    contour.iter().zip(next).map(|(edge, next)| Piece::new(edge, next.from)).collect()
}

/// The contour that consists of those pieces.
pub(super) fn contour_of(pieces: &[Piece]) -> Contour {
    let curve = |piece: &Piece| match piece.circle {
        None => Curve::Line,
        Some(Circle { center, radius, ccw }) => Curve::Arc { center, radius, ccw },
    };
    pieces.iter().map(|piece| Edge { from: piece.from, curve: curve(piece) }).collect()
}

/// Walks the pieces the other way.
pub(super) fn reverse(pieces: &mut [Piece]) {
    pieces.reverse();
    for piece in pieces {
        let circle = piece.circle.map(|circle| Circle { ccw: !circle.ccw, ..circle });
        *piece = Piece { from: piece.to, to: piece.from, circle };
    }
}

impl Piece {
    fn new(edge: &Edge, to: Vec2) -> Self {
        let circle = match edge.curve {
            Curve::Line => None,
            Curve::Arc { center, radius, ccw } => Some(Circle { center, radius, ccw }),
        };
        Self { from: edge.from, to, circle }
    }

    pub fn is_line(&self) -> bool {
        self.circle.is_none()
    }

    /// Whether it is a circle all around.
    pub fn is_whole(&self) -> bool {
        self.from == self.to
    }

    /// From its beginning to its end.
    pub fn chord(&self) -> Vec2 {
        self.to - self.from
    }

    /// The direction of walking at one of its points.
    pub fn tangent(&self, at: Vec2) -> Vec2 {
        match self.circle {
            None => self.chord(),
            Some(circle) if circle.ccw => (at - circle.center).left(),
            Some(circle) => -(at - circle.center).left(),
        }
    }

    /// The point in the middle of it. Of a whole circle: the one across.
    pub fn middle(&self) -> Vec2 {
        let Some(Circle { center, radius, ccw }) = self.circle else { return (self.from + self.to) * 0.5 };
        if self.is_whole() {
            return center + (center - self.from);
        }
        // A counter-clockwise arc is to the right of its chord, be it short or long.
        let side = if ccw { -self.chord().left() } else { self.chord().left() };
        center + side * (radius / side.length())
    }

    /// Whether a point of its circle is on the arc, the ends left out.
    pub fn has(&self, on_circle: Vec2) -> bool {
        let Some(circle) = self.circle else { return false };
        let side = orientation(self.from, self.to, on_circle);
        self.is_whole() || (if circle.ccw { side < 0.0 } else { side > 0.0 })
    }

    /// The point between its ends, and higher than both by more than rounding, that is the farthest in direction `up`
    /// (which has length one), if there is one.
    pub fn apex(&self, up: Vec2) -> Option<Vec2> {
        let Circle { center, radius, .. } = self.circle?;
        let apex = center + up * radius;
        let slack = ROUNDING * (radius + center.length());
        let rises = |end: Vec2| up.dot(apex - end) > slack;
        (self.has(apex) && rises(self.from) && rises(self.to)).then_some(apex)
    }

    /// The pieces before and behind one of its points.
    pub fn cut(&self, at: Vec2) -> [Self; 2] {
        [Self { to: at, ..*self }, Self { from: at, ..*self }]
    }

    /// The smallest and the largest coordinates.
    pub fn bounds(&self) -> (Vec2, Vec2) {
        let (mut low, mut high) = (self.from, self.from);
        let mut add = |p: Vec2| {
            low = Vec2::new(low.x.min(p.x), low.y.min(p.y));
            high = Vec2::new(high.x.max(p.x), high.y.max(p.y));
        };
        add(self.to);
        if let Some(Circle { center, radius, .. }) = self.circle {
            for (x, y) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
                let point = center + Vec2::new(x, y) * radius;
                if self.has(point) {
                    add(point);
                }
            }
        }
        (low, high)
    }

    /// Twice the area between it and the lines from `origin` to its ends, positive where it is walked counter-clockwise.
    pub fn doubled_area(&self, origin: Vec2) -> f64 {
        let triangle = (self.from - origin).cross(self.to - origin);
        triangle + self.sweep().map_or(0.0, |(angle, radius)| radius * radius * (angle - libm::sin(angle)))
    }

    /// The angle, negative where it is walked clockwise, and the radius of an arc.
    pub fn sweep(&self) -> Option<(f64, f64)> {
        let Circle { center, radius, ccw } = self.circle?;
        let (a, b) = (self.from - center, self.to - center);
        let angle = libm::atan2(a.cross(b), a.dot(b));
        let turn = 2.0 * std::f64::consts::PI;
        let angle = match (ccw, self.is_whole()) {
            (true, true) => turn,
            (false, true) => -turn,
            (true, _) if angle < 0.0 => angle + turn,
            (false, _) if angle > 0.0 => angle - turn,
            _ => angle,
        };
        Some((angle, radius))
    }
}

/// A few dozen roundings.
pub(super) const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Positive where `c` is to the left of the line from `a` to `b`, negative where it is to the right; right in any case.
pub(super) fn orientation(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let coord = |p: Vec2| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}

/// Positive where `p` is farther in direction `up` than `q`, negative where `q` is; right in any case.
pub(super) fn higher(up: Vec2, p: Vec2, q: Vec2) -> f64 {
    // Both products are determinants: of the two points and the point at infinity to the right of `up`.
    let coord = |x: f64, y: f64, z: f64| Coord3D { x, y, z };
    orient3d(coord(p.x, p.y, 1.0), coord(q.x, q.y, 1.0), coord(up.y, -up.x, 0.0), coord(0.0, 0.0, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(from: [f64; 2], to: [f64; 2], center: [f64; 2], ccw: bool) -> Piece {
        let point = |[x, y]: [f64; 2]| Vec2::new(x, y);
        let radius = (point(from) - point(center)).length();
        Piece { from: point(from), to: point(to), circle: Some(Circle { center: point(center), radius, ccw }) }
    }

    #[test]
    fn heights_are_compared_exactly() {
        assert!(higher(Vec2::new(0.0, 1.0), Vec2::new(5.0, 2.0), Vec2::new(0.0, 1.0)) > 0.0);
        assert!(higher(Vec2::new(1.0, 0.0), Vec2::new(-1.0, 9.0), Vec2::new(1.0, 0.0)) < 0.0);
        // 0.1 * 3 and 0.3 * 1 are the same to rounding only.
        let up = Vec2::new(0.1, 0.3);
        let (p, q) = (Vec2::new(3.0, 0.0), Vec2::new(0.0, 1.0));
        assert!(higher(up, p, q) != 0.0 && higher(up, p, p) == 0.0);
    }

    #[test]
    fn arcs_know_their_extent_and_area() {
        let half = arc([1.0, 0.0], [-1.0, 0.0], [0.0, 0.0], true);
        assert_eq!(half.middle(), Vec2::new(0.0, 1.0));
        assert_eq!(half.bounds(), (Vec2::new(-1.0, 0.0), Vec2::new(1.0, 1.0)));
        assert!((half.doubled_area(Vec2::ZERO) - std::f64::consts::PI).abs() < 1e-15);
        let lower = arc([1.0, 0.0], [-1.0, 0.0], [0.0, 0.0], false);
        assert_eq!(lower.middle(), Vec2::new(0.0, -1.0));
        assert!((lower.doubled_area(Vec2::ZERO) + std::f64::consts::PI).abs() < 1e-15);
        let most = arc([1.0, 0.0], [0.0, -1.0], [0.0, 0.0], true);
        assert_eq!(most.bounds(), (Vec2::new(-1.0, -1.0), Vec2::new(1.0, 1.0)));
        assert!(most.apex(Vec2::new(0.0, 1.0)).is_some() && most.apex(Vec2::new(0.6, -0.8)).is_none());
    }
}
