//! Solids and rays at the limits of arithmetic: the octree shows nothing that the canonical tracer does not, parameters are
//! numbers, and nothing panics.

mod common;

use common::polyhedra;
use octrace::exec::Exec;
use octrace::octree::BuildOptions;
use octrace::trace::Scratch;
use octrace::{Accel, Affine, Primitive, Ray, Solid, Spans, Tracer, TracerOptions, Vec3};

fn tracer(solid: &Solid, accel: Accel, leaf_surfaces: usize, depth: u32) -> Tracer {
    let octree = BuildOptions { leaf_surfaces, depth: Some(depth) };
    let options = TracerOptions { accel, octree, ..TracerOptions::default() };
    Tracer::build(solid, &options, &Exec::with_threads(1)).expect("nobody cancels")
}

/// The spans of each ray, where all tracers agree on them and on what follows from them.
fn all_spans(solid: &Solid, rays: &[Ray]) -> Vec<Spans> {
    let canonical = tracer(solid, Accel::None, 0, 0);
    let expected: Vec<Spans> = rays.iter().map(|ray| canonical.spans(ray)).collect();
    for (leaf_surfaces, depth) in [(4, 0), (1, 2), (0, 6)] {
        let tested = tracer(solid, Accel::Octree, leaf_surfaces, depth);
        let mut scratch = Scratch::default();
        for (ray, expected) in rays.iter().zip(&expected) {
            assert_eq!(&tested.spans_with(ray, &mut scratch), expected, "{ray:?}");
            let hit = tested.first_hit_within(ray, f64::INFINITY, &mut scratch);
            assert_eq!(hit, canonical.first_hit(ray), "{ray:?}");
            assert!(hit.is_none_or(|hit| hit.t.is_finite()), "{hit:?}");
            assert_eq!(tested.contains(ray.origin), canonical.contains(ray.origin), "{ray:?}");
            assert_eq!(scratch.counters.leaks, 0, "{ray:?}");
            let _ = tested.explain(ray).to_string();
        }
    }
    for hit in expected.iter().flatten().flat_map(|span| [span.enter, span.exit]).flatten() {
        assert!(hit.t.is_finite(), "{hit:?}");
    }
    expected
}

fn spans(solid: &Solid, ray: &Ray) -> Spans {
    all_spans(solid, std::slice::from_ref(ray)).remove(0)
}

#[test]
fn a_plane_that_is_met_at_infinity_is_not_met() {
    for z in [1.0, -1.0] {
        for slope in [1e-310, -1e-310, 5e-324] {
            let ray = Ray::new([0.0, 0.0, z], [1.0, 0.0, slope]);
            let spans = spans(&Solid::half_space(), &ray);
            assert_eq!(spans.iter().any(|span| span.enter.is_none() && span.exit.is_none()), z > 0.0, "{spans:?}");
        }
    }
}

#[test]
fn parameters_that_are_no_numbers_are_no_hits() {
    let tiny = 1e-315;
    assert_eq!(spans(&Solid::block(), &Ray::new([-1.0, 0.5, 0.5], [tiny, 0.0, 0.0])), []);
    assert_eq!(spans(&Solid::sphere(), &Ray::new([2.0, 0.1, 0.0], [-tiny, 0.0, tiny * 0.1])), []);
    assert_eq!(spans(&Solid::block(), &Ray::new([-1.0, 0.5, 0.5], [1e300, 0.0, 0.0])).len(), 1);
}

