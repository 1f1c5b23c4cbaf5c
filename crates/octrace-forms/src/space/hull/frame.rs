//! Coordinates in which curved things are balls, or upright circles.

use super::balls::Ball;
use super::discs::Disc;
use super::turned::{Axis, Ring};
use crate::space::round::{Extremes, Round};
use octrace::{Affine, Vec3};

/// Angles and ratios of lengths that differ by less than this do not differ: matrices in files have six digits.
const SIMILAR: f64 = 1e-5;

/// What was found: things in coordinates of their own, and the map from there to the world.
pub(super) struct Framed<T> {
    pub things: Vec<T>,
    pub map: Affine,
}

/// Coordinates in which all is balls and corners, if there are any.
pub(super) fn balls(extremes: &Extremes) -> Option<Framed<Ball>> {
    let all: Option<Vec<(Vec3, [Vec3; 3])>> = extremes
        .rounds
        .iter()
        .map(|round| match *round {
            Round::Ellipsoid { center, axes } => Some((center, axes)),
            Round::Ellipse { .. } | Round::Ring { .. } => None,
        })
        .collect();
    let all = all?;
    let (_, first) = *all.first()?;
    let own = linear(first);
    [Affine::IDENTITY, own].into_iter().find_map(|map| {
        let inverse = map.inverse()?;
        let ball = |&(center, axes): &(Vec3, [Vec3; 3])| {
            let axes = axes.map(|a| inverse.vector(a));
            let [u, v, w] = axes;
            let round = square(u, v) && square(v, w) && square(u, w);
            round.then(|| Ball { center: inverse.point(center), radius: u.length() })
        };
        let corners = extremes.points.iter().map(|&p| Some(Ball { center: inverse.point(p), radius: 0.0 }));
        let things = all.iter().map(ball).chain(corners).collect::<Option<Vec<Ball>>>()?;
        Some(Framed { things, map })
    })
}

/// Coordinates in which all is horizontal discs and corners, if there are any.
pub(super) fn discs(extremes: &Extremes) -> Option<Framed<Disc>> {
    let all: Option<Vec<(Vec3, [Vec3; 2])>> = extremes
        .rounds
        .iter()
        .map(|round| match *round {
            Round::Ellipse { center, axes } => Some((center, axes)),
            Round::Ellipsoid { .. } | Round::Ring { .. } => None,
        })
        .collect();
    let all = all?;
    let (_, [a, b]) = *all.first()?;
    let own = if square(a, b) {
        let u = a.normalized()?;
        let w = a.cross(b).normalized()?;
        linear([u, w.cross(u), w])
    } else {
        linear([a, b, a.cross(b).normalized()? * a.length()])
    };
    [Affine::IDENTITY, own].into_iter().find_map(|map| {
        let inverse = map.inverse()?;
        let disc = |&(center, axes): &(Vec3, [Vec3; 2])| {
            let [u, v] = axes.map(|a| inverse.vector(a));
            let level = |d: Vec3| d.z.abs() <= SIMILAR * d.length();
            (square(u, v) && level(u) && level(v)).then(|| Disc { center: inverse.point(center), radius: u.length() })
        };
        let corners = extremes.points.iter().map(|&p| Some(Disc { center: inverse.point(p), radius: 0.0 }));
        let things = all.iter().map(disc).chain(corners).collect::<Option<Vec<Disc>>>()?;
        Some(Framed { things, map })
    })
}

/// Discs that are all rounded by a ball of one radius.
pub(super) struct Rounded {
    pub discs: Framed<Disc>,
    /// The ball's radius, in the coordinates of the discs.
    pub round: f64,
}

