//! Boxes around the two sides of a surface.

use super::{Plane, Quadric, QuadricKind, Surface, Torus, TorusKind};
use crate::geom::{Affine, Bounds, Vec3};

impl Surface {
    /// A box that holds all of the inside, and one that holds all of the outside: all of space where nothing better is known.
    /// Rounding is accounted for where a surface is squashed; the usual is for the caller's margin to cover.
    pub fn extents(&self) -> (Bounds, Bounds) {
        match self {
            Self::Plane(plane) => plane.extents(),
            Self::Quadric(quadric) => (quadric.extent(), Bounds::ALL),
            Self::Torus(torus) => (torus.extent(), Bounds::ALL),
            Self::Mesh(mesh) => (mesh.extent(), Bounds::ALL),
            Self::Placed(placed) => (placed.bounds, Bounds::ALL),
        }
    }
}

impl Plane {
    fn extents(&self) -> (Bounds, Bounds) {
        let Some(axis) = self.axis() else { return (Bounds::ALL, Bounds::ALL) };
        let height = self.offset / self.normal[axis];
        let (mut low, mut high) = (Bounds::ALL, Bounds::ALL);
        low.max[axis] = height;
        high.min[axis] = height;
        if self.normal[axis] > 0.0 { (low, high) } else { (high, low) }
    }
}

impl Quadric {
    fn extent(&self) -> Bounds {
        match (self.kind, self.axes()) {
            (QuadricKind::Sphere, _) => around(&self.to_local, |row| row.length(), Vec3::splat(1.0)),
            (QuadricKind::Cylinder, Some(axes)) => {
                let mut bounds = Bounds::ALL;
                for (row, &axis) in axes[..2].iter().enumerate() {
                    let (scale, shift) = (self.to_local.rows[row][axis], self.to_local.translation[row]);
                    let (middle, half) = (-shift / scale, 1.0 / scale.abs());
                    let off = 8.0 * f64::EPSILON * (middle.abs() + half);
                    (bounds.min[axis], bounds.max[axis]) = (middle - half - off, middle + half + off);
                }
                bounds
            }
            (QuadricKind::Cylinder | QuadricKind::Cone, _) => Bounds::ALL,
        }
    }
}

impl Torus {
    fn extent(&self) -> Bounds {
        let flat = |row: Vec3| (row.x * row.x + row.y * row.y).sqrt();
        match self.kind {
            TorusKind::Outer => {
                let outer = 1.0 + self.minor;
                around(&self.to_local, |row| flat(row) + self.minor * row.length(), Vec3::new(outer, outer, self.minor))
            }
            TorusKind::Inner => {
                // In a cylinder, from tip to tip.
                let outer = (self.minor - 1.0).max(0.0);
                let tip = (outer * (self.minor + 1.0)).sqrt();
                around(&self.to_local, |row| flat(row) * outer + row.z.abs() * tip, Vec3::new(outer, outer, tip))
            }
        }
    }
}

/// A box around what lies about the origin of its own coordinates, not farther than `farthest`; `reach` tells from a row of
/// the map out of these coordinates how far it goes along that axis of the scene.
fn around(to_local: &Affine, reach: impl Fn(Vec3) -> f64, farthest: Vec3) -> Bounds {
    let Some(map) = to_local.inverse() else { return Bounds::ALL };
    let apply = |affine: &Affine, to: Vec3| Vec3::from(affine.rows.map(|row| row.abs().dot(to)));
    // Of a map that squashes space at an angle the inverse is imprecise, by what a point is off when moved there and back.
    let there_and_back = apply(to_local, apply(&map, farthest) + map.translation.abs()) + to_local.translation.abs();
    let off = apply(&map, there_and_back * (16.0 * f64::EPSILON));
    let half = Vec3::from(map.rows.map(reach)) + off;
    let bounds = Bounds::new(map.translation - half, map.translation + half);
    if half.is_finite() && bounds.min.is_finite() && bounds.max.is_finite() { bounds } else { Bounds::ALL }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Ray;

    #[test]
    fn what_crosses_a_surface_does_so_in_its_box() {
        let maps = [
            Affine::IDENTITY,
            Affine::translation(Vec3::new(1.0, -2.0, 3.0)) * Affine::scale(Vec3::new(0.5, 1.0, 2.0)),
            Affine::rotation_deg(Vec3::new(90.0, 0.0, 0.0)) * Affine::translation(Vec3::new(0.5, 0.25, -1.0)),
            Affine::rotation_deg(Vec3::new(20.0, 30.0, 40.0)) * Affine::scale(Vec3::new(0.5, 1.0, 2.0)),
        ];
        for map in maps {
            let to_local = map.inverse().expect("maps that can be undone");
            for surface in [
                Surface::Quadric(Quadric { kind: QuadricKind::Sphere, to_local }),
                Surface::Quadric(Quadric { kind: QuadricKind::Cylinder, to_local }),
                Surface::Torus(Torus { kind: TorusKind::Outer, minor: 0.25, to_local }),
                Surface::Torus(Torus { kind: TorusKind::Inner, minor: 2.0, to_local }),
            ] {
                let (bounds, _) = surface.extents();
                let mut touched = Bounds::EMPTY;
                for i in 0..6400 {
                    let (u, v) = (f64::from(i % 80) / 40.0 - 1.0, f64::from(i / 80) / 40.0 - 1.0);
                    for axis in 0..3 {
                        let (mut from, mut direction) = (Vec3::new(v, u, v) * 6.0, Vec3::ZERO);
                        (from[axis], from[(axis + 1) % 3]) = (-9.0, u * 6.0);
                        direction[axis] = 1.0;
                        let ray = Ray { origin: from, direction };
                        let mut params = Vec::new();
                        surface.crossings(&[], &ray, &mut params);
                        touched = params.iter().fold(touched, |all, &t| all.union(Bounds::around([ray.at(t)])));
                    }
                }
                let grown = Bounds::new(bounds.min - Vec3::splat(1e-9), bounds.max + Vec3::splat(1e-9));
                assert!(grown.contains(touched.min) && grown.contains(touched.max), "{surface:?}: {touched:?}");
                if matches!(surface, Surface::Quadric(Quadric { kind: QuadricKind::Sphere, .. })) {
                    assert!((bounds.size() - touched.size()).max_abs() < 0.4, "{bounds:?} is tight about {touched:?}");
                }
            }
        }
    }

    #[test]
    fn a_plane_bounds_both_of_its_sides() {
        let (inside, outside) = Surface::Plane(Plane { normal: -Vec3::Y, offset: 2.0 }).extents();
        assert_eq!((inside.min.y, inside.max.y), (-2.0, f64::INFINITY));
        assert_eq!((outside.min.y, outside.max.y), (f64::NEG_INFINITY, -2.0));
        assert_eq!(inside.min.x, f64::NEG_INFINITY);
        let oblique = Vec3::new(0.6, 0.8, 0.0);
        assert_eq!(Surface::Plane(Plane { normal: oblique, offset: 2.0 }).extents(), (Bounds::ALL, Bounds::ALL));
    }
}
