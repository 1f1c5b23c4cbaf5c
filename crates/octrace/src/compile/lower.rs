//! From solids to programs: primitives become intersections of surfaces, coincident surfaces one.

use super::expr::{Expr, Op};
use super::intern::{Face, intern};
use super::{Catalog, CompileReport, Constant, Leaf, Literal, Program, Word};
use crate::geom::{Affine, Bounds, Vec3};
use crate::model::{BoolOp, Node, PartId, Solid};
use crate::primitive::Primitive;
use crate::surface::{Plane, QuadricKind};

/// Everything about some bodies that does not depend on where one looks.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// What the programs refer to.
    pub catalog: Catalog,
    /// A program for each body.
    pub bodies: Vec<Program>,
    /// What joining coincident surfaces did.
    pub report: CompileReport,
}

/// Compiles bodies that share their surfaces. `snap` is the import tolerance relative to the size of everything bounded.
///
/// # Panics
/// If there are more than 2³⁰ uses of surfaces.
pub fn compile(bodies: &[Solid], snap: f64) -> Compiled {
    let mut lowering = Lowering::default();
    let lowered: Vec<Lowered> =
        bodies.iter().map(|body| lowering.solid(body, &Affine::IDENTITY, None, false)).collect();
    let extent = lowered.iter().fold(Bounds::EMPTY, |all, body| all.union(body.bounded));

    let mut catalog = Catalog { leaves: lowering.leaves, ..Catalog::default() };
    let (refs, report) = intern(&lowering.faces, &extent, snap, &mut catalog.surfaces);
    catalog.literals = std::iter::zip(&lowering.literal_leaves, &refs)
        .map(|(&leaf, face)| Literal { surface: face.surface, leaf })
        .collect();
    assert!(catalog.literals.len() <= Word::MAX_PAYLOAD as usize, "a program has room for 2^30 uses of surfaces");

    // Faces stored the other way round turn their literals' signs.
    let orient = |program: Expr| -> Constant {
        match program.into_words() {
            Constant::Words(mut words) => {
                for word in &mut words {
                    if let Word::Literal { index, negated } = Word::decode(*word) {
                        *word = Word::Literal { index, negated: negated ^ refs[index as usize].flipped }.encode();
                    }
                }
                Constant::Words(words)
            }
            constant => constant,
        }
    };
    let bodies = lowered
        .into_iter()
        .map(|body| Program { whole: orient(body.whole), outer: orient(body.outer), bounds: body.bounded })
        .collect();
    Compiled { catalog, bodies, report }
}

/// A subtree, lowered.
struct Lowered {
    /// Its program.
    whole: Expr,
    /// What is left of the program far away from everything bounded.
    outer: Expr,
    /// A box around the solid (around what it is the complement of, where it is negated).
    bounds: Bounds,
    /// A box around every maximal bounded part of it.
    bounded: Bounds,
}

#[derive(Default)]
struct Lowering {
    faces: Vec<Face>,
    /// The leaf of each face's literal; literals and faces are the same before interning.
    literal_leaves: Vec<u32>,
    leaves: Vec<Leaf>,
}

