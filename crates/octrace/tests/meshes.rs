//! Meshes of many triangles: what eight rays find together is what each finds by itself, whatever is in the way.

use octrace::exec::Exec;
use octrace::geom::sin_cos_deg;
use octrace::octree::BuildOptions;
use octrace::trace::{Backend, RayTile, RayTo, Scratch, TILE_PX};
use octrace::{Accel, Camera, Polyhedron, Projection, Ray, Solid, Tracer, TracerOptions, Vec3};

const SIZE_PX: u32 = 3 * TILE_PX as u32;

/// A ball of radius 1 with bumps; a corner in each pole.
fn bumpy(rings: u32) -> Solid {
    let segments = 2 * rings;
    let mut points = vec![Vec3::Z, -Vec3::Z];
    for ring in 1..rings {
        for segment in 0..segments {
            let (u, v) = (360.0 * f64::from(segment) / f64::from(segments), 180.0 * f64::from(ring) / f64::from(rings));
            let ((su, cu), (sv, cv)) = (sin_cos_deg(u), sin_cos_deg(v));
            let radius = 1.0 + 0.1 * sin_cos_deg(5.0 * u).0 * sin_cos_deg(7.0 * v).0 * sv;
            points.push(Vec3::new(sv * cu, sv * su, cv) * radius);
        }
    }
    let point = |ring: u32, segment: u32| match ring {
        0 => 0,
        _ if ring == rings => 1,
        _ => 2 + (ring - 1) * segments + segment % segments,
    };
    let mut faces = Vec::new();
    for (ring, segment) in (0..rings).flat_map(|ring| (0..segments).map(move |segment| (ring, segment))) {
        let [a, b] = [point(ring, segment), point(ring, segment + 1)];
        let [c, d] = [point(ring + 1, segment), point(ring + 1, segment + 1)];
        faces.push(vec![a, c, d]);
        faces.push(vec![a, d, b]);
    }
    solid(points, faces)
}

fn solid(points: Vec<Vec3>, faces: Vec<Vec<u32>>) -> Solid {
    Solid::primitive(Polyhedron::new(points, faces).expect("a sound polyhedron"))
}

/// So many plates of one mesh, each as thick as the gaps are wide, together from 0 to 1 along x.
fn plates(count: u32) -> Solid {
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for plate in 0..count {
        let first = points.len() as u32;
        points.extend((0..8).map(|i| {
            let x = f64::from(2 * plate + (i & 1)) / f64::from(2 * count - 1);
            Vec3::new(x, f64::from(i >> 1 & 1), f64::from(i >> 2))
        }));
        let block = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        faces.extend(block.map(|face| face.map(|i| first + i).to_vec()));
    }
    solid(points, faces)
}

/// A large block with two hollows that overlap, as one mesh: in what they have in common the surface winds around -1 times.
fn hollows() -> Solid {
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for (low, high, hollow) in [(0.0, 4.0, false), (1.0, 2.5, true), (1.5, 3.0, true)] {
        let first = points.len() as u32;
        let at = |bit: u32| if bit & 1 == 0 { low } else { high };
        points.extend((0..8).map(|i| Vec3::new(at(i), at(i >> 1), at(i >> 2))));
        for face in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
            let mut face: Vec<u32> = face.iter().map(|i| first + i).collect();
            if hollow {
                face.reverse();
            }
            faces.push(face);
        }
    }
    solid(points, faces)
}

/// Compares a picture, and rays from where it was hit to everywhere, with what the canonical tracer says.
fn compare(solids: &[Solid], camera: Camera) {
    compare_in(BuildOptions::default(), solids, camera);
}

