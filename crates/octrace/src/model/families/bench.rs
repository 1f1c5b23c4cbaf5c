//! The scenes of `octrace bench` and of the race against other programs (`bench/race`): equal solids there and here.

use super::mersenne::Mersenne;
use super::{Solid, classic};
use crate::geom::Vec3;

/// A plate with rounded corners and `per_side` by `per_side` counterbored holes, lying on z = 0.
pub fn plate(per_side: u32) -> Solid {
    const PITCH: f64 = 1.5;
    const CORNER: f64 = 1.5;
    const THICKNESS: f64 = 1.0;
    let half = f64::from(per_side) * PITCH / 2.0 + 0.5;
    let inner = half - CORNER;
    let bars = [[inner, half], [half, inner]].map(|[x, y]| block([-x, -y, 0.0], [x, y, THICKNESS]));
    let signs = [-1.0, 1.0];
    let corners =
        signs.iter().flat_map(|x| signs.iter().map(move |y| pin([x * inner, y * inner], CORNER, 0.0, THICKNESS)));
    let at = |i: u32| (f64::from(i) - (f64::from(per_side) - 1.0) / 2.0) * PITCH;
    let places = (0..per_side).flat_map(|j| (0..per_side).map(move |i| [at(i), at(j)]));
    let holes = places.flat_map(|place| {
        let beyond = THICKNESS + 0.5;
        [pin(place, 0.32, -0.5, beyond), pin(place, 0.55, 0.6 * THICKNESS, beyond)]
    });
    Solid::difference([Solid::union(bars.into_iter().chain(corners))].into_iter().chain(holes))
}

/// Menger's sponge about the origin, 2 wide: a block minus square bars along all axes, finer at every level.
pub fn menger(levels: u32) -> Solid {
    /// Whether a square of the carpet was not taken out by a coarser bar.
    fn is_kept(mut i: u32, mut j: u32) -> bool {
        while i > 0 || j > 0 {
            if i % 3 == 1 && j % 3 == 1 {
                return false;
            }
            (i, j) = (i / 3, j / 3);
        }
        true
    }
    /// The bars reach out of the block, so that no faces coincide with its own.
    const END: f64 = 1.1;
    let bars = (0..levels).flat_map(|level| {
        let across = 3_u32.pow(level);
        let cell = 2.0 / f64::from(across);
        let squares = (0..across).flat_map(move |i| (0..across).map(move |j| (i, j)));
        squares.filter(|&(i, j)| is_kept(i, j)).flat_map(move |(i, j)| {
            let [u, v] = [i, j].map(|i| -1.0 + (f64::from(i) + 1.0 / 3.0) * cell);
            let w = cell / 3.0;
            [
                block([u, v, -END], [u + w, v + w, END]),
                block([u, -END, v], [u + w, END, v + w]),
                block([-END, u, v], [END, u + w, v + w]),
            ]
        })
    });
    Solid::difference([block([-1.0; 3], [1.0; 3])].into_iter().chain(bars))
}

/// A block about the origin, 2 wide, minus `n` balls of different sizes at random places; together they have 0.4 of the
/// block's volume.
pub fn swiss(n: u32) -> Solid {
    let mut random = Mersenne::new(12_345_u32.wrapping_add(n));
    let volume_each = 0.4 * 8.0 / f64::from(n.max(1));
    let radius = libm::pow(volume_each * 3.0 / (4.0 * std::f64::consts::PI), 1.0 / 3.0);
    let ball = |_| {
        let center: [f64; 3] = std::array::from_fn(|_| random.uniform(-1.0, 1.0));
        Solid::sphere().scale([radius * random.uniform(0.6, 1.4); 3]).translate(center)
    };
    Solid::difference([block([-1.0; 3], [1.0; 3])].into_iter().chain((0..n).map(ball)))
}

/// Copies of the [`classic`] about the origin, as many as given along each axis, 3 from one to the next.
pub fn grid([nx, ny, nz]: [u32; 3]) -> Solid {
    const STEP: f64 = 3.0;
    let one = classic();
    let at = |i: u32, count: u32| (f64::from(i) - (f64::from(count) - 1.0) / 2.0) * STEP;
    let places =
        (0..nz).flat_map(|k| (0..ny).flat_map(move |j| (0..nx).map(move |i| [at(i, nx), at(j, ny), at(k, nz)])));
    Solid::union(places.map(|place| one.clone().translate(place)))
}

fn block(min: [f64; 3], max: [f64; 3]) -> Solid {
    let (min, max) = (Vec3::from(min), Vec3::from(max));
    Solid::block().scale(max - min).translate(min)
}

/// A cylinder upright at a place of the plane.
fn pin([x, y]: [f64; 2], radius: f64, low: f64, high: f64) -> Solid {
    Solid::cylinder().scale([radius, radius, high - low]).translate([x, y, low])
}
