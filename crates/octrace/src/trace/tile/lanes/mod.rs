//! Eight numbers at once.
//!
//! Every lane does what scalar code does, operation for operation, so the bits are the same on every machine. What does it
//! is an [`Isa`]: plain loops over arrays, which the compiler makes as wide as it was told to, or the intrinsics of AVX-512,
//! whose masks are no arrays. Code is written once, for any of them.

mod arrays;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod power;
mod vector;

#[cfg(target_arch = "x86_64")]
pub(super) use arrays::Avx2;
pub(super) use arrays::Portable;
#[cfg(target_arch = "x86_64")]
pub(super) use avx512::Avx512;
pub(crate) use vector::{Number, Vector};

use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// How many rays are traced at once.
pub const LANES: usize = 8;

/// Eight numbers in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(64))]
pub struct Stored(pub [f64; LANES]);

/// Something to do that is compiled as a function of its own, for an instruction set. Its `run` must be `#[inline(always)]`.
pub(crate) trait Kernel {
    fn run(self);
}

/// An instruction set: what can be done with eight numbers.
///
/// Its functions are safe to call only on machines that have it: see [`super::dispatch`], the only place that chooses one.
pub(crate) trait Isa: Copy {
    /// Eight numbers.
    type Numbers: Copy;
    /// Eight times yes or no.
    type Mask: Copy;

    /// Runs something, compiled for this instruction set and not as part of the caller.
    fn call<K: Kernel>(kernel: K);

