//! Solids by their boundary, for what needs one: the boolean operations are carried out on meshes.
//!
//! In comes a tree; out come triangles. What is round has corners instead, within a tolerance and so that volumes are
//! right. The mesh booleans are those of Manifold.

use super::SpaceError;
use super::bounds::bounds;
use super::contour::{polygon, region};
use super::convex::{convex, merged};
use super::fold::fold;
use super::round::{Extremes, Fit, fragments, swelling};
use super::swept::{prism_mesh, revolution_mesh};
use crate::Tolerance;
use crate::plane::Flat;
use manifold_rust::cross_section::CrossSection;
use manifold_rust::linalg;
use manifold_rust::manifold::Manifold;
use manifold_rust::types::{Error, MeshGL64, OpType};
use octrace::geom::sin_cos_deg;
use octrace::{Affine, BoolOp, Bounds, Polyhedron, Primitive, Solid, Vec2, Vec3};

/// A closed surface of triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// The corners.
    pub points: Vec<Vec3>,
    /// Three corners each, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// The polyhedron that the mesh bounds, triangles in one plane put together; `None` for nothing.
    pub fn polyhedron(self) -> Option<Polyhedron> {
        let faces = merged(&self.points, &self.triangles);
        let whole = Polyhedron::new(self.points.clone(), faces).ok();
        whole.or_else(|| {
            let triangles = self.triangles.iter().map(|t| t.to_vec()).collect();
            Polyhedron::new(self.points, triangles).ok()
        })
    }

    pub(super) fn of(manifold: &Manifold) -> Result<Self, SpaceError> {
        if manifold.status() != Error::NoError {
            return Err(SpaceError::NotASolid);
        }
        let mesh = manifold.get_mesh_gl64(-1);
        let points = mesh.vert_properties.as_chunks::<3>().0.iter().map(|&p| Vec3::from(p)).collect();
        let triangles = mesh.tri_verts.as_chunks::<3>().0.iter().map(|t| t.map(|i| i as u32)).collect();
        Ok(Self { points, triangles })
    }

    /// What is just above the plane z = 0.
    pub(super) fn slice(&self) -> Result<Flat, SpaceError> {
        let manifold = self.manifold();
        if manifold.status() != Error::NoError { Err(SpaceError::NotASolid) } else { Ok(outline(&manifold.slice(0.0))) }
    }

    /// The shadow on the plane z = 0.
    pub(super) fn shadow(&self) -> Result<Flat, SpaceError> {
        let manifold = self.manifold();
        if manifold.status() != Error::NoError { Err(SpaceError::NotASolid) } else { Ok(outline(&manifold.project())) }
    }

    pub(super) fn manifold(&self) -> Manifold {
        Manifold::from_mesh_gl64(&MeshGL64 {
            num_prop: 3,
            vert_properties: self.points.iter().flat_map(|p| p.to_array()).collect(),
            tri_verts: self.triangles.iter().flatten().map(|&i| u64::from(i)).collect(),
            ..MeshGL64::default()
        })
    }
}

/// The boundary of the solid; empty for the empty solid.
///
/// # Errors
/// If the solid is unbounded, or a polyhedron in it has no mesh that booleans can be made with.
pub fn mesh(solid: &Solid, tolerance: Tolerance) -> Result<TriangleMesh, SpaceError> {
    TriangleMesh::of(&manifold(solid, tolerance)?)
}

/// The same as a value of the mesh library.
pub(super) fn manifold(solid: &Solid, tolerance: Tolerance) -> Result<Manifold, SpaceError> {
    let whole = bounds(solid);
    if !whole.is_bounded() {
        return Err(SpaceError::Unbounded);
    }
    let deviation = tolerance.relative * whole.diagonal();
    let leaf = |primitive: &Primitive, map: &Affine| faceted(primitive, map, deviation, &whole).manifold();
    let manifold = fold(solid, leaf, |op, operands: Vec<Manifold>| combine(op, operands));
    if manifold.status() != Error::NoError { Err(SpaceError::NotASolid) } else { Ok(manifold) }
}

