//! Simplifying a program in a box changes it nowhere in that box.

mod common;

use common::{cases, lattice, lattice_point, lattice_solid};
use octrace::compile::{Catalog, Constant, Copies, Simplified, Simplifier, Word, compile, node_end};
use octrace::surface::CellBox;
use octrace::{Ray, Vec3};
use proptest::prelude::*;

/// Points keep this far from a box's walls, so that rounding in the classification does not matter.
const MARGIN: f64 = 1e-9;

/// Whether the origin of a ray is in a program: by the definition, literal by literal.
fn contains(catalog: &Catalog, words: &[u32], at: usize, ray: &Ray) -> bool {
    let (end, all) = match Word::decode(words[at]) {
        Word::Literal { index, negated } => {
            let surface = &catalog.surfaces[catalog.literals[index as usize].surface as usize];
            let mut params = Vec::new();
            let comes_from_inside = surface.crossings(&catalog.surfaces, ray, &mut params);
            let crossed = params.iter().filter(|&&t| t <= 0.0).count();
            return comes_from_inside ^ (crossed % 2 == 1) ^ negated;
        }
        Word::And { .. } => (node_end(words, at), true),
        Word::Or { .. } => (node_end(words, at), false),
    };
    let mut child = at + 1;
    while child < end {
        if contains(catalog, words, child, ray) != all {
            return !all;
        }
        child = node_end(words, child);
    }
    all
}

fn simplified(simplifier: &mut Simplifier, catalog: &Catalog, program: &Constant, cell: &CellBox) -> Constant {
    let Constant::Words(words) = program else { return program.clone() };
    let mut reduced = Vec::new();
    match simplifier.simplify(catalog, words, cell, &mut reduced) {
        Simplified::Constant(inside) => Constant::Everywhere(inside),
        Simplified::Reduced => Constant::Words(reduced.into()),
    }
}

fn half_edges() -> impl Strategy<Value = Vec3> {
    let half = || prop_oneof![Just(0.125), Just(0.25), Just(0.5), Just(1.0), 0.01..2.0];
    (half(), half(), half()).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

proptest! {
    #![proptest_config(cases(1500))]

    #[test]
    fn simplifying_in_a_box_changes_nothing_there(
        solid in lattice_solid(),
        center in (lattice_point(), lattice(), any::<bool>()).prop_map(|(p, shift, off)| match off {
            true => p + Vec3::new(0.11, -0.07, 0.05) * shift,
            false => p,
        }),
        half in half_edges(),
        points in prop::collection::vec((-1.0..1.0, -1.0..1.0, -1.0..1.0), 12),
    ) {
        let compiled = compile(&[solid], 0.0, Copies::Apart);
        let catalog = &compiled.catalog;
        let whole = &compiled.bodies[0].whole;
        let mut simplifier = Simplifier::default();
        let cell = CellBox::with_margin(center, half, MARGIN);
        let reduced = simplified(&mut simplifier, catalog, whole, &cell);
        // Once more, in an eighth of the box, as the octree does.
        let corner = CellBox::with_margin(center + half * 0.5, half * 0.5, MARGIN);
        let twice = simplified(&mut simplifier, catalog, &reduced, &corner);

        let inside = |program: &Constant, p: Vec3| match program {
            Constant::Everywhere(inside) => *inside,
            Constant::Words(words) => {
                let ray = Ray { origin: p, direction: Vec3::new(0.5773, 0.5131, 0.6351) };
                contains(catalog, words, 0, &ray)
            }
        };
        for (x, y, z) in points {
            let offset = half * Vec3::new(x, y, z);
            let p = center + offset;
            prop_assert_eq!(inside(&reduced, p), inside(whole, p), "at {:?}", p);
            let p = center + offset.abs();
            prop_assert_eq!(inside(&twice, p), inside(whole, p), "in the corner at {:?}", p);
        }
        if let (Constant::Words(before), Constant::Words(after)) = (whole, &reduced) {
            prop_assert!(after.len() <= before.len(), "simplifying makes nothing longer");
        }
    }
}
