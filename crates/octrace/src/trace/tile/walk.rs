//! A tile's way through the octree: front to back, once for all of its rays.
//!
//! The cells of a ray are met in the order of their parameters, since of two octants the one on the eye's side comes first.
//! A ray's stretch of a cell is bounded by the parameters at which it passes the cell's planes; cells that share a plane
//! share the number, so the stretches leave no gap.

use super::beam::{Beam, PART_PACKETS};
use super::lanes::{F64s, Isa, Kernel, LANES, Mask, Number, Stored, Vector};
use super::packet::Packet;
use super::program::{CHUNK, Solved, crossed, is_plain, is_short};
use super::prune::{Known, Parts, Pruned};
use super::{PACKETS, RayTile};
use crate::compile::{Catalog, Constant, Program};
use crate::geom::Vec3;
use crate::octree::{CellWord, Kind, Octree};
use crate::trace::Scratch;
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
    /// Whether all surfaces are planes and quadrics.
    pub only_plain: bool,
}

impl Scenery<'_> {
    /// Whether all surfaces of a program can be crossed in lanes.
    #[inline(always)]
    fn is_plain(&self, words: &[u32]) -> bool {
        self.only_plain || is_plain(self.catalog, words)
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
    /// The most cells that wait: seven for each level, and the last one's children.
    pub const MOST: usize = 160;
    pub const NOTHING: Self = Self { word: CellWord::OUTSIDE, center: Vec3::ZERO, half: 0.0, packets: 0 };
}

/// Programs are pruned for at least so many packets; for fewer it takes longer than it saves.
const PRUNED_FOR: u32 = 6;

/// A slab is cut in two so many times at most.
pub(super) const MAX_CUTS: usize = 4;

/// A cube.
#[derive(Clone, Copy)]
struct Cube {
    center: Vec3,
    half: f64,
}

/// What lies between two depths of a leaf, for some parts of the beam.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    words: Pruned,
    near: f64,
    far: f64,
    parts: u8,
    cuts: usize,
}

/// Slabs that wait for their turn.
pub(super) type Slabs = [Slab; MAX_CUTS + 1];

impl Slab {
    pub const NOTHING: Self = Self { words: Pruned::NOTHING, near: 0.0, far: 0.0, parts: 0, cuts: 0 };
}

/// How rays start: all from one point, or each from its own.
pub(super) trait Origins<I: Isa> {
    type Number: Number<I>;
    fn of(packet: &Packet, eye: Vec3) -> Vector<Self::Number>;
}

/// From one point.
pub(super) struct Common;

/// Each from its own.
pub(super) struct Own;

impl<I: Isa> Origins<I> for Common {
    type Number = f64;

    #[inline(always)]
    fn of(_packet: &Packet, eye: Vec3) -> Vector<f64> {
        Vector::new(eye.x, eye.y, eye.z)
    }
}

impl<I: Isa> Origins<I> for Own {
    type Number = F64s<I>;

