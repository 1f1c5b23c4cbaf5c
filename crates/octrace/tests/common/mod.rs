//! Random solids and rays that love coincidence: small integers, shared planes, repeated values.
#![allow(dead_code, reason = "each test uses its share")]

use octrace::{Contour, Curve, Edge, Polyhedron, Primitive, Profile, Ray, Solid, Vec2, Vec3};
use proptest::prelude::*;

/// So many cases, unless the environment variable `PROPTEST_CASES` asks for another number.
pub fn cases(usual: u32) -> ProptestConfig {
    match std::env::var_os("PROPTEST_CASES") {
        Some(_) => ProptestConfig::default(),
        None => ProptestConfig::with_cases(usual),
    }
}

/// A number of a coarse lattice.
pub fn lattice() -> impl Strategy<Value = f64> {
    (-4i32..=4).prop_map(|i| f64::from(i) * 0.5)
}

pub fn lattice_point() -> impl Strategy<Value = Vec3> {
    (lattice(), lattice(), lattice()).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

fn size() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.5), Just(1.0), Just(1.5), Just(2.0)]
}

fn angle() -> impl Strategy<Value = f64> {
    prop_oneof![4 => Just(0.0), 2 => Just(90.0), 1 => Just(180.0), 1 => Just(45.0), 1 => Just(30.0), 1 => Just(17.0)]
}

fn polyhedron(points: &[[f64; 3]], faces: &[Vec<u32>]) -> Solid {
    let points = points.iter().map(|&p| Vec3::from(p)).collect();
    Solid::primitive(Polyhedron::new(points, faces.to_vec()).expect("a sound polyhedron"))
}

/// A straight prism of height 1 over a polygon, counter-clockwise from above.
fn prism(outline: &[[f64; 2]]) -> Solid {
    let n = outline.len() as u32;
    let points: Vec<[f64; 3]> = [0.0, 1.0].iter().flat_map(|&z| outline.iter().map(move |p| [p[0], p[1], z])).collect();
    let mut faces = vec![(0..n).rev().collect::<Vec<u32>>(), (n..2 * n).collect()];
    faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]));
    polyhedron(&points, &faces)
}

/// A block as a shell, and another one, solid (`true`) or a hollow in the first.
fn shells(low: [f64; 3], high: [f64; 3], solid: bool) -> Solid {
    let corners = |low: [f64; 3], high: [f64; 3]| {
        (0..8).map(move |i| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { low[axis] } else { high[axis] }))
    };
    let points: Vec<[f64; 3]> = corners([0.0; 3], [2.0; 3]).chain(corners(low, high)).collect();
    let block = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]].map(Vec::from);
    let mut other = block.clone().map(|face| face.iter().map(|i| i + 8).collect::<Vec<u32>>());
    if !solid {
        other.iter_mut().for_each(|face| face.reverse());
    }
    polyhedron(&points, &[block, other].concat())
}

/// Polyhedra; all but the first two are not convex.
pub fn polyhedra() -> Vec<Solid> {
    let tetrahedron = polyhedron(
        &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(Vec::from),
    );
    let octahedron = polyhedron(
        &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]],
        &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]].map(Vec::from),
    );
    let ell = prism(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
    let square = |half: f64, z: f64| [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]];
    let frame_faces: Vec<Vec<u32>> = (0..4)
        .flat_map(|i| {
            let j = (i + 1) % 4;
            // Outer wall, wall of the hole, bottom, top.
            [[i, j, j + 4, i + 4], [j + 8, i + 8, i + 12, j + 12], [j, i, i + 8, j + 8], [i + 4, j + 4, j + 12, i + 12]]
                .map(Vec::from)
        })
        .collect();
    let frame =
        polyhedron(&[square(1.0, 0.0), square(1.0, 1.0), square(0.5, 0.0), square(0.5, 1.0)].concat(), &frame_faces);
    let star: Vec<[f64; 2]> = (0..10)
        .map(|i| {
            let (sin, cos) = octrace::geom::sin_cos_deg(36.0 * f64::from(i));
            let radius = if i % 2 == 0 { 1.0 } else { 0.4 };
            [radius * cos, radius * sin]
        })
        .collect();
    vec![
        tetrahedron,
        octahedron,
        ell,
        frame,
        prism(&star),
        // A closed hollow, one that reaches a wall, shells that touch in a face, in an edge, that overlap.
        shells([0.5; 3], [1.5; 3], false),
        shells([0.0, 0.5, 0.5], [1.0, 1.5, 1.5], false),
        shells([2.0, 0.0, 0.0], [3.0, 2.0, 2.0], true),
        shells([2.0, 2.0, 0.0], [3.0, 3.0, 2.0], true),
        shells([1.0, 1.0, 0.0], [3.0, 3.0, 2.0], true),
    ]
}

