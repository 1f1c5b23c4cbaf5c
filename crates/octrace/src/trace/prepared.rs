//! Rays made fit for arithmetic, the same way for every acceleration.
//!
//! Directions of extreme length are scaled by a power of two. A ray that starts very far from the scene is restarted where
//! its line comes nearest. If that is still far away, the line meets nothing that is bounded, and no arithmetic with
//! coordinates of that size shall pretend that it does.

use crate::geom::{Bounds, Hit, Ray, Span, Spans, Vec3};
use std::ops::Range;

/// A ray as it is traced, and how its parameters are those of the caller's ray.
pub(super) struct Prepared {
    /// The ray to trace.
    pub ray: Ray,
    /// Whether its line passes everything bounded at a great distance.
    pub passes_by: bool,
    shift: f64,
    scale: f64,
}

/// What is farther from the middle of the scene than so many times its size, is far.
const FAR: f64 = 64.0;

/// Which rays are traced just as they are given: those with usual directions that start near the scene.
pub(super) struct Usual {
    /// The middle of the scene.
    pub center: Vec3,
    /// How far from it in each coordinate rays start at most.
    pub far: f64,
}

impl Usual {
    /// The largest coordinates of directions that need not be scaled.
    pub const DIRECTIONS: Range<f64> = 1e-30..1e30;

    /// For a scene whose bounded parts lie in `bounds`.
    pub fn new(bounds: &Bounds) -> Self {
        match bounds.is_empty() {
            true => Self { center: Vec3::ZERO, far: f64::INFINITY },
            false => Self { center: bounds.center(), far: FAR * bounds.size().max_abs() },
        }
    }
}

impl Prepared {
    /// Prepares a ray for a scene whose bounded parts lie in `bounds`.
    pub fn new(ray: &Ray, bounds: &Bounds) -> Self {
        let mut prepared = Self { ray: *ray, passes_by: false, shift: 0.0, scale: 1.0 };
        let largest = ray.direction.max_abs();
        if !Usual::DIRECTIONS.contains(&largest) {
            let exponent = exponent_of(largest);
            prepared.ray.direction = scaled(ray.direction, -exponent);
            prepared.scale = libm::ldexp(1.0, exponent);
        }
        if !bounds.is_empty() {
            prepared.approach(bounds);
        }
        prepared
    }

    /// Whether the ray is traced just as it was given.
    pub fn is_as_given(&self) -> bool {
        self.shift == 0.0 && self.scale == 1.0 && !self.passes_by
    }

    /// Restarts a ray from far away where its line comes nearest to the middle of the bounds.
    fn approach(&mut self, bounds: &Bounds) {
        let center = bounds.center();
        let far = FAR * bounds.size().max_abs();
        let to_center = center - self.ray.origin;
        if to_center.max_abs() <= far {
            return;
        }
        // Scaled by a power of two, so that products of the largest numbers remain numbers.
        let d = self.ray.direction;
        let exponent = exponent_of(to_center.max_abs());
        let shift = libm::ldexp(scaled(to_center, -exponent).dot(d) / d.dot(d), exponent);
        let origin = self.ray.at(shift);
        if shift.is_finite() && origin.is_finite() {
            self.ray.origin = origin;
            self.shift = shift;
        }
        self.passes_by = (center - self.ray.origin).max_abs() > far;
    }

    /// A parameter of the caller's ray as one of the prepared ray.
    pub fn inner(&self, t: f64) -> f64 {
        t * self.scale - self.shift
    }

    /// A parameter of the prepared ray as one of the caller's.
    pub fn outer(&self, t: f64) -> f64 {
        (t + self.shift) / self.scale
    }

    /// The hit with the caller's parameter; `None` where that is too large for a number.
    pub fn outer_hit(&self, hit: Hit) -> Option<Hit> {
        let t = self.outer(hit.t);
        t.is_finite().then_some(Hit { t, ..hit })
    }

    /// As [`outer_hit`](Self::outer_hit) for a hit ahead of the ray's start: no parameter is rounded to zero.
    pub fn outer_hit_ahead(&self, hit: Hit) -> Option<Hit> {
        const LEAST: f64 = f64::from_bits(1);
        self.outer_hit(hit).map(|hit| Hit { t: hit.t.max(LEAST), ..hit })
    }

    /// Spans with the caller's parameters. What rounding makes equal on the way leaves no span, and no gap, between.
    pub fn outer_spans(&self, spans: Spans) -> Spans {
        let mut outer: Spans = Spans::with_capacity(spans.len());
        for span in spans {
            if self.outer(span.enter_t()) >= self.outer(span.exit_t()) {
                continue;
            }
            let convert = |hit: Option<Hit>| hit.and_then(|hit| self.outer_hit(hit));
            let span = Span { enter: convert(span.enter), exit: convert(span.exit) };
            match outer.last_mut() {
                Some(last) if last.exit_t() == span.enter_t() => last.exit = span.exit,
                _ => outer.push(span),
            }
        }
        outer
    }
}

/// The power of two that a positive number is at least.
fn exponent_of(number: f64) -> i32 {
    libm::frexp(number).1 - 1
}

/// The vector times two to the power of `exponent`; in two steps, since the factor itself may not be a number.
fn scaled(v: Vec3, exponent: i32) -> Vec3 {
    let half = exponent / 2;
    v * libm::ldexp(1.0, half) * libm::ldexp(1.0, exponent - half)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn prepared(origin: [f64; 3], direction: [f64; 3]) -> Prepared {
        Prepared::new(&Ray::new(origin, direction), &Bounds::new(Vec3::splat(-1.0), Vec3::splat(1.0)))
    }

    #[test]
    fn rays_from_anywhere_are_restarted_near_the_scene() {
        for far in [1e3, 1e100, 1e200, 1.7e308] {
            let Prepared { ray, passes_by, shift, .. } = prepared([far, 0.5, 0.0], [-2.0, 0.0, 0.0]);
            assert_eq!((ray.origin, passes_by, shift), (Vec3::new(0.0, 0.5, 0.0), false, far / 2.0));
        }
        assert!(prepared([1e300, 0.5, 0.0], [0.0, 1.0, 0.0]).passes_by);
        assert!(!prepared([2.0, 2.0, 2.0], [0.0, 1.0, 0.0]).passes_by, "near enough to be asked");
    }

    #[test]
    fn directions_of_any_length_keep_their_parameters() {
        for length in [5e-324, 1e-300, 1e-31, 1e31, 1.7e308] {
            let prepared = prepared([-4.0, 0.0, 0.0], [length, 0.0, 0.0]);
            assert!((1.0..2.0).contains(&prepared.ray.direction.x), "{length}");
            assert_eq!(prepared.ray.direction.x * prepared.scale, length);
        }
    }

    #[test]
    fn parameters_too_large_for_numbers_are_no_hits() {
        let prepared = prepared([-4.0, 0.0, 0.0], [5e-324, 0.0, 0.0]);
        let hit = |t: f64, entering: bool| Hit { t, leaf: 0, surface: 0, entering, flipped: false };
        assert_eq!(prepared.outer_hit(hit(3.0, true)), None);
        let through = Span { enter: Some(hit(3.0, true)), exit: Some(hit(5.0, false)) };
        assert_eq!(prepared.outer_spans(vec![through]), []);
        let from_here = Span { enter: Some(hit(0.0, true)), exit: Some(hit(5.0, false)) };
        assert_eq!(prepared.outer_spans(vec![from_here]), [Span { exit: None, ..from_here }]);
    }
}
