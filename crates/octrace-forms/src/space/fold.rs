//! Values of trees from values of their leaves, whatever the depth.

use super::leaves::is_nothing;
use octrace::model::Node;
use octrace::{Affine, BoolOp, Primitive, Solid};

/// The value of a solid: of a primitive, placed, by `leaf`; of a combination from those of its children by `combine`. The
/// empty solid, and what is too large or too thin to calculate with, is the union of nothing. Parts do not count.
pub(crate) fn fold<T>(
    solid: &Solid,
    mut leaf: impl FnMut(&Primitive, &Affine) -> T,
    mut combine: impl FnMut(BoolOp, Vec<T>) -> T,
) -> T {
    enum Step<'a> {
        Visit(Affine, &'a Solid),
        Combine(BoolOp, usize),
    }
    let mut pending = vec![Step::Visit(Affine::IDENTITY, solid)];
    let mut values = Vec::new();
    while let Some(step) = pending.pop() {
        match step {
            Step::Combine(op, count) => {
                let operands = values.split_off(values.len() - count);
                values.push(combine(op, operands));
            }
            Step::Visit(map, solid) => match solid.node() {
                Node::Empty => values.push(combine(BoolOp::Union, Vec::new())),
                Node::Primitive(primitive) if is_nothing(primitive, &map) => {
                    values.push(combine(BoolOp::Union, Vec::new()));
                }
                Node::Primitive(primitive) => values.push(leaf(primitive, &map)),
                Node::Transform(inner, child) => pending.push(Step::Visit(map * *inner, child)),
                Node::Part(_, child) => pending.push(Step::Visit(map, child)),
                Node::Combine(op, children) => {
                    pending.push(Step::Combine(*op, children.len()));
                    pending.extend(children.iter().rev().map(|child| Step::Visit(map, child)));
                }
            },
        }
    }
    values.pop().expect("each step leaves one value")
}
