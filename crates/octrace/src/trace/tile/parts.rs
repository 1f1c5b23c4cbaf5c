//! Parts of space that rays are in, against which surfaces are classified, all eight at once, as cells are
//! ([`Surface::classify`](crate::surface::Surface::classify)).
//!
//! Each of the eight parts of a tile's beam, cut off at two depths, lies in a parallelepiped, as do bundles of rays of a stream.

use super::beam::Beam;
use super::crossing::{point, vector};
use super::lanes::{F64s, Isa, Vector};
use super::torus::from_ring;
use crate::geom::{Affine, Vec3};
use crate::surface::{CellBox, Plane, Quadric, QuadricKind, Torus};

/// Eight parts of space, each a parallelepiped: along some rays between two depths, and some way across.
pub(super) struct Parts<I: Isa, A> {
    /// The rays in the middles.
    pub origin: Vector<F64s<I>>,
    pub direction: Vector<F64s<I>>,
    /// Depths of the middles, and half their range.
    pub depth: F64s<I>,
    pub half_depth: F64s<I>,
    /// How far they reach across.
    pub across: A,
    pub margin: f64,
}

/// Parts in a surface's coordinates.
#[derive(Clone, Copy)]
struct Local<I: Isa> {
    middle: Vector<F64s<I>>,
    /// How far they reach along the rays.
    along: Vector<F64s<I>>,
    /// What the margin, and what rounding, may come to.
    extra: Vec3,
    /// How far they reach along each axis.
    reach: Vector<F64s<I>>,
}

/// How far parts reach across.
pub(super) trait Across<I: Isa> {
    /// By how much points differ at most from the middle, times that vector.
    fn reach(&self, along: Vec3) -> F64s<I>;
    /// By how much they differ at most in local coordinates, times that slope.
    fn change(&self, map: &Affine, slope: Vector<F64s<I>>) -> F64s<I>;
}

/// All parts are as wide: half their extents along the film.
pub(super) struct Film {
    pub sides: [Vec3; 2],
}

/// Each part reaches as far along the axes as a box does.
pub(super) struct Boxes<I: Isa> {
    pub half: Vector<F64s<I>>,
}

impl<I: Isa> Across<I> for Film {
    #[inline(always)]
    fn reach(&self, along: Vec3) -> F64s<I> {
        F64s::splat(along.dot(self.sides[0]).abs() + along.dot(self.sides[1]).abs())
    }

    #[inline(always)]
    fn change(&self, map: &Affine, slope: Vector<F64s<I>>) -> F64s<I> {
        let [a, b] = self.sides.map(|side| map.vector(side));
        Vector::<F64s<I>>::from_one(a).dot(slope).abs() + Vector::<F64s<I>>::from_one(b).dot(slope).abs()
    }
}

impl<I: Isa> Across<I> for Boxes<I> {
    #[inline(always)]
    fn reach(&self, along: Vec3) -> F64s<I> {
        Vector::<F64s<I>>::from_one(along.abs()).dot(self.half)
    }

    #[inline(always)]
    fn change(&self, map: &Affine, slope: Vector<F64s<I>>) -> F64s<I> {
        let x = Vector::<F64s<I>>::from_one(map.column(0)).dot(slope).abs();
        let y = Vector::<F64s<I>>::from_one(map.column(1)).dot(slope).abs();
        let z = Vector::<F64s<I>>::from_one(map.column(2)).dot(slope).abs();
        Vector::new(x, y, z).dot(self.half)
    }
}

impl<I: Isa> Parts<I, Film> {
    /// The parts of a beam between the depths, with a margin all around, seen from `from`.
    #[inline(always)]
    pub fn of_beam(beam: &Beam, (near, far): (f64, f64), margin: f64, from: Vec3) -> Self {
        let (origin, direction) = beam.middles();
        let origin = origin.minus::<I>(from);
        let sides = match beam.parallel {
            true => beam.half_part,
            false => beam.half_part.map(|side| side * far),
        };
        let (depth, half_depth) = (F64s::splat(0.5 * (near + far)), F64s::splat(0.5 * (far - near)));
        Self { origin, direction, depth, half_depth, across: Film { sides }, margin }
    }
}

impl<I: Isa, A: Across<I>> Parts<I, A> {
    /// In which parts a plane's inside is everywhere, and in which it is nowhere.
    #[inline(always)]
    pub fn plane(&self, plane: &Plane) -> (u8, u8) {
        let normal = Vector::<F64s<I>>::from_one(plane.normal);
        let slope = normal.dot(self.direction);
        let height = normal.dot(self.origin) - F64s::splat(plane.offset) + slope * self.depth;
        let margin = plane.normal.abs().dot(Vec3::splat(self.margin));
        let reach = slope.abs() * self.half_depth + self.across.reach(plane.normal) + F64s::splat(margin);
        (height.le(-reach).bits(), height.ge(reach).bits())
    }

