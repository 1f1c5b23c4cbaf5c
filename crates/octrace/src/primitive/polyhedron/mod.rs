//! Closed polyhedra: checked when made, then immutable.
//!
//! In come points and faces as people and programs write them: points repeated for every face, faces slightly warped,
//! concave or turned about. Out come distinct points, planar faces in outward order, and a cover by triangles whose
//! boundary is *exactly* empty, so that rays cannot slip through.

mod convex;
mod facet;
mod topology;

pub use facet::FacePlane;

use crate::geom::{Bounds, Vec3};

/// A closed polyhedron with planar faces; may be concave, may have cavities and several shells.
///
/// A point is inside where the surface winds around it a positive number of times.
///
/// Invariants: points are finite, distinct and used; every edge is used as often in one direction as in the other, by
/// the faces as well as by the triangles; the volume is positive.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    points: Vec<Vec3>,
    faces: Vec<Vec<u32>>,
    triangles: Vec<Triangle>,
}

/// One of the triangles that cover the faces of a [`Polyhedron`]. It may be degenerate: where a face has a corner in
/// the middle of a straight side, a triangle without area keeps the cover closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Indices of the corners, counter-clockwise from outside.
    pub corners: [u32; 3],
    /// Index of the face that it covers a part of.
    pub face: u32,
}

/// Why points and faces are not a [`Polyhedron`]. Indices are those of the input.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PolyhedronError {
    /// A face names a point that is not there.
    #[error("face {face} names point {index}, but there are only {points} points")]
    NoSuchPoint {
        /// Index of the face.
        face: usize,
        /// The index it names.
        index: u32,
        /// How many points there are.
        points: usize,
    },
    /// A coordinate is infinite or NaN.
    #[error("point {index} has a coordinate that is not finite")]
    NotFinite {
        /// Index of the point.
        index: usize,
    },
    /// The surface has a boundary.
    #[error("the surface is open: the edge from point {from} to point {to} of face {face} borders no other face")]
    Open {
        /// Index of a face at the boundary.
        face: usize,
        /// The edge's first point, in the face's order.
        from: u32,
        /// The edge's second point.
        to: u32,
        /// How many such edges there are.
        count: usize,
    },
    /// The surface has no boundary, but its faces cannot be turned so that they agree where they meet.
    #[error(
        "the faces disagree: no way of turning them makes face {face} fit its neighbours at the edge from point {from} to point {to}"
    )]
    Unorientable {
        /// Index of a face at the edge.
        face: usize,
        /// The edge's first point, in the face's order.
        from: u32,
        /// The edge's second point.
        to: u32,
        /// How many such edges there are.
        count: usize,
    },
    /// The surface encloses nothing.
    #[error("the surface encloses no volume")]
    Flat,
}

impl Polyhedron {
    /// The polyhedron with these corners and faces. Faces are lists of point indices, *counter-clockwise* seen from
    /// outside (the mathematician's order; OpenSCAD lists them clockwise).
    ///
    /// What is put right without a word: points with equal coordinates are one point; points that no face uses go;
    /// corners repeated in a row and faces with fewer than three corners go; faces that are not planar within 1e-5 of
    /// the polyhedron's diagonal become triangles. If faces disagree on their order but can be turned to agree, they
    /// are, and each connected shell then has its outside outside. If the volume is negative, all faces are turned.
    ///
    /// # Errors
    /// If the surface is not closed, or the input is not sound: see [`PolyhedronError`].
    pub fn new(points: Vec<Vec3>, faces: Vec<Vec<u32>>) -> Result<Self, PolyhedronError> {
        let (points, mut faces) = topology::clean(points, faces)?;
        topology::orient(&points, &mut faces)?;
        let tolerance = facet::PLANARITY * Bounds::around(points.iter().copied()).diagonal();
        let (faces, triangles) = facet::triangulate(&points.coordinates, faces, tolerance);
        let mut polyhedron = Self { points: points.coordinates, faces, triangles };
        let (volume, error) = polyhedron.volume_and_error();
        if volume.abs() <= error {
            return Err(PolyhedronError::Flat);
        }
        if volume < 0.0 {
            polyhedron.turn();
        }
        Ok(polyhedron)
    }

    /// The corners: distinct, each of them used by a face.
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// The faces, counter-clockwise from outside, each with at least three corners. A face may be without area.
    pub fn faces(&self) -> &[Vec<u32>] {
        &self.faces
    }

    /// Triangles that cover the faces, those of one face in a row, in the order of the faces.
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The plane that fits a face best, `None` where the face has no area.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn face_plane(&self, face: usize) -> Option<FacePlane> {
        let corners: Vec<Vec3> = self.faces[face].iter().map(|&i| self.points[i as usize]).collect();
        FacePlane::fit(&corners)
    }

    /// The volume: cubic units of primitive space; parts enclosed twice count twice.
    pub fn volume(&self) -> f64 {
        self.volume_and_error().0
    }

    /// The signed volume, by tetrahedra about the middle, and a bound of its rounding error.
    fn volume_and_error(&self) -> (f64, f64) {
        let middle = Bounds::around(self.points.iter().copied()).center();
        let corner = |i: u32| self.points[i as usize] - middle;
        let (mut sum, mut magnitude) = (0.0_f64, 0.0_f64);
        for triangle in &self.triangles {
            let [a, b, c] = triangle.corners.map(corner);
            sum += a.dot(b.cross(c));
            magnitude += a.length() * b.length() * c.length();
        }
        // Each term is good to a few units in the last place of its magnitude. The running sum adds more where triangles
        // are many, but then at random; a body this thin has no digit of its volume left in any case.
        (sum / 6.0, magnitude * 16.0 * f64::EPSILON)
    }

    /// Exchanges inside and outside.
    fn turn(&mut self) {
        for face in &mut self.faces {
            face.reverse();
        }
        for triangle in &mut self.triangles {
            triangle.corners.reverse();
        }
    }
}

#[cfg(test)]
mod tests;
