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
        let steps = Steps::get();
        self.encode(|v| steps.encode(v), |alpha| (alpha * 255.0 + 0.5) as u8)
    }

    /// sRGB with straight alpha, 16 bits a channel, RGBA.
    pub fn to_rgba16(&self) -> Vec<u16> {
        let round = |v: f64| (v * 65535.0 + 0.5) as u16;
        self.encode(|v| round(linear_to_srgb(v)), round)
    }

    fn encode<T: Copy>(&self, color: impl Fn(f64) -> T, alpha: impl Fn(f64) -> T) -> Vec<T> {
        let mut samples: Vec<T> = Vec::with_capacity(4 * self.pixels.len());
        // Backgrounds and flat faces are of one colour.
        let mut last: Option<([f32; 4], [T; 4])> = None;
        for pixel in &self.pixels {
            let encoded = match last {
                Some((same, encoded)) if same == *pixel => encoded,
                _ => {
                    let [r, g, b, a] = pixel.map(f64::from);
                    let a = a.clamp(0.0, 1.0);
                    let straight = |v: f64| if a > 0.0 { v / a } else { 0.0 };
                    [color(straight(r)), color(straight(g)), color(straight(b)), alpha(a)]
                }
            };
            last = Some((*pixel, encoded));
            samples.extend_from_slice(&encoded);
        }
        samples
    }
}

/// The steps of 8-bit sRGB.
struct Steps {
    /// The linear values from which on each of the 256 begins.
    starts: [f64; 256],
    /// For every thousandth or so of linear light the step that it begins in.
    guesses: [u8; FIRST_GUESSES],
}

const FIRST_GUESSES: usize = 1025;

impl Steps {
    fn get() -> &'static Self {
        static STEPS: LazyLock<Steps> = LazyLock::new(Steps::new);
        &STEPS
    }

    fn new() -> Self {
        let starts: [f64; 256] = std::array::from_fn(|step| match step {
            0 => f64::NEG_INFINITY,
            _ => srgb_to_linear((step as f64 - 0.5) / 255.0),
        });
        let guesses = std::array::from_fn(|i| {
            let v = i as f64 / (FIRST_GUESSES - 1) as f64;
            (starts.partition_point(|&start| start <= v) - 1) as u8
        });
        Self { starts, guesses }
    }

    /// One linear value as 8-bit sRGB, rounded to the nearest step; NaN is 0.
    fn encode(&self, v: f64) -> u8 {
        let v = if v > 0.0 { v.min(1.0) } else { 0.0 };
        let mut step = self.guesses[(v * (FIRST_GUESSES - 1) as f64) as usize];
        while step < u8::MAX && self.starts[usize::from(step) + 1] <= v {
            step += 1;
        }
        step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_where_rounding_puts_them() {
        let steps = Steps::get();
        for i in 0..=200_000 {
            let v = f64::from(i) / 200_000.0;
            let exact = linear_to_srgb(v) * 255.0;
            let step = f64::from(steps.encode(v));
            assert!((exact - step).abs() <= 0.5 + 1e-6, "{v}: {exact} becomes {step}");
        }
        assert_eq!([-1.0, 0.0, 1.0, 7.0, f64::NAN].map(|v| steps.encode(v)), [0, 0, 255, 255, 0]);
    }
}
