//! The hull of balls, exactly.
//!
//! A plane that touches balls `i` and `j` and has all balls behind it has a normal `n` with `n . (c_j - c_i) = r_i - r_j`:
//! these normals are a circle, and every other ball cuts an arc out of it, for `n . (c_k - c_i) <= r_i - r_k` is linear in
//! the sine and cosine of the angle along the circle. Where arcs are left, the cone that touches both balls is in the
//! surface of the hull; their ends are the normals of planar facets.
//!
//! So the hull is the union of the balls, of the parts of those cones between the circles where they touch, and of the
//! convex polyhedron of the points where facets touch balls. Each of these lies in the hull; and what is between the
//! polyhedron and the surface of the hull is above one of its faces: above points of one ball, hence in the ball, or
//! between two arcs of touching points, hence in the cone.
//!
//! A corner is a ball of radius zero. Nothing here can go wrong by much: an arc lost or won to rounding changes the union
//! by what is thinner than rounding.

use super::super::arcs::Arcs;
use super::super::convex::convex;
use super::super::frusta::{across, frustum};
use octrace::{Bounds, Solid, Vec3};

/// A ball, or a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ball {
    pub center: Vec3,
    /// Zero or more.
    pub radius: f64,
}

/// What is smaller than this, as a share of the size of everything, is rounding.
const NOISE: f64 = 1e-13;

/// The hull of the balls. Costs about the third power of their number where all of them are on the hull.
pub(crate) fn hull(balls: &[Ball]) -> Solid {
    let reach = |b: &Ball| [b.center - Vec3::splat(b.radius), b.center + Vec3::splat(b.radius)];
    let size = Bounds::around(balls.iter().flat_map(reach)).diagonal();
    let noise = NOISE * size;
    let balls = without_hidden(balls, noise);
    let mut parts: Vec<Solid> = Vec::new();
    let mut touched: Vec<Vec3> = balls.iter().filter(|b| b.radius == 0.0).map(|b| b.center).collect();
    let mut on_hull = vec![balls.len() == 1; balls.len()];
    let mut cones = Vec::new();
    for (i, a) in balls.iter().enumerate() {
        for (j, b) in balls.iter().enumerate().skip(i + 1) {
            let Some(pair) = Pair::new(a, b) else { continue };
            let mut arcs = Arcs::Full;
            for (k, other) in balls.iter().enumerate() {
                if k != i && k != j && !arcs.is_empty() {
                    pair.keep_clear_of(other, noise, &mut arcs);
                }
            }
            if arcs.is_empty() {
                continue;
            }
            (on_hull[i], on_hull[j]) = (true, true);
            cones.push(pair.cone());
            for end in arcs.ends() {
                let normal = pair.normal(end.cos, end.sin);
                touched.extend([a, b].map(|ball| ball.center + normal * ball.radius));
            }
        }
    }
    parts.extend(convex(&touched).map(Solid::primitive));
    parts.extend(cones);
    let round = balls.iter().zip(on_hull).filter(|(ball, on_hull)| *on_hull && ball.radius > 0.0);
    parts.extend(round.map(|(ball, _)| Solid::sphere().scale(Vec3::splat(ball.radius)).translate(ball.center)));
    Solid::union(parts)
}

/// The balls that are not inside of another one; of equal ones the first.
fn without_hidden(balls: &[Ball], noise: f64) -> Vec<Ball> {
    let hides = |a: &Ball, b: &Ball| (a.center - b.center).length() + b.radius <= a.radius + noise;
    let hidden = |i: usize| {
        let ball = &balls[i];
        balls.iter().enumerate().any(|(j, other)| j != i && hides(other, ball) && (j < i || !hides(ball, other)))
    };
    (0..balls.len()).filter(|&i| !hidden(i)).map(|i| balls[i]).collect()
}

/// Two balls of which none hides the other, and the planes that touch both.
struct Pair<'a> {
    a: &'a Ball,
    b: &'a Ball,
    /// From `a` to `b`, of length one.
    axis: Vec3,
    length: f64,
    /// Across the axis and each other.
    sides: [Vec3; 2],
    /// The normals' part along the axis, and the length of the rest.
    cos: f64,
    sin: f64,
}

impl<'a> Pair<'a> {
    fn new(a: &'a Ball, b: &'a Ball) -> Option<Self> {
        let offset = b.center - a.center;
        let axis = offset.normalized()?;
        let length = offset.length();
        let cos = (a.radius - b.radius) / length;
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        Some(Self { a, b, axis, length, sides: across(axis), cos, sin })
    }

    /// The normal at an angle about the axis.
    fn normal(&self, cos: f64, sin: f64) -> Vec3 {
        self.axis * self.cos + (self.sides[0] * cos + self.sides[1] * sin) * self.sin
    }

    /// Keeps the angles for which the plane has `other` behind it.
    fn keep_clear_of(&self, other: &Ball, noise: f64, arcs: &mut Arcs) {
        let offset = other.center - self.a.center;
        let limit = self.a.radius - other.radius - self.cos * self.axis.dot(offset);
        let [u, v] = self.sides.map(|side| self.sin * side.dot(offset));
        let along = self.axis.dot(offset);
        let in_a_row = u.abs().max(v.abs()).max(limit.abs()) <= noise;
        if in_a_row && !(0.0 < along && along < self.length) {
            // All cones of balls in a row are the same: that of the outermost ones will do.
            *arcs = Arcs::NONE;
        }
        arcs.keep(u, v, limit, noise);
    }

    /// The part of the touching cone between the circles where it touches.
    fn cone(&self) -> Solid {
        let end = |ball: &Ball| (ball.center + self.axis * (self.cos * ball.radius), self.sin * ball.radius);
        frustum(end(self.a), end(self.b))
    }
}
