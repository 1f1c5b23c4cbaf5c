//! The grid on which polygons are combined.

use i_overlay::i_float::int::point::IntPoint;
use octrace::Vec2;

/// A point of the grid.
pub(super) type GridPoint = IntPoint<i64>;

/// Coordinates are no larger: these and their sums are exact as `f64`.
const LARGEST: f64 = 1_125_899_906_842_624.0;

/// How much smaller than the region most of it has to be for the grid to go by that.
const SMALL: f64 = 1.0 / 64.0;
/// How much finer the grid becomes at most.
const FINEST: f64 = 16_777_216.0;

/// A square grid over a region. Coordinates of corners that differ by less than a step become the same number, so that
/// edges along the axes that were meant to coincide do.
#[derive(Debug)]
pub(super) struct Grid {
    origin: Vec2,
    step: f64,
    xs: Vec<f64>,
    ys: Vec<f64>,
}

impl Grid {
    /// Steps in the larger side of the region, at least; at most twice as many. Where shapes are cut out of what stands for the
    /// whole plane, in the larger side of what most points are in.
    pub(super) const STEPS: f64 = 8388608.0;

    /// The grid for a region between two corners, and the corners of the curves in it; `points` are about where they go. `None`
    /// where the region has no size.
    pub(super) fn new(min: Vec2, max: Vec2, corners: &[Vec2], points: &[Vec2]) -> Option<Self> {
        let size = (max.x - min.x).max(max.y - min.y);
        if !(size > f64::MIN_POSITIVE * 1e30 && size.is_finite()) {
            return None;
        }
        let (_, exponent) = libm::frexp(size_of_most(points, size) / Self::STEPS);
        let step = libm::ldexp(1.0, exponent - 1);
        let middle = |a: f64, b: f64| ((a + b) * 0.5 / step).round() * step;
        let origin = Vec2::new(middle(min.x, max.x), middle(min.y, max.y));
        let xs = anchors(corners.iter().map(|p| p.x - origin.x).collect(), step);
        let ys = anchors(corners.iter().map(|p| p.y - origin.y).collect(), step);
        Some(Self { origin, step, xs, ys })
    }

    /// The distance of neighbours.
    pub(super) fn step(&self) -> f64 {
        self.step
    }

    /// The point for a corner, which must be one of those that the grid was made with.
    pub(super) fn corner(&self, p: Vec2) -> GridPoint {
        let anchored = |v: f64, anchors: &[f64]| anchors[anchors.partition_point(|&a| a <= v).saturating_sub(1)];
        self.point(anchored(p.x - self.origin.x, &self.xs), anchored(p.y - self.origin.y, &self.ys))
    }

    /// The nearest point.
    pub(super) fn nearest(&self, p: Vec2) -> GridPoint {
        self.point(p.x - self.origin.x, p.y - self.origin.y)
    }

    fn point(&self, x: f64, y: f64) -> GridPoint {
        // The library's numbers end a little beyond; only what was never on the grid gets there.
        let number = |v: f64| (v / self.step).round().clamp(-LARGEST, LARGEST) as i64;
        GridPoint::new(number(x), number(y))
    }

    /// Where a point of the grid is.
    pub(super) fn place(&self, p: GridPoint) -> Vec2 {
        self.origin + Vec2::new(p.x as f64, p.y as f64) * self.step
    }
}

/// The size of what most of the points are in, where that is much smaller than `size`, which all are in.
fn size_of_most(points: &[Vec2], size: f64) -> f64 {
    let quarter = points.len() / 4;
    let spread = |coordinate: fn(&Vec2) -> f64| {
        let mut values: Vec<f64> = points.iter().map(coordinate).collect();
        let mut at = |i: usize| *values.select_nth_unstable_by(i, f64::total_cmp).1;
        if points.is_empty() { size } else { at(points.len() - 1 - quarter) - at(quarter) }
    };
    // Half of the points are within half of that.
    let most = 8.0 * spread(|p| p.x).max(spread(|p| p.y));
    if 0.0 < most && most < SMALL * size { most.max(size / FINEST) } else { size }
}

/// The smallest of each group of numbers that are within a step of it.
pub(super) fn anchors(mut values: Vec<f64>, step: f64) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    let mut last = f64::NEG_INFINITY;
    values.retain(|&v| {
        let new = v - last > step;
        if new {
            last = v;
        }
        new
    });
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_that_nearly_coincide_do() {
        let corners = [Vec2::new(0.0, 0.0), Vec2::new(3.0, 1.0), Vec2::new(3.0 + 1e-7, 10.0)];
        let grid = Grid::new(corners[0], Vec2::new(10.0, 10.0), &corners, &corners).expect("it has a size");
        assert!(grid.step() <= 10.0 / Grid::STEPS && grid.step() > 5.0 / Grid::STEPS);
        assert_eq!(grid.corner(corners[1]).x, grid.corner(corners[2]).x);
        assert!((grid.place(grid.corner(corners[1])) - corners[1]).length() < grid.step());
        assert!(Grid::new(corners[0], corners[0], &corners, &corners).is_none());
    }

    #[test]
    fn a_frame_far_away_does_not_make_the_grid_coarse() {
        let square =
            |half: f64| [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| Vec2::new(x, y));
        let corners = [square(5e5), square(1.0)].concat();
        let grid = Grid::new(corners[0], corners[2], &corners, &corners).expect("it has a size");
        assert!(grid.step() <= 16.0 / Grid::STEPS, "{}", grid.step());
        assert!(corners.iter().all(|&p| (grid.place(grid.corner(p)) - p).length() <= grid.step()));
    }
}
