use super::tests::{check, check_leaks, check_points, hull_of_all, measured, post, random_numbers};
use super::*;
use crate::space::minkowski;
use discs::Disc;
use octrace::{Primitive, Vec3};
use std::f64::consts::PI;

/// A ring about an upright axis: a disc of this radius, rounded by a ball.
fn ring(center: [f64; 3], radius: f64, round: f64) -> Solid {
    Solid::primitive(Primitive::Torus { minor: round / radius }).scale(Vec3::splat(radius)).translate(center)
}

const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [0.0, 4.0]];

/// Four discs of radius 2 at the corners of a rectangle of 6 by 4: the area and the length of the outline.
const AREA: f64 = 24.0 + 40.0 + 4.0 * PI;
const OUTLINE: f64 = 20.0 + 4.0 * PI;

/// Steiner's formula for an upright prism of this height, rounded.
fn rounded_prism(height: f64, r: f64) -> f64 {
    let surface = 2.0 * AREA + OUTLINE * height;
    AREA * height + surface * r + (PI / 2.0 * OUTLINE + PI * height) * r * r + 4.0 / 3.0 * PI * r.powi(3)
}

#[test]
fn four_rings_make_a_rounded_plate() {
    let rings = CORNERS.map(|[x, y]| ring([x, y, 1.0], 2.0, 0.5));
    check(&rings, rounded_prism(0.0, 0.5));
    // A ring and its flat middle at each corner, a cylinder along each side, a block.
    assert_eq!(leaves(&[hull_of_all(&rings)]).len(), 4 * 2 + 4 + 1);
    let lying = rings.map(|r| r.rotate([90.0, 20.0, 0.0]).translate([1.0, 2.0, 3.0]));
    assert_eq!(leaves(&[hull_of_all(&lying)]).len(), 4 * 2 + 4 + 1);
    check(&lying, rounded_prism(0.0, 0.5));
}

#[test]
fn eight_rings_make_a_box_with_rounded_edges() {
    let rings: Vec<Solid> = [0.0, 3.0].iter().flat_map(|&z| CORNERS.map(|[x, y]| ring([x, y, z], 2.0, 0.5))).collect();
    check(&rings, rounded_prism(3.0, 0.5));
    assert_eq!(leaves(&[hull_of_all(&rings)]).len(), 4 * 5 + 8 + 1);
}

/// The tube is wider than the ring here: the ring is a spindle.
#[test]
fn small_rings_have_no_holes() {
    let rings = CORNERS.map(|[x, y]| ring([x, y, 1.0], 0.25, 1.0));
    let (area, outline) = (24.0 + 5.0 + PI / 16.0, 20.0 + PI / 2.0);
    check(&rings, 2.0 * area + PI / 2.0 * outline + 4.0 / 3.0 * PI);
}

#[test]
fn posts_rounded_by_a_ball_are_the_same() {
    let posts = hull_of_all(&CORNERS.map(|[x, y]| post([x, y, 0.0], 2.0, 3.0)));
    let parts = [posts, Solid::sphere().scale(Vec3::splat(0.5))];
    let sum = minkowski(&parts, Tolerance::default()).unwrap();
    let (found, expected) = (measured(&sum), rounded_prism(3.0, 0.5));
    let off = (found.volume - expected).abs();
    assert!(off <= found.volume_error + 1e-7 * expected, "{found:?} is not {expected}");
}

#[test]
fn rounded_discs_of_all_sizes_have_the_hull_of_the_definition() {
    let mut random = random_numbers();
    for (count, levels) in [(2, 8.0), (3, 1.0), (4, 2.0), (6, 3.0), (12, 4.0), (30, 100.0)] {
        let mut disc = || {
            let z = (random() * levels).floor() / levels;
            Disc { center: Vec3::new(random(), random(), z) * 4.0, radius: (random() - 0.3).max(0.0) }
        };
        let discs: Vec<Disc> = (0..count).map(|_| disc()).collect();
        let reach = |disc: &Disc, d: Vec3| disc.center.dot(d) + disc.radius * (d.x * d.x + d.y * d.y).sqrt();
        let support = |d: Vec3| 0.25 + discs.iter().map(|disc| reach(disc, d)).fold(f64::NEG_INFINITY, f64::max);
        check_points(&rounded::hull(&discs, 0.25, 1e-5), &support, &mut random);
    }
}

#[test]
fn rays_see_the_same_with_and_without_an_octree() {
    let plate = CORNERS.map(|[x, y]| ring([x, y, 1.0], 2.0, 0.5));
    let tower = [ring([0.0; 3], 2.0, 0.5), ring([3.0, 0.0, 0.0], 1.0, 0.5), ring([0.0, 0.0, 4.0], 1.0, 0.5)];
    check_leaks(&hull_of_all(&plate));
    check_leaks(&hull_of_all(&plate.map(|r| r.rotate([10.0, 20.0, 30.0]))));
    check_leaks(&hull_of_all(&tower));
}
