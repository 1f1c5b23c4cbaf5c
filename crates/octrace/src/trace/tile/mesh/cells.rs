//! Cells with meshes and tori in them, and else planes and quadrics.

use super::tori::LearnTorus;
use super::{Key, Learn, MESHES};
use crate::compile::{Catalog, Word};
use crate::primitive::Mesh;
use crate::surface::{Surface, Torus};
use crate::trace::tile::kernels::{Cube, Stretch, bits_of};
use crate::trace::tile::lanes::{F64s, Isa, Kernel, LANES, Mask};
use crate::trace::tile::packet::{Origins, Packet};
use crate::trace::tile::program::Solving;
use crate::trace::tile::walk::{Scenery, Walk};

/// A leaf whose surfaces are meshes, tori, planes and quadrics.
pub(in super::super) struct Toggled<'a, 'b, 'c, I: Isa, O: Origins<I>> {
    pub walk: &'a mut Walk<'b, 'c, I, O>,
    pub words: &'a [u32],
    pub packets: u32,
    pub cube: Cube,
    pub depths: (f64, f64),
}

impl<I: Isa, O: Origins<I>> Kernel for Toggled<'_, '_, '_, I, O> {
    #[inline(always)]
    fn run(self) {
        let Self { walk, words, packets, cube, depths } = self;
        let several = words.iter().filter(|&&word| folded(walk.scenery.catalog, word).is_some()).count() > MESHES;
        for number in bits_of(packets) {
            let (here, stretch) = walk.crossing(number, cube, depths);
            if !here.any() {
                continue;
            }
            let before = F64s::<I>::load(&walk.packets[number].t);
            match *words {
                _ if several => walk.by_scalar_code(words, number, here, stretch),
                [word] => walk.lone_toggled(word, number, here, stretch),
                _ => walk.with_toggled(words, number, here, stretch),
            }
            walk.note_facets(number, before);
        }
    }
}

