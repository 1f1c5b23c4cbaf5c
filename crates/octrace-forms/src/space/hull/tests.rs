use super::super::frusta::across;
use super::super::round::unit_ball;
use super::balls::Ball;
use super::discs::Disc;
use super::*;
use octrace::exec::Exec;
use octrace::query::{MeasureOptions, Measures, measure};
use octrace::{Tracer, TracerOptions, Vec3};
use std::f64::consts::PI;

pub(super) fn ball(center: [f64; 3], radius: f64) -> Solid {
    Solid::sphere().scale(Vec3::splat(radius)).translate(center)
}

pub(super) fn post(center: [f64; 3], radius: f64, height: f64) -> Solid {
    Solid::cylinder().scale([radius, radius, height]).translate(center)
}

pub(super) fn hull_of_all(solids: &[Solid]) -> Solid {
    hull(solids, Tolerance::default()).unwrap()
}

pub(super) fn measured(solid: &Solid) -> Measures {
    let exec = Exec::with_threads(1);
    let tracer = Tracer::build(solid, &TracerOptions::default(), &exec).unwrap();
    let options = MeasureOptions { tolerance: 1e-4, max_rays: 1_000_000 };
    measure(&tracer, &options, &exec).unwrap()
}

pub(super) fn check(solids: &[Solid], volume: f64) {
    check_to(1e-7, solids, volume);
}

pub(super) fn check_to(tolerance: f64, solids: &[Solid], volume: f64) {
    let measures = measured(&hull_of_all(solids));
    let off = (measures.volume - volume).abs();
    assert!(off <= measures.volume_error + tolerance * volume, "{} is not {volume}: {measures:?}", measures.volume);
}

#[test]
fn one_ball_is_its_hull() {
    check(&[ball([1.0, 2.0, 3.0], 2.0), ball([1.0, 2.5, 3.0], 1.0)], 4.0 / 3.0 * PI * 8.0);
}

#[test]
fn two_balls_make_a_capsule() {
    check(&[ball([0.0; 3], 1.0), ball([3.0, 4.0, 0.0], 1.0)], PI * 5.0 + 4.0 / 3.0 * PI);
}

#[test]
fn two_balls_of_different_sizes_make_a_tapered_capsule() {
    // Radii 3 and 1, 4 apart: the cone touches where the normal has 1/2 along the axis.
    let (tall, cap) = (4.0 * 0.75, |r: f64, h: f64| PI * h * h * (r - h / 3.0));
    let (big, small) = (3.0 * 0.75_f64.sqrt(), 0.75_f64.sqrt());
    let frustum = PI * tall / 3.0 * (big * big + big * small + small * small);
    check(&[ball([0.0; 3], 3.0), ball([0.0, 0.0, 4.0], 1.0)], frustum + cap(3.0, 4.5) + cap(1.0, 0.5));
}

#[test]
fn eight_balls_make_a_rounded_box() {
    let corner = |i: u32, side: u32, a: f64| if i >> side & 1 == 0 { 0.0 } else { a };
    let (a, b, c, r) = (4.0, 3.0, 2.0, 0.5);
    let balls: Vec<Solid> = (0..8).map(|i| ball([corner(i, 0, a), corner(i, 1, b), corner(i, 2, c)], r)).collect();
    let steiner = a * b * c + 2.0 * r * (a * b + b * c + c * a) + PI * r * r * (a + b + c) + 4.0 / 3.0 * PI * r.powi(3);
    check(&balls, steiner);
    let leaves = leaves(&[hull_of_all(&balls)]).len();
    assert_eq!(leaves, 8 + 12 + 1);
}

#[test]
fn four_balls_make_a_rounded_tetrahedron() {
    // Steiner's formula: volume, surface, edges with their outer angles. The regular tetrahedron of edge 2 sqrt(2).
    let r = 0.7;
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let edge = 8.0_f64.sqrt();
    let surface = 3.0_f64.sqrt() * edge * edge;
    let outer_angle = PI - libm::acos(1.0 / 3.0);
    let volume = 8.0 / 3.0 + surface * r + 6.0 * edge * outer_angle * r * r / 2.0 + 4.0 / 3.0 * PI * r.powi(3);
    check(&corners.map(|c| ball(c, r)), volume);
}

