//! Shadows of solids on the plane z = 0, in light from straight above: OpenSCAD's `projection()`.

use super::SpaceError;
use super::contour::{circle, convex_polygon, ellipse, nothing, plan, region, ring, rings};
use super::hull::square;
use super::leaves::{Leaf, leaves};
use super::mesh::mesh;
use super::pieces::is_convex_primitive;
use super::round::{Extremes, Round};
use super::section::is_turned;
use super::swept;
use crate::Tolerance;
use crate::plane::{Affine2, Flat};
use octrace::{Affine, BoolOp, Bounds, Primitive, Solid, Vec2, Vec3};

/// The shadow on the plane z = 0: the union of those of the leaves of the solid. Straight lines and circles are exact, but for
/// differences and intersections, which are made into meshes; ellipses are polygons within the tolerance.
///
/// # Errors
/// If the solid is unbounded, or a boundary that has to be found cannot be.
pub fn shadow(solid: &Solid, tolerance: Tolerance) -> Result<Flat, SpaceError> {
    let leaves = leaves(std::slice::from_ref(solid));
    let reach = |(map, leaf): &(Affine, Leaf<'_>)| super::bounds(&leaf.placed(map));
    let whole = leaves.iter().map(reach).fold(Bounds::EMPTY, Bounds::union);
    if !whole.is_bounded() {
        return Err(SpaceError::Unbounded);
    }
    let deviation = tolerance.relative * whole.diagonal();
    let mut shadows = Vec::new();
    for (map, leaf) in leaves {
        shadows.push(match leaf {
            Leaf::Primitive(Primitive::Torus { minor }) if is_flat(&map) => lying_ring(*minor, &map),
            Leaf::Primitive(Primitive::Prism { profile, .. }) if is_upright(&map) => {
                region(profile.contours().to_vec()).moved(Affine2::of_space(&map))
            }
            Leaf::Primitive(Primitive::Revolution(profile)) if is_upright(&map) && is_turned(&map) => {
                rings(&swept::reaches(profile.contours()), &map)
            }
            Leaf::Primitive(primitive) if is_convex_primitive(primitive) => {
                let mut extremes = Extremes::default();
                extremes.add(primitive, &map, tolerance)?;
                of_convex(&extremes, deviation)
            }
            leaf => mesh(&leaf.placed(&map), tolerance)?.shadow()?,
        });
    }
    Ok(match shadows.len() {
        0 => nothing(),
        1 => shadows.remove(0),
        _ => Flat::Combined(BoolOp::Union, shadows.into()),
    })
}

/// Whether vertical lines stay vertical, and horizontal ones horizontal.
fn is_upright(map: &Affine) -> bool {
    let [u, v, w] = [0, 1, 2].map(|axis| map.column(axis));
    let level = |d: Vec3| d.z.abs() <= 1e-9 * d.length();
    w.x.abs().max(w.y.abs()) <= 1e-9 * w.length() && level(u) && level(v)
}

/// Whether a ring's axis stays upright and the ring round.
fn is_flat(map: &Affine) -> bool {
    let [u, v, w] = [0, 1, 2].map(|axis| map.column(axis));
    let upright = w.x.abs().max(w.y.abs()) <= 1e-9 * w.length() && u.z.abs().max(v.z.abs()) <= 1e-9 * u.length();
    upright && square(u, v)
}

fn lying_ring(minor: f64, map: &Affine) -> Flat {
    let (radius, center) = (map.column(0).length(), plan(map.translation));
    let outer = circle(center, radius * (1.0 + minor), true);
    match minor < 1.0 {
        true => region(vec![outer, circle(center, radius * (1.0 - minor), false)]),
        false => region(vec![outer]),
    }
}

/// The shadow of the hull.
fn of_convex(extremes: &Extremes, deviation: f64) -> Flat {
    let mut discs = extremes.rounds.iter().map(shadow_of_round);
    // One disc that covers everything: an upright cylinder or cone, or a ball.
    let largest = discs.clone().max_by(|a, b| area(a).total_cmp(&area(b)));
    if let Some((center, axes)) = largest {
        let covers = |p: Vec2, reach: f64| (p - center).length() + reach <= axes[0].length() * (1.0 + 1e-9);
        let round = |axes: &[Vec2; 2]| square(flat(axes[0]), flat(axes[1]));
        let all_round = discs.all(|(p, axes)| round(&axes) && covers(p, axes[0].length()));
        if all_round && extremes.points.iter().all(|&p| covers(plan(p), 0.0)) {
            return region(vec![circle(center, axes[0].length(), true)]);
        }
        if extremes.rounds.len() == 1 && extremes.points.is_empty() {
            return ellipse(center, axes, deviation);
        }
    }
    let mut points: Vec<Vec2> = extremes.points.iter().map(|&p| plan(p)).collect();
    for (center, axes) in extremes.rounds.iter().map(shadow_of_round) {
        let [a, b] = axes;
        let length = (a.dot(a) + b.dot(b)).sqrt();
        if a.cross(b).abs() <= 1e-9 * length * length {
            // Seen from the side a circle is a line.
            let along = if a.length() >= b.length() { a } else { b };
            let half = along * (length / along.length());
            points.extend([center - half, center + half]);
        } else {
            points.extend(ring(center, axes, deviation));
        }
    }
    convex_polygon(points)
}

fn flat(v: Vec2) -> Vec3 {
    Vec3::new(v.x, v.y, 0.0)
}

fn area((_, [a, b]): &(Vec2, [Vec2; 2])) -> f64 {
    a.cross(*b).abs()
}

/// An ellipse, maybe a line, by its middle and two conjugate half-axes.
fn shadow_of_round(round: &Round) -> (Vec2, [Vec2; 2]) {
    match *round {
        Round::Ellipse { center, axes } => (plan(center), axes.map(plan)),
        Round::Ellipsoid { center, axes } | Round::Ring { center, axes, .. } => {
            // The shadow of a ball is what its three half-axes span; two along the principal directions span the same.
            let row = |axis: usize| Vec3::new(axes[0][axis], axes[1][axis], axes[2][axis]);
            let (x, y) = (row(0), row(1));
            let (xx, yy, xy) = (x.dot(x), y.dot(y), x.dot(y));
            if xx == 0.0 {
                return (plan(center), [Vec2::new(0.0, yy.sqrt()), Vec2::new(0.0, 0.0)]);
            }
            // Cholesky's factor of the matrix of these products has the columns wanted.
            let a = Vec2::new(xx.sqrt(), xy / xx.sqrt());
            let b = Vec2::new(0.0, (yy - a.y * a.y).max(0.0).sqrt());
            (plan(center), [a, b])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::contour::tests::check;
    use super::*;

    fn shadow_of(solid: Solid) -> Flat {
        shadow(&solid, Tolerance::default()).unwrap()
    }

    #[test]
    fn balls_and_upright_cylinders_are_discs() {
        let disc = shadow_of(Solid::sphere().scale([2.0; 3]).translate([5.0, 0.0, 9.0]));
        let Flat::Outline(outline) = &disc else { panic!("{disc:?}") };
        assert_eq!(outline.contours, [circle(Vec2::new(5.0, 0.0), 2.0, true)]);
        let frustum = shadow_of(Solid::primitive(Primitive::Cone { top: 0.5 }).scale([4.0, 4.0, 1.0]));
        let Flat::Outline(outline) = &frustum else { panic!("{frustum:?}") };
        assert_eq!(outline.contours, [circle(Vec2::new(0.0, 0.0), 4.0, true)]);
    }

    #[test]
    fn shadows_cover_what_is_below_the_solid() {
        check(&shadow_of(Solid::block().scale([2.0, 3.0, 4.0])), 6.0);
        // On its corner the cube has a hexagon of area sqrt(3) for its shadow.
        let upright = libm::atan(2.0_f64.sqrt()).to_degrees();
        check(&shadow_of(Solid::block().rotate([45.0, 0.0, 0.0]).rotate([0.0, 90.0 - upright, 0.0])), 3.0_f64.sqrt());
        check(&shadow_of(Solid::cylinder().scale([1.0, 1.0, 5.0]).rotate([0.0, 90.0, 0.0])), 10.0);
        check(&shadow_of(Solid::sphere().scale([3.0, 2.0, 1.0]).rotate([0.0, 90.0, 30.0])), 2.0 * std::f64::consts::PI);
        check(&shadow_of(Solid::primitive(Primitive::Torus { minor: 0.5 })), 2.0 * std::f64::consts::PI);
        let ring = Solid::primitive(Primitive::Torus { minor: 0.5 }).rotate([90.0, 0.0, 0.0]);
        check(&shadow_of(ring), 2.0 + std::f64::consts::PI / 4.0);
    }

    #[test]
    fn what_is_cut_away_casts_no_shadow() {
        let frame = Solid::block().scale([4.0; 3]) - Solid::block().scale([2.0, 2.0, 6.0]).translate([1.0, 1.0, -1.0]);
        check(&shadow_of(frame), 12.0);
        let dented = Solid::block().scale([4.0; 3]) - Solid::block().scale([2.0; 3]).translate([1.0, 1.0, -1.0]);
        check(&shadow_of(dented), 16.0);
    }

    #[test]
    fn there_must_be_an_end() {
        assert_eq!(shadow(&Solid::half_space(), Tolerance::default()).unwrap_err(), SpaceError::Unbounded);
    }
}
