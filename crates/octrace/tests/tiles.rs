//! Tiles of rays see what each of their rays sees, whatever machine they are compiled for.

mod common;

use common::{cases, lattice_point, lattice_solid};
use octrace::exec::Exec;
use octrace::octree::BuildOptions;
use octrace::trace::{Backend, EightRays, LANES, RayTile, RayTo, Scratch, TILE_PX};
use octrace::{Accel, Camera, Projection, Ray, Solid, Tracer, TracerOptions, Vec3};
use proptest::prelude::*;

const SIZE_PX: u32 = TILE_PX as u32;

fn tracer(bodies: &[Solid], options: &TracerOptions) -> Tracer {
    Tracer::build_bodies(bodies, options, &Exec::with_threads(1)).expect("nobody cancels")
}

/// Compares all rays of a film of one tile; `place` is where in its pixel each ray goes through. Returns how many of the
/// backends could trace it.
fn compare(bodies: &[Solid], octree: BuildOptions, camera: &Camera, place: (f64, f64)) -> Result<usize, TestCaseError> {
    let expected = tracer(bodies, &TracerOptions { accel: Accel::None, ..TracerOptions::default() });
    let tested = tracer(bodies, &TracerOptions { octree, ..TracerOptions::default() });
    let rays = camera.rays(SIZE_PX, SIZE_PX);
    let mut scratch = Scratch::default();
    let mut tile = RayTile::default();
    let mut backends = 0;
    for backend in Backend::ALL.into_iter().filter(|backend| backend.is_available()) {
        let Some(tiles) = tested.tiles(&rays, (SIZE_PX, SIZE_PX), backend) else { continue };
        backends += 1;
        // A tile at the picture's edge has fewer pixels.
        for (width, height) in [(SIZE_PX, SIZE_PX), (SIZE_PX - 3, 5)] {
            tiles.trace((0, 0), (width, height), place, &mut tile, &mut scratch);
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
                let ray = rays.ray(f64::from(x) + place.0, f64::from(y) + place.1);
                let alone = expected.first_body_hit(&ray, f64::INFINITY, &mut Scratch::default());
                let hit = tiles.hit(&tile, (x as usize, y as usize));
                prop_assert_eq!(hit, alone, "{:?}, {:?}", backend, ray);
            }
        }
    }
    prop_assert_eq!(scratch.counters.leaks, 0);
    Ok(backends)
}

fn projection() -> impl Strategy<Value = Projection> {
    prop_oneof![
        prop::sample::select(vec![1.0, 20.0, 53.13, 120.0]).prop_map(|fov_deg| Projection::Perspective { fov_deg }),
        prop::sample::select(vec![0.5, 4.0, 16.0]).prop_map(|height| Projection::Orthographic { height }),
    ]
}

proptest! {
    #![proptest_config(cases(400))]

    /// From everywhere, also from within and from the surface; through lattice points, where edges and corners are.
    #[test]
    fn tiles_see_what_rays_see(
        bodies in prop::collection::vec(lattice_solid(), 1..3),
        eye in lattice_point(),
        back in prop::sample::select(vec![0.0, 1.0, 7.5, 40.0]),
        at in lattice_point(),
        projection in projection(),
        in_the_middle in any::<bool>(),
        leaf_surfaces in 0_usize..5,
        depth in prop::option::of(0_u32..7),
    ) {
        let forward = (at - eye).normalized().unwrap_or(Vec3::X);
        let camera = Camera { eye: eye - forward * back, at, up: Vec3::Z, projection };
        let place = if in_the_middle { (0.5, 0.5) } else { (0.0, 0.0) };
        compare(&bodies, BuildOptions { leaf_surfaces, depth }, &camera, place)?;
    }
}

/// Up to eight rays; perhaps without the first one.
fn eight(rays: &[RayTo], without_first: bool) -> EightRays {
    let mut eight = EightRays::NONE;
    for (lane, RayTo { ray, end }) in rays.iter().enumerate() {
        eight.put(lane, ray, *end);
    }
    eight.lanes &= !u8::from(without_first);
    eight
}

