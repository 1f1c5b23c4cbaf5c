//! Points that are meant to be one point become one.

use super::RawMesh;
use octrace::Vec3;
use rustc_hash::FxHashMap;

/// Bins are this many tolerances wide, so that most points need one look only.
const BIN_WIDTH: f64 = 16.0;

/// The mesh with points no farther apart than about `tolerance` (the largest difference of a coordinate) made one: each
/// becomes the first such point in the file. Points keep their order; a tolerance of zero joins equal points.
pub(in crate::files) fn welded(mesh: RawMesh, tolerance: f64) -> RawMesh {
    let width = (BIN_WIDTH * tolerance).max(f64::MIN_POSITIVE);
    // Number of the bin, by axis. Numbers beyond those of `i64` share its last one, which costs time only.
    let bin = |p: Vec3| p.to_array().map(|x| if tolerance > 0.0 { (x / width).floor() as i64 } else { bits(x) });
    let mut bins: FxHashMap<[i64; 3], Vec<u32>> = FxHashMap::default();
    let mut points: Vec<Vec3> = Vec::new();
    let mut renumbered = Vec::with_capacity(mesh.points.len());
    for p in mesh.points {
        let home = bin(p);
        let (low, high) = (bin(p - Vec3::splat(tolerance)), bin(p + Vec3::splat(tolerance)));
        let near = |&i: &u32| (points[i as usize] - p).max_abs() <= tolerance;
        let around = |axis: usize| [low[axis], high[axis]].into_iter().take(if low[axis] < high[axis] { 2 } else { 1 });
        let known = around(0)
            .flat_map(|x| around(1).flat_map(move |y| around(2).map(move |z| [x, y, z])))
            .filter_map(|at| bins.get(&at)?.iter().copied().find(near))
            .min();
        renumbered.push(known.unwrap_or_else(|| {
            bins.entry(home).or_default().push(points.len() as u32);
            points.push(p);
            points.len() as u32 - 1
        }));
    }
    let mut faces = mesh.faces;
    // Indices of points that are not there stay as wrong as they are.
    faces.iter_mut().flatten().for_each(|i| *i = renumbered.get(*i as usize).copied().unwrap_or(u32::MAX));
    RawMesh { points, faces }
}

/// A number that tells coordinates apart; both zeros have the same.
fn bits(x: f64) -> i64 {
    (x + 0.0).to_bits() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_points_become_the_first_of_them() {
        let xs = [0.0, 1.0, 1.09, 0.95, 2.0, -0.0];
        let mesh = RawMesh {
            points: xs.iter().map(|&x| Vec3::new(x, 0.0, 0.0)).collect(),
            faces: vec![vec![0, 1, 2], vec![3, 4, 5, 9]],
        };
        let joined = welded(mesh.clone(), 0.1);
        assert_eq!(joined.points, [0.0, 1.0, 2.0].map(|x| Vec3::new(x, 0.0, 0.0)));
        assert_eq!(joined.faces, [vec![0, 1, 1], vec![1, 2, 0, u32::MAX]]);
        assert_eq!(welded(mesh, 0.0).points.len(), 5);
    }

    #[test]
    fn a_grid_of_points_at_the_borders_of_bins_is_found_again() {
        let points: Vec<Vec3> =
            (0..1000).map(|i| Vec3::new(f64::from(i) * 1.6e-5, 0.0, -f64::from(i) * 0.8e-5)).collect();
        let shifted = points.iter().map(|&p| p + Vec3::splat(0.9e-6));
        let mesh = RawMesh { points: points.iter().copied().chain(shifted).collect(), faces: Vec::new() };
        assert_eq!(welded(mesh, 1e-6).points, points);
    }
}
