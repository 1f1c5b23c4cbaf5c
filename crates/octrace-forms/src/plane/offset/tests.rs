//! Offsets known by hand, and such as OpenSCAD 2021.01 makes them.

use super::*;
use octrace::BoolOp;
use std::f64::consts::PI;

fn p(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

fn l_shape() -> Outline {
    let corners = vec![p(0.0, 0.0), p(20.0, 0.0), p(20.0, 5.0), p(8.0, 5.0), p(8.0, 15.0), p(0.0, 15.0)];
    Outline::polygon(&[corners]).expect("simple")
}

fn round(r: f64) -> Offset {
    Offset::Round { r, facets: None }
}

fn check(outline: &Outline, offset: Offset, area: f64, edges: usize) -> Outline {
    let result = outline.offset(offset).expect("simple");
    assert!((result.area() - area).abs() <= 1e-12 * area, "{} {area} {result:?}", result.area());
    assert_eq!(result.contours.iter().map(Vec::len).sum::<usize>(), edges, "{result:?}");
    result
}

#[test]
fn a_rounded_square() {
    let square = Outline::rectangle(p(-5.0, -5.0), p(5.0, 5.0));
    let rounded = check(&square, round(2.0), 100.0 + 80.0 + 4.0 * PI, 8);
    let arcs: Vec<Edge> = rounded.contours[0].iter().copied().filter(|e| e.curve != Curve::Line).collect();
    let corner = Curve::Arc { center: p(5.0, 5.0), radius: 2.0, ccw: true };
    assert!(arcs.contains(&Edge { from: p(7.0, 5.0), curve: corner }));
    // And back again: an arc as tight as the distance becomes a corner.
    let back = check(&rounded, round(-2.0), 100.0, 4);
    assert_eq!(back.contours.len(), 1);
    check(&rounded, round(-1.0), 100.0 + 40.0 + PI, 8);
    check(&rounded, round(-3.0), 64.0, 4);
    assert!(rounded.offset(round(-7.0)).expect("simple").is_empty());
    check(&square, Offset::Delta { delta: 2.0, chamfer: false }, 196.0, 4);
    check(&square, Offset::Delta { delta: -2.0, chamfer: false }, 36.0, 4);
    check(&square, round(-2.0), 36.0, 4);
}

#[test]
fn opening_and_closing_an_l() {
    // Fillets: the reflex corner and then the convex ones become round.
    let fillet = check(&l_shape(), round(2.0), 180.0 + 2.0 * 70.0 + 5.0 * PI - 4.0, 11);
    let filled = check(&fillet, round(-2.0), 180.0 + (4.0 - PI), 7);
    let arc = Curve::Arc { center: p(10.0, 7.0), radius: 2.0, ccw: false };
    assert!(filled.contours[0].contains(&Edge { from: p(10.0, 5.0), curve: arc }), "{filled:?}");
    let chain = filled.offset(round(-2.0)).and_then(|o| o.offset(round(4.0))).and_then(|o| o.offset(round(-2.0)));
    let chain = chain.expect("simple");
    assert!((chain.area() - (180.0 - 5.0 * (4.0 - PI) + (4.0 - PI))).abs() < 1e-9, "{}", chain.area());
    assert_eq!(chain.contours[0].len(), 12);
    for edge in &chain.contours[0] {
        assert!(matches!(edge.curve, Curve::Line | Curve::Arc { radius: 2.0, .. }));
    }
}

#[test]
fn discs_and_rings() {
    let disc = Outline::circle(5.0);
    check(&disc, round(1.5), PI * 6.5 * 6.5, 1);
    check(&disc, Offset::Delta { delta: -1.5, chamfer: true }, PI * 3.5 * 3.5, 1);
    assert!(disc.offset(round(-5.0)).expect("simple").is_empty());
    let ring = super::super::combine(BoolOp::Difference, &[&disc, &Outline::circle(3.0)]).expect("simple");
    check(&ring, round(1.0), PI * (36.0 - 4.0), 2);
    check(&ring, round(3.0), PI * 64.0, 1);
    check(&ring, round(-0.5), PI * (4.5 * 4.5 - 3.5 * 3.5), 2);
    assert!(ring.offset(round(-1.0)).expect("simple").is_empty());
    assert_eq!(disc.offset(round(f64::NAN)), Err(PlaneError::NotFinite));
}

#[test]
fn a_hole_closes_whatever_its_edges() {
    let hole = Outline::circle(2.0).with_facets(64);
    let plate = Outline::rectangle(p(-9.0, -9.0), p(9.0, 9.0));
    let holed = super::super::combine(BoolOp::Difference, &[&plate, &hole]).expect("simple");
    for r in [2.0, 2.5, 3.0, 4.5] {
        check(&holed, round(r), 18.0 * 18.0 + 4.0 * 18.0 * r + PI * r * r, 8);
    }
}

#[test]
fn slots_with_round_ends() {
    // A slot in a plate, its end a half disc: narrower when the plate grows, and gone when it is as narrow as twice the
    // distance. The mouth of the slot keeps its corners, which become round.
    let slotted = |half: f64| {
        let plate = Outline::rectangle(p(-10.0, -10.0), p(10.0, 10.0));
        let slot = Outline::rectangle(p(-half, -20.0), p(half, 0.0));
        super::super::combine(BoolOp::Difference, &[&plate, &slot, &disc_at(p(0.0, 0.0), half)]).expect("simple")
    };
    let grown = 400.0 + 80.0 + PI;
    let mouth = 2.0 * (1.0 - PI / 4.0);
    check(&slotted(3.0), round(1.0), grown - (4.0 * 10.0 + PI * 2.0) - (4.0 + mouth), 14);
    for half in [1.0, 0.5] {
        let closed = slotted(half).offset(round(1.0)).expect("simple");
        let notch = 2.0 * half - if half == 1.0 { PI / 2.0 } else { notch_area() };
        assert!((closed.area() - (grown - notch)).abs() < 1e-9, "{half} {} {}", closed.area(), grown - notch);
        assert_eq!(closed.contours.len(), 1);
    }
}

/// What two discs of radius 1 cover between their centres, 1 apart, on one side of the line between them.
fn notch_area() -> f64 {
    // Half of two discs less half of their lens, less the halves of the discs that look away.
    let lens = 2.0 * PI / 3.0 - 0.75_f64.sqrt();
    PI / 2.0 - lens / 2.0
}

fn disc_at(center: Vec2, radius: f64) -> Outline {
    Outline { contours: vec![super::super::outline::full_circle(center, radius)] }
}

/// Shapes whose areas OpenSCAD 2021.01 tells: written as SVG, six digits, summed by the shoelace formula.
#[test]
fn areas_are_openscads() {
    let facets = |r: f64, facets: u32| Offset::Round { r, facets: Some(facets) };
    let delta = |delta: f64, chamfer: bool| Offset::Delta { delta, chamfer };
    let polygon =
        |corners: &[(f64, f64)]| Outline::polygon(&[corners.iter().map(|&(x, y)| p(x, y)).collect()]).expect("simple");
    let square = Outline::rectangle(p(0.0, 0.0), p(10.0, 10.0));
    let (l, spike) = (l_shape(), polygon(&[(0.0, 0.0), (10.0, 1.0), (0.0, 2.0)]));
    let arrow = polygon(&[(0.0, 0.0), (10.0, 1.0), (3.0, 2.0), (4.0, 8.0)]);
    let bow_tie = polygon(&[(0.0, 0.0), (10.0, 10.0), (10.0, 0.0), (0.0, 10.0)]);
    let star: Vec<(f64, f64)> = (0..10)
        .map(|i| {
            let (s, c) = octrace::geom::sin_cos_deg(f64::from(i) * 36.0);
            let r = if i % 2 == 0 { 10.0 } else { 4.0 };
            (r * c, r * s)
        })
        .collect();
    let star = polygon(&star);
    let plate = {
        let centered = |half: f64| Outline::rectangle(p(-half, -half), p(half, half));
        let (s, c) = octrace::geom::sin_cos_deg(30.0);
        let turn = crate::plane::Affine2 { x: p(c, s), y: p(-s, c), translation: Vec2::ZERO };
        let turned = Outline::rectangle(p(6.0, 0.0), p(9.0, 3.0)).moved(&turn, crate::Tolerance::default());
        super::super::combine(BoolOp::Difference, &[&centered(10.0), &centered(2.0), &turned]).expect("simple")
    };
    let cases = [
        (&square, facets(3.0, 8), 245.455720),
        (&l, facets(2.0, 16), 331.307488),
        (&l, facets(-2.0, 16), 56.938522),
        (&l, delta(2.0, false), 336.0),
        (&l, delta(-2.0, false), 56.0),
        (&l, delta(2.0, true), 332.568489),
        (&l, delta(-2.0, true), 56.686288),
        (&spike, delta(1.0, false), 44.309619),
        (&spike, delta(1.0, true), 35.684419),
        (&spike, facets(1.0, 20), 35.182042),
        (&arrow, facets(1.0, 7), 50.931221),
        (&arrow, facets(-0.3, 7), 8.294946),
        (&plate, facets(1.5, 12), 525.749802),
        (&plate, facets(-1.5, 12), 210.056897),
        (&star, delta(0.7, false), 173.026431),
        (&star, delta(-0.7, false), 72.773729),
        (&star, facets(-0.7, 9), 73.084842),
        (&star, delta(1.0, true), 192.797578),
        (&bow_tie, facets(2.0, 32), 157.297295),
    ];
    for (outline, offset, area) in cases {
        let found = outline.offset(offset).expect("simple").area();
        assert!((found - area).abs() < 2e-5 * area, "{offset:?}: {found}, OpenSCAD {area}");
    }
}
