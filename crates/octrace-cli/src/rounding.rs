//! Measured numbers for people: no more digits than the error leaves meaning to.

/// The value, rounded to the first digit of its error.
pub fn rounded(value: f64, error: f64) -> String {
    let (Some(value_exponent), Some(error_exponent)) = (exponent(value), exponent(error)) else {
        return plain(value);
    };
    match usize::try_from(value_exponent - error_exponent) {
        Ok(digits) => plain(to_digits(value, digits)),
        Err(_) => plain(0.0),
    }
}

/// The error itself, in two digits.
pub fn error_of(error: f64) -> String {
    plain(to_digits(error, 1))
}

/// The value with so many digits after its first one.
fn to_digits(value: f64, digits: usize) -> f64 {
    // A double has no more than 17, and what was printed with them can be read.
    format!("{value:.*e}", digits.min(17)).parse().unwrap_or(value)
}

/// The power of ten of the first digit; `None` where there is no such digit.
fn exponent(value: f64) -> Option<i32> {
    let text = format!("{value:e}");
    let exponent = text.split_once('e')?.1.parse().ok()?;
    (value != 0.0).then_some(exponent)
}

/// The shortest text that means this number; with a power of ten where there would be too many zeros.
fn plain(value: f64) -> String {
    if value == 0.0 || !value.is_finite() || (1e-4..1e15).contains(&value.abs()) {
        // Adding zero turns -0 into 0.
        format!("{}", value + 0.0)
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_without_meaning_go() {
        for (value, error, expected) in [
            (203_221.577_548, 1.2, "203222"),
            (1_601_808.207, 117.0, "1601800"),
            (0.999_999_913, 1e-6, "1"),
            (-11.999_999_999_972, 3.4e-6, "-12"),
            (0.0, 1e-6, "0"),
            (-1e-18, 1e-6, "0"),
            (50.0, 60.0, "50"),
            (5.0, 60.0, "0"),
            (1.5, 0.0, "1.5"),
            (0.1 + 0.2, 1e-30, "0.30000000000000004"),
            (4.188_779e-300, 6e-305, "4.18878e-300"),
            (1.234_567e45, 1e39, "1.234567e45"),
            (1.0, f64::INFINITY, "1"),
            (f64::NAN, 1.0, "NaN"),
        ] {
            assert_eq!(rounded(value, error), expected, "{value} ± {error}");
        }
    }

    #[test]
    fn errors_have_two_digits() {
        for (error, expected) in [(0.0, "0"), (1.24e-6, "1.2e-6"), (0.0449, "0.045"), (117.0, "120"), (60.4, "60")] {
            assert_eq!(error_of(error), expected);
        }
    }
}
