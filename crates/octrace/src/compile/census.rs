//! How often every solid occurs, but for where it stands.

use super::copies::FEWEST;
use crate::geom::{Affine, Vec3};
use crate::model::{BoolOp, Node, Solid};
use crate::primitive::{Primitive, Profile};
use rustc_hash::{FxHashMap, FxHasher};
use std::hash::Hasher;

/// Counts solids.
#[derive(Default)]
pub(super) struct Census {
    counts: FxHashMap<u64, u32>,
    /// The keys of unions.
    unions: Vec<u64>,
    /// Hashes of unions, by their address: one may be in another, again and again.
    hashes: FxHashMap<usize, u64>,
}

impl Census {
    /// Counts a solid that `map` moves; returns its key.
    pub fn count(&mut self, solid: &Solid, map: &Affine) -> Option<u64> {
        let key = self.key(solid, map)?;
        *self.counts.entry(key).or_default() += 1;
        if matches!(solid.node(), Node::Combine(BoolOp::Union, _)) {
            self.unions.push(key);
        }
        Some(key)
    }

    /// Whether there are many solids with that key.
    pub fn is_frequent(&self, key: Option<u64>) -> bool {
        key.is_some_and(|key| self.counts.get(&key).is_some_and(|&count| count >= FEWEST))
    }

    /// Whether there are many solids with any key.
    pub fn has_frequent(&self) -> bool {
        self.counts.values().any(|&count| count >= FEWEST)
    }

    /// Whether there are many unions with any key.
    pub fn has_frequent_unions(&self) -> bool {
        self.unions.iter().any(|&key| self.is_frequent(Some(key)))
    }

    /// A number that equal solids have in common, wherever they stand; none for what is too simple to be shared. Others may
    /// have it too: of all but unions only a part is looked at.
    pub fn key(&mut self, solid: &Solid, map: &Affine) -> Option<u64> {
        let mut hasher = FxHasher::default();
        map.rows.iter().for_each(|&row| hash_vector(&mut hasher, row));
        match solid.node() {
            Node::Combine(BoolOp::Union, _) => hasher.write_u64(self.hash(solid)),
            Node::Combine(..)
            | Node::Primitive(Primitive::Polyhedron(_) | Primitive::Prism { .. } | Primitive::Revolution(_)) => {
                glance(&mut hasher, solid);
            }
            _ => return None,
        }
        Some(hasher.finish())
    }

    /// A number that hardly any different solid has.
    fn hash(&mut self, solid: &Solid) -> u64 {
        let mut hasher = FxHasher::default();
        hash_node(&mut hasher, solid.node());
        match solid.node() {
            Node::Empty | Node::Primitive(_) => {}
            Node::Transform(_, child) | Node::Part(_, child) => hasher.write_u64(with_stack(|| self.hash(child))),
            Node::Combine(op, children) => {
                let is_union = *op == BoolOp::Union;
                if let Some(&known) = self.hashes.get(&solid.id()).filter(|_| is_union) {
                    return known;
                }
                children.iter().for_each(|child| hasher.write_u64(with_stack(|| self.hash(child))));
                if is_union {
                    self.hashes.insert(solid.id(), hasher.finish());
                }
            }
        }
        hasher.finish()
    }
}

/// Looks at first operands only: then memory is read once, where solids are compared.
fn glance(hasher: &mut FxHasher, mut solid: &Solid) {
    loop {
        hash_node(hasher, solid.node());
        solid = match solid.node() {
            Node::Empty | Node::Primitive(_) => return,
            Node::Transform(_, child) | Node::Part(_, child) => child,
            Node::Combine(_, children) => match children.first() {
                Some(first) => first,
                None => return,
            },
        };
    }
}

/// What a node says itself.
fn hash_node(hasher: &mut FxHasher, node: &Node) {
    match node {
        Node::Empty => {}
        Node::Primitive(primitive) => hash_primitive(hasher, primitive),
        Node::Transform(map, _) => {
            map.rows.iter().for_each(|&row| hash_vector(hasher, row));
            hash_vector(hasher, map.translation);
        }
        Node::Part(id, _) => hasher.write_u32(id.0),
        Node::Combine(op, children) => {
            hasher.write_u8(*op as u8);
            hasher.write_usize(children.len());
        }
    }
}

/// Whether both are the same tree with the same numbers.
pub(super) fn same(a: &Solid, b: &Solid) -> bool {
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

/// Trees may be deep.
pub(super) fn with_stack<T>(work: impl FnOnce() -> T) -> T {
    stacker::maybe_grow(64 << 10, 4 << 20, work)
}

fn hash_vector(hasher: &mut FxHasher, v: Vec3) {
    // Adding zero turns -0 into 0.
    v.to_array().iter().for_each(|c| hasher.write_u64((c + 0.0).to_bits()));
}

/// Corners only: they say nearly all.
fn hash_profile(hasher: &mut FxHasher, profile: &Profile) {
    let corners = profile.contours().iter().flatten().map(|edge| edge.from);
    corners.for_each(|corner| hash_vector(hasher, Vec3::new(corner.x, corner.y, 0.0)));
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
        Primitive::Prism { profile, top } => {
            hash_profile(hasher, profile);
            (8, *top)
        }
        Primitive::Revolution(profile) => {
            hash_profile(hasher, profile);
            (9, 0.0)
        }
    };
    hasher.write_u8(kind);
    hasher.write_u64((size + 0.0).to_bits());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solids_that_differ_late_are_told_apart() {
        let solid = |radius: f64| Solid::block() - Solid::sphere() - Solid::sphere().scale([radius; 3]);
        let mut census = Census::default();
        let key = |census: &mut Census, solid: &Solid| census.key(solid, &Affine::IDENTITY);
        let (a, b, other) = (solid(0.5), solid(0.5), solid(0.25));
        assert_eq!(key(&mut census, &a), key(&mut census, &b));
        assert!(same(&a, &b) && !same(&a, &other));
        let union = |solid: &Solid| Solid::union([solid.clone(), Solid::block()]);
        assert_eq!(key(&mut census, &union(&a)), key(&mut census, &union(&b)));
        assert_ne!(key(&mut census, &union(&a)), key(&mut census, &union(&other)));
        assert_eq!(key(&mut census, &Solid::block()), None);
        assert_ne!(census.key(&a, &Affine::IDENTITY), census.key(&a, &Affine::scale(Vec3::splat(2.0))));
    }
}
