//! From what is seen along a tile's rays to its pixels.

use super::tile::TileRows;
use crate::shade::EightSeen;
use crate::trace::lanes::{F64s, Isa, LANES};
use crate::trace::{PACKET_PX, Task, corner_of};

/// Writes the pixels of a tile, row by row.
pub(super) struct Develop<'a> {
    /// What is seen in all samples together, by packets.
    pub seen: &'a [EightSeen],
    /// What a sample counts.
    pub share: f64,
    pub rows: TileRows<'a>,
}

impl Task for Develop<'_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { seen, share, mut rows } = self;
        for (number, seen) in seen.iter().enumerate() {
            let (left, top) = corner_of(number);
            let [r, g, b] = &seen.color;
            let mut channels = [[0.0_f32; LANES]; 4];
            for (channel, v) in channels.iter_mut().zip([r, g, b, &seen.alpha]) {
                let scaled = (F64s::<I>::load(v) * F64s::splat(share)).stored();
                for (narrow, wide) in channel.iter_mut().zip(scaled.0) {
                    *narrow = wide as f32;
                }
            }
            let [r, g, b, alpha] = channels;
            for (row, lanes) in rows[top..].iter_mut().zip([0..PACKET_PX.0, PACKET_PX.0..LANES]) {
                for (pixel, lane) in row.iter_mut().skip(left).zip(lanes) {
                    *pixel = [r[lane], g[lane], b[lane], alpha[lane]];
                }
            }
        }
    }
}
