//! Eight lines through the tree of a mesh.

use super::triangle::{Hits, Lines};
use crate::geom::Vec3;
use crate::primitive::{Below, BoxTree, Mesh, Node};
use crate::trace::tile::lanes::{F64s, Isa, Mask, Number, Vector};

/// Takes what is found.
pub(super) trait Find<I: Isa> {
    /// Lines pass through a triangle with that number.
    fn found(&mut self, hits: Hits<I>, number: u32);

    /// Parameters beyond which nothing is wanted any more.
    fn end(&self) -> F64s<I>;
}

/// Shows `find` where lines pass through triangles of a mesh, at parameters from 0 on: what is near comes early, no more than
/// that.
#[inline(always)]
pub(super) fn search<I: Isa, N: Number<I>>(mesh: &Mesh, lines: &Lines<I, N>, find: &mut impl Find<I>) {
    let (tree, frame) = (mesh.tree(), mesh.tree().frame());
    let nodes = tree.nodes();
    let zero = F64s::<I>::zero();
    let slopes = Slopes::new(lines, frame.center, frame.scale);
    let mut waiting = [0_u32; BoxTree::MOST_LEVELS];
    let mut count = usize::from(!nodes.is_empty());
    while count > 0 {
        count -= 1;
        let mut number = waiting[count] as usize;
        while let Some(node) = nodes.get(number) {
            let (near, far) = slopes.stretch(node, lines.signs);
            let here = lines.lanes & near.max(zero).le(far.min(find.end()));
            if !here.any() {
                break;
            }
            match node.below() {
                Below::Branch { second, axis } => {
                    let (first, second) = (number + 1, number + second as usize);
                    let (near, far) = if lines.signs >> axis & 1 == 0 { (first, second) } else { (second, first) };
                    waiting[count] = far as u32;
                    count += 1;
                    number = near;
                }
                Below::Leaf { first, count } => {
                    let (first, end) = (first as usize, (first + count) as usize);
                    for (place, triangle) in (first..end).zip(&mesh.triangles()[first..end]) {
                        let (hits, entering) = lines.crosses(mesh, triangle);
                        if hits.any() {
                            let t = lines.parameters(mesh, place);
                            let hits = hits & t.ge(zero) & t.le(find.end());
                            if hits.any() {
                                find.found(Hits { lanes: hits, entering, t }, triangle.number);
                            }
                        }
                    }
                    break;
                }
            }
        }
    }
}

/// Lines in the frame of a tree.
pub(super) struct Slopes<I: Isa, N> {
    origin: Vector<N>,
    inverse: [F64s<I>; 3],
}

impl<I: Isa, N: Number<I>> Slopes<I, N> {
    #[inline(always)]
    pub fn new(lines: &Lines<I, N>, center: Vec3, scale: f64) -> Self {
        let per_scale = N::from_one(1.0 / scale);
        let (o, d) = (lines.rays.origin.minus::<I>(center), lines.rays.direction);
        let origin = Vector::new(o.x * per_scale, o.y * per_scale, o.z * per_scale);
        let scale = F64s::splat(scale);
        Self { origin, inverse: [scale / d.x, scale / d.y, scale / d.z] }
    }

    /// Between which parameters the lines are in a node's box.
    #[inline(always)]
    pub fn stretch(&self, node: &Node, signs: usize) -> (F64s<I>, F64s<I>) {
        let Vector { x, y, z } = self.origin;
        let (x_near, x_far) = self.slab(node, 0, x, signs);
        let (y_near, y_far) = self.slab(node, 1, y, signs);
        let (z_near, z_far) = self.slab(node, 2, z, signs);
        // A line in one of the planes has no number there, and no bound.
        let (low, high) = (F64s::splat(f64::NEG_INFINITY), F64s::infinity());
        (low.max(x_near).max(y_near).max(z_near), high.min(x_far).min(y_far).min(z_far))
    }

    #[inline(always)]
    fn slab(&self, node: &Node, axis: usize, origin: N, signs: usize) -> (F64s<I>, F64s<I>) {
        let (low, high) = (f64::from(node.low[axis]), f64::from(node.high[axis]));
        let (near, far) = if signs >> axis & 1 == 0 { (low, high) } else { (high, low) };
        let at = |plane: f64| (N::from_one(plane) - origin).lanes() * self.inverse[axis];
        (at(near), at(far))
    }
}

/// The lanes that are certainly outside a mesh where they start.
#[inline(always)]
pub(super) fn start_outside<I: Isa, N: Number<I>>(mesh: &Mesh, lines: &Lines<I, N>) -> Mask<I> {
    let frame = mesh.tree().frame();
    match mesh.tree().nodes().first() {
        Some(root) => {
            let (near, far) = Slopes::new(lines, frame.center, frame.scale).stretch(root, lines.signs);
            near.gt(F64s::zero()) | far.lt(near) | far.lt(F64s::zero())
        }
        None => Mask::splat(true),
    }
}
