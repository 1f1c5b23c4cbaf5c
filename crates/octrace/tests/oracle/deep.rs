//! Solids nested deeper than a small stack could follow.

use octrace::exec::Exec;
use octrace::{Accel, Ray, Solid, Tracer, TracerOptions};

const LEVELS: usize = 20_000;

/// What a tracer says of the line x = y = 1/2, downwards from z = 9, and of two points of it.
fn check(solid: &Solid, expected: &[(f64, f64)]) {
    let ray = Ray::new([0.5, 0.5, 9.0], [0.0, 0.0, -1.0]);
    for accel in [Accel::None, Accel::Octree] {
        let options = TracerOptions { accel, ..TracerOptions::default() };
        let tracer = Tracer::build(solid, &options, &Exec::with_threads(1)).expect("nobody cancels");
        let spans: Vec<(f64, f64)> = tracer.spans(&ray).iter().map(|s| (s.enter_t(), s.exit_t())).collect();
        assert_eq!(spans, expected);
        assert_eq!(tracer.first_hit(&ray).map(|hit| hit.t), expected.first().map(|span| span.0));
        for t in [8.5, 11.5] {
            let inside = expected.iter().any(|&(enter, exit)| enter < t && t < exit);
            assert_eq!(tracer.contains(ray.at(t)), inside, "at {t}");
        }
        assert_all_stages_answer(&tracer, &ray);
    }
}

/// The stages that only people look at.
fn assert_all_stages_answer(tracer: &Tracer, ray: &Ray) {
    assert!(!tracer.program_text().is_empty());
    assert_eq!(tracer.explain(ray).hit.map(|(hit, _)| hit), tracer.first_hit(ray));
    let _ = tracer.classify_box(&tracer.bounds());
}

#[test]
fn differences_and_unions_in_turn() {
    let solid = (0..LEVELS).fold(Solid::block(), |solid, i| match i % 2 {
        0 => solid - Solid::sphere().translate([9.0, 0.0, 0.0]),
        _ => solid + Solid::block().translate([0.0, 0.0, -3.0]),
    });
    check(&solid, &[(8.0, 9.0), (11.0, 12.0)]);
}

/// `A − (B − (A − (B − …)))`: what is taken away is what is deep.
#[test]
fn differences_in_differences() {
    let solid = (0..LEVELS).fold(Solid::block(), |solid, i| match i % 2 {
        0 => Solid::block().translate([0.0, 0.0, 0.5]) - solid,
        _ => Solid::block() - solid,
    });
    // The last is the lower block less what the upper one keeps of itself.
    check(&solid, &[(8.0, 9.0)]);
}

#[test]
fn movements_in_movements() {
    const STEP: f64 = 1.0 / 16_384.0;
    let solid = (0..LEVELS).fold(Solid::block(), |solid, _| solid.translate([0.0, 0.0, -STEP]));
    let sunk = LEVELS as f64 * STEP;
    check(&solid, &[(8.0 + sunk, 9.0 + sunk)]);
}
