//! Solids that are stored once and stand in many places, and the numbers that go with them.
//!
//! A prototype's surfaces and literals are in the catalogue once, in coordinates of its own. Its copies have numbers too, of
//! which nothing is stored: beyond those of the catalogue, copy after copy. So whoever has such a number can find out what is
//! meant, and hits look as if every copy had surfaces of its own.

use super::{Catalog, Program, Word};
use crate::geom::{Hit, Ray, Vec3};
use crate::surface::{Placed, Surface};

/// A solid that stands in many places.
#[derive(Clone, Debug)]
pub struct Prototype {
    /// Its program, in its own coordinates. It is bounded.
    pub program: Program,
    /// The numbers of its literals.
    pub(super) literals: Numbers,
    /// The numbers of its surfaces.
    pub(super) surfaces: Numbers,
    /// How many leaves it has.
    pub leaves: u32,
    /// The first copy's first leaf: to this copy the leaves of the literals belong.
    pub(super) first_leaf: u32,
    /// The surface that is the first copy; the others follow.
    pub(super) first_placed: u32,
    /// How many copies there are.
    pub copies: u32,
}

/// A row of things in the catalogue, and their copies beyond it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Numbers {
    pub first: u32,
    pub count: u32,
    /// The number that the first copy's first thing has.
    pub copies_from: u32,
}

impl Numbers {
    /// What a copy's numbers exceed the stored ones by.
    fn shift(&self, copy: u32) -> u32 {
        self.copies_from - self.first + copy * self.count
    }

    /// The copy that a number beyond the catalogue belongs to, and the number that is stored.
    fn find(&self, number: u32) -> Option<(u32, u32)> {
        let beyond = number.checked_sub(self.copies_from)?;
        Some((beyond / self.count, self.first + beyond % self.count))
    }
}

impl Prototype {
    /// How many literals it has.
    pub fn literals(&self) -> usize {
        self.literals.count as usize
    }

    /// The surfaces that it is made of.
    pub fn surfaces<'a>(&self, catalog: &'a Catalog) -> &'a [Surface] {
        let first = self.surfaces.first as usize;
        &catalog.surfaces[first..first + self.surfaces.count as usize]
    }

    /// What is added to the literals of the program, in order to mean those of a copy.
    pub(crate) fn literal_shift(&self, copy: u32) -> u32 {
        self.literals.shift(copy)
    }
}

/// A use of a surface, or of a copy of one.
#[derive(Clone, Copy, Debug)]
pub struct Use<'a> {
    /// The surface as it is stored.
    pub surface: &'a Surface,
    /// Index of that in [`Catalog::surfaces`].
    pub stored: u32,
    /// What is added to the numbers of stored surfaces, in order to mean those of the copy.
    pub surface_shift: u32,
    /// Index into [`Catalog::leaves`].
    pub leaf: u32,
    /// Where the origin of the surface's coordinates is.
    pub offset: Vec3,
}

impl Use<'_> {
    /// The ray in the coordinates of the surface. (Subtracting zero changes no number.)
    #[inline]
    pub fn ray(&self, ray: &Ray) -> Ray {
        Ray { origin: ray.origin - self.offset, direction: ray.direction }
    }
}

