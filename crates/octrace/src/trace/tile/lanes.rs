//! Eight numbers at once.
//!
//! Plain arrays and plain loops: compiled for a machine with wide registers (see [`super::dispatch`]) each operation
//! becomes one or two instructions. Every lane does what scalar code does, operation for operation, so the bits are the same.

use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// How many lanes there are.
pub(super) const LANES: usize = 8;

const YES: u64 = !0;
const NO: u64 = 0;

/// Eight numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(64))]
pub(super) struct F64s(pub [f64; LANES]);

/// Eight times yes (all bits set) or no (none).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(align(64))]
pub(super) struct Mask([u64; LANES]);

/// Combines lane by lane.
macro_rules! lanewise {
    ($trait:ident, $method:ident, $type:ident, $operator:tt) => {
        impl $trait for $type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                Self(std::array::from_fn(|i| self.0[i] $operator o.0[i]))
            }
        }
    };
}

lanewise!(Add, add, F64s, +);
lanewise!(Sub, sub, F64s, -);
lanewise!(Mul, mul, F64s, *);
lanewise!(Div, div, F64s, /);
lanewise!(BitAnd, bitand, Mask, &);
lanewise!(BitOr, bitor, Mask, |);
lanewise!(BitXor, bitxor, Mask, ^);

impl Neg for F64s {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0.map(|v| -v))
    }
}

impl Not for Mask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0.map(|v| !v))
    }
}

/// Compares lane by lane.
macro_rules! comparison {
    ($(#[$doc:meta])* $name:ident, $operator:tt) => {
        $(#[$doc])*
        #[inline(always)]
        pub fn $name(self, o: Self) -> Mask {
            Mask(std::array::from_fn(|i| if self.0[i] $operator o.0[i] { YES } else { NO }))
        }
    };
}

impl F64s {
    pub const ZERO: Self = Self([0.0; LANES]);
    pub const INFINITY: Self = Self([f64::INFINITY; LANES]);

    #[inline(always)]
    pub fn splat(v: f64) -> Self {
        Self([v; LANES])
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    comparison!(lt, <);
    comparison!(le, <=);
    comparison!(gt, >);
    comparison!(eq, ==);

    /// The smaller of both; `self` where one is no number.
    #[inline(always)]
    pub fn min(self, o: Self) -> Self {
        o.lt(self).select(o, self)
    }

    /// The larger of both; `self` where one is no number.
    #[inline(always)]
    pub fn max(self, o: Self) -> Self {
        o.gt(self).select(o, self)
    }

    /// Which are numbers, and not infinite.
    #[inline(always)]
    pub fn is_finite(self) -> Mask {
        Mask(self.0.map(|v| if v.abs() < f64::INFINITY { YES } else { NO }))
    }
}

impl Mask {
    pub const NONE: Self = Self([NO; LANES]);

    #[inline(always)]
    pub fn splat(v: bool) -> Self {
        Self([if v { YES } else { NO }; LANES])
    }

    #[inline(always)]
    pub fn get(self, lane: usize) -> bool {
        self.0[lane] != NO
    }

    #[inline(always)]
    pub fn set(&mut self, lane: usize, v: bool) {
        self.0[lane] = if v { YES } else { NO };
    }

    /// `a` where yes, `b` where no.
    #[inline(always)]
    pub fn select_words(self, a: [u64; LANES], b: [u64; LANES]) -> [u64; LANES] {
        std::array::from_fn(|i| (a[i] & self.0[i]) | (b[i] & !self.0[i]))
    }

    /// `a` where yes, `b` where no.
    #[inline(always)]
    pub fn select(self, a: F64s, b: F64s) -> F64s {
        F64s(std::array::from_fn(|i| if self.0[i] != NO { a.0[i] } else { b.0[i] }))
    }

    #[inline(always)]
    pub fn any(self) -> bool {
        self.0.iter().fold(NO, |any, lane| any | lane) != NO
    }

    /// How many are yes.
    #[inline(always)]
    pub fn count(self) -> u64 {
        self.0.iter().map(|lane| lane & 1).sum()
    }

    #[inline(always)]
    pub fn all(self) -> bool {
        !(!self).any()
    }
}

/// Eight points or directions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Vec3s {
    pub x: F64s,
    pub y: F64s,
    pub z: F64s,
}

impl Vec3s {
    #[inline(always)]
    pub fn new(x: F64s, y: F64s, z: F64s) -> Self {
        Self { x, y, z }
    }

    /// As [`Vec3::dot`](crate::geom::Vec3::dot).
    #[inline(always)]
    pub fn dot(self, o: Self) -> F64s {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    /// As [`Vec3::cross`](crate::geom::Vec3::cross).
    #[inline(always)]
    pub fn cross(self, o: Self) -> Self {
        Self::new(self.y * o.z - self.z * o.y, self.z * o.x - self.x * o.z, self.x * o.y - self.y * o.x)
    }
}
