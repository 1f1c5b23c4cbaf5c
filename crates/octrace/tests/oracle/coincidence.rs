//! Coincidence by name: faces that lie in one another, seen face-on, grazing and along their plane. All by hand.
//!
//! A ray *in* a plane is on one side of it by rule: on the side of greater coordinates. So it is outside a block along its
//! top and inside it along its bottom, and along a wall between two blocks it is inside one of them.

use crate::tracers;
use octrace::{Ray, Solid};

/// The spans that every tracer must find.
fn check(solid: &Solid, origin: [f64; 3], direction: [f64; 3], expected: &[(f64, f64)]) {
    let ray = Ray::new(origin, direction);
    for tracer in tracers(solid) {
        let spans: Vec<(f64, f64)> = tracer.spans(&ray).iter().map(|s| (s.enter_t(), s.exit_t())).collect();
        assert_eq!(spans, expected, "{ray:?}");
        let first = expected.iter().flat_map(|s| [s.0, s.1]).find(|&t| 0.0 < t && t.is_finite());
        assert_eq!(tracer.first_hit(&ray).map(|hit| hit.t), first, "{ray:?}");
    }
}

/// As [`check`], where square roots are involved.
fn check_nearly(solid: &Solid, origin: [f64; 3], direction: [f64; 3], expected: &[(f64, f64)]) {
    let ray = Ray::new(origin, direction);
    for tracer in tracers(solid) {
        let spans = tracer.spans(&ray);
        let ends = spans.iter().zip(expected).flat_map(|(s, e)| [(s.enter_t(), e.0), (s.exit_t(), e.1)]);
        let near = ends.into_iter().all(|(a, b)| a == b || (a - b).abs() < 1e-13);
        assert!(spans.len() == expected.len() && near, "{spans:?} instead of {expected:?}");
    }
}

fn cube(size: f64, at: [f64; 3]) -> Solid {
    Solid::block().scale([size; 3]).translate(at)
}

/// A cube of edge 2 loses a cube of edge 1 whose top lies in its top.
#[test]
fn a_difference_of_cubes_that_share_a_face() {
    let solid = cube(2.0, [0.0; 3]) - cube(1.0, [0.5, 0.5, 1.0]);
    // Face-on, from above and below: the pocket is open, and its floor is at z = 1.
    check(&solid, [1.0, 1.0, 5.0], [0.0, 0.0, -1.0], &[(4.0, 5.0)]);
    check(&solid, [1.0, 1.0, -5.0], [0.0, 0.0, 1.0], &[(5.0, 6.0)]);
    check(&solid, [0.25, 1.0, 5.0], [0.0, 0.0, -1.0], &[(3.0, 5.0)]);
    // Grazing: into the pocket through the shared plane at x = 1.25, out of it into its wall at x = 1.5.
    check(&solid, [-2.75, 1.0, 2.25], [1.0, 0.0, -0.0625], &[(4.25, 4.75)]);
    // Along the shared plane.
    check(&solid, [-4.0, 1.0, 2.0], [1.0, 0.0, 0.0], &[]);
    // Just below it: the wall on either side of the pocket.
    check(&solid, [-4.0, 1.0, 1.75], [1.0, 0.0, 0.0], &[(4.0, 4.5), (5.5, 6.0)]);
    // Along the pocket's wall, above its floor: on the side of the block.
    check(&solid, [-4.0, 0.25, 1.5], [1.0, 0.0, 0.0], &[(4.0, 6.0)]);
}

/// A plate with a round hole that ends in both faces.
#[test]
fn a_hole_that_ends_in_both_faces() {
    let solid = Solid::block().scale([4.0, 4.0, 1.0]) - Solid::cylinder().translate([2.0, 2.0, 0.0]);
    check(&solid, [2.0, 2.0, 5.0], [0.0, 0.0, -1.0], &[]);
    check(&solid, [2.5, 2.5, -5.0], [0.0, 0.0, 1.0], &[]);
    check(&solid, [0.5, 0.5, 5.0], [0.0, 0.0, -1.0], &[(4.0, 5.0)]);
    // Through the hole at a slant: in at the axis on top, out at x = 3 half way down.
    check(&solid, [-6.0, 2.0, 5.0], [2.0, 0.0, -1.0], &[(4.5, 5.0)]);
    // Grazing.
    check(&solid, [-2.0, 2.0, 1.125], [1.0, 0.0, -0.0625], &[(2.0, 3.0), (5.0, 6.0)]);
    // Along the upper face, and along the lower one.
    check(&solid, [-4.0, 2.0, 1.0], [1.0, 0.0, 0.0], &[]);
    check(&solid, [-4.0, 2.0, 0.0], [1.0, 0.0, 0.0], &[(4.0, 5.0), (7.0, 8.0)]);
    // Across, half way up; and touching the hole's wall.
    check(&solid, [-4.0, 2.0, 0.5], [1.0, 0.0, 0.0], &[(4.0, 5.0), (7.0, 8.0)]);
    check(&solid, [-4.0, 1.0, 0.5], [1.0, 0.0, 0.0], &[(4.0, 8.0)]);
}

