//! Powers of numbers between 0 and 1, as highlights need them.

/// `x` to the power of `n`, for `0 <= x <= 1` and `n >= 0`; off by a part in 10⁹ or so.
///
/// The mathematical library's power is right to the last bit and takes several times as long: a quarter of the time of a
/// picture. That of the platform gives other bits elsewhere. Its twin for eight numbers at once (`trace::tile::lanes`) does
/// the same operations.
pub fn power_of_fraction(x: f64, n: f64) -> f64 {
    if !(f64::MIN_POSITIVE..1.0).contains(&x) {
        return if x >= 1.0 || n == 0.0 { 1.0 } else { 0.0 };
    }
    exp2(n * log2(x))
}

/// The numbers of the two series, and what takes floats apart.
pub(crate) mod series {
    use std::f64::consts::{FRAC_1_SQRT_2, LN_2, LOG2_E};

    /// The bits of a mantissa, and how many there are.
    pub const MANTISSA: u64 = (1 << MANTISSA_BITS) - 1;
    pub const MANTISSA_BITS: u32 = 52;
    /// The exponent of 1 as it is stored.
    pub const BIAS: u64 = 1023;
    /// Where mantissas begin: with the root of 1/2.
    pub const LEAST: u64 = FRAC_1_SQRT_2.to_bits();
    /// Added to a number's bits, it makes the exponent count from there.
    pub const TO_LEAST: u64 = 1.0_f64.to_bits() - LEAST;
    /// 2^52: as the exponent of a small integer's bits, it makes them that integer, and 2^52 more.
    pub const INTEGER: f64 = (1_u64 << MANTISSA_BITS) as f64;
    /// Added to a number, it leaves the nearest integer in the lowest bits.
    pub const ROUND: f64 = 1.5 * INTEGER;
    /// Below that, powers of two are nothing.
    pub const NOTHING: f64 = -1000.0;
    /// `log2 m` is this times `z` times the series.
    pub const SCALE: f64 = 2.0 * LOG2_E;
    /// `artanh z` over `z`, by powers of `z²`, the highest first.
    pub const ARTANH: [f64; 7] = [1.0 / 13.0, 1.0 / 11.0, 1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0, 1.0];
    /// For the exponential function.
    pub const LN_OF_2: f64 = LN_2;
    /// Taylor's series of the exponential function, the highest power first.
    pub const EXP: [f64; 10] = [
        1.0 / 362_880.0,
        1.0 / 40_320.0,
        1.0 / 5_040.0,
        1.0 / 720.0,
        1.0 / 120.0,
        1.0 / 24.0,
        1.0 / 6.0,
        1.0 / 2.0,
        1.0,
        1.0,
    ];
}

/// The logarithm of a normal number.
fn log2(x: f64) -> f64 {
    use series::*;
    // x = 2^exponent * m, with m between the roots of 1/2 and 2: the series converges quickly there.
    let bits = x.to_bits() + TO_LEAST;
    let exponent = f64::from_bits((bits >> MANTISSA_BITS) + INTEGER.to_bits()) - (INTEGER + BIAS as f64);
    let m = f64::from_bits((bits & MANTISSA) + LEAST);
    // ln m = 2 artanh z.
    let z = (m - 1.0) / (m + 1.0);
    exponent + SCALE * z * polynomial(&ARTANH, z * z)
}

/// Two to the power of `y <= 0`.
fn exp2(y: f64) -> f64 {
    use series::*;
    if y.is_nan() || y <= NOTHING {
        return 0.0;
    }
    let shifted = y + ROUND;
    // Up to ln 2 / 2.
    let f = (y - (shifted - ROUND)) * LN_OF_2;
    polynomial(&EXP, f) * f64::from_bits((shifted.to_bits() + BIAS) << MANTISSA_BITS)
}

/// A polynomial, the coefficient of the highest power first.
fn polynomial<const N: usize>(coefficients: &[f64; N], x: f64) -> f64 {
    let mut sum = coefficients[0];
    for coefficient in &coefficients[1..] {
        sum = sum * x + coefficient;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_as_the_library_has_them() {
        for i in 1..2000 {
            let x = f64::from(i) / 2000.0;
            for n in [0.0, 0.3, 1.0, 2.0, 17.5, 40.0, 200.0, 1e4] {
                let expected = libm::pow(x, n);
                let off = (power_of_fraction(x, n) - expected).abs();
                assert!(off <= 1e-9 * expected + 1e-290, "{x}^{n}");
            }
        }
    }

    #[test]
    fn the_ends_are_exact() {
        assert_eq!(power_of_fraction(1.0, 1e6), 1.0);
        assert_eq!(power_of_fraction(0.0, 2.0), 0.0);
        assert_eq!(power_of_fraction(0.0, 0.0), 1.0);
        assert_eq!(power_of_fraction(0.5, f64::INFINITY), 0.0);
    }
}
