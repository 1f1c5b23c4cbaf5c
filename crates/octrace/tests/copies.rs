//! Equal solids that stand apart are stored once; nobody can tell, but by the time and the memory that it takes.

mod common;

use common::{cases, lattice_primitive, lattice_ray};
use octrace::compile::Copies;
use octrace::exec::Exec;
use octrace::model::families::{classic, copies};
use octrace::octree::BuildOptions;
use octrace::query::{MeasureOptions, measure};
use octrace::trace::{Backend, RayTile, RayTo, Scratch, TILE_PX};
use octrace::traverse::TraversalKind;
use octrace::{Accel, Camera, PartId, Projection, Ray, Solid, Tracer, TracerOptions, Vec3};
use proptest::prelude::*;

const SIZE_PX: u32 = TILE_PX as u32;

fn tracer(solid: &Solid, options: TracerOptions) -> Tracer {
    Tracer::build(solid, &options, &Exec::with_threads(1)).expect("nobody cancels")
}

fn shared(solid: &Solid) -> Tracer {
    tracer(solid, TracerOptions::default())
}

fn apart(solid: &Solid) -> Tracer {
    tracer(solid, TracerOptions { copies: Copies::Apart, ..TracerOptions::default() })
}

fn canonical(solid: &Solid) -> Tracer {
    tracer(solid, TracerOptions { accel: Accel::None, ..TracerOptions::default() })
}

/// Copies of a solid, `apart` from each other along every axis; at numbers that are not round.
fn grid(solid: &Solid, count: u32, apart: f64) -> Solid {
    let at = |i: u32| [i % 4, i / 4 % 4, i / 16].map(|i| f64::from(i) * apart + 0.1);
    Solid::union((0..count).map(|i| solid.clone().translate(at(i))))
}

fn camera(eye: Vec3, at: Vec3, projection: Projection) -> Camera {
    Camera { eye, at, up: Vec3::Z, projection }
}

const PERSPECTIVE: Projection = Projection::Perspective { fov_deg: 30.0 };

/// Holds that tiles, streams and rays by themselves see the same bits as without an octree. Returns how many rays met
/// something.
fn compare(solid: &Solid, octree: BuildOptions, camera: &Camera, size_px: u32) -> Result<usize, TestCaseError> {
    let expected = canonical(solid);
    let tested = tracer(solid, TracerOptions { octree, ..TracerOptions::default() });
    prop_assert!(tested.stats().copies > 0, "something is shared");
    prop_assert_eq!(tested.stats().copies, expected.stats().copies);
    let rays = camera.rays(size_px, size_px);
    let (mut scratch, mut tile, mut alone) = (Scratch::default(), RayTile::default(), Scratch::default());
    let mut met = 0;
    for (column, row) in (0..size_px / SIZE_PX).flat_map(|y| (0..size_px / SIZE_PX).map(move |x| (x, y))) {
        let corner = (column * SIZE_PX, row * SIZE_PX);
        let pixels = || (0..SIZE_PX).flat_map(|y| (0..SIZE_PX).map(move |x| (x, y)));
        let ray_of = |(x, y): (u32, u32)| rays.ray(f64::from(corner.0 + x) + 0.5, f64::from(corner.1 + y) + 0.5);
        let stream: Vec<RayTo> = pixels().map(|px| RayTo { ray: ray_of(px), end: f64::INFINITY }).collect();
        let hits: Vec<_> =
            stream.iter().map(|RayTo { ray, .. }| expected.first_body_hit(ray, f64::INFINITY, &mut alone)).collect();
        met += hits.iter().flatten().count();
        for (RayTo { ray, end }, hit) in stream.iter().zip(&hits) {
            prop_assert_eq!(&tested.first_body_hit(ray, *end, &mut scratch), hit);
        }
        for backend in Backend::ALL.into_iter().filter(|backend| backend.is_available()) {
            prop_assert_eq!(&tested.first_hits(&stream, backend, &mut tile, &mut scratch), &hits, "{:?}", backend);
            let Some(tiles) = tested.tiles(&rays, (size_px, size_px), backend) else { continue };
            tiles.trace(corner, (SIZE_PX, SIZE_PX), (0.5, 0.5), &mut tile, &mut scratch);
            for ((x, y), hit) in pixels().zip(&hits) {
                prop_assert_eq!(&tiles.hit(&tile, (x as usize, y as usize)), hit, "{:?} {} {}", backend, x, y);
            }
        }
    }
    prop_assert_eq!(scratch.counters.leaks, 0);
    Ok(met)
}