/// Compares a stream of rays with each ray by itself, without an octree.
fn compare_stream(bodies: &[Solid], octree: BuildOptions, rays: &[RayTo]) -> Result<(), TestCaseError> {
    let expected = tracer(bodies, &TracerOptions { accel: Accel::None, ..TracerOptions::default() });
    let tested = tracer(bodies, &TracerOptions { octree, ..TracerOptions::default() });
    let (mut scratch, mut tile) = (Scratch::default(), RayTile::default());
    for backend in Backend::ALL.into_iter().filter(|backend| backend.is_available()) {
        let hits = tested.first_hits(rays, backend, &mut tile, &mut scratch);
        for (RayTo { ray, end }, hit) in rays.iter().zip(hits) {
            let alone = expected.first_body_hit(ray, *end, &mut Scratch::default());
            prop_assert_eq!(hit, alone, "{:?}, {:?} up to {}", backend, ray, end);
        }
        let mut blocked = vec![false; rays.len()];
        tested.blocked_into(rays, backend, &mut tile, &mut scratch, &mut blocked);
        // By eights, of which every third holds one ray less.
        let eights: Vec<EightRays> = rays.chunks(LANES).enumerate().map(|(i, rays)| eight(rays, i % 3 == 0)).collect();
        let mut blocked_lanes = vec![0xAA; eights.len()];
        tested.eights_blocked_into(&eights, backend, &mut tile, &mut scratch, &mut blocked_lanes);
        for (index, RayTo { ray, end }) in rays.iter().enumerate() {
            let alone = expected.first_body_hit(ray, *end, &mut Scratch::default()).is_some();
            prop_assert_eq!(blocked[index], alone, "{:?}, {:?} up to {}", backend, ray, end);
            let (number, lane) = (index / LANES, index % LANES);
            let asked = eights[number].lanes >> lane & 1 != 0;
            prop_assert_eq!(
                blocked_lanes[number] >> lane & 1 != 0,
                asked && alone,
                "{:?}, {:?} by eights",
                backend,
                ray
            );
        }
    }
    prop_assert_eq!(scratch.counters.leaks, 0);
    Ok(())
}

/// Rays from anywhere, also from within and from the surface, along axes and through lattice points.
fn any_ray() -> impl Strategy<Value = RayTo> {
    let end = prop::sample::select(vec![0.5, 1.0, 2.0, f64::INFINITY, 0.0, -1.0]);
    (lattice_point(), lattice_point(), prop::sample::select(vec![-1.0, -0.25, 0.0, 0.3]), end).prop_filter_map(
        "rays have a direction",
        |(from, to, back, end)| {
            let direction = to - from;
            let ray = Ray { origin: from + direction * back, direction };
            (direction != Vec3::ZERO).then_some(RayTo { ray, end })
        },
    )
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn streams_see_what_rays_see(
        bodies in prop::collection::vec(lattice_solid(), 1..3),
        rays in prop::collection::vec(any_ray(), 1..40),
        leaf_surfaces in 0_usize..5,
        depth in prop::option::of(0_u32..7),
    ) {
        compare_stream(&bodies, BuildOptions { leaf_surfaces, depth }, &rays)?;
    }
}

#[test]
fn usual_pictures_are_traced_in_tiles() {
    let drilled = Solid::block() - Solid::cylinder().scale([0.3, 0.3, 1.0]).translate([0.5, 0.5, 0.0]);
    let floor = Solid::half_space().rotate([180.0, 0.0, 0.0]);
    let available = Backend::ALL.into_iter().filter(|backend| backend.is_available()).count();
    for projection in [Projection::Perspective { fov_deg: 30.0 }, Projection::Orthographic { height: 2.0 }] {
        let camera = Camera { eye: Vec3::new(3.0, -4.0, 2.5), at: Vec3::splat(0.5), up: Vec3::Z, projection };
        let bodies = [drilled.clone(), floor.clone() + Solid::sphere().translate([0.0, 2.0, 1.0])];
        assert_eq!(
            compare(&bodies, BuildOptions::default(), &camera, (0.5, 0.5)).expect("all see the same"),
            available
        );
    }
}

/// In a cell with one surface, a ball that was taken away: the first crossing leads out of the solid, the second back in.
#[test]
fn a_ray_that_starts_inside_leaves_before_it_enters() {
    let solid = Solid::block().scale([8.0; 3]) - Solid::sphere().scale([0.3; 3]).translate([3.0, 3.0, 3.0]);
    let ray = Ray::new([2.2, 3.0, 3.0], [1.0, 0.0, 0.0]);
    compare_stream(&[solid], BuildOptions { leaf_surfaces: 1, depth: Some(2) }, &[RayTo { ray, end: f64::INFINITY }])
        .expect("it leaves");
}
