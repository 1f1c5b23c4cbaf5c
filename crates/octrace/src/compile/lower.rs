//! From solids to programs over faces: primitives become intersections of them. Surfaces are found for them later.

use super::copies::{Kind, Operand, reach_of};
use super::draft::{Draft, Op, Value};
use super::face::Face;
use super::{Leaf, Program};
use crate::geom::{Affine, Bounds, Vec3};
use crate::model::{BoolOp, Node, PartId, Solid};
use crate::primitive::{FacePlane, Polyhedron, Primitive};
use crate::surface::{Plane, QuadricKind};
use std::sync::Arc;

/// What came of a subtree.
struct Lowered {
    /// Its program.
    whole: Value,
    /// What is left of the program far away from everything bounded.
    outer: Value,
    /// A box around the solid (around what it is the complement of, where it is negated).
    bounds: Bounds,
    /// A box around every maximal bounded part of it.
    bounded: Bounds,
}

impl Lowered {
    /// Everything or nothing.
    fn constant(inside: bool) -> Self {
        let constant = Value::Constant(inside);
        Self { whole: constant, outer: constant, bounds: Bounds::EMPTY, bounded: Bounds::EMPTY }
    }
}

/// Programs whose literals have no surfaces yet.
#[derive(Default)]
pub(super) struct Lowering {
    snap: f64,
    pub faces: Vec<Face>,
    pub meshes: Vec<PendingMesh>,
    pub copies: Vec<PendingCopy>,
    pub literals: Vec<PendingLiteral>,
    pub leaves: Vec<Leaf>,
    whole: Draft,
    outer: Draft,
}

/// A literal whose surface is not known yet.
pub(super) struct PendingLiteral {
    pub shape: Shape,
    pub leaf: u32,
}

#[derive(Clone, Copy)]
pub(super) enum Shape {
    /// Index into [`Lowering::faces`].
    Face(u32),
    /// Index into [`Lowering::meshes`].
    Mesh(u32),
    /// Index into [`Lowering::copies`].
    Copy(u32),
}

/// A polyhedron to be made a mesh when its faces have surfaces.
pub(super) struct PendingMesh {
    pub polyhedron: Arc<Polyhedron>,
    pub map: Affine,
    /// Its faces with an area are those of [`Lowering::faces`] from here on.
    pub first_face: usize,
}

/// One of many places of a solid.
#[derive(Clone, Copy)]
pub(super) struct PendingCopy {
    pub kind: u32,
    pub offset: Vec3,
    /// See [`Placed::bounds`](crate::surface::Placed).
    pub bounds: Bounds,
    pub first_leaf: u32,
}

impl Lowering {
    /// `snap` is the import tolerance relative to the size of everything bounded.
    pub fn new(snap: f64) -> Self {
        Self { snap, ..Self::default() }
    }

    /// Lowers a body, moved by `map`.
    pub fn program_of(&mut self, body: &Solid, map: &Affine) -> Program {
        let lowered = self.solid(body, map, None, false);
        self.finish(lowered)
    }

    /// Lowers a body that is the union of those operands; of what has copies, only where they are.
    pub fn program_of_union(&mut self, operands: &[Operand], kinds: &[Kind]) -> Program {
        let (mut whole, mut outer) = (self.whole.open(Op::Or), self.outer.open(Op::Or));
        let (mut bounds, mut bounded) = (Bounds::EMPTY, Bounds::EMPTY);
        for operand in operands {
            let lowered = match operand.kind {
                None => self.solid(operand.solid, &operand.map, operand.part, false),
                Some(kind) => self.copy(operand, kind, &kinds[kind as usize]),
            };
            whole.add(lowered.whole);
            outer.add(lowered.outer);
            bounds = bounds.union(lowered.bounds);
            bounded = bounded.union(lowered.bounded);
        }
        let whole = self.whole.close(whole);
        let outer = match bounds.is_bounded() {
            true => self.outer.close_as(outer, false),
            false => self.outer.close(outer),
        };
        self.finish(Lowered { whole, outer, bounds, bounded })
    }

    fn finish(&mut self, lowered: Lowered) -> Program {
        let whole = self.whole.finish(lowered.whole);
        Program { whole, outer: self.outer.finish(lowered.outer), bounds: lowered.bounded }
    }