impl Lowering {
    /// Lowers a solid; `negated` asks for its complement.
    fn solid(&mut self, solid: &Solid, map: &Affine, part: Option<PartId>, negated: bool) -> Lowered {
        const RED_ZONE: usize = 64 << 10;
        const SEGMENT: usize = 4 << 20;
        stacker::maybe_grow(RED_ZONE, SEGMENT, || match solid.node() {
            Node::Empty => Lowered {
                whole: Expr::Constant(negated),
                outer: Expr::Constant(negated),
                bounds: Bounds::EMPTY,
                bounded: Bounds::EMPTY,
            },
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
        let children: Vec<Lowered> = children
            .iter()
            .enumerate()
            .map(|(i, child)| self.solid(child, map, part, negated ^ (op == BoolOp::Difference && i > 0)))
            .collect();
        let bounds = match op {
            BoolOp::Union => children.iter().fold(Bounds::EMPTY, |all, c| all.union(c.bounds)),
            BoolOp::Intersection => children.iter().fold(Bounds::ALL, |all, c| all.intersection(c.bounds)),
            BoolOp::Difference => children.first().map_or(Bounds::EMPTY, |c| c.bounds),
        };
        let bounds = if bounds.is_empty() { Bounds::EMPTY } else { bounds };
        let expr_op = if op == BoolOp::Union { Op::Or } else { Op::And }.under(negated);
        let bounded = match bounds.is_bounded() {
            true => bounds,
            false => children.iter().fold(Bounds::EMPTY, |all, c| all.union(c.bounded)),
        };
        let (wholes, outers): (Vec<Expr>, Vec<Expr>) = children.into_iter().map(|c| (c.whole, c.outer)).unzip();
        let whole = Expr::combine(expr_op, wholes);
        let outer = if bounds.is_bounded() { Expr::Constant(negated) } else { Expr::combine(expr_op, outers) };
        Lowered { whole, outer, bounds, bounded }
    }

    fn primitive(&mut self, primitive: &Primitive, map: &Affine, part: Option<PartId>, negated: bool) -> Lowered {
        let nothing = |whole: bool| Lowered {
            whole: Expr::Constant(whole),
            outer: Expr::Constant(whole),
            bounds: Bounds::EMPTY,
            bounded: Bounds::EMPTY,
        };
        // Products of invertible maps may still be flat to working precision, or overflow.
        let Some(inverse) = map.inverse() else {
            return nothing(negated);
        };
        let leaf = self.leaves.len() as u32;
        self.leaves.push(Leaf { part });
        let mut faces = FaceList { map, inverse, faces: Vec::new() };
        match primitive {
            Primitive::Block => faces.block(),
            Primitive::Sphere => faces.quadric(QuadricKind::Sphere, &Affine::IDENTITY, (-1.0, 1.0)),
            Primitive::Cylinder => {
                faces.quadric(QuadricKind::Cylinder, &Affine::IDENTITY, (0.0, 1.0));
                faces.cap(Vec3::Z, -1.0, 1.0, 0.0);
                faces.cap(Vec3::Z, 1.0, 1.0, 1.0);
            }
            Primitive::Cone { top } => {
                // The double cone X² + Y² < Z² with Z = 1 - (1 - top) z.
                let slope = 1.0 - top;
                let from_cone = Affine {
                    translation: Vec3::new(0.0, 0.0, 1.0 / slope),
                    ..Affine::scale(Vec3::new(1.0, 1.0, -1.0 / slope))
                };
                faces.quadric(QuadricKind::Cone, &from_cone, (1.0, (1.0 + top) / 2.0));
                faces.cap(Vec3::Z, -1.0, 1.0, 0.0);
                faces.cap(Vec3::Z, 1.0, top.max(0.5), 1.0);
            }
            Primitive::HalfSpace => faces.half_space(),
            Primitive::Torus { .. } => return nothing(negated),
            Primitive::Polyhedron(_) => return nothing(negated),
        }
        let literals: Vec<Expr> = faces
            .faces
            .into_iter()
            .map(|face| {
                let index = self.faces.len() as u32;
                self.faces.push(face);
                self.literal_leaves.push(leaf);
                Expr::Literal { index, negated }
            })
            .collect();
        let bounds = primitive.bounds(map);
        let outer = match (bounds.is_bounded(), &literals[..]) {
            (false, &[Expr::Literal { index, negated }]) => Expr::Literal { index, negated },
            _ => Expr::Constant(negated),
        };
        let bounded = if bounds.is_bounded() { bounds } else { Bounds::EMPTY };
        Lowered { whole: Expr::combine(Op::And.under(negated), literals), outer, bounds, bounded }
    }
}

/// The faces of one primitive, moved to the scene by `map`.
struct FaceList<'a> {
    map: &'a Affine,
    inverse: Affine,
    faces: Vec<Face>,
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

    /// A disc perpendicular to z, its normal `axis * sign`.
    fn cap(&mut self, axis: Vec3, sign: f64, radius: f64, z: f64) {
        let corners = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
        self.plane(axis * sign, corners.map(|(x, y)| Vec3::new(x * radius, y * radius, z)));
    }

    /// The half-space z >= 0.
    fn half_space(&mut self) {
        let on_plane = self.map.point(Vec3::ZERO);
        if let Some(plane) = self.moved_plane(-Vec3::Z, &[on_plane]) {
            self.faces.push(Face::Unbounded { plane });
        }
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
