//! A tile's way through the octree: front to back, once for all of its rays.
//!
//! The cells of a ray are met in the order of their parameters, since of two octants the one on the eye's side comes first.
//! A ray's stretch of a cell is bounded by the parameters at which it passes the cell's planes; cells that share a plane
//! share the number, so the stretches leave no gap.

use super::crossing::Rays;
use super::frustum::Frustum;
use super::lanes::{F64s, LANES, Mask, Vec3s};
use super::program::{Solved, is_plain};
use super::{PACKETS, packet_block};
use crate::compile::{Catalog, Constant, Program};
use crate::geom::Vec3;
use crate::octree::{Kind, Octree};

/// Eight rays on their way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packet {
    pub rays: Rays,
    /// One over the direction.
    inverse: Vec3s,
    /// Rays that have met nothing so far.
    pub open: Mask,
    /// Rays that scalar code must trace.
    pub given_up: Mask,
    /// Where rays met something.
    pub t: F64s,
    /// The literals that they met.
    pub words: [u64; LANES],
}

impl Packet {
    /// Rays that set out; those not `wanted` are ignored.
    pub fn new(rays: Rays, wanted: Mask) -> Self {
        let one = F64s::splat(1.0);
        let d = rays.direction;
        let inverse = Vec3s::new(one / d.x, one / d.y, one / d.z);
        Self { rays, inverse, open: wanted, given_up: Mask::NONE, t: F64s::INFINITY, words: [0; LANES] }
    }

    /// The rays' stretches of a cube.
    #[inline(always)]
    fn stretch(&self, center: Vec3, half: f64) -> (F64s, F64s) {
        let (mut t_in, mut t_out) = (F64s::ZERO, F64s::INFINITY);
        let axes = [
            (self.rays.origin.x, self.inverse.x, center.x),
            (self.rays.origin.y, self.inverse.y, center.y),
            (self.rays.origin.z, self.inverse.z, center.z),
        ];
        for (origin, inverse, center) in axes {
            let low = (F64s::splat(center - half) - origin) * inverse;
            let high = (F64s::splat(center + half) - origin) * inverse;
            let forward = inverse.gt(F64s::ZERO);
            // A ray in one of the planes has no number there, and no bound.
            t_in = t_in.max(forward.select(low, high));
            t_out = t_out.min(forward.select(high, low));
        }
        (t_in, t_out)
    }
}

/// What a tile is traced through.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scenery<'a> {
    pub catalog: &'a Catalog,
    pub program: &'a Program,
    pub octree: &'a Octree,
    pub frustum: &'a Frustum,
    /// Whether rays set out outside, and look for the inside.
    pub wanted: bool,
}

/// Counts for statistics.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work {
    pub cells: u64,
    pub surface_tests: u64,
}

/// The most cells that wait: seven for each level, and the last one's children.
const MAX_WAITING: usize = 160;

