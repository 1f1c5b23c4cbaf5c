//! Whether a polyhedron is convex, and whether it is best seen as what half-spaces have in common.

use super::{FacePlane, Polyhedron};
use crate::geom::{Bounds, Vec3};
use crate::primitive::bvh::Bvh;
use rustc_hash::FxHashMap;
use std::ops::ControlFlow;

/// So many faces are asked first, without a tree.
const SOME: usize = 8;

/// With up to so many faces, half-spaces are best in any case.
const FEW: usize = 64;

/// With more than so many they never are.
const MANY: usize = 600;

/// The cosine of the angle between faces that go over into each other so smoothly that cells which tell one from the other
/// would have to be tiny: where a circle has more than 45 corners.
const SMOOTH: f64 = 0.990_268_068_741_57;

/// Of the angle at which they do not go over into each other at all: 30 degrees.
const SHARP: f64 = 0.866_025_403_784_438_6;

impl Polyhedron {
    /// Whether a convex polyhedron is so round, of so many faces, that it costs less as a mesh than as what the half-spaces
    /// behind its faces have in common. Near a point of it are the planes of all faces that are hardly turned against each
    /// other, and more of them matter than have a face there.
    pub(crate) fn is_round(&self) -> bool {
        if self.faces.len() <= FEW || self.faces.len() > MANY {
            return self.faces.len() > MANY;
        }
        let normals: Vec<Option<Vec3>> =
            (0..self.faces.len()).map(|face| self.face_plane(face).map(|plane| plane.normal)).collect();
        let edges =
            |face: &Vec<u32>| (0..face.len()).map(|i| (face[i], face[(i + 1) % face.len()])).collect::<Vec<_>>();
        let mut at_edge = FxHashMap::default();
        for (number, face) in self.faces.iter().enumerate() {
            at_edge.extend(edges(face).into_iter().map(|edge| (edge, number)));
        }
        // Of the neighbours that a face goes over into, how it is turned against the one against which it is turned most.
        let turned = |face: usize| {
            let own = normals[face]?;
            let others = edges(&self.faces[face]).into_iter().filter_map(|(a, b)| normals[*at_edge.get(&(b, a))?]);
            others.map(|other| own.dot(other)).filter(|&cosine| cosine > SHARP).reduce(f64::min)
        };
        let smooth = (0..self.faces.len()).filter(|&face| turned(face).is_some_and(|cosine| cosine > SMOOTH));
        smooth.count() > FEW
    }

    /// Whether no corner lies further than `tolerance` (units of primitive space) outside the plane of any face. If so,
    /// the polyhedron is what the half-spaces behind its faces have in common, up to the tolerance.
    ///
    /// Every face then lies in the surface of the convex hull, and a closed surface in a sphere covers the whole of it;
    /// so this is sound for several shells and repeated faces, too. Costs about `faces * log(points)` where the answer
    /// is yes, less where it is no.
    pub fn is_convex(&self, tolerance: f64) -> bool {
        // Of what is not convex, most faces can tell.
        let some = (0..self.faces.len()).step_by(self.faces.len().div_ceil(SOME).max(1));
        let pokes_out = |plane: FacePlane| self.points.iter().any(|&p| plane.distance(p) > tolerance);
        if some.filter_map(|face| self.face_plane(face)).any(pokes_out) {
            return false;
        }
        let boxes: Vec<Bounds> = self.points.iter().map(|&p| Bounds::new(p, p)).collect();
        let tree = Bvh::build(&boxes);
        (0..self.faces.len()).filter_map(|face| self.face_plane(face)).all(|plane| {
            let reach = plane.normal.abs();
            let pokes_out = |b: &Bounds| plane.distance(b.center()) + 0.5 * reach.dot(b.max - b.min) > tolerance;
            let outcome =
                tree.visit(pokes_out, |point| match plane.distance(self.points[point as usize]) > tolerance {
                    true => ControlFlow::Break(()),
                    false => ControlFlow::Continue(()),
                });
            outcome.is_continue()
        })
    }
}