#[test]
fn balls_in_a_plane_make_a_plate() {
    let balls =
        [[0.0, 0.0, 1.0], [6.0, 0.0, 1.0], [6.0, 4.0, 1.0], [0.0, 4.0, 1.0], [3.0, 2.0, 1.0]].map(|c| ball(c, 1.0));
    check(&balls, 24.0 * 2.0 + PI / 2.0 * 20.0 + 4.0 / 3.0 * PI);
}

#[test]
fn a_ball_touching_another_from_inside_does_not_show() {
    check(&[ball([0.0; 3], 2.0), ball([1.0, 0.0, 0.0], 1.0)], 4.0 / 3.0 * PI * 8.0);
}

#[test]
fn a_cone_with_a_round_end() {
    // A ball of radius 3 and a point 5 away from its middle: the cone touches at a circle of radius 12/5.
    let point = Solid::block().scale(Vec3::splat(1e-9)).translate([0.0, 0.0, 5.0]);
    let volume = PI * 2.4 * 2.4 * 3.2 / 3.0 + PI * 4.8 * 4.8 * (3.0 - 1.6);
    check(&[ball([0.0; 3], 3.0), point], volume);
}

#[test]
fn scaled_balls_are_balls_in_their_own_coordinates() {
    let flat = |s: Solid| s.scale([1.0, 1.0, 0.25]).rotate([20.0, 30.0, 40.0]);
    let balls = [[0.0; 3], [3.0, 0.0, 0.0]].map(|c| flat(ball(c, 1.0)));
    assert!(leaves(&[hull_of_all(&balls)]).len() == 3);
    check(&balls, (PI * 3.0 + 4.0 / 3.0 * PI) / 4.0);
}

#[test]
fn posts_make_a_plate_with_rounded_edges() {
    let posts = [[0.0; 3], [6.0, 0.0, 0.0], [6.0, 4.0, 0.0], [0.0, 4.0, 0.0]].map(|c| post(c, 1.0, 2.5));
    check(&posts, 2.5 * (24.0 + 20.0 + PI));
    assert_eq!(leaves(&[hull_of_all(&posts)]).len(), 5);
    let lying = posts.map(|p| p.rotate([90.0, 0.0, 0.0]).translate([1.0, 2.0, 3.0]));
    assert_eq!(leaves(&[hull_of_all(&lying)]).len(), 5);
    check(&lying, 2.5 * (24.0 + 20.0 + PI));
}

#[test]
fn a_disc_and_a_point_make_an_oblique_cone() {
    let disc = post([0.0; 3], 2.0, 1e-7);
    let point = Solid::block().scale(Vec3::splat(1e-9)).translate([5.0, 1.0, 3.0]);
    check(&[disc, point], PI * 4.0);
}

#[test]
fn posts_of_two_heights_make_a_ramp() {
    let posts = [post([0.0; 3], 1.0, 2.0), post([10.0, 0.0, 0.0], 1.0, 4.0)];
    // The trapezoid between the axes, of area 30, moved about by a disc. In a slice along it at y the disc is a segment of
    // half-length w = sqrt(1 - y²), and the slice has the area 30 + 2 w 4.
    check(&posts, 60.0 + 4.0 * PI);
}

/// How deep a point is in a convex solid that reaches as far in a direction as `support` says: the least distance from a
/// plane that touches it. First directions on a net, then downhill from the best ones.
fn depth(support: &dyn Fn(Vec3) -> f64, net: &[Vec3], p: Vec3) -> f64 {
    let mut starts: Vec<(f64, Vec3)> = net.iter().map(|&d| (support(d) - d.dot(p), d)).collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let downhill = |&(mut least, mut at): &(f64, Vec3)| {
        let mut step = 0.1;
        while step > 1e-5 {
            let [u, v] = across(at);
            let around = [u, v, u + v, u - v].into_iter().flat_map(|w| [w, w * -1.0]);
            let tried = around.filter_map(|w| (at + w * step).normalized()).map(|d| (support(d) - d.dot(p), d));
            match tried.min_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((depth, d)) if depth < least => (least, at) = (depth, d),
                _ => step *= 0.5,
            }
        }
        least
    };
    starts[..3].iter().map(downhill).fold(f64::INFINITY, f64::min)
}

