//! Equal solids that stand apart, found in the tree: they need be stored, compiled and classified only once.
//!
//! What comes in are the operands of the unions at the top of the tree. Those that are equal but for where they stand (the
//! same tree with the same numbers, moved by maps that differ in translation only) are copies of one solid, if they are so
//! many that it pays, and if the box of each keeps clear of whatever else there is: then nothing in it can coincide with
//! anything outside, and boolean algebra never has to look into it.

use super::census::{Census, same};
use super::clear::is_clear;
use super::lower::Lowering;
use super::{Constant, Program, nesting};
use crate::exec::CancelToken;
use crate::geom::{Affine, Bounds, Vec3};
use crate::model::{BoolOp, Node, PartId, Solid};
use rustc_hash::FxHashMap;

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
pub(super) const FEWEST: u32 = 32;
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
    /// A number that equal solids have in common; none for what is too simple to be shared.
    key: Option<u64>,
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
    /// The operands of all bodies, and where each body's end.
    operands: Vec<Operand<'a>>,
    ends: Vec<usize>,
    pub kinds: Vec<Kind>,
}

impl<'a> Plan<'a> {
    /// The operands of each body.
    pub fn bodies(&self) -> impl Iterator<Item = &[Operand<'a>]> {
        let starts = [0].into_iter().chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.operands[start..end])
    }
}

/// Finds out what is to be shared; `None` where nothing is, and after `cancel`.
pub(super) fn plan<'a>(bodies: &'a [Solid], snap: f64, cancel: &CancelToken) -> Option<Plan<'a>> {
    let mut count = 0;
    for body in bodies {
        visit(body, |_, is_union| {
            count += usize::from(!is_union);
            true
        });
    }
    if count < FEWEST as usize {
        return None;
    }
    let mut census = Census::default();
    let (mut operands, mut ends) = (Vec::with_capacity(count), Vec::new());
    for body in bodies {
        // The topmost union is all of the body, and no copy of anything.
        let mut is_topmost = true;
        visit(body, |operand, is_union| {
            match is_union {
                true if is_topmost => {}
                true => _ = census.count(operand.solid, &operand.map),
                false => operands.push(Operand { key: census.count(operand.solid, &operand.map), ..operand }),
            }
            is_topmost = false;
            !cancel.is_cancelled()
        });
        ends.push(operands.len());
    }
    if cancel.is_cancelled() || !census.has_frequent() {
        return None;
    }
    if census.has_frequent_unions() {
        operands.clear();
        ends.clear();
        for body in bodies {
            visit(body, |operand, is_union| {
                let key = census.key(operand.solid, &operand.map);
                let goes_on = is_union && !census.is_frequent(key);
                if !goes_on {
                    operands.push(Operand { key, ..operand });
                }
                goes_on
            });
            ends.push(operands.len());
        }
    }
    let kinds = kinds(&census, &mut operands, snap, cancel);
    if kinds.is_empty() { None } else { Some(Plan { operands, ends, kinds }) }
}

/// Shows `meet` the unions at the top of a tree (`true`), and their operands, as far as it wants to go on into unions; in
/// source order.
fn visit<'a>(body: &'a Solid, mut meet: impl FnMut(Operand<'a>, bool) -> bool) {
    let mut pending = vec![Operand { solid: body, map: Affine::IDENTITY, part: None, key: None, kind: None }];
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

/// Decides which operands are copies of what.
fn kinds(census: &Census, operands: &mut [Operand], snap: f64, cancel: &CancelToken) -> Vec<Kind> {
    let groups = groups(census, operands).into_iter().filter(|group| group.len() >= FEWEST as usize);
    let mut candidates: Vec<(Kind, Vec<u32>)> =
        groups.filter_map(|group| Some((Kind::of(&operands[group[0] as usize], snap, cancel)?, group))).collect();
    if cancel.is_cancelled() || candidates.is_empty() {
        return Vec::new();
    }
    let mut boxes: Vec<Option<Bounds>> = vec![None; operands.len()];
    for (kind, group) in &candidates {
        for &number in group {
            let by = operands[number as usize].map.translation;
            boxes[number as usize] = Some(reach_of(&kind.program.bounds, by));
        }
    }
    let is_clear = is_clear(operands, &boxes, snap);
    candidates.iter_mut().for_each(|(_, group)| group.retain(|&number| is_clear[number as usize]));
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

/// Parts those that are frequent into groups of equal ones, by their first occurrence.
fn groups(census: &Census, operands: &[Operand]) -> Vec<Vec<u32>> {
    /// Solids that differ, but not at a glance, are compared with so many others.
    const MOST_ALIKE: usize = 16;
    let mut groups: Vec<Vec<u32>> = Vec::new();
    let mut alike: FxHashMap<u64, Vec<usize>> = FxHashMap::default();
    for (number, operand) in operands.iter().enumerate() {
        let Some(key) = operand.key.filter(|_| census.is_frequent(operand.key)) else { continue };
        let alike = alike.entry(key).or_default();
        let equals = |group: &usize| {
            let first = &operands[groups[*group][0] as usize];
            first.map.rows == operand.map.rows && same(first.solid, operand.solid)
        };
        match alike.iter().copied().find(equals) {
            Some(group) => groups[group].push(number as u32),
            None if alike.len() < MOST_ALIKE => {
                alike.push(groups.len());
                groups.push(vec![number as u32]);
            }
            None => {}
        }
    }
    groups
}

impl Kind {
    /// How many numbers a copy needs at most.
    fn numbers(&self) -> usize {
        self.lowering.faces.len() + self.lowering.meshes.len() + self.lowering.literals.len()
    }

    /// Lowers a solid, if it can be shared.
    fn of(operand: &Operand, snap: f64, cancel: &CancelToken) -> Option<Self> {
        let mut lowering = Lowering::new(snap, cancel);
        let map = Affine { translation: Vec3::ZERO, ..operand.map };
        let program = lowering.program_of(operand.solid, &map);
        let is_bounded = program.outer == Constant::Everywhere(false) && program.bounds.has_volume();
        let is_flat = matches!(&program.whole, Constant::Words(words) if nesting(words) <= DEEPEST);
        (is_bounded && is_flat && program.bounds.is_bounded()).then_some(Self { lowering, program })
    }
}

/// The box of a copy of a solid, larger than any rounding may have what is in it: rays that miss it meet nothing.
pub(super) fn reach_of(bounds: &Bounds, by: Vec3) -> Bounds {
    let (min, max) = (bounds.min + by, bounds.max + by);
    let farthest = min.max_abs().max(max.max_abs()).max(by.max_abs());
    Bounds::new(min, max).grown(1e-8 * bounds.size().max_abs() + 1e-12 * farthest)
}
