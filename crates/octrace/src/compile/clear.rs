//! Which solids keep clear of everything else, by their boxes.

use super::census::with_stack;
use super::copies::Operand;
use super::reliable::reliable_bounds;
use crate::geom::{Affine, Bounds, Vec3};
use crate::model::{BoolOp, Node, Solid};
use crate::primitive::{Bvh, Primitive};
use crate::surface::{Plane, Surface};
use std::ops::ControlFlow;

/// By this part of its box's longest edge a copy is clear of everything else: then cells need not be much smaller than copies
/// to have one of them only.
const GAP: f64 = 1.0 / 16.0;

/// Which of those operands whose boxes are given are clear of all others. `snap` is the import tolerance relative to the size
/// of everything bounded.
pub(super) fn is_clear(operands: &[Operand], boxes: &[Option<Bounds>], snap: f64) -> Vec<bool> {
    let is_asked: Vec<bool> = boxes.iter().map(Option::is_some).collect();
    let box_of =
        |(operand, own): (&Operand, &Option<Bounds>)| own.unwrap_or_else(|| reach(operand.solid, &operand.map));
    let boxes: Vec<Bounds> = operands.iter().zip(boxes).map(box_of).collect();
    let numbers = (0..boxes.len() as u32).filter(|&i| !boxes[i as usize].is_empty());
    let (bounded, unbounded): (Vec<u32>, Vec<u32>) = numbers.partition(|&i| boxes[i as usize].is_bounded());
    let tree = Bvh::build(&bounded.iter().map(|&i| boxes[i as usize]).collect::<Vec<_>>());
    let Bounds { min, max } = tree.bounds();
    // Much more than the margin of cells, and than what is taken to coincide.
    let least = 1e-5_f64.max(8.0 * snap) * (max - min).max_abs() + 1e-9 * min.max_abs().max(max.max_abs());
    let is_clear = |number: usize| {
        let own = boxes[number];
        let gap = (GAP * own.size().max_abs()).max(least);
        let grown = own.grown(gap);
        let touches = |other: &Bounds| !grown.intersection(*other).is_empty();
        let stop = tree.visit(touches, |item| {
            let other = bounded[item as usize] as usize;
            match other != number && touches(&boxes[other]) {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        });
        stop.is_continue() && !unbounded.iter().any(|&other| touches(&boxes[other as usize]))
    };
    is_asked.iter().enumerate().map(|(number, &is_asked)| is_asked && is_clear(number)).collect()
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
