//! What holds of all outlines: tried on many, their corners, centres and radii small integers, so that they touch, coincide
//! and repeat.

use super::*;
use crate::Tolerance;
use octrace::{BoolOp, Vec2};
use proptest::prelude::*;

fn point() -> impl Strategy<Value = Vec2> {
    (-4..=4, -4..=4).prop_map(|(x, y)| Vec2::new(f64::from(x), f64::from(y)))
}

/// Discs, rectangles, triangles and stars, rings, rounded rectangles.
fn simple() -> impl Strategy<Value = Outline> {
    let placed = |outline: Outline, at: Vec2| outline.moved(&Affine2::translation(at), Tolerance::default());
    let disc = (point(), 1..=4).prop_map(move |(at, r)| placed(Outline::circle(f64::from(r)), at));
    let rectangle = (point(), point()).prop_map(|(a, b)| Outline::rectangle(a, b));
    let polygon = prop::collection::vec(point(), 3..7).prop_map(|path| Outline::polygon(&[path]).expect("it is small"));
    let rounded = (point(), point(), 1..=2).prop_map(|(a, b, r)| {
        let r = f64::from(r);
        Outline::rectangle(a, b).offset(Offset::Round { r, facets: None }).expect("it is small")
    });
    prop_oneof![disc, rectangle, polygon, rounded]
}

fn outline() -> impl Strategy<Value = Outline> {
    prop_oneof![
        simple(),
        (simple(), simple(), 0..3).prop_map(|(a, b, op)| {
            let op = [BoolOp::Union, BoolOp::Intersection, BoolOp::Difference][op as usize];
            combine(op, &[&a, &b]).expect("it is small")
        }),
    ]
}

fn combined(op: BoolOp, a: &Outline, b: &Outline) -> Outline {
    combine(op, &[a, b]).expect("it is small")
}

/// Areas of all that these shapes can be are below a few hundred. Where curves touch, chords may not tell: see the module
/// `boolean`.
const CLOSE: f64 = 1e-4;

/// The corners of arcs are on their circles, nothing is endless, and contours do not cross: by every rule they surround the
/// same.
fn check_valid(outline: &Outline) {
    for fill in [Fill::EvenOdd, Fill::Positive] {
        let area = region(&outline.contours, fill).expect("it is small").area();
        assert!((area - outline.area()).abs() < CLOSE, "{fill:?} {area} {} {outline:?}", outline.area());
    }
    for (edge, to) in outline.contours.iter().flat_map(curve::edges) {
        assert!(edge.from.x.is_finite() && edge.from.y.is_finite());
        if let octrace::Curve::Arc { center, radius, .. } = edge.curve {
            for p in [edge.from, to] {
                assert!(((p - center).length() - radius).abs() < 1e-6, "{edge:?} {to:?} in {outline:?}");
            }
        } else {
            assert!(edge.from != to, "{edge:?} in {outline:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn areas_add_up(a in outline(), b in outline()) {
        let (union, common) = (combined(BoolOp::Union, &a, &b), combined(BoolOp::Intersection, &a, &b));
        let rest = combined(BoolOp::Difference, &a, &b);
        for outline in [&a, &b, &union, &common, &rest] {
            check_valid(outline);
        }
        let sum = union.area() + common.area() - a.area() - b.area();
        prop_assert!(sum.abs() < CLOSE, "{sum} {a:?} {b:?}");
        prop_assert!((rest.area() + common.area() - a.area()).abs() < CLOSE, "{a:?} {b:?}");
        let either = exclusive(&a, &b).expect("it is small");
        prop_assert!((either.area() + common.area() - union.area()).abs() < CLOSE, "{a:?} {b:?}");
    }

    #[test]
    fn nothing_comes_of_itself(a in outline()) {
        prop_assert_eq!(combined(BoolOp::Difference, &a, &a), Outline::EMPTY);
        for op in [BoolOp::Union, BoolOp::Intersection] {
            prop_assert!((combined(op, &a, &a).area() - a.area()).abs() < 1e-9, "{:?}", a);
        }
    }

    #[test]
    fn points_are_in_what_the_tree_says(a in outline(), b in outline(), p in point(), dx in 1..8, dy in 1..8) {
        // Off the lattice, and off most curves through it.
        let p = p + Vec2::new(f64::from(dx) * 0.1234567, f64::from(dy) * 0.0987654);
        let (in_a, in_b) = (a.contains(p), b.contains(p));
        let inside = |op| combined(op, &a, &b).contains(p);
        prop_assert_eq!(inside(BoolOp::Union), in_a || in_b);
        prop_assert_eq!(inside(BoolOp::Intersection), in_a && in_b);
        prop_assert_eq!(inside(BoolOp::Difference), in_a && !in_b);
    }

    #[test]
    fn hulls_contain_and_are_convex(a in outline(), b in outline()) {
        let around = hull([&a, &b]);
        check_valid(&around);
        prop_assert!(around.is_convex(), "{around:?}");
        let outside = combined(BoolOp::Difference, &a, &around);
        prop_assert!(outside.area() < CLOSE, "{} {a:?} {around:?}", outside.area());
        let fine = hull([&a.polygonised(Tolerance { relative: 1e-8 }), &b.polygonised(Tolerance { relative: 1e-8 })]);
        prop_assert!((around.area() - fine.area()).abs() < 2e-5, "{} {} {a:?} {b:?}", around.area(), fine.area());
    }

    #[test]
    fn offsets_are_sums_with_discs(a in outline(), r in 1..=3, p in point()) {
        let r = f64::from(r);
        let grown = a.offset(Offset::Round { r, facets: None }).expect("it is small");
        check_valid(&grown);
        let by_fine_disc = a
            .polygonised(Tolerance { relative: 1e-5 })
            .offset(Offset::Round { r, facets: Some(1000) })
            .expect("it is small");
        prop_assert!((grown.area() - by_fine_disc.area()).abs() < 0.02, "{} {}", grown.area(), by_fine_disc.area());
        let shrunk = grown.offset(Offset::Round { r: -r, facets: None }).expect("it is small");
        check_valid(&shrunk);
        let lost = combined(BoolOp::Difference, &a, &shrunk).area();
        prop_assert!(lost < CLOSE, "closing loses {lost} of {a:?}");
        let p = p + Vec2::new(0.1234567, 0.0987654);
        let near = (0..64).any(|i| {
            let (s, c) = octrace::geom::sin_cos_deg(f64::from(i) * 5.625);
            a.contains(p + Vec2::new(c, s) * (r * 0.999))
        });
        prop_assert!(!near || grown.contains(p));
    }

    #[test]
    fn maps_move_what_is_inside(a in outline(), p in point(), x in point(), y in point()) {
        let map = Affine2 { x, y, translation: p };
        let moved = a.moved(&map, Tolerance::default());
        check_valid(&moved);
        let expected = a.area() * if map.inverse().is_some() { map.determinant().abs() } else { 0.0 };
        // Chords may be away from their arcs by the tolerance, all along.
        let size = moved.bounds().map_or(0.0, |b| b.diagonal());
        let slack = 10.0 * size * size * Tolerance::default().relative;
        prop_assert!((moved.area() - expected).abs() <= slack, "{} {expected}", moved.area());
    }
}
