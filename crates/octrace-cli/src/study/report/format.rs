//! Numbers for people.

use crate::statistics::Spread;
use maud::{Markup, html};

/// Three digits that count, or the whole number where it has more: `0.0123`, `4.56`, `12,300`.
pub fn number(value: f64) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    // Digits before the point; for what is less than 0.1, the zeros after it, negative.
    let magnitude = value.abs().log10().floor() as i32 + 1;
    match 3 - magnitude {
        decimals @ 1.. => format!("{value:.*}", decimals.min(9) as usize),
        _ => whole(value.round() as u64),
    }
}

/// Thousands apart.
pub fn whole(value: u64) -> String {
    indicatif::HumanCount(value).to_string()
}

/// In brackets, from where to where values go that differ from scene to scene; nothing where they do not.
pub fn range(values: &Spread) -> String {
    if values.min == values.max {
        return String::new();
    }
    format!(" ({}–{})", number(values.min), number(values.max))
}

/// A time with a unit that fits.
pub fn seconds(value: f64) -> String {
    let (factor, unit) = unit_of_time(value);
    format!("{} {unit}", number(value * factor))
}

/// A median time with a unit that fits, and small beside it from where to where the times go, in the same unit.
pub fn spread_seconds(values: &Spread) -> Markup {
    let (factor, unit) = unit_of_time(values.median);
    html! { (spread(&values.times(factor))) " " (unit) }
}

/// What to multiply seconds with, and what they are then.
fn unit_of_time(seconds: f64) -> (f64, &'static str) {
    match seconds {
        s if s >= 1.0 => (1.0, "s"),
        s if s >= 1e-3 => (1e3, "ms"),
        s if s >= 1e-6 => (1e6, "µs"),
        _ => (1e9, "ns"),
    }
}

/// A number of bytes with a unit that fits.
pub fn bytes(value: usize) -> String {
    indicatif::DecimalBytes(value as u64).to_string()
}

/// A median, and small beside it from where to where the values go.
pub fn spread(values: &Spread) -> Markup {
    html! {
        (number(values.median)) " "
        small { "(" (number(values.min)) "–" (number(values.max)) ")" }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_that_count() {
        for (value, expected) in [
            (0.0, "0"),
            (0.012_34, "0.0123"),
            (0.5, "0.500"),
            (1.0, "1.00"),
            (45.67, "45.7"),
            (456.7, "457"),
            (12_345.6, "12,346"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(number(value), expected);
        }
        assert_eq!(
            (seconds(0.0123).as_str(), seconds(2.5).as_str(), seconds(4.2e-5).as_str()),
            ("12.3 ms", "2.50 s", "42.0 µs")
        );
    }
}
