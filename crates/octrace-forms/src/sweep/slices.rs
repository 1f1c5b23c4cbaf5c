//! How many pieces OpenSCAD cuts round and twisted things into, by `$fn`, `$fa` and `$fs`.

/// OpenSCAD's `$fn`, `$fa` and `$fs`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragments {
    /// `$fn`: so many for a full turn; 0 leaves it to the other two.
    pub count: f64,
    /// `$fa`: the least angle of a fragment, in degrees.
    pub angle_deg: f64,
    /// `$fs`: the least size of a fragment.
    pub size: f64,
}

impl Default for Fragments {
    fn default() -> Self {
        Self { count: 0.0, angle_deg: 12.0, size: 2.0 }
    }
}

/// OpenSCAD's finest grid: what is smaller than this has no shape.
const GRID: f64 = 1.0 / 1_048_576.0;
/// What OpenSCAD takes `$fa` and `$fs` for if they are smaller.
const SMALLEST: f64 = 0.01;
/// More than these are never made.
const MOST: f64 = 100_000.0;

impl Fragments {
    fn angle(&self) -> f64 {
        self.angle_deg.max(SMALLEST)
    }

    fn least_size(&self) -> f64 {
        self.size.max(SMALLEST)
    }
}

/// How many corners a full turn of this radius has.
pub fn fragments(radius: f64, by: &Fragments) -> u32 {
    if radius < GRID || !by.count.is_finite() {
        3
    } else if by.count > 0.0 {
        (by.count as u32).max(3)
    } else {
        let size = radius * std::f64::consts::TAU / by.least_size();
        (360.0 / by.angle()).min(size).max(5.0).ceil() as u32
    }
}

/// How many slices a twisted extrusion has: as fine as its outermost corner's way around needs it. `length` is how far
/// that corner goes.
fn twisted(twist_deg: f64, radius: f64, length: f64, by: &Fragments) -> u32 {
    let least = (twist_deg / 120.0).ceil().max(1.0);
    if radius < GRID || !by.count.is_finite() {
        return least as u32;
    }
    let wanted = match by.count > 0.0 {
        true => (twist_deg / 360.0 * by.count).ceil(),
        false => (twist_deg / by.angle()).ceil().min((length / by.least_size()).ceil()),
    };
    wanted.max(least).min(MOST) as u32
}

/// Slices of an extrusion by `height` with a twist (in degrees) and without scaling; its outermost corner is `radius`
/// from the axis and follows a helix.
pub(super) fn of_helix(radius: f64, height: f64, twist_deg: f64, by: &Fragments) -> u32 {
    let twist_deg = twist_deg.abs();
    let around = radius * twist_deg.to_radians();
    twisted(twist_deg, radius, (around * around + height * height).sqrt(), by)
}

/// Slices of an extrusion with a twist and uniform scaling: seen from above its outermost corner follows a spiral of
/// Archimedes.
pub(super) fn of_spiral(radius: f64, height: f64, twist_deg: f64, scale: f64, by: &Fragments) -> u32 {
    let twist_deg = twist_deg.abs();
    let turned = twist_deg.to_radians();
    // The spiral starts where the radius would be zero.
    let end = turned * scale.max(1.0) / (scale - 1.0).abs();
    let spiral = |angle: f64| 0.5 * radius / end * (angle * (1.0 + angle * angle).sqrt() + libm::asinh(angle));
    let around = spiral(end) - spiral(end - turned);
    twisted(twist_deg, radius, (around * around + height * height).sqrt(), by)
}

/// Slices of an extrusion whose scales along x and y differ: no corner moves sideways by more than `farthest`.
pub(super) fn of_scaling(farthest: f64, height: f64, by: &Fragments) -> u32 {
    if farthest < GRID || !by.count.is_finite() {
        return 1;
    }
    let wanted = match by.count > 0.0 {
        true => by.count,
        false => ((farthest * farthest + height * height).sqrt() / by.least_size()).ceil(),
    };
    wanted.clamp(1.0, MOST) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What OpenSCAD 2021.01 makes, counted in the corners of its output.
    #[test]
    fn openscad_counts_like_this() {
        let default = Fragments::default();
        let twenty = Fragments { count: 20.0, ..default };
        let corner = 8.0_f64.sqrt();
        assert_eq!(fragments(1.0, &default), 5);
        assert_eq!(fragments(10.0, &default), 30);
        assert_eq!(of_helix(corner, 10.0, 90.0, &default), 6);
        assert_eq!(of_helix(corner, 10.0, 90.0, &twenty), 5);
        assert_eq!(of_helix(corner, 10.0, 5.0, &default), 1);
        assert_eq!(of_spiral(corner, 10.0, 90.0, 2.0, &default), 6);
        assert_eq!(of_scaling(4.0 * libm::sin(72_f64.to_radians()), 10.0, &default), 6);
    }
}