fn line(x: f64, y: f64) -> Edge {
    Edge { from: Vec2::new(x, y), curve: Curve::Line }
}

/// An arc that starts in a corner, about a center.
fn arc(x: f64, y: f64, center: [f64; 2], ccw: bool) -> Edge {
    let (from, center) = (Vec2::new(x, y), Vec2::new(center[0], center[1]));
    Edge { from, curve: Curve::Arc { center, radius: (from - center).length(), ccw } }
}

/// Contours of small integers, most of them not convex: lines, arcs that bulge either way, holes, contours that touch.
pub fn contours() -> Vec<Vec<Contour>> {
    let polygon = |corners: &[[f64; 2]]| corners.iter().map(|&[x, y]| line(x, y)).collect::<Contour>();
    let square = |low: f64, high: f64| polygon(&[[low, low], [high, low], [high, high], [low, high]]);
    vec![
        vec![square(0.0, 1.0)],
        vec![polygon(&[[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0]])],
        vec![polygon(&[[-1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 2.0], [-1.0, 1.0]])],
        vec![square(-1.0, 2.0), square(0.0, 1.0)],
        // A hole in a corner, an island in a hole, a corner met twice.
        vec![square(0.0, 2.0), polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])],
        vec![square(-2.0, 2.0), square(-1.0, 1.0), vec![arc(1.0, 0.0, [0.0, 0.0], true)]],
        vec![polygon(&[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0]])],
        vec![polygon(&[
            [0.0, 0.0],
            [3.0, 0.0],
            [3.0, 3.0],
            [1.0, 3.0],
            [1.0, 2.0],
            [2.0, 2.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [0.0, 2.0],
        ])],
        vec![vec![arc(1.0, 0.0, [0.0, 0.0], true)]],
        vec![vec![arc(2.0, 1.0, [1.0, 1.0], true)], vec![arc(1.0, 1.0, [0.5, 1.0], false)]],
        // Stadium, half a disc, a crescent, most of a disc with a bite.
        vec![vec![line(0.0, 0.0), arc(1.0, 0.0, [1.0, 0.5], true), line(1.0, 1.0), arc(0.0, 1.0, [0.0, 0.5], true)]],
        vec![vec![line(-1.0, 0.0), arc(1.0, 0.0, [0.0, 0.0], true)]],
        vec![vec![arc(0.0, -1.0, [0.0, 0.0], true), arc(0.0, 1.0, [-1.0, 0.0], false)]],
        vec![vec![
            line(0.0, -1.0),
            line(2.0, -1.0),
            line(2.0, 1.0),
            line(0.0, 1.0),
            arc(0.0, 0.5, [0.0, 0.0], false),
            line(0.0, -0.5),
        ]],
        vec![vec![
            arc(1.0, 0.0, [0.0, 0.0], true),
            arc(-1.0, 0.0, [-2.0, 0.0], false),
            line(-2.0, -1.0),
            line(1.0, -1.0),
        ]],
        // Arcs that meet an axis at an angle: spindles and lemons, when they are turned about it.
        vec![vec![arc(0.0, -1.0, [-0.5, 0.0], true), line(0.0, 1.0)]],
        vec![vec![arc(0.0, -1.0, [0.5, 0.0], true), line(0.0, 1.0)]],
    ]
}