    #[inline(always)]
    fn of(packet: &Packet, _eye: Vec3) -> Vector<F64s<I>> {
        let [x, y, z] = &packet.origin;
        Vector::new(F64s::load(x), F64s::load(y), F64s::load(z))
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

/// Follows all packets to the first crossing.
#[inline(always)]
pub(super) fn walk<I: Isa, O: Origins<I>>(scenery: &Scenery, lead: Lead, tile: &mut RayTile, scratch: &mut Scratch) {
    let RayTile { packets, beam, waiting, solved, slabs, chunk, .. } = tile;
    let mut walk = Walk::<I, O> {
        scenery,
        beam,
        packets,
        scratch,
        open: 0,
        solved,
        slabs,
        chunk,
        known: Known::nothing(),
        machine: PhantomData,
    };
    walk.count_open();
    let bounded = scenery.program.outer == Constant::Everywhere(!scenery.wanted);
    if !bounded {
        walk.before();
    }
    match lead {
        Lead::Beam => walk.inside(waiting),
        Lead::Signs(near) => walk.inside_singly(near, waiting),
    }
    if !bounded {
        walk.behind();
    }
}

struct Walk<'a, 'b, I: Isa, O: Origins<I>> {
    scenery: &'b Scenery<'a>,
    beam: &'b Beam,
    packets: &'b mut [Packet; PACKETS],
    scratch: &'b mut Scratch,
    /// Packets with rays that have met nothing so far.
    open: u32,
    solved: &'b mut Solved,
    slabs: &'b mut Slabs,
    chunk: &'b mut Option<Box<Chunk>>,
    known: Known,
    machine: PhantomData<(I, O)>,
}

/// The stretches of eight rays in a cell.
#[derive(Clone, Copy)]
struct Stretch<I: Isa> {
    t_in: F64s<I>,
    t_out: F64s<I>,
}

impl<I: Isa, O: Origins<I>> Walk<'_, '_, I, O> {
    fn count_open(&mut self) {
        self.open = 0;
        for (number, packet) in self.packets.iter().enumerate() {
            self.open |= u32::from(packet.open != 0) << number;
        }
    }

    /// The cells of the octree.
    #[inline(always)]
    fn inside(&mut self, waiting: &mut [Waiting; Waiting::MOST]) {
        let Scenery { octree, wanted, .. } = *self.scenery;
        let void = if wanted { CellWord::OUTSIDE } else { CellWord::INSIDE };
        let beam = self.beam;
        waiting[0] = Waiting { word: octree.root, center: octree.center, half: octree.half, packets: u32::MAX };
        let mut count = usize::from(octree.root != void);
        while count > 0 && self.open != 0 {
            count -= 1;
            let Waiting { word, center, half, .. } = waiting[count];
            let reached = beam.reached::<I>(center, half + octree.margin);
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
                Kind::Leaf(offset) => {
                    self.scratch.counters.cells += 1;
                    self.leaf(octree.program(offset), packets, center, half);
                }
                // All inside what the rays come to: they should have met its surface before.
                Kind::Outside | Kind::Inside => self.give_up_in(packets, Cube { center, half }, (0.0, f64::INFINITY)),
            }
        }
    }

    /// The cells of the octree, each for those packets that come through it.
    #[inline(always)]
    fn inside_singly(&mut self, near: usize, waiting: &mut [Waiting; Waiting::MOST]) {
        let Scenery { octree, wanted, .. } = *self.scenery;
        let void = if wanted { CellWord::OUTSIDE } else { CellWord::INSIDE };
        let everywhere = (0.0, f64::INFINITY);
        waiting[0] = Waiting { word: octree.root, center: octree.center, half: octree.half, packets: u32::MAX };
        let mut count = usize::from(octree.root != void);
        while count > 0 && self.open != 0 {
            count -= 1;
            let Waiting { word, center, half, packets } = waiting[count];
            let packets = packets & self.open;
            let cube = Cube { center, half };
            match word.kind() {
                _ if packets == 0 => {}
                Kind::Branch(index) => {
                    let children = &octree.branches[index as usize];
                    let mut visitors = [0; LANES];
                    for number in bits_of(packets) {
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
                    match is_short(words) {
                        true => self.evaluate(words, packets, cube, everywhere),
                        false => self.give_up_in(packets, cube, everywhere),
                    }
                }
                Kind::Outside | Kind::Inside => self.give_up_in(packets, cube, everywhere),
            }
        }
    }

    /// The octants of a cell that a packet's rays come through, numbered from the nearest on.
    #[inline(always)]
    fn octants_met(&self, number: usize, cube: Cube) -> u8 {
        let packet = &self.packets[number];
        let (here, Stretch { t_in, t_out }) = self.crossing(number, cube, (0.0, f64::INFINITY));
        let origin = O::of(packet, self.beam.eye);
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
        let side =
            |eye: f64, forward: f64, center: f64| usize::from(if parallel { forward < 0.0 } else { eye > center });
        side(eye.x, forward.x, center.x) | side(eye.y, forward.y, center.y) << 1 | side(eye.z, forward.z, center.z) << 2
    }

    /// A leaf, for those packets.
    ///
    /// What the beam's parts see of it is pruned; where more than one surface is left, the parts are cut in depth, and the
    /// nearer half goes first.
    #[inline(always)]
    fn leaf(&mut self, words: &[u32], packets: u32, center: Vec3, half: f64) {
        if !is_short(words) {
            self.give_up_in(packets, Cube { center, half }, (0.0, f64::INFINITY));
            return;
        }
        let cube = Cube { center, half };
        if packets.count_ones() < PRUNED_FOR {
            self.evaluate(words, packets, cube, (0.0, f64::INFINITY));
            return;
        }
        let margin = self.scenery.octree.margin;
        let (near, far) = self.beam.depths(center, half + margin);
        self.slabs[0] = Slab { words: Pruned::new(words), near, far, parts: u8::MAX, cuts: 0 };
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let Slab { words, near, far, parts, cuts } = self.slabs[count];
            let mut open = 0;
            for (part, part_packets) in PART_PACKETS.iter().enumerate() {
                open |= u8::from(packets & self.open & part_packets != 0) << part;
            }
            let parts = parts & open;
            if parts == 0 {
                continue;
            }
            let region = Parts::<I>::new(self.beam, (near, far), margin);
            self.known.learn(self.scenery.catalog, words.words(), &region);
            let (always, never) = self.known.decided();
            let (settled, leaked) = if self.scenery.wanted { (never, always) } else { (always, never) };
            if leaked & !settled & parts != 0 {
                self.give_up_in(packets & packets_of(leaked & parts), cube, (near, far));
            }
            let undecided = parts & !(settled | leaked);
            let can_be_cut = cuts < MAX_CUTS && region.is_deep(self.beam);
            let crowded = if can_be_cut { self.known.crowded(words.words(), undecided) } else { 0 };
            let mut left = undecided & !crowded;
            while left != 0 {
                let alike = self.known.alike(words.words(), left);
                let pruned = self.known.pruned(words.words(), left & left.wrapping_neg());
                self.evaluate(pruned.words(), packets & packets_of(alike), cube, (near, far));
                left &= !alike;
            }
            if crowded != 0 {
                let words = self.known.pruned(words.words(), crowded);
                let middle = 0.5 * (near + far);
                self.slabs[count] = Slab { words, near: middle, far, parts: crowded, cuts: cuts + 1 };
                self.slabs[count + 1] = Slab { words, near, far: middle, parts: crowded, cuts: cuts + 1 };
                count += 2;
            }
        }
    }

    /// Evaluates a leaf's program for those packets.
    fn evaluate(&mut self, words: &[u32], packets: u32, cube: Cube, depths: (f64, f64)) {
        match *words {
            _ if !self.scenery.is_plain(words) => {
                I::call(OneByOne { walk: self, words, packets, cube, depths });
            }
            [word] => I::call(Single { walk: self, word, packets, cube, depths }),
            _ => I::call(Several { walk: self, words, packets, cube, depths }),
        }
        self.close(packets);
    }

    /// Takes note of which of those packets have no open rays any more.
    fn close(&mut self, packets: u32) {
        for number in bits_of(packets) {
            self.open &= !(u32::from(self.packets[number].open == 0) << number);
        }
    }

    /// Which open rays of a packet come through a cube between two depths, and their stretches there.
    #[inline(always)]
    fn crossing(&self, number: usize, cube: Cube, (near, far): (f64, f64)) -> (Mask<I>, Stretch<I>) {
        let packet = &self.packets[number];
        let mut stretch = self.stretch(packet, cube.center, cube.half);
        let per_depth = F64s::load(&packet.per_depth);
        // Where two slabs meet, both have the same number.
        stretch.t_in = stretch.t_in.max(F64s::splat(near) * per_depth);
        stretch.t_out = stretch.t_out.min(F64s::splat(far) * per_depth).min(F64s::load(&packet.t));
        (Mask::from_bits(packet.open) & stretch.t_in.le(stretch.t_out), stretch)
    }

    /// The rays' stretches of a cube.
    #[inline(always)]
    fn stretch(&self, packet: &Packet, center: Vec3, half: f64) -> Stretch<I> {
        let origin = O::of(packet, self.beam.eye);
        let (mut t_in, mut t_out) = (F64s::zero(), F64s::infinity());
        let axes = [(origin.x, 0, center.x), (origin.y, 1, center.y), (origin.z, 2, center.z)];
        for (origin, axis, center) in axes {
            let inverse = F64s::<I>::load(&packet.inverse[axis]);
            let low = (O::Number::from_one(center - half) - origin).lanes() * inverse;
            let high = (O::Number::from_one(center + half) - origin).lanes() * inverse;
            let forward = inverse.gt(F64s::zero());
            // A ray in one of the planes has no number there, and no bound.
            t_in = t_in.max(forward.select(low, high));
            t_out = t_out.min(forward.select(high, low));
        }
        Stretch { t_in, t_out }
    }

    /// A stretch with a program of one literal, which is plain.
    #[inline(always)]
    fn single(&mut self, word: u32, number: usize, here: Mask<I>, Stretch { t_in, t_out }: Stretch<I>) {
        self.scratch.counters.surface_tests += u64::from(here.bits().count_ones());
        let wanted = self.scenery.wanted;
        let crossed = crossed(self.scenery.catalog, word, &self.packets[number].rays::<I, O>(self.beam.eye));
        let starts_wanted = crossed.starts_inside ^ Mask::splat(!wanted);
        // Two crossings at one place cancel each other.
        let (a, b) = (crossed.a, crossed.b);
        let two_sides = a.lt(b);
        let turn = starts_wanted.select(b, a);
        // Already there, and not since just now.
        let between = two_sides & a.lt(t_in) & t_in.lt(b) & !starts_wanted;
        let beyond = starts_wanted & !(two_sides & a.le(t_in) & t_in.le(b));
        let leaked = here & (between | beyond);
        let found = here & !leaked & two_sides & turn.ge(t_in) & turn.le(t_out) & turn.lt(F64s::infinity());
        self.packets[number].meet::<I>(found, turn, [word; LANES], self.scenery);
        if leaked.any() {
            self.packets[number].leak(leaked, t_in);
        }
    }

    /// Stretches of some packets with a plain program.
    #[inline(always)]
    fn program(&mut self, words: &[u32], chunk: &Chunk) {
        let (wanted, eye) = (self.scenery.wanted, self.beam.eye);
        let packets = &*self.packets;
        let rays = |slot: usize| packets[chunk.numbers[slot] as usize].rays::<I, O>(eye);
        self.solved.solve(self.scenery.catalog, words, chunk.count, rays);
        for slot in 0..chunk.count {
            let here = Mask::from_bits(chunk.here[slot]);
            let (t_in, t_out) = (F64s::load(&chunk.t_in[slot]), F64s::load(&chunk.t_out[slot]));
            self.scratch.counters.surface_tests += words.len() as u64 * u64::from(here.bits().count_ones());
            let solved = self.solved.packet(words, slot);
            let packet = &mut self.packets[chunk.numbers[slot] as usize];
            // Infinite for rays that are done.
            let mut t = here.select(t_in, F64s::infinity());
            loop {
                t = solved.bound::<I>(t, wanted);
                let pending = t.le(t_out) & t.lt(F64s::infinity());
                if !pending.any() {
                    break;
                }
                let changes = solved.changes::<I>(t);
                let arrived = pending & (changes.after ^ Mask::splat(!wanted));
                let turned = changes.before ^ changes.after;
                packet.meet::<I>(arrived & turned, t, changes.words, self.scenery);
                let leaked = arrived & !turned;
                if leaked.any() {
                    packet.leak(leaked, t_in);
                }
                if arrived.bits() == pending.bits() {
                    break;
                }
                t = arrived.select(F64s::infinity(), t);
            }
        }
    }

    /// A stretch with a program that needs scalar code.
    #[inline(always)]
    fn one_by_one(&mut self, words: &[u32], number: usize, here: Mask<I>, Stretch { t_in, t_out }: Stretch<I>) {
        let (t_in, t_out) = (t_in.stored(), t_out.stored());
        let rays = self.packets[number].rays::<I, O>(self.beam.eye);
        let origin = rays.origin.map(|v| v.lanes().stored());
        let packet = &mut self.packets[number];
        packet.one_by_one(self.scenery, words, here.bits(), (&origin, &t_in, &t_out), self.scratch);
    }

    /// Leaves to scalar code the open rays of those packets that come through a cell.
    #[inline(always)]
    fn give_up_in(&mut self, packets: u32, cube: Cube, depths: (f64, f64)) {
        I::call(GiveUp { walk: self, packets, cube, depths });
        self.close(packets);
    }

    /// The stretches before the octree's root.
    #[inline(always)]
    fn before(&mut self) {
        self.outer(|t_in, _, passes| {
            // Rays that miss the root are followed to the end at once.
            let t_out = passes.select(t_in, F64s::infinity());
            (F64s::zero().lt(t_out), Stretch { t_in: F64s::zero(), t_out })
        });
    }

    /// The stretches behind the octree's root.
    #[inline(always)]
    fn behind(&mut self) {
        self.outer(|_, t_out, passes| (passes, Stretch { t_in: t_out, t_out: F64s::infinity() }));
    }

    /// Stretches outside the octree's root: what `stretch` makes of those inside.
    #[inline(always)]
    fn outer(&mut self, stretch: impl Fn(F64s<I>, F64s<I>, Mask<I>) -> (Mask<I>, Stretch<I>)) {
        let Octree { center, half, .. } = *self.scenery.octree;
        let words = match &self.scenery.program.outer {
            Constant::Everywhere(inside) if *inside == self.scenery.wanted => None,
            Constant::Everywhere(_) => return,
            Constant::Words(words) => Some(&**words).filter(|words| is_short(words) && self.scenery.is_plain(words)),
        };
        let mut chunk = self.chunk.take().unwrap_or_default();
        chunk.count = 0;
        for number in bits_of(self.open) {
            let Stretch { t_in, t_out } = self.stretch(&self.packets[number], center, half);
            let (rays, stretch) = stretch(t_in, t_out, t_in.le(t_out));
            let here = rays & Mask::from_bits(self.packets[number].open);
            match words {
                _ if !here.any() => {}
                Some(words) => {
                    chunk.push(number, here, stretch);
                    if chunk.count == CHUNK {
                        I::call(Outer { walk: self, words, chunk: &chunk });
                        chunk.count = 0;
                    }
                }
                None => self.packets[number].leak(here, stretch.t_in),
            }
        }
        if let Some(words) = words.filter(|_| chunk.count > 0) {
            I::call(Outer { walk: self, words, chunk: &chunk });
        }
        *self.chunk = Some(chunk);
        self.count_open();
    }
}

/// Some packets' stretches.
#[derive(Debug, Default)]
pub(super) struct Chunk {
    count: usize,
    numbers: [u8; CHUNK],
    /// The rays that it is about.
    here: [u8; CHUNK],
    t_in: [Stored; CHUNK],
    t_out: [Stored; CHUNK],
}

impl Chunk {
    #[inline(always)]
    fn push<I: Isa>(&mut self, number: usize, here: Mask<I>, Stretch { t_in, t_out }: Stretch<I>) {
        self.numbers[self.count] = number as u8;
        self.here[self.count] = here.bits();
        self.t_in[self.count] = t_in.stored();
        self.t_out[self.count] = t_out.stored();
        self.count += 1;
    }
}

/// A leaf with one literal, which is plain.
struct Single<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    walk: &'a mut Walk<'b, 'c, I, O>,
    word: u32,
    packets: u32,
    cube: Cube,
    depths: (f64, f64),
}

