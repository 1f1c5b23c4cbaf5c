//! Where eight rays cross one surface: what [`Plane`] and [`Quadric`] do for one ray, operation for operation.

use super::lanes::{F64s, Isa, LANES, Mask, Number, Vector};
use crate::geom::{Affine, Ray, Vec3};
use crate::surface::{Crossings, Plane, Quadric, QuadricKind, Surface};
use std::ops::{Add, Sub};

/// Eight rays, from one origin or from eight.
#[derive(Clone, Copy)]
pub(super) struct Rays<I: Isa, N> {
    pub origin: Vector<N>,
    pub direction: Vector<F64s<I>>,
}

impl<I: Isa, N: Number<I>> Rays<I, N> {
    /// One of them.
    fn lane(&self, i: usize) -> Ray {
        let at = |v: Vector<F64s<I>>| Vec3::new(v.x.stored().0[i], v.y.stored().0[i], v.z.stored().0[i]);
        Ray { origin: at(self.origin.map(Number::lanes)), direction: at(self.direction) }
    }
}

/// Where eight lines pass from one side of a surface to the other: as [`Crossings`], of two at most.
pub(super) struct Crossed<I: Isa> {
    /// Whether the line comes from inside.
    pub starts_inside: Mask<I>,
    /// The first crossing; infinite if there is none.
    pub a: F64s<I>,
    /// The second, not before the first; infinite if there is none.
    pub b: F64s<I>,
}

impl<I: Isa> Copy for Crossed<I> {}
impl<I: Isa> Clone for Crossed<I> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<I: Isa> Crossed<I> {
    /// Lines that stay outside.
    #[inline(always)]
    pub fn nowhere() -> Self {
        Self { starts_inside: Mask::splat(false), a: F64s::infinity(), b: F64s::infinity() }
    }

    /// As [`Sides::before`](crate::surface::Sides::before).
    #[inline(always)]
    pub fn before(&self, t: F64s<I>) -> Mask<I> {
        self.starts_inside ^ self.a.lt(t) ^ self.b.lt(t)
    }

    /// As [`Sides::after`](crate::surface::Sides::after).
    #[inline(always)]
    pub fn after(&self, t: F64s<I>) -> Mask<I> {
        self.starts_inside ^ self.a.le(t) ^ self.b.le(t)
    }

    /// As [`Sides::next`](crate::surface::Sides::next).
    #[inline(always)]
    pub fn next(&self, t: F64s<I>, wanted: bool) -> F64s<I> {
        let is_there = self.after(t) ^ Mask::splat(!wanted);
        // Two crossings at one place cancel each other.
        let first = self.a.lt(self.b).select(self.a, F64s::infinity());
        let second = self.b.gt(t).select(self.b, F64s::infinity());
        is_there.select(t, self.a.gt(t).select(first, second))
    }

    /// The other side of the surface is meant.
    #[inline(always)]
    pub fn negated(mut self, negated: bool) -> Self {
        self.starts_inside = self.starts_inside ^ Mask::splat(negated);
        self
    }

    /// Sets the lanes of `unusual` to what scalar code says.
    #[cold]
    #[inline(never)]
    fn set(&mut self, unusual: u8, crossings: impl Fn(usize) -> Crossings) {
        let (mut a, mut b) = (self.a.stored(), self.b.stored());
        let mut starts_inside = self.starts_inside.bits();
        for lane in (0..LANES).filter(|lane| unusual >> lane & 1 != 0) {
            let crossings = crossings(lane);
            let at = |i: usize| crossings.params().get(i).copied().unwrap_or(f64::INFINITY);
            (a.0[lane], b.0[lane]) = (at(0), at(1));
            starts_inside = starts_inside & !(1 << lane) | u8::from(crossings.starts_inside()) << lane;
        }
        (self.a, self.b) = (F64s::load(&a), F64s::load(&b));
        self.starts_inside = Mask::from_bits(starts_inside);
    }
}

/// The crossings of eight rays with a plane or a quadric; of anything else, none.
#[inline(always)]
pub(super) fn crossed_by<I: Isa, N: Number<I>>(surface: &Surface, rays: &Rays<I, N>) -> Crossed<I> {
    match surface {
        Surface::Plane(surface) => plane(surface, rays),
        Surface::Quadric(surface) => quadric(surface, rays),
        Surface::Torus(_) | Surface::Mesh(_) | Surface::Placed(_) => Crossed::nowhere(),
    }
}

/// As [`Affine::vector`].
#[inline(always)]
pub(super) fn vector<I: Isa, N: Number<I>>(map: &Affine, v: Vector<N>) -> Vector<N> {
    let row = |i: usize| Vector::<N>::from_one(map.rows[i]).dot(v);
    Vector::new(row(0), row(1), row(2))
}

/// As [`Affine::point`].
#[inline(always)]
pub(super) fn point<I: Isa, N: Number<I>>(map: &Affine, p: Vector<N>) -> Vector<N> {
    let (v, t) = (vector(map, p), Vector::<N>::from_one(map.translation));
    Vector::new(v.x + t.x, v.y + t.y, v.z + t.z)
}

