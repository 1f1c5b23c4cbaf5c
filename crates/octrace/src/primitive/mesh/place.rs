//! Putting a mesh in order: which surfaces faces have that have none of their own, and what is near what in memory.

use super::{MeshTriangle, SurfaceRef};
use crate::geom::Vec3;

/// The triangles in that order, and the points in the order in which they come to them.
pub(super) fn arranged(
    order: &[u32],
    points: &[Vec3],
    corners_of: impl Fn(usize) -> [u32; 3],
) -> (Vec<MeshTriangle>, Vec<Vec3>) {
    const NONE: u32 = u32::MAX;
    let mut renumbered = vec![NONE; points.len()];
    let mut arranged = Vec::with_capacity(points.len());
    let triangles = order.iter().map(|&number| {
        let corners = corners_of(number as usize).map(|corner| {
            let new = &mut renumbered[corner as usize];
            if *new == NONE {
                *new = arranged.len() as u32;
                arranged.push(points[corner as usize]);
            }
            *new
        });
        MeshTriangle { corners, number }
    });
    let triangles = triangles.collect();
    (triangles, arranged)
}

/// Gives faces without a surface of their own the surface of a neighbour, or else of the first face that has one.
pub(super) fn adopt(mut surfaces: Vec<Option<SurfaceRef>>, faces: &[Vec<u32>]) -> Option<Vec<SurfaceRef>> {
    let fallback = surfaces.iter().flatten().next().copied()?;
    if surfaces.iter().all(Option::is_some) {
        return surfaces.into_iter().collect();
    }
    // The last face at each edge, by the edge's direction: the neighbour walks it the other way.
    let edges = |face: &[u32]| (0..face.len()).map(|i| (face[i], face[(i + 1) % face.len()])).collect::<Vec<_>>();
    let mut at_edge = std::collections::HashMap::new();
    for (number, face) in faces.iter().enumerate() {
        at_edge.extend(edges(face).into_iter().map(|edge| (edge, number)));
    }
    // Degenerate faces may border on each other, so what has been adopted is passed on.
    let mut orphans: Vec<usize> = (0..faces.len()).filter(|&i| surfaces[i].is_none()).collect();
    loop {
        let before = orphans.len();
        orphans.retain(|&orphan| {
            let neighbours = edges(&faces[orphan]).into_iter().filter_map(|(a, b)| at_edge.get(&(b, a)));
            surfaces[orphan] = neighbours.filter_map(|&n| surfaces[n]).next();
            surfaces[orphan].is_none()
        });
        if orphans.is_empty() || orphans.len() == before {
            return Some(surfaces.into_iter().map(|s| s.unwrap_or(fallback)).collect());
        }
    }
}
