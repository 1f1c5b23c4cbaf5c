//! Equal solids that stand apart, found in the tree: they need be stored, compiled and classified only once.
//!
//! What comes in are the operands of the unions at the top of the tree. Those that are equal but for where they stand (the
//! same tree with the same numbers, moved by maps that differ in translation only) are copies of one solid, if they are so
//! many that it pays, and if the box of each keeps clear of whatever else there is: then nothing in it can coincide with
//! anything outside, and boolean algebra never has to look into it.

use super::lower::{Lowering, reliable_bounds};
use super::{Constant, Program, nesting};
use crate::geom::{Affine, Bounds, Vec3};
use crate::model::{BoolOp, Node, PartId, Solid};
use crate::primitive::{Bvh, Primitive};
use crate::surface::{Plane, Surface};
use rustc_hash::{FxHashMap, FxHasher};
use std::hash::Hasher;
use std::ops::ControlFlow;

/// What becomes of equal solids.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Copies {
    /// Where they are many and stand apart, they are stored once.
    #[default]
    Shared,
    /// Each is stored by itself.
    Apart,
}

/// So many copies at least are worth a prototype.
const FEWEST: u32 = 32;
/// By this part of its box's longest edge a copy is clear of everything else: then cells need not be much smaller than copies
/// to have one of them only.
const GAP: f64 = 1.0 / 16.0;
/// Programs that are nested deeper are not shared: what evaluates a copy does so within the stack that there is.
const DEEPEST: usize = 32;

/// Copies have so many numbers at most: words have room for 2³⁰.
const MOST_NUMBERS: usize = 1 << 29;

/// An operand of the unions at the top of a tree.
#[derive(Clone, Copy)]
pub(super) struct Operand<'a> {
    pub solid: &'a Solid,
    pub map: Affine,
    pub part: Option<PartId>,
    /// Which kind of solid it is a copy of.
    pub kind: Option<u32>,
}

/// A solid that has copies: lowered, but for where it stands.
pub(super) struct Kind {
    pub lowering: Lowering,
    pub program: Program,
}

/// How bodies are to be compiled.
pub(super) struct Plan<'a> {
    /// The operands of each body.
    pub bodies: Vec<Vec<Operand<'a>>>,
    pub kinds: Vec<Kind>,
}

/// Finds out what is to be shared; `None` where nothing is.
pub(super) fn plan(bodies: &[Solid], snap: f64) -> Option<Plan<'_>> {
    let mut count = 0;
    for body in bodies {
        visit(body, |_, is_union| {
            count += u32::from(!is_union);
            true
        });
    }
    if count < FEWEST {
        return None;
    }
    let mut census = Census::default();
    for body in bodies {
        visit(body, |operand, _| {
            census.count(&operand);
            true
        });
    }
    if census.counts.values().all(|&count| count < FEWEST) {
        return None;
    }
    let mut operands = Vec::new();
    let ends: Vec<usize> = (bodies.iter())
        .map(|body| {
            visit(body, |operand, is_union| {
                let goes_on = is_union && !census.is_frequent(&operand);
                if !goes_on {
                    operands.push(operand);
                }
                goes_on
            });
            operands.len()
        })
        .collect();
    let kinds = census.kinds(&mut operands, snap);
    if kinds.is_empty() {
        return None;
    }
    let mut start = 0;
    let body = |end: usize| operands[std::mem::replace(&mut start, end)..end].to_vec();
    Some(Plan { bodies: ends.into_iter().map(body).collect(), kinds })
}

/// Shows `meet` the unions at the top of a tree (`true`), and their operands, as far as it wants to go on into unions; in
/// source order.
fn visit<'a>(body: &'a Solid, mut meet: impl FnMut(Operand<'a>, bool) -> bool) {
    let mut pending = vec![Operand { solid: body, map: Affine::IDENTITY, part: None, kind: None }];
    while let Some(at) = pending.pop() {
        match at.solid.node() {
            Node::Empty => {}
            Node::Transform(inner, child) => pending.push(Operand { solid: child, map: at.map * *inner, ..at }),
            // Inner parts win.
            Node::Part(id, child) => pending.push(Operand { solid: child, part: Some(*id), ..at }),
            Node::Combine(BoolOp::Union, children) => {
                if meet(at, true) {
                    pending.extend(children.iter().rev().map(|solid| Operand { solid, ..at }));
                }
            }
            Node::Combine(..) | Node::Primitive(_) => _ = meet(at, false),
        }
    }
}

/// How often every solid occurs, but for where it stands.
#[derive(Default)]
struct Census {
    counts: FxHashMap<u64, u32>,
    /// Hashes of the operators that were seen, by their address.
    hashes: FxHashMap<usize, u64>,
}

impl Census {
    fn count(&mut self, operand: &Operand) {
        if let Some(key) = self.key(operand) {
            *self.counts.entry(key).or_default() += 1;
        }
    }

