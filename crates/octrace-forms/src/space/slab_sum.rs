//! Minkowski sums of outlines between two heights, among themselves and with balls.

use super::SpaceError;
use super::fold::fold;
use super::frusta::across;
use super::hull::square;
use super::leaves::{Leaf, leaves};
use super::pieces::is_convex_primitive;
use super::slab::{Slab, slabs};
use crate::Tolerance;
use octrace::model::Node;
use octrace::{Affine, Primitive, Solid, Vec3};

/// So many pairs of slabs have their sums made at most.
const MOST_PAIRS: usize = 100;

/// The sum where all operands are outlines between two heights, in some direction, or balls; and not all of them are blocks,
/// cylinders and the like.
pub(super) fn sum_of_slabs(solids: &[Solid], tolerance: Tolerance) -> Result<Option<Solid>, SpaceError> {
    let plain = |p: &Primitive| is_convex_primitive(p) && !matches!(p, Primitive::Prism { .. });
    if leaves(solids).iter().all(|(_, leaf)| matches!(leaf, Leaf::Primitive(p) if plain(p))) {
        return Ok(None);
    }
    for upright in std::iter::once(Affine::IDENTITY).chain(upright(solids)) {
        let Some(back) = upright.inverse() else { continue };
        if let Some(sum) = sum_of_upright_slabs(solids, &upright, tolerance)? {
            return Ok(Some(sum.transform(back)));
        }
    }
    Ok(None)
}

/// A turn that makes the first cylinder or prism upright, if it is not.
fn upright(solids: &[Solid]) -> Option<Affine> {
    let axis = |primitive: &Primitive, map: &Affine| match primitive {
        Primitive::Cylinder | Primitive::Prism { .. } => map.column(2).normalized(),
        _ => None,
    };
    let first = |solid| fold(solid, axis, |_, axes: Vec<Option<Vec3>>| axes.into_iter().flatten().next());
    let w = solids.iter().find_map(first).filter(|w| w.z.abs() < 1.0)?;
    let [u, v] = across(w);
    Some(Affine::linear([u, v, w]))
}

/// The sum, if everything is as it should be after it was turned.
fn sum_of_upright_slabs(solids: &[Solid], upright: &Affine, tolerance: Tolerance) -> Result<Option<Solid>, SpaceError> {
    let (mut sum, mut radius, mut moved): (Option<Vec<Slab>>, f64, Vec3) = (None, 0.0, Vec3::ZERO);
    for solid in solids.iter().filter(|solid| !matches!(solid.node(), Node::Empty)) {
        let turned = solid.clone().transform(*upright);
        if let Some((center, more)) = as_ball(&turned) {
            radius += more;
            moved += center;
            continue;
        }
        let Some(slabs) = slabs(&turned, tolerance)? else { return Ok(None) };
        sum = Some(match sum {
            None => slabs,
            Some(sum) if sum.len().saturating_mul(slabs.len()) > MOST_PAIRS => return Ok(None),
            Some(sum) => {
                let pairs = sum.iter().flat_map(|a| slabs.iter().map(move |b| a.plus(b, tolerance)));
                pairs.collect::<Result<_, _>>()?
            }
        });
    }
    let Some(sum) = sum else { return Ok(None) };
    let of = |slab: Slab| if radius > 0.0 { slab.rounded(radius) } else { Ok(slab.solid()) };
    let parts: Vec<Solid> = sum.into_iter().map(of).collect::<Result<_, _>>()?;
    Ok(Some(Solid::union(parts).translate(moved)))
}

/// Centre and radius of a solid that is a ball.
fn as_ball(solid: &Solid) -> Option<(Vec3, f64)> {
    let leaves = leaves(std::slice::from_ref(solid));
    let [(map, Leaf::Primitive(Primitive::Sphere))] = leaves.as_slice() else { return None };
    let [u, v, w] = [0, 1, 2].map(|axis| map.column(axis));
    (square(u, v) && square(v, w) && square(u, w)).then(|| (map.translation, u.length()))
}

#[cfg(test)]
mod tests {
    use super::super::bounds;
    use super::super::hull::check_leaks;
    use super::super::minkowski;
    use super::*;
    use octrace::exec::Exec;
    use octrace::query::{MeasureOptions, measure};
    use octrace::{Contour, Curve, Edge, Profile, Tracer, TracerOptions, Vec2};
    use std::f64::consts::PI;

