//! Surfaces against eight boxes at once: the children of a cell.
//!
//! What comes in is where the boxes are; what goes out are two sets of them as bits: those inside a surface and those
//! outside. Lanes are arrays of eight, operations loops over them, which the compiler makes wide instructions of. The
//! formulas are those of [`Surface::classify`], and where boxes agree so do the answers, to the bit.

use super::{CellBox, Plane, Quadric, QuadricKind, Side, Surface};
use crate::geom::Vec3;

/// Eight boxes of one size, in two places along every axis. Box `i` is in the high place in x, y, z where bit 0, 1, 2 of
/// `i` is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octants {
    /// The middle of the box that is in the low place along every axis.
    low: Vec3,
    /// The middle of the box that is in the high place along every axis.
    high: Vec3,
    /// Half the edges, with the margin.
    half: Vec3,
    /// See [`CellBox::rounding`].
    rounding: f64,
}

/// Where eight boxes lie with respect to a set, a bit for each. A box in neither is crossed, or may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OctantSides {
    /// The boxes that are all inside.
    pub inside: u8,
    /// The boxes that are all outside.
    pub outside: u8,
}

impl OctantSides {
    /// All boxes on the same side.
    pub fn all(side: Side) -> Self {
        match side {
            Side::Inside => Self { inside: u8::MAX, outside: 0 },
            Side::Outside => Self { inside: 0, outside: u8::MAX },
            Side::Crossing => Self { inside: 0, outside: 0 },
        }
    }
}

const LANES: usize = 8;
type Lanes = [f64; LANES];

impl Octants {
    /// The octants of the cube about `center`, each with a margin all around; `child_half` is half an octant's edge without.
    pub fn new(center: Vec3, child_half: f64, margin: f64) -> Self {
        let CellBox { half, rounding, .. } = CellBox::with_margin(center, Vec3::splat(child_half), margin);
        let offset = Vec3::splat(child_half);
        Self { low: center - offset, high: center + offset, half, rounding }
    }

    /// One box eight times.
    pub fn all(cell: &CellBox) -> Self {
        Self { low: cell.center, high: cell.center, half: cell.half, rounding: cell.rounding }
    }

    /// The boxes as they lie from a place that is moved by `by`.
    pub(crate) fn seen_from(&self, by: Vec3) -> Self {
        Self { low: self.low - by, high: self.high - by, ..*self }
    }

    /// From where to where the boxes in the low place along an axis reach, and those in the high place.
    #[inline(always)]
    pub(super) fn extents(&self, axis: usize) -> ((f64, f64), (f64, f64)) {
        let extent = |middle: f64| (middle - self.half[axis], middle + self.half[axis]);
        (extent(self.low[axis]), extent(self.high[axis]))
    }

    /// One of the boxes.
    pub fn cell(&self, octant: usize) -> CellBox {
        let side = |axis: usize| if octant >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] };
        CellBox { center: Vec3::new(side(0), side(1), side(2)), half: self.half, rounding: self.rounding }
    }
}

impl Surface {
    /// [`classify`](Self::classify) for eight boxes.
    #[inline(always)]
    pub fn classify_octants(&self, octants: &Octants) -> OctantSides {
        match self {
            Self::Plane(plane) => plane.classify_octants(octants),
            Self::Quadric(quadric) => quadric.classify_octants(octants),
            Self::Torus(_) | Self::Mesh(_) => self.classify_one_by_one(octants),
            Self::Placed(placed) => placed.classify_octants(octants),
        }
    }

    #[inline(never)]
    fn classify_one_by_one(&self, octants: &Octants) -> OctantSides {
        let mut sides = OctantSides { inside: 0, outside: 0 };
        for octant in 0..LANES {
            match self.classify(&octants.cell(octant)) {
                Side::Inside => sides.inside |= 1 << octant,
                Side::Outside => sides.outside |= 1 << octant,
                Side::Crossing => {}
            }
        }
        sides
    }
}

/// Eight numbers, of which number `i` depends on bit `axis` of `i`.
#[inline(always)]
fn along(axis: usize, [low, high]: [f64; 2]) -> Lanes {
    std::array::from_fn(|i| if i >> axis & 1 == 0 { low } else { high })
}

#[inline(always)]
fn map(f: impl Fn(usize) -> f64) -> Lanes {
    std::array::from_fn(f)
}

/// The lanes for which something holds, as bits.
#[inline(always)]
fn bits(holds: impl Fn(usize) -> bool) -> u8 {
    let lanes: [bool; LANES] = std::array::from_fn(holds);
    (0..LANES).fold(0, |bits, i| bits | u8::from(lanes[i]) << i)
}

/// The four boxes in the low place along an axis, the four in the high place, or both.
#[inline(always)]
pub(crate) fn halves(axis: usize, [low, high]: [bool; 2]) -> u8 {
    const LOW: [u8; 3] = [0b0101_0101, 0b0011_0011, 0b0000_1111];
    (if low { LOW[axis] } else { 0 }) | (if high { !LOW[axis] } else { 0 })
}

