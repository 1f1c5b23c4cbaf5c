use super::body::Chord;
use super::*;
use crate::exec::CancelToken;
use crate::geom::{Affine, Ray, sin_cos_deg};
use crate::model::Solid;
use crate::primitive::Polyhedron;
use crate::trace::TracerOptions;
use std::f64::consts::PI;

fn tracer(solid: &Solid) -> Tracer {
    Tracer::build(solid, &TracerOptions::default(), &Exec::default()).unwrap()
}

fn measured(solid: &Solid, tolerance: f64) -> Measures {
    let options = MeasureOptions { tolerance, ..MeasureOptions::default() };
    measure(&tracer(solid), &options, &Exec::default()).unwrap()
}

fn assert_near(a: Vec3, b: Vec3, tolerance: f64) {
    assert!((a - b).max_abs() <= tolerance, "{a:?} is not within {tolerance} of {b:?}");
}

/// Measures to two tolerances; what the errors claim must hold, and the box must be what it is.
fn check(name: &str, solid: Solid, volume: f64, centroid: [f64; 3], bbox: [[f64; 3]; 2]) {
    for tolerance in [1e-3, 2e-5] {
        let m = measured(&solid, tolerance);
        let off = (m.volume - volume).abs();
        assert!(m.converged, "{name}: {m:?}");
        assert!(m.volume_error <= tolerance * m.volume, "{name}: {m:?}");
        assert!(off <= m.volume_error, "{name}: the volume should be {volume}: {m:?}");
        assert_near(m.centroid.unwrap(), centroid.into(), m.centroid_error);
        let size = m.bbox.diagonal();
        assert_near(m.bbox.min, bbox[0].into(), 1e-6 * size);
        assert_near(m.bbox.max, bbox[1].into(), 1e-6 * size);
        assert!(m.bbox_error <= 1e-6 * size, "{name}: {m:?}");
    }
}

#[test]
fn simple_solids_are_measured() {
    let unit = Solid::block;
    check("block", unit().scale([2.0, 3.0, 4.0]), 24.0, [1.0, 1.5, 2.0], [[0.0; 3], [2.0, 3.0, 4.0]]);
    check(
        "ball",
        Solid::sphere().translate([5.0, 0.0, 0.0]),
        4.0 / 3.0 * PI,
        [5.0, 0.0, 0.0],
        [[4.0, -1.0, -1.0], [6.0, 1.0, 1.0]],
    );
    let hole = Solid::cylinder().scale([0.5, 0.5, 1.0]).translate([1.0, 1.0, 0.0]);
    let volume = 4.0 - PI / 4.0;
    check("drilled plate", unit().scale([2.0, 2.0, 1.0]) - hole, volume, [1.0, 1.0, 0.5], [[0.0; 3], [2.0, 2.0, 1.0]]);
}

#[test]
fn the_box_is_tight_where_nothing_is_axis_parallel() {
    // Ridges and corners in all directions; and the box of the operands is larger than that of the result.
    let turned = Solid::block().translate([-0.5, -0.5, -0.5]).rotate([0.0, 0.0, 45.0]);
    let reach = 0.5_f64.sqrt();
    check("standing on edge", turned.clone(), 1.0, [0.0; 3], [[-reach, -reach, -0.5], [reach, reach, 0.5]]);
    let lens = Solid::sphere() & Solid::sphere().translate([1.0, 0.0, 0.0]);
    let rim = 0.75_f64.sqrt();
    check("lens", lens, 5.0 / 12.0 * PI, [0.5, 0.0, 0.0], [[0.0, -rim, -rim], [1.0, rim, rim]]);
    let tilted = Solid::block().translate([-0.5, -0.5, -0.5]).rotate([20.0, 35.0, 50.0]);
    let corners =
        (0..8).map(|i| Vec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) - Vec3::splat(0.5));
    let map = crate::geom::Affine::rotation_deg(Vec3::new(20.0, 35.0, 50.0));
    let bounds = Bounds::around(corners.map(|p| map.point(p)));
    check("tilted block", tilted, 1.0, [0.0; 3], [bounds.min.into(), bounds.max.into()]);
}

#[test]
fn what_is_small_and_far_apart_is_not_overlooked() {
    let ball = |x: f64| Solid::sphere().scale([0.05, 0.05, 0.05]).translate([x, 0.5 * x, 0.3 * x]);
    let m = measured(&Solid::union([ball(-3.0), ball(3.0)]), 1e-2);
    assert!((m.volume - 8.0 / 3.0 * PI * 0.05 * 0.05 * 0.05).abs() <= m.volume_error, "{m:?}");
    assert!(m.converged && m.volume_error <= 1e-2 * m.volume, "{m:?}");
    assert_near(m.bbox.min, Vec3::new(-3.05, -1.55, -0.95), 1e-5);
    assert_near(m.bbox.max, Vec3::new(3.05, 1.55, 0.95), 1e-5);
}

