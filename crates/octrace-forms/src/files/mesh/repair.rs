//! Closing meshes that are nearly closed.
//!
//! In this order: faces that cannot be faces go; points that nearly coincide at the boundary are joined; faces that are
//! there twice go; corners in the middle of a neighbour's edge are put into that edge; what is still open gets a face for
//! each loop of the boundary. Which way round faces are is settled when the solid is made.

use super::{RawMesh, weld};
use octrace::{Bounds, Vec3};
use rustc_hash::FxHashMap;

/// At the boundary, points are joined over this share of the mesh's diagonal.
const JOIN: f64 = 1e-5;

/// What a repair did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repairs {
    /// Points that were joined with others.
    pub joined_points: usize,
    /// Faces that went: without an area between their corners, there twice, or naming no points.
    pub dropped_faces: usize,
    /// Corners that were put into edges that they lie on.
    pub split_edges: usize,
    /// Holes that were closed, each with one face.
    pub closed_holes: usize,
}

impl RawMesh {
    /// The mesh with as much done as is needed, or as can be done, to close its surface.
    pub fn repaired(self) -> (Self, Repairs) {
        let mut repairs = Repairs::default();
        let before = (self.points.len(), self.faces.len());
        let mut mesh = weld::welded(self, 0.0);
        let finite: Vec<bool> = mesh.points.iter().map(|p| p.is_finite()).collect();
        mesh.faces.retain(|face| face.iter().all(|&i| finite.get(i as usize).copied().unwrap_or(false)));
        let size = Bounds::around(mesh.points.iter().copied().filter(|p| p.is_finite())).diagonal();
        let tolerance = if size.is_finite() { JOIN * size } else { 0.0 };

        join_at_boundary(&mut mesh, tolerance);
        drop_repeats(&mut mesh);
        repairs.joined_points = before.0.saturating_sub(used_points(&mesh));
        repairs.dropped_faces = before.1 - mesh.faces.len();
        repairs.split_edges = split_edges(&mut mesh, tolerance);
        repairs.closed_holes = close_holes(&mut mesh);
        (mesh, repairs)
    }
}

/// The edges that bound an odd number of faces, each once, as a face walks it; in the order of their points.
fn open_edges(mesh: &RawMesh) -> Vec<(u32, u32)> {
    let walked = |face: &[u32]| (0..face.len()).map(|i| (face[i], face[(i + 1) % face.len()])).collect::<Vec<_>>();
    let mut edges: Vec<(u32, u32, bool)> =
        mesh.faces.iter().flat_map(|face| walked(face)).map(|(a, b)| (a.min(b), a.max(b), a < b)).collect();
    edges.sort_unstable();
    let odd = edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)).filter(|uses| uses.len() % 2 == 1);
    // The middle one of the uses goes in the prevailing direction.
    odd.map(|uses| uses[uses.len() / 2]).map(|(a, b, forward)| if forward { (a, b) } else { (b, a) }).collect()
}

fn used_points(mesh: &RawMesh) -> usize {
    let mut used: Vec<u32> = mesh.faces.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    used.len()
}

/// Joins points of the boundary that are no farther apart than `tolerance`.
fn join_at_boundary(mesh: &mut RawMesh, tolerance: f64) {
    let mut at_boundary: Vec<u32> = open_edges(mesh).into_iter().flat_map(|(a, b)| [a, b]).collect();
    at_boundary.sort_unstable();
    at_boundary.dedup();
    let points = at_boundary.iter().map(|&i| mesh.points[i as usize]).collect();
    // Faces of one point each tell where the point went.
    let faces = (0..at_boundary.len() as u32).map(|i| vec![i]).collect();
    let joined = weld::welded(RawMesh { points, faces }, tolerance);
    // The first point of the boundary that became each joined one.
    let mut first: Vec<Option<u32>> = vec![None; joined.points.len()];
    let mut renumbered: Vec<u32> = (0..mesh.points.len() as u32).collect();
    for (&point, became) in at_boundary.iter().zip(&joined.faces) {
        renumbered[point as usize] = *first[became[0] as usize].get_or_insert(point);
    }
    for face in &mut mesh.faces {
        face.iter_mut().for_each(|i| *i = renumbered[*i as usize]);
        face.dedup();
        while face.len() > 1 && face.first() == face.last() {
            face.pop();
        }
    }
    mesh.faces.retain(|face| face.len() >= 3);
}