    fn is_frequent(&mut self, operand: &Operand) -> bool {
        self.key(operand).is_some_and(|key| self.counts.get(&key).is_some_and(|&count| count >= FEWEST))
    }

    /// A number that equal solids have in common, wherever they stand; none for what is too simple to be shared.
    fn key(&mut self, operand: &Operand) -> Option<u64> {
        let is_worth_it = matches!(operand.solid.node(), Node::Combine(..) | Node::Primitive(Primitive::Polyhedron(_)));
        is_worth_it.then(|| {
            let mut hasher = FxHasher::default();
            operand.map.rows.iter().for_each(|&row| hash_vector(&mut hasher, row));
            hasher.write_u64(self.hash(operand.solid));
            hasher.finish()
        })
    }

    fn hash(&mut self, solid: &Solid) -> u64 {
        let mut hasher = FxHasher::default();
        match solid.node() {
            Node::Empty => {}
            Node::Primitive(primitive) => hash_primitive(&mut hasher, primitive),
            Node::Transform(map, child) => {
                map.rows.iter().for_each(|&row| hash_vector(&mut hasher, row));
                hash_vector(&mut hasher, map.translation);
                hasher.write_u64(with_stack(|| self.hash(child)));
            }
            Node::Part(id, child) => {
                hasher.write_u32(id.0);
                hasher.write_u64(with_stack(|| self.hash(child)));
            }
            Node::Combine(op, children) => {
                if let Some(&known) = self.hashes.get(&solid.id()) {
                    return known;
                }
                hasher.write_u8(*op as u8 + 16);
                children.iter().for_each(|child| hasher.write_u64(with_stack(|| self.hash(child))));
                self.hashes.insert(solid.id(), hasher.finish());
            }
        }
        hasher.finish()
    }

    /// Decides which operands are copies of what.
    fn kinds(&mut self, operands: &mut [Operand], snap: f64) -> Vec<Kind> {
        // The frequent ones, by their first occurrence.
        let mut groups: Vec<Vec<u32>> = Vec::new();
        let mut group_of: FxHashMap<u64, usize> = FxHashMap::default();
        for (number, operand) in operands.iter().enumerate() {
            let Some(key) = self.key(operand).filter(|key| self.counts[key] >= FEWEST) else { continue };
            let group = *group_of.entry(key).or_insert(groups.len());
            if group == groups.len() {
                groups.push(Vec::new());
            }
            let first = groups[group].first().map(|&first| &operands[first as usize]);
            if first.is_none_or(|first| first.map.rows == operand.map.rows && same(first.solid, operand.solid)) {
                groups[group].push(number as u32);
            }
        }
        let mut candidates: Vec<(Kind, Vec<u32>)> = (groups.into_iter())
            .filter(|group| group.len() >= FEWEST as usize)
            .filter_map(|group| Some((Kind::of(&operands[group[0] as usize], snap)?, group)))
            .collect();
        if candidates.is_empty() {
            return Vec::new();
        }
        keep_clear(operands, &mut candidates);
        let mut kinds = Vec::new();
        let mut left = MOST_NUMBERS;
        for (kind, group) in candidates.into_iter().filter(|(_, group)| group.len() >= FEWEST as usize) {
            let Some(after) = left.checked_sub(kind.numbers() * group.len()) else { continue };
            left = after;
            group.iter().for_each(|&number| operands[number as usize].kind = Some(kinds.len() as u32));
            kinds.push(kind);
        }
        kinds
    }
}

impl Kind {
    /// How many numbers a copy needs at most.
    fn numbers(&self) -> usize {
        self.lowering.faces.len() + self.lowering.meshes.len() + self.lowering.literals.len()
    }

    /// Lowers a solid, if it can be shared.
    fn of(operand: &Operand, snap: f64) -> Option<Self> {
        let mut lowering = Lowering::new(snap);
        let map = Affine { translation: Vec3::ZERO, ..operand.map };
        let program = lowering.program_of(operand.solid, &map);
        let is_bounded = program.outer == Constant::Everywhere(false) && program.bounds.has_volume();
        let is_flat = matches!(&program.whole, Constant::Words(words) if nesting(words) <= DEEPEST);
        (is_bounded && is_flat && program.bounds.is_bounded()).then_some(Self { lowering, program })
    }
}

