//! Prisms and bodies of revolution: volumes are those of the closed formulas, and all tracers see the same.

use octrace::exec::Exec;
use octrace::query::{MeasureOptions, measure};
use octrace::{Accel, Contour, Curve, Edge, Primitive, Profile, Ray, Solid, Tracer, TracerOptions, Vec2, Vec3};
use std::f64::consts::PI;
use std::sync::Arc;

fn line(x: f64, y: f64) -> Edge {
    Edge { from: Vec2::new(x, y), curve: Curve::Line }
}

fn arc(x: f64, y: f64, center: [f64; 2], ccw: bool) -> Edge {
    let (from, center) = (Vec2::new(x, y), Vec2::new(center[0], center[1]));
    Edge { from, curve: Curve::Arc { center, radius: (from - center).length(), ccw } }
}

fn polygon(corners: &[[f64; 2]]) -> Contour {
    corners.iter().map(|&[x, y]| line(x, y)).collect()
}

fn profile(contours: &[Contour]) -> Arc<Profile> {
    Arc::new(Profile::new(contours.to_vec()).expect("a sound profile"))
}

fn tracer(solid: &Solid, accel: Accel) -> Tracer {
    Tracer::build(solid, &TracerOptions { accel, ..TracerOptions::default() }, &Exec::with_threads(1))
        .expect("nobody cancels")
}

/// Measures, and follows rays from all around.
fn check(name: &str, solid: &Solid, volume: f64) {
    let solid = solid.clone().rotate([10.0, 20.0, 30.0]);
    let (fast, canonical) = (tracer(&solid, Accel::default()), tracer(&solid, Accel::None));
    let options = MeasureOptions { tolerance: 1e-3, ..MeasureOptions::default() };
    let measured = measure(&fast, &options, &Exec::with_threads(1)).expect("bounded");
    let off = (measured.volume - volume).abs();
    assert!(off <= measured.volume_error, "{name}: {measured:?}, and should be {volume}");
    for i in 0..400 {
        let (s, c) = octrace::geom::sin_cos_deg(f64::from(i) * 137.5);
        let from = Vec3::new(c, s, f64::from(i % 20) / 10.0 - 1.0) * 20.0;
        let to = Vec3::new(f64::from(i % 7) - 3.0, f64::from(i % 5) - 2.0, f64::from(i % 3) - 1.0) * 0.7;
        let ray = Ray::new(from, to - from);
        assert_eq!(fast.spans(&ray), canonical.spans(&ray), "{name}: {ray:?}");
    }
}

/// A plate with a notch, a nose and a hole, all of them round; and its area.
fn cam() -> (Arc<Profile>, f64) {
    let outer = vec![
        line(-3.0, -2.0),
        line(3.0, -2.0),
        line(3.0, 0.0),
        arc(2.0, 0.0, [1.5, 0.0], false),
        line(1.0, 0.0),
        line(1.0, 1.0),
        arc(0.5, 1.0, [0.0, 1.0], true),
        line(-0.5, 1.0),
        line(-1.0, 1.0),
        line(-1.0, 0.0),
        line(-3.0, 0.0),
    ];
    let hole = vec![arc(0.5, -1.0, [0.0, -1.0], true)];
    // Half a disc is taken away, half a disc comes on top.
    (profile(&[outer, hole]), 12.0 + 2.0 - PI / 4.0)
}

#[test]
fn prisms_are_as_large_as_their_profiles() {
    let (profile, area) = cam();
    check("cam", &Solid::prism(Arc::clone(&profile)).scale([1.0, 1.0, 2.0]), 2.0 * area);
    for top in [0.5, 0.0] {
        let volume = area * (1.0 + top + top * top) / 3.0;
        check("tapered", &Solid::primitive(Primitive::Prism { profile: Arc::clone(&profile), top }), volume);
    }
    let square = self::profile(&[polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])]);
    check("a block", &Solid::prism(square), 1.0);
}

#[test]
fn bodies_of_revolution_are_as_large_as_pappus_says() {
    let half_disc = profile(&[vec![arc(0.0, -2.0, [0.0, 0.0], true), line(0.0, 2.0)]]);
    check("ball", &Solid::revolution(half_disc), 4.0 / 3.0 * PI * 8.0);
    let disc = profile(&[vec![arc(4.0, 0.0, [3.0, 0.0], true)]]);
    check("ring", &Solid::revolution(disc), 2.0 * PI * 3.0 * PI);
    let square = profile(&[polygon(&[[1.0, 0.0], [2.0, -1.0], [3.0, 0.0], [2.0, 1.0]])]);
    check("a ring of cones", &Solid::revolution(square), 2.0 * PI * 2.0 * 2.0);
    let ell = profile(&[polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 3.0]])]);
    check("stepped", &Solid::revolution(ell), PI * (4.0 + 1.0 + 1.0 / 3.0));
    // A disc without the half disc in its middle.
    let bite = profile(&[vec![arc(1.0, -1.0, [1.0, 0.0], true), line(1.0, 1.0)]]);
    check("half a ring", &Solid::revolution(bite), PI * PI / 2.0 * 2.0 * (1.0 + 4.0 / (3.0 * PI)));
}

#[test]
fn arcs_beyond_the_axis_make_lemons() {
    let lemon = profile(&[vec![arc(0.0, -1.0, [-0.5, 0.0], true), line(0.0, 1.0)]]);
    let whole = profile(&[vec![arc(-0.5 + 1.25_f64.sqrt(), 0.0, [-0.5, 0.0], true)]]);
    let angle = libm::asin(1.0 / 1.25_f64.sqrt());
    let volume = PI * (3.0 - 2.0 / 3.0 - 0.5 - 1.25 * angle);
    check("lemon", &Solid::revolution(lemon), volume);
    check("what is beyond the axis is cut off", &Solid::revolution(whole), volume);
    let beyond = profile(&[polygon(&[[-2.0, 0.0], [-1.0, 0.0], [-1.0, 1.0]])]);
    assert!(
        tracer(&Solid::revolution(beyond), Accel::default())
            .spans(&Ray::new([-9.0, 0.0, 0.5], [1.0, 0.0, 0.0]))
            .is_empty()
    );
}

/// Ten thousand edges, nested as deep as can be.
#[test]
fn a_long_spiral_is_no_problem() {
    let (mut out, mut back) = (Vec::new(), Vec::new());
    for i in 0..5000 {
        let (s, c) = octrace::geom::sin_cos_deg(f64::from(i) * 5.0);
        let radius = 1.0 + f64::from(i) / 72.0;
        out.push([radius * c, radius * s]);
        back.push([(radius - 0.5) * c, (radius - 0.5) * s]);
    }
    back.reverse();
    let spiral = Solid::prism(profile(&[polygon(&[out, back].concat())]));
    let ray = Ray::new([-100.0, 0.001, 0.5], [1.0, 0.0, 0.0]);
    let spans = tracer(&spiral, Accel::None).spans(&ray);
    assert_eq!(tracer(&spiral, Accel::default()).spans(&ray), spans);
    assert!((136..=140).contains(&spans.len()), "69 turns: {} spans", spans.len());
}
