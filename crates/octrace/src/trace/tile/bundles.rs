//! Rays of a stream in eight bundles, of four packets each, as far as neighbours in the stream have anything in common.
//!
//! Of a bundle's rays one knows the least and the greatest coordinates. So one knows between which parameters they come
//! through a cell, and the parallelepipeds in which they are then, for which programs are pruned as for the parts of a beam
//! ([`super::prune`]). That says something of cells that are not much smaller than the bundle is wide.

use super::PACKETS;
use super::kernels::Cube;
use super::lanes::{F64s, Isa, LANES, Mask, Stored, Vector};
use super::packet::Packet;
use super::prune::{Boxes, Parts};
use crate::geom::Vec3;

/// Packets of a bundle.
const TOGETHER: usize = PACKETS / LANES;

/// A bundle is used in cells with at least this part of its width as half edge.
const LEAST_CELL: f64 = 0.25;

/// The least and the greatest of what rays have, a lane for each bundle.
#[derive(Clone, Copy, Debug, Default)]
struct Range {
    low: Stored,
    high: Stored,
}

/// The bundles of a stream's packets.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bundles {
    origin: [Range; 3],
    direction: [Range; 3],
    inverse: [Range; 3],
    /// Parameters beyond which nothing counts.
    end: Stored,
    /// How wide they are where they are widest; infinite for bundles that are not to be used.
    width: Stored,
    state: State,
    /// Nothing is looked for but in here.
    root: Cube,
}

/// What is known of the bundles: it takes a while to find out, and few rays never need it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum State {
    #[default]
    Nothing,
    /// What rays they have.
    Gathered,
    /// And how wide they are in an octree.
    Measured,
}

/// The parameters with which bundles come through a cell, at most.
pub(super) struct Passage<I: Isa> {
    t_in: F64s<I>,
    t_out: F64s<I>,
    /// Which come through it.
    pub bundles: u8,
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

impl Bundles {
    /// There are other rays now.
    pub fn forget(&mut self) {
        self.state = State::Nothing;
    }

    /// The same rays go through the octree with that root.
    pub fn enter(&mut self, root: Cube) {
        self.root = root;
        self.state = if self.state == State::Nothing { State::Nothing } else { State::Gathered };
    }

    /// Finds out what is to be known of the rays of the packets, if it is not known. Their directions have the same `signs`.
    #[inline(always)]
    pub fn know<I: Isa>(&mut self, packets: &[Packet; PACKETS], signs: usize) {
        if self.state == State::Nothing {
            self.gather::<I>(packets);
        }
        if self.state != State::Measured {
            self.measure::<I>(signs);
        }
        self.state = State::Measured;
    }

    #[inline(always)]
    fn gather<I: Isa>(&mut self, packets: &[Packet; PACKETS]) {
        for axis in 0..3 {
            self.origin[axis] = Range::of::<I>(packets, |packet| &packet.origin[axis]);
            self.direction[axis] = Range::of::<I>(packets, |packet| &packet.direction[axis]);
            self.inverse[axis] = Range::of::<I>(packets, |packet| &packet.inverse[axis]);
        }
        self.end = Range::of::<I>(packets, |packet| &packet.t).high;
    }

    #[inline(always)]
    fn measure<I: Isa>(&mut self, signs: usize) {
        let Passage { t_out, .. } = self.passage::<I>(signs, self.root, Vec3::ZERO);
        let (mut width, mut usual) = (F64s::<I>::zero(), t_out.is_finite());
        for axis in 0..3 {
            let extent = |range: &Range| F64s::<I>::load(&range.high) - F64s::load(&range.low);
            width = width.max(extent(&self.origin[axis]) + extent(&self.direction[axis]) * t_out.max(F64s::zero()));
            let Range { low, high } = &self.inverse[axis];
            usual = usual & F64s::load(low).is_finite() & F64s::load(high).is_finite();
        }
        // Bundles without rays reach from infinity to infinity.
        self.width = (usual & width.is_finite()).select(width, F64s::infinity()).stored();
    }

    /// The bundles that are to be used in cells with that half edge.
    #[inline(always)]
    pub fn narrow<I: Isa>(&self, half: f64) -> u8 {
        (F64s::<I>::load(&self.width) * F64s::splat(LEAST_CELL)).le(F64s::splat(half)).bits()
    }