/// A surface that lines may cross more than twice.
#[derive(Clone, Copy)]
enum Folded<'a> {
    Mesh(&'a Mesh),
    Torus(&'a Torus),
}

/// The mesh or the torus that a literal is of, and the number of its surface.
#[inline(always)]
fn folded(catalog: &Catalog, word: u32) -> Option<(Folded<'_>, u32)> {
    let Word::Literal { index, .. } = Word::decode(word) else { return None };
    let surface = catalog.literals.get(index as usize)?.surface;
    match &catalog.surfaces[surface as usize] {
        Surface::Mesh(mesh) => Some((Folded::Mesh(mesh), surface)),
        Surface::Torus(torus) => Some((Folded::Torus(torus), surface)),
        Surface::Plane(_) | Surface::Quadric(_) | Surface::Placed(_) => None,
    }
}

/// The mesh that a literal is of, and the number of its surface.
#[inline(always)]
fn mesh_of(catalog: &Catalog, word: u32) -> Option<(&Mesh, u32)> {
    match folded(catalog, word) {
        Some((Folded::Mesh(mesh), surface)) => Some((mesh, surface)),
        _ => None,
    }
}

impl<I: Isa, O: Origins<I>> Walk<'_, '_, I, O> {
    /// Notes the faces of meshes that rays of a packet met since they had met things at `before`.
    #[inline(always)]
    fn note_facets(&mut self, number: usize, before: F64s<I>) {
        let Scenery { catalog, literal_shift, .. } = self.scenery;
        let packet = &mut self.packets[number];
        let mut left = F64s::load(&packet.t).lt(before).bits();
        while left != 0 {
            let lane = left.trailing_zeros() as usize & (LANES - 1);
            left &= left - 1;
            let Some((_, surface)) = mesh_of(catalog, packet.words[lane].wrapping_sub(literal_shift)) else { continue };
            let facet = self.meshes.facet(number, Key { surface, literal_shift }, lane, packet.t.0[lane]);
            packet.facets[lane] = facet.unwrap_or(Packet::UNKNOWN);
        }
    }

    /// A stretch with a program that needs scalar code; how the rays come into meshes is found out in lanes.
    #[inline(always)]
    pub(in super::super) fn by_scalar_code(
        &mut self,
        words: &[u32],
        number: usize,
        here: Mask<I>,
        stretch: Stretch<I>,
    ) {
        let before = F64s::<I>::load(&self.packets[number].t);
        let catalog = self.scenery.catalog;
        let mut some = false;
        for &word in words.iter().filter(|&&word| mesh_of(catalog, word).is_some()).take(MESHES) {
            self.learn(word, number, here.bits(), false);
            some = true;
        }
        self.one_by_one(words, number, here, stretch);
        if some {
            self.note_facets(number, before);
        }
    }

    /// Has the toggles of some of a packet's rays found; says where they are kept.
    #[inline(always)]
    fn learn(&mut self, word: u32, number: usize, lanes: u8, only_first: bool) -> usize {
        let catalog = self.scenery.catalog;
        let Some((folded, surface)) = folded(catalog, word) else { return 0 };
        let key = Key { surface, literal_shift: self.scenery.literal_shift };
        let place = self.meshes.place(number, key);
        let toggles = &mut self.meshes.known[number][place];
        if lanes & !toggles.lanes == 0 && (only_first || !toggles.only_first) {
            return place;
        }
        let packet = &self.packets[number];
        let rays = packet.rays::<I, O>(self.beam.eye, self.scenery.offset);
        let end = F64s::load(&packet.t);
        let lanes = lanes | packet.open;
        let all = &mut *self.meshes.all;
        toggles.only_first = only_first;
        match folded {
            Folded::Mesh(mesh) => I::call(Learn { mesh, rays, lanes, end, only_first, all, toggles }),
            Folded::Torus(torus) => I::call(LearnTorus { torus, rays, lanes, only_first, toggles }),
        }
        place
    }

    /// A stretch with a mesh or a torus and nothing else.
    #[inline(always)]
    fn lone_toggled(&mut self, word: u32, number: usize, here: Mask<I>, stretch: Stretch<I>) {
        let Stretch { t_in, t_out } = stretch;
        let negated = matches!(Word::decode(word), Word::Literal { negated: true, .. });
        let mut only_first = true;
        let (crossed, odd) = loop {
            let place = self.learn(word, number, here.bits(), only_first);
            let toggles = &self.meshes.known[number][place];
            let (crossed, _) = toggles.from::<I>(t_in);
            // What comes first is all that matters, if it does not come at once.
            let enough = F64s::load(&toggles.until).ge(t_out) | crossed.a.gt(t_in) & crossed.a.is_finite();
            let odd = here & (Mask::from_bits(toggles.odd) | !enough);
            if !odd.any() || !toggles.only_first {
                break (crossed, odd);
            }
            only_first = false;
        };
        if odd.any() {
            self.one_by_one(&[word], number, odd, Stretch { t_in, t_out });
        }
        self.single_crossed(word, crossed.negated(negated), number, here & !odd, Stretch { t_in, t_out });
    }

    /// A stretch with meshes, tori and other surfaces.
    #[inline(always)]
    fn with_toggled(&mut self, words: &[u32], number: usize, here: Mask<I>, stretch: Stretch<I>) {
        let Stretch { mut t_in, t_out } = stretch;
        let catalog = self.scenery.catalog;
        for &word in words {
            if folded(catalog, word).is_some() {
                self.learn(word, number, here.bits(), false);
            }
        }
        let numbers = [number as u8];
        let solving =
            Solving { packets: self.packets, numbers: &numbers, eye: self.beam.eye, offset: self.scenery.offset };
        self.solved.solve::<I, O>(catalog, words, &solving);
        let mut left = here;
        while left.any() {
            // Two toggles of each mesh are looked at together, and then the next.
            let (mut end, mut odd) = (t_out, Mask::splat(false));
            for (at, &word) in words.iter().enumerate() {
                let Some((_, surface)) = folded(catalog, word) else { continue };
                let key = Key { surface, literal_shift: self.scenery.literal_shift };
                let Some(place) = self.meshes.find(number, key) else {
                    odd = Mask::splat(true);
                    break;
                };
                let toggles = &self.meshes.known[number][place];
                let (crossed, third) = toggles.from::<I>(t_in);
                let until = F64s::load(&toggles.until);
                odd = odd | Mask::from_bits(toggles.odd) | until.lt(t_in);
                end = end.min(third.next_down()).min(until);
                let negated = matches!(Word::decode(word), Word::Literal { negated: true, .. });
                self.solved.put(at, crossed.negated(negated));
            }
            let odd = odd & left;
            if odd.any() {
                self.one_by_one(words, number, odd, Stretch { t_in, t_out });
                left = left & !odd;
            }
            self.solved_program(words, (0, number), left, Stretch { t_in, t_out: end });
            left = left & Mask::from_bits(self.packets[number].open) & end.lt(t_out);
            t_in = left.select(end.next_up(), t_in);
        }
    }
}
