//! All faces of a program, by number. Those of meshes may be hundreds of thousands, so they are made when they are asked for.

use super::face::Face;
use crate::geom::{Affine, Bounds, Vec3};
use crate::primitive::{FacePlane, Polyhedron};
use crate::surface::Plane;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// Faces, each with a number, in the order in which they were added.
#[derive(Debug, Default)]
pub(super) struct Faces {
    own: Vec<Face>,
    meshes: Vec<Facets>,
    /// How many faces of meshes there are.
    facets: usize,
}

/// The faces of a polyhedron, moved to where they stand.
#[derive(Debug)]
struct Facets {
    polyhedron: Arc<Polyhedron>,
    map: Affine,
    /// The number of the first of them, and how many other faces come before.
    first: usize,
    own_before: usize,
    /// Those that have an area.
    kept: Vec<u32>,
}

impl Faces {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.own.len() + self.facets
    }

    /// How many of them are those of meshes.
    pub fn of_meshes(&self) -> usize {
        self.facets
    }

    /// Adds a face.
    pub fn push(&mut self, face: Face) {
        self.own.push(face);
    }

    /// Adds the faces of a polyhedron that have an area.
    pub fn add_facets(&mut self, polyhedron: &Arc<Polyhedron>, map: &Affine) {
        let has_area = |face: &u32| Corners::new(polyhedron, map, *face as usize).fit().is_some();
        let kept: Vec<u32> = (0..polyhedron.faces().len() as u32).into_par_iter().filter(has_area).collect();
        let (first, own_before) = (self.len(), self.own.len());
        self.facets += kept.len();
        self.meshes.push(Facets { polyhedron: Arc::clone(polyhedron), map: *map, first, own_before, kept });
    }

    /// The face of that number.
    ///
    /// # Panics
    /// If there is none.
    pub fn get(&self, number: usize) -> Cow<'_, Face> {
        match self.find(number) {
            Ok(face) => Cow::Borrowed(face),
            Err(corners) => Cow::Owned(corners.face().expect("it had an area before")),
        }
    }

    /// The [size](Face::size) of the face of that number.
    ///
    /// # Panics
    /// If there is none.
    pub fn size(&self, number: usize, room: &mut Vec<Vec3>) -> f64 {
        match self.find(number) {
            Ok(face) => face.size(face.samples(room)),
            Err(corners) => Bounds::around(corners.four()).diagonal(),
        }
    }

    /// A face by its number, or the corners of a mesh's.
    fn find(&self, number: usize) -> Result<&Face, Corners<'_>> {
        let Some(before) = self.meshes.partition_point(|mesh| mesh.first <= number).checked_sub(1) else {
            return Ok(&self.own[number]);
        };
        let mesh = &self.meshes[before];
        match mesh.kept.get(number - mesh.first) {
            Some(&face) => Err(Corners::new(&mesh.polyhedron, &mesh.map, face as usize)),
            None => Ok(&self.own[number - mesh.first - mesh.kept.len() + mesh.own_before]),
        }
    }
}

/// The corners of a polyhedron's face, moved, counter-clockwise from outside also where the map mirrors.
struct Corners<'a> {
    points: &'a [Vec3],
    corners: &'a [u32],
    map: &'a Affine,
    is_mirrored: bool,
}

impl<'a> Corners<'a> {
    fn new(polyhedron: &'a Polyhedron, map: &'a Affine, face: usize) -> Self {
        let is_mirrored = map.determinant() < 0.0;
        Self { points: polyhedron.points(), corners: &polyhedron.faces()[face], map, is_mirrored }
    }

    fn at(&self, i: usize) -> Vec3 {
        let i = if self.is_mirrored { self.corners.len() - 1 - i } else { i };
        self.map.point(self.points[self.corners[i] as usize])
    }

    /// Four of them, far from each other.
    fn four(&self) -> [Vec3; 4] {
        [0, 1, 2, 3].map(|i| self.at(i * self.corners.len() / 4))
    }

    /// The plane that fits best.
    fn fit(&self) -> Option<FacePlane> {
        match self.corners.len() {
            3 => FacePlane::fit(&[0, 1, 2].map(|i| self.at(i))),
            count => FacePlane::fit(&(0..count).map(|i| self.at(i)).collect::<Vec<Vec3>>()),
        }
    }

    fn face(&self) -> Option<Face> {
        let fit = self.fit()?;
        let plane = Plane { normal: fit.normal, offset: fit.normal.dot(fit.point) };
        Some(Face::Plane { plane, corners: self.four() })
    }
}

/// A face of a polyhedron, turned outwards also where the map mirrors; `None` where it has no area.
pub(super) fn facet(polyhedron: &Polyhedron, map: &Affine, face: usize) -> Option<Face> {
    Corners::new(polyhedron, map, face).face()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Arc<Polyhedron> {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::from);
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(Vec::from);
        Arc::new(Polyhedron::new(points.to_vec(), faces.to_vec()).expect("a sound polyhedron"))
    }

    fn unbounded(offset: f64) -> Face {
        Face::Unbounded { plane: Plane { normal: Vec3::Z, offset } }
    }

    #[test]
    fn faces_of_meshes_and_others_are_numbered_as_they_come() {
        let (mut faces, polyhedron) = (Faces::default(), tetrahedron());
        let offset_of = |faces: &Faces, number: usize| match *faces.get(number) {
            Face::Unbounded { plane } => plane.offset,
            _ => f64::NAN,
        };
        faces.push(unbounded(1.0));
        faces.add_facets(&polyhedron, &Affine::IDENTITY);
        faces.push(unbounded(2.0));
        faces.add_facets(&polyhedron, &Affine::scale(Vec3::new(-1.0, 1.0, 1.0)));
        faces.push(unbounded(3.0));
        assert_eq!(faces.len(), 11);
        assert_eq!([0, 5, 10].map(|number| offset_of(&faces, number)), [1.0, 2.0, 3.0]);
        // All but one of the faces lie in the planes of the axes, and look down them.
        for number in [1, 2, 3, 6, 7, 8] {
            let Face::Plane { plane, corners } = *faces.get(number) else { panic!("a plane") };
            assert_eq!((plane.offset, plane.normal.max_abs()), (0.0, 1.0));
            assert!(corners.iter().all(|&corner| plane.normal.dot(corner) == 0.0));
            let inside = Vec3::new(if number < 5 { 0.1 } else { -0.1 }, 0.1, 0.1);
            assert!(plane.normal.dot(inside) < 0.0, "{number}: {plane:?}");
        }
    }
}