impl Plane {
    /// The axis that the normal is along, if it is.
    #[inline(always)]
    pub(super) fn axis(&self) -> Option<usize> {
        let n = self.normal;
        match (n.x == 0.0, n.y == 0.0, n.z == 0.0) {
            (false, true, true) => Some(0),
            (true, false, true) => Some(1),
            (true, true, false) => Some(2),
            _ => None,
        }
    }

    #[inline(always)]
    fn classify_octants(&self, octants: &Octants) -> OctantSides {
        let Octants { low, high, half, .. } = octants;
        let n = self.normal;
        if let Some(axis) = self.axis() {
            // Four boxes at a time.
            let reach = n[axis].abs() * half[axis];
            let height = [low, high].map(|middle| n[axis] * middle[axis] - self.offset);
            return OctantSides {
                inside: halves(axis, height.map(|height| height <= -reach)),
                outside: halves(axis, height.map(|height| height >= reach)),
            };
        }
        let (x, y, z) = (
            along(0, [n.x * low.x, n.x * high.x]),
            along(1, [n.y * low.y, n.y * high.y]),
            along(2, [n.z * low.z, n.z * high.z]),
        );
        let height = map(|i| x[i] + y[i] + z[i] - self.offset);
        let reach = n.abs().dot(*half);
        OctantSides { inside: bits(|i| height[i] <= -reach), outside: bits(|i| height[i] >= reach) }
    }
}

impl Quadric {
    /// See [`Quadric::classify`].
    #[inline(always)]
    fn classify_octants(&self, octants: &Octants) -> OctantSides {
        match self.axes() {
            Some(axes) => self.classify_along_axes(axes, octants),
            None => self.classify_across_axes(octants),
        }
    }

    /// The axis of the scene that each of the quadric's own coordinates is along, if they all are along one.
    #[inline(always)]
    pub(super) fn axes(&self) -> Option<[usize; 3]> {
        let [x, y, z] = self.to_local.rows;
        let straight = x.y == 0.0 && x.z == 0.0 && y.x == 0.0 && y.z == 0.0 && z.x == 0.0 && z.y == 0.0;
        if straight {
            return Some([0, 1, 2]);
        }
        let alone = |row: Vec3| match row.to_array().map(|c| c != 0.0) {
            [true, false, false] => Some(0),
            [false, true, false] => Some(1),
            [false, false, true] => Some(2),
            _ => None,
        };
        let axes = [alone(x)?, alone(y)?, alone(z)?];
        (axes.iter().sum::<usize>() == 3 && axes[0] != axes[1]).then_some(axes)
    }

    /// Where coordinates do not mix, interval arithmetic is exact: what else there is adds nothing.
    #[inline(always)]
    fn classify_along_axes(&self, axes: [usize; 3], octants: &Octants) -> OctantSides {
        let (s, c0) = self.kind.coefficients();
        let (mut least, mut most) = ([[0.0; 2]; 3], [[0.0; 2]; 3]);
        for (row, &axis) in axes.iter().enumerate() {
            let (scale, shift) = (self.to_local.rows[row][axis], self.to_local.translation[row]);
            let reach = scale.abs() * octants.half[axis] + scale.abs() * octants.rounding;
            for (place, middle) in [octants.low[axis], octants.high[axis]].into_iter().enumerate() {
                let coordinate = (scale * middle + shift).abs();
                let (near, far) = ((coordinate - reach).max(0.0), coordinate + reach);
                let (low, high) = (near * near, far * far);
                (least[axis][place], most[axis][place]) = match (row, s < 0.0) {
                    (2, true) => (-high, -low),
                    (2, false) => (s * low, s * high),
                    _ => (low, high),
                };
            }
        }
        let sum = |[x, y, z]: [[f64; 2]; 3]| {
            let (x, y, z) = (along(0, x), along(1, y), along(2, z));
            map(|i| x[i] + y[i] + z[i] + c0)
        };
        let (least, most) = (sum(least), sum(most));
        OctantSides { inside: bits(|i| most[i] <= 0.0), outside: bits(|i| least[i] >= 0.0) }
    }

