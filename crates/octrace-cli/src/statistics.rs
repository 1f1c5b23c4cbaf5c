//! What a few repeated measurements say: the middle, and from where to where they go.

use serde::{Serialize, Serializer};

/// Median and extremes of a handful of values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// As many values are smaller as are larger.
    #[serde(serialize_with = "six_digits")]
    pub median: f64,
    /// The smallest.
    #[serde(serialize_with = "six_digits")]
    pub min: f64,
    /// The largest.
    #[serde(serialize_with = "six_digits")]
    pub max: f64,
}

impl Spread {
    /// Of at least one value.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut values: Vec<f64> = values.into_iter().collect();
        values.sort_by(f64::total_cmp);
        let (Some(&min), Some(&max)) = (values.first(), values.last()) else {
            return Self { median: f64::NAN, min: f64::NAN, max: f64::NAN };
        };
        let middle = values.len() / 2;
        let median = if values.len() % 2 == 1 { values[middle] } else { (values[middle - 1] + values[middle]) / 2.0 };
        Self { median, min, max }
    }

    /// Of the ratios of values that were measured in the same round. What slows a whole round down cancels out.
    pub fn of_ratios(over: &[f64], under: &[f64]) -> Self {
        Self::of(std::iter::zip(over, under).map(|(a, b)| a / b.max(f64::MIN_POSITIVE)))
    }

    /// All three values times a factor.
    pub fn times(self, factor: f64) -> Self {
        Self { median: self.median * factor, min: self.min * factor, max: self.max * factor }
    }
}

/// No clock says more.
fn six_digits<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    let rounded = format!("{value:.5e}").parse().unwrap_or(*value);
    serializer.serialize_f64(rounded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_of_odd_and_even_numbers() {
        assert_eq!(Spread::of([3.0, 1.0, 2.0]), Spread { median: 2.0, min: 1.0, max: 3.0 });
        assert_eq!(Spread::of([4.0, 1.0, 2.0, 3.0]).median, 2.5);
        assert!(Spread::of([]).median.is_nan());
    }

    #[test]
    fn six_digits_are_written() {
        let json = serde_json::to_string(&Spread::of([1.0 / 3.0, 12_345_678.9, 2e-7 / 3.0])).unwrap();
        assert_eq!(json, r#"{"median":0.333333,"min":6.66667e-8,"max":12345700.0}"#);
    }

    #[test]
    fn ratios_are_those_of_one_round() {
        let ratios = Spread::of_ratios(&[2.0, 40.0, 3.0], &[1.0, 20.0, 1.0]);
        assert_eq!(ratios, Spread { median: 2.0, min: 2.0, max: 3.0 });
    }
}
