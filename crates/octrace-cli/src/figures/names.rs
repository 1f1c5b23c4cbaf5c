//! What the primitives of a scene are called in figures: their kind, and their number in source order.

use crate::tree;
use octrace::model::Node;
use octrace::{Scene, Solid};
use std::collections::{HashMap, VecDeque};

/// The primitives of a solid in source order, as nodes of the tree.
fn leaves(solid: &Solid) -> Vec<&Solid> {
    let (mut leaves, mut pending) = (Vec::new(), vec![solid]);
    while let Some(solid) = pending.pop() {
        match solid.node() {
            Node::Empty => {}
            Node::Primitive(_) => leaves.push(solid),
            Node::Transform(_, child) | Node::Part(_, child) => pending.push(child),
            Node::Combine(_, children) => pending.extend(children.iter().rev()),
        }
    }
    leaves
}

/// How many primitives a solid has.
pub fn count(solid: &Solid) -> usize {
    leaves(solid).len()
}

/// The name of primitive number `leaf`.
pub fn name(solid: &Solid, leaf: usize) -> String {
    format!("{} {leaf}", tree::name(solid.node()))
}

/// The names of a solid's primitives.
pub fn of_solid(solid: &Solid) -> Vec<String> {
    leaves(solid).iter().enumerate().map(|(leaf, solid)| name(solid, leaf)).collect()
}

/// The names of the primitives in the order in which the scene's bodies have them.
pub fn of_bodies(scene: &Scene, bodies: &[Solid]) -> Vec<String> {
    let mut numbers: HashMap<usize, VecDeque<String>> = HashMap::new();
    for (leaf, solid) in leaves(&scene.solid).into_iter().enumerate() {
        numbers.entry(solid.id()).or_default().push_back(name(solid, leaf));
    }
    let name = |solid: &Solid| numbers.get_mut(&solid.id()).and_then(VecDeque::pop_front);
    bodies.iter().flat_map(leaves).map(name).map(Option::unwrap_or_default).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::{Material, Part, PartId, Rgb};

    #[test]
    fn bodies_are_sorted_but_numbers_stay() {
        let glass = Part { material: Material::glass(Rgb::WHITE) };
        let solid = Solid::union([Solid::sphere().part(PartId(0)), Solid::block() - Solid::cylinder()]);
        let scene = Scene { parts: vec![glass], ..Scene::new(solid) };
        assert_eq!(of_solid(&scene.solid), ["sphere 0", "block 1", "cylinder 2"]);
        assert_eq!(of_bodies(&scene, &scene.bodies().solids), ["block 1", "cylinder 2", "sphere 0"]);
    }
}
