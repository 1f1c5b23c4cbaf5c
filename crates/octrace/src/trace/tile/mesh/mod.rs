//! Meshes: where eight rays come into one and out of it, found together. Tori too, which lines cross up to four times.
//!
//! For a ray that starts outside a mesh's box the first crossing is enough, as long as nothing more is asked. Else all
//! crossings ahead are found: how often they go in and out tells where the ray starts, since at last it is outside. What is
//! found of a packet is kept until other rays are traced, for a mesh reaches through many cells. It is what
//! [`Mesh::toggles`] finds for each ray by itself, to the bit; rays for which that is not certain are for scalar code.

mod all;
mod cells;
mod first;
mod search;
mod tori;
mod triangle;

pub(super) use cells::Toggled;

use super::PACKETS;
use super::crossing::{Crossed, Rays};
use super::lanes::{F64s, Isa, Kernel, LANES, Mask, Number, Stored};
use super::packet::Packet;
use crate::compile::{Catalog, Word};
use crate::geom::Hit;
use crate::primitive::{Facet, Mesh, SurfaceRef};
use crate::surface::Surface;
use crate::trace::roots::Roots;
use all::All;
use first::First;
use search::{search, start_outside};
use triangle::Lines;

/// So many toggles of each line are kept.
const KEPT: usize = 4;

/// So many meshes and tori are known of a packet at once.
pub(super) const MESHES: usize = 4;

/// Which mesh or torus: the number of its surface, and what is added to literals where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Key {
    pub surface: u32,
    pub literal_shift: u32,
}

/// Where eight lines change between outside and inside of a mesh or a torus, at least ahead of their starts.
#[derive(Clone, Debug)]
pub(super) struct Toggles {
    key: Key,
    /// The lanes that are known.
    lanes: u8,
    /// Those that start inside.
    starts_inside: u8,
    /// Those that scalar code has to look at.
    odd: u8,
    /// Ascending, behind the last one infinite.
    t: [Stored; KEPT],
    facets: [[u32; LANES]; KEPT],
    /// Up to here, and here included, none is missing.
    until: Stored,
    /// Whether the first toggle was enough for lines that start outside.
    only_first: bool,
}

impl Toggles {
    const NOTHING: Self = Self {
        key: Key { surface: u32::MAX, literal_shift: u32::MAX },
        lanes: 0,
        starts_inside: 0,
        odd: 0,
        t: [Stored([f64::INFINITY; LANES]); KEPT],
        facets: [[0; LANES]; KEPT],
        until: Stored([0.0; LANES]),
        only_first: false,
    };

    /// A line of which nothing is known so far but where it starts.
    fn begin(&mut self, lane: usize, starts_inside: bool, until: f64) {
        for t in &mut self.t {
            t.0[lane] = f64::INFINITY;
        }
        self.starts_inside = self.starts_inside & !(1 << lane) | u8::from(starts_inside) << lane;
        self.until.0[lane] = until;
    }

    /// Adds a toggle if there is room.
    fn push(&mut self, lane: usize, count: usize, t: f64, facet: Facet) -> bool {
        if count == KEPT {
            self.until.0[lane] = self.t[KEPT - 1].0[lane];
            return false;
        }
        self.t[count].0[lane] = t;
        self.facets[count][lane] = facet.0;
        true
    }

    /// The two toggles from `t` on, and the third.
    #[inline(always)]
    fn from<I: Isa>(&self, t: F64s<I>) -> (Crossed<I>, F64s<I>) {
        let (mut a, mut b, mut c) = (F64s::infinity(), F64s::infinity(), F64s::infinity());
        let mut starts_inside = Mask::from_bits(self.starts_inside);
        for toggle in self.t.iter().rev() {
            let toggle = F64s::load(toggle);
            let ahead = toggle.ge(t);
            (c, b) = (ahead.select(b, c), ahead.select(a, b));
            a = ahead.select(toggle, a);
            starts_inside = starts_inside ^ !ahead;
        }
        (Crossed { starts_inside, a, b }, c)
    }

    /// Tells of the mesh, if enough is known for parameters up to `end`.
    pub fn tell(&self, literal_shift: u32, lane: usize, end: f64, roots: &mut Roots) {
        let is_known = self.lanes & !self.odd & 1 << lane != 0 && self.key.literal_shift == literal_shift;
        if is_known && self.until.0[lane] >= end {
            let toggles = self.t.iter().map(|t| t.0[lane]).filter(|t| t.is_finite());
            roots.know(self.key.surface, self.starts_inside >> lane & 1 != 0, toggles);
        }
    }

    /// The facet at a toggle.
    fn facet_at(&self, lane: usize, t: f64) -> Option<u32> {
        (0..KEPT).find(|&i| self.t[i].0[lane] == t).map(|i| self.facets[i][lane])
    }
}

/// The hit of a mesh at a face that is known; `None` where it is not, or where the literal is no mesh's. As
/// [`hit_of`](crate::trace::roots::hit_of).
pub(super) fn hit_of_facet(catalog: &Catalog, word: u32, facet: u32, t: f64, entering: bool) -> Option<Hit> {
    let Word::Literal { index, negated } = Word::decode(word) else { return None };
    let literal = catalog.literal(index);
    if facet == Packet::UNKNOWN || !matches!(literal.surface, Surface::Mesh(_)) {
        return None;
    }
    let SurfaceRef { surface, flipped } = Facet(facet).surface();
    let surface = surface + literal.surface_shift;
    Some(Hit { t, leaf: literal.leaf, surface, entering, flipped: negated != flipped })
}

