//! The film.

use crate::model::linear_to_srgb;

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
        self.encode(255.0).map(|v| v as u8).collect()
    }

    /// sRGB with straight alpha, 16 bits a channel, RGBA.
    pub fn to_rgba16(&self) -> Vec<u16> {
        self.encode(65535.0).map(|v| v as u16).collect()
    }

    fn encode(&self, scale: f64) -> impl Iterator<Item = f64> + '_ {
        self.pixels.iter().flat_map(move |&[r, g, b, a]| {
            let alpha = f64::from(a).clamp(0.0, 1.0);
            let straight = |v: f32| if alpha > 0.0 { f64::from(v) / alpha } else { 0.0 };
            let color = |v: f32| (linear_to_srgb(straight(v)) * scale + 0.5).floor();
            [color(r), color(g), color(b), (alpha * scale + 0.5).floor()]
        })
    }
}
