//! Minkowski sums of bodies of revolution about parallel axes: of rings, of drilled and stepped discs.
//!
//! A body is known by its section through the axis, both halves of it. One with no hole about its axis (a ball, a cylinder, a
//! cone) is a disc at every height. What it adds to a point of another body, in distances from the axis, is an interval; so
//! the section of the sum is the sum of the sections.

use super::SpaceError;
use super::fold::fold;
use super::frusta::across;
use super::hull::square;
use super::leaves::{Leaf, leaves};
use super::pieces::is_convex_primitive;
use crate::Tolerance;
use crate::plane::{Affine2, Outline, combine};
use octrace::model::Node;
use octrace::{Affine, BoolOp, Primitive, Profile, Solid, Vec2, Vec3};

/// Directions and places that differ by less, as a share of the sizes, do not differ: files have six digits.
const SAME: f64 = 2e-6;

/// The sum where all operands are bodies of revolution, all but one of them balls, cylinders or cones; and not all of them are
/// convex primitives.
pub(super) fn sum_of_turned(solids: &[Solid], tolerance: Tolerance) -> Result<Option<Solid>, SpaceError> {
    let plain = |p: &Primitive| is_convex_primitive(p) && !matches!(p, Primitive::Revolution(_));
    if leaves(solids).iter().all(|(_, leaf)| matches!(leaf, Leaf::Primitive(p) if plain(p))) {
        return Ok(None);
    }
    let Some(w) = solids.iter().find_map(|solid| axis(solid)?.1) else { return Ok(None) };
    let [u, v] = across(w);
    let upright = Affine::linear([u, v, w]);
    let Some(back) = upright.inverse() else { return Ok(None) };
    let (mut sum, mut moved, mut hollow): (Option<Outline>, Vec3, u32) = (None, Vec3::ZERO, 0);
    for solid in solids.iter().filter(|solid| !matches!(solid.node(), Node::Empty)) {
        let Some((origin, _)) = axis(solid) else { return Ok(None) };
        hollow += u32::from(!is_filled(solid));
        let own = solid.clone().translate(-origin).transform(upright);
        let Some(section) = section(&own, tolerance)? else { return Ok(None) };
        moved += origin;
        sum = Some(match sum {
            None => section,
            Some(sum) => sum.minkowski(&section, tolerance)?,
        });
    }
    let profile = sum.filter(|_| hollow <= 1).and_then(|sum| Profile::new(sum.contours).ok());
    Ok(profile.map(|profile| Solid::revolution(profile).transform(back).translate(moved)))
}

/// A point of the axis of the first thing that has one, and the axis' direction; of a ball the middle alone.
fn axis(solid: &Solid) -> Option<(Vec3, Option<Vec3>)> {
    let of = |primitive: &Primitive, map: &Affine| match primitive {
        Primitive::Sphere => Some((map.translation, None)),
        Primitive::Cylinder | Primitive::Cone { .. } | Primitive::Torus { .. } | Primitive::Revolution(_) => {
            Some((map.translation, map.column(2).normalized()))
        }
        _ => None,
    };
    fold(solid, of, |_, found| {
        let found: Vec<(Vec3, Option<Vec3>)> = found.into_iter().flatten().collect();
        found.iter().copied().find(|(_, direction)| direction.is_some()).or(found.first().copied())
    })
}

/// Whether the solid is one ball, cylinder or cone.
fn is_filled(solid: &Solid) -> bool {
    let leaves = leaves(std::slice::from_ref(solid));
    matches!(
        leaves.as_slice(),
        [(_, Leaf::Primitive(Primitive::Sphere | Primitive::Cylinder | Primitive::Cone { .. }))]
    )
}

/// The section through the z axis of a body of revolution about it; `None` where it is none.
fn section(solid: &Solid, tolerance: Tolerance) -> Result<Option<Outline>, SpaceError> {
    fold(
        solid,
        |primitive, map| of_primitive(primitive, map, tolerance),
        |op, sections: Vec<Result<Option<Outline>, SpaceError>>| {
            let sections: Option<Vec<Outline>> = sections.into_iter().collect::<Result<_, _>>()?;
            let Some(sections) = sections else { return Ok(None) };
            let sections: Vec<&Outline> = sections.iter().collect();
            Ok(Some(combine(op, &sections)?))
        },
    )
}

