//! A polyhedron of any shape, placed in the world, ready for rays.
//!
//! In come a [`Polyhedron`] and where it goes; out come, for any line, all crossings with its surface. The surface is
//! watertight: whether the line passes a triangle is decided exactly, for corners projected along the ray as
//! [Woop, Benthin, Wald 2013] do, with a symbolic nudge for lines through edges and corners. So each line enters as often
//! as it leaves, always. *Where* it crosses a triangle is the business of the plane that the triangle lies in, which
//! other solids may share: equal planes give equal parameters, to the bit.

mod line;
mod overlap;
mod parts;
mod place;
mod within;

use super::bvh::BoxTree;
use super::polyhedron::{FacePlane, Polyhedron};
use crate::geom::{Affine, Bounds, Ray, Vec3};
use line::Line;
pub(crate) use line::{TINY, UNCERTAIN};
pub(crate) use parts::{Facet, MeshPlane, MeshTriangle};
use place::{adopt, arranged};
use std::ops::ControlFlow;
use within::{reach, within};

/// A polyhedron in world space, for which rays can be traced: watertight, with parameters from planes that it may share
/// with other solids.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Corners, in the order in which the triangles come to them.
    points: Vec<Vec3>,
    /// In the order of the tree's leaves.
    triangles: Vec<MeshTriangle>,
    tree: BoxTree,
    /// The planes of the triangles' surfaces, in the same order.
    planes: Vec<MeshPlane>,
    /// The surfaces of the triangles by their numbers.
    facets: Vec<Facet>,
    slack: f64,
    /// The largest coordinate, by magnitude.
    farthest: f64,
}

/// Which of the caller's surfaces a face lies in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SurfaceRef {
    /// The caller's number of the surface.
    pub surface: u32,
    /// Whether that surface's own normal points into the polyhedron.
    pub flipped: bool,
}

/// A face of the polyhedron where it stands in the world, for which the caller is to name a surface.
#[derive(Clone, Copy, Debug)]
pub struct MovedFace<'a> {
    /// Index of the face in [`Polyhedron::faces`].
    pub face: usize,
    /// Its corners, counter-clockwise from outside.
    pub corners: &'a [Vec3],
    /// The plane that fits the corners best.
    pub plane: FacePlane,
}

/// A ray passing through a triangle of a [`Mesh`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Ray parameter.
    pub t: f64,
    /// Whether the ray goes into the polyhedron here (and not out of it).
    pub entering: bool,
    /// Index of the triangle.
    pub triangle: u32,
}

impl Mesh {
    /// The polyhedron moved by `map`, which may mirror. `surface_of` names the surface for each face that has an area,
    /// in the order of the faces.
    ///
    /// `slack` (scene units) says how far a surface may lie off the face that it stands for: the parameter of a crossing
    /// is taken from the surface, but not further than this outside the triangle's bounding box.
    ///
    /// `None` where no face has an area after the move, so that nothing is left.
    pub fn new(
        polyhedron: &Polyhedron,
        map: &Affine,
        slack: f64,
        surface_of: &mut dyn FnMut(&MovedFace) -> SurfaceRef,
    ) -> Option<Self> {
        let mirrored = map.determinant() < 0.0;
        let points: Vec<Vec3> = polyhedron.points().iter().map(|&p| map.point(p)).collect();
        let mut corners = Vec::new();
        let mut surfaces = Vec::with_capacity(polyhedron.faces().len());
        for (face, indices) in polyhedron.faces().iter().enumerate() {
            corners.clear();
            corners.extend(indices.iter().map(|&i| points[i as usize]));
            if mirrored {
                corners.reverse();
            }
            let plane = FacePlane::fit(&corners);
            surfaces.push(plane.map(|plane| surface_of(&MovedFace { face, corners: &corners, plane })));
        }
        let surfaces = adopt(surfaces, polyhedron.faces())?;
        let corners_of = |triangle: usize| {
            let [a, b, c] = polyhedron.triangles()[triangle].corners;
            if mirrored { [c, b, a] } else { [a, b, c] }
        };
        let facets = polyhedron.triangles().iter().map(|t| Facet::new(surfaces[t.face as usize])).collect();
        let (tree, order) = BoxTree::build(polyhedron.triangles().len(), slack, |triangle| {
            Bounds::around(corners_of(triangle).map(|i| points[i as usize]))
        });
        let (triangles, points) = arranged(&order, &points, corners_of);
        let farthest = points.iter().map(|p| p.max_abs()).fold(0.0, f64::max);
        Some(Self { points, triangles, tree, planes: Vec::new(), facets, slack, farthest })
    }

    /// The smallest axis-aligned box around the mesh.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }

    /// A box that holds everything that may be taken to be inside.
    pub(crate) fn extent(&self) -> Bounds {
        let (Bounds { min, max }, off) = (self.bounds(), Vec3::splat(2.0 * self.slack));
        Bounds::new(min - off, max + off)
    }

    /// How many triangles there are.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// The surface that a triangle lies in.
    ///
    /// # Panics
    /// If there is no such triangle.
    pub fn surface(&self, triangle: u32) -> SurfaceRef {
        self.facets[triangle as usize].surface()
    }