#[test]
fn nothing_has_no_volume_and_no_box() {
    let ball = Solid::sphere;
    for nothing in [Solid::empty(), ball() - ball(), ball() & ball().translate([2.0, 0.0, 0.0])] {
        let m = measured(&nothing, 1e-3);
        assert_eq!((m.volume, m.volume_error, m.centroid, m.converged), (0.0, 0.0, None, true), "{m:?}");
        assert!(m.bbox.is_empty(), "{m:?}");
    }
}

/// The box of what is thin, and its volume as far as few rays tell it: by hand.
fn check_thin(name: &str, solid: &Solid, volume: f64, bbox: [[f64; 3]; 2]) {
    let options = MeasureOptions { tolerance: 1e-3, max_rays: 200_000 };
    let m = measure(&tracer(solid), &options, &Exec::default()).unwrap();
    let [min, max] = bbox.map(Vec3::from);
    let size = (max - min).length();
    assert_near(m.bbox.min, min, 1e-6 * size);
    assert_near(m.bbox.max, max, 1e-6 * size);
    assert!(m.bbox_error <= 1e-5 * size, "{name}: {m:?}");
    assert!(!m.converged || (m.volume - volume).abs() <= 1e-3 * volume, "{name}: {m:?}");
}

#[test]
fn thin_remainders_have_boxes() {
    let block = |size: [f64; 3]| Solid::block().scale(size);
    // A wedge between two faces at a thousandth of a degree.
    let cut = block([200.0, 20.0, 20.0]).translate([-50.0, -5.0, 0.0]).rotate([0.0, -0.001, 0.0]);
    let high = 100.0 * 0.001_f64.to_radians();
    check_thin("wedge", &(block([100.0, 10.0, 10.0]) - cut), 500.0 * high, [[0.0; 3], [100.0, 10.0, high]]);
    for thin in [1e-3, 1e-6] {
        let volume = 100.0 * thin;
        let wall = block([10.0; 3]) - block([10.0, 10.0, 20.0]).translate([thin, 0.0, -5.0]);
        check_thin("wall", &wall, volume, [[0.0; 3], [thin, 10.0, 10.0]]);
        let shifted = block([10.0; 3]).translate([thin, 0.0, 0.0]);
        check_thin(
            "what two have in common",
            &(block([10.0; 3]) & shifted.clone().translate([10.0 - 2.0 * thin, 0.0, 0.0])),
            volume,
            [[10.0 - thin, 0.0, 0.0], [10.0, 10.0, 10.0]],
        );
        // Tilted: 10 wide, 10 high, `thin` thick, turned by 30 degrees about z.
        let foil = (block([10.0; 3]) - shifted).rotate([0.0, 0.0, 30.0]);
        let (s, c) = (0.5, 0.75_f64.sqrt());
        check_thin("foil", &foil, volume, [[-10.0 * s, 0.0, 0.0], [thin * c, thin * s + 10.0 * c, 10.0]]);
        // A needle, upright and then lying askew.
        let four = |x: f64, y: f64| block([20.0; 3]).translate([x, y, -5.0]);
        let needle = block([10.0; 3]) - Solid::union([four(thin, -5.0), four(-5.0, thin)]);
        check_thin("needle", &needle, 10.0 * thin * thin, [[0.0; 3], [thin, thin, 10.0]]);
        let lying = needle.rotate([0.0, 30.0, 0.0]);
        check_thin(
            "lying needle",
            &lying,
            10.0 * thin * thin,
            [[0.0, 0.0, -thin * s], [thin * c + 10.0 * s, thin, 10.0 * c]],
        );
    }
}

/// A ball of flat faces, as OpenSCAD makes it: rings of corners between the poles.
fn faceted_ball(rings: u32, around: u32) -> (Vec<Vec3>, Polyhedron) {
    let corner = |i: u32, j: u32| {
        let ring = sin_cos_deg(180.0 * (f64::from(i) + 0.5) / f64::from(rings));
        let round = sin_cos_deg(360.0 * f64::from(j) / f64::from(around));
        Vec3::new(ring.0 * round.1, ring.0 * round.0, ring.1)
    };
    let corners: Vec<Vec3> = (0..rings).flat_map(|i| (0..around).map(move |j| corner(i, j))).collect();
    let mut faces: Vec<Vec<u32>> =
        vec![(0..around).rev().collect(), (0..around).map(|j| (rings - 1) * around + j).collect()];
    for (i, j) in (0..rings - 1).flat_map(|i| (0..around).map(move |j| (i, j))) {
        let k = (j + 1) % around;
        faces.push(vec![i * around + j, i * around + k, (i + 1) * around + k, (i + 1) * around + j]);
    }
    let ball = Polyhedron::new(corners.clone(), faces).expect("it is closed");
    (corners, ball)
}