fn of_primitive(primitive: &Primitive, map: &Affine, tolerance: Tolerance) -> Result<Option<Outline>, SpaceError> {
    let [u, v, w] = [0, 1, 2].map(|axis| map.column(axis));
    let (width, height, low) = (u.length(), w.z, map.translation.z);
    let size = width + w.length() + low.abs();
    let aside = |p: Vec3| p.x.abs().max(p.y.abs());
    let on_axis = aside(map.translation) <= SAME * size && square(u, v);
    let upright = on_axis && aside(w) <= SAME * size && u.z.abs().max(v.z.abs()) <= SAME * size;
    let same_scale = square(u, w) && square(v, w);
    let circle =
        |x: f64, radius: f64| Outline::circle(radius).moved(&Affine2::translation(Vec2::new(x, low)), tolerance);
    Ok(match primitive {
        Primitive::Sphere if on_axis && same_scale => Some(circle(0.0, width)),
        Primitive::Cylinder if upright => {
            Some(Outline::rectangle(Vec2::new(-width, low), Vec2::new(width, low + height)))
        }
        Primitive::Cone { top } if upright => {
            let at = |x: f64, z: f64| Vec2::new(x * width, low + z * height);
            Some(Outline::polygon(&[vec![at(-1.0, 0.0), at(1.0, 0.0), at(*top, 1.0), at(-*top, 1.0)]])?)
        }
        Primitive::Torus { minor } if upright && same_scale && *minor < 1.0 => {
            let circles = [-width, width].map(|x| circle(x, width * minor));
            Some(combine(BoolOp::Union, &[&circles[0], &circles[1]])?)
        }
        Primitive::Revolution(profile) if upright => {
            let whole = Outline { contours: profile.contours().to_vec() };
            let (min, max) = profile.bounds();
            let right = Outline::rectangle(Vec2::new(0.0, min.y), Vec2::new(max.x.max(0.0), max.y));
            let right = combine(BoolOp::Intersection, &[&whole, &right])?;
            let scale = |x: f64| Affine2::scale(Vec2::new(x, height));
            let place =
                |x: f64| right.moved(&scale(x), tolerance).moved(&Affine2::translation(Vec2::new(0.0, low)), tolerance);
            Some(combine(BoolOp::Union, &[&place(width), &place(-width)])?)
        }
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::super::hull::check_leaks;
    use super::super::minkowski;
    use super::*;
    use octrace::exec::Exec;
    use octrace::query::{MeasureOptions, measure};
    use octrace::{Tracer, TracerOptions};
    use std::f64::consts::PI;

    /// Sums with a section of this area, whose middle is 6.5 off the axis.
    fn check(solids: &[Solid], area: f64) {
        for angles in [[0.0; 3], [90.0, 0.0, 0.0], [10.0, 20.0, 30.0]] {
            let place = |solid: &Solid| solid.clone().translate([1.0, 2.0, 3.0]).rotate(angles);
            let sum = minkowski(&solids.iter().map(place).collect::<Vec<_>>(), Tolerance::default()).unwrap();
            assert_eq!(leaves(std::slice::from_ref(&sum)).len(), 1, "{sum:?}");
            let tracer = Tracer::build(&sum, &TracerOptions::default(), &Exec::with_threads(1)).unwrap();
            let options = MeasureOptions { tolerance: 1e-4, max_rays: 1_000_000 };
            let found = measure(&tracer, &options, &Exec::with_threads(1)).unwrap();
            let expected = 2.0 * PI * 6.5 * area;
            let off = (found.volume - expected).abs();
            assert!(off <= found.volume_error + 1e-6 * expected, "{found:?} is not {expected}");
            check_leaks(&sum);
        }
    }

    fn post(radius: f64, height: f64) -> Solid {
        Solid::cylinder().scale([radius, radius, height])
    }

    #[test]
    fn rings_grow_by_balls_and_cones() {
        let washer = post(7.0, 4.0) - post(6.0, 9.0).translate([0.0, 0.0, -1.0]);
        let outline = Outline::rectangle(Vec2::new(6.0, 0.0), Vec2::new(7.0, 4.0));
        let ring = Solid::revolution(Profile::new(outline.contours).unwrap());
        for solid in [washer, ring] {
            check(&[solid.clone(), Solid::sphere().scale([0.5; 3])], 4.0 + 5.0 + PI / 4.0);
            let cone = Solid::primitive(Primitive::Cone { top: 0.0 }).scale([0.5, 0.5, 1.0]);
            check(&[cone, solid], 8.0 + 1.5);
        }
        let torus = Solid::primitive(Primitive::Torus { minor: 0.5 / 6.5 }).scale([6.5; 3]);
        check(&[torus, Solid::sphere().scale([0.25; 3])], PI * 0.75 * 0.75);
    }
}