/// The same with another octree.
fn compare_in(octree: BuildOptions, solids: &[Solid], camera: Camera) {
    let exec = Exec::with_threads(1);
    let build = |accel| {
        let options = TracerOptions { accel, octree, ..TracerOptions::default() };
        Tracer::build_bodies(solids, &options, &exec).expect("nobody cancels")
    };
    let (expected, tested) = (build(Accel::None), build(Accel::Octree));
    let size = tested.bounds().size().max_abs();
    let rays = camera.rays(SIZE_PX, SIZE_PX);
    let (mut scratch, mut tile) = (Scratch::default(), RayTile::default());
    for backend in Backend::ALL.into_iter().filter(|backend| backend.is_available()) {
        let tiles = tested.tiles(&rays, (SIZE_PX, SIZE_PX), backend).expect("the camera is outside");
        let mut next = Vec::new();
        for (left, top) in (0..9).map(|i| (i % 3 * TILE_PX, i / 3 * TILE_PX)) {
            let corner = (left as u32, top as u32);
            tiles.trace(corner, (TILE_PX as u32, TILE_PX as u32), (0.5, 0.5), &mut tile, &mut scratch);
            for (x, y) in (0..TILE_PX).flat_map(|y| (0..TILE_PX).map(move |x| (x, y))) {
                let (hit, ray) = (tiles.hit(&tile, (x, y)), tiles.ray(&tile, (x, y)));
                let alone = expected.first_body_hit(&ray, f64::INFINITY, &mut Scratch::default());
                assert_eq!(hit, alone, "{backend:?}, {ray:?}");
                let Some((_, hit)) = hit else { continue };
                let turn = f64::from((x * 7 + y * 13) as u32);
                let ((su, cu), (sv, cv)) = (sin_cos_deg(37.0 * turn), sin_cos_deg(11.0 * turn));
                let off = if x % 2 == 0 { -1e-3 } else { 1e-3 } * size;
                let end = if y % 4 == 0 { 0.5 * size } else { f64::INFINITY };
                next.push(RayTo { ray: Ray::new(ray.at(hit.t + off), [sv * cu, sv * su, cv]), end });
            }
        }
        assert!(next.len() > 300, "{}", next.len());
        let mut blocked = vec![false; next.len()];
        let hits = tested.first_hits(&next, backend, &mut tile, &mut scratch);
        tested.blocked_into(&next, backend, &mut tile, &mut scratch, &mut blocked);
        for ((to, hit), blocked) in next.iter().zip(hits).zip(blocked) {
            assert_eq!(hit, expected.first_body_hit(&to.ray, to.end, &mut Scratch::default()), "{backend:?}, {to:?}");
            assert_eq!(hit.is_some(), blocked);
        }
    }
    assert_eq!(scratch.counters.leaks, 0);
}

fn from(eye: [f64; 3], at: [f64; 3], fov_deg: f64) -> Camera {
    Camera { eye: eye.into(), at: at.into(), up: Vec3::Z, projection: Projection::Perspective { fov_deg } }
}

fn along_x(middle: [f64; 3], height: f64) -> Camera {
    let at = Vec3::from(middle);
    Camera { eye: at - Vec3::X * 20.0, at, up: Vec3::Z, projection: Projection::Orthographic { height } }
}

#[test]
fn a_bumpy_ball() {
    compare(&[bumpy(40)], from([3.0, -4.0, 2.0], [0.0; 3], 25.0));
    // Through the corners in the poles and along rows of corners.
    compare(&[bumpy(24)], along_x([0.0; 3], 2.4));
}

#[test]
fn differences_and_intersections_of_meshes() {
    let hole = |radius: f64| Solid::cylinder().translate([0.0, 0.0, -0.5]).scale([radius, radius, 4.0]);
    let drilled = bumpy(24) - hole(0.4) - hole(0.3).rotate([0.0, 90.0, 0.0]);
    compare(std::slice::from_ref(&drilled), from([3.0, -4.0, 2.0], [0.0; 3], 25.0));
    compare(&[drilled & Solid::sphere().scale([1.02; 3])], from([3.0, -4.0, 2.0], [0.0; 3], 25.0));
    let other = bumpy(16).rotate([20.0, 30.0, 0.0]).translate([0.7, 0.2, 0.1]);
    compare(&[bumpy(16) | other.clone()], from([3.0, -4.0, 2.0], [0.0; 3], 30.0));
    compare(&[bumpy(16) - other.clone()], from([4.0, 0.5, 1.0], [0.0; 3], 30.0));
    compare(&[bumpy(16), other], from([3.0, -4.0, 2.0], [0.0; 3], 30.0));
}

#[test]
fn many_meshes_in_one_place() {
    let turned = (0..7).map(|i| bumpy(8).rotate([f64::from(i) * 20.0, 0.0, f64::from(i) * 33.0]));
    compare(&[Solid::intersection(turned)], from([3.0, -4.0, 2.0], [0.0; 3], 25.0));
}

