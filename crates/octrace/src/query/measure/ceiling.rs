//! How far a program's inside can reach in a box: by linear programs.
//!
//! Each surface keeps its side within a half-space ([`Surface::half_space_in`](crate::surface::Surface)); what is in all of
//! them is bounded by a linear program, and of a union the highest operand counts. So a ridge or a tip is known to be where it
//! is, though boxes on it are on both sides of all its faces, however small.

use crate::compile::{Catalog, Word, node_end};
use crate::geom::Vec3;
use crate::num::{HalfSpace, farthest};
use crate::surface::CellBox;

/// Longer programs are not looked at: they get shorter as boxes get smaller.
const MOST_WORDS: usize = 256;
/// So many linear programs may be solved for a box; beyond, unions are passed over.
const MOST_PROGRAMS: u32 = 64;

/// The place of the box that may be inside the program and is farthest along `up`, an axis or against one; `None` where
/// there is no such place. Nothing of the inside is farther.
pub(super) fn ceiling(catalog: &Catalog, words: &[u32], cell: &CellBox, up: Vec3) -> Option<Vec3> {
    let mut search =
        Search { catalog, words, cell, up, halves: Vec::new(), programs_left: MOST_PROGRAMS, highest: None };
    if words.len() > MOST_WORDS {
        search.solve();
    } else {
        search.all_of(&[0], &[]);
    }
    search.highest.map(|(_, delta)| cell.center + delta)
}

struct Search<'a> {
    catalog: &'a Catalog,
    words: &'a [u32],
    cell: &'a CellBox,
    up: Vec3,
    /// What holds all that is looked at.
    halves: Vec<HalfSpace>,
    programs_left: u32,
    /// The farthest place so far, as a height and from the box's middle.
    highest: Option<(f64, Vec3)>,
}

impl Search<'_> {
    /// Looks at what is in all of some nodes, and of some unions.
    fn all_of(&mut self, nodes: &[usize], unions: &[usize]) {
        let known = self.halves.len();
        let (mut nodes, mut unions) = (nodes.to_vec(), unions.to_vec());
        while let Some(at) = nodes.pop() {
            match Word::decode(self.words[at]) {
                Word::Literal { index, negated } => {
                    let literal = self.catalog.literal(index);
                    let cell = CellBox { center: self.cell.center - literal.offset, ..*self.cell };
                    self.halves.extend(literal.surface.half_space_in(&cell, negated));
                }
                Word::And { .. } => nodes.extend(self.children(at)),
                Word::Or { .. } => unions.push(at),
            }
        }
        match unions.pop() {
            Some(union) if self.programs_left > 0 => {
                for child in self.children(union) {
                    self.all_of(&[child], &unions);
                }
            }
            _ => self.solve(),
        }
        self.halves.truncate(known);
    }

    fn children(&self, at: usize) -> Vec<usize> {
        let end = node_end(self.words, at);
        let next = |&child: &usize| Some(node_end(self.words, child)).filter(|&next| next < end);
        std::iter::successors(Some(at + 1), next).collect()
    }

    fn solve(&mut self) {
        self.programs_left = self.programs_left.saturating_sub(1);
        let half = self.cell.half;
        let room = ((-half).to_array(), half.to_array());
        let Some(found) = farthest(self.up.to_array(), room, &self.halves) else { return };
        let delta = Vec3::from(found);
        let height = self.up.dot(delta);
        if self.highest.is_none_or(|(highest, _)| height > highest) {
            self.highest = Some((height, delta));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile::{Constant, Copies, compile};
    use crate::model::Solid;

    /// The greatest height in a box about the origin.
    fn highest(solid: Solid, half: f64) -> Option<f64> {
        let compiled = compile(&[solid], 0.0, Copies::Apart);
        let Constant::Words(words) = &compiled.bodies[0].whole else { panic!("a solid") };
        let cell = CellBox::new(Vec3::ZERO, Vec3::splat(half));
        ceiling(&compiled.catalog, words, &cell, Vec3::Z).map(|p| p.z)
    }

    #[test]
    fn ridges_tips_and_grooves_are_as_high_as_they_are() {
        let block = || Solid::block().translate([-0.5, -0.5, -0.5]);
        let ridge = || block().rotate([45.0, 0.0, 0.0]).rotate([0.0, 0.0, 30.0]);
        let top = 0.5_f64.sqrt();
        for (solid, height) in [(ridge(), top), (block().rotate([45.0, 35.264389682754654, 0.0]), 0.75_f64.sqrt())] {
            let found = highest(solid, 2.0).expect("it is there");
            assert!((found - height).abs() < 1e-12, "{found}");
        }
        // A block with a groove is as high as its shoulders, up to where the box around it ends.
        let grooved = block() - ridge().translate([0.0, 0.0, 0.5]);
        assert!((highest(grooved, 0.5).expect("it is there") - 0.5).abs() < 1e-12);
        assert_eq!(highest(ridge().translate([0.0, 0.0, -1.0]), 0.25), None);
    }
}
