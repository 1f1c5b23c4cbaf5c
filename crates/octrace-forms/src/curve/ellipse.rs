//! Arcs of ellipses: true arcs where they are circles, Béziers within a few parts in 10^8 where they are not.

use super::Pen;
use octrace::Vec2;
use octrace::geom::sin_cos_deg;

/// An ellipse, `center + x * cos(a) + y * sin(a)`, from one angle to another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EllipticArc {
    pub center: Vec2,
    /// Where the angle 0 is, from the middle.
    pub x: Vec2,
    /// Where the angle 90 is, from the middle.
    pub y: Vec2,
    pub start_deg: f64,
    /// Negative angles go the other way; beyond a full turn they are cut.
    pub sweep_deg: f64,
}

/// No Bézier stands for more of a turn than this, in degrees: then it is good to 2e-8 of the radius.
const LONGEST: f64 = 30.0;

impl EllipticArc {
    /// The point at an angle in degrees.
    pub fn at(&self, angle_deg: f64) -> Vec2 {
        let (sin, cos) = sin_cos_deg(angle_deg);
        self.center + self.x * cos + self.y * sin
    }

    pub fn end_deg(&self) -> f64 {
        self.start_deg + self.sweep_deg.clamp(-360.0, 360.0)
    }

    /// Whether it is a part of a circle, up to rounding.
    pub fn is_circular(&self) -> bool {
        let radius = self.x.length();
        (self.y.length() - radius).abs() <= 1e-9 * radius && self.x.dot(self.y).abs() <= 1e-9 * radius * radius
    }

    /// Draws it from the pen's place, which is its start, to `end`, which is its end up to rounding.
    pub fn draw(&self, pen: &mut Pen, end: Vec2) {
        let sweep = self.end_deg() - self.start_deg;
        let radius = self.x.length();
        let round =
            (self.y.length() - radius).abs() <= 1e-9 * radius && self.x.dot(self.y).abs() <= 1e-9 * radius * radius;
        if round {
            let ccw = (self.x.cross(self.y) > 0.0) == (sweep > 0.0);
            return pen.arc_to(end, self.center, radius, ccw);
        }
        let pieces = (sweep.abs() / LONGEST).ceil().max(1.0);
        let step = sweep / pieces;
        let (sin, cos) = sin_cos_deg(step / 4.0);
        let handle = 4.0 / 3.0 * sin / cos;
        let tangent = |angle: f64| {
            let (sin, cos) = sin_cos_deg(angle);
            (self.y * cos - self.x * sin) * handle
        };
        for i in 0..pieces as u32 {
            let (a, b) = (self.start_deg + step * f64::from(i), self.start_deg + step * f64::from(i + 1));
            let to = if i + 1 == pieces as u32 { end } else { self.at(b) };
            pen.cubic_to(self.at(a) + tangent(a), self.at(b) - tangent(b), to);
        }
    }

    /// Draws so many chords at equal angles instead.
    pub fn draw_chords(&self, pen: &mut Pen, chords: u32, end: Vec2) {
        let step = (self.end_deg() - self.start_deg) / f64::from(chords);
        for i in 1..=chords {
            pen.line_to(if i == chords { end } else { self.at(self.start_deg + step * f64::from(i)) });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Strokes, signed_area};
    use std::f64::consts::PI;

    fn area(y: Vec2, sweep_deg: f64) -> (f64, usize) {
        let arc = EllipticArc { center: Vec2::new(5.0, 1.0), x: Vec2::new(3.0, 0.0), y, start_deg: 20.0, sweep_deg };
        let mut pen = Pen::new(Strokes::Arcs { tolerance: 1e-6 });
        pen.move_to(arc.at(20.0));
        arc.draw(&mut pen, arc.at(arc.end_deg()));
        let paths = pen.finish();
        (signed_area(&paths), paths.iter().map(Vec::len).sum())
    }

    #[test]
    fn circles_are_one_arc_and_ellipses_are_near() {
        let (full, edges) = area(Vec2::new(0.0, 3.0), 360.0);
        assert!((full - 9.0 * PI).abs() < 1e-12 && edges == 1);
        assert!((area(Vec2::new(0.0, -3.0), 360.0).0 + 9.0 * PI).abs() < 1e-12);
        assert!((area(Vec2::new(0.0, 2.0), 360.0).0 - 6.0 * PI).abs() < 1e-4);
        assert!((area(Vec2::new(1.0, 2.0), -180.0).0 + 3.0 * PI).abs() < 1e-4);
    }
}