#[test]
fn copies_of_a_mesh() {
    let copies = (0..64).map(|i| {
        let at = [f64::from(i % 4), f64::from(i / 4 % 4), f64::from(i / 16)].map(|c| c * 3.0);
        bumpy(8).translate(at)
    });
    compare(&[Solid::union(copies)], from([20.0, -14.0, 12.0], [4.0; 3], 30.0));
}

/// More crossings than are kept of a ray.
#[test]
fn plates_behind_each_other() {
    for count in [2, 3, 6, 11, 40] {
        compare(&[plates(count)], along_x([0.5; 3], 1.5));
        compare(&[plates(count)], from([-3.0, 0.4, 0.7], [0.5; 3], 30.0));
        // What is seen first is behind most of them.
        let hidden = plates(count) - Solid::sphere().scale([0.45; 3]).translate([0.0, 0.5, 0.5]);
        compare(std::slice::from_ref(&hidden), along_x([0.5; 3], 1.5));
        compare(&[hidden & Solid::sphere().scale([0.4; 3]).translate([0.5; 3])], along_x([0.5; 3], 1.1));
    }
}

#[test]
fn hollows_that_overlap() {
    compare(&[hollows()], from([9.0, -8.0, 7.0], [2.0; 3], 35.0));
    let open = hollows() - Solid::block().scale([2.0, 5.0, 5.0]).translate([2.0, -0.5, -0.5]);
    compare(std::slice::from_ref(&open), from([12.0, 1.0, 3.0], [2.0; 3], 30.0));
    compare(&[open], along_x([2.0; 3], 5.0));
}

fn ring(minor: f64) -> Solid {
    Solid::primitive(octrace::Primitive::Torus { minor })
}

#[test]
fn tori() {
    for minor in [0.25, 0.4, 1.0, 1.25] {
        compare(&[ring(minor).scale([1.0, 1.5, 0.8])], from([3.0, -4.0, 2.0], [0.0; 3], 25.0));
    }
    // In the ring's plane, four crossings a ray.
    compare(&[ring(0.5)], along_x([0.0; 3], 2.0));
    let thick = || ring(0.4).rotate([20.0, 30.0, 0.0]);
    compare(&[Solid::block().scale([3.0, 3.0, 1.0]).translate([-1.5, -1.5, -0.5]) - thick()], along_x([0.0; 3], 2.0));
    compare(&[thick(), ring(0.2) - Solid::sphere().scale([0.5; 3]).translate([1.0, 0.0, 0.0])], along_x([0.0; 3], 2.0));
    let copies =
        (0..9).map(|i| (thick() - Solid::cylinder()).translate([4.0 * f64::from(i % 3), 4.0 * f64::from(i / 3), 0.0]));
    compare(&[copies.reduce(|all, next| all + next).expect("nine")], from([14.0, -9.0, 8.0], [4.0, 4.0, 0.0], 35.0));
}

/// Several tori in one cell, each crossed up to four times there; from five on scalar code looks at them.
#[test]
fn tori_in_large_cells() {
    let octree = BuildOptions { leaf_surfaces: 40, depth: Some(1) };
    let turned = |i: i32| ring(0.3).rotate([36.0 * f64::from(i), 50.0, 0.0]);
    for count in [1, 2, 4, 6] {
        let rings = (0..count).map(turned).reduce(|all, next| all + next).expect("some");
        let slab = Solid::block().scale([3.0, 3.0, 0.9]).translate([-1.5, -1.5, -0.4]);
        for solid in [rings.clone(), slab.clone() & rings.clone(), slab - rings] {
            compare_in(octree, std::slice::from_ref(&solid), from([3.0, -4.0, 1.0], [0.0; 3], 25.0));
            compare_in(octree, &[solid], along_x([0.0; 3], 1.5));
        }
    }
}

#[test]
fn meshes_and_tori() {
    let torus = || ring(0.4).scale([0.8; 3]);
    compare(&[bumpy(16) - torus()], from([3.0, -4.0, 2.0], [0.0; 3], 25.0));
    compare(&[torus() - bumpy(16).scale([0.8; 3])], from([3.0, -4.0, 2.0], [0.0; 3], 25.0));
    compare(&[plates(11) & torus().rotate([0.0, 90.0, 0.0]).translate([0.5; 3])], along_x([0.5; 3], 1.1));
}
