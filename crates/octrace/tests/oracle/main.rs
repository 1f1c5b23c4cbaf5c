//! The tracer against an oracle: a slow and obvious twin that knows solids by their definition, point by point, and
//! shares no code with the compiler or the tracer.

mod coincidence;
#[path = "../common/mod.rs"]
mod common;
mod deep;

mod lattice_boxes;
mod twin;

use common::{cases, lattice_ray, lattice_solid, near_lattice_ray};
use octrace::exec::Exec;
use octrace::octree::BuildOptions;
use octrace::{Accel, Ray, Solid, Tracer, TracerOptions, Vec3};
use proptest::prelude::*;
use twin::{Answer, ask};

/// Points nearer to a surface than this are nobody's.
const NEAR: f64 = 1e-9;

/// Without octree, with a shallow one, with a deep one.
fn tracers(solid: &Solid) -> [Tracer; 3] {
    let octree = |leaf_surfaces, depth| BuildOptions { leaf_surfaces, depth: Some(depth) };
    [(Accel::None, octree(0, 0)), (Accel::Octree, octree(4, 3)), (Accel::Octree, octree(1, 6))].map(
        |(accel, octree)| {
            let options = TracerOptions { accel, octree, ..TracerOptions::default() };
            Tracer::build(solid, &options, &Exec::with_threads(1)).expect("nobody cancels")
        },
    )
}

/// What the twin says of a point clear of all surfaces.
fn clearly_inside(solid: &Solid, p: Vec3) -> Option<bool> {
    let Answer { inside, clearance } = ask(solid, p);
    (clearance > NEAR).then_some(inside)
}

proptest! {
    #![proptest_config(cases(1500))]

    #[test]
    fn points_are_where_the_definition_says(
        solid in lattice_solid(),
        points in prop::collection::vec((-4.0..4.0, -4.0..4.0, -4.0..4.0), 50),
    ) {
        let tracers = tracers(&solid);
        for (x, y, z) in points {
            let p = Vec3::new(x, y, z);
            if let Some(inside) = clearly_inside(&solid, p) {
                for tracer in &tracers {
                    prop_assert_eq!(tracer.contains(p), inside, "{:?}", p);
                }
            }
        }
    }

    /// Spans and gaps hold what they should, in their middles and next to their ends.
    #[test]
    fn spans_and_gaps_are_where_the_definition_says(
        solid in lattice_solid(),
        rays in prop::collection::vec(prop_oneof![lattice_ray(), near_lattice_ray()], 10),
    ) {
        let tracers = tracers(&solid);
        for ray in rays {
            let middle = -ray.origin.dot(ray.direction) / ray.direction.dot(ray.direction);
            // No lattice solid's bounded parts are farther away.
            let far = 100.0 / ray.direction.length();
            for tracer in &tracers {
                let spans = tracer.spans(&ray);
                let ends: Vec<f64> = spans.iter().flat_map(|s| [s.enter_t(), s.exit_t()]).collect();
                let mut ends: Vec<f64> = ends.into_iter().map(|t| t.clamp(middle - far, middle + far)).collect();
                ends.insert(0, middle - far);
                ends.push(middle + far);
                for (i, pair) in ends.windows(2).enumerate().filter(|(_, pair)| pair[0] < pair[1]) {
                    for weight in [0.001, 0.1, 0.5, 0.8, 0.999] {
                        let t = pair[0] + (pair[1] - pair[0]) * weight;
                        if let Some(inside) = clearly_inside(&solid, ray.at(t)) {
                            prop_assert_eq!(i % 2 == 1, inside, "at {}, {:?}", t, spans);
                        }
                    }
                }
            }
        }
    }

    /// A hit's normal points out of the solid, and is at right angles to the surface.
    #[test]
    fn normals_point_outwards(
        solid in lattice_solid(),
        rays in prop::collection::vec((unit_cube(), unit_cube()), 20),
    ) {
        const STEP: f64 = 1e-6;
        const TINY: f64 = 1e-7;
        let tracers = tracers(&solid);
        for (origin, direction) in rays {
            // Rays of no lattice: they meet no edges.
            let ray = Ray::new(origin * 4.0, direction + Vec3::splat(1e-3));
            for tracer in &tracers {
                let Some(hit) = tracer.first_hit(&ray) else { continue };
                let point = tracer.surface_point(&ray, &hit);
                let n = point.normal;
                prop_assert!((n.length() - 1.0).abs() < 1e-14);
                prop_assert!(ask(&solid, point.position).clearance < NEAR, "a hit is on a surface");
                let beside = n.cross(if n.x.abs() < 0.6 { Vec3::X } else { Vec3::Y }).normalized().expect("not parallel");
                for tangent in [beside, n.cross(beside)] {
                    let off = ask(&solid, point.position + tangent * TINY).clearance;
                    prop_assert!(off < NEAR, "{:?} is no normal: {:e} off the surface", n, off);
                }
                let at = |distance: f64| clearly_inside(&solid, point.position + n * distance);
                // Where another surface is as near, a step of ten times the length may tell another story.
                if at(STEP) == at(10.0 * STEP) && at(-STEP) == at(-10.0 * STEP) {
                    prop_assert!(at(STEP) != Some(true) && at(-STEP) != Some(false), "{:?} at {:?}", n, point.position);
                }
            }
        }
    }
}

fn unit_cube() -> impl Strategy<Value = Vec3> {
    (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}