#[test]
fn a_grid_is_stored_once() {
    let solid = copies(100);
    let (once, each) = (shared(&solid).stats(), apart(&solid).stats());
    assert_eq!((once.copies, each.copies), (100, 0));
    assert_eq!((once.primitives, once.literals), (each.primitives, each.literals));
    assert!(once.surfaces < 20 && each.surfaces > 200, "{} {}", once.surfaces, each.surfaces);
    let bytes = |stats: octrace::trace::TracerStats| stats.octree.expect("there is one").bytes;
    assert!(8 * bytes(once) < bytes(each), "{} {}", bytes(once), bytes(each));
}

#[test]
fn every_way_to_trace_a_grid_gives_the_same_bits() {
    let solid = copies(100);
    for (eye, at) in [([-20.0, -30.0, 40.0], [13.0, 13.0, 0.0]), ([30.0, 1.0, 2.0], [10.0, 10.0, 0.0])] {
        for projection in [PERSPECTIVE, Projection::Orthographic { height: 12.0 }] {
            let camera = camera(eye.into(), at.into(), projection);
            let met = compare(&solid, BuildOptions::default(), &camera, 48).expect("all see the same");
            assert!(met > 500, "{met}");
        }
    }
}

#[test]
fn a_camera_in_a_copy_or_between_copies_sees_what_is_there() {
    let solid = grid(&(Solid::block().scale([2.0; 3]) - Solid::sphere().scale([0.5; 3]).translate([1.0; 3])), 64, 3.0);
    // In the stuff, in the hollow, in the gap, on a face.
    for eye in [[0.3, 0.3, 0.4], [1.1, 1.2, 1.05], [2.5, 2.6, 2.4], [2.1, 1.0, 1.0], [5.0, 5.0, 4.0]] {
        let camera = camera(eye.into(), [6.0, 5.5, 4.5].into(), Projection::Perspective { fov_deg: 100.0 });
        compare(&solid, BuildOptions::default(), &camera, 32).expect("all see the same");
    }
}

/// Copies in a hollow of something larger, beside things that are no copies, over a floor without an end.
#[test]
fn copies_among_other_things_are_copies() {
    let shell =
        Solid::block().scale([20.0; 3]).translate([-4.0; 3]) - Solid::block().scale([18.0; 3]).translate([-3.0; 3]);
    let floor = Solid::half_space().rotate([180.0, 0.0, 0.0]).translate([0.0, 0.0, -9.0]);
    let ball = Solid::sphere().translate([14.5, 1.0, 1.0]);
    let solid = Solid::union([shell.clone(), grid(&classic(), 64, 3.0), floor.clone(), ball.clone()]);
    assert_eq!(shared(&solid).stats().copies, 0, "the shell's box holds them all");
    let open = Solid::union([grid(&classic(), 64, 3.0), floor, ball]);
    assert_eq!(shared(&open).stats().copies, 64);
    let camera = camera(Vec3::new(30.0, -25.0, 22.0), Vec3::new(5.0, 5.0, 3.0), PERSPECTIVE);
    let met = compare(&open, BuildOptions::default(), &camera, 64).expect("all see the same");
    assert!(met > 1000, "{met}");
    for solid in [solid, open] {
        agree(&solid, Vec3::new(5.0, 5.0, 5.0), 12.0);
    }
}