    /// Bounds of the parameters at which the bundles, seen from `from`, pass a plane across an axis.
    ///
    /// They are made by the operations that make the rays' own, which are monotonous: so they hold for what those come to,
    /// rounding included.
    #[inline(always)]
    fn passes<I: Isa>(&self, axis: usize, negative: bool, plane: f64, from: Vec3) -> (F64s<I>, F64s<I>) {
        let load = |range: &Range| (F64s::<I>::load(&range.low), F64s::<I>::load(&range.high));
        let (low, high) = load(&self.inverse[axis]);
        let (least, greatest) = load(&self.origin[axis]);
        let (least, greatest) = (least - F64s::splat(from[axis]), greatest - F64s::splat(from[axis]));
        let (first, last) = if negative { (least, greatest) } else { (greatest, least) };
        let (first, last) = (F64s::splat(plane) - first, F64s::splat(plane) - last);
        ((first * low).min(first * high), (last * low).max(last * high))
    }

    /// How the bundles, seen from `from`, come through a cube.
    #[inline(always)]
    pub fn passage<I: Isa>(&self, signs: usize, Cube { center, half }: Cube, from: Vec3) -> Passage<I> {
        let (mut t_in, mut t_out) = (F64s::zero(), F64s::load(&self.end));
        for axis in 0..3 {
            let negative = signs >> axis & 1 != 0;
            let (low, high) = (center[axis] - half, center[axis] + half);
            let (near, far) = if negative { (high, low) } else { (low, high) };
            t_in = t_in.max(self.passes::<I>(axis, negative, near, from).0);
            t_out = t_out.min(self.passes::<I>(axis, negative, far, from).1);
        }
        Passage { t_in, t_out, bundles: t_in.le(t_out).bits() }
    }

    /// Where the bundles' rays are on that passage, seen from `from`.
    #[inline(always)]
    pub fn parts<I: Isa>(&self, passage: &Passage<I>, margin: f64, from: Vec3) -> Parts<I, Boxes<I>> {
        let half = F64s::splat(0.5);
        let middle = |range: &Range| (F64s::<I>::load(&range.low) + F64s::load(&range.high)) * half;
        let extent = |range: &Range| (F64s::<I>::load(&range.high) - F64s::load(&range.low)) * half;
        let [x, y, z] = &self.origin;
        let [u, v, w] = &self.direction;
        let reach = |origin: &Range, direction: &Range| extent(origin) + extent(direction) * passage.t_out;
        Parts {
            origin: Vector::new(middle(x), middle(y), middle(z)).minus::<I>(from),
            direction: Vector::new(middle(u), middle(v), middle(w)),
            depth: (passage.t_in + passage.t_out) * half,
            half_depth: (passage.t_out - passage.t_in) * half,
            across: Boxes { half: Vector::new(reach(x, u), reach(y, v), reach(z, w)) },
            margin,
        }
    }
}

impl Range {
    /// Of the rays of each bundle that are followed together.
    #[inline(always)]
    fn of<I: Isa>(packets: &[Packet; PACKETS], what: impl Fn(&Packet) -> &Stored) -> Self {
        let mut range = Self::default();
        for (bundle, packets) in packets.chunks_exact(TOGETHER).enumerate() {
            let (mut low, mut high) = (F64s::<I>::infinity(), -F64s::<I>::infinity());
            for packet in packets {
                let (here, v) = (Mask::from_bits(packet.wanted & !packet.given_up), F64s::load(what(packet)));
                low = low.min(here.select(v, low));
                high = high.max(here.select(v, high));
            }
            let (low, high) = (low.stored().0, high.stored().0);
            let least = |a: f64, b: f64| if b < a { b } else { a };
            let greatest = |a: f64, b: f64| if b > a { b } else { a };
            range.low.0[bundle] = least(
                least(least(low[0], low[1]), least(low[2], low[3])),
                least(least(low[4], low[5]), least(low[6], low[7])),
            );
            range.high.0[bundle] = greatest(
                greatest(greatest(high[0], high[1]), greatest(high[2], high[3])),
                greatest(greatest(high[4], high[5]), greatest(high[6], high[7])),
            );
        }
        range
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