/// Of faces with the same corners one stays, or none where as many look one way as the other.
fn drop_repeats(mesh: &mut RawMesh) {
    let key = |face: &[u32]| {
        let mut key = face.to_vec();
        key.sort_unstable();
        key
    };
    // Which way round: from the smallest corner to the smaller one of its neighbours, or away from it.
    let forward = |face: &[u32]| {
        let (low, _) = face.iter().enumerate().min_by_key(|&(_, &i)| i).unwrap_or((0, &0));
        face[(low + 1) % face.len()] < face[(low + face.len() - 1) % face.len()]
    };
    let mut net: FxHashMap<Vec<u32>, i64> = FxHashMap::default();
    for face in &mesh.faces {
        *net.entry(key(face)).or_default() += if forward(face) { 1 } else { -1 };
    }
    // The first that looks the prevailing way stays; it settles the count.
    mesh.faces.retain(|face| {
        let count = net.entry(key(face)).or_default();
        let stays = if forward(face) { *count > 0 } else { *count < 0 };
        if stays {
            *count = 0;
        }
        stays
    });
}

/// Puts corners of the boundary into open edges on which they lie, within `tolerance`. Returns how many.
fn split_edges(mesh: &mut RawMesh, tolerance: f64) -> usize {
    let edges = open_edges(mesh);
    let mut corners: Vec<u32> = edges.iter().flat_map(|&(a, b)| [a, b]).collect();
    corners.sort_unstable();
    corners.dedup();
    let along = |axis: usize| {
        let mut sorted: Vec<(f64, u32)> = corners.iter().map(|&i| (mesh.points[i as usize][axis], i)).collect();
        sorted.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        sorted
    };
    let sorted = [0, 1, 2].map(along);
    let mut inserted: FxHashMap<(u32, u32), Vec<u32>> = FxHashMap::default();
    for (from, to) in edges {
        let (a, b) = (mesh.points[from as usize], mesh.points[to as usize]);
        let (low, high) = (a.min(b) - Vec3::splat(tolerance), a.max(b) + Vec3::splat(tolerance));
        // Of the three slabs around the edge the one with the fewest corners.
        let slab = |axis: usize| {
            let start = sorted[axis].partition_point(|c| c.0 < low[axis]);
            let end = sorted[axis].partition_point(|c| c.0 <= high[axis]);
            &sorted[axis][start..end.max(start)]
        };
        let slab = [0, 1, 2].map(slab).into_iter().min_by_key(|slab| slab.len()).unwrap_or_default();
        let (way, length) = (b - a, (b - a).length());
        let place = |&(_, i): &(f64, u32)| {
            let offset = mesh.points[i as usize] - a;
            let along = offset.dot(way) / length;
            let inside = tolerance < along && along < length - tolerance;
            (inside && (offset - way * (along / length)).length() <= tolerance).then_some((along, i))
        };
        let mut on_edge: Vec<(f64, u32)> = slab.iter().filter_map(place).collect();
        on_edge.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        if !on_edge.is_empty() {
            inserted.insert((from, to), on_edge.into_iter().map(|(_, i)| i).collect());
        }
    }
    for face in &mut mesh.faces {
        let count = face.len();
        let sides = (0..count).map(|i| (face[i], face[(i + 1) % count]));
        if sides.clone().any(|side| inserted.contains_key(&side)) {
            *face = sides
                .flat_map(|side| std::iter::once(side.0).chain(inserted.get(&side).into_iter().flatten().copied()))
                .collect();
        }
    }
    inserted.values().map(Vec::len).sum()
}

