//! Lanes as one register of AVX-512, masks as one of its mask registers.

#![allow(unsafe_code, reason = "intrinsics; see Isa for where they may be called")]

use super::{Isa, Kernel, LANES, Stored};
use std::arch::x86_64::*;

/// AVX-512: F, DQ, VL and BW; and what all machines have that have those.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Avx512;

#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw,bmi1,bmi2,lzcnt,popcnt")]
#[inline(never)]
fn call<K: Kernel>(kernel: K) {
    kernel.run();
}

/// Functions that are one intrinsic each.
macro_rules! intrinsics {
    ($($name:ident($($arg:ident: $type:ty),*) -> $result:ty = $body:expr;)*) => {
        $(
            #[inline(always)]
            fn $name($($arg: $type),*) -> $result {
                // SAFETY: dispatch chooses this instruction set only where the machine has it; loads and stores are of
                // whole arrays.
                unsafe { $body }
            }
        )*
    };
}

impl Isa for Avx512 {
    type Numbers = __m512d;
    type Mask = __mmask8;

    intrinsics! {
        splat(v: f64) -> __m512d = _mm512_set1_pd(v);
        load(v: &Stored) -> __m512d = _mm512_load_pd(v.0.as_ptr());
        add(a: __m512d, b: __m512d) -> __m512d = _mm512_add_pd(a, b);
        sub(a: __m512d, b: __m512d) -> __m512d = _mm512_sub_pd(a, b);
        mul(a: __m512d, b: __m512d) -> __m512d = _mm512_mul_pd(a, b);
        div(a: __m512d, b: __m512d) -> __m512d = _mm512_div_pd(a, b);
        sqrt(v: __m512d) -> __m512d = _mm512_sqrt_pd(v);
        neg(v: __m512d) -> __m512d = _mm512_xor_pd(v, _mm512_set1_pd(-0.0));
        abs(v: __m512d) -> __m512d = _mm512_abs_pd(v);
        // The instructions give the second operand where one is no number.
        min(a: __m512d, b: __m512d) -> __m512d = _mm512_min_pd(b, a);
        max(a: __m512d, b: __m512d) -> __m512d = _mm512_max_pd(b, a);
        least(v: __m512d) -> f64 = _mm512_reduce_min_pd(v);
        greatest(v: __m512d) -> f64 = _mm512_reduce_max_pd(v);
        lt(a: __m512d, b: __m512d) -> __mmask8 = _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b);
        le(a: __m512d, b: __m512d) -> __mmask8 = _mm512_cmp_pd_mask::<_CMP_LE_OQ>(a, b);
        select(mask: __mmask8, yes: __m512d, no: __m512d) -> __m512d = _mm512_mask_blend_pd(mask, no, yes);
        differing(words: &[u32; LANES], other: u32) -> u8 = _mm256_cmpneq_epi32_mask(
            _mm256_loadu_si256(words.as_ptr().cast()),
            _mm256_set1_epi32(other as i32),
        );
        select_words(mask: __mmask8, yes: [u32; LANES], no: [u32; LANES]) -> [u32; LANES] = {
            let (yes, no) = (_mm256_loadu_si256(yes.as_ptr().cast()), _mm256_loadu_si256(no.as_ptr().cast()));
            let mut chosen = [0; LANES];
            _mm256_storeu_si256(chosen.as_mut_ptr().cast(), _mm256_mask_blend_epi32(mask, no, yes));
            chosen
        };
        signs(v: __m512d) -> u8 = _mm512_movepi64_mask(_mm512_castpd_si512(v));
        plus_bits(v: __m512d, bits: u64) -> __m512d =
            _mm512_castsi512_pd(_mm512_add_epi64(_mm512_castpd_si512(v), _mm512_set1_epi64(bits as i64)));
        and_bits(v: __m512d, bits: u64) -> __m512d =
            _mm512_castsi512_pd(_mm512_and_si512(_mm512_castpd_si512(v), _mm512_set1_epi64(bits as i64)));
        shift_left(v: __m512d, by: u32) -> __m512d =
            _mm512_castsi512_pd(_mm512_sllv_epi64(_mm512_castpd_si512(v), _mm512_set1_epi64(i64::from(by))));
        shift_right(v: __m512d, by: u32) -> __m512d =
            _mm512_castsi512_pd(_mm512_srlv_epi64(_mm512_castpd_si512(v), _mm512_set1_epi64(i64::from(by))));
        store(v: __m512d) -> Stored = {
            let mut stored = Stored::default();
            _mm512_store_pd(stored.0.as_mut_ptr(), v);
            stored
        };
    }

    #[inline(always)]
    fn call<K: Kernel>(kernel: K) {
        // SAFETY: dispatch chooses this instruction set only where the machine has it.
        unsafe { call(kernel) }
    }

    #[inline(always)]
    fn and(a: __mmask8, b: __mmask8) -> __mmask8 {
        a & b
    }

    #[inline(always)]
    fn or(a: __mmask8, b: __mmask8) -> __mmask8 {
        a | b
    }

    #[inline(always)]
    fn xor(a: __mmask8, b: __mmask8) -> __mmask8 {
        a ^ b
    }

    #[inline(always)]
    fn bits(mask: __mmask8) -> u8 {
        mask
    }

    #[inline(always)]
    fn from_bits(bits: u8) -> __mmask8 {
        bits
    }
}
