//! The film.

use crate::model::{linear_to_srgb, srgb_to_linear};
use std::sync::LazyLock;

/// A picture in linear light: rows from the top, pixels from the left, each red, green, blue (premultiplied) and alpha.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    width_px: u32,
    height_px: u32,
    pixels: Vec<[f32; 4]>,
}

impl Film {
    /// A film with these pixels, `width_px * height_px` of them.
    pub(super) fn new(width_px: u32, height_px: u32, pixels: Vec<[f32; 4]>) -> Self {
        debug_assert_eq!(pixels.len(), width_px as usize * height_px as usize);
        Self { width_px, height_px, pixels }
    }

    /// Pixels in a row.
    pub fn width_px(&self) -> u32 {
        self.width_px
    }

    /// Rows.
    pub fn height_px(&self) -> u32 {
        self.height_px
    }

    /// The pixels in linear light, colours premultiplied by alpha.
    pub fn pixels(&self) -> &[[f32; 4]] {
        &self.pixels
    }

    /// sRGB with straight alpha, 8 bits a channel, RGBA.
    pub fn to_rgba8(&self) -> Vec<u8> {
        self.encode(encode8, |alpha| (alpha * 255.0 + 0.5) as u8)
    }

    /// sRGB with straight alpha, 16 bits a channel, RGBA.
    pub fn to_rgba16(&self) -> Vec<u16> {
        let round = |v: f64| (v * 65535.0 + 0.5) as u16;
        self.encode(|v| round(linear_to_srgb(v)), round)
    }

    fn encode<T>(&self, color: impl Fn(f64) -> T, alpha: impl Fn(f64) -> T) -> Vec<T> {
        let mut samples = Vec::with_capacity(4 * self.pixels.len());
        for &[r, g, b, a] in &self.pixels {
            let a = f64::from(a).clamp(0.0, 1.0);
            let straight = |v: f32| if a > 0.0 { f64::from(v) / a } else { 0.0 };
            samples.extend([color(straight(r)), color(straight(g)), color(straight(b)), alpha(a)]);
        }
        samples
    }
}

/// The linear values from which on each of the 256 steps of 8-bit sRGB begins.
static STEPS: LazyLock<[f64; 256]> = LazyLock::new(|| {
    std::array::from_fn(|step| if step == 0 { f64::NEG_INFINITY } else { srgb_to_linear((step as f64 - 0.5) / 255.0) })
});

/// For every thousandth or so of linear light the step that it begins in.
static STEP_AT: LazyLock<[u8; FIRST_GUESSES]> = LazyLock::new(|| {
    std::array::from_fn(|i| {
        let v = i as f64 / (FIRST_GUESSES - 1) as f64;
        (STEPS.partition_point(|&step| step <= v) - 1) as u8
    })
});
const FIRST_GUESSES: usize = 1025;

/// One linear value as 8-bit sRGB, rounded to the nearest step; NaN is 0.
fn encode8(v: f64) -> u8 {
    let v = if v > 0.0 { v.min(1.0) } else { 0.0 };
    let mut step = STEP_AT[(v * (FIRST_GUESSES - 1) as f64) as usize];
    while step < u8::MAX && STEPS[usize::from(step) + 1] <= v {
        step += 1;
    }
    step
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_where_rounding_puts_them() {
        for i in 0..=200_000 {
            let v = f64::from(i) / 200_000.0;
            let exact = linear_to_srgb(v) * 255.0;
            let step = f64::from(encode8(v));
            assert!((exact - step).abs() <= 0.5 + 1e-6, "{v}: {exact} becomes {step}");
        }
        assert_eq!([-1.0, 0.0, 1.0, 7.0, f64::NAN].map(encode8), [0, 0, 255, 255, 0]);
    }
}
