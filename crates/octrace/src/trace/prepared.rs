//! Rays made fit for arithmetic, and the way back to the caller's parameters.

use crate::geom::{Bounds, Hit, Ray, Span, Spans};

/// A ray made fit for arithmetic, the same way for every acceleration: directions of extreme length are scaled by a power
/// of two, and a ray that starts very far from the scene is restarted near it.
pub(super) struct Prepared {
    /// The ray to trace.
    pub ray: Ray,
    shift: f64,
    scale: f64,
}

impl Prepared {
    pub fn new(ray: &Ray, bounds: &Bounds) -> Self {
        let mut prepared = Self { ray: *ray, shift: 0.0, scale: 1.0 };
        let largest = ray.direction.max_abs();
        if !(1e-30..1e30).contains(&largest) {
            let (_, exponent) = libm::frexp(largest);
            let exponent = exponent - 1;
            // In two steps, since the factor itself may overflow.
            let half = -exponent / 2;
            let (a, b) = (libm::ldexp(1.0, half), libm::ldexp(1.0, -exponent - half));
            prepared.ray.direction = ray.direction * a * b;
            prepared.scale = libm::ldexp(1.0, exponent);
        }
        if !bounds.is_empty() {
            let to_center = bounds.center() - prepared.ray.origin;
            let size = bounds.size().max_abs();
            if to_center.max_abs() > 64.0 * size {
                let d = prepared.ray.direction;
                let shift = to_center.dot(d) / d.dot(d);
                let origin = prepared.ray.at(shift);
                if shift.is_finite() && origin.is_finite() {
                    prepared.ray.origin = origin;
                    prepared.shift = shift;
                }
            }
        }
        prepared
    }

    /// A parameter of the caller's ray as one of the prepared ray.
    pub fn inner(&self, t: f64) -> f64 {
        t * self.scale - self.shift
    }

    /// A parameter of the prepared ray as one of the caller's.
    pub fn outer(&self, t: f64) -> f64 {
        (t + self.shift) / self.scale
    }

    /// Parameters that rounding makes equal on the way leave no span, and no gap, between them.
    pub fn outer_spans(&self, spans: Spans) -> Spans {
        let mut outer: Spans = Spans::with_capacity(spans.len());
        for span in spans {
            let span = Span {
                enter: span.enter.map(|hit| self.outer_hit(hit)),
                exit: span.exit.map(|hit| self.outer_hit(hit)),
            };
            if span.enter_t() >= span.exit_t() {
                continue;
            }
            match outer.last_mut() {
                Some(last) if last.exit_t() == span.enter_t() => last.exit = span.exit,
                _ => outer.push(span),
            }
        }
        outer
    }

    pub fn outer_hit(&self, hit: Hit) -> Hit {
        Hit { t: self.outer(hit.t), ..hit }
    }
}