impl Catalog {
    /// What the number of a literal means: one of [`literals`](Self::literals), or a copy's.
    ///
    /// # Panics
    /// If there is none of that number.
    #[inline]
    pub fn literal(&self, index: u32) -> Use<'_> {
        match self.literals.get(index as usize) {
            Some(literal) => Use {
                surface: &self.surfaces[literal.surface as usize],
                stored: literal.surface,
                surface_shift: 0,
                leaf: literal.leaf,
                offset: Vec3::ZERO,
            },
            None => self.literal_of_copy(index),
        }
    }

    #[inline(never)]
    fn literal_of_copy(&self, index: u32) -> Use<'_> {
        let (prototype, copy, stored) = self.find(index, |prototype| &prototype.literals);
        let (literal, placed) = (self.literals[stored as usize], self.placed(prototype, copy));
        Use {
            surface: &self.surfaces[literal.surface as usize],
            stored: literal.surface,
            surface_shift: prototype.surfaces.shift(copy),
            leaf: literal.leaf - prototype.first_leaf + placed.first_leaf,
            offset: placed.offset,
        }
    }

    /// The number of a literal's surface: one of [`surfaces`](Self::surfaces), or a copy's.
    pub(crate) fn surface_number(&self, literal: u32) -> u32 {
        let at = self.literal(literal);
        at.stored + at.surface_shift
    }

    /// What the number of a surface means: one of [`surfaces`](Self::surfaces), or a copy's; and where the origin of its
    /// coordinates is.
    ///
    /// # Panics
    /// If there is none of that number.
    #[inline]
    pub fn surface(&self, number: u32) -> (&Surface, Vec3) {
        match self.surfaces.get(number as usize) {
            Some(surface) => (surface, Vec3::ZERO),
            None => {
                let (prototype, copy, stored) = self.find(number, |prototype| &prototype.surfaces);
                (&self.surfaces[stored as usize], self.placed(prototype, copy).offset)
            }
        }
    }

    /// The placed solid that a word is a literal of.
    #[inline]
    pub(crate) fn placed_by(&self, word: u32) -> Option<&Placed> {
        let Word::Literal { index, .. } = Word::decode(word) else { return None };
        match &self.surfaces[self.literals.get(index as usize)?.surface as usize] {
            Surface::Placed(placed) => Some(placed),
            _ => None,
        }
    }

    /// The prototype of a placed solid.
    pub fn prototype(&self, placed: &Placed) -> &Prototype {
        &self.prototypes[placed.prototype as usize]
    }

    /// The hit as that copy's, which was found as the prototype's.
    pub(crate) fn hit_of_copy(&self, placed: &Placed, hit: Hit) -> Hit {
        let prototype = self.prototype(placed);
        Hit {
            leaf: hit.leaf - prototype.first_leaf + placed.first_leaf,
            surface: hit.surface + prototype.surfaces.shift(placed.copy),
            ..hit
        }
    }

    /// The prototype and the copy that a number beyond the catalogue belongs to, and the number that is stored.
    fn find(&self, number: u32, numbers: impl Fn(&Prototype) -> &Numbers) -> (&Prototype, u32, u32) {
        let after = self.prototypes.partition_point(|prototype| numbers(prototype).copies_from <= number);
        let prototype = after.checked_sub(1).map(|last| &self.prototypes[last]);
        let found = prototype.and_then(|prototype| Some((prototype, numbers(prototype).find(number)?)));
        let (prototype, (copy, stored)) = found.expect("numbers are those of the catalogue, or of copies");
        (prototype, copy, stored)
    }

    fn placed(&self, prototype: &Prototype, copy: u32) -> &Placed {
        match &self.surfaces[(prototype.first_placed + copy) as usize] {
            Surface::Placed(placed) => placed,
            _ => unreachable!("a prototype's copies follow the first"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Constant, Copies, compile};
    use super::*;
    use crate::model::families::copies;

    #[test]
    fn numbers_beyond_the_catalogue_are_those_of_copies() {
        let compiled = compile(&[copies(40)], 0.0, Copies::Shared);
        let catalog = &compiled.catalog;
        let prototype = &catalog.prototypes[0];
        assert_eq!((catalog.prototypes.len(), prototype.copies, prototype.leaves), (1, 40, 5));
        let Constant::Words(words) = &compiled.bodies[0].whole else { panic!("a program") };
        let placed: Vec<&Placed> = words.iter().filter_map(|&word| catalog.placed_by(word)).collect();
        assert_eq!(placed.len(), 40);
        let mut surfaces = Vec::new();
        for placed in placed {
            for stored in prototype.literals.first..prototype.literals.first + prototype.literals.count {
                let (there, here) =
                    (catalog.literal(stored + prototype.literal_shift(placed.copy)), catalog.literal(stored));
                assert_eq!((there.stored, there.offset), (here.stored, placed.offset));
                assert_eq!(there.leaf, here.leaf + 5 * placed.copy);
                let number = there.stored + there.surface_shift;
                assert!(
                    std::ptr::eq(catalog.surface(number).0, here.surface) && catalog.surface(number).1 == placed.offset
                );
                surfaces.push(number);
            }
        }
        surfaces.sort_unstable();
        surfaces.dedup();
        assert_eq!(surfaces.len(), 40 * prototype.surfaces.count as usize, "all different");
        assert!(surfaces[0] as usize >= catalog.surfaces.len());
    }
}
