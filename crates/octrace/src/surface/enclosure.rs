//! Half-spaces around what a surface has of its inside, or of its outside, in a box.

use super::{CellBox, Plane, Quadric, QuadricKind, Surface};
use crate::geom::Vec3;
use crate::num::HalfSpace;

/// Roundings in the numbers that make a half-space, amply.
const ROUNDINGS: f64 = 32.0 * f64::EPSILON;

impl Surface {
    /// A half-space that holds all points of the box that are inside (`negated`: outside), in coordinates from the box's
    /// middle; `None` where none is known that says anything.
    pub(crate) fn half_space_in(&self, cell: &CellBox, negated: bool) -> Option<HalfSpace> {
        let found = match self {
            Self::Plane(plane) => plane.half_space_in(cell, negated),
            Self::Quadric(quadric) => quadric.half_space_in(cell, negated),
            Self::Torus(_) | Self::Mesh(_) | Self::Placed(_) => return None,
        };
        (found.most.is_finite() && found.normal.iter().all(|n| n.is_finite())).then_some(found)
    }
}

impl Plane {
    fn half_space_in(&self, cell: &CellBox, negated: bool) -> HalfSpace {
        let height = self.normal.dot(cell.center) - self.offset;
        let slack = ROUNDINGS * (self.normal.abs().dot(cell.center.abs()) + self.offset.abs());
        let (normal, height) = if negated { (-self.normal, -height) } else { (self.normal, height) };
        HalfSpace { normal: normal.to_array(), most: slack - height }
    }
}

impl Quadric {
    /// By the mean value form of [`classify`](Self::classify): `f(q) + grad f(q) . delta`, and how far `f` bulges from it.
    fn half_space_in(&self, cell: &CellBox, negated: bool) -> HalfSpace {
        let (s, c0) = self.kind.coefficients();
        let q = self.to_local.point(cell.center);
        let (reach, rounding) = cell.reach(&self.to_local.rows);
        let squares = Vec3::new(q.x * q.x, q.y * q.y, s * (q.z * q.z));
        let value = squares.x + squares.y + squares.z + c0;
        let slope = self.to_local.transposed_vector(Vec3::new(2.0 * q.x, 2.0 * q.y, 2.0 * s * q.z));
        // How far rounding puts the box's middle.
        let of_center = self.to_local.rows.map(|row| row.abs().dot(cell.center.abs()));
        let size = Vec3::from(of_center) + self.to_local.translation.abs() + reach;
        let weight = Vec3::new(1.0, 1.0, s.abs());
        let off = |v: Vec3| Vec3::new(v.x * size.x, v.y * size.y, v.z * size.z).dot(weight);
        let slack = ROUNDINGS * (off(size) + c0.abs()) + 2.0 * q.abs().dot(rounding);
        let across = reach.x * reach.x + reach.y * reach.y;
        let along = reach.z * reach.z;
        let (low, high) = match self.kind {
            QuadricKind::Sphere => (0.0, across + along),
            QuadricKind::Cylinder => (0.0, across),
            QuadricKind::Cone => (-along, across),
        };
        match negated {
            // f < 0, and f is at least value + slope . delta + low.
            false => HalfSpace { normal: slope.to_array(), most: slack - value - low },
            true => HalfSpace { normal: (-slope).to_array(), most: slack + value + high },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Affine;
    use crate::surface::Side;

    #[test]
    fn no_point_of_the_side_is_left_out() {
        let tilted = Affine::rotation_deg(Vec3::new(20.0, 30.0, 40.0)) * Affine::scale(Vec3::new(0.5, 1.0, 2.0));
        let mut surfaces = vec![Surface::Plane(Plane { normal: Vec3::new(0.6, 0.0, 0.8), offset: 0.3 })];
        for kind in [QuadricKind::Sphere, QuadricKind::Cylinder, QuadricKind::Cone] {
            surfaces.push(Surface::Quadric(Quadric { kind, to_local: tilted }));
        }
        let cell = CellBox::new(Vec3::new(0.4, -0.3, 0.2), Vec3::new(0.3, 0.2, 0.1));
        for surface in surfaces {
            let (mut held, mut cut) = (0, 0);
            for i in 0..4096 {
                let share = |shift: i32| f64::from(i >> shift & 15) / 7.5 - 1.0;
                let delta = Vec3::new(share(0) * cell.half.x, share(4) * cell.half.y, share(8) * cell.half.z);
                let inside = surface.classify(&CellBox::new(cell.center + delta, Vec3::ZERO)) == Side::Inside;
                for negated in [false, true] {
                    let half = surface.half_space_in(&cell, negated).expect("a plane or a quadric");
                    let holds = Vec3::from(half.normal).dot(delta) <= half.most;
                    assert!(holds || inside == negated, "{surface:?} {delta:?}");
                    held += u32::from(holds);
                    cut += u32::from(!holds);
                }
            }
            assert!(held >= 4096 && cut > 100, "{surface:?}: {held} {cut}");
        }
    }
}
