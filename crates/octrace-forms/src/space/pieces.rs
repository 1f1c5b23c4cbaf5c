//! Convex pieces of solids with flat faces.
//!
//! A convex piece without another one is cut along the faces of the other: what is outside of the first face, what is
//! inside of the first and outside of the second, and so on. What the pieces have in common is their surface.

use super::convex::convex;
use super::fold::fold;
use super::swept;
use octrace::{Affine, BoolOp, Bounds, Polyhedron, Primitive, Solid, Vec3};

/// So many pieces at most: what has more is better treated as a mesh.
const MOST: usize = 200;

/// Distances smaller than this, as a share of the size, are zero.
const NOISE: f64 = 1e-9;

/// The convex polyhedra that make up the solid; `None` where something round is in it, a polyhedron that is not convex or a
/// half-space, and where pieces would be too many.
pub(super) fn pieces(solid: &Solid) -> Option<Vec<Polyhedron>> {
    fold(solid, piece, |op, operands: Vec<Option<Vec<Polyhedron>>>| {
        let mut operands = operands.into_iter();
        let Some(first) = operands.next() else { return Some(Vec::new()) };
        operands.try_fold(first?, |a, b| {
            let b = b?;
            let pieces = match op {
                BoolOp::Union => a.into_iter().chain(b).collect(),
                BoolOp::Intersection => a.iter().flat_map(|a| b.iter().filter_map(|b| common(a, b))).collect(),
                BoolOp::Difference => b.iter().try_fold(a, |rest, b| {
                    let rest: Vec<Polyhedron> = rest.into_iter().flat_map(|a| without(a, b)).collect();
                    (rest.len() <= MOST).then_some(rest)
                })?,
            };
            (pieces.len() <= MOST).then_some(pieces)
        })
    })
}

fn piece(primitive: &Primitive, map: &Affine) -> Option<Vec<Polyhedron>> {
    let points: Vec<Vec3> = match primitive {
        Primitive::Block => {
            let bit = |i: u32, b: u32| f64::from(i >> b & 1);
            (0..8).map(|i| map.point(Vec3::new(bit(i, 0), bit(i, 1), bit(i, 2)))).collect()
        }
        Primitive::Polyhedron(p) if is_convex(p) => p.points().iter().map(|&p| map.point(p)).collect(),
        Primitive::Prism { profile, top } => {
            let parts = swept::straight_parts(profile.contours(), *top)?;
            let parts = parts.iter().map(|part| part.iter().map(|&p| map.point(p)).collect::<Vec<Vec3>>());
            let pieces: Vec<Polyhedron> = parts.filter_map(|points| convex(&points)).collect();
            return (pieces.len() <= MOST).then_some(pieces);
        }
        _ => return None,
    };
    Some(convex(&points).into_iter().collect())
}

/// Whether the polyhedron is convex up to six digits.
pub(super) fn is_convex(polyhedron: &Polyhedron) -> bool {
    polyhedron.is_convex(1e-6 * Bounds::around(polyhedron.points().iter().copied()).diagonal())
}

/// Whether the primitive is convex.
pub(super) fn is_convex_primitive(primitive: &Primitive) -> bool {
    match primitive {
        Primitive::Polyhedron(polyhedron) => is_convex(polyhedron),
        Primitive::Torus { .. } => false,
        Primitive::Prism { profile, .. } => swept::is_convex(profile.contours()),
        Primitive::Revolution(profile) => swept::is_convex_revolution(profile.contours()),
        Primitive::Block | Primitive::Sphere | Primitive::Cylinder | Primitive::Cone { .. } | Primitive::HalfSpace => {
            true
        }
    }
}

/// A plane by its outward normal and a point.
type Face = octrace::primitive::FacePlane;

fn faces(polyhedron: &Polyhedron) -> impl Iterator<Item = Face> + '_ {
    (0..polyhedron.faces().len()).filter_map(|face| polyhedron.face_plane(face))
}

/// What two convex polyhedra have in common.
fn common(a: &Polyhedron, b: &Polyhedron) -> Option<Polyhedron> {
    faces(b).try_fold(a.clone(), |rest, face| behind(&rest, &face))
}

/// Convex pieces of `a` without `b`.
fn without(a: Polyhedron, b: &Polyhedron) -> Vec<Polyhedron> {
    if common(&a, b).is_none() {
        return vec![a];
    }
    let mut pieces = Vec::new();
    let mut rest = a;
    for face in faces(b) {
        let turned = Face { normal: -face.normal, ..face };
        pieces.extend(behind(&rest, &turned));
        match behind(&rest, &face) {
            Some(inside) => rest = inside,
            None => break,
        }
    }
    pieces
}

/// The part of a convex polyhedron that is on the inner side of a plane.
fn behind(polyhedron: &Polyhedron, face: &Face) -> Option<Polyhedron> {
    let points = polyhedron.points();
    let noise = NOISE * Bounds::around(points.iter().copied()).diagonal();
    let height = |i: u32| match face.distance(points[i as usize]) {
        h if h.abs() <= noise => 0.0,
        h => h,
    };
    let heights: Vec<f64> = (0..points.len() as u32).map(height).collect();
    if heights.iter().all(|&h| h <= 0.0) {
        return Some(polyhedron.clone());
    }
    let mut kept: Vec<Vec3> = points.iter().zip(&heights).filter(|(_, h)| **h <= 0.0).map(|(&p, _)| p).collect();
    for corners in polyhedron.faces() {
        for (&i, &j) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let (a, b) = (heights[i as usize], heights[j as usize]);
            // Each edge once, from the inner side on.
            if a < 0.0 && b > 0.0 {
                let (p, q) = (points[i as usize], points[j as usize]);
                kept.push(p + (q - p) * (a / (a - b)));
            }
        }
    }
    convex(&kept)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(x: f64, y: f64, z: f64) -> Solid {
        Solid::block().scale([x, y, z])
    }

    fn check(solid: &Solid, expected: Option<(usize, f64)>) {
        let found = pieces(solid).map(|p| (p.len(), p.iter().map(Polyhedron::volume).sum::<f64>()));
        assert_eq!(found, expected, "{solid:?}");
    }

    #[test]
    fn frames_come_in_four_pieces() {
        check(&(block(10.0, 8.0, 3.0) - block(6.0, 4.0, 5.0).translate([2.0, 2.0, -1.0])), Some((4, 168.0)));
    }

    #[test]
    fn what_is_beside_takes_nothing_away() {
        check(&(block(1.0, 1.0, 1.0) - block(1.0, 1.0, 1.0).translate([1.0, 0.0, 0.0])), Some((1, 1.0)));
        check(&(block(1.0, 1.0, 1.0) - block(3.0, 3.0, 3.0).translate([-1.0; 3])), Some((0, 0.0)));
    }

    #[test]
    fn common_parts_are_convex() {
        check(&(block(4.0, 4.0, 4.0) & block(4.0, 4.0, 4.0).translate([1.0; 3])), Some((1, 27.0)));
        check(&Solid::empty(), Some((0, 0.0)));
    }

    #[test]
    fn round_things_have_no_pieces() {
        check(&(block(1.0, 1.0, 1.0) - Solid::sphere()), None);
    }
}
