//! Turning about an axis: OpenSCAD's `rotate_extrude`.

use super::layers::{Ends, Section, Sides};
use super::linear::polygons;
use super::slices::{Fragments, fragments};
use super::{SweepError, profile, resolved};
use crate::Tolerance;
use crate::plane::{Affine2, Bounds2, Flat, Outline};
use octrace::geom::sin_cos_deg;
use octrace::{Affine, Primitive, Solid, Vec2, Vec3};
use std::sync::Arc;

/// How a flat shape is turned about its y axis, which then is the z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotateExtrude {
    /// How far, in degrees, counter-clockwise seen from above; negative goes the other way. 360 and more, either way, is
    /// a full turn.
    pub angle_deg: f64,
    /// Where it starts, in degrees from the x axis.
    pub start_deg: f64,
    /// OpenSCAD's own facets are wanted, by these; otherwise it is round.
    pub written: Option<Fragments>,
}

impl RotateExtrude {
    fn is_full(&self) -> bool {
        self.angle_deg.abs() >= 360.0 || !self.angle_deg.is_finite()
    }
}

/// The shape turned about the y axis, which becomes the z axis. A shape on the negative side of the axis stays there.
///
/// Round sweeps are exact: lines become planes, cylinders and cones, arcs spheres and tori.
///
/// # Errors
/// If the shape lies on both sides of the axis; if the outline, or what comes of it, is not sound.
pub fn rotate_extrude(shape: &Flat, how: &RotateExtrude, tolerance: Tolerance) -> Result<Solid, SweepError> {
    if how.angle_deg == 0.0 {
        return Ok(Solid::empty());
    }
    let mut shape = resolved(shape, tolerance)?;
    let mut sides = shape.bounds();
    if sides.is_some_and(|sides| sides.min.x < 0.0 && 0.0 < sides.max.x) {
        // The bounds of a combination are those of its operands. Its boundary tells.
        let outline = shape.outline(tolerance)?;
        sides = outline.bounds();
        shape = Flat::Outline(outline);
    }
    let Some(Bounds2 { min: low, max: high }) = sides else { return Ok(Solid::empty()) };
    // Corners on the axis may be beside it by a rounding.
    let slack = 1e-6 * low.x.abs().max(high.x.abs());
    if low.x < -slack && slack < high.x {
        return Err(SweepError::AcrossAxis { from: low.x, to: high.x });
    }
    let is_left = high.x <= slack;
    if is_left {
        shape = shape.moved(Affine2::scale(Vec2::new(-1.0, 1.0)));
    }
    let reach = low.x.abs().max(high.x.abs());
    let solid = match how.written {
        Some(by) => faceted(&shape, how, &by, reach, tolerance)?,
        None => round(&shape, how, tolerance)?,
    };
    // Mirrored about the axis is turned by a half.
    let start = how.start_deg + if is_left { 180.0 } else { 0.0 };
    Ok(solid.rotate([0.0, 0.0, start]))
}

/// Turning a combination is combining what is turned, as far as it is right of the axis.
fn round(shape: &Flat, how: &RotateExtrude, tolerance: Tolerance) -> Result<Solid, SweepError> {
    let leaf = |outline: &Arc<Outline>, map: &Affine2| -> Result<Solid, SweepError> {
        let outline = onto_axis(outline.moved(map, tolerance));
        if outline.bounds().is_none_or(|bounds| bounds.max.x <= 0.0) {
            return Ok(Solid::empty());
        }
        let profile = profile(&outline, tolerance)?;
        Ok(profile.map_or_else(Solid::empty, |profile| Solid::primitive(Primitive::Revolution(profile))))
    };
    let solid = shape.fold(leaf, |op, solids| Ok(Solid::combine(op, solids)))?;
    if how.is_full() {
        return Ok(solid);
    }
    // The half-space of all that is less than half a turn after an angle: y >= 0, turned.
    let after = |angle_deg: f64| {
        let upright = Affine { rows: [Vec3::X, Vec3::Z, -Vec3::Y], translation: Vec3::ZERO };
        Solid::half_space().transform(upright).rotate([0.0, 0.0, angle_deg])
    };
    let (from, to) = if how.angle_deg < 0.0 { (how.angle_deg, 0.0) } else { (0.0, how.angle_deg) };
    let wedge = [after(from), after(to - 180.0)];
    Ok(match to - from <= 180.0 {
        true => Solid::intersection(std::iter::once(solid).chain(wedge)),
        false => Solid::intersection([solid, Solid::union(wedge)]),
    })
}

/// Moves corners that are beside the axis by a rounding onto it.
fn onto_axis(mut outline: Outline) -> Outline {
    let Some(bounds) = outline.bounds() else { return outline };
    let slack = 1e-9 * bounds.max.x;
    for edge in outline.contours.iter_mut().flatten() {
        if edge.from.x.abs() <= slack {
            edge.from.x = 0.0;
        }
    }
    outline
}