/// As [`Plane::crossings`].
#[inline(always)]
pub(super) fn plane<I: Isa, N: Number<I>>(plane: &Plane, rays: &Rays<I, N>) -> Crossed<I> {
    let height = Vector::<N>::from_one(plane.normal).dot(rays.origin) - N::from_one(plane.offset);
    let slope = Vector::<F64s<I>>::from_one(plane.normal).dot(rays.direction);
    let t = -height.lanes() / slope + F64s::zero();
    let usual = t.is_finite();
    let mut crossed = Crossed { starts_inside: slope.gt(F64s::zero()), a: t, b: F64s::infinity() };
    if !usual.all() {
        crossed.set(!usual.bits(), |lane| plane.crossings(&rays.lane(lane)));
    }
    crossed
}

/// As [`Quadric::crossings`].
#[inline(always)]
pub(super) fn quadric<I: Isa, N: Number<I>>(quadric: &Quadric, rays: &Rays<I, N>) -> Crossed<I> {
    let o = point(&quadric.to_local, rays.origin);
    let d = vector(&quadric.to_local, rays.direction);
    // Each kind is compiled by itself.
    let crossed = match quadric.kind {
        QuadricKind::Sphere => solved::<I, N, Sphere>(o, d),
        QuadricKind::Cylinder => solved::<I, N, Cylinder>(o, d),
        QuadricKind::Cone => {
            let o = o.map(Number::lanes);
            let nearest = -o.dot(d) / d.dot(d);
            let o = Vector::new(o.x + d.x * nearest, o.y + d.y * nearest, o.z + d.z * nearest);
            let (mut crossed, usual) = solved::<I, F64s<I>, Cone>(o, d);
            (crossed.a, crossed.b) = (crossed.a + nearest, crossed.b + nearest);
            (crossed, usual & (crossed.a.is_finite() & crossed.b.is_finite()))
        }
    };
    let (mut crossed, usual) = crossed;
    if !usual.all() {
        crossed.set(!usual.bits(), |lane| quadric.crossings(&rays.lane(lane)));
    }
    crossed
}

/// A kind of quadric, known when compiling.
trait Kind {
    const KIND: QuadricKind;
}

struct Sphere;
struct Cylinder;
struct Cone;

impl Kind for Sphere {
    const KIND: QuadricKind = QuadricKind::Sphere;
}

impl Kind for Cylinder {
    const KIND: QuadricKind = QuadricKind::Cylinder;
}

impl Kind for Cone {
    const KIND: QuadricKind = QuadricKind::Cone;
}

/// The crossings of `o + t d`, in local coordinates; and in which lanes they are as usual.
#[inline(always)]
fn solved<I: Isa, N: Number<I>, K: Kind>(o: Vector<N>, d: Vector<F64s<I>>) -> (Crossed<I>, Mask<I>) {
    let (_, c0) = K::KIND.coefficients();
    let c = plus_z::<N, K>(o.x * o.x + o.y * o.y, o.z * o.z) + N::from_one(c0);
    let (c, o) = (c.lanes(), o.map(Number::lanes));
    let a = plus_z::<F64s<I>, K>(d.x * d.x + d.y * d.y, d.z * d.z);
    let b = plus_z::<F64s<I>, K>(o.x * d.x + o.y * d.y, o.z * d.z);
    let m = o.cross(d);
    let moment = plus_z::<F64s<I>, K>(m.z * m.z, m.x * m.x + m.y * m.y);
    let discriminant = F64s::splat(-c0) * a - moment;
    let root = discriminant.sqrt();
    let q = b.gt(F64s::zero()).select(-b - root, root - b);
    let (t0, t1) = (q / a, c / q);
    let ordered = t0.le(t1);
    let first = ordered.select(t0, t1) + F64s::zero();
    let second = ordered.select(t1, t0) + F64s::zero();
    let met = discriminant.gt(F64s::zero());
    let crossed = Crossed {
        starts_inside: a.lt(F64s::zero()),
        a: met.select(first, F64s::infinity()),
        b: met.select(second, F64s::infinity()),
    };
    // A sphere and a cylinder are missed from outside; whatever else is not two crossings is for the code that knows.
    let missed = match K::KIND {
        QuadricKind::Cone => Mask::splat(false),
        _ => discriminant.lt(F64s::zero()) & a.gt(F64s::zero()) & c.gt(F64s::zero()),
    };
    (crossed, missed | (met & first.is_finite() & second.is_finite()))
}

/// Adds what products of z coordinates count.
#[inline(always)]
fn plus_z<N: Add<Output = N> + Sub<Output = N>, K: Kind>(rest: N, product: N) -> N {
    match K::KIND {
        QuadricKind::Sphere => rest + product,
        QuadricKind::Cylinder => rest,
        QuadricKind::Cone => rest - product,
    }
}
