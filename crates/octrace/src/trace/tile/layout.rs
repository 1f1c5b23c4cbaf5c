//! Which pixels of a tile are traced together: 4 by 2 are a packet, 2 by 2 packets a bundle, 2 by 4 bundles the tile.
//!
//! Packets are numbered bundle by bundle, so that neighbours in a stream of them are neighbours in the picture both ways.
//! A set of packets is 32 bits, one of bundles eight.

use super::TILE_PX;
use super::lanes::LANES;

/// Pixels of a packet along x, and along y.
pub(crate) const PACKET_PX: (usize, usize) = (4, 2);
/// Columns and rows of packets in a tile.
pub(super) const COLUMNS: usize = TILE_PX / PACKET_PX.0;
pub(super) const ROWS: usize = TILE_PX / PACKET_PX.1;
/// Packets in a tile.
pub(crate) const PACKETS: usize = COLUMNS * ROWS;

/// Columns of bundles, and the pixels of one along x, and along y.
pub(super) const BUNDLE_COLUMNS: usize = 2;
pub(super) const BUNDLE_PX: (usize, usize) = (2 * PACKET_PX.0, 2 * PACKET_PX.1);
/// Packets of a bundle.
pub(super) const TOGETHER: usize = PACKETS / LANES;
const _: () = assert!(TILE_PX == BUNDLE_COLUMNS * BUNDLE_PX.0 && TOGETHER == 4);

/// The packet and the lane of a pixel.
#[inline(always)]
pub(crate) fn lane_of(x: usize, y: usize) -> (usize, usize) {
    let (column, row) = (x / PACKET_PX.0, y / PACKET_PX.1);
    let bundle = row / 2 * BUNDLE_COLUMNS + column / 2;
    (bundle * TOGETHER + row % 2 * 2 + column % 2, y % PACKET_PX.1 * PACKET_PX.0 + x % PACKET_PX.0)
}

/// The first pixel of a packet.
#[inline(always)]
pub(crate) fn corner_of(packet: usize) -> (usize, usize) {
    let (bundle, within) = (packet / TOGETHER, packet % TOGETHER);
    let column = bundle % BUNDLE_COLUMNS * 2 + within % 2;
    let row = bundle / BUNDLE_COLUMNS * 2 + within / 2;
    (column * PACKET_PX.0, row * PACKET_PX.1)
}

/// The packets that are both in some rows and in some columns: a bit for each.
#[inline(always)]
pub(super) fn packets_in(rows: u32, columns: u32) -> u32 {
    /// The packets of the rows whose bits are set.
    const IN_ROWS: [u32; 1 << ROWS] = {
        let mut packets = [0; 1 << ROWS];
        let mut rows = 0;
        while rows < packets.len() {
            // Two rows are a byte.
            let mut row = 0;
            while row < ROWS {
                packets[rows] |= (rows as u32 >> row & 1) * (0x33 << (row / 2 * 8 + row % 2 * 2));
                row += 1;
            }
            rows += 1;
        }
        packets
    };
    let in_columns = (((columns & 3) * 0x05) | ((columns >> 2) * 0x50)) * 0x0101_0101;
    IN_ROWS[rows as usize % IN_ROWS.len()] & in_columns
}

/// All packets of some bundles.
#[inline(always)]
pub(super) fn packets_of(bundles: u8) -> u32 {
    // Every bit to a nibble of its own, and from there to all of it.
    let spread = u32::from(bundles);
    let spread = (spread | spread << 12) & 0x000F_000F;
    let spread = (spread | spread << 6) & 0x0303_0303;
    let spread = (spread | spread << 3) & 0x1111_1111;
    spread * 0xF
}

/// The bundles that some packets belong to.
#[inline(always)]
pub(super) fn bundles_of(packets: u32) -> u8 {
    let any = packets | packets >> 2;
    let any = (any | any >> 1) & 0x1111_1111;
    let any = (any | any >> 3) & 0x0303_0303;
    let any = (any | any >> 6) & 0x000F_000F;
    (any | any >> 12) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_has_a_lane_of_its_own() {
        let mut taken = [0_u8; PACKETS];
        for (x, y) in (0..TILE_PX).flat_map(|y| (0..TILE_PX).map(move |x| (x, y))) {
            let (packet, lane) = lane_of(x, y);
            taken[packet] |= 1 << lane;
            let (left, top) = corner_of(packet);
            assert_eq!((left + lane % PACKET_PX.0, top + lane / PACKET_PX.0), (x, y));
            let in_packet = packets_in(1 << (y / PACKET_PX.1), 1 << (x / PACKET_PX.0));
            assert_eq!(in_packet, 1 << packet);
            assert_eq!(bundles_of(in_packet), 1 << (y / BUNDLE_PX.1 * BUNDLE_COLUMNS + x / BUNDLE_PX.0));
        }
        assert_eq!(taken, [u8::MAX; PACKETS]);
        assert_eq!(packets_in(0xFF, 0xF), u32::MAX);
    }

    #[test]
    fn packets_and_bundles_belong_together() {
        assert_eq!(packets_of(0b1000_0001), 0xF000_000F);
        assert_eq!(bundles_of(0x8000_0400), 0b1000_0100);
        for bundles in 0..=u8::MAX {
            assert_eq!(bundles_of(packets_of(bundles)), bundles);
            for packet in 0..4 {
                assert_eq!(bundles_of(packets_of(bundles) & 0x1111_1111 << packet), bundles);
            }
        }
    }
}