/// Coordinates in which all is horizontal rings with tubes of one radius, and balls of that radius, if there are any.
pub(super) fn rounded(extremes: &Extremes) -> Option<Rounded> {
    if !extremes.points.is_empty() {
        return None;
    }
    let first = extremes.rounds.iter().find_map(|round| match *round {
        Round::Ring { axes, .. } => Some(axes),
        Round::Ellipse { .. } | Round::Ellipsoid { .. } => None,
    })?;
    let is_ball = |[u, v, w]: [Vec3; 3]| square(u, v) && square(v, w) && square(u, w);
    let own = if is_ball(first) { first.map(|a| a / a.length()) } else { first };
    [Affine::IDENTITY, linear(own)].into_iter().find_map(|map| {
        let inverse = map.inverse()?;
        let disc = |round: &Round| {
            let (center, axes, ring) = match *round {
                Round::Ring { center, axes, minor } => (center, axes, Some(minor)),
                Round::Ellipsoid { center, axes } => (center, axes, None),
                Round::Ellipse { .. } => return None,
            };
            let axes = axes.map(|a| inverse.vector(a));
            let size = axes[0].length();
            let upright = axes[2].x.abs().max(axes[2].y.abs()) <= SIMILAR * size;
            let (radius, tube) = ring.map_or((0.0, size), |minor| (size, size * minor));
            (is_ball(axes) && (ring.is_none() || upright))
                .then(|| (Disc { center: inverse.point(center), radius }, tube))
        };
        let all = extremes.rounds.iter().map(disc).collect::<Option<Vec<(Disc, f64)>>>()?;
        let round = all.first()?.1;
        let same = all.iter().all(|(_, tube)| (tube - round).abs() <= SIMILAR * round);
        same.then(|| Rounded { discs: Framed { things: all.into_iter().map(|(disc, _)| disc).collect(), map }, round })
    })
}

/// An axis about which everything is turned, if there is one, and all by their sections.
pub(super) fn turned(extremes: &Extremes) -> Option<(Vec<Ring>, Axis)> {
    let first = extremes.rounds.iter().find_map(|round| match *round {
        Round::Ellipse { center, axes: [a, b] } | Round::Ring { center, axes: [a, b, _], .. } => Some((center, a, b)),
        Round::Ellipsoid { .. } => None,
    });
    let (origin, a, b) = first?;
    let direction = a.cross(b).normalized()?;
    let side = a.normalized()?;
    let axis = Axis { origin, direction, sides: [side, direction.cross(side)] };
    let aside = SIMILAR * 0.1 * extremes.size();
    let height = |p: Vec3| {
        let offset = p - origin;
        let z = offset.dot(direction);
        ((offset - direction * z).length() <= aside).then_some(z)
    };
    let level = |v: Vec3| v.dot(direction).abs() <= SIMILAR * v.length();
    let ring = |round: &Round| match *round {
        Round::Ellipsoid { center, axes: [u, v, w] } => {
            let round = square(u, v) && square(v, w) && square(u, w);
            Some(Ring { distance: 0.0, z: height(center)?, radius: round.then(|| u.length())? })
        }
        Round::Ellipse { center, axes: [u, v] } => {
            let about = square(u, v) && level(u) && level(v);
            Some(Ring { distance: about.then(|| u.length())?, z: height(center)?, radius: 0.0 })
        }
        Round::Ring { center, axes: [u, v, w], minor } => {
            let about = square(u, v) && square(v, w) && square(u, w) && level(u) && level(v);
            let distance = about.then(|| u.length())?;
            Some(Ring { distance, z: height(center)?, radius: distance * minor })
        }
    };
    let corners = extremes.points.iter().map(|&p| Some(Ring { distance: 0.0, z: height(p)?, radius: 0.0 }));
    let rings = extremes.rounds.iter().map(ring).chain(corners).collect::<Option<Vec<Ring>>>()?;
    Some((rings, axis))
}

/// Whether two vectors are across each other and have the same length.
pub(crate) fn square(u: Vec3, v: Vec3) -> bool {
    let (a, b) = (u.length(), v.length());
    (a - b).abs() <= SIMILAR * a && u.dot(v).abs() <= SIMILAR * a * b
}

/// The linear map with these columns.
fn linear([x, y, z]: [Vec3; 3]) -> Affine {
    Affine::linear([0, 1, 2].map(|axis| Vec3::new(x[axis], y[axis], z[axis])))
}
