//! The laws that define the project.

mod common;

use common::{cases, lattice_point, lattice_ray, lattice_solid, near_lattice_ray};
use octrace::exec::Exec;
use octrace::octree::BuildOptions;
use octrace::trace::Scratch;
use octrace::traverse::TraversalKind;
use octrace::{Accel, Affine, Ray, Solid, Span, Tracer, TracerOptions, Vec3};
use proptest::prelude::*;

fn tracer(solid: &Solid, options: &TracerOptions) -> Tracer {
    Tracer::build(solid, options, &Exec::with_threads(1)).expect("nobody cancels")
}

fn canonical(solid: &Solid) -> Tracer {
    tracer(solid, &TracerOptions { accel: Accel::None, ..TracerOptions::default() })
}

fn octree(solid: &Solid, leaf_surfaces: usize, depth: u32, traversal: TraversalKind) -> Tracer {
    let octree = BuildOptions { leaf_surfaces, depth: Some(depth) };
    tracer(solid, &TracerOptions { octree, traversal, ..TracerOptions::default() })
}

proptest! {
    #![proptest_config(cases(1500))]

    /// The octree is an accelerator: it must never be visible.
    #[test]
    fn every_traversal_sees_what_the_canonical_tracer_sees(
        solid in lattice_solid(),
        rays in prop::collection::vec(lattice_ray(), 20),
        leaf_surfaces in 0usize..5,
        depth in 0u32..7,
    ) {
        let expected = canonical(&solid);
        for traversal in TraversalKind::ALL {
            let tested = octree(&solid, leaf_surfaces, depth, traversal);
            let mut scratch = Scratch::default();
            for ray in &rays {
                prop_assert_eq!(tested.spans_with(ray, &mut scratch), expected.spans(ray), "spans, {}", traversal);
                let hit = tested.first_hit_within(ray, f64::INFINITY, &mut scratch);
                prop_assert_eq!(hit, expected.first_hit(ray), "first hit, {}", traversal);
            }
            prop_assert_eq!(scratch.counters.leaks, 0);
        }
    }

    /// Spans are sorted, disjoint, never touching, never empty.
    #[test]
    fn spans_are_in_order(solid in lattice_solid(), ray in lattice_ray()) {
        let spans = canonical(&solid).spans(&ray);
        for span in &spans {
            prop_assert!(span.enter_t() < span.exit_t());
            prop_assert!(span.enter.is_none_or(|hit| hit.entering) && span.exit.is_none_or(|hit| !hit.entering));
        }
        for pair in spans.windows(2) {
            prop_assert!(pair[0].exit_t() < pair[1].enter_t());
        }
    }

    /// `A ∪ A = A`, `A ∩ A = A`, `A − A = ∅`, and De Morgan's laws.
    #[test]
    fn boolean_algebra_holds(a in lattice_solid(), b in lattice_solid(), ray in near_lattice_ray()) {
        let params = |solid: Solid| -> Vec<(f64, f64)> {
            canonical(&solid).spans(&ray).iter().map(|s| (s.enter_t(), s.exit_t())).collect()
        };
        let alone = params(a.clone());
        prop_assert_eq!(params(a.clone() + a.clone()), alone.clone());
        prop_assert_eq!(params(a.clone() & a.clone()), alone);
        prop_assert_eq!(params(a.clone() - a.clone()), vec![]);
        let everything = Solid::half_space() + Solid::half_space().scale([1.0, 1.0, -1.0]);
        let not = |s: Solid| everything.clone() - s;
        prop_assert_eq!(params(not(a.clone() + b.clone())), params(not(a.clone()) & not(b.clone())));
        prop_assert_eq!(params(not(a.clone() & b.clone())), params(not(a) + not(b)));
    }

    /// Moving solid and ray together moves no crossing off its surface by more than [`MOVED`], and faces that coincide
    /// still do: no span appears and none goes. (Rays of no lattice: whether one along a face is inside is decided by a
    /// tie rule, which looks at coordinates.)
    #[test]
    fn moving_solid_and_ray_together_moves_nothing(
        solid in lattice_solid(),
        (through, direction) in (generic(), generic()),
        (angles, by) in (generic(), generic()),
    ) {
        let map = Affine::translation(by * 10.0) * Affine::rotation_deg(angles * 180.0);
        let ray = Ray::new(through * 3.0 - direction * 4.0, direction);
        let tracer = canonical(&solid);
        let ends = |spans: &[Span]| spans.iter().flat_map(|span| [span.enter, span.exit]).collect::<Vec<_>>();
        let here = ends(&tracer.spans(&ray));
        let there = ends(&canonical(&solid.transform(map)).spans(&ray.transformed(&map)));
        prop_assert_eq!(here.len(), there.len(), "{:?} and {:?}", here, there);
        for pair in here.iter().zip(&there) {
            let (Some(here), Some(there)) = pair else {
                prop_assert!(pair.0.is_none() && pair.1.is_none());
                continue;
            };
            // Where the ray grazes the surface, `t` is known less well than the distance from it.
            let steepness = tracer.surface_point(&ray, here).normal.dot(direction).abs();
            let distance = 10.0 + ray.at(here.t).max_abs();
            prop_assert!((here.t - there.t).abs() * steepness <= MOVED * distance, "{:?} and {:?}", here, there);
        }
    }

    /// Points are inside exactly where their rays say so.
    #[test]
    fn points_agree_with_spans(solid in lattice_solid(), ray in lattice_ray(), at in lattice_point()) {
        let tested = octree(&solid, 2, 5, TraversalKind::default());
        for span in tested.spans(&ray) {
            let (enter, exit) = (span.enter_t().max(-1e3), span.exit_t().min(1e3));
            if exit - enter > 1e-6 {
                // A span that runs along a face is on one side of it by rounding alone. But no farther.
                let middle = ray.at((enter + exit) / 2.0);
                let near = [Vec3::ZERO, Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z];
                prop_assert!(near.iter().any(|&step| tested.contains(middle + step * 1e-9)));
            }
        }
        prop_assert_eq!(tested.contains(at), canonical(&solid).contains(at));
    }
}