/// Follows all packets to the first crossing.
#[inline(always)]
pub(super) fn walk(scenery: &Scenery, packets: &mut [Packet; PACKETS]) -> Work {
    let mut work = Work::default();
    let mut solved = Solved::empty();
    let octree = scenery.octree;
    let bounded = scenery.program.outer == Constant::Everywhere(!scenery.wanted);
    if !bounded {
        for packet in packets.iter_mut() {
            let (t_in, _) = packet.stretch(octree.center, octree.half);
            outer(scenery, packet, &mut solved, t_in.gt(F64s::ZERO), (F64s::ZERO, t_in), &mut work);
        }
    }
    let mut open = open_blocks(packets);
    let mut waiting = [(octree.root, Vec3::ZERO, 0.0, 0_u16); MAX_WAITING];
    waiting[0] = (octree.root, octree.center, octree.half, u16::MAX);
    let mut count = 1;
    let (eye, direction) = (packets[0].rays.lane(0).origin, packets[0].rays.lane(0).direction);
    let parallel = packets[PACKETS - 1].rays.lane(LANES - 1).origin != eye;
    while count > 0 && open != 0 {
        count -= 1;
        let (word, center, half, blocks) = waiting[count];
        let blocks = blocks & open;
        if blocks == 0 {
            continue;
        }
        match word.kind() {
            Kind::Branch(index) => {
                let children = &octree.branches[index as usize];
                let child_half = half / 2.0;
                let reached = scenery.frustum.reached(center, child_half, octree.margin);
                let near = nearest_octant(eye, direction, parallel, center);
                for order in (0..LANES).rev() {
                    let octant = order ^ near;
                    let blocks = reached[octant] & blocks;
                    let is_void = match children[octant].kind() {
                        Kind::Outside => scenery.wanted,
                        Kind::Inside => !scenery.wanted,
                        Kind::Leaf(_) | Kind::Branch(_) => false,
                    };
                    if blocks != 0 && !is_void {
                        let center = Octree::child_center(center, child_half, octant);
                        waiting[count] = (children[octant], center, child_half, blocks);
                        count += 1;
                    }
                }
            }
            Kind::Leaf(offset) => {
                work.cells += 1;
                let words = octree.program(offset);
                let plain = is_plain(scenery.catalog, words);
                for (number, packet) in packets.iter_mut().enumerate() {
                    if blocks >> packet_block(number) & 1 == 0 || !packet.open.any() {
                        continue;
                    }
                    let (t_in, t_out) = packet.stretch(center, half);
                    let here = packet.open & t_in.le(t_out);
                    if !here.any() {
                        continue;
                    }
                    if plain {
                        evaluate(scenery, packet, &mut solved, words, here, (t_in, t_out), &mut work);
                    } else {
                        give_up(packet, here);
                    }
                }
                open = open_blocks(packets);
            }
            // All inside what the rays come to: they should have met its surface before.
            Kind::Outside | Kind::Inside => {
                let is_void = (word.kind() == Kind::Outside) == scenery.wanted;
                for packet in packets.iter_mut().filter(|_| !is_void) {
                    let (t_in, t_out) = packet.stretch(center, half);
                    give_up(packet, packet.open & t_in.le(t_out));
                }
                open = open_blocks(packets);
            }
        }
    }
    if !bounded {
        for packet in packets.iter_mut().filter(|packet| packet.open.any()) {
            let (t_in, t_out) = packet.stretch(octree.center, octree.half);
            let from = t_in.le(t_out).select(t_out, F64s::ZERO);
            outer(scenery, packet, &mut solved, Mask::splat(true), (from, F64s::INFINITY), &mut work);
        }
    }
    work
}

/// The blocks with rays that have met nothing so far.
#[inline(always)]
fn open_blocks(packets: &[Packet; PACKETS]) -> u16 {
    let mut open = 0;
    for (number, packet) in packets.iter().enumerate() {
        open |= u16::from(packet.open.any()) << packet_block(number);
    }
    open
}

/// The octant of a cell that rays meet first.
#[inline(always)]
fn nearest_octant(eye: Vec3, direction: Vec3, parallel: bool, center: Vec3) -> usize {
    let side =
        |eye: f64, direction: f64, center: f64| usize::from(if parallel { direction < 0.0 } else { eye > center });
    side(eye.x, direction.x, center.x)
        | side(eye.y, direction.y, center.y) << 1
        | side(eye.z, direction.z, center.z) << 2
}

/// Leaves rays to scalar code.
#[inline(always)]
fn give_up(packet: &mut Packet, rays: Mask) {
    packet.given_up = packet.given_up | rays;
    packet.open = packet.open & !rays;
}

/// A stretch outside the octree's root, for some rays.
#[inline(always)]
fn outer<'a>(
    scenery: &Scenery<'a>,
    packet: &mut Packet,
    solved: &mut Solved<'a>,
    rays: Mask,
    (t_in, t_out): (F64s, F64s),
    work: &mut Work,
) {
    let here = packet.open & rays & t_in.le(t_out);
    match &scenery.program.outer {
        Constant::Words(words) if !is_plain(scenery.catalog, words) => give_up(packet, here),
        Constant::Words(words) => evaluate(scenery, packet, solved, words, here, (t_in, t_out), work),
        Constant::Everywhere(inside) if *inside == scenery.wanted => give_up(packet, here),
        Constant::Everywhere(_) => {}
    }
}

/// A stretch with a plain program.
#[inline(always)]
fn evaluate<'a>(
    scenery: &Scenery<'a>,
    packet: &mut Packet,
    solved: &mut Solved<'a>,
    words: &'a [u32],
    here: Mask,
    (t_in, t_out): (F64s, F64s),
    work: &mut Work,
) {
    work.surface_tests += words.len() as u64 * here.count();
    solved.solve(scenery.catalog, words, &packet.rays);
    let from = here.select(t_in, F64s::INFINITY);
    let t = solved.next(from, scenery.wanted);
    let met = here & t.le(t_out) & t.lt(F64s::INFINITY);
    if !met.any() {
        return;
    }
    let changes = solved.changes(t);
    let sound = changes.before ^ changes.after;
    let found = met & sound;
    packet.t = found.select(t, packet.t);
    packet.words = found.select_words(changes.words, packet.words);
    packet.open = packet.open & !found;
    give_up(packet, met & !sound);
}
