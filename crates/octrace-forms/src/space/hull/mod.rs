//! Convex hulls of solids.
//!
//! Exact are the hulls of
//! - blocks, polyhedra and whatever else has only corners: a convex polyhedron;
//! - balls of any sizes, and corners: see [`balls`];
//! - cylinders and cones whose circles lie in parallel planes, and corners: see [`discs`];
//! - parallel rings and balls with tubes of one radius, so cylinders and plates with rounded edges: see [`rounded`];
//! - balls, cylinders, cones and tori about one axis: see [`turned`];
//!
//! all but the last moved by any affine map as a whole. Holes that the hull does not see do not matter: see [`uncut`].
//! Of everything else those parts are exact that are between things of one of these kinds; for the rest there are strips
//! of planes, inside of the hull and within the tolerance: see [`patched`].

mod balls;
mod discs;
mod frame;
mod kinds;
mod net;
mod patched;
#[cfg(test)]
mod patched_tests;
mod rounded;
#[cfg(test)]
mod rounded_tests;
mod strips;
mod support;
#[cfg(test)]
mod tests;
mod turned;
mod uncut;

pub(super) use frame::square;
pub(super) use patched::STRIPS;
#[cfg(test)]
pub(super) use tests::check_leaks;

use super::SpaceError;
use super::convex::convex;
use super::leaves::{Leaf, leaves};
use super::mesh::mesh;
use super::round::{Extremes, Fit};
use crate::Tolerance;
use octrace::{Solid, Vec3};

/// Up to so many curved things and corners have their hull found exactly, for that takes the third power of the number.
const MOST: usize = 300;

/// The convex hull of the solids; empty for none, and where it is flat. Parts are forgotten.
///
/// # Errors
/// If a solid is unbounded, or a boundary that has to be found cannot be: see [`SpaceError`].
pub fn hull(solids: &[Solid], tolerance: Tolerance) -> Result<Solid, SpaceError> {
    hull_with_corners(solids, &[], tolerance)
}

/// The convex hull of solids and of points besides.
///
/// # Errors
/// As for [`hull`].
pub fn hull_with_corners(solids: &[Solid], corners: &[Vec3], tolerance: Tolerance) -> Result<Solid, SpaceError> {
    let mut extremes = Extremes::default();
    extremes.points.extend_from_slice(corners);
    for (map, leaf) in leaves(solids) {
        match leaf {
            Leaf::Primitive(primitive) => extremes.add(primitive, &map, tolerance)?,
            leaf @ Leaf::Other(_) => {
                let placed = leaf.placed(&map);
                let boundary = mesh(&placed, tolerance)?;
                match uncut::uncut(&placed, &boundary, tolerance) {
                    Some(more) => extremes.append(more),
                    None => extremes.points.extend(boundary.points),
                }
            }
        }
    }
    Ok(hull_of(extremes, tolerance))
}

/// The convex hull of corners and curved things.
pub(super) fn hull_of(mut extremes: Extremes, tolerance: Tolerance) -> Solid {
    if extremes.rounds.is_empty() {
        return convex(&extremes.points).map_or_else(Solid::empty, Solid::primitive);
    }
    if let Some(hull) = convex(&extremes.points) {
        extremes.points = hull.points().to_vec();
    }
    if extremes.points.len() + extremes.rounds.len() <= MOST {
        let deviation = patched::STRIPS * tolerance.relative * extremes.size();
        if let Some(hull) = exact(&extremes, deviation).or_else(|| patched::hull(&extremes, tolerance)) {
            return hull;
        }
    }
    let points = extremes.sampled(tolerance.relative * extremes.size(), Fit::Inside);
    convex(&points).map_or_else(Solid::empty, Solid::primitive)
}

/// The hull of things that are of one kind, if they are. What strips there are, are within `deviation` (scene units).
fn exact(extremes: &Extremes, deviation: f64) -> Option<Solid> {
    if let Some(framed) = frame::balls(extremes) {
        return Some(balls::hull(&framed.things).transform(framed.map));
    }
    if let Some(framed) = frame::discs(extremes) {
        return Some(discs::hull(&framed.things).transform(framed.map));
    }
    if let Some((rings, axis)) = frame::turned(extremes) {
        return Some(turned::hull(&rings, &axis));
    }
    let frame::Rounded { discs, round } = frame::rounded(extremes)?;
    Some(rounded::hull(&discs.things, round, deviation).transform(discs.map))
}
