//! The solids that are made to measure with.

use octrace::exec::Exec;
use octrace::model::families::{balls, chain, classic, copies, grid, menger, plate, swiss};
use octrace::trace::TracerStats;
use octrace::{Solid, Tracer, TracerOptions};

fn stats(solid: &Solid) -> TracerStats {
    Tracer::build(solid, &TracerOptions::default(), &Exec::with_threads(1)).expect("nobody cancels").stats()
}

#[test]
fn they_have_as_many_primitives_as_they_say() {
    for (solid, expected) in [
        (classic(), 5),
        (balls(0), 1),
        (balls(10), 11),
        (balls(1_000), 1_001),
        (copies(0), 0),
        (copies(7), 35),
        (chain(0), 1),
        (chain(16), 17),
        (plate(1), 8),
        (plate(20), 806),
        (menger(0), 1),
        (menger(3), 220),
        (menger(4), 1_756),
        (swiss(0), 1),
        (swiss(100), 101),
        (grid([0, 1, 1]), 0),
        (grid([5, 5, 4]), 500),
    ] {
        assert_eq!(stats(&solid).primitives, expected);
    }
}

#[test]
fn no_two_balls_are_in_one_place() {
    for n in [1, 10, 100, 343] {
        assert_eq!(stats(&balls(n)).surfaces, 6 + n as usize, "six planes, and each ball's own surface");
    }
}

#[test]
fn no_two_copies_touch() {
    // Each has its own spheres and bars; the planes of a row are shared.
    let middle = octrace::Ray::new([-9.0, 0.0, 0.9], [1.0, 0.0, 0.0]);
    let tracer = Tracer::build(&copies(9), &TracerOptions::default(), &Exec::with_threads(1)).expect("nobody cancels");
    assert_eq!(tracer.spans(&middle).len(), 6, "left and right of the bore of each of the three in a row");
}
