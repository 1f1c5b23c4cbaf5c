//! A tile's way through the octree: front to back, once for all of its rays.
//!
//! The cells of a ray are met in the order of their parameters, since of two octants the one on the eye's side comes first.
//! A ray's stretch of a cell is bounded by the parameters at which it passes the cell's planes; cells that share a plane
//! share the number, so the stretches leave no gap.

use super::PACKETS;
use super::RayTile;
use super::beam::Beam;
use super::bundles::{Bundles, LEAST_LED};
use super::kernels::{Chunk, Cube, Stretch, bits_of};
use super::lanes::{F64s, Isa, LANES, Number};
use super::layout::packets_of;
use super::leaf::Slabs;
use super::mesh::MeshMemo;
use super::packet::{Origins, Packet};
use super::program::{Kinds, Solved, kinds_of};
use super::prune::Known;
use crate::compile::{Catalog, Constant, Program};
use crate::geom::Vec3;
use crate::octree::{CellWord, Kind, Octree};
use crate::trace::body::Body;
use crate::trace::{Scratch, Tracer};
use std::marker::PhantomData;

/// What a tile is traced through.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scenery<'a> {
    pub catalog: &'a Catalog,
    pub program: &'a Program,
    pub octree: &'a Octree,
    /// Whether rays set out outside, and look for the inside.
    pub wanted: bool,
    /// The body's number.
    pub body: u32,
    /// Whether all surfaces are planes and quadrics, but for whole solids.
    pub only_plain: bool,
    /// Solids that stand in many places; none in a copy of one.
    pub prototypes: &'a [Body],
    /// Where the origin of the octree's and the surfaces' coordinates is.
    pub offset: Vec3,
    /// What is added to the numbers of literals.
    pub literal_shift: u32,
}

impl<'a> Scenery<'a> {
    /// A body as a whole.
    pub fn of(tracer: &'a Tracer, number: usize, octree: &'a Octree, wanted: bool) -> Self {
        let body = &tracer.bodies[number];
        let prototypes = body.prototypes();
        Self {
            catalog: &tracer.catalog,
            program: &body.program,
            octree,
            wanted,
            body: number as u32,
            only_plain: tracer.only_plain,
            prototypes,
            offset: Vec3::ZERO,
            literal_shift: 0,
        }
    }

    /// What kinds of surfaces a program has.
    #[inline(always)]
    pub(super) fn kinds_of(&self, words: &[u32]) -> Kinds {
        if self.only_plain && self.prototypes.is_empty() { Kinds::Plain } else { kinds_of(self.catalog, words) }
    }
}

/// A cell that waits for its turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    word: CellWord,
    center: Vec3,
    half: f64,
    /// The packets that may reach it, as far as one knows.
    packets: u32,
}

impl Waiting {
    /// The most cells that wait: seven for each level, and the last one's children; as many again for a copy of a solid.
    pub const MOST: usize = 320;
    pub const NOTHING: Self = Self { word: CellWord::OUTSIDE, center: Vec3::ZERO, half: 0.0, packets: 0 };

    /// All of an octree, for all packets.
    pub fn root(octree: &Octree) -> Self {
        Self { word: octree.root, center: octree.center, half: octree.half, packets: u32::MAX }
    }
}

/// How packets are led through the octree.
#[derive(Clone, Copy, Debug)]
pub(super) enum Lead {
    /// As one beam.
    Beam,
    /// Packet by packet. The directions of all rays have the same signs, a bit for each that is negative.
    Signs(usize),
}

/// Bundles are led through branches as a whole if there are at least so many packets.
const LED_FROM: u32 = 4;

/// Follows all packets to the first crossing.
#[inline(always)]
pub(super) fn walk<I: Isa, O: Origins<I>>(scenery: Scenery, lead: Lead, tile: &mut RayTile, scratch: &mut Scratch) {
    let RayTile { packets, beam, bundles, waiting, solved, meshes, slabs, chunk, .. } = tile;
    let mut walk = Walk::<I, O> {
        scenery,
        beam,
        bundles,
        packets,
        scratch,
        open: 0,
        solved,
        meshes,
        slabs,
        chunk,
        known: Known::nothing(),
        machine: PhantomData,
    };
    walk.count_open();
    let bounded = scenery.program.outer == Constant::Everywhere(!scenery.wanted);
    if !bounded {
        walk.before(lead);
    }
    match lead {
        Lead::Beam => walk.inside(waiting),
        Lead::Signs(near) => walk.inside_singly(near, waiting),
    }
    if !bounded {
        walk.behind();
    }
}