/// Gives every loop of the boundary a face. Returns how many.
///
/// As many open edges end at each point as an even number has, so walks along them come back.
fn close_holes(mesh: &mut RawMesh) -> usize {
    let edges = open_edges(mesh);
    // Against the direction of the faces, where they agree.
    let mut ways: FxHashMap<u32, Vec<(u32, usize)>> = FxHashMap::default();
    for (number, &(a, b)) in edges.iter().enumerate() {
        ways.entry(b).or_default().push((a, number));
    }
    for (number, &(a, b)) in edges.iter().enumerate() {
        // Taken only when there is no other: these come first, and the last ones are popped.
        ways.entry(a).or_default().insert(0, (b, number));
    }
    let mut used = vec![false; edges.len()];
    let mut step = |from: u32, used: &mut Vec<bool>| loop {
        let (to, number) = ways.get_mut(&from)?.pop()?;
        if !std::mem::replace(&mut used[number], true) {
            return Some(to);
        }
    };
    let mut holes = 0;
    for start in edges.iter().map(|edge| edge.1) {
        let mut walk = vec![start];
        // Where each point is in the walk.
        let mut places: FxHashMap<u32, usize> = FxHashMap::from_iter([(start, 0)]);
        while let Some(&at) = walk.last() {
            let Some(next) = step(at, &mut used) else { break };
            match places.get(&next).copied() {
                None => {
                    places.insert(next, walk.len());
                    walk.push(next);
                }
                // A loop is closed; the walk goes on from where it began.
                Some(place) => {
                    let corners = walk.split_off(place + 1);
                    corners.iter().for_each(|corner| _ = places.remove(corner));
                    mesh.faces.push(std::iter::once(next).chain(corners).collect());
                    holes += 1;
                }
            }
        }
    }
    holes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit cube, its top and bottom missing one or both.
    fn cube() -> RawMesh {
        let points = (0..8).map(|i| Vec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2))).collect();
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        RawMesh { points, faces: faces.map(Vec::from).to_vec() }
    }

    fn check(mesh: RawMesh, volume: f64, expected: Repairs) {
        let (repaired, repairs) = mesh.repaired();
        assert_eq!(repairs, expected);
        let actual = repaired.into_polyhedron().unwrap().volume();
        assert!((actual - volume).abs() < 1e-4, "{actual}");
    }

    #[test]
    fn what_is_closed_stays_as_it_is() {
        check(cube(), 1.0, Repairs::default());
    }

    #[test]
    fn holes_get_a_face_each() {
        let mut mesh = cube();
        mesh.faces.drain(..2);
        check(mesh, 1.0, Repairs { closed_holes: 2, ..Repairs::default() });
        let mut mesh = cube();
        mesh.faces.remove(0);
        mesh.faces[1].reverse();
        check(mesh, 1.0, Repairs { closed_holes: 1, ..Repairs::default() });
    }

    #[test]
    fn holes_that_meet_in_a_corner_are_two() {
        let mut mesh = cube();
        // Triangles are missing in the top and in the side y = 0; they share the corner 4.
        mesh.faces[1] = vec![4, 5, 7];
        mesh.faces[2] = vec![0, 1, 5];
        check(mesh, 1.0, Repairs { closed_holes: 2, ..Repairs::default() });
    }

    #[test]
    fn what_is_there_twice_goes() {
        let mut mesh = cube();
        mesh.faces.push(vec![1, 3, 7, 5]);
        check(mesh, 1.0, Repairs { dropped_faces: 1, ..Repairs::default() });
        let mut mesh = cube();
        mesh.faces.extend([vec![0, 1, 3], vec![3, 1, 0], vec![2, 2, 3], vec![7, 8, 9]]);
        check(mesh, 1.0, Repairs { dropped_faces: 4, ..Repairs::default() });
    }

    #[test]
    fn cracks_are_joined() {
        let mut mesh = cube();
        mesh.points.push(Vec3::new(1.0 + 1e-6, 1.0, 1.0));
        mesh.faces[1] = vec![4, 5, 8, 6];
        check(mesh, 1.0, Repairs { joined_points: 1, ..Repairs::default() });
    }

    #[test]
    fn corners_in_the_middle_of_an_edge_are_put_in() {
        let mut mesh = cube();
        mesh.points.push(Vec3::new(0.5, 0.0, 1.0));
        mesh.faces[1] = vec![4, 8, 5, 7, 6];
        check(mesh, 1.0, Repairs { split_edges: 1, ..Repairs::default() });
    }
}