/// Sharing changes rounding only: rays meet the same parts at the same parameters, and points are inside or outside.
#[track_caller]
fn agree(solid: &Solid, center: Vec3, radius: f64) {
    let (once, each) = (shared(solid), apart(solid));
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    };
    let mut met = 0;
    for _ in 0..4000 {
        let mut point = || center + Vec3::new(random(), random(), random()) * radius;
        let (from, to) = (point(), point());
        assert_eq!(once.contains(from), each.contains(from), "{from:?}");
        let ray = Ray::new(from, to - from);
        match (once.first_hit(&ray), each.first_hit(&ray)) {
            (Some(a), Some(b)) => {
                let (p, q) = (once.surface_point(&ray, &a), each.surface_point(&ray, &b));
                assert!(
                    (p.position - q.position).max_abs() < 1e-9 && (p.normal - q.normal).max_abs() < 1e-6,
                    "{ray:?}"
                );
                assert_eq!((a.leaf, p.part, a.entering), (b.leaf, q.part, b.entering));
                met += 1;
            }
            (a, b) => assert_eq!(a, b, "{ray:?}"),
        }
        let ends = |tracer: &Tracer| tracer.spans(&ray).len();
        assert_eq!(ends(&once), ends(&each), "{ray:?}");
    }
    assert!(met > 300, "{met}");
}

#[test]
fn copies_keep_their_parts_and_leaves() {
    let two = |i: u32| (Solid::block().part(PartId(77)) - Solid::sphere().scale([0.5; 3])).part(PartId(i));
    let solid = Solid::union((0..40).map(|i| two(i).translate([f64::from(i) * 1.5, 0.2, -0.1])));
    assert_eq!(shared(&solid).stats().copies, 40);
    agree(&solid, Vec3::new(5.0, 0.5, 0.5), 5.0);
    let tracer = shared(&solid);
    let ray = Ray::new([1.5 * 17.0 - 0.2, 0.3, 0.0], [1.0, 0.0, 0.0]);
    let hit = tracer.first_hit(&ray).expect("the eighteenth is hit");
    assert_eq!(tracer.surface_point(&ray, &hit).part, Some(PartId(17)), "the ball's outer part");
    assert_eq!(hit.leaf, 35);
}

#[test]
fn what_touches_or_overlaps_is_not_shared() {
    for (spacing, copies) in [(2.0, 0), (1.0, 0), (2.05, 0), (2.5, 64)] {
        let solid = grid(&(Solid::block().scale([2.0; 3]) - Solid::sphere()), 64, spacing);
        assert_eq!(shared(&solid).stats().copies, copies, "{spacing}");
    }
    // Only those are left out that touch something.
    let solid = grid(&classic(), 64, 3.0) + Solid::block().scale([1.0, 1.0, 20.0]);
    let found = shared(&solid).stats().copies;
    assert!((56..64).contains(&found), "{found}");
    agree(&solid, Vec3::new(5.0, 5.0, 5.0), 8.0);
}

#[test]
fn few_or_simple_or_turned_solids_are_not_shared() {
    assert_eq!(shared(&copies(20)).stats().copies, 0);
    assert_eq!(shared(&grid(&Solid::sphere(), 64, 3.0)).stats().copies, 0);
    let turned = |i: u32| classic().rotate([0.0, 0.0, f64::from(i)]).translate([f64::from(i) * 4.0, 0.0, 0.0]);
    assert_eq!(shared(&Solid::union((0..64).map(turned))).stats().copies, 0);
    // What is turned alike is equal; unions are copied as wholes.
    let screw = Solid::cylinder() + Solid::block().translate([-0.5, -0.5, 1.0]);
    assert_eq!(shared(&grid(&screw.rotate([30.0, 20.0, 10.0]), 64, 5.0)).stats().copies, 64);
}

