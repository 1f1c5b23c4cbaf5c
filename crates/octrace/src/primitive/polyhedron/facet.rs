//! Faces one by one: the plane that fits, and triangles that cover.

use super::Triangle;
use super::topology::Face;
use crate::geom::Vec3;
use earcut::Earcut;
use std::collections::HashMap;

/// How far the corners of a face may lie off its plane, relative to the polyhedron's diagonal. Coordinates in files have
/// six digits; with that many, a planar face is planar to about half of this.
pub(super) const PLANARITY: f64 = 1e-5;

/// The plane of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacePlane {
    /// Unit normal, outward.
    pub normal: Vec3,
    /// A point of the plane: the mean of the corners.
    pub point: Vec3,
}

impl FacePlane {
    /// The plane that fits a closed polygon best, after Newell [Sutherland, Sproull, Schumacker 1974]: its normal is the
    /// direction from which the polygon looks largest, counter-clockwise. `None` where the area is zero to rounding.
    ///
    /// A polygon in a plane with a constant coordinate gets that plane exactly.
    pub fn fit(corners: &[Vec3]) -> Option<Self> {
        let (&first, rest) = corners.split_first()?;
        let (mut area, mut magnitude) = (Vec3::ZERO, 0.0_f64);
        for pair in rest.windows(2) {
            let (a, b) = (pair[0] - first, pair[1] - first);
            area += a.cross(b);
            magnitude += a.length() * b.length();
        }
        // Every product above is good to a unit in its last place; 16 of them bound the sum's error with room.
        if area.length() <= 16.0 * f64::EPSILON * magnitude {
            return None;
        }
        let offset = rest.iter().fold(Vec3::ZERO, |sum, &p| sum + (p - first)) / corners.len() as f64;
        Some(Self { normal: area.normalized()?, point: first + offset })
    }

    /// Signed distance of a point, positive outside.
    pub fn distance(&self, p: Vec3) -> f64 {
        self.normal.dot(p - self.point)
    }
}

/// Splits faces that are not planar within `tolerance` into triangles, and covers all faces with triangles.
pub(super) fn triangulate(points: &[Vec3], faces: Vec<Face>, tolerance: f64) -> (Vec<Vec<u32>>, Vec<Triangle>) {
    let mut planar: Vec<Vec<u32>> = Vec::with_capacity(faces.len());
    let mut triangles = Vec::with_capacity(faces.len() * 2);
    let mut cutter = Cutter::default();
    let mut coordinates: Vec<Vec3> = Vec::new();
    for Face { corners, .. } in faces {
        if let [a, b, c] = corners[..] {
            triangles.push(Triangle { corners: [a, b, c], face: planar.len() as u32 });
            planar.push(corners);
            continue;
        }
        coordinates.clear();
        coordinates.extend(corners.iter().map(|&i| points[i as usize]));
        let plane = FacePlane::fit(&coordinates);
        let warped = |p: &FacePlane| coordinates.iter().any(|&q| p.distance(q).abs() > tolerance);
        let pieces = cutter.cut(&corners, &coordinates, plane);
        if plane.filter(warped).is_some() {
            let pieces = across(&corners, &coordinates).map_or(pieces, Vec::from);
            for corners in pieces {
                triangles.push(Triangle { corners, face: planar.len() as u32 });
                planar.push(corners.to_vec());
            }
        } else {
            triangles.extend(pieces.into_iter().map(|corners| Triangle { corners, face: planar.len() as u32 }));
            planar.push(corners);
        }
    }
    (planar, triangles)
}

