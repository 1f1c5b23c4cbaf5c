//! Boolean operations that a person can check by hand.

use super::*;
use octrace::{Curve, Edge, Vec2};
use std::f64::consts::PI;

fn rectangle(x: f64, y: f64, w: f64, h: f64) -> Outline {
    Outline::rectangle(Vec2::new(x, y), Vec2::new(x + w, y + h))
}

fn disc(x: f64, y: f64, radius: f64) -> Outline {
    Outline { contours: vec![crate::plane::outline::full_circle(Vec2::new(x, y), radius)] }
}

fn do_it(op: BoolOp, outlines: &[Outline]) -> Outline {
    let outlines: Vec<&Outline> = outlines.iter().collect();
    combine(op, &outlines).expect("it is simple")
}

fn corners(outline: &Outline) -> Vec<(f64, f64)> {
    let mut corners: Vec<(f64, f64)> = outline.contours.iter().flatten().map(|e| (e.from.x, e.from.y)).collect();
    corners.sort_by(|a, b| a.partial_cmp(b).expect("corners are finite"));
    corners
}

fn check_area(outline: &Outline, expected: f64) {
    assert!((outline.area() - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{} {expected}", outline.area());
}

#[test]
fn two_squares_make_an_l() {
    let l = do_it(BoolOp::Union, &[rectangle(0.0, 0.0, 3.0, 1.0), rectangle(0.0, 0.0, 1.0, 3.0)]);
    assert_eq!(corners(&l), [(0.0, 0.0), (0.0, 3.0), (1.0, 1.0), (1.0, 3.0), (3.0, 0.0), (3.0, 1.0)]);
    check_area(&l, 5.0);
}

#[test]
fn neighbours_leave_no_seam() {
    let both = do_it(BoolOp::Union, &[rectangle(0.1, 0.2, 0.3, 0.7), rectangle(0.4, 0.2, 0.3, 0.7)]);
    assert_eq!(both.contours.len(), 1);
    assert_eq!(both.contours[0].len(), 4);
    let apart = [rectangle(0.0, 0.0, 1.0, 1.0), rectangle(1.0 + 1e-8, 0.0, 1.0, 1.0)];
    assert_eq!(do_it(BoolOp::Union, &apart).contours.len(), 1, "a slit below the grid is none");
}

#[test]
fn a_drilled_square_keeps_the_circle() {
    let drilled = do_it(BoolOp::Difference, &[rectangle(-2.0, -2.0, 4.0, 4.0), disc(0.0, 0.0, 1.0)]);
    assert_eq!(drilled.contours.len(), 2);
    assert!(drilled.contours.contains(&vec![Edge {
        from: Vec2::new(1.0, 0.0),
        curve: Curve::Arc { center: Vec2::ZERO, radius: 1.0, ccw: false },
    }]));
    check_area(&drilled, 16.0 - PI);
}

#[test]
fn a_quarter_disc_has_exact_corners() {
    let quarter = do_it(BoolOp::Intersection, &[disc(0.0, 0.0, 5.0), rectangle(0.0, 0.0, 9.0, 9.0)]);
    assert_eq!(corners(&quarter), [(0.0, 0.0), (0.0, 5.0), (5.0, 0.0)]);
    check_area(&quarter, 25.0 * PI / 4.0);
    let cut = do_it(BoolOp::Intersection, &[disc(0.0, 0.0, 5.0), rectangle(3.0, -9.0, 9.0, 18.0)]);
    assert_eq!(corners(&cut), [(3.0, -4.0), (3.0, 4.0)]);
}

#[test]
fn a_lens_of_two_circles() {
    let lens = do_it(BoolOp::Intersection, &[disc(0.0, 0.0, 5.0), disc(6.0, 0.0, 5.0)]);
    assert_eq!(corners(&lens), [(3.0, -4.0), (3.0, 4.0)]);
    let half_angle = libm::acos(0.6);
    check_area(&lens, 2.0 * 25.0 * (half_angle - 0.6 * 0.8));
    let both = do_it(BoolOp::Union, &[disc(0.0, 0.0, 5.0), disc(6.0, 0.0, 5.0)]);
    check_area(&both, 50.0 * PI - lens.area());
    assert_eq!(both.contours[0].len(), 2);
}

#[test]
fn a_stadium_of_tangent_pieces() {
    let pieces = [disc(0.0, 0.0, 1.0), disc(4.0, 0.0, 1.0), rectangle(0.0, -1.0, 4.0, 2.0)];
    let stadium = do_it(BoolOp::Union, &pieces);
    assert_eq!(corners(&stadium), [(0.0, -1.0), (0.0, 1.0), (4.0, -1.0), (4.0, 1.0)]);
    check_area(&stadium, 8.0 + PI);
    assert_eq!(do_it(BoolOp::Union, &[stadium.clone(), stadium.clone()]).area(), stadium.area());
    assert!(do_it(BoolOp::Difference, &[stadium.clone(), stadium.clone()]).is_empty());
    let plates = do_it(BoolOp::Difference, &[stadium, disc(0.0, 0.0, 1.0)]);
    check_area(&plates, 8.0 - PI / 2.0 + PI / 2.0);
}

#[test]
fn circles_that_touch() {
    let eight = do_it(BoolOp::Union, &[disc(-1.0, 0.0, 1.0), disc(1.0, 0.0, 1.0)]);
    check_area(&eight, 2.0 * PI);
    let crescent = do_it(BoolOp::Difference, &[disc(0.0, 0.0, 2.0), disc(1.0, 0.0, 1.0)]);
    check_area(&crescent, 3.0 * PI);
    let ring = do_it(BoolOp::Difference, &[disc(0.0, 0.0, 2.0), disc(0.0, 0.0, 1.0)]);
    check_area(&ring, 3.0 * PI);
    assert_eq!(ring.contours.len(), 2);
    assert!(do_it(BoolOp::Intersection, &[disc(-1.0, 0.0, 1.0), disc(1.0, 0.0, 1.0)]).is_empty());
}

#[test]
fn a_circle_stays_where_something_touches_it_in_one_corner() {
    // (24, 10) / 13 from the centre: on the circle, but for rounding, and in the middle of a chord.
    let touch = Vec2::new(-2.153846153846154, -1.2307692307692308);
    let round = disc(-4.0, -2.0, 2.0);
    let corners = |a: (f64, f64), b: (f64, f64)| [Vec2::new(a.0, a.1), touch, Vec2::new(b.0, b.1)];
    let (inside, outside) = (corners((-4.0, -1.0), (-4.0, 0.0)), corners((4.0, -2.0), (2.0, -4.0)));
    // Both counter-clockwise.
    let beside =
        Outline { contours: [inside, outside].map(|corners| crate::plane::outline::straight(&corners)).to_vec() };
    let outer = 0.5 * ((2.0 - touch.x) * (-2.0 - touch.y) - (4.0 - touch.x) * (-4.0 - touch.y)).abs();
    check_area(&do_it(BoolOp::Union, &[round.clone(), beside.clone()]), 4.0 * PI + outer);
    check_area(&do_it(BoolOp::Intersection, &[round, beside.clone()]), beside.area() - outer);
}

#[test]
fn polygons_may_cross_themselves() {
    let p = |x: f64, y: f64| Vec2::new(x, y);
    let bow_tie = Outline::polygon(&[vec![p(0.0, 0.0), p(2.0, 2.0), p(2.0, 0.0), p(0.0, 2.0)]]).expect("simple");
    check_area(&bow_tie, 2.0);
    assert!(corners(&bow_tie).contains(&(1.0, 1.0)));
    let square = vec![p(0.0, 0.0), p(0.0, 4.0), p(4.0, 4.0), p(4.0, 0.0)];
    let hole = vec![p(1.0, 1.0), p(1.0, 2.0), p(2.0, 2.0), p(2.0, 1.0)];
    let holed = Outline::polygon(&[square.clone(), hole]).expect("simple");
    check_area(&holed, 15.0);
    assert!(Outline::polygon(&[square.clone(), square]).expect("simple").is_empty(), "twice is not at all");
    assert_eq!(Outline::polygon(&[vec![p(f64::NAN, 0.0)]]), Err(PlaneError::NotFinite));
}

#[test]
fn fills_count_turns() {
    let square = rectangle(0.0, 0.0, 1.0, 1.0).contours.remove(0);
    let clockwise = crate::plane::curve::reversed(&square);
    let area = |contour: &Contour, fill| region(std::slice::from_ref(contour), fill).expect("simple").area();
    assert_eq!(area(&square, Fill::Positive), 1.0);
    assert_eq!(area(&square, Fill::Negative), 0.0);
    assert_eq!(area(&clockwise, Fill::Positive), 0.0);
    assert_eq!(area(&clockwise, Fill::Negative), 1.0);
    assert_eq!(area(&clockwise, Fill::NonZero), 1.0);
}

#[test]
fn too_many_crossings_are_refused() {
    // A star with every corner far from the next: nearly all pairs of its edges cross.
    let count = 20_001;
    let corner = |i: usize| {
        let (s, c) = octrace::geom::sin_cos_deg((i * 10_000 % count) as f64 * 360.0 / count as f64);
        Vec2::new(c, s)
    };
    let star: Vec<Vec2> = (0..count).map(corner).collect();
    assert_eq!(Outline::polygon(&[star]), Err(PlaneError::TooComplex { edges: count }));
}

#[test]
fn arcs_that_are_none_are_lines() {
    let arc = |center: Vec2, radius: f64| Curve::Arc { center, radius, ccw: true };
    let with = |curve: Curve| {
        let corner = |x: f64, y: f64, curve: Curve| Edge { from: Vec2::new(x, y), curve };
        let contour = vec![corner(0.0, 0.0, curve), corner(4.0, 0.0, Curve::Line), corner(0.0, 4.0, Curve::Line)];
        region(&[contour], Fill::NonZero)
    };
    for (center, radius) in [(2.0, 1e9), (2.0, 1e-9), (1e9, 1.0), (-1e300, 1e300)] {
        let straight = with(arc(Vec2::new(center, 0.0), radius)).expect("finite");
        assert!((straight.area() - 8.0).abs() < 1e-5, "{center} {radius}: {}", straight.area());
    }
    assert_eq!(with(arc(Vec2::new(2.0, 0.0), f64::INFINITY)), Err(PlaneError::NotFinite));
    check_area(&with(arc(Vec2::new(2.0, 0.0), 2.0)).expect("finite"), 8.0 + 2.0 * PI);
}