    /// One of many places of a solid: a literal.
    fn copy(&mut self, operand: &Operand, kind: u32, solid: &Kind) -> Lowered {
        let leaf = self.leaves.len() as u32;
        // Inner parts win.
        self.leaves.extend(solid.lowering.leaves.iter().map(|leaf| Leaf { part: leaf.part.or(operand.part) }));
        let offset = operand.map.translation;
        let Bounds { min, max } = solid.program.bounds;
        let bounds = Bounds::new(min + offset, max + offset);
        let index = self.literals.len() as u32;
        self.literals.push(PendingLiteral { shape: Shape::Copy(self.copies.len() as u32), leaf });
        self.copies.push(PendingCopy {
            kind,
            offset,
            bounds: reach_of(&solid.program.bounds, offset),
            first_leaf: leaf,
        });
        let whole = self.whole.literal(index, false);
        Lowered { whole, outer: Value::Constant(false), bounds, bounded: bounds }
    }

    /// Lowers a solid; `negated` asks for its complement.
    fn solid(&mut self, solid: &Solid, map: &Affine, part: Option<PartId>, negated: bool) -> Lowered {
        const RED_ZONE: usize = 64 << 10;
        const SEGMENT: usize = 4 << 20;
        stacker::maybe_grow(RED_ZONE, SEGMENT, || match solid.node() {
            Node::Empty => Lowered::constant(negated),
            Node::Transform(inner, child) => self.solid(child, &(*map * *inner), part, negated),
            Node::Part(id, child) => {
                // Inner parts win: the first that is set, seen from the leaf.
                self.solid(child, map, Some(*id), negated)
            }
            Node::Combine(op, children) => self.combine(*op, children, map, part, negated),
            Node::Primitive(primitive) => self.primitive(primitive, map, part, negated),
        })
    }

    fn combine(
        &mut self,
        op: BoolOp,
        children: &[Solid],
        map: &Affine,
        part: Option<PartId>,
        negated: bool,
    ) -> Lowered {
        let expr_op = if op == BoolOp::Union { Op::Or } else { Op::And }.under(negated);
        let (mut whole, mut outer) = (self.whole.open(expr_op), self.outer.open(expr_op));
        let mut bounds = if op == BoolOp::Intersection { Bounds::ALL } else { Bounds::EMPTY };
        let mut bounded = Bounds::EMPTY;
        for (i, child) in children.iter().enumerate() {
            let child = self.solid(child, map, part, negated ^ (op == BoolOp::Difference && i > 0));
            whole.add(child.whole);
            outer.add(child.outer);
            bounded = bounded.union(child.bounded);
            match op {
                BoolOp::Union => bounds = bounds.union(child.bounds),
                BoolOp::Intersection => bounds = bounds.intersection(child.bounds),
                BoolOp::Difference if i == 0 => bounds = child.bounds,
                BoolOp::Difference => {}
            }
        }
        if op == BoolOp::Intersection && !bounds.has_volume() {
            // Boxes that only touch, or not even that, hold nothing in common.
            self.whole.close_as(whole, negated);
            self.outer.close_as(outer, negated);
            return Lowered::constant(negated);
        }
        let whole = self.whole.close(whole);
        if bounds.is_bounded() {
            return Lowered { whole, outer: self.outer.close_as(outer, negated), bounds, bounded: bounds };
        }
        Lowered { whole, outer: self.outer.close(outer), bounds, bounded }
    }

    fn primitive(&mut self, primitive: &Primitive, map: &Affine, part: Option<PartId>, negated: bool) -> Lowered {
        // Products of invertible maps may still be flat to working precision, or overflow.
        let Some(inverse) = map.inverse() else {
            return Lowered::constant(negated);
        };
        let bounds = reliable_bounds(primitive, map, &inverse);
        if primitive.exceeds_numbers(&bounds, &inverse) {
            return Lowered::constant(negated);
        }
        let leaf = self.leaves.len() as u32;
        self.leaves.push(Leaf { part });
        let first_face = self.faces.len();
        let mut faces = FaceList { map, inverse, faces: &mut self.faces };
        let mut concave = None;
        match primitive {
            Primitive::Block => faces.block(),
            Primitive::Sphere => faces.quadric(QuadricKind::Sphere, &Affine::IDENTITY, (-1.0, 1.0)),
            Primitive::Cylinder => {
                faces.quadric(QuadricKind::Cylinder, &Affine::IDENTITY, (0.0, 1.0));
                faces.cap(-Vec3::Z, 1.0, 0.0);
                faces.cap(Vec3::Z, 1.0, 1.0);
            }
            Primitive::Cone { top } => faces.cone(*top),
            Primitive::HalfSpace => faces.half_space(),
            Primitive::Torus { minor } => faces.torus(*minor),
            Primitive::Polyhedron(polyhedron) => {
                faces.polyhedron(polyhedron);
                if faces.faces.len() == first_face {
                    return Lowered::constant(negated);
                }
                let size = Bounds::around(polyhedron.points().iter().copied()).diagonal();
                if !polyhedron.is_convex(self.snap.max(1e-12) * size) {
                    concave = Some(polyhedron);
                }
            }
        }
        let faces = first_face..self.faces.len();
        let first_literal = self.literals.len() as u32;
        match concave {
            Some(polyhedron) => {
                let mesh = PendingMesh { polyhedron: Arc::clone(polyhedron), map: *map, first_face };
                self.meshes.push(mesh);
                self.literals.push(PendingLiteral { shape: Shape::Mesh(self.meshes.len() as u32 - 1), leaf });
            }
            None => self.literals.extend(faces.map(|face| {
                let shape = Shape::Face(face as u32);
                PendingLiteral { shape, leaf }
            })),
        }
        let literals = first_literal..self.literals.len() as u32;
        let mut whole = self.whole.open(Op::And.under(negated));
        for index in literals.clone() {
            whole.add(self.whole.literal(index, negated));
        }
        let whole = self.whole.close(whole);
        let is_bounded = bounds.is_bounded();
        let outer = match literals.len() {
            1 if !is_bounded => self.outer.literal(first_literal, negated),
            _ => Value::Constant(negated),
        };
        Lowered { whole, outer, bounds, bounded: if is_bounded { bounds } else { Bounds::EMPTY } }
    }
}

