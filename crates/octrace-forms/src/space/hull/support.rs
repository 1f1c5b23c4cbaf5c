//! Planes that touch: where a corner or something round reaches farthest, and the planes that touch two or three of these.

use crate::space::round::Round;
use octrace::Vec3;

/// So many steps are made towards a plane at most. Each about doubles the number of digits.
const STEPS: u32 = 20;

/// A normal closer (sine of the angle) to the axis of a disc touches nowhere in particular.
const FLAT: f64 = 1e-7;

/// What a plane can touch.
#[derive(Clone, Copy, Debug)]
pub(super) enum Thing {
    Corner(Vec3),
    Round(Round),
}

impl Thing {
    /// The point that is farthest in a direction; `None` where a whole disc is.
    pub fn farthest(&self, direction: Vec3) -> Option<Vec3> {
        let of = |axes: &[Vec3]| {
            let shares = axes.iter().map(|axis| axis.dot(direction));
            let length = shares.clone().map(|share| share * share).sum::<f64>().sqrt();
            let longest = axes.iter().map(|axis| axis.length()).fold(0.0, f64::max);
            (length > FLAT * longest * direction.length())
                .then(|| axes.iter().zip(shares).fold(Vec3::ZERO, |sum, (&axis, share)| sum + axis * (share / length)))
        };
        Some(match self {
            Self::Corner(point) => *point,
            Self::Round(Round::Ellipse { center, axes }) => *center + of(axes)?,
            Self::Round(Round::Ellipsoid { center, axes }) => *center + of(axes)?,
            Self::Round(Round::Ring { center, axes, minor }) => *center + of(&axes[..2])? + of(axes)? * *minor,
        })
    }
}

/// A plane that touches things, by its normal of length one and a point on each.
#[derive(Clone, Debug)]
pub(super) struct Touch<const N: usize> {
    pub normal: Vec3,
    pub points: [Vec3; N],
}

/// The plane that touches all of the things, two or three, with a normal near this one. `noise` (scene units) is how far
/// it may be off.
pub(super) fn touch<const N: usize>(things: &[Thing; N], near: Vec3, noise: f64) -> Option<Touch<N>> {
    let mut normal = near.normalized()?;
    for _ in 0..STEPS {
        let mut points = [Vec3::ZERO; N];
        for (point, thing) in points.iter_mut().zip(things) {
            *point = thing.farthest(normal)?;
        }
        let apart = |k: usize| points[0] - points[k.min(N - 1)];
        let (g, h) = (apart(1), apart(2));
        let (f, e) = (g.dot(normal), h.dot(normal));
        if f.abs().max(e.abs()) <= noise {
            return Some(Touch { normal, points });
        }
        // The least change of the normal that makes both differences vanish, to first order.
        let change = if N == 2 {
            g * (f / g.dot(g))
        } else {
            let (gg, gh, hh) = (g.dot(g), g.dot(h), h.dot(h));
            let determinant = gg * hh - gh * gh;
            g * ((f * hh - e * gh) / determinant) + h * ((e * gg - f * gh) / determinant)
        };
        normal = (normal - change).normalized()?;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_touch_balls_and_discs() {
        let ball = |x: f64, radius: f64| {
            let axes = [Vec3::X * radius, Vec3::Y * radius, Vec3::Z * radius];
            Thing::Round(Round::Ellipsoid { center: Vec3::X * x, axes })
        };
        // Radii 3 and 1, 4 apart: the normal has 1/2 along the axis.
        let found = touch(&[ball(0.0, 3.0), ball(4.0, 1.0)], Vec3::new(0.1, 0.0, 1.0), 1e-12).unwrap();
        assert!((found.normal - Vec3::new(0.5, 0.0, 0.75_f64.sqrt())).length() < 1e-9, "{found:?}");
        // On a third ball the plane stands still.
        let aside = Thing::Corner(Vec3::new(0.0, 3.0, 3.0));
        let found = touch(&[ball(0.0, 3.0), ball(8.0, 3.0), aside], Vec3::new(0.2, 0.1, 1.0), 1e-12).unwrap();
        assert!((found.normal - Vec3::Z).length() < 1e-9, "{found:?}");
        let disc = Thing::Round(Round::Ellipse { center: Vec3::ZERO, axes: [Vec3::X, Vec3::Y] });
        assert!(disc.farthest(Vec3::Z).is_none());
        assert_eq!(disc.farthest(Vec3::new(2.0, 0.0, 1.0)).unwrap(), Vec3::X);
    }
}