/// `A − A` is nothing, whatever `A`, and however it was placed.
#[test]
fn a_solid_minus_itself() {
    let torus = Solid::primitive(octrace::Primitive::Torus { minor: 0.5 });
    let all = [Solid::block(), Solid::sphere(), Solid::cylinder(), Solid::half_space(), torus];
    for shape in all {
        for angles in [[0.0, 0.0, 0.0], [0.0, 90.0, 0.0], [17.0, 30.0, 45.0]] {
            let a = shape.clone().scale([1.0, 2.0, 0.5]).rotate(angles);
            let solid = a.clone() - a;
            for direction in [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.3, -0.2, 0.9]] {
                check(&solid, [0.25, 0.25, 0.125], direction, &[]);
                check(&solid, [0.0, 0.0, 0.0], direction, &[]);
            }
        }
    }
}

/// Two cubes side by side are one block: the wall between them is not there.
#[test]
fn a_union_of_cubes_that_share_a_wall() {
    let solid = cube(1.0, [0.0; 3]) + cube(1.0, [1.0, 0.0, 0.0]);
    check(&solid, [-4.0, 0.5, 0.5], [1.0, 0.0, 0.0], &[(4.0, 6.0)]);
    check(&solid, [4.0, 0.5, 0.5], [-1.0, 0.0, 0.0], &[(2.0, 4.0)]);
    // Grazing the wall: through it at y = 1/2.
    check(&solid, [0.96875, 0.0, 0.5], [0.0625, 1.0, 0.0], &[(0.0, 1.0)]);
    // Across a face of both, at a slant, through the edge of the wall.
    check(&solid, [0.0, 0.5, 2.0], [1.0, 0.0, -1.0], &[(1.0, 2.0)]);
    // Along a common face.
    check(&solid, [-4.0, 1.0, 0.5], [1.0, 0.0, 0.0], &[]);
}

/// A ray *in* the wall between two cubes: it has the solid on both sides.
#[test]
fn along_a_shared_wall() {
    let solid = cube(1.0, [0.0; 3]) + cube(1.0, [1.0, 0.0, 0.0]);
    check(&solid, [1.0, -4.0, 0.5], [0.0, 1.0, 0.0], &[(4.0, 5.0)]);
    check(&solid, [1.0, 0.5, 4.0], [0.0, 0.0, -1.0], &[(3.0, 4.0)]);
    check(&solid, [1.0, -4.0, -4.0], [0.0, 1.0, 1.0], &[(4.0, 5.0)]);
}

/// Of a wedge that ends in a ball, a ray through the ball's middle meets nothing that the ball has not swallowed.
#[test]
fn a_sphere_that_swallows_the_tip_of_a_wedge() {
    let wedge = Solid::half_space() - Solid::half_space().rotate([0.0, 45.0, 0.0]).translate([0.0, 0.0, 1.0]);
    let solid = wedge - Solid::sphere().scale([2.0, 2.0, 2.0]);
    check(&solid, [0.0, 0.0, -5.0], [0.0, 0.0, 1.0], &[]);
    check(&solid, [0.0, 0.0, 0.0], [0.0, 0.0, -1.0], &[]);
    check(&(Solid::half_space() + solid), [0.0, 0.0, -5.0], [0.0, 0.0, 1.0], &[(5.0, f64::INFINITY)]);
}

/// A ball on a floor.
#[test]
fn a_sphere_that_touches_a_plane() {
    let floor = || Solid::half_space().scale([1.0, 1.0, -1.0]);
    let ball = || Solid::sphere().translate([0.0, 0.0, 1.0]);
    let both = floor() + ball();
    // Face-on, through the point of contact: one stretch.
    check(&both, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0], &[(3.0, f64::INFINITY)]);
    check(&both, [0.0, 0.0, -5.0], [0.0, 0.0, 1.0], &[(f64::NEG_INFINITY, 7.0)]);
    check(&both, [3.0, 0.0, 5.0], [0.0, 0.0, -1.0], &[(5.0, f64::INFINITY)]);
    // Along the plane, through the point of contact.
    check(&both, [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0], &[]);
    // Through the middle, along the plane.
    check(&both, [-4.0, 0.0, 1.0], [1.0, 0.0, 0.0], &[(3.0, 5.0)]);
    // Grazing: through the ball, out of it, into the floor at x = 2.
    let (middle, half) = (7.9375 / 2.03125, 1.8125_f64.sqrt() / 2.03125);
    let expected = [(middle - half, middle + half), (6.0, f64::INFINITY)];
    check_nearly(&both, [-4.0, 0.0, 0.75], [1.0, 0.0, -0.125], &expected);
    // Cut off at the floor it is the same ball.
    let cut = ball() - floor();
    check(&cut, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0], &[(3.0, 5.0)]);
    check(&cut, [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0], &[]);
    // What both have in common is one point: nothing.
    let common = ball() & floor();
    check(&common, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0], &[]);
    check(&common, [-4.0, 0.0, 0.0], [1.0, 0.0, 0.0], &[]);
    // And the floor from which the ball was taken is whole.
    let dented = floor() - ball();
    check(&dented, [0.0, 0.0, 5.0], [0.0, 0.0, -1.0], &[(5.0, f64::INFINITY)]);
}