#[test]
fn lines_that_pass_at_a_great_distance_meet_what_is_unbounded_only() {
    let slab = Solid::half_space() - Solid::half_space().translate([0.0, 0.0, 1.0]);
    let tilted = Solid::block().rotate([17.0, 30.0, 45.0]) + Solid::primitive(Primitive::Cone { top: 0.5 });
    let mut rays = Vec::new();
    for far in [1e3, 1e16, 1e20, 1e155, 1e300] {
        for direction in [Vec3::X, Vec3::new(0.6, 0.8, 1e-9), Vec3::new(0.3, -0.2, 0.9)] {
            let beside = direction.cross(Vec3::new(0.1, 0.7, 0.3)).normalized().expect("a direction");
            rays.push(Ray::new(beside * far, direction));
        }
    }
    assert!(all_spans(&tilted, &rays).iter().all(Vec::is_empty));
    let with_slab = all_spans(&(tilted + slab.clone()), &rays);
    let slab_alone = all_spans(&slab, &rays);
    assert!(with_slab.iter().zip(&slab_alone).all(|(a, b)| a.len() == b.len()));
}

#[test]
fn boxes_that_do_not_meet_hold_nothing_in_common() {
    // From this far away both balls seem to be in the same place.
    let flat = Solid::sphere().scale([2.0, 0.5, 2.0]).translate([0.0, -2.0, 0.0]);
    let slim = Solid::sphere().scale([0.5, 0.5, 2.0]);
    let ray = Ray::new([5.950570929777348e17, 7.934094573036463e17, 3.9670472865182317e17], [-1.5, -2.0, -1.0]);
    assert_eq!(spans(&(flat & slim), &ray), []);
    let cone = Solid::primitive(Primitive::Cone { top: 0.5 }).scale([0.5, 0.5, 1.0]);
    let ray = Ray::new([-727606875106.9989, 0.5, -2910427500435.4956], [0.25, 0.0, 1.0]);
    assert_eq!(spans(&(cone & Solid::block().translate([2.0, 0.0, 0.0])), &ray), []);
}

#[test]
fn lines_that_are_all_but_parallel_to_faces_leave_a_polyhedron() {
    for tiny in [1e-310, -1e-310, 5e-324, 1e-300, 1e-200] {
        let rays = [
            Ray::new([-6.5000013962631895, -1.0000012217307048, 0.5], [0.9999999999999848, 1.745329251994321e-7, tiny]),
            Ray::new([-6.5, -1.5, 0.5], [1.0, tiny, tiny]),
            Ray::new([-6.5, -2.0, 1.5], [1.0, -tiny, tiny]),
        ];
        for solid in polyhedra() {
            let turned = solid.clone().scale([0.5; 3]).rotate([0.0, 0.0, 1e-5]).translate([0.5, -2.0, 0.5]);
            for spans in [all_spans(&turned, &rays), all_spans(&solid, &rays)] {
                assert!(spans.iter().flatten().all(|span| span.exit.is_some()), "{spans:?}");
            }
        }
    }
}

#[test]
fn a_squeezed_polyhedron_minus_itself_is_nothing() {
    // Two of the axes are parallel but for a thousandth of a degree.
    let squeeze = Affine::from_rows([
        [0.6186666911916294, -2.631695909410362, -0.0006087795551592646, -1.5],
        [-0.7603360105233418, 2.279821337701914, 0.0007495704695489081, -1.0],
        [-0.19783708281053994, -0.12213128888824289, 0.00019438096095431606, 1.0],
    ]);
    let ray = Ray::new(
        [-34.743490327100055, 890.1795825287545, -3.916975270463314],
        [3.682291830642913, -106.92572556291461, 0.5767716384622755],
    );
    for solid in polyhedra().into_iter().chain([Solid::block(), Solid::sphere(), Solid::cylinder()]) {
        let squeezed = solid.scale([0.5; 3]).transform(squeeze);
        assert_eq!(spans(&(squeezed.clone() - squeezed), &ray), []);
    }
}

