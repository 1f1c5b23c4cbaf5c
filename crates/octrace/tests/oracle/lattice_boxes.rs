//! Boxes on a lattice, turned by quarters: everything is exact, and so must the tracer be, to the last bit.

use crate::common::cases;
use crate::tracers;
use crate::twin::ask;
use octrace::{Ray, Solid, Vec3};
use proptest::prelude::*;

/// Surfaces lie at multiples of this.
const STEP: f64 = 0.5;
/// No box reaches beyond this, from the origin.
const REACH: i32 = 24;

fn lattice_box() -> impl Strategy<Value = Solid> {
    let steps = || (-4i32..=4).prop_map(|i| f64::from(i) * STEP);
    let size = || prop::sample::select(vec![0.5, 1.0, -1.0, 1.5, 2.0]);
    let quarter = || prop::sample::select(vec![0.0, 0.0, 90.0, 180.0, 270.0]);
    let shape = prop_oneof![8 => Just(Solid::block()), 1 => Just(Solid::half_space())];
    (shape, (size(), size(), size()), (quarter(), quarter(), quarter()), (steps(), steps(), steps())).prop_map(
        |(shape, (a, b, c), (x, y, z), (u, v, w))| shape.scale([a, b, c]).rotate([x, y, z]).translate([u, v, w]),
    )
}

fn box_solid() -> impl Strategy<Value = Solid> {
    lattice_box().prop_recursive(4, 24, 4, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 2..4).prop_map(Solid::union),
            prop::collection::vec(inner.clone(), 2..4).prop_map(Solid::intersection),
            prop::collection::vec(inner, 2..4).prop_map(Solid::difference),
        ]
    })
}

/// The ends of the spans along an axis, through the middles of cells of the lattice: cell by cell.
fn expected(solid: &Solid, origin: Vec3, axis: usize, sign: f64) -> Vec<f64> {
    let mut direction = Vec3::ZERO;
    direction[axis] = sign;
    let inside = |i: i32| ask(solid, origin + direction * ((f64::from(i) + 0.5) * STEP)).inside;
    let mut ends = Vec::new();
    let mut before = inside(-2 * REACH);
    if before {
        ends.push(f64::NEG_INFINITY);
    }
    for i in -2 * REACH..2 * REACH {
        if inside(i) != before {
            ends.push(f64::from(i) * STEP);
            before = !before;
        }
    }
    if before {
        ends.push(f64::INFINITY);
    }
    ends
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn spans_through_lattice_boxes_are_exact(
        solid in box_solid(),
        lines in prop::collection::vec(((-12i32..12, -12i32..12), -4i32..=4, 0usize..3, any::<bool>()), 10),
    ) {
        let tracers = tracers(&solid);
        for ((u, v), start, axis, forwards) in lines {
            let sign = if forwards { 1.0 } else { -1.0 };
            let mut origin = Vec3::ZERO;
            origin[axis] = f64::from(start) * STEP;
            origin[(axis + 1) % 3] = (f64::from(u) + 0.5) * STEP;
            origin[(axis + 2) % 3] = (f64::from(v) + 0.5) * STEP;
            let mut direction = Vec3::ZERO;
            direction[axis] = sign;
            let expected = expected(&solid, origin, axis, sign);
            for tracer in &tracers {
                let ray = Ray::new(origin, direction);
                let ends: Vec<f64> =
                    tracer.spans(&ray).iter().flat_map(|span| [span.enter_t(), span.exit_t()]).collect();
                prop_assert_eq!(&ends, &expected, "{:?}", ray);
                let first = tracer.first_hit(&ray).map(|hit| hit.t);
                prop_assert_eq!(first, expected.iter().copied().find(|&t| 0.0 < t && t < f64::INFINITY));
            }
        }
    }
}