/// The corners that the mesh of `whole` has where nothing is cut away from its part `solid`, a union of primitives.
pub(super) fn corners(solid: &Solid, whole: &Solid, tolerance: Tolerance) -> Vec<Vec3> {
    let whole = bounds(whole);
    let deviation = tolerance.relative * whole.diagonal();
    let leaf = |primitive: &Primitive, map: &Affine| faceted(primitive, map, deviation, &whole).points;
    fold(solid, leaf, |_, corners: Vec<Vec<Vec3>>| corners.concat())
}

fn combine(op: BoolOp, operands: Vec<Manifold>) -> Manifold {
    let op = match op {
        BoolOp::Union => return union(operands),
        BoolOp::Intersection => OpType::Intersect,
        BoolOp::Difference => OpType::Subtract,
    };
    let mut operands = operands.into_iter();
    let Some(first) = operands.next() else { return Manifold::empty() };
    match op {
        // What is taken away may be put together first: fewer cuts through a large mesh.
        OpType::Subtract => first.boolean(&union(operands.collect()), op),
        _ => operands.fold(first, |a, b| a.boolean(&b, op)),
    }
}

/// Pairs, then pairs of pairs: so no mesh is rebuilt more often than the logarithm of their number.
pub(super) fn union(mut operands: Vec<Manifold>) -> Manifold {
    while operands.len() > 1 {
        let pair = |pair: &[Manifold]| match pair {
            [a, b] => a.boolean(b, OpType::Add),
            rest => rest.first().cloned().unwrap_or_else(Manifold::empty),
        };
        operands = operands.chunks(2).map(pair).collect();
    }
    operands.pop().unwrap_or_else(Manifold::empty)
}

/// A primitive with corners that are within `deviation` (scene units) of it. Of unbounded ones the part around `whole`.
pub(super) fn faceted(primitive: &Primitive, map: &Affine, deviation: f64, whole: &Bounds) -> TriangleMesh {
    let polyhedron = match primitive {
        Primitive::Polyhedron(polyhedron) => return moved(polyhedron, map),
        Primitive::Torus { minor } => return torus(*minor, map, deviation),
        Primitive::Prism { profile, top } => return prism_mesh(profile.contours(), *top, map, deviation),
        Primitive::Revolution(profile) => return revolution_mesh(profile.contours(), map, deviation),
        Primitive::HalfSpace => half_space(map, whole),
        Primitive::Block | Primitive::Sphere | Primitive::Cylinder | Primitive::Cone { .. } => {
            let mut extremes = Extremes::default();
            // None of these is unbounded, or has arcs that a tolerance is for.
            let added = extremes.add(primitive, map, Tolerance::default());
            added.ok().and_then(|()| convex(&extremes.sampled(deviation, Fit::Even)))
        }
    };
    polyhedron.map_or_else(TriangleMesh::default, |p| moved(&p, &Affine::IDENTITY))
}

fn moved(polyhedron: &Polyhedron, map: &Affine) -> TriangleMesh {
    let mirrored = map.determinant() < 0.0;
    let turned = |[a, b, c]: [u32; 3]| if mirrored { [c, b, a] } else { [a, b, c] };
    TriangleMesh {
        points: polyhedron.points().iter().map(|&p| map.point(p)).collect(),
        triangles: polyhedron.triangles().iter().map(|t| turned(t.corners)).collect(),
    }
}

/// The part of a half-space within a box somewhat larger than `whole`.
fn half_space(map: &Affine, whole: &Bounds) -> Option<Polyhedron> {
    let inverse = map.inverse()?;
    let margin = Vec3::splat(whole.diagonal());
    let mut reach = Bounds::new(whole.min - margin, whole.max + margin).transformed(&inverse);
    reach.min.z = reach.min.z.max(0.0);
    if !reach.has_volume() {
        return None;
    }
    let corner = |i: u32| {
        let at = |bit: u32, axis: usize| if i >> bit & 1 == 0 { reach.min[axis] } else { reach.max[axis] };
        map.point(Vec3::new(at(0, 0), at(1, 1), at(2, 2)))
    };
    convex(&(0..8).map(corner).collect::<Vec<_>>())
}

