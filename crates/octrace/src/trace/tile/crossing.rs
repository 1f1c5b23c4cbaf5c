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
    /// Points along them.
    #[inline(always)]
    pub fn at(&self, t: F64s<I>) -> Vector<F64s<I>> {
        let (o, d) = (self.origin.map(Number::lanes), self.direction);
        Vector::new(o.x + d.x * t, o.y + d.y * t, o.z + d.z * t)
    }

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
        let parallel = slope.le(F64s::zero()) & slope.ge(F64s::zero());
        crossed.starts_inside = parallel & height.lanes().lt(F64s::zero()) | !parallel & crossed.starts_inside;
        crossed.a = parallel.select(F64s::infinity(), t);
        let usual = usual | parallel;
        if !usual.all() {
            crossed.set(!usual.bits(), |lane| plane.crossings(&rays.lane(lane)));
        }
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
            let met = crossed.a.is_finite();
            (crossed.a, crossed.b) = (crossed.a + nearest, crossed.b + nearest);
            (crossed, usual & (!met | crossed.a.is_finite() & crossed.b.is_finite()))
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
    let met = discriminant.gt(F64s::zero());
    if !met.any() && !matches!(K::KIND, QuadricKind::Cone) {
        // As below.
        let missed = discriminant.lt(F64s::zero()) & a.gt(F64s::zero()) & c.gt(F64s::zero());
        return (Crossed::nowhere(), missed);
    }
    let root = discriminant.sqrt();
    let q = b.gt(F64s::zero()).select(-b - root, root - b);
    let (t0, t1) = (q / a, c / q);
    let ordered = t0.le(t1);
    let first = ordered.select(t0, t1) + F64s::zero();
    let second = ordered.select(t1, t0) + F64s::zero();
    // Lines that miss the surface, and those of them that are inside.
    let (missed, inside) = match K::KIND {
        QuadricKind::Cone => {
            let curved = a.lt(F64s::zero()) | a.gt(F64s::zero());
            let by_direction = (a.abs() * o.dot(o)).ge(c.abs() * d.dot(d));
            let inside = by_direction & a.lt(F64s::zero()) | !by_direction & c.lt(F64s::zero());
            (discriminant.le(F64s::zero()) & curved, inside)
        }
        // From outside; whatever else is not two crossings is for the code that knows.
        QuadricKind::Sphere | QuadricKind::Cylinder => {
            (discriminant.lt(F64s::zero()) & a.gt(F64s::zero()) & c.gt(F64s::zero()), Mask::splat(false))
        }
    };
    let crossed = Crossed {
        starts_inside: met & a.lt(F64s::zero()) | missed & inside,
        a: met.select(first, F64s::infinity()),
        b: met.select(second, F64s::infinity()),
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

#[cfg(test)]
mod tests {
    use super::super::dispatch::{Backend, Task};
    use super::super::lanes::Stored;
    use super::*;

    /// Says for eight rays which come from inside, and where they cross a surface.
    struct Cross<'a>(&'a Surface, &'a [[Stored; 3]; 2], &'a mut (u8, [Stored; 2]));

    impl Task for Cross<'_> {
        #[inline(always)]
        fn run<I: Isa>(self) {
            let Self(surface, [origin, direction], result) = self;
            let rays = Rays::<I, F64s<I>> { origin: Vector::load(origin), direction: Vector::load(direction) };
            let Crossed { starts_inside, a, b } = crossed_by(surface, &rays);
            *result = (starts_inside.bits(), [a.stored(), b.stored()]);
        }
    }

    /// Small integers and their neighbours: rays along axes and generators, through apexes, in faces.
    fn some_rays() -> Vec<Ray> {
        let mut state = 1_u64;
        let mut next = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let whole = ((state >> 33) % 5) as f64 - 2.0;
            if state >> 60 & 3 == 0 { whole + (state >> 40 & 0xFFFF) as f64 * 1e-5 } else { whole }
        };
        let mut three = move || Vec3::new(next(), next(), next());
        let rays = std::iter::from_fn(|| Some((three(), three())));
        rays.filter_map(|(origin, direction)| Ray::checked(origin, direction)).take(80_000).collect()
    }

    #[test]
    fn eight_rays_cross_where_one_does() {
        let turned = Affine::rotation_deg(Vec3::new(10.0, 20.0, 30.0));
        let quadric = |kind, to_local| Surface::Quadric(Quadric { kind, to_local });
        let mut surfaces = vec![
            Surface::Plane(Plane { normal: Vec3::Z, offset: 1.0 }),
            Surface::Plane(Plane { normal: Vec3::new(0.6, 0.0, -0.8), offset: 0.0 }),
        ];
        for kind in [QuadricKind::Sphere, QuadricKind::Cylinder, QuadricKind::Cone] {
            surfaces.extend([quadric(kind, Affine::IDENTITY), quadric(kind, turned)]);
        }
        let rays = some_rays();
        for (surface, rays) in
            surfaces.iter().flat_map(|surface| rays.chunks_exact(LANES).map(move |rays| (surface, rays)))
        {
            let stored =
                |of: fn(&Ray) -> Vec3| [0, 1, 2].map(|axis| Stored(std::array::from_fn(|lane| of(&rays[lane])[axis])));
            let eight = [stored(|ray| ray.origin), stored(|ray| ray.direction)];
            for backend in Backend::ALL {
                let mut found = Default::default();
                backend.run(Cross(surface, &eight, &mut found));
                let (starts_inside, [a, b]) = found;
                for (lane, ray) in rays.iter().enumerate() {
                    let mut params = Vec::new();
                    let expected = surface.crossings(&[], ray, &mut params);
                    params.resize(2, f64::INFINITY);
                    let crossings = (starts_inside >> lane & 1 != 0, a.0[lane].to_bits(), b.0[lane].to_bits());
                    let expected = (expected, params[0].to_bits(), params[1].to_bits());
                    assert_eq!(crossings, expected, "{surface:?}, {ray:?}, {backend:?}");
                }
            }
        }
    }
}
