//! Curved shapes beside OpenSCAD's: its areas at `$fn = 720` (2021.01; written as SVG, summed by the shoelace formula)
//! against those of true arcs. The polygons are inscribed, so theirs are smaller by some 1e-5.

use super::*;
use crate::Tolerance;
use octrace::geom::sin_cos_deg;
use octrace::{BoolOp, Vec2};

fn p(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

fn disc(x: f64, y: f64, r: f64) -> Flat {
    Flat::from(Outline::circle(r)).moved(Affine2::translation(p(x, y)))
}

fn rectangle(x: f64, y: f64, w: f64, h: f64) -> Flat {
    Outline::rectangle(p(x, y), p(x + w, y + h)).into()
}

fn polygon(corners: &[(f64, f64)]) -> Outline {
    Outline::polygon(&[corners.iter().map(|&(x, y)| p(x, y)).collect()]).expect("simple")
}

fn of<const N: usize>(op: BoolOp, shapes: [Flat; N]) -> Outline {
    let combined = Flat::combined(op, shapes).outline(Tolerance::default()).expect("simple");
    (*combined).clone()
}

fn rounded(outline: &Outline, distances: &[f64]) -> Outline {
    let round = |outline: Outline, &r: &f64| outline.offset(Offset::Round { r, facets: None });
    distances.iter().try_fold(outline.clone(), round).expect("simple")
}

fn check(name: &str, outline: &Outline, openscad: f64) {
    let area = outline.area();
    assert!((area - openscad).abs() < 5e-5 * openscad, "{name}: {area}, OpenSCAD {openscad}");
    let arcs = outline.contours.iter().flatten().count();
    assert!(arcs < 60, "{name} has {arcs} edges: its arcs are lost");
}

/// A plate with a large hole and a slot.
fn plate() -> Outline {
    of(BoolOp::Difference, [disc(0.0, 0.0, 10.0), disc(6.0, 0.0, 5.0), rectangle(-12.0, -2.0, 12.0, 4.0)])
}

fn crescent() -> Outline {
    of(BoolOp::Difference, [disc(0.0, 0.0, 5.0), disc(4.0, 0.0, 4.0)])
}

fn six_discs() -> Outline {
    of(
        BoolOp::Union,
        [0, 1, 2, 3, 4, 5].map(|i| {
            let (s, c) = sin_cos_deg(f64::from(i) * 60.0);
            disc(8.0 * c, 8.0 * s, 2.0)
        }),
    )
}

#[test]
fn chains_of_offsets() {
    let l = polygon(&[(0.0, 0.0), (20.0, 0.0), (20.0, 5.0), (8.0, 5.0), (8.0, 15.0), (0.0, 15.0)]);
    let star: Vec<(f64, f64)> = (0..10)
        .map(|i| {
            let ((s, c), r) = (sin_cos_deg(f64::from(i) * 36.0), if i % 2 == 0 { 10.0 } else { 4.0 });
            (r * c, r * s)
        })
        .collect();
    check("l", &rounded(&l, &[-1.0, 2.0, -1.0]), 179.141465);
    check("star", &rounded(&polygon(&star), &[-0.5, 1.0, -0.5]), 115.616224);
    check("six grown", &rounded(&six_discs(), &[3.0]), 422.185768);
    check("six closed", &rounded(&six_discs(), &[3.0, -3.0]), 88.360424);
}

#[test]
fn offsets_of_arcs() {
    check("round out", &rounded(&plate(), &[1.0]), 301.387642);
    check("round in", &rounded(&plate(), &[-1.0]), 116.178245);
    let delta = |delta, chamfer| plate().offset(Offset::Delta { delta, chamfer }).expect("simple");
    // The plate's tips are so sharp that the direction of OpenSCAD's last facets, a quarter of a degree off, shows.
    let mitred = delta(1.0, false);
    assert!((mitred.area() - 307.721295).abs() < 2e-4 * 307.721295, "{}", mitred.area());
    check("chamfer in", &delta(-1.0, true), 116.135348);
}

#[test]
fn hulls_and_sums() {
    let shapes =
        [disc(0.0, 0.0, 4.0), disc(9.0, 2.0, 1.0), rectangle(3.0, 8.0, 2.0, 2.0)].map(|s| of(BoolOp::Union, [s]));
    check("hull", &hull(&shapes), 118.767889);
    let sum = |a: &Outline, b: &Outline| a.minkowski(b, Tolerance::default()).expect("simple");
    let holed = of(BoolOp::Difference, [rectangle(-10.0, -10.0, 20.0, 20.0), disc(0.0, 0.0, 6.0)]);
    check("holed + disc", &sum(&holed, &Outline::circle(1.5)), 463.451973);
    let lens = of(BoolOp::Intersection, [disc(0.0, 0.0, 5.0), disc(4.0, 0.0, 5.0)]);
    check("lens + rectangle", &sum(&lens, &Outline::rectangle(p(0.0, 0.0), p(3.0, 2.0))), 85.128036);
    // Neither convex nor a disc: chords, so there are many edges.
    let chords = sum(&crescent(), &polygon(&[(0.0, 0.0), (3.0, 0.0), (1.0, 1.0), (0.0, 3.0)]));
    assert!((chords.area() - 104.785520).abs() < 2e-4 * 104.785520, "{}", chords.area());
}

#[test]
fn what_is_stretched() {
    let resized = Flat::from(crescent()).resized(p(10.0, 4.0), [false; 2], Tolerance::default()).expect("simple");
    for (shape, openscad) in
        [(resized, 24.692187), (Flat::from(crescent()).moved(Affine2::scale(p(2.0, 1.0))), 100.311631)]
    {
        let area = shape.outline(Tolerance::default()).expect("simple").area();
        assert!((area - openscad).abs() < 5e-4 * openscad, "{area}, OpenSCAD {openscad}");
    }
}

#[test]
fn holes_fill() {
    let ring = of(BoolOp::Difference, [disc(0.0, 0.0, 5.0), disc(1.0, 0.0, 3.0)]);
    let island = of(BoolOp::Union, [ring.into(), disc(1.0, 0.0, 1.0)]);
    let filled = island.filled().expect("simple");
    assert_eq!(filled.as_disc(), Some((p(0.0, 0.0), 5.0)));
}
