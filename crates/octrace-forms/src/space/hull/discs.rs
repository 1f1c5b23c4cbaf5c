//! The hull of discs in parallel planes, exactly: of upright cylinders and cones of any sizes and heights, and corners.
//!
//! The planes are horizontal here. A plane, not horizontal, that has all discs behind it has a normal
//! `(cos p, sin p, s)`, and touches discs `i` and `j` if `x_i cos p + y_i sin p + z_i s + r_i` has the same value for
//! both. Where their heights differ that gives `s`, and every other disc cuts an arc out of the angles `p` by an inequality
//! that is linear in the sine and cosine. Where arcs are left, the oblique cone through both circles is in the surface of
//! the hull; their ends are the normals of planar facets.
//!
//! So the hull is the union of these cones, each whole, and of the convex polyhedron of the points where facets touch
//! discs: as for balls, what is between that polyhedron and the surface of the hull lies in one of the cones.
//!
//! A corner is a disc of radius zero.

use super::super::arcs::{Arcs, Direction};
use super::super::convex::convex;
use super::super::frusta::between;
use octrace::{Bounds, Solid, Vec3};

/// A horizontal disc, or a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Disc {
    pub center: Vec3,
    /// Zero or more.
    pub radius: f64,
}

/// What is smaller than this, as a share of the size of everything, is rounding.
const NOISE: f64 = 1e-13;

/// Heights closer than this, as a share of the size of everything, are the same.
const LEVEL: f64 = 1e-9;

/// The hull of the discs. Costs about the third power of their number where all of them are on the hull.
pub(crate) fn hull(discs: &[Disc]) -> Solid {
    let Prepared { discs, noise, .. } = Prepared::new(discs, LEVEL);
    let mut touched: Vec<Vec3> = discs.iter().filter(|d| d.radius == 0.0).map(|d| d.center).collect();
    let mut cones = Vec::new();
    for Slant { discs: [a, b], arcs } in slants(&discs, noise) {
        let [foot, head] = [a, b].map(|d| (d.center, d.radius));
        cones.push(between(foot, head, [Vec3::X, Vec3::Y]));
        for end in arcs.ends() {
            touched.extend([a, b].map(|disc| disc.rim(end.outward())));
        }
    }
    let polyhedron = convex(&touched).map(Solid::primitive);
    Solid::union(polyhedron.into_iter().chain(cones))
}

impl Disc {
    /// The point of the rim in a horizontal direction of length one.
    pub fn rim(&self, outward: Vec3) -> Vec3 {
        self.center + outward * self.radius
    }
}

impl Direction {
    /// The direction as a horizontal one.
    pub fn outward(self) -> Vec3 {
        Vec3::new(self.cos, self.sin, 0.0)
    }
}

/// Discs that can be on the hull, with their heights made equal where they should be.
pub(super) struct Prepared {
    pub discs: Vec<Disc>,
    /// Length of the diagonal of the box around all discs.
    pub size: f64,
    /// Lengths below this are rounding.
    pub noise: f64,
}

impl Prepared {
    /// Heights closer than the share `level` of the size are made one.
    pub fn new(discs: &[Disc], level: f64) -> Self {
        let reach = |d: &Disc| [-1.0, 1.0].map(|sign| d.center + Vec3::new(d.radius, d.radius, 0.0) * sign);
        let size = Bounds::around(discs.iter().flat_map(reach)).diagonal();
        let noise = NOISE * size;
        Self { discs: without_hidden(&levelled(discs, level * size), noise), size, noise }
    }
}

/// Two discs at different heights that planes touch which have all others behind them.
pub(super) struct Slant {
    pub discs: [Disc; 2],
    /// The directions of the planes' normals, as seen from above.
    pub arcs: Arcs,
}

impl Slant {
    /// The normal at a direction from above; not of length one.
    pub fn normal(&self, outward: Vec3) -> Vec3 {
        let [a, b] = self.discs;
        let to_b = b.center - a.center;
        outward - Vec3::Z * ((to_b.dot(outward) + b.radius - a.radius) / to_b.z)
    }
}

/// All such pairs of discs.
pub(super) fn slants(discs: &[Disc], noise: f64) -> impl Iterator<Item = Slant> + '_ {
    let pairs = discs.iter().enumerate().flat_map(|(i, a)| discs[i + 1..].iter().map(move |b| [a, b]));
    pairs.filter(|[a, b]| a.center.z != b.center.z).filter_map(move |[a, b]| {
        let mut arcs = Arcs::Full;
        for other in discs.iter().filter(|&other| other != a && other != b) {
            if arcs.is_empty() {
                return None;
            }
            keep_clear_of(a, b, other, noise, &mut arcs);
        }
        (!arcs.is_empty()).then_some(Slant { discs: [*a, *b], arcs })
    })
}

/// The discs with heights that are equal or differ by more than rounding.
fn levelled(discs: &[Disc], tolerance: f64) -> Vec<Disc> {
    let mut levels: Vec<f64> = discs.iter().map(|d| d.center.z).collect();
    levels.sort_unstable_by(f64::total_cmp);
    levels.dedup_by(|z, kept| *z - *kept <= tolerance);
    let level = |z: f64| levels[levels.partition_point(|&l| l <= z).saturating_sub(1)];
    discs.iter().map(|d| Disc { center: Vec3::new(d.center.x, d.center.y, level(d.center.z)), ..*d }).collect()
}

/// The discs that are not part of another one at the same height; of equal ones the first.
fn without_hidden(discs: &[Disc], noise: f64) -> Vec<Disc> {
    let hides =
        |a: &Disc, b: &Disc| a.center.z == b.center.z && (a.center - b.center).length() + b.radius <= a.radius + noise;
    let hidden = |i: usize| {
        let disc = &discs[i];
        discs.iter().enumerate().any(|(j, other)| j != i && hides(other, disc) && (j < i || !hides(disc, other)))
    };
    (0..discs.len()).filter(|&i| !hidden(i)).map(|i| discs[i]).collect()
}

/// Keeps the angles for which the plane that touches `a` and `b` has `other` behind it.
fn keep_clear_of(a: &Disc, b: &Disc, other: &Disc, noise: f64, arcs: &mut Arcs) {
    let (to_b, to_other) = (b.center - a.center, other.center - a.center);
    let share = to_other.z / to_b.z;
    let u = to_other.x - share * to_b.x;
    let v = to_other.y - share * to_b.y;
    let limit = share * (b.radius - a.radius) - (other.radius - a.radius);
    let noise = noise * share.abs().max(1.0);
    let in_a_row = u.abs().max(v.abs()).max(limit.abs()) <= noise;
    if in_a_row && !(0.0 < share && share < 1.0) {
        // All cones of discs in a row are the same: that of the outermost ones will do.
        *arcs = Arcs::NONE;
    }
    arcs.keep(u, v, limit, noise);
}
