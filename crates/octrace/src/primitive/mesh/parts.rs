//! What a mesh is made of, for whoever follows several rays through it at once.

use super::line::{self, Line};
use super::{Mesh, SurfaceRef};
use crate::geom::{Ray, Vec3};
use crate::primitive::bvh::{BoxTree, GROWTH_BY_COORDINATES};

/// A triangle among others that are near it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeshTriangle {
    /// Counter-clockwise from outside.
    pub corners: [u32; 3],
    /// Its number in the order of the polyhedron.
    pub number: u32,
}

/// The plane of a surface that a triangle lies in: where it is at hand when a ray is there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeshPlane {
    pub normal: Vec3,
    pub offset: f64,
}

/// A [`SurfaceRef`] in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Facet(pub u32);

impl Facet {
    const FLIPPED: u32 = 1 << 31;

    /// The same in one word.
    pub fn new(surface: SurfaceRef) -> Self {
        Self(surface.surface | if surface.flipped { Self::FLIPPED } else { 0 })
    }

    /// What it refers to.
    #[inline(always)]
    pub fn surface(self) -> SurfaceRef {
        SurfaceRef { surface: self.0 & !Self::FLIPPED, flipped: self.0 & Self::FLIPPED != 0 }
    }
}

impl Mesh {
    /// Takes the planes of the surfaces, by their numbers, to be at hand where [`plane`](Self::plane) asks for them.
    pub(crate) fn keep_planes(&mut self, plane_of: impl Fn(u32) -> MeshPlane) {
        let planes = self.triangles.iter().map(|triangle| plane_of(self.facet(triangle.number).surface().surface));
        self.planes = planes.collect();
    }

    /// The plane of the surface that the triangle at a place of the tree lies in.
    #[inline(always)]
    pub(crate) fn plane(&self, place: usize) -> MeshPlane {
        self.planes[place]
    }

    /// The surface that a triangle lies in.
    #[inline(always)]
    pub(crate) fn facet(&self, triangle: u32) -> Facet {
        self.facets[triangle as usize]
    }

    /// The tree over the triangles, its boxes grown by the slack.
    pub(crate) fn tree(&self) -> &BoxTree {
        &self.tree
    }

    /// The triangles in the order of the tree's leaves.
    pub(crate) fn triangles(&self) -> &[MeshTriangle] {
        &self.triangles
    }

    /// The corners of a triangle.
    #[inline(always)]
    pub(crate) fn corners(&self, triangle: &MeshTriangle) -> [Vec3; 3] {
        triangle.corners.map(|i| self.points[i as usize])
    }

    /// How far a surface may lie off the face that it stands for.
    pub(crate) fn slack(&self) -> f64 {
        self.slack
    }

    /// The largest coordinate of rays' origins for which the boxes of the tree are large enough to have no line through a
    /// triangle pass them by.
    pub(crate) fn reach(&self) -> f64 {
        GROWTH_BY_COORDINATES / (2.0 * line::ROOM) * self.farthest
    }

    /// Whether the line passes through a triangle, and if so, whether it goes in.
    pub(crate) fn crosses(&self, ray: &Ray, triangle: &MeshTriangle) -> Option<bool> {
        Line::new(ray, self.farthest).crosses(self.corners(triangle))
    }
}