/// A solid that is modelled far from its own origin is known there no better than that.
#[test]
fn copies_from_far_away_agree_too() {
    for far in [1e3, 1e6, 1e9, 1e12] {
        let solid = classic().translate([far, -far, 0.0]);
        let place = |i: i32| [f64::from(i % 8) * 3.0 - far, f64::from(i / 8) * 3.0 + far, 0.1];
        let solid = Solid::union((0..64).map(|i| solid.clone().translate(place(i))));
        // Not peeled off with the rest: in a difference, the solid stays where it was modelled.
        let carved = Solid::union((0..64).map(|i| {
            let hole = Solid::sphere().scale([0.4; 3]).translate([far + 1.0, -far, 0.0]);
            (classic().translate([far, -far, 0.0]) - hole).translate(place(i))
        }));
        for solid in [solid, carved] {
            let (expected, tested) = (canonical(&solid), shared(&solid));
            let mut scratch = Scratch::default();
            for i in 0..400 {
                let (x, y) = (f64::from(i % 20) * 1.2 - 1.0, f64::from(i / 20) * 1.2 - 1.0);
                let ray = Ray::new([x, y, 9.0], [0.3, 0.2, -1.0]);
                assert_eq!(tested.spans_with(&ray, &mut scratch), expected.spans(&ray), "{far} {ray:?}");
            }
            assert_eq!(scratch.counters.leaks, 0);
        }
    }
}

#[test]
fn volumes_are_those_of_all_copies() {
    let solid = copies(49);
    let exec = Exec::with_threads(1);
    let volume = |tracer: &Tracer| {
        measure(tracer, &MeasureOptions { tolerance: 1e-3, ..MeasureOptions::default() }, &exec)
            .expect("nobody cancels")
    };
    let (once, each) = (volume(&shared(&solid)), volume(&apart(&solid)));
    assert!((once.volume / each.volume - 1.0).abs() < 2e-3, "{} {}", once.volume, each.volume);
}

proptest! {
    #![proptest_config(cases(40))]

    /// Copies of anything, in octrees of any kind, seen from anywhere.
    #[test]
    fn copies_of_anything_are_traced_as_without_an_octree(
        first in lattice_primitive(),
        second in lattice_primitive(),
        how in 0..3,
        eye in (0.0..40.0, 0.0..40.0, 0.0..40.0),
        leaf_surfaces in 1_usize..5,
        depth in prop::option::of(2_u32..7),
    ) {
        let room = Solid::block().scale([7.0; 3]).translate([-3.5; 3]);
        let solid = match how {
            0 => Solid::union([first, second]) & room,
            1 => Solid::intersection([first, second]) & room,
            _ => room - first - second,
        };
        let solid = grid(&solid, 40, 9.3);
        prop_assume!(shared(&solid).stats().copies > 0);
        let eye = Vec3::new(eye.0, eye.1, eye.2);
        let camera = camera(eye, Vec3::new(14.0, 15.0, 9.0), Projection::Perspective { fov_deg: 60.0 });
        compare(&solid, BuildOptions { leaf_surfaces, depth }, &camera, 16)?;
    }

    /// Rays from anywhere to anywhere, walked in every way: the spans of whole lines, and what is crossed first.
    #[test]
    fn rays_pass_copies_as_without_an_octree(
        first in lattice_primitive(),
        second in lattice_primitive(),
        rays in prop::collection::vec((lattice_ray(), 0..4_i32, 0..4_i32, 0..3_i32), 20),
        traversal in prop::sample::select(TraversalKind::ALL.to_vec()),
        depth in prop::option::of(1_u32..7),
    ) {
        let room = Solid::block().scale([7.0; 3]).translate([-3.5; 3]);
        let solid = grid(&((first & room.clone()) + (room - second)), 40, 9.3);
        prop_assume!(shared(&solid).stats().copies > 0);
        let expected = canonical(&solid);
        let octree = BuildOptions { leaf_surfaces: 2, depth };
        let tested = tracer(&solid, TracerOptions { octree, traversal, ..TracerOptions::default() });
        let mut scratch = Scratch::default();
        for (mut ray, x, y, z) in rays {
            ray.origin += Vec3::from([x, y, z].map(|i| f64::from(i) * 9.3 + 0.1));
            prop_assert_eq!(tested.spans_with(&ray, &mut scratch), expected.spans(&ray));
            prop_assert_eq!(tested.first_hit_within(&ray, 5.0, &mut scratch), expected.first_hit_within(&ray, 5.0, &mut Scratch::default()));
            prop_assert_eq!(tested.contains(ray.origin), expected.contains(ray.origin));
        }
        prop_assert_eq!(scratch.counters.leaks, 0);
    }
}
