//! The faces of primitives, moved to where they stand.

use super::face::Face;
use super::facets::{Faces, facet};
use crate::geom::{Affine, Vec3};
use crate::primitive::Polyhedron;
use crate::surface::{Plane, QuadricKind, TorusKind};

/// The faces of one primitive, moved to the scene by `map`.
pub(super) struct FaceList<'a> {
    pub map: &'a Affine,
    pub inverse: Affine,
    pub faces: &'a mut Faces,
}

impl FaceList<'_> {
    /// A planar face with the given outward normal, in local coordinates, through four corners.
    pub fn plane(&mut self, normal: Vec3, corners: [Vec3; 4]) {
        let corners = corners.map(|c| self.map.point(c));
        if let Some(plane) = self.moved_plane(normal, &corners) {
            self.faces.push(Face::Plane { plane, corners });
        }
    }

    /// Normals move by the transposed inverse. An invertible map leaves none without a direction.
    fn moved_plane(&self, normal: Vec3, points: &[Vec3]) -> Option<Plane> {
        let normal = self.inverse.transposed_vector(normal).normalized()?;
        let middle = points.iter().fold(Vec3::ZERO, |sum, &p| sum + p) / points.len() as f64;
        Some(Plane { normal, offset: normal.dot(middle) })
    }

    pub fn block(&mut self) {
        for axis in 0..3 {
            for (height, sign) in [(0.0, -1.0), (1.0, 1.0)] {
                let mut normal = Vec3::ZERO;
                normal[axis] = sign;
                let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| {
                    let mut corner = Vec3::ZERO;
                    corner[axis] = height;
                    corner[(axis + 1) % 3] = u;
                    corner[(axis + 2) % 3] = v;
                    corner
                });
                self.plane(normal, corners);
            }
        }
    }

    /// A disc about the z axis.
    pub fn cap(&mut self, normal: Vec3, radius: f64, z: f64) {
        let corners = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
        self.plane(normal, corners.map(|(x, y)| Vec3::new(x * radius, y * radius, z)));
    }

    /// The side is a part of the double cone X² + Y² < Z² with Z = 1 - (1 - top) z.
    pub fn cone(&mut self, top: f64) {
        let slope = 1.0 - top;
        let from_cone = Affine {
            translation: Vec3::new(0.0, 0.0, 1.0 / slope),
            ..Affine::scale(Vec3::new(1.0, 1.0, -1.0 / slope))
        };
        self.quadric(QuadricKind::Cone, &from_cone, (1.0, (1.0 + top) / 2.0));
        self.cap(-Vec3::Z, 1.0, 0.0);
        // At a pointed end the plane only parts the nappes; it is known as well as the cone.
        self.cap(Vec3::Z, if top > 0.0 { top } else { 1.0 }, 1.0);
    }

    /// The faces that have an area, turned outwards also where the map mirrors.
    pub fn polyhedron(&mut self, polyhedron: &Polyhedron) {
        let faces = (0..polyhedron.faces().len()).filter_map(|face| facet(polyhedron, self.map, face));
        faces.for_each(|face| self.faces.push(face));
    }

    /// The half-space z >= 0.
    pub fn half_space(&mut self) {
        let on_plane = self.map.point(Vec3::ZERO);
        if let Some(plane) = self.moved_plane(-Vec3::Z, &[on_plane]) {
            self.faces.push(Face::Unbounded { plane });
        }
    }

    /// A torus; `placed` takes its own coordinates to those of the primitive.
    pub fn torus(&mut self, kind: TorusKind, minor: f64, placed: &Affine) {
        let map = *self.map * *placed;
        if let Some(from_primitive) = placed.inverse() {
            self.faces.push(Face::Torus { kind, minor, map, to_local: from_primitive * self.inverse });
        }
    }

    /// A quadric; `placed` takes its own coordinates to those of the primitive.
    pub fn quadric(&mut self, kind: QuadricKind, placed: &Affine, heights: (f64, f64)) {
        let map = *self.map * *placed;
        if let Some(from_primitive) = placed.inverse() {
            let to_local = from_primitive * self.inverse;
            self.faces.push(Face::Quadric { kind, map, to_local, heights });
        }
    }
}
