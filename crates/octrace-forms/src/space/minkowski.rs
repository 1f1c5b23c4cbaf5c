//! Minkowski sums of solids: all sums of a point of each.
//!
//! Sums go through unions. So operands are taken apart into convex pieces: the leaves of unions, and what [`pieces`] finds
//! in differences and intersections of flat-faced solids. The sum of two convex pieces is the hull of the sums of their
//! corners, circles and balls, exactly for
//! - corners and whatever has an exact hull: a block and a ball make a rounded block, a block and an upright cylinder a
//!   plate with rounded edges;
//! - circles in parallel planes, balls and balls, a circle or a ring and a ball.
//!
//! Prisms, blocks and cylinders of one direction, also with holes and pockets along it, have the sum of their outlines: exact with
//! a cylinder of that direction, with a ball, or where outlines are polygons.
//!
//! Bodies of revolution about parallel axes have the sum of their sections: exact with a ball, or where all is straight.
//!
//! Other convex pieces are replaced by polyhedra within the tolerance. What has no convex pieces becomes a mesh, with
//! fewer corners on round things the larger it is; a sum of two such solids must be small.

use super::SpaceError;
use super::convex::convex;
use super::hull::hull_of;
use super::leaves::{Leaf, leaves};
use super::mesh::{TriangleMesh, manifold, union};
use super::pieces::{is_convex_primitive, pieces};
use super::round::{Extremes, Fit};
use super::slab_sum::sum_of_slabs;
use super::turned_sum::sum_of_turned;
use crate::Tolerance;
use manifold_rust::manifold::Manifold;
use octrace::{Polyhedron, Solid};

/// So many pairs of pieces have their sums made at most; with more, operands become meshes.
const MOST_PAIRS: usize = 2_000;
/// So many corners have the pieces that a mesh is swept by at most, all triangles together.
const MOST_SWEPT: usize = 400_000;
/// The fewest corners with which something round is still taken for round.
const COARSEST: usize = 150;

/// An operand, or the sum of some.
struct Operand {
    /// Convex pieces.
    pieces: Vec<Extremes>,
    /// Solids that have no convex pieces.
    others: Vec<Manifold>,
}

/// The Minkowski sum of the solids. Empty ones do not count; of none it is empty. Parts are forgotten.
///
/// # Errors
/// If an operand is unbounded, has no boundary that can be found, or if the sum is too large: see [`SpaceError`].
pub fn minkowski(solids: &[Solid], tolerance: Tolerance) -> Result<Solid, SpaceError> {
    if let Some(sum) = sum_of_turned(solids, tolerance)? {
        return Ok(sum);
    }
    if let Some(sum) = sum_of_slabs(solids, tolerance)? {
        return Ok(sum);
    }
    let mut sum: Option<Operand> = None;
    for solid in solids {
        let operand = Operand::new(solid, tolerance)?;
        if !operand.is_empty() {
            sum = Some(match sum {
                None => operand,
                Some(sum) => sum.plus(operand, tolerance)?,
            });
        }
    }
    let Some(sum) = sum else { return Ok(Solid::empty()) };
    let mut parts: Vec<Solid> = sum.pieces.into_iter().map(|piece| hull_of(piece, tolerance)).collect();
    for other in &sum.others {
        parts.extend(TriangleMesh::of(other)?.polyhedron().map(Solid::primitive));
    }
    Ok(Solid::union(parts))
}

impl Operand {
    fn new(solid: &Solid, tolerance: Tolerance) -> Result<Self, SpaceError> {
        let mut operand = Self { pieces: Vec::new(), others: Vec::new() };
        for (map, leaf) in leaves(std::slice::from_ref(solid)) {
            match leaf {
                Leaf::Primitive(primitive) if is_convex_primitive(primitive) => {
                    let mut piece = Extremes::default();
                    piece.add(primitive, &map, tolerance)?;
                    operand.pieces.push(piece);
                }
                leaf => {
                    let placed = leaf.placed(&map);
                    match pieces(&placed) {
                        Some(pieces) => operand.pieces.extend(pieces.iter().map(corners)),
                        None => operand.others.push(manifold(&placed, tolerance)?),
                    }
                }
            }
        }
        operand.others.retain(|other| !other.is_empty());
        Ok(operand)
    }

    fn is_empty(&self) -> bool {
        self.pieces.is_empty() && self.others.is_empty()
    }