/// A box around the primitive as its surfaces have it, which know the inverse only. Of a map that squashes space at an
/// angle the inverse is imprecise: what that does to the primitive's points, moved there and back, comes on top.
pub(super) fn reliable_bounds(primitive: &Primitive, map: &Affine, inverse: &Affine) -> Bounds {
    let bounds = primitive.bounds(map);
    let local = primitive.bounds(&Affine::IDENTITY);
    if !local.is_bounded() {
        return bounds;
    }
    let apply = |affine: &Affine, to: Vec3| Vec3::from(affine.rows.map(|row| row.abs().dot(to)));
    let farthest = local.min.abs().max(local.max.abs());
    let there_and_back = apply(inverse, apply(map, farthest) + map.translation.abs());
    let off = apply(map, there_and_back * (8.0 * f64::EPSILON));
    // The margins of cells cover the usual.
    let usual = 1e-9 * bounds.size().max_abs() + 1e-13 * bounds.min.max_abs().max(bounds.max.max_abs());
    if off.max_abs() <= usual { bounds } else { Bounds::new(bounds.min - off, bounds.max + off) }
}

/// The faces of one primitive, moved to the scene by `map`.
struct FaceList<'a> {
    map: &'a Affine,
    inverse: Affine,
    faces: &'a mut Vec<Face>,
}

impl FaceList<'_> {
    /// A planar face with the given outward normal, in local coordinates, through four corners.
    fn plane(&mut self, normal: Vec3, corners: [Vec3; 4]) {
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

    fn block(&mut self) {
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
    fn cap(&mut self, normal: Vec3, radius: f64, z: f64) {
        let corners = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
        self.plane(normal, corners.map(|(x, y)| Vec3::new(x * radius, y * radius, z)));
    }

    /// The side is a part of the double cone X² + Y² < Z² with Z = 1 - (1 - top) z.
    fn cone(&mut self, top: f64) {
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
    fn polyhedron(&mut self, polyhedron: &Polyhedron) {
        let mirrored = self.map.determinant() < 0.0;
        for face in polyhedron.faces() {
            let mut corners: Vec<Vec3> =
                face.iter().map(|&i| self.map.point(polyhedron.points()[i as usize])).collect();
            if mirrored {
                corners.reverse();
            }
            if let Some(fit) = FacePlane::fit(&corners) {
                let plane = Plane { normal: fit.normal, offset: fit.normal.dot(fit.point) };
                let some = [0, 1, 2, 3].map(|i| corners[i * corners.len() / 4]);
                self.faces.push(Face::Plane { plane, corners: some });
            }
        }
    }

    /// The half-space z >= 0.
    fn half_space(&mut self) {
        let on_plane = self.map.point(Vec3::ZERO);
        if let Some(plane) = self.moved_plane(-Vec3::Z, &[on_plane]) {
            self.faces.push(Face::Unbounded { plane });
        }
    }

    fn torus(&mut self, minor: f64) {
        self.faces.push(Face::Torus { minor, map: *self.map, to_local: self.inverse });
    }

    /// A quadric; `placed` takes its own coordinates to those of the primitive.
    fn quadric(&mut self, kind: QuadricKind, placed: &Affine, heights: (f64, f64)) {
        let map = *self.map * *placed;
        if let Some(from_primitive) = placed.inverse() {
            let to_local = from_primitive * self.inverse;
            self.faces.push(Face::Quadric { kind, map, to_local, heights });
        }
    }
}