    /// The parts in local coordinates.
    #[inline(always)]
    fn local(&self, map: &Affine) -> Local<I> {
        let along = vector(map, self.direction);
        let origin = point(map, self.origin);
        let at = |o: F64s<I>, d: F64s<I>| o + d * self.depth;
        let middle = Vector::new(at(origin.x, along.x), at(origin.y, along.y), at(origin.z, along.z));
        let along = along.map(|v| v * self.half_depth);
        let margin = Vec3::from(map.rows.map(|row| row.abs().dot(Vec3::splat(self.margin))));
        let extra = margin + margin * CellBox::ROUNDING_IN_MARGINS;
        let reach = Vector::new(
            along.x.abs() + self.across.reach(map.rows[0]) + F64s::splat(extra.x),
            along.y.abs() + self.across.reach(map.rows[1]) + F64s::splat(extra.y),
            along.z.abs() + self.across.reach(map.rows[2]) + F64s::splat(extra.z),
        );
        Local { middle, along, extra, reach }
    }

    /// By how much, at most, something with that slope in local coordinates changes from the middle.
    #[inline(always)]
    fn change(&self, map: &Affine, local: &Local<I>, slope: Vector<F64s<I>>) -> F64s<I> {
        let Local { along, extra, .. } = *local;
        slope.dot(along).abs()
            + self.across.change(map, slope)
            + slope.x.abs() * F64s::splat(extra.x)
            + slope.y.abs() * F64s::splat(extra.y)
            + slope.z.abs() * F64s::splat(extra.z)
    }

    /// As [`plane`](Self::plane), for a torus; see [`Torus::classify`].
    #[inline(always)]
    pub fn torus(&self, torus: &Torus) -> (u8, u8) {
        let local = self.local(&torus.to_local);
        let (q, reach) = (local.middle, local.reach);
        let (zero, half) = (F64s::zero(), F64s::splat(0.5));
        let (ring, minor) = (F64s::splat(torus.kind.ring()), F64s::splat(torus.minor));
        let length = |x: F64s<I>, y: F64s<I>| (x * x + y * y).sqrt();
        let rho = length(q.x, q.y);
        let distance = length(rho - ring, q.z);
        let radius = reach.dot(reach).sqrt();
        let (low, high) = (distance - radius, distance + radius);
        let least_rho = rho - radius;
        let slope = from_ring(torus, q).map(|v| v / distance);
        let (linear, bend) = (self.change(&torus.to_local, &local, slope), radius * radius * half);
        let is_smooth = least_rho.gt(zero) & low.gt(zero);
        let fine_low = is_smooth.select(distance - linear - bend / least_rho, low);
        let fine_high = is_smooth.select(distance + linear + bend / low.min(least_rho), high);
        let (low, high) = (low.max(fine_low), high.min(fine_high));

        let least = |v: F64s<I>, reach: F64s<I>| (v.abs() - reach).max(zero);
        let rho_low = length(least(q.x, reach.x), least(q.y, reach.y));
        let rho_high = length(q.x.abs() + reach.x, q.y.abs() + reach.y);
        let nearest = (rho_low - ring).max(ring - rho_high).max(zero);
        let farthest = (rho_high - ring).max(ring - rho_low);
        let low = low.max(length(nearest, least(q.z, reach.z)));
        let high = high.min(length(farthest, q.z.abs() + reach.z));
        let outside = low.ge(minor).bits();
        (high.le(minor).bits() & !outside, outside)
    }

    /// As [`plane`](Self::plane), for a quadric; see [`Quadric::classify`].
    #[inline(always)]
    pub fn quadric(&self, quadric: &Quadric) -> (u8, u8) {
        let map = &quadric.to_local;
        let (s, c0) = quadric.kind.coefficients();
        let local = self.local(map);
        let Local { middle: q, reach, .. } = local;
        // The mean value form: the parts are thin, and where they are long they are cut.
        let (s_lanes, c0, two) = (F64s::splat(s), F64s::splat(c0), F64s::splat(2.0));
        let value = q.x * q.x + q.y * q.y + s_lanes * (q.z * q.z) + c0;
        let slope = Vector::new(two * q.x, two * q.y, two * s_lanes * q.z);
        let linear = self.change(map, &local, slope);
        let (flat, up) = (reach.x * reach.x + reach.y * reach.y, reach.z * reach.z);
        let (bulge_low, bulge_high) = match quadric.kind {
            QuadricKind::Sphere => (F64s::zero(), flat + up),
            QuadricKind::Cylinder => (F64s::zero(), flat),
            QuadricKind::Cone => (-up, flat),
        };
        let zero = F64s::zero();
        let outside = (value - linear + bulge_low).ge(zero).bits();
        let inside = (value + linear + bulge_high).le(zero).bits();
        (inside & !outside, outside)
    }
}