    /// Replaces `out` by all crossings of the whole line, `t` from -inf to inf, in ascending order; those at one `t`
    /// by triangle. As many enter as leave, also where the line runs through edges and corners or along faces.
    ///
    /// `surface_t` says where the ray meets a surface by its number; where it does not (infinite or NaN), or far away,
    /// the crossing lies within the triangle all the same.
    pub fn crossings(&self, ray: &Ray, surface_t: impl Fn(u32) -> f64, out: &mut Vec<Crossing>) {
        out.clear();
        let line = Line::new(ray, self.farthest);
        let _ = self.tree.visit::<()>(
            |bounds| line.may_touch(bounds),
            |place| {
                out.extend(self.crossing(&line, ray, &surface_t, place));
                ControlFlow::Continue(())
            },
        );
        out.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.triangle.cmp(&b.triangle)));
    }

    /// Replaces `out` by the crossings at which the line changes between outside and inside, ascending, no two at one
    /// `t`: first it enters, then it leaves, and so on; at last it leaves.
    ///
    /// What happens at one `t` happens at once; of several triangles there the first one in the order of the mesh that
    /// goes the right way stands for all.
    pub fn toggles(&self, ray: &Ray, surface_t: impl Fn(u32) -> f64, out: &mut Vec<Crossing>) {
        self.crossings(ray, surface_t, out);
        let (mut kept, mut next, mut winding) = (0, 0, 0_i32);
        while next < out.len() {
            let was_inside = winding > 0;
            let first = next;
            while next < out.len() && out[next].t == out[first].t {
                winding += if out[next].entering { 1 } else { -1 };
                next += 1;
            }
            let inside = winding > 0;
            if inside != was_inside {
                let going = out[first..next].iter().filter(|c| c.entering == inside);
                let chosen = *going.min_by_key(|c| c.triangle).expect("winding changes by crossings of that sign");
                out[kept] = chosen;
                kept += 1;
            }
            next = next.max(first + 1);
        }
        out.truncate(kept);
    }

    /// The triangle that stands for the toggle at `t`, a parameter that [`Self::toggles`] gave for the same ray: the first
    /// in the order of the mesh of those that the line crosses there in that direction. Cheaper than all toggles, for it
    /// looks near the point only.
    pub fn triangle_at(&self, ray: &Ray, surface_t: impl Fn(u32) -> f64, t: f64, entering: bool) -> Option<u32> {
        let line = Line::new(ray, self.farthest);
        let point = ray.at(t);
        // A crossing is in its triangle's box, but for the slack and for rounding, which is far less than this.
        let rounding = 1e-9 * (point.max_abs() + ray.origin.max_abs());
        let near = Vec3::splat(self.slack + rounding);
        let probe = Bounds::new(point - near, point + near);
        let mut first: Option<u32> = None;
        let _ = self.tree.visit::<()>(
            |bounds| !bounds.intersection(probe).is_empty() && line.may_touch(bounds),
            |place| {
                if let Some(Crossing { triangle, .. }) = self
                    .crossing(&line, ray, &surface_t, place)
                    .filter(|crossing| crossing.t == t && crossing.entering == entering)
                {
                    first = Some(first.map_or(triangle, |known| known.min(triangle)));
                }
                ControlFlow::Continue(())
            },
        );
        first
    }

    /// Where the line passes through the triangle at a place of the tree, if it does.
    fn crossing(&self, line: &Line, ray: &Ray, surface_t: impl Fn(u32) -> f64, place: u32) -> Option<Crossing> {
        let triangle = &self.triangles[place as usize];
        let corners = self.corners(triangle);
        let entering = line.crosses(corners)?;
        let (low, high) = within(ray, corners, self.slack, reach(ray, &Bounds::around(corners), self.slack));
        let t = surface_t(self.surface(triangle.number).surface);
        let t = if t.is_finite() { t.max(low).min(high) } else { low + 0.5 * (high - low) };
        Some(Crossing { t, entering, triangle: triangle.number })
    }

    /// Whether the point is inside. On the surface the answer is one or the other.
    pub fn contains(&self, point: Vec3) -> bool {
        let line = Line::new(&Ray { origin: point, direction: Vec3::Z }, self.farthest);
        let mut winding = 0_i32;
        let _ = self.tree.visit::<()>(
            |bounds| bounds.max.z >= point.z && line.may_touch(bounds),
            |place| {
                let corners = self.corners(&self.triangles[place as usize]);
                if let Some(entering) = line.crosses(corners) {
                    let ahead = line::is_behind(corners, point) != entering;
                    winding += i32::from(ahead) * if entering { -1 } else { 1 };
                }
                ControlFlow::Continue(())
            },
        );
        winding > 0
    }

    /// Whether the surface may touch a box. False only where it does not: so a box that is not touched lies inside or
    /// outside as a whole. Rounding is the caller's: make the box larger by what matters.
    pub fn touches_box(&self, center: Vec3, half_extents: Vec3) -> bool {
        // A crossing lies off its triangle by the slack at most, and its surface off the triangle's plane once more.
        let half_extents = half_extents + Vec3::splat(2.0 * self.slack);
        let probe = Bounds::new(center - half_extents, center + half_extents);
        let outcome = self.tree.visit(
            |bounds| !bounds.intersection(probe).is_empty(),
            |place| {
                let corners = self.corners(&self.triangles[place as usize]);
                match overlap::triangle_reaches_box(corners, center, half_extents) {
                    true => ControlFlow::Break(()),
                    false => ControlFlow::Continue(()),
                }
            },
        );
        outcome.is_break()
    }
}

#[cfg(test)]
mod tests;
