//! Which solids keep their own boundary when light passes through them.
//!
//! A union has no surfaces inside. That is right for opaque solids, but a ball seen through a block of glass, or glass
//! that stands on a floor, must keep its boundary. So the operands of the unions at the top of the tree are sorted: what
//! is opaque makes one body, and each transparent material another.

use super::{BoolOp, Node, PartId, Scene, Solid};
use crate::geom::Affine;
use std::collections::BTreeMap;

/// The bodies of a scene.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// A solid for each body: the opaque one first, if there is any; in the end the union of all is the scene's solid.
    pub solids: Vec<Solid>,
    /// The index of refraction inside each body.
    pub ior: Vec<f64>,
    /// Whether no light passes anything that a body is made of.
    pub opaque: Vec<bool>,
}

impl Scene {
    /// Sorts the scene's solid into bodies. Where all is opaque that is one body: the solid as it stands.
    pub fn bodies(&self) -> Bodies {
        let transparent = |part: &super::Part| part.material.is_transparent();
        if !self.parts.iter().any(transparent) {
            return Bodies { solids: vec![self.solid.clone()], ior: vec![1.0], opaque: vec![true] };
        }
        let mut opaque = Vec::new();
        let mut clear: BTreeMap<PartId, Vec<Solid>> = BTreeMap::new();
        let mut pending = vec![(&self.solid, Affine::IDENTITY, None)];
        while let Some((solid, map, part)) = pending.pop() {
            match solid.node() {
                Node::Empty => {}
                Node::Transform(inner, child) => pending.push((child, map * *inner, part)),
                Node::Part(id, child) => pending.push((child, map, Some(*id))),
                Node::Combine(BoolOp::Union, children) => {
                    pending.extend(children.iter().rev().map(|child| (child, map, part)));
                }
                Node::Combine(..) | Node::Primitive(_) => {
                    let placed = solid.clone().transform(map);
                    let placed = match part {
                        Some(id) => placed.part(id),
                        None => placed,
                    };
                    match first_part(solid, part) {
                        Some(id) if self.material(Some(id)).is_transparent() => {
                            clear.entry(id).or_default().push(placed);
                        }
                        _ => opaque.push(placed),
                    }
                }
            }
        }
        let mut bodies = Bodies { solids: Vec::new(), ior: Vec::new(), opaque: Vec::new() };
        if !opaque.is_empty() {
            let is_opaque = opaque.iter().all(|solid| self.is_opaque(solid));
            bodies.solids.push(Solid::union(opaque));
            bodies.ior.push(1.0);
            bodies.opaque.push(is_opaque);
        }
        for (id, solids) in clear {
            bodies.solids.push(Solid::union(solids));
            bodies.ior.push(self.material(Some(id)).ior);
            bodies.opaque.push(false);
        }
        bodies
    }

    /// Whether no light passes anything that a solid is made of.
    fn is_opaque(&self, solid: &Solid) -> bool {
        let mut pending = vec![solid];
        while let Some(solid) = pending.pop() {
            match solid.node() {
                Node::Empty | Node::Primitive(_) => {}
                Node::Part(id, _) if self.material(Some(*id)).is_transparent() => return false,
                Node::Transform(_, child) | Node::Part(_, child) => pending.push(child),
                Node::Combine(_, children) => pending.extend(children),
            }
        }
        true
    }
}

/// The part of the first leaf: in a difference that of what is cut, not of the tool.
fn first_part(solid: &Solid, mut part: Option<PartId>) -> Option<PartId> {
    let mut solid = solid;
    loop {
        match solid.node() {
            Node::Empty | Node::Primitive(_) => return part,
            Node::Part(id, child) => {
                part = Some(*id);
                solid = child;
            }
            Node::Transform(_, child) => solid = child,
            Node::Combine(_, children) => match children.first() {
                Some(first) => solid = first,
                None => return part,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Material, Part, Rgb};

    #[test]
    fn glass_keeps_its_boundary_and_its_place() {
        let glass = Part { material: Material::glass(Rgb::WHITE) };
        let ball = Solid::sphere().part(PartId(0));
        let solid = Solid::union([ball.clone() - Solid::block(), Solid::block(), ball]).translate([1.0, 0.0, 0.0]);
        let scene = Scene { parts: vec![glass], ..Scene::new(solid) };
        let bodies = scene.bodies();
        assert_eq!(bodies.ior, [1.0, 1.5]);
        let Node::Combine(BoolOp::Union, clear) = bodies.solids[1].node() else { panic!("two glass solids") };
        assert_eq!(clear.len(), 2);
    }

    #[test]
    fn a_solid_that_glass_was_cut_from_is_not_opaque() {
        let parts =
            vec![Part { material: Material::glass(Rgb::WHITE) }, Part { material: Material::matte(Rgb::WHITE) }];
        let opaque = |solid: Solid| Scene { parts: parts.clone(), ..Scene::new(solid) }.bodies().opaque;
        let (glass, matte) = (Solid::sphere().part(PartId(0)), Solid::block().part(PartId(1)));
        assert_eq!(opaque(matte.clone()), [true]);
        assert_eq!(opaque(glass.clone() + matte.clone()), [true, false]);
        assert_eq!(opaque(matte - glass), [false]);
    }
}
