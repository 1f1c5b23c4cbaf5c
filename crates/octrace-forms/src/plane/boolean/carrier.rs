//! The lines and circles that edges are parts of, and where they meet.

use octrace::Vec2;

/// A line through two points, or a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Carrier {
    /// A line.
    Line { from: Vec2, to: Vec2 },
    /// A circle.
    Circle { center: Vec2, radius: f64 },
}

impl Carrier {
    /// How far a point is from it.
    pub(crate) fn distance(&self, p: Vec2) -> f64 {
        match *self {
            Self::Line { from, to } => {
                let along = to - from;
                let length = along.length();
                if length == 0.0 { (p - from).length() } else { (along.cross(p - from) / length).abs() }
            }
            Self::Circle { center, radius } => ((p - center).length() - radius).abs(),
        }
    }

    /// The point on it that is nearest to `p`.
    pub(crate) fn nearest(&self, p: Vec2) -> Vec2 {
        match *self {
            Self::Line { from, to } => {
                let along = to - from;
                let squared = along.dot(along);
                if squared == 0.0 { from } else { from + along * (along.dot(p - from) / squared) }
            }
            Self::Circle { center, radius } => {
                let out = p - center;
                let length = out.length();
                if length == 0.0 { center + Vec2::new(radius, 0.0) } else { center + out * (radius / length) }
            }
        }
    }

    /// Where the two meet, nearest to `p`. Where they miss each other by less than `slack` they touch. `None` where they
    /// are parallel, concentric or apart.
    pub(crate) fn meet(&self, other: &Self, p: Vec2, slack: f64) -> Option<Vec2> {
        let met = match (*self, *other) {
            (Self::Line { from, to }, Self::Line { from: from2, to: to2 }) => {
                lines(from, to - from, from2, to2 - from2)
            }
            (Self::Line { from, to }, Self::Circle { center, radius })
            | (Self::Circle { center, radius }, Self::Line { from, to }) => {
                line_and_circle(from, to, center, radius, p, slack)
            }
            (Self::Circle { center: a, radius: r }, Self::Circle { center: b, radius: s }) => {
                circles(a, r, b, s, p, slack)
            }
        }?;
        (met.x.is_finite() && met.y.is_finite()).then_some(met)
    }
}

fn lines(p: Vec2, u: Vec2, q: Vec2, v: Vec2) -> Option<Vec2> {
    let cross = u.cross(v);
    let even = u.length() * v.length();
    // Along lines at a smaller angle a rounding error moves the point by more than a thousand times the grid.
    if cross.abs() <= even * 1e-6 {
        return None;
    }
    // Each coordinate of a line along an axis is exact.
    let met = p + u * ((q - p).cross(v) / cross);
    let exact = |met: f64, p: f64, u: f64, q: f64, v: f64| match (u == 0.0, v == 0.0) {
        (true, _) => p,
        (_, true) => q,
        _ => met,
    };
    Some(Vec2::new(exact(met.x, p.x, u.x, q.x, v.x), exact(met.y, p.y, u.y, q.y, v.y)))
}

/// Of two points at `±half` from the middle, the one nearer to `p`.
fn nearer(middle: Vec2, half: Vec2, p: Vec2) -> Vec2 {
    if (p - middle).dot(half) < 0.0 { middle - half } else { middle + half }
}

fn line_and_circle(from: Vec2, to: Vec2, center: Vec2, radius: f64, p: Vec2, slack: f64) -> Option<Vec2> {
    let along = to - from;
    let length = along.length();
    if length == 0.0 {
        return None;
    }
    let u = along * (1.0 / length);
    let height = u.cross(center - from);
    let foot = center + Vec2::new(u.y, -u.x) * height;
    let half = (radius - height.abs()) * (radius + height.abs());
    if half < 0.0 {
        return (height.abs() - radius <= slack).then_some(foot);
    }
    let met = nearer(foot, u * half.sqrt(), p);
    Some(Vec2::new(if u.x == 0.0 { from.x } else { met.x }, if u.y == 0.0 { from.y } else { met.y }))
}

fn circles(a: Vec2, r: f64, b: Vec2, s: f64, p: Vec2, slack: f64) -> Option<Vec2> {
    let between = b - a;
    let distance = between.length();
    if distance <= slack {
        return None;
    }
    let u = between * (1.0 / distance);
    let along = 0.5 * (distance + (r - s) * (r + s) / distance);
    let squared = (r - along) * (r + along);
    if squared < 0.0 {
        let apart = (distance - (r + s)).max((r - s).abs() - distance);
        return (apart <= slack).then(|| a + u * if along < 0.0 { -r } else { r });
    }
    Some(nearer(a + u * along, u.left() * squared.sqrt(), p))
}

#[cfg(test)]
mod tests {
    use super::*;

    const X_AXIS: Carrier = Carrier::Line { from: Vec2::new(-1.0, 0.0), to: Vec2::new(1.0, 0.0) };
    const FIVE: Carrier = Carrier::Circle { center: Vec2::ZERO, radius: 5.0 };

    #[test]
    fn curves_meet_where_they_should() {
        let upright = Carrier::Line { from: Vec2::new(3.0, -9.0), to: Vec2::new(3.0, 9.0) };
        let near = Vec2::new(3.0, 4.5);
        assert_eq!(X_AXIS.meet(&upright, near, 0.0), Some(Vec2::new(3.0, 0.0)));
        assert_eq!(FIVE.meet(&upright, near, 0.0), Some(Vec2::new(3.0, 4.0)));
        assert_eq!(upright.meet(&FIVE, -near, 0.0), Some(Vec2::new(3.0, -4.0)));
        let other = Carrier::Circle { center: Vec2::new(6.0, 0.0), radius: 5.0 };
        assert_eq!(FIVE.meet(&other, near, 0.0), Some(Vec2::new(3.0, 4.0)));
    }

    #[test]
    fn what_touches_up_to_the_slack_meets() {
        let above = Carrier::Line { from: Vec2::new(-1.0, 5.25), to: Vec2::new(1.0, 5.25) };
        assert_eq!(above.meet(&FIVE, Vec2::ZERO, 0.125), None);
        assert_eq!(above.meet(&FIVE, Vec2::ZERO, 0.25), Some(Vec2::new(0.0, 5.25)));
        let inside = Carrier::Circle { center: Vec2::new(2.0, 0.0), radius: 3.0 };
        assert_eq!(FIVE.meet(&inside, Vec2::ZERO, 0.0), Some(Vec2::new(5.0, 0.0)));
        assert_eq!(FIVE.meet(&FIVE, Vec2::ZERO, 0.1), None);
        assert_eq!(X_AXIS.meet(&X_AXIS, Vec2::ZERO, 0.1), None);
    }
}