#[test]
fn squashed_solids_are_seen_from_afar_where_they_are() {
    // To sheets thinner than an atom, at an angle.
    let squash = Affine::from_rows([
        [0.0, -240.0, -170.0, 0.0],
        [-720.0, -32.0, -20.0, 0.0],
        [-1e-9, -0.043e-9, -0.027e-9, 0.0],
    ]);
    let eye = Vec3::new(-51665.82465104276, 51666.76577329656, -25832.559405267442);
    let mut rays =
        vec![Ray { origin: eye, direction: Vec3::new(0.66456260451860, -0.66687791212751, 0.33709107818496) }];
    for i in 0..900 {
        let (u, v) = (f64::from(i % 30) / 15.0 - 1.0, f64::from(i / 30) / 15.0 - 1.0);
        rays.push(Ray { origin: eye, direction: Vec3::new(2.0 + 0.05 * u, -2.0 + 0.05 * v, 1.0 + 0.02 * (u + v)) });
    }
    let shapes =
        [Solid::sphere(), Solid::cylinder(), Solid::block(), Solid::primitive(Primitive::Torus { minor: 0.5 })];
    for solid in shapes.map(|solid| solid.transform(squash)) {
        let bounds = tracer(&solid, Accel::None, 0, 0).bounds().grown(1e-6);
        let all = all_spans(&solid, &rays);
        for (ray, spans) in rays.iter().zip(&all) {
            for hit in spans.iter().flat_map(|span| [span.enter, span.exit]).flatten() {
                assert!(bounds.contains(ray.at(hit.t)), "{ray:?} {hit:?}");
            }
        }
    }
}

#[test]
fn meshes_whose_faces_were_joined_are_met_beyond_their_corners_too() {
    // Nearly a turn by 45 degrees and twice the size, as dumps print it.
    let edge = 141_421.0 / 100_000.0;
    let map = Affine::from_rows([[edge, 0.0, -1.4, 0.0], [0.0, -2.0, -2.5e-7, 2.0], [-1.4, 0.0, -edge, -1.0]]);
    let solid = polyhedra()[2].clone().transform(map);
    let ray = Ray::new([-20.713152443462, 1.999999753173, -2.4142099999999997], [3.4906600010486954e-7, -1e-30, 0.0]);
    let with = |accel: Accel, snap: f64| {
        let options = TracerOptions { accel, snap, ..TracerOptions::default() };
        Tracer::build(&solid, &options, &Exec::with_threads(1)).expect("nobody cancels")
    };
    let canonical = with(Accel::None, 1e-3).spans(&ray);
    assert_eq!(canonical, with(Accel::Octree, 1e-3).spans(&ray));
    // The top, which was put level, ends a little before the corner that the ray runs through.
    let beyond = canonical[0].enter_t() - with(Accel::None, 0.0).spans(&ray).first().map_or(0.0, |span| span.enter_t());
    assert!(beyond != 0.0, "{canonical:?}");
}

#[test]
fn what_is_too_large_or_too_thin_to_calculate_with_is_nothing() {
    let shapes = [
        Solid::block(),
        Solid::sphere(),
        Solid::cylinder(),
        Solid::primitive(Primitive::Cone { top: 0.0 }),
        Solid::primitive(Primitive::Torus { minor: 0.5 }),
        polyhedra()[2].clone(),
    ];
    let rays = [
        Ray::new([0.25, 0.25, 5.0], [0.0, 0.0, -1.0]),
        Ray::new([1e200, 0.25, 0.5], [-1.0, 0.0, 0.0]),
        Ray::new([-1e300, -1e300, 0.5], [1.0, 1.0, 1e-9]),
        Ray::new([0.1, 0.2, 0.3], [1e300, 1e290, -1e308]),
    ];
    let ordinary = all_spans(&Solid::block(), &rays);
    for shape in &shapes {
        for size in [1e31, 1e300] {
            for factors in [[size; 3], [1.0 / size; 3], [size, 1.0, 1.0], [1.0, 1.0, 1.0 / size]] {
                let extreme = shape.clone().scale(factors);
                assert!(all_spans(&extreme, &rays).iter().all(Vec::is_empty), "{factors:?}");
                let moved = shape.clone().translate([size, 0.0, 0.0]);
                let crowd = all_spans(&Solid::union([Solid::block(), extreme, moved]), &rays);
                assert_eq!(crowd, ordinary, "{factors:?}");
            }
        }
    }
}