pub(super) struct Walk<'a, 'b, I: Isa, O: Origins<I>> {
    pub scenery: Scenery<'a>,
    pub beam: &'b Beam,
    pub bundles: &'b mut Bundles,
    pub packets: &'b mut [Packet; PACKETS],
    pub scratch: &'b mut Scratch,
    /// Packets with rays that have met nothing so far.
    pub open: u32,
    pub solved: &'b mut Solved,
    pub meshes: &'b mut MeshMemo,
    pub slabs: &'b mut Slabs,
    pub chunk: &'b mut Option<Box<Chunk>>,
    pub known: Known,
    pub machine: PhantomData<(I, O)>,
}

impl<I: Isa, O: Origins<I>> Walk<'_, '_, I, O> {
    pub(super) fn count_open(&mut self) {
        self.open = 0;
        for (number, packet) in self.packets.iter().enumerate() {
            self.open |= u32::from(packet.open != 0) << number;
        }
    }

    /// The cells of the octree.
    #[inline(always)]
    fn inside(&mut self, waiting: &mut [Waiting; Waiting::MOST]) {
        let void = if self.scenery.wanted { CellWord::OUTSIDE } else { CellWord::INSIDE };
        let beam = self.beam;
        waiting[0] = Waiting::root(self.scenery.octree);
        let mut count = usize::from(waiting[0].word != void);
        let mut visit = None;
        while self.goes_on(&mut count, &mut visit) {
            count -= 1;
            let Scenery { octree, offset, .. } = self.scenery;
            let Waiting { word, center, half, .. } = waiting[count];
            let reached = beam.reached::<I>(center + offset, half + octree.margin);
            let packets = reached.packets & self.open;
            if packets == 0 {
                continue;
            }
            match word.kind() {
                Kind::Branch(index) => {
                    let children = &octree.branches[index as usize];
                    let child_half = half / 2.0;
                    let octants = beam.octants::<I>(&reached, child_half, octree.margin)
                        & I::differing(&children.map(CellWord::bits), void.bits());
                    let near = self.nearest_octant(center);
                    // The nearest goes on top.
                    let mut left = swapped(octants, near);
                    while left != 0 {
                        let order = 7 - left.leading_zeros() as usize;
                        left &= !(1 << order);
                        let octant = order ^ near;
                        let center = Octree::child_center(center, child_half, octant);
                        waiting[count] = Waiting { word: children[octant], center, half: child_half, packets };
                        count += 1;
                    }
                }
                Kind::Leaf(program) => {
                    self.scratch.counters.cells += 1;
                    let words = octree.program(program);
                    match self.copy_in(words) {
                        None => self.leaf(words, packets, center, half),
                        Some(placed) => {
                            let packets = packets & self.reach_copy(placed);
                            self.visit(placed, packets, Cube { center, half }, waiting, &mut count, &mut visit);
                        }
                    }
                }
                // All inside what the rays come to: they should have met its surface before.
                Kind::Outside | Kind::Inside => self.give_up_in(packets, Cube { center, half }, (0.0, f64::INFINITY)),
            }
        }
    }

    /// The cells of the octree, each for those packets that come through it.
    #[inline(always)]
    fn inside_singly(&mut self, near: usize, waiting: &mut [Waiting; Waiting::MOST]) {
        let void = if self.scenery.wanted { CellWord::OUTSIDE } else { CellWord::INSIDE };
        let everywhere = (0.0, f64::INFINITY);
        waiting[0] = Waiting::root(self.scenery.octree);
        let Octree { center, half, .. } = *self.scenery.octree;
        self.bundles.enter(Cube { center, half });
        let mut count = usize::from(waiting[0].word != void);
        let mut visit = None;
        while self.goes_on(&mut count, &mut visit) {
            count -= 1;
            let octree = self.scenery.octree;
            let Waiting { word, center, half, packets } = waiting[count];
            let packets = packets & self.open;
            let cube = Cube { center, half };
            match word.kind() {
                _ if packets == 0 => {}
                Kind::Branch(index) => {
                    let children = &octree.branches[index as usize];
                    let (led, mut visitors) = self.bundles_in(packets, cube, near);
                    for number in bits_of(packets & !led) {
                        let mut octants = self.octants_met(number, cube);
                        while octants != 0 {
                            visitors[octants.trailing_zeros() as usize & 7] |= 1 << number;
                            octants &= octants - 1;
                        }
                    }
                    // The nearest goes on top.
                    for order in (0..LANES).rev() {
                        let octant = order ^ near;
                        if visitors[order] != 0 && children[octant] != void {
                            let center = Octree::child_center(center, half / 2.0, octant);
                            let packets = visitors[order];
                            waiting[count] = Waiting { word: children[octant], center, half: half / 2.0, packets };
                            count += 1;
                        }
                    }
                }
                Kind::Leaf(offset) => {
                    self.scratch.counters.cells += 1;
                    let words = octree.program(offset);
                    match self.copy_in(words) {
                        Some(placed) => self.visit(placed, packets, cube, waiting, &mut count, &mut visit),
                        None => self.leaf_of_stream(words, packets, cube, near),
                    }
                }
                Kind::Outside | Kind::Inside => self.give_up_in(packets, cube, everywhere),
            }
        }
    }