/// A ring of quadrilaterals, each two triangles. Where the tube is wider than the hole the surface would cross itself; then
/// it starts and ends on the axis.
fn torus(minor: f64, map: &Affine, deviation: f64) -> TriangleMesh {
    let scale = Primitive::Sphere.bounds(map).size().max_abs() * 0.5;
    let n = fragments(scale * (1.0 + minor), deviation);
    let m = fragments(scale * minor, deviation);
    let tube = minor * swelling(m);
    let profile: Vec<(f64, f64)> = (0..m)
        .map(|i| sin_cos_deg(360.0 * f64::from(i) / f64::from(m)))
        .map(|(s, c)| (((1.0 + tube * c) * swelling(n)).max(0.0), tube * s))
        .collect();
    let mut mesh = TriangleMesh::default();
    for i in 0..n {
        let (s, c) = sin_cos_deg(360.0 * f64::from(i) / f64::from(n));
        mesh.points.extend(profile.iter().map(|&(radius, z)| map.point(Vec3::new(radius * c, radius * s, z))));
        for j in 0..m {
            let at = |i: u32, j: u32| i % n * m + j % m;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    // Cleaned of what is doubled on the axis, and turned outwards.
    let triangles = mesh.triangles.iter().map(|t| t.to_vec()).collect();
    Polyhedron::new(mesh.points, triangles).map_or_else(|_| TriangleMesh::default(), |p| moved(&p, &Affine::IDENTITY))
}

/// The region of a section: outer contours are counter-clockwise, holes clockwise.
fn outline(section: &CrossSection) -> Flat {
    let corners = |path: &Vec<linalg::Vec2>| polygon(path.iter().map(|p| Vec2::new(p.x, p.y)));
    region(section.to_polygons().iter().map(corners).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn check(solid: Solid, volume: f64) {
        let mesh = mesh(&solid, Tolerance::default()).unwrap();
        let found = mesh.polyhedron().map_or(0.0, |p| p.volume());
        assert!((found - volume).abs() <= 1e-4 * volume, "{found} is not {volume}");
    }

    #[test]
    fn volumes_are_right() {
        check(Solid::empty(), 0.0);
        check(Solid::block().scale([2.0, -3.0, 4.0]), 24.0);
        check(Solid::sphere().scale([2.0, 1.0, 1.0]), 8.0 / 3.0 * PI);
        check(Solid::cylinder() - Solid::block().translate([0.0, 0.0, 0.5]), PI - PI / 8.0);
        check(Solid::primitive(Primitive::Cone { top: 0.5 }), PI / 3.0 * 1.75);
        check(Solid::primitive(Primitive::Torus { minor: 0.25 }), 2.0 * PI * PI / 16.0);
        check(Solid::sphere() & Solid::half_space().rotate([30.0, 40.0, 0.0]), 2.0 / 3.0 * PI);
        check(Solid::block() + Solid::block().translate([0.5; 3]), 1.875);
        check(Solid::block() + Solid::block().translate([1.0, 0.0, 0.0]), 2.0);
        check(Solid::block() & Solid::block().translate([1.0, 0.0, 0.0]), 0.0);
    }

    #[test]
    fn the_unbounded_has_no_mesh() {
        assert_eq!(mesh(&Solid::half_space(), Tolerance::default()).unwrap_err(), SpaceError::Unbounded);
    }

    #[test]
    fn deep_trees_are_no_trouble() {
        let deep = (0..200_000).fold(Solid::block(), |s, _| s.translate([1e-6, 0.0, 0.0]));
        check(deep, 1.0);
    }
}
