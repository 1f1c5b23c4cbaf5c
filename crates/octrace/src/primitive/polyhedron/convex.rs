//! Whether a polyhedron is convex.

use super::{FacePlane, Polyhedron};
use crate::geom::Bounds;
use crate::primitive::bvh::Bvh;
use std::ops::ControlFlow;

/// So many faces are asked first, without a tree.
const SOME: usize = 8;

impl Polyhedron {
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
