//! Lanes as plain arrays and operations as plain loops: right on any machine, and as wide as the code around them is
//! compiled for.

#![allow(unsafe_code, reason = "calls of what is compiled for AVX2; see Isa for where they may happen")]

use super::{Isa, Kernel, LANES, Stored};

/// Plain loops over arrays, compiled for AVX2 or for any machine.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Arrays<const AVX2: bool>;

/// For any machine.
pub(in super::super) type Portable = Arrays<false>;
/// For machines with AVX2.
#[cfg(target_arch = "x86_64")]
pub(in super::super) type Avx2 = Arrays<true>;

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
#[inline(never)]
fn call_avx2<K: Kernel>(kernel: K) {
    kernel.run();
}

#[inline(never)]
fn call_portable<K: Kernel>(kernel: K) {
    kernel.run();
}

/// All bits set for yes, none for no. As bytes or bits, masks would have to be spread around every comparison.
type Mask = [u64; LANES];

const YES: u64 = !0;
const NO: u64 = 0;

#[inline(always)]
fn pairs<A: Copy, B>(a: [A; LANES], b: [A; LANES], f: impl Fn(A, A) -> B) -> [B; LANES] {
    std::array::from_fn(|i| f(a[i], b[i]))
}

#[inline(always)]
fn mask(v: bool) -> u64 {
    if v { YES } else { NO }
}

impl<const AVX2: bool> Isa for Arrays<AVX2> {
    type Numbers = [f64; LANES];
    type Mask = Mask;

    #[inline(always)]
    fn call<K: Kernel>(kernel: K) {
        #[cfg(target_arch = "x86_64")]
        if AVX2 {
            // SAFETY: dispatch chooses this instruction set only where the machine has it.
            return unsafe { call_avx2(kernel) };
        }
        call_portable(kernel);
    }

    #[inline(always)]
    fn splat(v: f64) -> [f64; LANES] {
        [v; LANES]
    }

    #[inline(always)]
    fn load(v: &Stored) -> [f64; LANES] {
        v.0
    }

    #[inline(always)]
    fn store(v: [f64; LANES]) -> Stored {
        Stored(v)
    }

    #[inline(always)]
    fn add(a: [f64; LANES], b: [f64; LANES]) -> [f64; LANES] {
        pairs(a, b, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(a: [f64; LANES], b: [f64; LANES]) -> [f64; LANES] {
        pairs(a, b, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(a: [f64; LANES], b: [f64; LANES]) -> [f64; LANES] {
        pairs(a, b, |a, b| a * b)
    }

    #[inline(always)]
    fn div(a: [f64; LANES], b: [f64; LANES]) -> [f64; LANES] {
        pairs(a, b, |a, b| a / b)
    }

    #[inline(always)]
    fn sqrt(v: [f64; LANES]) -> [f64; LANES] {
        v.map(f64::sqrt)
    }

    #[inline(always)]
    fn neg(v: [f64; LANES]) -> [f64; LANES] {
        v.map(|v| -v)
    }

    #[inline(always)]
    fn abs(v: [f64; LANES]) -> [f64; LANES] {
        v.map(f64::abs)
    }

    #[inline(always)]
    fn min(a: [f64; LANES], b: [f64; LANES]) -> [f64; LANES] {
        pairs(a, b, |a, b| if b < a { b } else { a })
    }

    #[inline(always)]
    fn max(a: [f64; LANES], b: [f64; LANES]) -> [f64; LANES] {
        pairs(a, b, |a, b| if b > a { b } else { a })
    }

    #[inline(always)]
    fn least(v: [f64; LANES]) -> f64 {
        let half = |i: usize| if v[i + 4] < v[i] { v[i + 4] } else { v[i] };
        let quarter = |i: usize| if half(i + 2) < half(i) { half(i + 2) } else { half(i) };
        if quarter(1) < quarter(0) { quarter(1) } else { quarter(0) }
    }

    #[inline(always)]
    fn greatest(v: [f64; LANES]) -> f64 {
        -Self::least(Self::neg(v))
    }

    #[inline(always)]
    fn lt(a: [f64; LANES], b: [f64; LANES]) -> Mask {
        pairs(a, b, |a, b| mask(a < b))
    }

    #[inline(always)]
    fn le(a: [f64; LANES], b: [f64; LANES]) -> Mask {
        pairs(a, b, |a, b| mask(a <= b))
    }

    #[inline(always)]
    fn select(mask: Mask, yes: [f64; LANES], no: [f64; LANES]) -> [f64; LANES] {
        std::array::from_fn(|i| if mask[i] != NO { yes[i] } else { no[i] })
    }

    #[inline(always)]
    fn and(a: Mask, b: Mask) -> Mask {
        pairs(a, b, |a, b| a & b)
    }

    #[inline(always)]
    fn or(a: Mask, b: Mask) -> Mask {
        pairs(a, b, |a, b| a | b)
    }

    #[inline(always)]
    fn xor(a: Mask, b: Mask) -> Mask {
        pairs(a, b, |a, b| a ^ b)
    }

    #[inline(always)]
    fn bits(mask: Mask) -> u8 {
        let mut bits = 0;
        for (i, lane) in mask.iter().enumerate() {
            bits |= (lane & 1 << i) as u8;
        }
        bits
    }

    #[inline(always)]
    fn from_bits(bits: u8) -> Mask {
        std::array::from_fn(|i| mask(bits >> i & 1 != 0))
    }

    #[inline(always)]
    fn differing(words: &[u32; LANES], other: u32) -> u8 {
        let mut bits = 0;
        for (i, &word) in words.iter().enumerate() {
            bits |= u8::from(word != other) << i;
        }
        bits
    }

    #[inline(always)]
    fn select_words(mask: Mask, yes: [u32; LANES], no: [u32; LANES]) -> [u32; LANES] {
        std::array::from_fn(|i| if mask[i] != NO { yes[i] } else { no[i] })
    }

    #[inline(always)]
    fn signs(v: [f64; LANES]) -> u8 {
        let mut bits = 0;
        for (i, v) in v.iter().enumerate() {
            bits |= u8::from(v.is_sign_negative()) << i;
        }
        bits
    }

    #[inline(always)]
    fn plus_bits(v: [f64; LANES], bits: u64) -> [f64; LANES] {
        v.map(|v| f64::from_bits(v.to_bits().wrapping_add(bits)))
    }

    #[inline(always)]
    fn and_bits(v: [f64; LANES], bits: u64) -> [f64; LANES] {
        v.map(|v| f64::from_bits(v.to_bits() & bits))
    }

    #[inline(always)]
    fn shift_left(v: [f64; LANES], by: u32) -> [f64; LANES] {
        v.map(|v| f64::from_bits(v.to_bits() << by))
    }

    #[inline(always)]
    fn shift_right(v: [f64; LANES], by: u32) -> [f64; LANES] {
        v.map(|v| f64::from_bits(v.to_bits() >> by))
    }
}