/// A quadrangle cut as OpenSCAD's tessellator cuts it, seen along an axis: from its dent, or along the diagonal that is
/// Delaunay's; where both are, as a sweep in the direction of the first coordinate cuts. `None` where the face is another.
fn across(corners: &[u32], coordinates: &[Vec3]) -> Option<[[u32; 3]; 2]> {
    let &[a, b, c, d] = corners else { return None };
    let pieces = |from_a: bool| if from_a { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
    let seen = seen_by_sweep(coordinates);
    let &[pa, pb, pc, pd] = seen.as_slice() else { return None };
    let turns = [turn(pd, pa, pb), turn(pa, pb, pc), turn(pb, pc, pd), turn(pc, pd, pa)];
    let mut dents = (0..4).filter(|&i| turns[i] <= 0.0);
    match (dents.next(), dents.next()) {
        (None, _) => {}
        (Some(dent), None) => return Some(pieces(dent % 2 == 0)),
        (Some(_), Some(_)) => return None,
    }
    // The angles at b and at d: with more than half a turn together the diagonal is between them.
    let angle = |at: [f64; 2], from: [f64; 2], to: [f64; 2]| {
        let (u, v) = ([from[0] - at[0], from[1] - at[1]], [to[0] - at[0], to[1] - at[1]]);
        (u[0] * v[0] + u[1] * v[1], u[0] * v[1] - u[1] * v[0])
    };
    let ((cos_b, sin_b), (cos_d, sin_d)) = (angle(pb, pc, pa), angle(pd, pa, pc));
    let sum = sin_b * cos_d + cos_b * sin_d;
    let scale = 1e-9 * (sin_b.abs() + cos_b.abs()) * (sin_d.abs() + cos_d.abs());
    let from_a = if sum.abs() > scale {
        sum > 0.0
    } else {
        let order = |&i: &usize, &j: &usize| seen[i][0].total_cmp(&seen[j][0]).then(seen[i][1].total_cmp(&seen[j][1]));
        let (first, last) = ((0..4).min_by(order)?, (0..4).max_by(order)?);
        // Between the two that come between these, if they are on both sides; else from the last one.
        if (first + last) % 2 == 0 { first % 2 == 1 } else { last % 2 == 0 }
    };
    Some(pieces(from_a))
}

/// Twice the area of a triangle, positive counter-clockwise.
fn turn(p: [f64; 2], q: [f64; 2], r: [f64; 2]) -> f64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

/// The corners as OpenSCAD's tessellator (libtess2) sees them, counter-clockwise: along the axis that is nearest to the normal
/// of the largest triangle on the two corners that are farthest apart along an axis.
fn seen_by_sweep(coordinates: &[Vec3]) -> Vec<[f64; 2]> {
    let end = |axis: usize, sign: f64| {
        let farther = |p: Vec3, q: Vec3| if sign * q[axis] > sign * p[axis] { q } else { p };
        coordinates.iter().copied().reduce(farther).unwrap_or_default()
    };
    let length = |axis: usize| end(axis, 1.0)[axis] - end(axis, -1.0)[axis];
    let longest = (1..3).fold(0, |longest, axis| if length(axis) > length(longest) { axis } else { longest });
    let (low, high) = (end(longest, -1.0), end(longest, 1.0));
    let normals = coordinates.iter().map(|&p| (low - high).cross(p - high));
    let normal = normals.fold(Vec3::ZERO, |best, n| if n.dot(n) > best.dot(best) { n } else { best });
    let axis = normal.largest_axis();
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut seen: Vec<[f64; 2]> = coordinates.iter().map(|p| [p[u], p[v]]).collect();
    let area: f64 = seen.windows(2).map(|pair| turn(seen[0], pair[0], pair[1])).sum();
    if area < 0.0 {
        seen.iter_mut().for_each(|p| p[1] = 0.0 - p[1]);
    }
    seen
}

/// Cuts polygons into triangles; keeps its memory from one polygon to the next.
struct Cutter {
    earcut: Earcut<f64>,
    cut: Vec<u32>,
}

impl Default for Cutter {
    fn default() -> Self {
        Self { earcut: Earcut::new(), cut: Vec::new() }
    }
}

impl Cutter {
    /// Triangles that cover the polygon, turned as it is; together they have *exactly* its edges, as chains.
    fn cut(&mut self, corners: &[u32], coordinates: &[Vec3], plane: Option<FacePlane>) -> Vec<[u32; 3]> {
        let mut pieces = Vec::with_capacity(corners.len() - 2);
        if let Some(plane) = plane {
            let flat = flatten(coordinates, plane.normal);
            self.earcut.earcut(flat.iter().copied(), &[] as &[u32], &mut self.cut);
            let doubled_area = |t: &[u32]| turn(flat[t[0] as usize], flat[t[1] as usize], flat[t[2] as usize]);
            let clockwise = self.cut.chunks_exact(3).map(doubled_area).sum::<f64>() < 0.0;
            for t in self.cut.chunks_exact(3) {
                let [a, b, c] = [0, 1, 2].map(|i| corners[t[i] as usize]);
                pieces.push(if clockwise { [c, b, a] } else { [a, b, c] });
            }
        }
        close(corners, &mut pieces);
        pieces
    }
}

/// The polygon seen against its normal, counter-clockwise: the coordinate along the normal's largest part is dropped.
fn flatten(coordinates: &[Vec3], normal: Vec3) -> Vec<[f64; 2]> {
    let axis = normal.largest_axis();
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let first = coordinates[0];
    let pair = |p: Vec3| if normal[axis] > 0.0 { [p[u], p[v]] } else { [p[v], p[u]] };
    coordinates.iter().map(|&p| pair(p - first)).collect()
}

/// Adds degenerate triangles until the pieces have exactly the polygon's edges. Ear clipping leaves out corners in the
/// middle of straight sides, and gives up on polygons that cross themselves; what is missing is a set of closed walks.
fn close(corners: &[u32], pieces: &mut Vec<[u32; 3]>) {
    let mut edges: Vec<(u32, u32, i32)> = Vec::with_capacity(corners.len() + 3 * pieces.len());
    let mut push = |a: u32, b: u32, sign: i32| edges.push(if a < b { (a, b, sign) } else { (b, a, -sign) });
    for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        push(a, b, 1);
    }
    for &[a, b, c] in pieces.iter() {
        push(a, b, -1);
        push(b, c, -1);
        push(c, a, -1);
    }
    edges.sort_unstable();
    let mut missing: Vec<(u32, u32)> = Vec::new();
    for uses in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let net: i32 = uses.iter().map(|u| u.2).sum();
        let (a, b, _) = uses[0];
        let edge = if net > 0 { (a, b) } else { (b, a) };
        missing.extend(std::iter::repeat_n(edge, net.unsigned_abs() as usize));
    }
    let mut next_of: HashMap<u32, Vec<u32>> = HashMap::new();
    for &(from, to) in &missing {
        next_of.entry(from).or_default().push(to);
    }
    let mut step = |from: u32| next_of.get_mut(&from).and_then(Vec::pop);
    // As many missing edges lead into each point as out of it, so every walk comes back to its start.
    for &(start, _) in &missing {
        let Some(mut at) = step(start) else { continue };
        while let Some(next) = step(at) {
            if next == start {
                break;
            }
            pieces.push([start, at, next]);
            at = next;
        }
    }
}
