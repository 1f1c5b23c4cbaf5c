//! Shapes made as large as asked for.

use super::{Affine2, Bounds2, Flat, PlaneError};
use crate::Tolerance;
use octrace::Vec2;

/// How `resize` scales something with these bounds, about the origin: along each axis to the new size, or, where that is 0,
/// not at all, or, where that is 0 and the axis is automatic, as much as along the axis with the larger new size.
///
/// The same rule as OpenSCAD's; what has no width is not scaled along that axis.
pub fn resize_factors(size: Vec2, new: Vec2, automatic: [bool; 2]) -> Vec2 {
    let factor = |new: f64, size: f64| if new > 0.0 && new.is_finite() && size > 0.0 { new / size } else { 1.0 };
    let own = Vec2::new(factor(new.x, size.x), factor(new.y, size.y));
    let leading = if new.y > new.x { own.y } else { own.x };
    let chosen = |automatic: bool, new: f64, own: f64| if automatic && new <= 0.0 { leading } else { own };
    Vec2::new(chosen(automatic[0], new.x, own.x), chosen(automatic[1], new.y, own.y))
}

impl Flat {
    /// The shape scaled about the origin to a new size, as OpenSCAD's `resize` does: see [`resize_factors`].
    ///
    /// # Errors
    /// As for [`Flat::outline`], which is asked for where the tree does more than unite.
    pub fn resized(self, new: Vec2, automatic: [bool; 2], tolerance: Tolerance) -> Result<Self, PlaneError> {
        let (shape, bounds) = if self.only_unites() {
            let bounds = self.bounds();
            (self, bounds)
        } else {
            let outline = self.outline(tolerance)?;
            let bounds = outline.bounds();
            (Self::Outline(outline), bounds)
        };
        let Some(size) = bounds.map(|b: Bounds2| b.size()) else { return Ok(Self::empty()) };
        Ok(shape.moved(Affine2::scale(resize_factors(size, new, automatic))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::Outline;
    use octrace::BoolOp;

    /// The same cases in OpenSCAD 2021.01 have these sizes.
    #[test]
    fn sizes_are_openscads() {
        let cases = [
            ([20.0, 10.0], [false, false], [20.0, 10.0]),
            ([20.0, 0.0], [false, false], [20.0, 3.0]),
            ([20.0, 0.0], [true, true], [20.0, 15.0]),
            ([20.0, 6.0], [true, false], [20.0, 6.0]),
            ([0.0, 6.0], [true, false], [8.0, 6.0]),
            ([8.0, 0.0], [false, true], [8.0, 6.0]),
        ];
        for (new, automatic, expected) in cases {
            let rectangle = Flat::from(Outline::rectangle(Vec2::new(2.0, 2.0), Vec2::new(6.0, 5.0)));
            let new = Vec2::new(new[0], new[1]);
            let resized = rectangle.resized(new, automatic, Tolerance::default()).expect("simple");
            assert_eq!(resized.bounds().map(|b| b.size()), Some(Vec2::new(expected[0], expected[1])));
        }
    }

    #[test]
    fn what_counts_is_what_is_left() {
        let rectangle = |w: f64| Flat::from(Outline::rectangle(Vec2::ZERO, Vec2::new(w, 2.0)));
        let cut = Flat::combined(BoolOp::Difference, [rectangle(8.0), rectangle(4.0)]);
        let resized = cut.resized(Vec2::new(1.0, 0.0), [false; 2], Tolerance::default()).expect("simple");
        let bounds = resized.bounds().expect("it is not empty");
        assert_eq!((bounds.min, bounds.max), (Vec2::new(1.0, 0.0), Vec2::new(2.0, 2.0)));
        let nothing = Flat::empty().resized(Vec2::new(1.0, 1.0), [false; 2], Tolerance::default());
        assert!(nothing.expect("simple").is_empty());
    }
}
