//! Outlines with rounded corners and fillets, as chains of offsets make them, become prisms that hold what they hold.

use octrace::exec::Exec;
use octrace::{Profile, Ray, Solid, Tracer, TracerOptions, Vec2};
use octrace_forms::plane::{Offset, Outline};

/// Numbers that look random, the same every time.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }
}

/// Steps and bumps on a plate: polygons with many right angles, as drawings have them.
fn polygon(numbers: &mut Numbers) -> Vec<Vec2> {
    let mut corners = vec![Vec2::new(0.0, -10.0)];
    let mut x = 0.0;
    for _ in 0..3 + numbers.below(4) {
        let height = numbers.below(4) as f64 * 5.0;
        let width = 2.0 + numbers.below(5) as f64 * 4.0;
        let slant = if numbers.below(3) == 0 { 3.0 } else { 0.0 };
        corners.push(Vec2::new(x, height));
        corners.push(Vec2::new(x + width, height + slant));
        x += width;
    }
    corners.push(Vec2::new(x, -10.0));
    corners.reverse();
    corners
}

#[test]
fn prisms_over_rounded_outlines_hold_what_the_outlines_hold() {
    let exec = Exec::with_threads(1);
    let mut seen = [0, 0];
    for seed in 0..150 {
        let mut numbers = Numbers(seed);
        let mut outline = Outline::polygon(&[polygon(&mut numbers)]).expect("a polygon");
        for _ in 0..2 + numbers.below(2) {
            let r = (numbers.below(9) as f64 - 4.0) * 1.25;
            outline = outline.offset(Offset::Round { r, facets: None }).expect("it can be offset");
        }
        if outline.is_empty() {
            continue;
        }
        let bounds = outline.bounds().expect("it is not empty");
        let profile = Profile::new(outline.contours.clone()).unwrap_or_else(|e| panic!("{seed}: {e}\n{outline:?}"));
        let tracer = Tracer::build(&Solid::prism(profile), &TracerOptions::default(), &exec).expect("nobody cancels");
        let near_edge = 1e-6 * bounds.diagonal();
        for i in 0..40 {
            for j in 0..40 {
                let at = |k: i32| f64::from(k) / 38.0 - 0.0261;
                let p = bounds.min + Vec2::new(bounds.size().x * at(i), bounds.size().y * at(j));
                let around = [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
                let expected = outline.contains(p);
                let is_clear = |&(x, y): &(f64, f64)| outline.contains(p + Vec2::new(x, y) * near_edge) == expected;
                if around.iter().all(is_clear) {
                    let met = tracer.first_hit(&Ray::new([p.x, p.y, 2.0], [0.0, 0.0, -1.0])).is_some();
                    assert_eq!(met, expected, "{seed}: at {p:?} of {outline:?}");
                    seen[usize::from(expected)] += 1;
                }
            }
        }
    }
    assert!(seen.iter().all(|&n| n > 10_000), "{seen:?}");
}
