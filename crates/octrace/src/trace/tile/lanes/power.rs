//! Powers of eight numbers at once: what [`power_of_fraction`](crate::num::power_of_fraction) does for one.

use super::{F64s, Isa};
use crate::num::power_series::*;

impl<I: Isa> F64s<I> {
    /// These numbers to the power of `n`, as [`power_of_fraction`](crate::num::power_of_fraction).
    #[inline(always)]
    pub fn power_of_fraction(self, n: Self) -> Self {
        let one = Self::splat(1.0);
        let power = exp2(n * log2(self));
        let is_one = self.ge(one) | (n.le(Self::zero()) & n.ge(Self::zero()));
        let usual = self.ge(Self::splat(f64::MIN_POSITIVE)) & self.lt(one);
        usual.select(power, is_one.select(one, Self::zero()))
    }
}

/// The logarithms of normal numbers.
#[inline(always)]
fn log2<I: Isa>(x: F64s<I>) -> F64s<I> {
    let bits = I::plus_bits(x.0, TO_LEAST);
    let exponent = F64s::<I>(I::plus_bits(I::shift_right(bits, MANTISSA_BITS), INTEGER.to_bits()));
    let exponent = exponent - F64s::splat(INTEGER + BIAS as f64);
    let m = F64s::<I>(I::plus_bits(I::and_bits(bits, MANTISSA), LEAST));
    let z = (m - F64s::splat(1.0)) / (m + F64s::splat(1.0));
    exponent + F64s::splat(SCALE) * z * polynomial(&ARTANH, z * z)
}

/// Two to these powers, which are not positive.
#[inline(always)]
fn exp2<I: Isa>(y: F64s<I>) -> F64s<I> {
    let shifted = y + F64s::splat(ROUND);
    let f = (y - (shifted - F64s::splat(ROUND))) * F64s::splat(LN_OF_2);
    let scale = F64s::<I>(I::shift_left(I::plus_bits(shifted.0, BIAS), MANTISSA_BITS));
    y.gt(F64s::splat(NOTHING)).select(polynomial(&EXP, f) * scale, F64s::zero())
}

/// A polynomial, the coefficient of the highest power first.
#[inline(always)]
fn polynomial<I: Isa, const N: usize>(coefficients: &[f64; N], x: F64s<I>) -> F64s<I> {
    let mut sum = F64s::splat(coefficients[0]);
    for &coefficient in &coefficients[1..] {
        sum = sum * x + F64s::splat(coefficient);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::Stored;
    use super::*;
    use crate::num::power_of_fraction;
    use crate::trace::tile::dispatch::{Backend, Task};

    struct Power<'a>(&'a Stored, f64, &'a mut Stored);

    impl Task for Power<'_> {
        #[inline(always)]
        fn run<I: Isa>(self) {
            let Self(x, n, power) = self;
            *power = F64s::<I>::load(x).power_of_fraction(F64s::splat(n)).stored();
        }
    }

    #[test]
    fn eight_powers_have_the_bits_of_one() {
        let mut numbers: Vec<f64> = (0..=2000).map(|i| f64::from(i) / 2000.0).collect();
        numbers.extend([1e-320, f64::MIN_POSITIVE, 1e-300, 1.0_f64.next_down(), 1.5, f64::NAN, -0.0]);
        for x in numbers.chunks_exact(8).map(|x| Stored(x.try_into().expect("chunks are of eight"))) {
            for n in [0.0, 0.3, 1.0, 2.0, 17.5, 40.0, 1e4, f64::INFINITY] {
                let expected = x.0.map(|x| power_of_fraction(x, n).to_bits());
                for backend in Backend::ALL {
                    let mut power = Stored::default();
                    backend.run(Power(&x, n, &mut power));
                    assert_eq!(power.0.map(f64::to_bits), expected, "{x:?}^{n} by {backend:?}");
                }
            }
        }
    }
}