impl<I: Isa, O: Origins<I>> Kernel for Single<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        for number in bits_of(self.packets) {
            let (here, stretch) = self.walk.crossing(number, self.cube, self.depths);
            if here.any() {
                self.walk.single(self.word, number, here, stretch);
            }
        }
    }
}

/// A leaf with a plain program.
struct Several<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    walk: &'a mut Walk<'b, 'c, I, O>,
    words: &'a [u32],
    packets: u32,
    cube: Cube,
    depths: (f64, f64),
}

impl<I: Isa, O: Origins<I>> Kernel for Several<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        let mut chunk = self.walk.chunk.take().unwrap_or_default();
        chunk.count = 0;
        for number in bits_of(self.packets) {
            let (here, stretch) = self.walk.crossing(number, self.cube, self.depths);
            if here.any() {
                chunk.push(number, here, stretch);
                if chunk.count == CHUNK {
                    self.walk.program(self.words, &chunk);
                    chunk.count = 0;
                }
            }
        }
        if chunk.count > 0 {
            self.walk.program(self.words, &chunk);
        }
        *self.walk.chunk = Some(chunk);
    }
}

/// A leaf with surfaces that lanes cannot cross.
struct OneByOne<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    walk: &'a mut Walk<'b, 'c, I, O>,
    words: &'a [u32],
    packets: u32,
    cube: Cube,
    depths: (f64, f64),
}

