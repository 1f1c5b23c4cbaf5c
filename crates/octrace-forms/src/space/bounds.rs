//! Boxes around solids, and resizing to a box.

use super::SpaceError;
use super::fold::fold;
use octrace::exec::Exec;
use octrace::query::{MeasureError, MeasureOptions, measure};
use octrace::{Affine, BoolOp, Bounds, Solid, Tracer, TracerOptions, Vec3};

/// A box around the solid. It is the smallest one if the solid is a union of primitives; what differences and
/// intersections cut away is not known here. See [`tight_bounds`].
pub fn bounds(solid: &Solid) -> Bounds {
    let primitive = |primitive: &octrace::Primitive, map: &Affine| primitive.bounds(map);
    fold(solid, primitive, |op, boxes: Vec<Bounds>| match op {
        BoolOp::Union => boxes.into_iter().fold(Bounds::EMPTY, Bounds::union),
        BoolOp::Intersection => {
            let common = boxes.into_iter().reduce(Bounds::intersection).unwrap_or(Bounds::EMPTY);
            if common.has_volume() { common } else { Bounds::EMPTY }
        }
        BoolOp::Difference => boxes.into_iter().next().unwrap_or(Bounds::EMPTY),
    })
}

/// The smallest box around the solid: exact if the solid is a union of primitives, else measured with rays, to about
/// seven digits of its size.
///
/// # Errors
/// If the solid is unbounded.
pub fn tight_bounds(solid: &Solid) -> Result<Bounds, SpaceError> {
    let around = bounds(solid);
    let is_union = fold(solid, |_, _| true, |op, all: Vec<bool>| op == BoolOp::Union && all.iter().all(|&union| union));
    if !is_union && !around.is_empty() {
        let exec = Exec::with_threads(1);
        let tracer = Tracer::build(solid, &TracerOptions::default(), &exec).map_err(|_| SpaceError::Unmeasured)?;
        // The box alone is wanted, and it does not depend on the options; these are for the volume.
        let options = MeasureOptions { tolerance: 1.0, max_rays: 1 };
        return match measure(&tracer, &options, &exec) {
            Ok(measures) => Ok(measures.bbox),
            Err(MeasureError::Unbounded) => Err(SpaceError::Unbounded),
            Err(_) => Err(SpaceError::Unmeasured),
        };
    }
    if around.is_bounded() { Ok(around) } else { Err(SpaceError::Unbounded) }
}

/// The solid scaled about the origin so that its box gets the sizes in `size`, as OpenSCAD's `resize` does: a size that is
/// not positive leaves its axis as it is, or, if `auto` says so for the axis, scales it like the axis with the largest size.
///
/// # Errors
/// If the solid is unbounded.
pub fn resize(solid: &Solid, size: Vec3, auto: [bool; 3]) -> Result<Solid, SpaceError> {
    let around = tight_bounds(solid)?;
    if !around.has_volume() {
        return Ok(Solid::empty());
    }
    let now = around.size();
    let wanted = size.to_array();
    let leading = (0..3).fold(0, |best, axis| if wanted[axis] > wanted[best] { axis } else { best });
    let common = if wanted[leading] > 0.0 { wanted[leading] / now[leading] } else { 1.0 };
    let factor = |axis: usize| match (wanted[axis] > 0.0, auto[axis]) {
        (true, _) => wanted[axis] / now[axis],
        (false, true) => common,
        (false, false) => 1.0,
    };
    Ok(solid.clone().scale([factor(0), factor(1), factor(2)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(x: f64, y: f64, z: f64) -> Solid {
        Solid::block().scale([x, y, z])
    }

    /// Sizes as OpenSCAD 2021.01 makes them of `cube([2, 3, 4])`.
    #[test]
    fn sizes_are_those_of_openscad() {
        let check = |size: [f64; 3], auto: [bool; 3], expected: [f64; 3]| {
            let resized = resize(&block(2.0, 3.0, 4.0), size.into(), auto).unwrap();
            assert_eq!(bounds(&resized), Bounds::new(Vec3::ZERO, expected.into()), "{size:?} {auto:?}");
        };
        check([10.0, 0.0, 0.0], [false; 3], [10.0, 3.0, 4.0]);
        check([10.0, 0.0, 0.0], [true; 3], [10.0, 15.0, 20.0]);
        check([10.0, 6.0, 0.0], [false, false, true], [10.0, 6.0, 20.0]);
        check([10.0, -6.0, 0.0], [false, true, true], [10.0, 15.0, 20.0]);
        check([0.0; 3], [false, true, true], [2.0, 3.0, 4.0]);
        check([3.0, 30.0, 0.0], [false, false, true], [3.0, 30.0, 40.0]);
    }

    #[test]
    fn resizing_is_about_the_origin() {
        let resized = resize(&block(2.0, 3.0, 4.0).translate([1.0; 3]), Vec3::new(10.0, 0.0, 0.0), [true; 3]).unwrap();
        assert_eq!(bounds(&resized), Bounds::new(Vec3::splat(5.0), Vec3::new(15.0, 20.0, 25.0)));
    }

    #[test]
    fn what_is_cut_away_is_measured() {
        let cut = block(4.0, 1.0, 1.0) - block(2.0, 3.0, 3.0).translate([2.0, -1.0, -1.0]);
        assert_eq!(bounds(&cut).max.x, 4.0);
        let resized = resize(&cut, Vec3::new(10.0, 0.0, 0.0), [false; 3]).unwrap();
        assert!((tight_bounds(&resized).unwrap().max.x - 10.0).abs() < 1e-5);
    }

    #[test]
    fn the_unbounded_has_no_size() {
        let unbounded = resize(&Solid::half_space(), Vec3::splat(1.0), [false; 3]);
        assert_eq!(unbounded.unwrap_err(), SpaceError::Unbounded);
        assert!(bounds(&Solid::empty()).is_empty());
    }
}
