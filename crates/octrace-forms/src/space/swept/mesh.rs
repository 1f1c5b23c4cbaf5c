//! Meshes of swept solids.

use super::edge::{flattened, right_of_axis};
use crate::space::mesh::TriangleMesh;
use crate::space::round::{fragments, swelling};
use octrace::geom::sin_cos_deg;
use octrace::{Affine, Contour, Polyhedron, Vec2, Vec3};

/// The mesh of a prism: of the region that the contours surround at z = 0, scaled by `top` at z = 1, moved by `map`.
pub(crate) fn prism_mesh(contours: &[Contour], top: f64, map: &Affine, deviation: f64) -> TriangleMesh {
    let scale = map.column(0).length().max(map.column(1).length());
    let polygons = flattened(contours, deviation / scale);
    let (mut points, mut faces): (Vec<Vec3>, Vec<Vec<u32>>) = (Vec::new(), Vec::new());
    for polygon in &polygons {
        let (first, n) = (points.len() as u32, polygon.len() as u32);
        let at = |z: f64, scale: f64| polygon.iter().map(move |p| map.point(Vec3::new(p.x * scale, p.y * scale, z)));
        points.extend(at(0.0, 1.0).chain(at(1.0, top)));
        faces.extend((0..n).map(|i| [i, (i + 1) % n, (i + 1) % n + n, i + n].map(|k| first + k).to_vec()));
    }
    let (corners, cover) = covered(&polygons);
    for [a, b, c] in cover {
        let [a, b, c] = [a, b, c].map(|i| corners[i]);
        faces.push([a.0, c.0, b.0].to_vec());
        if top > 0.0 {
            faces.push([a.1, b.1, c.1].to_vec());
        }
    }
    mesh_of(points, faces)
}

/// For each corner of the polygons its number at the bottom and at the top; and triangles that cover what the polygons
/// surround.
pub(super) fn covered(polygons: &[Vec<Vec2>]) -> (Vec<(u32, u32)>, Vec<[usize; 3]>) {
    let mut numbers = Vec::new();
    let mut first = 0;
    let mut shapes = Vec::new();
    for polygon in polygons {
        let n = polygon.len() as u32;
        let indices = (0..n).map(|i| (first + i, first + i + n));
        shapes.push(polygon.iter().zip(indices.clone()).map(|(p, _)| linalg_vec2(*p)).collect::<Vec<_>>());
        numbers.extend(indices);
        first += 2 * n;
    }
    let cover = manifold_rust::polygon::triangulate(&shapes, -1.0, true);
    let index = |i: i32| usize::try_from(i).unwrap_or_default();
    (numbers, cover.iter().map(|t| [t.x, t.y, t.z].map(index)).collect())
}

fn linalg_vec2(p: Vec2) -> manifold_rust::linalg::Vec2 {
    manifold_rust::linalg::Vec2::new(p.x, p.y)
}

/// The mesh of what the contours sweep about the z axis, x being the distance from it and y the height, moved by `map`.
pub(crate) fn revolution_mesh(contours: &[Contour], map: &Affine, deviation: f64) -> TriangleMesh {
    let scale = [0, 1, 2].map(|axis| map.column(axis).length()).into_iter().fold(0.0, f64::max);
    let polygons: Vec<Vec<Vec2>> =
        flattened(contours, deviation / scale).iter().map(|polygon| right_of_axis(polygon)).collect();
    let widest = polygons.iter().flatten().map(|p| p.x).fold(0.0, f64::max);
    let n = fragments(widest * scale, deviation);
    let swelling = swelling(n);
    let (mut points, mut faces): (Vec<Vec3>, Vec<Vec<u32>>) = (Vec::new(), Vec::new());
    for polygon in &polygons {
        let (first, m) = (points.len() as u32, polygon.len() as u32);
        for i in 0..n {
            let (s, c) = sin_cos_deg(360.0 * f64::from(i) / f64::from(n));
            let turned = |p: &Vec2| map.point(Vec3::new(p.x * swelling * c, p.x * swelling * s, p.y));
            points.extend(polygon.iter().map(turned));
            let at = |i: u32, j: u32| first + i % n * m + j % m;
            for j in (0..m).filter(|&j| polygon[j as usize].x > 0.0 || polygon[(j + 1) as usize % m as usize].x > 0.0) {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                faces.extend([vec![a, b, c], vec![a, c, d]]);
            }
        }
    }
    mesh_of(points, faces)
}

/// The mesh of a polyhedron; nothing where there is none.
fn mesh_of(points: Vec<Vec3>, faces: Vec<Vec<u32>>) -> TriangleMesh {
    let Ok(polyhedron) = Polyhedron::new(points, faces) else { return TriangleMesh::default() };
    TriangleMesh {
        points: polyhedron.points().to_vec(),
        triangles: polyhedron.triangles().iter().map(|t| t.corners).collect(),
    }
}
