use super::support::Thing;
use super::tests::{ball, check_leaks, check_points, check_to, hull_of_all, measured, post, random_numbers};
use super::*;
use crate::space::round::Round;
use octrace::{Primitive, Vec3};

fn disc(center: [f64; 3], [a, b]: [[f64; 3]; 2]) -> Round {
    Round::Ellipse { center: center.into(), axes: [a.into(), b.into()] }
}

/// How far a thing reaches in a direction that is no axis.
fn reach(thing: &Thing, direction: Vec3) -> f64 {
    thing.farthest(direction).map_or(f64::NEG_INFINITY, |point| point.dot(direction))
}

/// How many primitives of a kind are in a union.
fn count(solid: &Solid, is: impl Fn(&Primitive) -> bool) -> usize {
    leaves(std::slice::from_ref(solid)).iter().filter(|(_, leaf)| matches!(leaf, Leaf::Primitive(p) if is(p))).count()
}

fn faces(solid: &Solid) -> usize {
    let of = |leaf: &Leaf| match leaf {
        Leaf::Primitive(Primitive::Polyhedron(polyhedron)) => polyhedron.faces().len(),
        _ => 0,
    };
    leaves(std::slice::from_ref(solid)).iter().map(|(_, leaf)| of(leaf)).sum()
}

#[test]
fn crossing_discs_have_the_hull_of_a_formula() {
    // Unit discs across y and across z: x² + (|y| + |z|)² <= 1, whose slices are squares of area 2 (1 - x²).
    let discs =
        [disc([0.0; 3], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), disc([0.0; 3], [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])];
    let hull = hull_of(Extremes { points: Vec::new(), rounds: discs.to_vec() }, Tolerance::default());
    let found = measured(&hull);
    assert!((0.9998..=1.00001).contains(&(found.volume / (8.0 / 3.0))), "{found:?}");
    assert!(faces(&hull) < 1400, "{}", faces(&hull));
    check_leaks(&hull);
}

/// The volume of the limit of finer and finer meshes of OpenSCAD 2021.01.
#[test]
fn slanted_cylinders_are_exact_but_for_strips() {
    let slanted = Solid::cylinder().scale([24.0, 24.0, 1.0]).translate([-4.0, 0.0, 17.0]).rotate([0.0, 40.0, 0.0]);
    let cone = Solid::primitive(Primitive::Cone { top: 57.5 / 66.5 }).scale([66.5, 66.5, 30.0]);
    let solids = [cone, slanted.translate([70.0, 0.0, 0.0])];
    check_to(1e-4, &solids, 408_941.0);
    let hull = hull_of_all(&solids);
    assert_eq!(count(&hull, |p| matches!(p, Primitive::Cone { .. } | Primitive::Cylinder)), 2);
    assert!(faces(&hull) < 450, "{}", faces(&hull));
    check_leaks(&hull);
}

#[test]
fn balls_beside_posts_stay_balls() {
    let solids = [post([0.0; 3], 2.0, 1.0), ball([4.0, 0.0, 3.0], 1.0), ball([4.0, 3.0, 3.0], 1.0)];
    let hull = hull_of_all(&solids);
    assert_eq!(count(&hull, |p| *p == Primitive::Sphere), 2);
    assert!(count(&hull, |p| *p == Primitive::Cylinder) >= 2);
    check_leaks(&hull);
}

#[test]
fn mixed_things_have_the_hull_of_the_definition() {
    let mut random = random_numbers();
    for count in [2, 3, 5, 9, 20] {
        let mut vector = || Vec3::new(random(), random(), random());
        let mut extremes = Extremes::default();
        for i in 0..count {
            let center = vector() * 4.0;
            let axis = (vector() - Vec3::splat(0.5)).normalized().unwrap();
            let [u, v] = super::super::frusta::across(axis);
            let size = 0.2 + 0.8 * vector().x;
            match i % 4 {
                0 => extremes.rounds.push(Round::Ellipse { center, axes: [u * size, v * size] }),
                1 => extremes.rounds.push(Round::Ellipsoid { center, axes: [u, v, axis].map(|a| a * size) }),
                2 => extremes.rounds.push(Round::Ring { center, axes: [u, v, axis].map(|a| a * size), minor: 0.3 }),
                _ => extremes.points.push(center),
            }
        }
        let mut things: Vec<Thing> = extremes.rounds.iter().copied().map(Thing::Round).collect();
        things.extend(extremes.points.iter().copied().map(Thing::Corner));
        let support = |d: Vec3| things.iter().map(|thing| reach(thing, d)).fold(f64::NEG_INFINITY, f64::max);
        check_points(&hull_of(extremes, Tolerance::default()), &support, &mut random);
    }
}
