//! Points and directions of eight lanes.

use super::{F64s, Isa, LANES, Mask, Stored};
use crate::geom::Vec3;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// One number for all lanes, or eight.
pub(crate) trait Number<I: Isa>: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    fn from_one(v: f64) -> Self;
    /// In eight lanes.
    fn lanes(self) -> F64s<I>;
}

impl<I: Isa> Number<I> for f64 {
    #[inline(always)]
    fn from_one(v: f64) -> Self {
        v
    }

    #[inline(always)]
    fn lanes(self) -> F64s<I> {
        F64s::splat(self)
    }
}

impl<I: Isa> Number<I> for F64s<I> {
    #[inline(always)]
    fn from_one(v: f64) -> Self {
        Self::splat(v)
    }

    #[inline(always)]
    fn lanes(self) -> Self {
        self
    }
}

/// Points or directions: eight, or one for all lanes.
#[derive(Clone, Copy)]
pub(crate) struct Vector<N> {
    pub x: N,
    pub y: N,
    pub z: N,
}

impl<N: Copy> Vector<N> {
    #[inline(always)]
    pub fn new(x: N, y: N, z: N) -> Self {
        Self { x, y, z }
    }

    #[inline(always)]
    pub fn map<M>(self, f: impl Fn(N) -> M) -> Vector<M> {
        Vector { x: f(self.x), y: f(self.y), z: f(self.z) }
    }

    /// As [`Vec3::dot`], of the two in this order.
    #[inline(always)]
    pub fn dot(self, o: Self) -> N
    where
        N: Add<Output = N> + Mul<Output = N>,
    {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    /// As [`Vec3::cross`].
    #[inline(always)]
    pub fn cross(self, o: Self) -> Self
    where
        N: Sub<Output = N> + Mul<Output = N>,
    {
        Self::new(self.y * o.z - self.z * o.y, self.z * o.x - self.x * o.z, self.x * o.y - self.y * o.x)
    }
}

impl<N> Vector<N> {
    /// The same for all lanes.
    #[inline(always)]
    pub fn from_one<I: Isa>(v: Vec3) -> Self
    where
        N: Number<I>,
    {
        Self { x: N::from_one(v.x), y: N::from_one(v.y), z: N::from_one(v.z) }
    }

    /// Less the same for all lanes.
    #[inline(always)]
    pub fn minus<I: Isa>(self, v: Vec3) -> Self
    where
        N: Number<I>,
    {
        let v = Self::from_one(v);
        Self { x: self.x - v.x, y: self.y - v.y, z: self.z - v.z }
    }
}

impl<N: Add<Output = N>> Add for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self { x: self.x + o.x, y: self.y + o.y, z: self.z + o.z }
    }
}

impl<N: Sub<Output = N>> Sub for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self { x: self.x - o.x, y: self.y - o.y, z: self.z - o.z }
    }
}

impl<N: Neg<Output = N>> Neg for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl<N: Copy + Mul<Output = N>> Mul<N> for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: N) -> Self {
        Self { x: self.x * s, y: self.y * s, z: self.z * s }
    }
}

impl<N: Copy + Div<Output = N>> Div<N> for Vector<N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, s: N) -> Self {
        Self { x: self.x / s, y: self.y / s, z: self.z / s }
    }
}

impl<I: Isa> Vector<F64s<I>> {
    #[inline(always)]
    pub fn load([x, y, z]: &[Stored; 3]) -> Self {
        Self::new(F64s::load(x), F64s::load(y), F64s::load(z))
    }

    #[inline(always)]
    pub fn stored(self) -> [Stored; 3] {
        [self.x.stored(), self.y.stored(), self.z.stored()]
    }

    /// `yes` where the mask says so.
    #[inline(always)]
    pub fn select(mask: Mask<I>, yes: Self, no: Self) -> Self {
        Self::new(mask.select(yes.x, no.x), mask.select(yes.y, no.y), mask.select(yes.z, no.z))
    }

    /// As [`Vec3::max_abs`], of numbers.
    #[inline(always)]
    pub fn max_abs(self) -> F64s<I> {
        self.x.abs().max(self.y.abs()).max(self.z.abs())
    }

    /// As [`Vec3::normalized`]; and which lanes have a direction.
    #[inline(always)]
    pub fn normalized(self) -> (Self, Mask<I>) {
        let squared = self.dot(self);
        let unit = self / squared.sqrt();
        let usual = squared.ge(F64s::splat(1e-200)) & squared.lt(F64s::splat(1e200));
        if usual.all() {
            return (unit, usual);
        }
        let mut stored = unit.stored();
        let found = normalize(&self.stored(), !usual.bits(), &mut stored);
        (Self::load(&stored), usual | Mask::from_bits(found))
    }
}

/// Sets the directions of some lanes to what scalar code says; says which have one.
#[cold]
#[inline(never)]
fn normalize(v: &[Stored; 3], lanes: u8, unit: &mut [Stored; 3]) -> u8 {
    let mut found = 0;
    for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
        let Some(direction) = Vec3::new(v[0].0[lane], v[1].0[lane], v[2].0[lane]).normalized() else { continue };
        found |= 1 << lane;
        for axis in 0..3 {
            unit[axis].0[lane] = direction[axis];
        }
    }
    found
}
