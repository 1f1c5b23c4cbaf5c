//! Powers of numbers between 0 and 1, as highlights need them.

/// `x` to the power of `n`, for `0 <= x <= 1` and `n >= 0`; off by a part in 10⁹ or so.
///
/// The mathematical library's power is right to the last bit and takes several times as long: a quarter of the time of a
/// picture. That of the platform gives other bits elsewhere.
pub fn power_of_fraction(x: f64, n: f64) -> f64 {
    if !(f64::MIN_POSITIVE..1.0).contains(&x) {
        return if x >= 1.0 || n == 0.0 { 1.0 } else { 0.0 };
    }
    exp2(n * log2(x))
}

/// The logarithm of a normal number.
fn log2(x: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    // x = 2^exponent * m, with m between the roots of 1/2 and 2: the series converges quickly there.
    let bits = x.to_bits() + (0x3FF0_0000_0000_0000 - std::f64::consts::FRAC_1_SQRT_2.to_bits());
    let exponent = (bits >> 52) as i64 - 1023;
    let m = f64::from_bits((bits & MANTISSA) + std::f64::consts::FRAC_1_SQRT_2.to_bits());
    let z = (m - 1.0) / (m + 1.0);
    let zz = z * z;
    // ln m = 2 artanh z.
    let series =
        1.0 + zz * (1.0 / 3.0 + zz * (0.2 + zz * (1.0 / 7.0 + zz * (1.0 / 9.0 + zz * (1.0 / 11.0 + zz / 13.0)))));
    exponent as f64 + 2.0 * std::f64::consts::LOG2_E * z * series
}

/// Two to the power of `y <= 0`.
fn exp2(y: f64) -> f64 {
    if y.is_nan() || y <= -1000.0 {
        return 0.0;
    }
    let whole = (y - 0.5) as i64;
    let f = (y - whole as f64) * std::f64::consts::LN_2;
    // Taylor's series, for |f| up to ln 2 / 2.
    let mut sum = 1.0;
    for k in (1..=10).rev() {
        sum = 1.0 + sum * f / f64::from(k);
    }
    sum * f64::from_bits(((whole + 1023) as u64) << 52)
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
