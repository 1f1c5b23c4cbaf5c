//! The materials of a scene, as rays by eights need them.

use crate::model::{Material, PartId, Rgb, Scene};
use crate::trace::lanes::{F64s, Isa, LANES, Stored};
use crate::trace::{EightHits, Tracer};

/// Those of the scene's parts, and in the end that of parts without one; and numbers of each.
#[derive(Debug)]
pub(super) struct Materials {
    list: Vec<Material>,
    /// What each sends to the viewer by ambient light: red, green, blue.
    pub ambients: Vec<[f64; 3]>,
    /// Body colour, `Kd`, `Ks` and exponent.
    pub coats: Vec<[f64; 6]>,
    /// What share of light it lets pass.
    pub transmissions: Vec<[f64; 3]>,
    /// `Kr` and `Kt`.
    pub branchings: Vec<[f64; 2]>,
    /// Whether light goes on from any, and whether it passes any.
    pub go_on: bool,
    pub transparent: bool,
}

impl Materials {
    pub fn new(scene: &Scene, ambient: Rgb) -> Self {
        let mut list: Vec<Material> = scene.parts.iter().map(|part| part.material).collect();
        list.push(scene.material(None));
        let coat =
            |&Material { color: Rgb { r, g, b }, kd, ks, shininess, .. }: &Material| [r, g, b, kd, ks, shininess];
        Self {
            ambients: list.iter().map(|material| components(ambient_of(material, ambient))).collect(),
            coats: list.iter().map(coat).collect(),
            transmissions: list.iter().map(|material| components(material.transmission())).collect(),
            branchings: list.iter().map(|material| [material.kr, material.kt]).collect(),
            go_on: list.iter().any(|material| material.kr > 0.0 || material.is_transparent()),
            transparent: list.iter().any(Material::is_transparent),
            list,
        }
    }

    /// As [`Scene::material`].
    pub fn of(&self, part: Option<PartId>) -> &Material {
        self.numbered(self.number(part))
    }

    pub fn numbered(&self, number: u32) -> &Material {
        &self.list[number as usize]
    }

    fn number(&self, part: Option<PartId>) -> u32 {
        let none = self.list.len() as u32 - 1;
        part.map_or(none, |PartId(index)| index.min(none))
    }
}

/// What a material sends to the viewer by ambient light.
pub(super) fn ambient_of(material: &Material, ambient: Rgb) -> Rgb {
    material.color * ambient * material.ka
}

fn components(Rgb { r, g, b }: Rgb) -> [f64; 3] {
    [r, g, b]
}

/// The materials of what eight rays meet.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EightMaterials {
    /// Their numbers; that of some other ray where nothing is met.
    pub numbers: [u32; LANES],
    /// Whether all are the same.
    alike: bool,
}

impl EightMaterials {
    /// The materials of the leaves that were hit.
    pub fn of(hits: &EightHits, materials: &Materials, tracer: &Tracer) -> Self {
        if materials.list.len() == 1 {
            return Self { numbers: [0; LANES], alike: true };
        }
        let number = |leaf: u32| materials.number(tracer.catalog().leaves[leaf as usize].part);
        let first = hits.met.trailing_zeros() as usize & (LANES - 1);
        let mut found = Self { numbers: [number(hits.leaves[first]); LANES], alike: true };
        for lane in (first + 1..LANES).filter(|lane| hits.met >> lane & 1 != 0) {
            if hits.leaves[lane] != hits.leaves[first] {
                found.numbers[lane] = number(hits.leaves[lane]);
                found.alike &= found.numbers[lane] == found.numbers[first];
            }
        }
        found
    }

    /// Their numbers in a list that has some for each material.
    #[inline(always)]
    pub fn pick<I: Isa, const N: usize>(&self, list: &[[f64; N]]) -> [F64s<I>; N] {
        let mut picked = [F64s::zero(); N];
        if self.alike {
            for (picked, &number) in picked.iter_mut().zip(&list[self.numbers[0] as usize]) {
                *picked = F64s::splat(number);
            }
            return picked;
        }
        let mut stored = [Stored::default(); N];
        for (lane, &material) in self.numbers.iter().enumerate() {
            for (stored, &number) in stored.iter_mut().zip(&list[material as usize]) {
                stored.0[lane] = number;
            }
        }
        for (picked, stored) in picked.iter_mut().zip(&stored) {
            *picked = F64s::load(stored);
        }
        picked
    }
}
