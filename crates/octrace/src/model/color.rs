//! Colours, in linear light.

use crate::num::power_of_fraction;
use std::ops::{Add, AddAssign, Mul};

/// Red, green and blue in linear light, with the sRGB primaries. One is the white of a display; more is brighter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb {
    /// Red.
    pub r: f64,
    /// Green.
    pub g: f64,
    /// Blue.
    pub b: f64,
}

impl Rgb {
    /// No light.
    pub const BLACK: Self = Self::gray(0.0);
    /// The white of a display.
    pub const WHITE: Self = Self::gray(1.0);

    /// The colour with these linear components.
    pub const fn new(r: f64, g: f64, b: f64) -> Self {
        Self { r, g, b }
    }

    /// Grey of the given linear intensity.
    pub const fn gray(v: f64) -> Self {
        Self::new(v, v, v)
    }

    /// From components as they are written in files and on the web: sRGB encoded, 0 to 1.
    pub fn from_srgb(encoded: [f64; 3]) -> Self {
        let [r, g, b] = encoded.map(srgb_to_linear);
        Self::new(r, g, b)
    }

    /// The largest of the three components.
    pub fn max_component(self) -> f64 {
        self.r.max(self.g).max(self.b)
    }
}

/// Decodes one sRGB component (IEC 61966-2-1).
pub fn srgb_to_linear(v: f64) -> f64 {
    if v <= 0.04045 { v / 12.92 } else { libm::pow((v + 0.055) / 1.055, 2.4) }
}

/// Encodes one component as sRGB (IEC 61966-2-1), after cutting it to 0..=1; NaN becomes 0.
pub fn linear_to_srgb(v: f64) -> f64 {
    let v = if v > 0.0 { v.min(1.0) } else { 0.0 };
    if v <= 0.003_130_8 { v * 12.92 } else { 1.055 * power_of_fraction(v, 1.0 / 2.4) - 0.055 }
}

impl Add for Rgb {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::new(self.r + o.r, self.g + o.g, self.b + o.b)
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl Mul<f64> for Rgb {
    type Output = Self;
    fn mul(self, s: f64) -> Self {
        Self::new(self.r * s, self.g * s, self.b * s)
    }
}

/// Component by component: light through a filter.
impl Mul for Rgb {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self::new(self.r * o.r, self.g * o.g, self.b * o.b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_there_and_back() {
        for i in 0..=255 {
            let v = f64::from(i) / 255.0;
            assert!((linear_to_srgb(srgb_to_linear(v)) - v).abs() < 1e-7, "{i}");
        }
        assert_eq!(linear_to_srgb(f64::NAN), 0.0);
    }
}