/// The bound of the law of motion, relative to the distances involved: a few hundred roundings.
const MOVED: f64 = 1e-13;

/// A vector off any lattice.
fn generic() -> impl Strategy<Value = Vec3> {
    let number = || (0.05..1.0, any::<bool>()).prop_map(|(v, negative): (f64, bool)| if negative { -v } else { v });
    (number(), number(), number()).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

/// The example of the design: a drilled block whose hole ends in both faces.
#[test]
fn hits_are_exact() {
    let hole = Solid::cylinder().scale([0.25, 0.25, 1.0]).translate([0.5, 0.5, 0.0]);
    let tracer = octree(&(Solid::block() - hole), 2, 6, TraversalKind::default());
    let corner = tracer.first_hit(&Ray::new([0.125, 0.125, -4.0], [0.0, 0.0, 1.0]));
    assert_eq!(corner.expect("the corner is solid").t, 4.0);
    assert_eq!(tracer.first_hit(&Ray::new([0.5, 0.5, -4.0], [0.0, 0.0, 1.0])), None);
}

/// Operators nested tens of thousands deep neither overflow a small stack nor change the answer.
#[test]
fn deep_nesting_is_no_problem() {
    let solid = (0..20_000).fold(Solid::block(), |solid, i| match i % 2 {
        0 => solid - Solid::sphere().translate([9.0, 0.0, 0.0]),
        _ => solid + Solid::block().translate([0.0, 0.0, -4.0]),
    });
    let ray = Ray::new([0.5, 0.5, 9.0], [0.0, 0.0, -1.0]);
    let expected = canonical(&solid).spans(&ray);
    assert_eq!(expected.len(), 2);
    assert_eq!(octree(&solid, 2, 4, TraversalKind::default()).spans(&ray), expected);
}