impl<I: Isa, O: Origins<I>> Kernel for OneByOne<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        for number in bits_of(self.packets) {
            let (here, stretch) = self.walk.crossing(number, self.cube, self.depths);
            if here.any() {
                self.walk.one_by_one(self.words, number, here, stretch);
            }
        }
    }
}

/// What cannot be: all is inside where rays come from outside.
struct GiveUp<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    walk: &'a mut Walk<'b, 'c, I, O>,
    packets: u32,
    cube: Cube,
    depths: (f64, f64),
}

impl<I: Isa, O: Origins<I>> Kernel for GiveUp<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        for number in bits_of(self.packets) {
            let (here, stretch) = self.walk.crossing(number, self.cube, self.depths);
            self.walk.packets[number].leak(here, stretch.t_in);
        }
    }
}

/// Stretches outside the octree's root, with a plain program.
struct Outer<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    walk: &'a mut Walk<'b, 'c, I, O>,
    words: &'a [u32],
    chunk: &'a Chunk,
}

impl<I: Isa, O: Origins<I>> Kernel for Outer<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        self.walk.program(self.words, self.chunk);
    }
}

/// The places of the bits that are set, from the lowest on.
#[inline(always)]
fn bits_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = bits.trailing_zeros();
        bits &= bits.wrapping_sub(1);
        (lowest < u32::BITS).then_some(lowest as usize)
    })
}

/// All packets of some parts.
#[inline(always)]
fn packets_of(parts: u8) -> u32 {
    let mut packets = 0;
    for (part, part_packets) in PART_PACKETS.iter().enumerate() {
        packets |= if parts >> part & 1 != 0 { *part_packets } else { 0 };
    }
    packets
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