/// Compares a solid with the convex one that has this support, at random points.
pub(super) fn check_points(solid: &Solid, support: &dyn Fn(Vec3) -> f64, random: &mut impl FnMut() -> f64) {
    let net: Vec<Vec3> = unit_ball(24).filter_map(Vec3::normalized).collect();
    let tracer = Tracer::build(solid, &TracerOptions::default(), &Exec::with_threads(1)).unwrap();
    for _ in 0..60 {
        let p = Vec3::new(random(), random(), random()) * 5.0 - Vec3::splat(0.5);
        let depth = depth(support, &net, p);
        if depth.abs() > 1e-3 {
            assert_eq!(tracer.contains(p), depth > 0.0, "{p:?}, depth {depth}");
        }
    }
}

pub(super) fn random_numbers() -> impl FnMut() -> f64 {
    let mut state = 7_u64;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / f64::from(1 << 24)
    }
}

#[test]
fn balls_of_all_sizes_have_the_hull_of_the_definition() {
    let mut random = random_numbers();
    for count in [3, 4, 6, 12, 30] {
        let mut ball = || {
            let center = Vec3::new(random(), random(), random()) * 4.0;
            Ball { center, radius: (random() - 0.3).max(0.0) }
        };
        let balls: Vec<Ball> = (0..count).map(|_| ball()).collect();
        let support = |d: Vec3| balls.iter().map(|b| b.center.dot(d) + b.radius).fold(f64::NEG_INFINITY, f64::max);
        check_points(&balls::hull(&balls), &support, &mut random);
    }
}

#[test]
fn discs_of_all_sizes_have_the_hull_of_the_definition() {
    let mut random = random_numbers();
    for (count, levels) in [(3, 8.0), (4, 2.0), (6, 3.0), (12, 4.0), (30, 100.0)] {
        let mut disc = || {
            let z = (random() * levels).floor() / levels;
            Disc { center: Vec3::new(random(), random(), z) * 4.0, radius: (random() - 0.3).max(0.0) }
        };
        let discs: Vec<Disc> = (0..count).map(|_| disc()).collect();
        let reach = |disc: &Disc, d: Vec3| disc.center.dot(d) + disc.radius * (d.x * d.x + d.y * d.y).sqrt();
        let support = |d: Vec3| discs.iter().map(|disc| reach(disc, d)).fold(f64::NEG_INFINITY, f64::max);
        check_points(&discs::hull(&discs), &support, &mut random);
    }
}

#[test]
fn numbers_out_of_reach_are_nothing() {
    for far in [1e40, 1e200, f64::INFINITY, f64::NAN] {
        check(&[Solid::block(), Solid::sphere().translate([far, 0.0, 0.0]), Solid::block().scale([far; 3])], 1.0);
    }
}

#[test]
fn what_is_unbounded_is_an_error() {
    assert_eq!(hull(&[Solid::half_space()], Tolerance::default()).unwrap_err(), SpaceError::Unbounded);
}

#[test]
fn a_stretched_ring_has_the_hull_of_a_ring() {
    let torus = Solid::primitive(octrace::Primitive::Torus { minor: 0.5 }).scale([2.0, 1.0, 1.0]);
    // The ring and what it surrounds: a disc of radius 1, thickness 1, and the outer half of the tube.
    let outer_half = 2.0 * PI * (1.0 + 4.0 * 0.5 / (3.0 * PI)) * PI * 0.125;
    check(&[torus], 2.0 * (PI + outer_half));
}

#[test]
fn a_ring_has_a_hull_with_flat_ends() {
    let torus = Solid::primitive(octrace::Primitive::Torus { minor: 0.5 });
    let outer_half = 2.0 * PI * (1.0 + 4.0 * 0.5 / (3.0 * PI)) * PI * 0.125;
    check(&[torus.clone().scale([3.0; 3]).rotate([10.0, 20.0, 30.0])], 27.0 * (PI + outer_half));
    assert_eq!(leaves(&[hull_of_all(&[torus])]).len(), 2);
}

