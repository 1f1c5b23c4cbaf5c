//! Copies of a solid that is stored once: the walk goes on in the solid's own octree, in the solid's own coordinates.
//!
//! A copy's box keeps clear of everything else. So what a ray meets from where it enters that box to where it leaves it, it
//! meets in the copy: each ray goes through all of the copy at once, in the cell in which it enters the box. All others wait
//! aside meanwhile.

use super::kernels::{Cube, bits_of};
use super::lanes::{Isa, Kernel, Mask};
use super::packet::Origins;
use super::walk::{Scenery, Waiting, Walk};
use crate::geom::{Bounds, Vec3};
use crate::octree::CellWord;
use crate::surface::Placed;

/// A visit to a copy.
#[derive(Clone, Copy)]
pub(super) struct Visit<'a> {
    /// So many cells wait elsewhere.
    bottom: usize,
    /// The packets that it is about.
    packets: u32,
    /// What the walk comes back to.
    elsewhere: Scenery<'a>,
}

impl<'a, I: Isa, O: Origins<I>> Walk<'a, '_, I, O> {
    /// Whether there is a next one among the `count` cells that wait. Where there is none in a copy, the visit ends.
    #[inline(always)]
    pub(super) fn goes_on(&mut self, count: &mut usize, visit: &mut Option<Visit<'a>>) -> bool {
        loop {
            let bottom = visit.as_ref().map_or(0, |visit| visit.bottom);
            if *count > bottom && self.open != 0 {
                return true;
            }
            let Some(over) = visit.take() else { return false };
            *count = over.bottom;
            self.scenery = over.elsewhere;
            self.bring_back(over.packets);
        }
    }

    /// The copy that is all of a leaf.
    #[inline(always)]
    pub(super) fn copy_in(&self, words: &[u32]) -> Option<&'a Placed> {
        let Scenery { catalog, prototypes, .. } = self.scenery;
        match words {
            [word] if !prototypes.is_empty() => catalog.placed_by(*word),
            _ => None,
        }
    }

    /// The packets that may reach a copy.
    #[inline(always)]
    pub(super) fn reach_copy(&self, placed: &Placed) -> u32 {
        let Bounds { min, max } = placed.bounds;
        let half = (max - min).max_abs() * 0.5 + self.scenery.octree.margin;
        self.beam.reached::<I>((min + max) * 0.5, half).packets
    }

    /// Begins a visit to the copy that is all of a leaf, for those packets' rays that enter its box there.
    pub(super) fn visit(
        &mut self,
        placed: &'a Placed,
        packets: u32,
        cube: Cube,
        waiting: &mut [Waiting; Waiting::MOST],
        count: &mut usize,
        visit: &mut Option<Visit<'a>>,
    ) {
        let prototype = &self.scenery.prototypes[placed.prototype as usize];
        let Some(octree) = prototype.octree() else {
            self.give_up_in(packets, cube, (0.0, f64::INFINITY));
            return;
        };
        let void = if self.scenery.wanted { CellWord::OUTSIDE } else { CellWord::INSIDE };
        if octree.root == void {
            return;
        }
        I::call(SetAside { walk: self, placed, packets, cube });
        if self.open == 0 {
            self.bring_back(packets);
            return;
        }
        *visit = Some(Visit { bottom: *count, packets, elsewhere: self.scenery });
        let literal_shift = self.scenery.catalog.prototype(placed).literal_shift(placed.copy);
        self.scenery = Scenery {
            program: &prototype.program,
            octree,
            prototypes: &[],
            offset: placed.offset,
            literal_shift,
            ..self.scenery
        };
        waiting[*count] = Waiting::root(octree);
        *count += 1;
    }

    /// Rays that were set aside go on.
    fn bring_back(&mut self, packets: u32) {
        for number in bits_of(packets) {
            let packet = &mut self.packets[number];
            packet.open |= packet.aside;
        }
        self.count_open();
    }
}

/// Opens nothing but those rays of some packets that enter the box of a copy in that cell.
struct SetAside<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    walk: &'a mut Walk<'b, 'c, I, O>,
    placed: &'a Placed,
    packets: u32,
    cube: Cube,
}

impl<I: Isa, O: Origins<I>> Kernel for SetAside<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        let Self { walk, placed, packets, cube } = self;
        let half = Vec3::splat(cube.half);
        let Bounds { min, max } = placed.bounds;
        let has_mixed_leaves = walk.scenery.octree.has_mixed_leaves;
        walk.open = 0;
        for number in bits_of(packets) {
            let packet = &walk.packets[number];
            let here = walk.stretch(packet, (cube.center - half, cube.center + half));
            let there = walk.stretch(packet, (min, max));
            // Where a leaf may hold a part of the copy beside something else, rays may come from there, half through.
            let since = if has_mixed_leaves { there.t_out } else { there.t_in };
            let enters =
                here.t_in.le(here.t_out) & there.t_in.le(there.t_out) & there.t_in.le(here.t_out) & here.t_in.le(since);
            let here = (Mask::<I>::from_bits(packet.open) & enters).bits();
            let packet = &mut walk.packets[number];
            packet.aside = packet.open & !here;
            packet.open = here;
            walk.open |= u32::from(here != 0) << number;
        }
    }
}
