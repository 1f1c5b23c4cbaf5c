//! What is drawn beside the object: subtrees marked `%` or `#`, on request.

use super::operand::Operand;
use super::perform::plate;
use octrace::{Affine, Material, Rgb, Solid};
use octrace_forms::Tolerance;

/// Where a node's result goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Aside {
    /// To its parent.
    #[default]
    No,
    /// Among the ghosts only.
    Ghost,
    /// To its parent, and among the highlights.
    Highlight,
}

/// What is drawn beside the object, in the scene's coordinates.
#[derive(Debug, Default)]
pub(super) struct Asides {
    ghosts: Vec<Solid>,
    highlights: Vec<Solid>,
}

impl Asides {
    /// Keeps what is to be drawn beside the object; `map` is from its parent to the scene. What is flat becomes a plate.
    pub fn take(&mut self, aside: Aside, operand: &Operand, map: &Affine, tolerance: Tolerance) {
        let list = match aside {
            Aside::No => return,
            Aside::Ghost => &mut self.ghosts,
            Aside::Highlight => &mut self.highlights,
        };
        match operand {
            Operand::Solid(made) => list.push(made.solid.unpainted().transform(*map)),
            Operand::Flat(flat) => list.extend(plate(flat, tolerance).map(|plate| plate.transform(*map))),
            Operand::Corners(_) | Operand::Empty | Operand::LeftOut => {}
        }
    }

    /// Ghosts and highlights, each in one solid, with what they are made of; those that there are.
    pub fn finish(self) -> impl Iterator<Item = (Solid, Material)> {
        let made_of = |rgb, kt| Material { kt, tint: 0.0, kr: 0.0, ..Material::matte(Rgb::from_srgb(rgb)) };
        let ghost = (self.ghosts, made_of([0.55, 0.55, 0.55], 0.7));
        let highlight = (self.highlights, made_of([1.0, 0.32, 0.32], 0.5));
        let all = [ghost, highlight].into_iter().filter(|(solids, _)| !solids.is_empty());
        all.map(|(solids, material)| (Solid::union(solids), material))
    }
}