#[test]
fn the_box_of_flat_faces_and_holes_is_proven_closely() {
    let (corners, ball) = faceted_ball(15, 30);
    let turn = [20.0, 35.0, 50.0];
    let map = Affine::rotation_deg(turn.into());
    let hole =
        |tilt: f64| Solid::cylinder().scale([0.3, 0.3, 4.0]).translate([0.0, 0.0, -2.0]).rotate([tilt, 0.0, 0.0]);
    // Holes where no corner is the farthest; seams between flat faces and the holes' walls are everywhere.
    let drilled = (Solid::primitive(ball) - hole(0.0) - hole(45.0)).rotate(turn);
    let m = measured(&drilled, 1e-2);
    let bounds = Bounds::around(corners.iter().map(|&p| map.point(p)));
    assert_near(m.bbox.min, bounds.min, 1e-6);
    assert_near(m.bbox.max, bounds.max, 1e-6);
    assert!(m.bbox_error <= 1e-6, "{m:?}");
}

#[test]
fn unbounded_solids_are_refused() {
    let error = measure(&tracer(&(Solid::half_space() - Solid::block())), &MeasureOptions::default(), &Exec::default());
    assert_eq!(error, Err(MeasureError::Unbounded));
    let cap = Solid::half_space() & Solid::sphere();
    let m = measured(&cap, 1e-3);
    assert!((m.volume - 2.0 / 3.0 * PI).abs() <= m.volume_error);
    assert_near(m.bbox.min, Vec3::new(-1.0, -1.0, 0.0), 2e-6);
}

#[test]
fn threads_change_nothing() {
    let tracer = tracer(&(Solid::block() - Solid::sphere().scale([0.7, 0.7, 0.7])));
    let with = |threads| measure(&tracer, &MeasureOptions::default(), &Exec::with_threads(threads)).unwrap();
    assert_eq!(with(1), with(3));
}

#[test]
fn a_small_budget_is_kept_and_confessed() {
    let options = MeasureOptions { tolerance: 1e-9, max_rays: 100_000 };
    let m = measure(&tracer(&Solid::sphere()), &options, &Exec::default()).unwrap();
    assert!(!m.converged);
    assert!((m.volume - 4.0 / 3.0 * PI).abs() <= m.volume_error, "{m:?}");
    assert!(m.rays < 200_000, "{m:?}");
}

#[test]
fn work_stops_when_asked_to() {
    let cancel = CancelToken::new();
    cancel.cancel();
    let exec = Exec { cancel, ..Exec::default() };
    let tracer = tracer(&Solid::sphere());
    assert_eq!(measure(&tracer, &MeasureOptions::default(), &exec), Err(MeasureError::Cancelled));
}

/// A ball with a sheet above it of which classification cannot say that it is empty.
struct Haunted;

impl Body for Haunted {
    type Scratch = ();
    type Region = ();

    fn bounds(&self) -> Bounds {
        Bounds::new(Vec3::splat(-2.0), Vec3::splat(2.0))
    }

    fn chords(&self, ray: &Ray, (): &mut (), chords: &mut Vec<Chord>) {
        chords.clear();
        let along = -ray.origin.dot(ray.direction);
        let beside = ray.at(along).length();
        if beside < 1.0 {
            let half = (1.0 - beside * beside).sqrt();
            chords.push(Chord { start: along - half, end: along + half });
        }
        if ray.direction.z != 0.0 {
            let t = (1.5 - ray.origin.z) / ray.direction.z;
            chords.push(Chord { start: t, end: t + 1e-13 });
        }
    }

    fn whole(&self) {}

    fn narrow(&self, (): &(), b: &Bounds) -> Option<()> {
        let nearest = b.min.max(Vec3::ZERO).min(b.max);
        (nearest.length() <= 1.0 || (b.min.z <= 1.5 && 1.5 <= b.max.z)).then_some(())
    }

    fn ceiling(&self, (): &(), b: &Bounds, up: Vec3) -> Option<Vec3> {
        Some(Vec3::from([0, 1, 2].map(|axis| if up[axis] < 0.0 { b.min[axis] } else { b.max[axis] })))
    }
}

#[test]
fn phantoms_do_not_count_as_reached() {
    let m = measure_body(&Haunted, &MeasureOptions::default(), &Exec::default()).unwrap();
    assert_near(m.bbox.min, Vec3::splat(-1.0), 1e-6);
    assert_near(m.bbox.max, Vec3::splat(1.0), 1e-6);
    assert!(m.bbox_error > 0.49, "what cannot be excluded is said: {m:?}");
    assert!((m.volume - 4.0 / 3.0 * PI).abs() <= m.volume_error);
}
