//! Where eight rays cross one surface: what [`Plane`] and [`Quadric`] do for one ray, operation for operation.

use super::lanes::{F64s, LANES, Mask, Vec3s};
use crate::geom::{Affine, Ray, Vec3};
use crate::surface::{Crossings, Plane, Quadric, QuadricKind};

/// Eight rays.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rays {
    pub origin: Vec3s,
    pub direction: Vec3s,
}

impl Rays {
    /// Sets one of them.
    pub fn set(&mut self, i: usize, ray: &Ray) {
        let put = |v: &mut Vec3s, p: Vec3| (v.x.0[i], v.y.0[i], v.z.0[i]) = (p.x, p.y, p.z);
        put(&mut self.origin, ray.origin);
        put(&mut self.direction, ray.direction);
    }

    /// One of them.
    #[inline(always)]
    pub fn lane(&self, i: usize) -> Ray {
        let at = |v: &Vec3s| Vec3::new(v.x.0[i], v.y.0[i], v.z.0[i]);
        Ray { origin: at(&self.origin), direction: at(&self.direction) }
    }
}

/// Where eight lines pass from one side of a surface to the other: as [`Crossings`], of two at most.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossed {
    /// Whether the line comes from inside.
    pub starts_inside: Mask,
    /// The first crossing; infinite if there is none.
    pub a: F64s,
    /// The second, not before the first; infinite if there is none.
    pub b: F64s,
}

impl Crossed {
    const NOWHERE: Self = Self { starts_inside: Mask::NONE, a: F64s::INFINITY, b: F64s::INFINITY };

    /// As [`Sides::before`](crate::surface::Sides::before).
    #[inline(always)]
    pub fn before(&self, t: F64s) -> Mask {
        self.starts_inside ^ self.a.lt(t) ^ self.b.lt(t)
    }

    /// As [`Sides::after`](crate::surface::Sides::after).
    #[inline(always)]
    pub fn after(&self, t: F64s) -> Mask {
        self.starts_inside ^ self.a.le(t) ^ self.b.le(t)
    }

    /// As [`Sides::next`](crate::surface::Sides::next).
    #[inline(always)]
    pub fn next(&self, t: F64s, wanted: bool) -> F64s {
        let is_there = !(self.after(t) ^ Mask::splat(wanted));
        // Two crossings at one place cancel each other.
        let first = self.a.lt(self.b).select(self.a, F64s::INFINITY);
        let second = self.b.gt(t).select(self.b, F64s::INFINITY);
        is_there.select(t, self.a.gt(t).select(first, second))
    }

    /// The other side of the surface is meant.
    #[inline(always)]
    pub fn negated(mut self, negated: bool) -> Self {
        self.starts_inside = self.starts_inside ^ Mask::splat(negated);
        self
    }

    /// Sets one lane to what scalar code says.
    fn set(&mut self, lane: usize, crossings: &Crossings) {
        let at = |i: usize| crossings.params().get(i).copied().unwrap_or(f64::INFINITY);
        self.starts_inside.set(lane, crossings.starts_inside());
        (self.a.0[lane], self.b.0[lane]) = (at(0), at(1));
    }
}

#[inline(always)]
fn splat(v: Vec3) -> Vec3s {
    Vec3s::new(F64s::splat(v.x), F64s::splat(v.y), F64s::splat(v.z))
}

#[inline(always)]
fn vector(map: &Affine, v: Vec3s) -> Vec3s {
    Vec3s::new(splat(map.rows[0]).dot(v), splat(map.rows[1]).dot(v), splat(map.rows[2]).dot(v))
}

#[inline(always)]
fn point(map: &Affine, p: Vec3s) -> Vec3s {
    let (v, t) = (vector(map, p), splat(map.translation));
    Vec3s::new(v.x + t.x, v.y + t.y, v.z + t.z)
}

/// As [`Plane::crossings`].
#[inline(always)]
pub(super) fn plane(plane: &Plane, rays: &Rays) -> Crossed {
    let normal = splat(plane.normal);
    let height = normal.dot(rays.origin) - F64s::splat(plane.offset);
    let slope = normal.dot(rays.direction);
    let t = -height / slope + F64s::ZERO;
    let usual = t.is_finite();
    let mut crossed = Crossed { starts_inside: slope.gt(F64s::ZERO), a: t, ..Crossed::NOWHERE };
    if !usual.all() {
        set_unusual(&mut crossed, usual, |lane| plane.crossings(&rays.lane(lane)));
    }
    crossed
}

/// As [`Quadric::crossings`].
#[inline(always)]
pub(super) fn quadric(quadric: &Quadric, rays: &Rays) -> Crossed {
    let origin = point(&quadric.to_local, rays.origin);
    let d = vector(&quadric.to_local, rays.direction);
    let (s, c0) = quadric.kind.coefficients();
    let is_cone = quadric.kind == QuadricKind::Cone;
    let (s, c0) = (F64s::splat(s), F64s::splat(c0));
    let (mut o, mut nearest) = (origin, F64s::ZERO);
    if is_cone {
        nearest = -origin.dot(d) / d.dot(d);
        o = Vec3s::new(origin.x + d.x * nearest, origin.y + d.y * nearest, origin.z + d.z * nearest);
    }
    let a = d.x * d.x + d.y * d.y + s * (d.z * d.z);
    let b = o.x * d.x + o.y * d.y + s * (o.z * d.z);
    let c = o.x * o.x + o.y * o.y + s * (o.z * o.z) + c0;
    let m = o.cross(d);
    let discriminant = -c0 * a - (m.z * m.z + s * (m.x * m.x + m.y * m.y));
    let root = discriminant.sqrt();
    let q = b.gt(F64s::ZERO).select(-b - root, root - b);
    let (t0, t1) = (q / a, c / q);
    let ordered = t0.le(t1);
    let (first, second) = (ordered.select(t0, t1), ordered.select(t1, t0));
    let (first, second) = match is_cone {
        true => (first + F64s::ZERO + nearest, second + F64s::ZERO + nearest),
        false => (first + F64s::ZERO, second + F64s::ZERO),
    };
    let met = discriminant.gt(F64s::ZERO);
    let mut crossed = Crossed {
        starts_inside: a.lt(F64s::ZERO),
        a: met.select(first, F64s::INFINITY),
        b: met.select(second, F64s::INFINITY),
    };
    // A sphere and a cylinder are missed from outside; whatever else is not two crossings is for the code that knows.
    let missed = match is_cone {
        true => Mask::NONE,
        false => discriminant.lt(F64s::ZERO) & a.gt(F64s::ZERO) & c.gt(F64s::ZERO),
    };
    let usual = missed | (met & first.is_finite() & second.is_finite());
    if !usual.all() {
        set_unusual(&mut crossed, usual, |lane| quadric.crossings(&rays.lane(lane)));
    }
    crossed
}

#[cold]
fn set_unusual(crossed: &mut Crossed, usual: Mask, crossings: impl Fn(usize) -> Crossings) {
    for lane in (0..LANES).filter(|&lane| !usual.get(lane)) {
        crossed.set(lane, &crossings(lane));
    }
}
