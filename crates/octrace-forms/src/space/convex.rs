//! The convex polyhedron around points, with few faces: triangles in one plane are one face.

use manifold_rust::linalg;
use manifold_rust::manifold::Manifold;
use octrace::{Bounds, Polyhedron, Vec3};
use std::collections::BTreeMap;

/// How far, as a share of the diagonal of the box around the points, corners may lie off a common face. Coordinates in
/// files have six digits, so what was planar is so to about this.
const COPLANAR: f64 = 2e-6;

/// The convex polyhedron around the points; `None` where they are in a plane, or not finite.
///
/// Its corners are some of the points, to the bit. A point closer than 1e-7 of the size to the hull of the others may be
/// passed over.
pub(crate) fn convex(points: &[Vec3]) -> Option<Polyhedron> {
    let (corners, triangles) = triangulated(points)?;
    let faces = merged(&corners, &triangles);
    Polyhedron::new(corners, faces).ok()
}

/// The same as corners and triangles.
pub(crate) fn triangulated(points: &[Vec3]) -> Option<(Vec<Vec3>, Vec<[u32; 3]>)> {
    let bounds = Bounds::around(points.iter().copied());
    if points.len() < 4 || !bounds.has_volume() || !points.iter().all(|p| p.is_finite()) {
        return None;
    }
    // Adding zero makes -0.0 equal to 0.0 to the bit.
    let mut distinct: Vec<Vec3> = points.iter().map(|&p| p + Vec3::ZERO).collect();
    distinct.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
    distinct.dedup();
    let hull = Manifold::hull(&distinct.iter().map(|p| linalg::Vec3::new(p.x, p.y, p.z)).collect::<Vec<_>>());
    let mesh = hull.get_mesh_gl64(-1);
    let (corners, []) = mesh.vert_properties.as_chunks::<3>() else { return None };
    let corners = corners.iter().map(|&p| Vec3::from(p)).collect();
    let triangles = mesh.tri_verts.as_chunks::<3>().0.iter().map(|t| t.map(|i| i as u32)).collect();
    Some((corners, triangles))
}

/// The triangles of a closed surface put together to faces whose corners lie in a plane.
pub(crate) fn merged(corners: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let tolerance = COPLANAR * Bounds::around(corners.iter().copied()).diagonal();
    let across: BTreeMap<(u32, u32), usize> =
        triangles.iter().enumerate().flat_map(|(t, c)| edges(c).map(move |edge| (edge, t))).collect();
    let corner = |i: u32| corners[i as usize];
    let doubled_area = |t: &[u32; 3]| (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0]));
    let areas: Vec<Vec3> = triangles.iter().map(doubled_area).collect();
    // From the largest triangle of a face on: its plane is the best known.
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    order.sort_by(|&a, &b| areas[b].length().total_cmp(&areas[a].length()).then(a.cmp(&b)));
    let mut taken = vec![false; triangles.len()];
    let mut faces = Vec::new();
    for seed in order {
        if taken[seed] {
            continue;
        }
        taken[seed] = true;
        let (mut region, mut next) = (vec![seed], 0);
        if let Some(normal) = areas[seed].normalized() {
            let through = corner(triangles[seed][0]);
            let in_plane = |t: usize| triangles[t].iter().all(|&i| normal.dot(corner(i) - through).abs() <= tolerance);
            while let Some(&t) = region.get(next) {
                next += 1;
                for (a, b) in edges(&triangles[t]) {
                    if let Some(&other) = across.get(&(b, a))
                        && !taken[other]
                        && areas[other].dot(normal) >= 0.0
                        && in_plane(other)
                    {
                        taken[other] = true;
                        region.push(other);
                    }
                }
            }
        }
        match outline(region.iter().flat_map(|&t| edges(&triangles[t]))) {
            Some(face) => faces.push(face),
            None => faces.extend(region.iter().map(|&t| triangles[t].to_vec())),
        }
    }
    without_seams(faces)
}

fn edges(&[a, b, c]: &[u32; 3]) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// The one closed walk along those edges that are not used in both directions; `None` where it is not one walk.
fn outline(edges: impl Iterator<Item = (u32, u32)>) -> Option<Vec<u32>> {
    let mut open = BTreeMap::new();
    let mut pending: std::collections::BTreeSet<(u32, u32)> = edges.collect();
    while let Some((a, b)) = pending.pop_first() {
        if !pending.remove(&(b, a)) && open.insert(a, b).is_some() {
            return None;
        }
    }
    let (&first, _) = open.first_key_value()?;
    let (mut walk, mut at) = (vec![first], open.remove(&first)?);
    while at != first {
        walk.push(at);
        at = open.remove(&at)?;
    }
    open.is_empty().then_some(walk)
}

/// Faces without the corners at which only two of them meet: these are in the middle of straight sides.
fn without_seams(mut faces: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    let mut uses = BTreeMap::new();
    faces.iter().flatten().for_each(|&i| *uses.entry(i).or_insert(0_u32) += 1);
    for face in &mut faces {
        face.retain(|i| uses[i] > 2);
    }
    faces
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice(n: u32) -> Vec<Vec3> {
        (0..n * n * n).map(|i| Vec3::new(f64::from(i % n), f64::from(i / n % n), f64::from(i / n / n))).collect()
    }

    #[test]
    fn a_lattice_has_the_six_faces_of_its_box() {
        let hull = convex(&lattice(4)).unwrap();
        assert_eq!((hull.points().len(), hull.faces().len(), hull.volume()), (8, 6, 27.0));
        assert!(hull.faces().iter().all(|f| f.len() == 4));
    }

    #[test]
    fn six_digits_are_planar_enough() {
        let round = |x: f64| (x * 1e5).round() / 1e5;
        let turned = octrace::Affine::rotation_deg(Vec3::new(10.0, 20.0, 30.0));
        let points: Vec<Vec3> =
            lattice(3).into_iter().map(|p| Vec3::from(turned.point(p * 3.0).to_array().map(round))).collect();
        let hull = convex(&points).unwrap();
        assert_eq!(hull.faces().len(), 6);
        assert!((hull.volume() - 216.0).abs() < 2e-3, "{}", hull.volume());
    }

    #[test]
    fn what_is_flat_has_no_hull() {
        assert!(convex(&[]).is_none());
        assert!(convex(&lattice(1)).is_none());
        let plane: Vec<Vec3> =
            (0..9).map(|i| Vec3::new(f64::from(i), f64::from(i % 3), f64::from(i + i % 3))).collect();
        assert!(convex(&plane).is_none());
        assert!(convex(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::splat(f64::NAN)]).is_none());
    }

    #[test]
    fn a_prism_keeps_its_two_ends_whole() {
        let n = 96;
        let ring = |z: f64| {
            (0..n).map(move |i| {
                let (s, c) = octrace::geom::sin_cos_deg(f64::from(i) * 360.0 / f64::from(n));
                Vec3::new(20.0 * c, 20.0 * s, z)
            })
        };
        let points: Vec<Vec3> = ring(0.0).chain(ring(7.0)).collect();
        assert_eq!(convex(&points).unwrap().faces().len(), n as usize + 2);
    }
}
