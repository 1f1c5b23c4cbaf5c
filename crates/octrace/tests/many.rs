//! Programs long enough that large parts of them stand for themselves while cells are large.

mod common;

use common::{cases, lattice_primitive, lattice_ray};
use octrace::exec::Exec;
use octrace::octree::BuildOptions;
use octrace::{Accel, Solid, Tracer, TracerOptions};
use proptest::prelude::*;

fn built(solid: &Solid, accel: Accel, octree: BuildOptions) -> Tracer {
    let options = TracerOptions { accel, octree, ..TracerOptions::default() };
    Tracer::build(solid, &options, &Exec::with_threads(1)).expect("nobody cancels")
}

/// A hundred small solids, which combine a few primitives each, combined two by two in turn, or all at once.
fn crowd() -> impl Strategy<Value = Solid> {
    let place = || (0..12_i32, 0..12_i32, 0..12_i32).prop_map(|(x, y, z)| [x, y, z].map(f64::from));
    let few = (prop::collection::vec(lattice_primitive(), 1..5), 0..3, place()).prop_map(|(solids, how, at)| {
        match how {
            0 => Solid::union(solids),
            1 => Solid::intersection(solids),
            _ => Solid::difference(solids),
        }
        .translate(at)
    });
    (prop::collection::vec(few, 100), 0..4).prop_map(|(solids, how)| match how {
        0 => Solid::union(solids),
        1 => Solid::difference([Solid::block().scale([14.0; 3])].into_iter().chain(solids)),
        2 => Solid::block().scale([11.0; 3]) & Solid::union(solids),
        _ => solids.into_iter().enumerate().fold(Solid::block(), |all, (i, solid)| match i % 3 {
            0 => solid - all,
            _ => all + solid,
        }),
    })
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn a_crowd_is_traced_as_without_an_octree(
        solid in crowd(),
        rays in prop::collection::vec((lattice_ray(), 0..12_i32, 0..12_i32, 0..12_i32), 40),
        leaf_surfaces in 1..8_usize,
        depth in prop_oneof![Just(None), (1..6_u32).prop_map(Some)],
    ) {
        let plain = built(&solid, Accel::None, BuildOptions::default());
        let fast = built(&solid, Accel::Octree, BuildOptions { leaf_surfaces, depth });
        for (mut ray, x, y, z) in rays {
            ray.origin += octrace::Vec3::from([x, y, z].map(f64::from));
            prop_assert_eq!(fast.spans(&ray), plain.spans(&ray));
            prop_assert_eq!(fast.first_hit(&ray), plain.first_hit(&ray));
        }
    }
}
