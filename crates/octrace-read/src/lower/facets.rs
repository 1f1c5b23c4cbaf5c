//! How many facets OpenSCAD gives a round thing, and solids with exactly these.

use super::args::Args;
use crate::Facets;
use octrace::geom::sin_cos_deg;
use octrace::{Polyhedron, PolyhedronError, Vec3};
use octrace_forms::sweep::{Fragments, fragments};

/// `$fn` up to this is taken to mean facets: nearly always a nut, a hexagon, a pyramid.
const LARGEST_MEANT: f64 = 12.0;

/// The number of facets around a thing of this radius, or `None` where it is to be round.
pub(super) fn around(mode: Facets, args: &Args<'_>, radius: f64) -> Option<u32> {
    meant(mode, args).map(|by| fragments(radius, &by))
}

/// By what OpenSCAD counts the facets of a thing that is to have them; `None` where it is to be round.
pub(super) fn meant(mode: Facets, args: &Args<'_>) -> Option<Fragments> {
    let number = |name| args.number(name).map(|(v, _)| v);
    let (wanted, angle, size) = (number("$fn"), number("$fa"), number("$fs"));
    let default = Fragments::default();
    let written = Fragments {
        count: wanted.unwrap_or(default.count),
        angle_deg: angle.unwrap_or(default.angle_deg),
        size: size.unwrap_or(default.size),
    };
    match mode {
        Facets::Smooth => None,
        Facets::Auto => (0.0 < written.count && written.count < LARGEST_MEANT + 1.0).then_some(written),
        Facets::Written => wanted.or(angle).or(size).map(|_| written),
    }
}

/// Corners of a regular polygon: at angles of 360 i / n degrees, the first on +x.
fn ring(n: u32, radius: f64, z: f64) -> impl Iterator<Item = Vec3> {
    (0..n).map(move |i| {
        let (sin, cos) = sin_cos_deg(360.0 * f64::from(i) / f64::from(n));
        Vec3::new(radius * cos, radius * sin, z)
    })
}

/// The side faces between two rings of `n` corners that start at `low` and `high`.
fn band(n: u32, low: u32, high: u32) -> impl Iterator<Item = Vec<u32>> {
    (0..n).map(move |i| {
        let next = (i + 1) % n;
        vec![low + i, low + next, high + next, high + i]
    })
}

/// A prism or a frustum inscribed in the unit cylinder or in a cone of radius 1 at z = 0 and `top` at z = 1; a pyramid
/// for `top` 0.
pub(super) fn frustum(n: u32, top: f64) -> Result<Polyhedron, PolyhedronError> {
    let mut points: Vec<Vec3> = ring(n, 1.0, 0.0).collect();
    let mut faces = vec![(0..n).rev().collect()];
    if top > 0.0 {
        points.extend(ring(n, top, 1.0));
        faces.push((n..2 * n).collect());
        faces.extend(band(n, 0, n));
    } else {
        points.push(Vec3::Z);
        faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n]));
    }
    Polyhedron::new(points, faces)
}

/// OpenSCAD's ball of radius 1 with `n` facets around: rings at polar angles 180 (i + 1/2) / rings, so that the poles
/// are faces.
pub(super) fn ball(n: u32) -> Result<Polyhedron, PolyhedronError> {
    let rings = n.div_ceil(2);
    let mut points = Vec::with_capacity((n * rings) as usize);
    for i in (0..rings).rev() {
        let (sin, cos) = sin_cos_deg(180.0 * (f64::from(i) + 0.5) / f64::from(rings));
        points.extend(ring(n, sin, cos));
    }
    let last = (rings - 1) * n;
    let mut faces: Vec<Vec<u32>> = vec![(0..n).rev().collect(), (last..last + n).collect()];
    faces.extend((1..rings).flat_map(|i| band(n, (i - 1) * n, i * n)));
    Polyhedron::new(points, faces)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume, from the faces' orientation.
    fn volume(p: &Polyhedron) -> f64 {
        let corner = |i: u32| p.points()[i as usize];
        let fan = |face: &Vec<u32>| -> f64 {
            face.windows(2).skip(1).map(|w| corner(face[0]).dot(corner(w[0]).cross(corner(w[1])))).sum()
        };
        p.faces().iter().map(fan).sum::<f64>() / 6.0
    }

    fn check(actual: f64, expected: f64) {
        assert!((actual - expected).abs() < 1e-14, "{actual} is not {expected}");
    }

    #[test]
    fn prisms_and_pyramids_have_the_volume_of_their_base() {
        check(volume(&frustum(4, 1.0).unwrap()), 2.0);
        check(volume(&frustum(4, 0.0).unwrap()), 2.0 / 3.0);
        check(volume(&frustum(4, 0.5).unwrap()), 2.0 / 3.0 * (1.0 + 0.5 + 0.25));
        check(volume(&frustum(6, 1.0).unwrap()), 1.5 * 3.0_f64.sqrt());
    }

    #[test]
    fn the_first_corner_is_on_x() {
        assert_eq!(frustum(5, 1.0).unwrap().points()[0], Vec3::X);
    }

    #[test]
    fn a_ball_of_four_facets_is_a_prism() {
        // Two rings, 45 degrees from the poles: a square prism of half height and radius sqrt(1/2).
        check(volume(&ball(4).unwrap()), 2.0_f64.sqrt());
        assert_eq!(ball(5).unwrap().points().len(), 15, "three rings of five");
    }
}
