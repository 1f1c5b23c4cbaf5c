//! Whole solids that stand in several places: one of these places, as far as boxes can tell.

use super::{CellBox, OctantSides, Octants, Side, halves};
use crate::geom::{Bounds, Ray, Vec3};

/// A solid that is stored once, in one of the places where it stands. What it looks like is known to the catalogue of the
/// program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// A box around it.
    pub bounds: Bounds,
    /// Where the origin of its own coordinates is.
    pub offset: Vec3,
    /// The number of the solid.
    pub prototype: u32,
    /// Which copy of the solid it is.
    pub copy: u32,
    /// The number of its first leaf.
    pub first_leaf: u32,
}

impl Placed {
    /// The ray in the solid's own coordinates.
    #[inline]
    pub fn ray(&self, ray: &Ray) -> Ray {
        Ray { origin: ray.origin - self.offset, direction: ray.direction }
    }

    /// See [`Surface::classify`](super::Surface::classify): outside its bounds there is nothing of it.
    pub fn classify(&self, cell: &CellBox) -> Side {
        let meets = |axis: usize| {
            cell.center[axis] - cell.half[axis] <= self.bounds.max[axis]
                && cell.center[axis] + cell.half[axis] >= self.bounds.min[axis]
        };
        if (0..3).all(meets) { Side::Crossing } else { Side::Outside }
    }

    /// [`classify`](Self::classify) for eight boxes.
    pub(super) fn classify_octants(&self, octants: &Octants) -> OctantSides {
        let meets = |axis: usize| {
            let (low, high) = octants.extents(axis);
            let meets = |(min, max): (f64, f64)| min <= self.bounds.max[axis] && max >= self.bounds.min[axis];
            halves(axis, [meets(low), meets(high)])
        };
        OctantSides { inside: 0, outside: !(meets(0) & meets(1) & meets(2)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_boxes_are_classified_as_each_by_itself() {
        let bounds = Bounds::new(Vec3::new(0.2, -0.7, -3.0), Vec3::new(0.3, 0.1, -0.25));
        let placed = Placed { bounds, offset: Vec3::ZERO, prototype: 0, copy: 0, first_leaf: 0 };
        let octants = Octants::new(Vec3::ZERO, 0.5, 0.0);
        let sides = placed.classify_octants(&octants);
        assert_eq!(sides, OctantSides { inside: 0, outside: !0b1010 });
        for octant in 0..8 {
            let is_outside = placed.classify(&octants.cell(octant)) == Side::Outside;
            assert_eq!(is_outside, sides.outside >> octant & 1 == 1);
        }
    }
}