fn faceted(
    shape: &Flat,
    how: &RotateExtrude,
    by: &Fragments,
    reach: f64,
    tolerance: Tolerance,
) -> Result<Solid, SweepError> {
    let polygons = polygons(&onto_axis(shape.outline(tolerance)?.as_ref().clone()), tolerance);
    if polygons.is_empty() {
        return Ok(Solid::empty());
    }
    let count = fragments(reach, by);
    let section = Section::new(&polygons);
    let at = |angle_deg: f64, corner: Vec2| {
        let (sin, cos) = sin_cos_deg(angle_deg);
        Vec3::new(corner.x * cos, corner.x * sin, corner.y)
    };
    let solid = if how.is_full() {
        // A full turn starts on -x.
        let step = 360.0 / f64::from(count);
        section
            .sweep(count as usize, Ends::Joined, Sides::Whole, |layer, corner| at(180.0 - step * layer as f64, corner))
    } else {
        let share = (f64::from(count) * how.angle_deg.abs() / 360.0).trunc().max(1.0);
        // The section as drawn is seen from where the turn, clockwise, begins.
        let (first, step) = match how.angle_deg > 0.0 {
            true => (how.angle_deg, -how.angle_deg / share),
            false => (0.0, how.angle_deg / share),
        };
        section.sweep(share as usize + 1, Ends::Capped, Sides::Whole, |layer, corner| {
            at(first + step * layer as f64, corner)
        })
    };
    Ok(solid?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::BoolOp;
    use octrace::model::Node;

    fn square(x: f64) -> Flat {
        Outline::rectangle(Vec2::new(x, 0.0), Vec2::new(x + 1.0, 1.0)).into()
    }

    fn faceted(angle_deg: f64, count: f64) -> RotateExtrude {
        let written = Some(Fragments { count, ..Fragments::default() });
        RotateExtrude { angle_deg, start_deg: 0.0, written }
    }

    /// The volume and the box of a solid that is one polyhedron.
    fn measured(solid: &Solid, map: Affine) -> (f64, octrace::Bounds) {
        match solid.node() {
            Node::Primitive(Primitive::Polyhedron(p)) => {
                let corners = p.points().iter().map(|&q| map.point(q));
                (p.volume() * map.determinant().abs(), octrace::Bounds::around(corners))
            }
            Node::Transform(own, child) => measured(child, map * *own),
            other => panic!("{other:?}"),
        }
    }

    fn check(shape: &Flat, how: &RotateExtrude, volume: f64, low: [f64; 3], high: [f64; 3]) {
        let solid = rotate_extrude(shape, how, Tolerance::default()).expect("it can be turned");
        let (found, bounds) = measured(&solid, Affine::IDENTITY);
        assert!((found - volume).abs() < 2e-5 * volume, "{how:?}: {found} is not {volume}");
        let off = (bounds.min - Vec3::from(low)).max_abs().max((bounds.max - Vec3::from(high)).max_abs());
        assert!(off < 1e-5, "{how:?}: {bounds:?}");
    }

    /// Volumes and boxes of what OpenSCAD 2021.01 exports for the same.
    #[test]
    fn facets_are_those_of_openscad() {
        check(&square(1.0), &faceted(360.0, 8.0), 8.48525, [-2.0, -2.0, 0.0], [2.0, 2.0, 1.0]);
        check(&square(-2.0), &faceted(360.0, 8.0), 8.48525, [-2.0, -2.0, 0.0], [2.0, 2.0, 1.0]);
        check(&square(0.0), &faceted(360.0, 8.0), 2.82843, [-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]);
        check(&square(1.0), &faceted(90.0, 8.0), 2.12131, [0.0, 0.0, 0.0], [2.0, 2.0, 1.0]);
        check(&square(1.0), &faceted(-90.0, 8.0), 2.12131, [0.0, -2.0, 0.0], [2.0, 0.0, 1.0]);
        check(&square(-2.0), &faceted(90.0, 8.0), 2.12131, [-2.0, -2.0, 0.0], [0.0, 0.0, 1.0]);
        check(&square(1.0), &faceted(10.0, 8.0), 0.260472, [0.984808, 0.0, 0.0], [2.0, 0.347296, 1.0]);
        check(&square(1.0), &faceted(100.0, 8.0), 2.29814, [-0.347296, 0.0, 0.0], [2.0, 1.96962, 1.0]);
        check(&square(5.0), &faceted(360.0, 5.0), 26.1541, [-6.0, -5.70634, 0.0], [4.8541, 5.70634, 1.0]);
    }

    #[test]
    fn a_shape_across_the_axis_is_refused() {
        let error = rotate_extrude(&square(-0.5), &faceted(360.0, 8.0), Tolerance::default()).unwrap_err();
        assert_eq!(error.to_string(), "the shape lies on both sides of the axis: x goes from -0.5 to 0.5");
    }

    /// What is cut away may reach across.
    #[test]
    fn only_what_is_left_counts() {
        let half = Flat::combined(
            BoolOp::Difference,
            [Outline::circle(2.0).into(), { Outline::rectangle(Vec2::new(-3.0, -3.0), Vec2::new(0.0, 3.0)).into() }],
        );
        assert!(rotate_extrude(&half, &faceted(360.0, 8.0), Tolerance::default()).is_ok());
        let nothing = rotate_extrude(&half, &faceted(0.0, 8.0), Tolerance::default()).expect("a turn by nothing");
        assert!(matches!(nothing.node(), Node::Empty));
    }
}