/// Prisms, tapered or not, and bodies of revolution.
pub fn swept() -> impl Strategy<Value = Solid> {
    let profile =
        prop::sample::select(contours()).prop_map(|contours| Profile::new(contours).expect("a sound profile"));
    (profile, prop_oneof![3 => Just(None), 2 => Just(Some(1.0)), 1 => Just(Some(0.5)), 1 => Just(Some(0.0))]).prop_map(
        |(profile, top)| {
            let profile = profile.into();
            Solid::primitive(match top {
                Some(top) => Primitive::Prism { profile, top },
                None => Primitive::Revolution(profile),
            })
        },
    )
}

/// A primitive, placed on the lattice.
pub fn lattice_primitive() -> impl Strategy<Value = Solid> {
    let shape = prop_oneof![
        4 => Just(Solid::block()),
        1 => prop::sample::select(polyhedra()),
        3 => swept(),
        2 => Just(Solid::sphere()),
        3 => Just(Solid::cylinder()),
        1 => Just(Solid::half_space()),
        1 => prop_oneof![Just(0.0), Just(0.5)].prop_map(|top| Solid::primitive(octrace::Primitive::Cone { top })),
        1 => prop_oneof![Just(0.125), Just(0.5), Just(1.0), Just(1.25)]
            .prop_map(|minor| Solid::primitive(octrace::Primitive::Torus { minor })),
    ];
    let scale = prop_oneof![
        2 => size().prop_map(Vec3::splat),
        1 => (size(), size(), size()).prop_map(|(x, y, z)| Vec3::new(x, y, z)),
        1 => (size(), size(), size()).prop_map(|(x, y, z)| Vec3::new(-x, y, z)),
    ];
    (shape, scale, (angle(), angle(), angle()), lattice_point())
        .prop_map(|(shape, scale, (a, b, c), at)| shape.scale(scale).rotate([a, b, c]).translate(at))
}

/// A CSG tree over such primitives.
pub fn lattice_solid() -> impl Strategy<Value = Solid> {
    lattice_primitive().prop_recursive(4, 24, 4, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 2..4).prop_map(Solid::union),
            prop::collection::vec(inner.clone(), 2..4).prop_map(Solid::intersection),
            prop::collection::vec(inner.clone(), 2..4).prop_map(Solid::difference),
            inner.clone().prop_map(|a| a.clone() - a),
            (inner.clone(), lattice_point()).prop_map(|(a, by)| a.clone() + a.translate(by)),
            inner.prop_map(|a| a.rotate([0.0, 0.0, 90.0])),
        ]
    })
}

/// A ray that is likely to run along edges and faces, through corners, or to start on a surface.
pub fn lattice_ray() -> impl Strategy<Value = Ray> {
    ray_from(prop_oneof![Just(0.0), Just(1.0), Just(7.0), Just(1000.0)])
}

/// The same, never from far away.
pub fn near_lattice_ray() -> impl Strategy<Value = Ray> {
    ray_from(prop_oneof![Just(0.0), Just(1.0), Just(7.0)])
}

fn ray_from(back: impl Strategy<Value = f64>) -> impl Strategy<Value = Ray> {
    let direction = prop_oneof![
        2 => prop_oneof![Just(Vec3::X), Just(Vec3::Y), Just(-Vec3::Z), Just(-Vec3::X), Just(Vec3::Z)],
        2 => lattice_point(),
        1 => (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| Vec3::new(x, y, z)),
    ];
    (lattice_point(), direction.prop_filter("a direction", |d| *d != Vec3::ZERO), back, -0.25..0.25, any::<bool>())
        .prop_map(|(through, direction, back, off, generic)| {
            let nudge = if generic { Vec3::new(off, off * 0.7, -off * 0.3) } else { Vec3::ZERO };
            Ray::new(through + nudge - direction * back, direction)
        })
}