    #[inline(always)]
    fn classify_across_axes(&self, octants: &Octants) -> OctantSides {
        let Octants { low, high, half, rounding } = octants;
        let (s, c0) = self.kind.coefficients();
        let [rx, ry, rz] = self.to_local.rows;
        let cell = CellBox { center: *low, half: *half, rounding: *rounding };
        let (reach, rounding) = cell.reach(&self.to_local.rows);
        let local = |row: Vec3, shift: f64| {
            let (x, y, z) = (
                along(0, [row.x * low.x, row.x * high.x]),
                along(1, [row.y * low.y, row.y * high.y]),
                along(2, [row.z * low.z, row.z * high.z]),
            );
            map(|i| x[i] + y[i] + z[i] + shift)
        };
        let shift = self.to_local.translation;
        let (qx, qy, qz) = (local(rx, shift.x), local(ry, shift.y), local(rz, shift.z));

        let near = |q: f64, reach: f64| (q.abs() - reach).max(0.0);
        let far = |q: f64, reach: f64| q.abs() + reach;
        let square = |v: f64| v * v;
        let coarse_least = map(|i| {
            let z = if s < 0.0 { far(qz[i], reach.z) } else { near(qz[i], reach.z) };
            square(near(qx[i], reach.x)) + square(near(qy[i], reach.y)) + s * square(z) + c0
        });
        let coarse_most = map(|i| {
            let z = if s < 0.0 { near(qz[i], reach.z) } else { far(qz[i], reach.z) };
            square(far(qx[i], reach.x)) + square(far(qy[i], reach.y)) + s * square(z) + c0
        });

        let value = map(|i| qx[i] * qx[i] + qy[i] * qy[i] + s * (qz[i] * qz[i]) + c0);
        let slope =
            |axis: usize| map(|i| rx[axis] * (2.0 * qx[i]) + ry[axis] * (2.0 * qy[i]) + rz[axis] * (2.0 * s * qz[i]));
        let (sx, sy, sz) = (slope(0), slope(1), slope(2));
        let linear = map(|i| {
            let shifted = sx[i].abs() * half.x + sy[i].abs() * half.y + sz[i].abs() * half.z;
            let rounded = qx[i].abs() * rounding.x + qy[i].abs() * rounding.y + qz[i].abs() * rounding.z;
            shifted + 2.0 * rounded
        });
        let bulge = reach.x * reach.x + reach.y * reach.y;
        let (bulge_least, bulge_most) = match self.kind {
            QuadricKind::Sphere => (0.0, bulge + reach.z * reach.z),
            QuadricKind::Cylinder => (0.0, bulge),
            QuadricKind::Cone => (-(reach.z * reach.z), bulge),
        };
        OctantSides {
            inside: bits(|i| coarse_most[i] <= 0.0 || value[i] + linear[i] + bulge_most <= 0.0),
            outside: bits(|i| coarse_least[i] >= 0.0 || value[i] - linear[i] + bulge_least >= 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Affine;
    use crate::surface::{Torus, TorusKind};

    /// Surfaces of all kinds, along the axes and across them.
    fn surfaces() -> Vec<Surface> {
        let turned = Affine::rotation_deg(Vec3::new(20.0, 30.0, 40.0)) * Affine::scale(Vec3::new(1.0, 0.5, 2.0));
        let swapped = Affine::rotation_deg(Vec3::new(0.0, 90.0, 0.0)) * Affine::translation(Vec3::new(0.1, -0.2, 0.3));
        let mut surfaces = Vec::new();
        for to_local in [Affine::IDENTITY, Affine::scale(Vec3::new(1.0, 2.0, 3.0)), swapped, turned] {
            for kind in [QuadricKind::Sphere, QuadricKind::Cylinder, QuadricKind::Cone] {
                surfaces.push(Surface::Quadric(Quadric { kind, to_local }));
            }
            surfaces.push(Surface::Torus(Torus { kind: TorusKind::Outer, minor: 0.5, to_local }));
            surfaces.push(Surface::Torus(Torus { kind: TorusKind::Inner, minor: 2.0, to_local }));
            let normal = to_local.vector(Vec3::X).normalized().expect("a direction");
            surfaces.push(Surface::Plane(Plane { normal, offset: 0.25 }));
        }
        surfaces
    }

    #[test]
    fn eight_boxes_are_what_each_of_them_is() {
        for surface in surfaces() {
            let mut decided = 0;
            for place in 0..1000 {
                let at = |n: i32| f64::from(place / n % 10) * 0.4 - 1.8;
                let half = [0.02, 0.1, 0.4][place as usize % 3];
                let octants = Octants::new(Vec3::new(at(1), at(10), at(100)), half, 1e-8);
                let sides = surface.classify_octants(&octants);
                for octant in 0..8 {
                    let expected = surface.classify(&octants.cell(octant));
                    let side = match (sides.inside >> octant & 1, sides.outside >> octant & 1) {
                        (0, 0) => Side::Crossing,
                        (0, _) => Side::Outside,
                        (_, 0) => Side::Inside,
                        (_, _) => panic!("{surface:?}: box {octant} of {octants:?} is said to be on both sides"),
                    };
                    assert_eq!(side, expected, "{surface:?}: box {octant} of {octants:?}");
                    decided += u32::from(side != Side::Crossing);
                }
            }
            assert!(decided > 2000, "{surface:?} decides where boxes are");
        }
    }
}