    fn plus(self, other: Self, tolerance: Tolerance) -> Result<Self, SpaceError> {
        if self.pieces.len().saturating_mul(other.pieces.len()) > MOST_PAIRS {
            return Err(SpaceError::TooMuch);
        }
        let mut sum = Self { pieces: Vec::new(), others: Vec::new() };
        for a in &self.pieces {
            for b in &other.pieces {
                sum.pieces.push(a.plus(b, tolerance));
            }
        }
        for (meshes, pieces) in [(&self.others, &other.pieces), (&other.others, &self.pieces)] {
            for mesh in meshes {
                for piece in pieces {
                    sum.others.push(swept(mesh, piece, tolerance)?);
                }
            }
        }
        for a in &self.others {
            for b in &other.others {
                if a.num_tri().saturating_mul(b.num_tri()) > MOST_SWEPT / 100 {
                    return Err(SpaceError::TooMuch);
                }
                sum.others.push(a.minkowski_sum(b));
            }
        }
        if sum.others.len() > 1 {
            sum.others = vec![union(sum.others)];
        }
        Ok(sum)
    }
}

fn corners(polyhedron: &Polyhedron) -> Extremes {
    Extremes { points: polyhedron.points().to_vec(), rounds: Vec::new() }
}

/// The sum of a mesh and a convex piece.
fn swept(mesh: &Manifold, piece: &Extremes, tolerance: Tolerance) -> Result<Manifold, SpaceError> {
    let allowed = (MOST_SWEPT / mesh.num_tri().max(1)).max(COARSEST);
    let mut deviation = tolerance.relative * piece.size();
    let mut points = piece.sampled(deviation, Fit::Even);
    while points.len() > allowed && deviation < piece.size() {
        deviation *= 2.0;
        points = piece.sampled(deviation, Fit::Even);
    }
    if points.len().saturating_mul(mesh.num_tri()) > 8 * MOST_SWEPT {
        return Err(SpaceError::TooMuch);
    }
    let Some(tool) = convex(&points) else { return Ok(Manifold::empty()) };
    let triangles = tool.triangles().iter().map(|t| t.corners).collect();
    let tool = TriangleMesh { points: tool.points().to_vec(), triangles }.manifold();
    let dilated = mesh.try_dilate_by_convex(&tool, None, None);
    Ok(dilated.unwrap_or_else(|| mesh.minkowski_sum(&tool)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::Vec3;
    use octrace::exec::Exec;
    use octrace::query::{MeasureOptions, measure};
    use octrace::{Tracer, TracerOptions};
    use std::f64::consts::PI;

    fn block(x: f64, y: f64, z: f64) -> Solid {
        Solid::block().scale([x, y, z])
    }

    fn frame() -> Solid {
        block(10.0, 8.0, 3.0) - block(6.0, 4.0, 5.0).translate([2.0, 2.0, -1.0])
    }

    fn volume(solids: &[Solid]) -> (f64, f64) {
        let sum = minkowski(solids, Tolerance::default()).unwrap();
        let exec = Exec::with_threads(1);
        let tracer = Tracer::build(&sum, &TracerOptions::default(), &exec).unwrap();
        let options = MeasureOptions { tolerance: 1e-4, max_rays: 1_000_000 };
        let measures = measure(&tracer, &options, &exec).unwrap();
        (measures.volume, measures.volume_error)
    }

    fn check(solids: &[Solid], expected: f64) {
        let (volume, error) = volume(solids);
        assert!((volume - expected).abs() <= error + 1e-7 * expected, "{volume} is not {expected}");
    }

    #[test]
    fn boxes_add_up() {
        check(&[block(2.0, 2.0, 2.0), block(3.0, 3.0, 3.0), Solid::empty(), block(1.0, 1.0, 1.0)], 216.0);
        assert!(matches!(minkowski(&[], Tolerance::default()).unwrap().node(), octrace::model::Node::Empty));
    }

    #[test]
    fn a_block_and_a_ball_make_a_rounded_block() {
        let (a, b, c, r) = (4.0, 3.0, 2.0, 0.5);
        let steiner =
            a * b * c + 2.0 * r * (a * b + b * c + c * a) + PI * r * r * (a + b + c) + 4.0 / 3.0 * PI * r * r * r;
        let solids = [block(a, b, c), Solid::sphere().scale([r; 3])];
        check(&solids, steiner);
        let sum = minkowski(&solids, Tolerance::default()).unwrap();
        assert_eq!(leaves(&[sum]).len(), 8 + 12 + 1);
    }

    #[test]
    fn a_block_and_a_cylinder_make_a_plate() {
        let solids = [block(4.0, 3.0, 2.0), Solid::cylinder()];
        check(&solids, 3.0 * (12.0 + 14.0 + PI));
        assert_eq!(leaves(&[minkowski(&solids, Tolerance::default()).unwrap()]).len(), 5);
    }

    #[test]
    fn a_cylinder_and_a_ball_make_a_rounded_cylinder() {
        // Radius 2, height 3, rounded by 1/2: its faces moved out, and half a ring at each end.
        let solids = [Solid::cylinder().scale([2.0, 2.0, 3.0]), Solid::sphere().scale([0.5; 3])];
        let quarter_ring = 2.0 * PI * (2.0 + 4.0 * 0.5 / (3.0 * PI)) * PI * 0.25 / 4.0;
        check(&solids, PI * 6.25 * 3.0 + 2.0 * (PI * 4.0 * 0.5 + quarter_ring));
        let reversed = [solids[1].clone(), solids[0].clone()];
        assert_eq!(leaves(&[minkowski(&reversed, Tolerance::default()).unwrap()]).len(), 5);
    }

    /// Volumes of the same in OpenSCAD 2021.01.
    #[test]
    fn flat_frames_have_the_sums_of_openscad() {
        check(&[frame(), block(1.0, 1.0, 1.0)], 336.0);
        let hollow = block(3.0, 3.0, 3.0) - block(1.0, 1.0, 5.0).translate([1.0, 1.0, -1.0]);
        check(&[block(2.0, 2.0, 2.0), hollow.clone()], 125.0);
        check(&[frame(), hollow], 840.0);
        let diamond: Vec<Vec3> = [0.0, 1.0]
            .into_iter()
            .flat_map(|z| [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].map(|[x, y]| Vec3::new(x, y, z)))
            .collect();
        check(&[frame(), Solid::primitive(convex(&diamond).unwrap())], 440.0);
    }

    #[test]
    fn a_frame_and_a_cylinder_are_exact() {
        // The outline grows by 1/2 with rounded corners, the hole shrinks to 5 by 3, the height grows by 1.
        let (found, error) = volume(&[frame(), Solid::cylinder().scale([0.5, 0.5, 1.0])]);
        let expected = 4.0 * (80.0 + 18.0 + PI / 4.0 - 5.0 * 3.0);
        assert!((found - expected).abs() <= error + 1e-7 * expected, "{found} is not {expected}");
    }

    /// The volume of the same in OpenSCAD 2021.01.
    #[test]
    fn prisms_with_dents_have_the_sums_of_openscad() {
        let corners = [[0.0, 0.0], [6.0, 0.0], [6.0, 2.0], [2.0, 2.0], [2.0, 6.0], [0.0, 6.0]];
        let edge = |[x, y]: [f64; 2]| octrace::Edge { from: octrace::Vec2::new(x, y), curve: octrace::Curve::Line };
        let profile = octrace::Profile::new(vec![corners.map(edge).to_vec()]).unwrap();
        let ell = octrace::Primitive::Prism { profile: std::sync::Arc::new(profile), top: 1.0 };
        let solids = [Solid::primitive(ell).scale([1.0, 1.0, 3.0]), block(1.0, 1.0, 1.0)];
        check(&solids, 132.0);
        // Lying, they are no outlines between two heights, but still prisms over triangles.
        check(&solids.map(|s| s.rotate([90.0, 0.0, 0.0])), 132.0);
    }

    #[test]
    fn drilled_plates_and_cylinders_make_prisms() {
        let drilled = block(10.0, 10.0, 2.0) - Solid::cylinder().scale([3.0, 3.0, 4.0]).translate([5.0, 5.0, -1.0]);
        let solids = [drilled, Solid::cylinder()];
        check(&solids, 3.0 * (100.0 + 40.0 + PI - 4.0 * PI));
        assert_eq!(leaves(&[minkowski(&solids, Tolerance::default()).unwrap()]).len(), 1);
    }

    #[test]
    fn what_is_not_convex_is_swept() {
        let drilled = block(10.0, 10.0, 2.0) - Solid::cylinder().scale([3.0, 3.0, 4.0]).translate([5.0, 5.0, -1.0]);
        let lying = [drilled, block(1.0, 1.0, 1.0)].map(|s| s.rotate([90.0, 0.0, 0.0]));
        let (found, _) = volume(&lying);
        // The hole that is left is where all four corners of the square are in the hole.
        let r = 3.0;
        let clear = |x: f64, y: f64| [0.0, 1.0].iter().all(|a| [0.0, 1.0].iter().all(|b| (x - a).hypot(y - b) <= r));
        let steps = 500;
        let at = |i: i32| -2.0 + 5.0 * (f64::from(i) + 0.5) / f64::from(steps);
        let count =
            (0..steps).flat_map(|i| (0..steps).map(move |j| (i, j))).filter(|&(i, j)| clear(at(i), at(j))).count();
        let hole = count as f64 * 25.0 / f64::from(steps * steps);
        let expected = 3.0 * (121.0 - hole);
        assert!((found - expected).abs() < 2e-3 * expected, "{found} is not {expected}");
    }
}
