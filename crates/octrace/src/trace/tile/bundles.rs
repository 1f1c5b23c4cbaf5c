//! Rays of a stream in eight bundles, of four packets each, as far as neighbours in the stream have anything in common.
//!
//! Of a bundle's rays one knows the least and the greatest coordinates. So one knows between which parameters they come
//! through a cell, and the parallelepipeds in which they are then, for which programs are pruned as for the parts of a beam
//! ([`super::parts`]). That says something of cells that are not much smaller than the bundle is wide.

use super::kernels::Cube;
use super::lanes::{F64s, Isa, LANES, Mask, Stored, Vector};
use super::layout::{PACKETS, TOGETHER};
use super::packet::Packet;
use super::parts::{Boxes, Parts};
use crate::geom::Vec3;

/// Programs are pruned for a bundle in cells with at least this part of its width as half edge.
pub(super) const LEAST_PRUNED: f64 = 0.25;

/// A bundle is led through the octree as a whole where octants have at least this part of its width as half edge.
pub(super) const LEAST_LED: f64 = 0.5;

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
            // Directions have the same sign; dividing keeps their order.
            let Range { low, high } = &self.direction[axis];
            let one = F64s::<I>::splat(1.0);
            self.inverse[axis] =
                Range { low: (one / F64s::load(high)).stored(), high: (one / F64s::load(low)).stored() };
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
            // Nor are directions of bundles without rays.
            for Range { low, high } in [&self.direction[axis], &self.inverse[axis]] {
                usual = usual & F64s::load(low).is_finite() & F64s::load(high).is_finite();
            }
        }
        self.width = (usual & width.is_finite()).select(width, F64s::infinity()).stored();
    }

    /// The bundles of which at most this part of the width is at most that wide.
    #[inline(always)]
    pub fn narrow<I: Isa>(&self, part: f64, half: f64) -> u8 {
        (F64s::<I>::load(&self.width) * F64s::splat(part)).le(F64s::splat(half)).bits()
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

    /// The bundles, seen from `from`, that come through each octant of a cube, numbered from the nearest on.
    #[inline(always)]
    pub fn octants_met<I: Isa>(&self, signs: usize, Cube { center, half }: Cube, from: Vec3) -> [u8; LANES] {
        let whole = (F64s::<I>::zero(), F64s::<I>::infinity());
        // Where bundles enter and leave the near half and the far half, across each axis.
        let mut halves = [[whole; 2]; 3];
        for axis in 0..3 {
            let negative = signs >> axis & 1 != 0;
            let (low, high) = (center[axis] - half, center[axis] + half);
            let (near, far) = if negative { (high, low) } else { (low, high) };
            let (middle_first, middle_last) = self.passes::<I>(axis, negative, center[axis], from);
            halves[axis] = [
                (self.passes::<I>(axis, negative, near, from).0, middle_last),
                (middle_first, self.passes::<I>(axis, negative, far, from).1),
            ];
        }
        let end = F64s::load(&self.end);
        let mut bundles = [0; LANES];
        for order in 0..LANES {
            let (x, y, z) = (halves[0][order & 1], halves[1][order >> 1 & 1], halves[2][order >> 2]);
            let t_in = F64s::zero().max(x.0).max(y.0).max(z.0);
            let t_out = end.min(x.1).min(y.1).min(z.1);
            bundles[order] = t_in.le(t_out).bits();
        }
        bundles
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
            for packet in packets.iter().filter(|packet| packet.wanted != 0) {
                let (here, v) = (Mask::from_bits(packet.wanted & !packet.given_up), F64s::load(what(packet)));
                low = low.min(here.select(v, low));
                high = high.max(here.select(v, high));
            }
            (range.low.0[bundle], range.high.0[bundle]) = (low.least(), high.greatest());
        }
        range
    }
}