/// Takes from the groups what does not keep clear of everything else.
fn keep_clear(operands: &[Operand], candidates: &mut [(Kind, Vec<u32>)]) {
    let mut boxes = vec![None; operands.len()];
    for (kind, group) in candidates.iter() {
        for &number in group {
            boxes[number as usize] = Some(moved(&kind.program.bounds, operands[number as usize].map.translation));
        }
    }
    let reach =
        |(operand, found): (&Operand, Option<Bounds>)| found.unwrap_or_else(|| reach(operand.solid, &operand.map));
    let boxes: Vec<Bounds> = operands.iter().zip(boxes).map(reach).collect();
    let everything =
        boxes.iter().filter(|found| found.is_bounded()).fold(Bounds::EMPTY, |all, &found| all.union(found));
    // Much more than the margin of cells, and than what is taken to coincide.
    let least = 1e-5 * everything.size().max_abs() + 1e-9 * everything.min.max_abs().max(everything.max.max_abs());
    let (bounded, unbounded): (Vec<u32>, Vec<u32>) = (0..boxes.len() as u32)
        .filter(|&i| !boxes[i as usize].is_empty())
        .partition(|&i| boxes[i as usize].is_bounded());
    let tree = Bvh::build(&bounded.iter().map(|&i| boxes[i as usize]).collect::<Vec<_>>());
    let is_clear = |&number: &u32| {
        let own = boxes[number as usize];
        let gap = Vec3::splat((GAP * own.size().max_abs()).max(least));
        let grown = Bounds::new(own.min - gap, own.max + gap);
        let touches = |other: &Bounds| !grown.intersection(*other).is_empty();
        let stop = tree.visit(touches, |item| {
            let other = bounded[item as usize];
            match other != number && touches(&boxes[other as usize]) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        stop.is_continue() && !unbounded.iter().any(|&other| touches(&boxes[other as usize]))
    };
    for (_, group) in candidates {
        group.retain(is_clear);
    }
}

/// The box moved, a little larger than rounding may have it.
pub(super) fn moved(bounds: &Bounds, by: Vec3) -> Bounds {
    let (min, max) = (bounds.min + by, bounds.max + by);
    let off = Vec3::splat(8.0 * f64::EPSILON * min.max_abs().max(max.max_abs()).max(by.max_abs()));
    Bounds::new(min - off, max + off)
}

/// A box around a solid.
fn reach(solid: &Solid, map: &Affine) -> Bounds {
    match solid.node() {
        Node::Empty => Bounds::EMPTY,
        Node::Transform(inner, child) => with_stack(|| reach(child, &(*map * *inner))),
        Node::Part(_, child) => with_stack(|| reach(child, map)),
        Node::Primitive(primitive) => match (primitive, map.inverse()) {
            (_, None) => Bounds::EMPTY,
            (Primitive::HalfSpace, Some(inverse)) => half_space(map, &inverse),
            (_, Some(inverse)) => reliable_bounds(primitive, map, &inverse),
        },
        Node::Combine(op, children) => {
            let mut boxes = children.iter().map(|child| with_stack(|| reach(child, map)));
            match op {
                BoolOp::Union => boxes.fold(Bounds::EMPTY, Bounds::union),
                BoolOp::Intersection => boxes.fold(Bounds::ALL, Bounds::intersection),
                BoolOp::Difference => boxes.next().unwrap_or(Bounds::EMPTY),
            }
        }
    }
}

/// A box around the half-space z >= 0, moved: where its plane is along two axes, it is not all of space.
fn half_space(map: &Affine, inverse: &Affine) -> Bounds {
    let Some(normal) = inverse.transposed_vector(-Vec3::Z).normalized() else { return Bounds::ALL };
    let plane = Plane { normal, offset: normal.dot(map.translation) };
    Surface::Plane(plane).extents().0
}

/// Whether both are the same tree with the same numbers.
fn same(a: &Solid, b: &Solid) -> bool {
    if a.id() == b.id() {
        return true;
    }
    match (a.node(), b.node()) {
        (Node::Empty, Node::Empty) => true,
        (Node::Primitive(a), Node::Primitive(b)) => a == b,
        (Node::Transform(map, a), Node::Transform(other, b)) => map == other && with_stack(|| same(a, b)),
        (Node::Part(id, a), Node::Part(other, b)) => id == other && with_stack(|| same(a, b)),
        (Node::Combine(op, a), Node::Combine(other, b)) => {
            op == other && a.len() == b.len() && a.iter().zip(b).all(|(a, b)| with_stack(|| same(a, b)))
        }
        _ => false,
    }
}

fn with_stack<T>(work: impl FnOnce() -> T) -> T {
    stacker::maybe_grow(64 << 10, 4 << 20, work)
}

fn hash_vector(hasher: &mut FxHasher, v: Vec3) {
    // Adding zero turns -0 into 0.
    v.to_array().iter().for_each(|c| hasher.write_u64((c + 0.0).to_bits()));
}

fn hash_primitive(hasher: &mut FxHasher, primitive: &Primitive) {
    let (kind, size) = match primitive {
        Primitive::Block => (1, 0.0),
        Primitive::Sphere => (2, 0.0),
        Primitive::Cylinder => (3, 0.0),
        Primitive::HalfSpace => (4, 0.0),
        Primitive::Cone { top } => (5, *top),
        Primitive::Torus { minor } => (6, *minor),
        Primitive::Polyhedron(polyhedron) => {
            polyhedron.points().iter().for_each(|&point| hash_vector(hasher, point));
            (7, polyhedron.faces().len() as f64)
        }
    };
    hasher.write_u8(kind);
    hasher.write_u64((size + 0.0).to_bits());
}
