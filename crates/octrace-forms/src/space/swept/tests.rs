use super::*;
use crate::space::leaves::leaves;
use crate::space::mesh::TriangleMesh;
use crate::space::round::Extremes;
use crate::{Tolerance, space::hull::hull_of};
use octrace::{Affine, Contour, Curve, Edge, Vec2, Vec3};
use std::f64::consts::PI;

fn line(x: f64, y: f64) -> Edge {
    Edge { from: Vec2::new(x, y), curve: Curve::Line }
}

fn arc(x: f64, y: f64, center: [f64; 2], radius: f64) -> Edge {
    Edge { from: Vec2::new(x, y), curve: Curve::Arc { center: Vec2::new(center[0], center[1]), radius, ccw: true } }
}

fn stadium() -> Contour {
    vec![line(0.0, -1.0), arc(3.0, -1.0, [3.0, 0.0], 1.0), line(3.0, 1.0), arc(0.0, 1.0, [0.0, 0.0], 1.0)]
}

fn ring() -> Vec<Contour> {
    let circle = |radius: f64, ccw: bool| {
        let center = Vec2::new(5.0, 0.0);
        vec![Edge { from: center + Vec2::new(radius, 0.0), curve: Curve::Arc { center, radius, ccw } }]
    };
    vec![circle(2.0, true), circle(1.0, false)]
}

fn volume(mesh: TriangleMesh) -> f64 {
    mesh.polyhedron().map_or(0.0, |p| p.volume())
}

#[test]
fn meshes_have_the_right_volume() {
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-4 * expected, "{found} {expected}");
    let map = Affine::scale(Vec3::new(1.0, 1.0, 2.0));
    close(volume(prism_mesh(&[stadium()], 1.0, &map, 1e-3)), 2.0 * (6.0 + PI));
    close(volume(prism_mesh(&[stadium()], 0.0, &map, 1e-3)), 2.0 * (6.0 + PI) / 3.0);
    close(volume(prism_mesh(&ring(), 1.0, &map, 1e-3)), 6.0 * PI);
    close(volume(revolution_mesh(&ring(), &Affine::IDENTITY, 1e-3)), 30.0 * PI * PI);
    // The half of a stadium that is right of the axis: a cylinder of length 3 along x turned about y.
    close(volume(revolution_mesh(&[stadium()], &Affine::IDENTITY, 1e-3)), {
        let rounded_rim = 2.0 * PI * (3.0 + 4.0 / (3.0 * PI)) * PI / 2.0;
        2.0 * 9.0 * PI + rounded_rim
    });
}

#[test]
fn hulls_of_prisms_are_made_of_whole_circles() {
    let mut extremes = Extremes::default();
    extremes.add_prism(&[stadium()], 1.0, &Affine::IDENTITY, 1e-4);
    assert_eq!(extremes.rounds.len(), 4);
    let hull = hull_of(extremes, Tolerance::default());
    assert_eq!(leaves(&[hull]).len(), 3);
    // The disc of a segment sticks out.
    let segment = vec![line(0.0, -1.0), arc(0.0, 1.0, [2.0, 0.0], 5.0_f64.sqrt())];
    let mut extremes = Extremes::default();
    extremes.add_prism(&[segment], 1.0, &Affine::IDENTITY, 1e-4);
    assert!(extremes.rounds.is_empty() && extremes.points.len() > 8);
}

#[test]
fn hulls_of_turned_rings_are_exact() {
    let mut extremes = Extremes::default();
    extremes.add_revolution(&ring(), &Affine::IDENTITY, 1e-4);
    assert_eq!(extremes.rounds.len(), 1);
    assert_eq!(leaves(&[hull_of(extremes, Tolerance::default())]).len(), 2);
}

#[test]
fn rings_are_known_at_any_height() {
    let tube = &ring()[..1];
    let check = |height: f64, expected: &[(f64, f64)]| {
        let found = rings_at(tube, height, 1e-12);
        let close = |a: &(f64, f64), b: &(f64, f64)| (a.0 - b.0).abs() + (a.1 - b.1).abs() < 1e-12;
        assert!(found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| close(a, b)), "{found:?}");
    };
    check(0.0, &[(3.0, 7.0)]);
    check(1.2, &[(3.4, 6.6)]);
    check(2.5, &[]);
    assert_eq!(reaches(tube), [(3.0, 7.0)]);
    let step = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [2.0, 1.0], [2.0, 3.0], [0.0, 3.0]];
    let step: Vec<Contour> = vec![step.iter().map(|p| line(p[0], p[1])).collect()];
    assert_eq!(rings_at(&step, 0.0, 1e-12), [(0.0, 4.0)]);
    assert_eq!(rings_at(&step, 1.0, 1e-12), [(0.0, 2.0), (0.0, 4.0)]);
    assert_eq!(rings_at(&step, 2.0, 1e-12), [(0.0, 2.0)]);
    assert_eq!(rings_at(&step, 3.0, 1e-12), [(0.0, 2.0)]);
    assert_eq!(rings_at(&step, 3.1, 1e-12), []);
    assert_eq!(reaches(&[stadium()]), [(0.0, 4.0)]);
}

#[test]
fn what_is_left_of_the_axis_does_not_count() {
    // A circle with its middle left of the axis: what is right of it is a lens.
    let center = Vec2::new(-3.0, 0.0);
    let circle = vec![Edge { from: Vec2::new(2.0, 0.0), curve: Curve::Arc { center, radius: 5.0, ccw: true } }];
    let mut extremes = Extremes::default();
    extremes.add_revolution(std::slice::from_ref(&circle), &Affine::IDENTITY, 1e-4);
    let hull = crate::space::bounds(&hull_of(extremes, Tolerance::default()));
    assert!((hull.max.z - 4.0).abs() < 1e-2 && (hull.max.x - 2.0).abs() < 1e-2, "{hull:?}");
    let mesh = revolution_mesh(&[circle], &Affine::IDENTITY, 1e-3).polyhedron();
    // Twice the integral of pi x² over z from 0 to 4, with x = sqrt(25 - z²) - 3.
    let antiderivative =
        |z: f64| 34.0 * z - z * z * z / 3.0 - 3.0 * (z * (25.0 - z * z).sqrt() + 25.0 * libm::asin(z / 5.0));
    let volume = 2.0 * PI * antiderivative(4.0);
    assert!(mesh.is_some_and(|p| (p.volume() - volume).abs() < 1e-3 * volume));
}

#[test]
fn convexity_is_known() {
    assert!(is_convex(&[stadium()]));
    assert!(!is_convex(&ring()));
    assert!(is_convex(&ring()[..1]));
    let ell = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    assert!(is_convex_revolution(&[stadium()]) && !is_convex_revolution(&ring()[..1]));
    assert!(!is_convex(&[ell.iter().map(|p| line(p[0], p[1])).collect()]));
}