    fn splat(v: f64) -> Self::Numbers;
    fn load(v: &Stored) -> Self::Numbers;
    fn store(v: Self::Numbers) -> Stored;
    fn add(a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn sub(a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn mul(a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn div(a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn sqrt(v: Self::Numbers) -> Self::Numbers;
    fn neg(v: Self::Numbers) -> Self::Numbers;
    fn abs(v: Self::Numbers) -> Self::Numbers;
    /// `b < a ? b : a`.
    fn min(a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// `b > a ? b : a`.
    fn max(a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// The least of eight numbers, of which none is NaN.
    fn least(v: Self::Numbers) -> f64;
    /// The greatest of eight numbers, of which none is NaN.
    fn greatest(v: Self::Numbers) -> f64;
    fn lt(a: Self::Numbers, b: Self::Numbers) -> Self::Mask;
    fn le(a: Self::Numbers, b: Self::Numbers) -> Self::Mask;
    fn select(mask: Self::Mask, yes: Self::Numbers, no: Self::Numbers) -> Self::Numbers;
    fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    fn or(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    fn xor(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// A bit for each lane, the first one's lowest.
    fn bits(mask: Self::Mask) -> u8;
    fn from_bits(bits: u8) -> Self::Mask;
    /// Of eight words those that differ from `other`, a bit for each.
    fn differing(words: &[u32; LANES], other: u32) -> u8;
    /// `yes` where the mask says so.
    fn select_words(mask: Self::Mask, yes: [u32; LANES], no: [u32; LANES]) -> [u32; LANES];
    /// Of eight numbers those whose sign bit is set, a bit for each.
    fn signs(v: Self::Numbers) -> u8;
    /// Numbers as their bits: adds to them, without carrying over.
    fn plus_bits(v: Self::Numbers, bits: u64) -> Self::Numbers;
    /// Numbers as their bits: keeps those that are set.
    fn and_bits(v: Self::Numbers, bits: u64) -> Self::Numbers;
    /// Numbers as their bits, shifted up.
    fn shift_left(v: Self::Numbers, by: u32) -> Self::Numbers;
    /// Numbers as their bits, shifted down.
    fn shift_right(v: Self::Numbers, by: u32) -> Self::Numbers;
}

/// Eight numbers.
pub(crate) struct F64s<I: Isa>(pub I::Numbers);

/// Eight times yes or no.
pub(crate) struct Mask<I: Isa>(pub I::Mask);

impl<I: Isa> Copy for F64s<I> {}
impl<I: Isa> Clone for F64s<I> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<I: Isa> Copy for Mask<I> {}
impl<I: Isa> Clone for Mask<I> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

/// Operators lane by lane.
macro_rules! operator {
    ($type:ident, $trait:ident, $operator:ident, $method:ident) => {
        impl<I: Isa> $trait for $type<I> {
            type Output = Self;
            #[inline(always)]
            fn $operator(self, o: Self) -> Self {
                Self(I::$method(self.0, o.0))
            }
        }
    };
}

operator!(F64s, Add, add, add);
operator!(F64s, Sub, sub, sub);
operator!(F64s, Mul, mul, mul);
operator!(F64s, Div, div, div);
operator!(Mask, BitAnd, bitand, and);
operator!(Mask, BitOr, bitor, or);
operator!(Mask, BitXor, bitxor, xor);

impl<I: Isa> Neg for F64s<I> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(I::neg(self.0))
    }
}

impl<I: Isa> Not for Mask<I> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        self ^ Self::splat(true)
    }
}

impl<I: Isa> F64s<I> {
    #[inline(always)]
    pub fn splat(v: f64) -> Self {
        Self(I::splat(v))
    }

    #[inline(always)]
    pub fn load(v: &Stored) -> Self {
        Self(I::load(v))
    }

    #[inline(always)]
    pub fn stored(self) -> Stored {
        I::store(self.0)
    }

    #[inline(always)]
    pub fn zero() -> Self {
        Self::splat(0.0)
    }

    #[inline(always)]
    pub fn infinity() -> Self {
        Self::splat(f64::INFINITY)
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self(I::sqrt(self.0))
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        Self(I::abs(self.0))
    }

    /// The smaller of both; `self` where one is no number.
    #[inline(always)]
    pub fn min(self, o: Self) -> Self {
        Self(I::min(self.0, o.0))
    }

    /// The least of all, of which none is NaN.
    #[inline(always)]
    pub fn least(self) -> f64 {
        I::least(self.0)
    }

    /// The greatest of all, of which none is NaN.
    #[inline(always)]
    pub fn greatest(self) -> f64 {
        I::greatest(self.0)
    }

    /// The larger of both; `self` where one is no number.
    #[inline(always)]
    pub fn max(self, o: Self) -> Self {
        Self(I::max(self.0, o.0))
    }

    #[inline(always)]
    pub fn lt(self, o: Self) -> Mask<I> {
        Mask(I::lt(self.0, o.0))
    }

    #[inline(always)]
    pub fn le(self, o: Self) -> Mask<I> {
        Mask(I::le(self.0, o.0))
    }

    #[inline(always)]
    pub fn gt(self, o: Self) -> Mask<I> {
        o.lt(self)
    }

    #[inline(always)]
    pub fn ge(self, o: Self) -> Mask<I> {
        o.le(self)
    }

    /// Those whose sign bit is set, a bit for each, the first one's lowest.
    #[inline(always)]
    pub fn signs(self) -> u8 {
        I::signs(self.0)
    }

    /// As [`f64::next_up`], of positive numbers.
    #[inline(always)]
    pub fn next_up(self) -> Self {
        self.is_finite().select(Self(I::plus_bits(self.0, 1)), self)
    }

    /// As [`f64::next_down`], of positive numbers.
    #[inline(always)]
    pub fn next_down(self) -> Self {
        self.is_finite().select(Self(I::plus_bits(self.0, u64::MAX)), self)
    }

    /// Which are numbers, and not infinite.
    #[inline(always)]
    pub fn is_finite(self) -> Mask<I> {
        self.abs().lt(Self::infinity())
    }
}

impl<I: Isa> Mask<I> {
    #[inline(always)]
    pub fn splat(v: bool) -> Self {
        Self(I::from_bits(if v { u8::MAX } else { 0 }))
    }

    #[inline(always)]
    pub fn from_bits(bits: u8) -> Self {
        Self(I::from_bits(bits))
    }

    /// A bit for each lane, the first one's lowest.
    #[inline(always)]
    pub fn bits(self) -> u8 {
        I::bits(self.0)
    }

    #[inline(always)]
    pub fn any(self) -> bool {
        self.bits() != 0
    }

    #[inline(always)]
    pub fn all(self) -> bool {
        self.bits() == u8::MAX
    }

    /// `yes` where it says so.
    #[inline(always)]
    pub fn select(self, yes: F64s<I>, no: F64s<I>) -> F64s<I> {
        F64s(I::select(self.0, yes.0, no.0))
    }

    /// `yes` where it says so.
    #[inline(always)]
    pub fn select_words(self, yes: [u32; LANES], no: [u32; LANES]) -> [u32; LANES] {
        I::select_words(self.0, yes, no)
    }
}