/// The surface of a face that is known.
pub(super) fn face_of(catalog: &Catalog, facet: u32) -> Option<&Surface> {
    catalog.surfaces.get(Facet(facet).surface().surface as usize)
}

/// What is known of the packets of a tile.
#[derive(Debug)]
pub(super) struct MeshMemo {
    known: Box<[[Toggles; MESHES]; PACKETS]>,
    /// Which is the next to be forgotten, by packet.
    next: [u8; PACKETS],
    all: Box<All>,
}

impl Default for MeshMemo {
    fn default() -> Self {
        let known = vec![[Toggles::NOTHING; MESHES]; PACKETS].into_boxed_slice();
        let known = known.try_into().unwrap_or_else(|_| unreachable!("as many as there are packets"));
        Self { known, next: [0; PACKETS], all: Box::default() }
    }
}

impl MeshMemo {
    /// There are other rays now.
    pub fn forget(&mut self) {
        for known in self.known.iter_mut().flatten() {
            known.lanes = 0;
        }
    }

    /// What is known of a packet.
    pub fn of(&self, number: usize) -> &[Toggles] {
        &self.known[number]
    }

    /// What is known of a packet and a surface.
    fn find(&self, number: usize, key: Key) -> Option<usize> {
        self.known[number].iter().position(|known| known.key == key && known.lanes != 0)
    }

    /// The facet at which a ray comes into a mesh or out of it.
    fn facet(&self, number: usize, key: Key, lane: usize, t: f64) -> Option<u32> {
        let known = &self.known[number][self.find(number, key)?];
        if known.lanes >> lane & 1 != 0 { known.facet_at(lane, t) } else { None }
    }

    /// Where to put what is found of a packet and a surface.
    fn place(&mut self, number: usize, key: Key) -> usize {
        self.find(number, key).unwrap_or_else(|| {
            let next = &mut self.next[number];
            *next = (*next + 1) % MESHES as u8;
            let place = *next as usize;
            (self.known[number][place].key, self.known[number][place].lanes) = (key, 0);
            place
        })
    }
}

/// Finds the toggles of a packet's rays with a mesh.
struct Learn<'a, I: Isa, N: Number<I>> {
    mesh: &'a Mesh,
    rays: Rays<I, N>,
    /// Rays that matter.
    lanes: u8,
    /// Nothing matters beyond.
    end: F64s<I>,
    /// Whether the first toggle is enough.
    only_first: bool,
    all: &'a mut All,
    toggles: &'a mut Toggles,
}

impl<I: Isa, N: Number<I>> Kernel for Learn<'_, I, N> {
    #[inline(always)]
    fn run(self) {
        let Self { mesh, rays, lanes, end, only_first, all, toggles } = self;
        let o = rays.origin.map(Number::lanes);
        let far = !o.max_abs().le(F64s::splat(mesh.reach()));
        (toggles.lanes, toggles.odd) = (lanes, far.bits() & lanes);
        let mut left = lanes & !toggles.odd;
        while left != 0 {
            let mut lines = Lines::of(rays, left);
            left &= !lines.lanes.bits();
            let outside = start_outside(mesh, &lines);
            let inside = lines.lanes & !outside;
            let first = if only_first { lines.lanes & outside } else { Mask::splat(false) };
            let rest = lines.lanes & !first;
            if first.any() {
                lines.lanes = first;
                let mut found = First::up_to(end);
                search(mesh, &lines, &mut found);
                take_first(mesh, &found, first.bits(), toggles);
            }
            if rest.any() {
                lines.lanes = rest;
                all.begin(inside.select(F64s::infinity(), end).stored());
                search(mesh, &lines, all);
                all.toggles(mesh, rest.bits(), outside.bits(), toggles);
                toggles.odd |= all.overflowed;
            }
        }
    }
}

/// Takes over the first crossings of lines that start outside.
#[inline(always)]
fn take_first<I: Isa>(mesh: &Mesh, found: &First<I>, lanes: u8, toggles: &mut Toggles) {
    let lanes = Mask::<I>::from_bits(lanes);
    let enters = lanes & found.found & found.winding.gt(F64s::zero());
    // First out and then in is a matter of rounding, or of a mesh that is turned about.
    toggles.odd |= (lanes & found.found & !enters).bits();
    toggles.starts_inside &= !lanes.bits();
    toggles.until = lanes.select(found.t, F64s::load(&toggles.until)).stored();
    let first = enters.select(found.t, F64s::infinity());
    toggles.t[0] = lanes.select(first, F64s::load(&toggles.t[0])).stored();
    for t in &mut toggles.t[1..] {
        *t = lanes.select(F64s::infinity(), F64s::load(t)).stored();
    }
    let mut left = enters.bits();
    while left != 0 {
        let lane = left.trailing_zeros() as usize & (LANES - 1);
        left &= left - 1;
        toggles.facets[0][lane] = mesh.facet(found.triangles[lane]).0;
    }
}
