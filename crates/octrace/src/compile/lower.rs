//! From solids to programs over faces: primitives become intersections of them. Surfaces are found for them later.

use super::copies::{Kind, Operand, reach_of};
use super::draft::{Draft, Op, Value};
use super::faces::FaceList;
use super::facets::Faces;
use super::reliable::{add_walls, fence, reliable_bounds};
use super::swept::Swept;
use super::{Leaf, Program};
use crate::exec::CancelToken;
use crate::geom::{Affine, Bounds, Vec3};
use crate::model::{BoolOp, Node, PartId, Solid};
use crate::primitive::{Polyhedron, Primitive};
use crate::surface::{QuadricKind, TorusKind};
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
    cancel: CancelToken,
    pub faces: Faces,
    pub meshes: Vec<PendingMesh>,
    pub copies: Vec<PendingCopy>,
    pub literals: Vec<PendingLiteral>,
    pub leaves: Vec<Leaf>,
    pub(super) whole: Draft,
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

/// A primitive to be lowered.
struct Bare<'a> {
    primitive: &'a Primitive,
    map: &'a Affine,
    inverse: Affine,
    bounds: Bounds,
    leaf: u32,
    negated: bool,
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
    /// `snap` is the import tolerance relative to the size of everything bounded. After `cancel`, nothing that comes out is of
    /// any use.
    pub fn new(snap: f64, cancel: &CancelToken) -> Self {
        Self { snap, cancel: cancel.clone(), ..Self::default() }
    }

    /// What interrupts the work.
    pub fn cancel(&self) -> &CancelToken {
        &self.cancel
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
            _ if self.cancel.is_cancelled() => Lowered::constant(negated),
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
        let bare = Bare { primitive, map, inverse, bounds, leaf, negated };
        let Some(fence) = fence(&bounds, map, &inverse) else { return self.bare(&bare) };
        let mut all = self.whole.open(Op::And.under(negated));
        let lowered = self.bare(&bare);
        all.add(lowered.whole);
        let first_face = self.faces.len() as u32;
        add_walls(&mut self.faces, &fence);
        for face in first_face..self.faces.len() as u32 {
            let index = self.literals.len() as u32;
            self.literals.push(PendingLiteral { shape: Shape::Face(face), leaf });
            all.add(self.whole.literal(index, negated));
        }
        Lowered { whole: self.whole.close(all), ..lowered }
    }

    /// A primitive by its own surfaces.
    fn bare(&mut self, bare: &Bare) -> Lowered {
        let Bare { primitive, map, inverse, bounds, leaf, negated } = *bare;
        let first_face = self.faces.len();
        let mut faces = FaceList { map, inverse, faces: &mut self.faces };
        let mut mesh = None;
        match primitive {
            Primitive::Prism { profile, top } => {
                let whole = self.prism(profile, *top, &Swept { map, inverse, leaf, negated });
                return Lowered { whole, outer: Value::Constant(negated), bounds, bounded: bounds };
            }
            Primitive::Revolution(profile) => {
                let whole = self.revolution(profile, &Swept { map, inverse, leaf, negated });
                return Lowered { whole, outer: Value::Constant(negated), bounds, bounded: bounds };
            }
            Primitive::Block => faces.block(),
            Primitive::Sphere => faces.quadric(QuadricKind::Sphere, &Affine::IDENTITY, (-1.0, 1.0)),
            Primitive::Cylinder => {
                faces.quadric(QuadricKind::Cylinder, &Affine::IDENTITY, (0.0, 1.0));
                faces.cap(-Vec3::Z, 1.0, 0.0);
                faces.cap(Vec3::Z, 1.0, 1.0);
            }
            Primitive::Cone { top } => faces.cone(*top),
            Primitive::HalfSpace => faces.half_space(),
            Primitive::Torus { minor } => faces.torus(TorusKind::Outer, *minor, &Affine::IDENTITY),
            Primitive::Polyhedron(polyhedron) => {
                let size = Bounds::around(polyhedron.points().iter().copied()).diagonal();
                if !polyhedron.is_round() && polyhedron.is_convex(self.snap.max(1e-12) * size) {
                    faces.polyhedron(polyhedron);
                } else {
                    faces.faces.add_facets(polyhedron, map);
                    mesh = Some(polyhedron);
                }
                if faces.faces.len() == first_face {
                    return Lowered::constant(negated);
                }
            }
        }
        let faces = first_face..self.faces.len();
        let first_literal = self.literals.len() as u32;
        match mesh {
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
