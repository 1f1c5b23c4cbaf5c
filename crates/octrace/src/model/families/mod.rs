//! Families of solids that grow without end, to measure with: what does it cost to have ten times as many primitives,
//! or a tree twice as deep? The same on every machine.

mod bench;
mod mersenne;

pub use bench::{grid, menger, plate, swiss};

use super::Solid;
use crate::geom::{Vec3, sin_cos_deg};

/// Cube and sphere minus three cylinders, about the origin, 2 wide.
pub fn classic() -> Solid {
    let bar = Solid::cylinder().translate([0.0, 0.0, -0.5]).scale([0.6, 0.6, 3.0]);
    let cube = Solid::block().translate([-0.5; 3]).scale([2.0; 3]);
    let across = [bar.clone().rotate([90.0, 0.0, 0.0]), bar.clone().rotate([0.0, 90.0, 0.0])];
    Solid::difference([cube & Solid::sphere().scale([1.35; 3]), bar].into_iter().chain(across))
}

/// A block minus `n` balls on a cubic lattice, spread evenly over its points where `n` is not a cube. The lattice has a
/// unit between points and the block is as many units wide as the lattice has points; balls reach out of three of its
/// faces.
pub fn balls(n: u32) -> Solid {
    let n = u64::from(n);
    let edge = (1_u64..).find(|edge| edge.pow(3) >= n).unwrap_or(1);
    let ball = |i: u64| {
        let place = i * edge.pow(3) / n;
        let at = [place % edge, place / edge % edge, place / edge / edge];
        Solid::sphere().scale([0.45; 3]).translate(at.map(|c| c as f64 + 0.25))
    };
    Solid::difference([Solid::block().scale([edge as f64; 3])].into_iter().chain((0..n).map(ball)))
}

/// `n` copies of the [`classic`] in a square, none touching another.
pub fn copies(n: u32) -> Solid {
    let columns = (1_u32..).find(|&columns| u64::from(columns).pow(2) >= u64::from(n)).unwrap_or(1);
    let at = |i: u32| [f64::from(i % columns) * 3.0, f64::from(i / columns) * 3.0, 0.0];
    Solid::union((0..n).map(|i| classic().translate(at(i))))
}

/// A ball that `depth` smaller ones on its surface are taken from and added to by turns, in a tree that is as deep as
/// it has operators: no step can be exchanged with the next.
pub fn chain(depth: u32) -> Solid {
    /// What the directions of a sunflower's seeds differ by.
    const GOLDEN_ANGLE_DEG: f64 = 137.507_764_050_037_85;
    (0..depth).fold(Solid::sphere(), |solid, i| {
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(depth);
        let radius = (1.0 - z * z).sqrt();
        let (sin, cos) = sin_cos_deg(GOLDEN_ANGLE_DEG * f64::from(i));
        let lump = Solid::sphere().scale([0.25; 3]).translate(Vec3::new(radius * cos, radius * sin, z));
        if i % 2 == 0 { solid - lump } else { solid + lump }
    })
}