#[test]
fn a_ball_on_a_post_is_turned() {
    // A ball of radius 1 whose middle is 2 above a disc of radius 2: in section the tangent from (2, 0) to the circle.
    let solids = [post([0.0; 3], 2.0, 1e-9), ball([0.0, 0.0, 2.0], 1.0)];
    let hull = hull_of_all(&solids);
    let kinds = leaves(std::slice::from_ref(&hull)).len();
    assert!(kinds <= 4, "{kinds}");
    // The touching point is (2, 0) + t (cos a, sin a), with t = sqrt(8 - 1) and the angle 135 degrees minus asin(1/sqrt(8)).
    let angle = 0.75 * PI - libm::asin(1.0 / 8.0_f64.sqrt());
    let t = 7.0_f64.sqrt();
    let (radius, z) = (2.0 + t * libm::cos(angle), t * libm::sin(angle));
    let frustum = PI * z / 3.0 * (4.0 + 2.0 * radius + radius * radius);
    let tall = 3.0 - z;
    check(&solids, frustum + PI * tall * tall * (1.0 - tall / 3.0));
}

#[test]
fn holes_inside_do_not_show() {
    let plate = hull_of_all(&[[0.0; 3], [6.0, 0.0, 0.0], [6.0, 4.0, 0.0], [0.0, 4.0, 0.0]].map(|c| post(c, 1.0, 2.5)));
    let drilled = plate - post([3.0, 2.0, -1.0], 1.0, 9.0);
    assert_eq!(leaves(&[hull_of_all(std::slice::from_ref(&drilled))]).len(), 5);
    check(&[drilled.translate([1.0, 2.0, 3.0])], 2.5 * (24.0 + 20.0 + PI));
    // A hole through the rim does show: half of the disc is left.
    let halved = post([0.0; 3], 1.0, 1.0) - Solid::block().scale([4.0; 3]).translate([0.0, -2.0, -2.0]);
    check_to(1e-4, &[halved], PI / 2.0);
}

/// Volumes of the same in OpenSCAD 2021.01.
#[test]
fn hulls_of_booleans_are_those_of_openscad() {
    let block = |size: f64, at: [f64; 3]| Solid::block().scale([size; 3]).translate(at);
    let far = block(1.0, [6.0, 0.0, 0.0]);
    check(&[block(4.0, [0.0; 3]) - block(4.0, [1.0; 3]), far.clone()], 76.0);
    check(&[block(4.0, [0.0; 3]) & block(4.0, [1.0; 3]), far], 146.0 / 3.0);
}

/// The octree must never be visible, above all not where balls, cones and planes touch.
#[test]
fn rays_see_the_same_hull_with_and_without_an_octree() {
    let corners =
        [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 3.0, 0.0], [0.0, 3.0, 0.0], [1.0, 1.0, 2.0], [3.0, 2.0, 2.0]];
    let hulls = [
        hull_of_all(&corners.map(|c| ball(c, 1.0))),
        hull_of_all(&[ball([0.0; 3], 1.0), ball([3.0, 1.0, 0.0], 0.5), ball([1.0, 2.0, 1.0], 0.25)]),
        hull_of_all(&corners.map(|c| post(c, 0.5, 1.0))),
        hull_of_all(&[Solid::primitive(octrace::Primitive::Torus { minor: 0.5 }), ball([0.0, 0.0, 2.0], 0.5)]),
    ];
    hulls.iter().for_each(check_leaks);
}

/// Whether rays see the same with and without an octree.
pub(in crate::space) fn check_leaks(hull: &Solid) {
    let exec = Exec::with_threads(1);
    let with = Tracer::build(hull, &TracerOptions::default(), &exec).unwrap();
    let without = TracerOptions { accel: octrace::Accel::None, ..TracerOptions::default() };
    let without = Tracer::build(hull, &without, &exec).unwrap();
    let mut scratch = octrace::trace::Scratch::default();
    let (bounds, steps) = (with.bounds(), 24);
    let at = |i: i32, low: f64, high: f64| low + (high - low) * f64::from(i) / f64::from(steps);
    for i in 0..=steps {
        for j in 0..=steps {
            let p = Vec3::new(at(i, bounds.min.x, bounds.max.x), at(j, bounds.min.y, bounds.max.y), bounds.max.z + 1.0);
            for direction in [Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.25, 0.5, -1.0)] {
                let ray = octrace::Ray::new(p, direction);
                assert_eq!(with.spans_with(&ray, &mut scratch), without.spans(&ray), "{ray:?}");
            }
        }
    }
    assert_eq!(scratch.counters.leaks, 0);
}