    /// Of packets in a branch those that go on as bundles, and which of them may come through each octant, numbered from the
    /// nearest on: fewer than one would find out for each by itself, but there is less to do.
    #[inline(always)]
    fn bundles_in(&mut self, packets: u32, cube: Cube, signs: usize) -> (u32, [u32; LANES]) {
        let mut visitors = [0; LANES];
        if packets.count_ones() < LED_FROM {
            return (0, visitors);
        }
        self.bundles.know::<I>(self.packets, signs);
        let led = packets & packets_of(self.bundles.narrow::<I>(LEAST_LED, cube.half / 2.0));
        if led != 0 {
            let met = self.bundles.octants_met::<I>(signs, cube, self.scenery.offset);
            for order in 0..LANES {
                visitors[order] = packets_of(met[order]) & led;
            }
        }
        (led, visitors)
    }

    /// The octants of a cell that a packet's rays come through, numbered from the nearest on.
    #[inline(always)]
    fn octants_met(&self, number: usize, cube: Cube) -> u8 {
        let packet = &self.packets[number];
        let (here, Stretch { t_in, t_out }) = self.crossing(number, cube, (0.0, f64::INFINITY));
        let origin = O::of(packet, self.beam.eye, self.scenery.offset);
        let middle = |axis: usize, origin: O::Number, center: f64| {
            (O::Number::from_one(center) - origin).lanes() * F64s::<I>::load(&packet.inverse[axis])
        };
        // Where rays leave the near half, and where they enter the far one. A ray in the plane between is in both.
        let halves = |middle: F64s<I>| (t_out.min(middle), t_in.max(middle));
        let (near_x, far_x) = halves(middle(0, origin.x, cube.center.x));
        let (near_y, far_y) = halves(middle(1, origin.y, cube.center.y));
        let (near_z, far_z) = halves(middle(2, origin.z, cube.center.z));
        let (near_xy, far_xy) = (near_x.min(near_y), far_x.max(far_y));
        let met = |start: F64s<I>, end: F64s<I>, bit: u32| u8::from((here & start.le(end)).any()) << bit;
        met(t_in, near_xy.min(near_z), 0)
            | met(far_x, near_y.min(near_z), 1)
            | met(far_y, near_x.min(near_z), 2)
            | met(far_xy, near_z, 3)
            | met(far_z, near_xy, 4)
            | met(far_x.max(far_z), near_y, 5)
            | met(far_y.max(far_z), near_x, 6)
            | met(far_xy.max(far_z), t_out, 7)
    }

    /// The octant of a cell that rays meet first.
    #[inline(always)]
    fn nearest_octant(&self, center: Vec3) -> usize {
        let Beam { eye, forward, parallel, .. } = *self.beam;
        let eye = eye - self.scenery.offset;
        let side =
            |eye: f64, forward: f64, center: f64| usize::from(if parallel { forward < 0.0 } else { eye > center });
        side(eye.x, forward.x, center.x) | side(eye.y, forward.y, center.y) << 1 | side(eye.z, forward.z, center.z) << 2
    }
}

/// The bits in another order: bit `i` is what bit `i ^ by` was.
#[inline(always)]
fn swapped(bits: u8, by: usize) -> u8 {
    let bits = if by & 1 != 0 { (bits & 0x55) << 1 | bits >> 1 & 0x55 } else { bits };
    let bits = if by & 2 != 0 { (bits & 0x33) << 2 | bits >> 2 & 0x33 } else { bits };
    if by & 4 != 0 { bits.rotate_left(4) } else { bits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_swapped_as_their_numbers_are() {
        for bits in 0..=u8::MAX {
            for by in 0..8 {
                for i in 0..8 {
                    assert_eq!(swapped(bits, by) >> i & 1, bits >> (i ^ by) & 1);
                }
            }
        }
    }
}
