//! From what is seen along a tile's rays to its pixels.

use crate::shade::EightSeen;
use crate::trace::lanes::{F64s, Isa, LANES};
use crate::trace::{PACKET_PX, TILE_PX, Task};

/// Packets along x.
const ACROSS: usize = TILE_PX / PACKET_PX.0;

/// Writes the pixels of a tile, row by row.
pub(super) struct Develop<'a> {
    /// What is seen in all samples together, by packets.
    pub seen: &'a [EightSeen],
    /// What a sample counts.
    pub share: f64,
    /// Pixels in a row of the tile.
    pub width: usize,
    pub pixels: &'a mut [[f32; 4]],
}

impl Task for Develop<'_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { seen, share, width, pixels } = self;
        for (number, seen) in seen.iter().enumerate() {
            let (left, top) = (number % ACROSS * PACKET_PX.0, number / ACROSS * PACKET_PX.1);
            let [r, g, b] = &seen.color;
            let mut channels = [[0.0_f32; LANES]; 4];
            for (channel, v) in channels.iter_mut().zip([r, g, b, &seen.alpha]) {
                let scaled = (F64s::<I>::load(v) * F64s::splat(share)).stored();
                for (narrow, wide) in channel.iter_mut().zip(scaled.0) {
                    *narrow = wide as f32;
                }
            }
            let [r, g, b, alpha] = channels;
            for row in 0..PACKET_PX.1 {
                let first = (top + row) * width + left;
                let count = width.saturating_sub(left).min(PACKET_PX.0);
                let Some(pixels) = pixels.get_mut(first..first + count) else { break };
                for (column, pixel) in pixels.iter_mut().enumerate() {
                    let lane = row * PACKET_PX.0 + column;
                    *pixel = [r[lane], g[lane], b[lane], alpha[lane]];
                }
            }
        }
    }
}
