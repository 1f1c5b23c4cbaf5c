//! Hulls that a person can check by hand.

use super::*;
use crate::Tolerance;
use crate::plane::combine;
use octrace::BoolOp;

fn p(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

fn disc(x: f64, y: f64, radius: f64) -> Outline {
    Outline { contours: vec![full_circle(p(x, y), radius)] }
}

fn check(outlines: &[Outline], area: f64, edges: usize) -> Outline {
    let hull = hull(outlines);
    assert!((hull.area() - area).abs() <= 1e-12 * area, "{} {area} {hull:?}", hull.area());
    assert_eq!(hull.contours.iter().map(Vec::len).sum::<usize>(), edges, "{hull:?}");
    hull
}

#[test]
fn a_rounded_plate() {
    let plate = [disc(0.0, 0.0, 1.0), disc(6.0, 0.0, 1.0), disc(6.0, 4.0, 1.0), disc(0.0, 4.0, 1.0)];
    let plate = check(&plate, 24.0 + 20.0 + PI, 8);
    assert!(plate.contours[0].contains(&Edge { from: p(0.0, -1.0), curve: Curve::Line }));
    let again = check(&[plate.clone(), disc(3.0, 2.0, 0.5)], 44.0 + PI, 8);
    assert_eq!(again, plate);
}

#[test]
fn a_belt_about_two_wheels() {
    // Centres 5 apart, radii 4 and 1: the tangents are 4 long, with an angle whose sine is 3/5.
    let tilt = libm::asin(0.6);
    let area = 4.0 * 5.0 + 16.0 * (PI / 2.0 + tilt) + (PI / 2.0 - tilt);
    let belt = check(&[disc(0.0, 0.0, 4.0), disc(5.0, 0.0, 1.0)], area, 4);
    assert!((belt.contours[0].iter().map(|e| e.from.x).fold(0.0, f64::max) - 5.6).abs() < 1e-14);
}

#[test]
fn corners_and_circles() {
    let square = Outline::rectangle(p(0.0, 0.0), p(4.0, 4.0));
    let l = Outline::polygon(&[vec![p(0.0, 0.0), p(4.0, 0.0), p(4.0, 1.0), p(1.0, 1.0), p(1.0, 4.0), p(0.0, 4.0)]]);
    check(&[l.expect("simple")], 11.5, 5);
    check(&[square.clone(), disc(2.0, 2.0, 1.0)], 16.0, 4);
    // A point 5 from the centre of a circle of radius 3: tangents of length 4.
    let angle = PI - libm::acos(0.6);
    let thorn = Outline::polygon(&[vec![p(5.0, 0.0), p(4.0, 0.1), p(4.0, -0.1)]]).expect("simple");
    check(&[disc(0.0, 0.0, 3.0), thorn], 12.0 + 9.0 * angle, 3);
    assert!(hull(&[]).is_empty());
    assert!(hull(&[Outline::EMPTY]).is_empty());
}

#[test]
fn arcs_that_end() {
    let half = Outline {
        contours: vec![vec![
            Edge { from: p(0.0, -2.0), curve: Curve::Arc { center: p(0.0, 0.0), radius: 2.0, ccw: true } },
            Edge { from: p(0.0, 2.0), curve: Curve::Line },
        ]],
    };
    check(std::slice::from_ref(&half), 2.0 * PI, 2);
    let square = Outline::rectangle(p(-4.0, -2.0), p(-3.0, 2.0));
    check(&[half.clone(), square], 2.0 * PI + 16.0, 4);
    // The end of the arc is a corner of the hull where the tangent would touch beyond it.
    let high = Outline::rectangle(p(-4.0, -1.0), p(-3.0, 2.0));
    check(&[half.clone(), high], 2.0 * PI + 14.0, 4);
    // Two halves of one circle are the circle.
    let other = half.moved(&crate::plane::Affine2::scale(p(-1.0, 1.0)), crate::Tolerance::default());
    check(&[half, other], 4.0 * PI, 1);
}

#[test]
fn an_arc_touched_just_beside_its_end() {
    // The lens begins at a corner that another circle shares; the tangent from the great disc touches it 0.3 degrees later.
    let lens = combine(BoolOp::Intersection, &[&disc(2.0, 4.0, 2.0), &disc(3.0, 3.0, 1.0)]).expect("it is small");
    let mut turned = lens.clone();
    turned.contours[0].rotate_left(1);
    for (lens, order) in [lens, turned].iter().flat_map(|lens| [[0, 1, 2], [2, 1, 0]].map(|order| (lens, order))) {
        let discs = [disc(4.0, -4.0, 3.0), disc(0.0, 0.0, 1.0), lens.clone()];
        let around = hull(order.map(|i| &discs[i]));
        let fine = hull(&discs.each_ref().map(|d| d.polygonised(Tolerance { relative: 1e-9 })));
        assert!((around.area() - fine.area()).abs() < 1e-6, "{} {} {around:?}", around.area(), fine.area());
        assert!(around.is_convex(), "{around:?}");
    }
}