    /// The volume of the sum, upright and lying, and that rays see the same everywhere.
    fn check(solids: &[Solid], expected: f64) {
        for angles in [[0.0; 3], [90.0, 0.0, 0.0], [10.0, 20.0, 30.0]] {
            let turned: Vec<Solid> = solids.iter().map(|solid| solid.clone().rotate(angles)).collect();
            let sum = minkowski(&turned, Tolerance::default()).unwrap();
            assert!(leaves(std::slice::from_ref(&sum)).len() < 60, "{sum:?}");
            let exec = Exec::with_threads(1);
            let tracer = Tracer::build(&sum, &TracerOptions::default(), &exec).unwrap();
            let options = MeasureOptions { tolerance: 1e-4, max_rays: 1_000_000 };
            let measures = measure(&tracer, &options, &exec).unwrap();
            let off = (measures.volume - expected).abs();
            assert!(off <= measures.volume_error + 1e-6 * expected, "{measures:?} is not {expected}");
            check_leaks(&sum);
            // Pictures are framed by this.
            if angles == [0.0; 3] {
                let (loose, tight) = (bounds(&sum).diagonal(), measures.bbox.diagonal());
                assert!(loose < 1.1 * tight, "{loose} is much more than {tight}");
            }
        }
    }

    fn ball(radius: f64) -> Solid {
        Solid::sphere().scale([radius; 3])
    }

    /// The volume between two heights, rounded: slices at the ends are the outline grown by `s` less than `r`, which have the
    /// area `area + length s + bend s²`.
    fn rounded([area, length, bend]: [f64; 3], height: f64, r: f64) -> f64 {
        let ends = area * r + length * PI * r * r / 4.0 + bend * 2.0 / 3.0 * r.powi(3);
        height * (area + length * r + bend * r * r) + 2.0 * ends
    }

    fn drilled(x: f64, y: f64) -> Solid {
        let hole = Solid::cylinder().scale([2.0, 2.0, 9.0]).translate([x, y, -1.0]);
        Solid::block().scale([10.0, 8.0, 6.0]) - hole
    }

    #[test]
    fn drilled_plates_are_rounded() {
        check(&[drilled(5.0, 4.0), ball(0.5)], rounded([80.0 - 4.0 * PI, 36.0 + 4.0 * PI, 0.0], 6.0, 0.5));
        // Half of the hole is in the block, and has a corner at each end.
        check(&[ball(0.5), drilled(5.0, 0.0)], rounded([80.0 - 2.0 * PI, 32.0 + 2.0 * PI, PI], 6.0, 0.5));
    }

    #[test]
    fn counterbored_plates_are_rounded() {
        let (r, bore) = (0.5, Solid::cylinder().scale([3.0, 3.0, 9.0]).translate([5.0, 4.0, 4.0]));
        let disc = |radius: f64| PI * radius * radius;
        // What stays open within r of a rim: slices of the radius less sqrt(r² - t²).
        let rim = |radius: f64| disc(radius) * r - radius * PI * PI * r * r / 2.0 + 2.0 / 3.0 * PI * r.powi(3);
        let open = 2.0 * rim(2.0) + 4.0 * disc(2.0 - r) + (2.0 - r) * disc(3.0 - r) + rim(3.0);
        check(&[drilled(5.0, 4.0) - bore, ball(r)], rounded([80.0, 36.0, PI], 6.0, r) - open);
    }

    #[test]
    fn three_quarters_of_a_disc_are_rounded() {
        let arc = Curve::Arc { center: Vec2::new(0.0, 0.0), radius: 3.0, ccw: true };
        let edge = |x: f64, y: f64, curve: Curve| Edge { from: Vec2::new(x, y), curve };
        let contour: Contour = vec![edge(3.0, 0.0, arc), edge(0.0, -3.0, Curve::Line), edge(0.0, 0.0, Curve::Line)];
        let solid = Solid::prism(Profile::new(vec![contour]).unwrap()).scale([1.0, 1.0, 2.0]);
        // At the reflex corner what both sides gain is counted once.
        let expected = rounded([6.75 * PI, 4.5 * PI + 6.0, 1.25 * PI - 1.0], 2.0, 0.5);
        check(&[solid, ball(0.25), ball(0.25)], expected);
    }
}
