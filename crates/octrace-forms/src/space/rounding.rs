//! Outlines between two heights, moved out by a ball: exactly.
//!
//! A point outside is nearest to a wall, to one of the flat ends, to an edge of the ends or to a corner there. So the sum is
//! the union of the grown outline at the old heights, of the outline between heights moved apart, of tubes around the
//! edges, cylinders and parts of rings, and of balls at the corners.

use super::SpaceError;
use super::frusta::{across, frustum};
use super::slab::{Slab, prism};
use super::swept::{Walk, walk};
use crate::plane::Offset;
use octrace::{Affine, Curve, Primitive, Solid, Vec2, Vec3};
use std::f64::consts::{PI, TAU};

/// Edges that meet at a smaller angle (sine) meet smoothly: files have six digits.
const SMOOTH: f64 = 1e-5;

impl Slab {
    /// The sum with a ball about the origin.
    ///
    /// # Errors
    /// If the outline has too many edges.
    pub fn rounded(&self, radius: f64) -> Result<Solid, SpaceError> {
        let grown = self.outline.offset(Offset::Round { r: radius, facets: None })?;
        let mut parts =
            vec![prism(grown, self.low, self.high), prism(self.outline.clone(), self.low - radius, self.high + radius)];
        for contour in &self.outline.contours {
            let edges: Vec<Walk> = walk(contour).collect();
            for (before, edge) in edges.iter().cycle().skip(edges.len() - 1).zip(&edges) {
                let smooth = before.tangent_at_end().cross(edge.tangent_at_start()).abs() <= SMOOTH
                    && before.tangent_at_end().dot(edge.tangent_at_start()) > 0.0;
                for height in [self.low, self.high] {
                    parts.push(tube(edge, height, radius));
                    if !smooth {
                        let corner = Vec3::new(edge.from.x, edge.from.y, height);
                        parts.push(Solid::sphere().scale(Vec3::splat(radius)).translate(corner));
                    }
                }
            }
        }
        Ok(Solid::union(parts))
    }
}

/// All points nearest to an edge at this height that are within the radius of it.
fn tube(edge: &Walk, height: f64, radius: f64) -> Solid {
    let at = |p: Vec2| Vec3::new(p.x, p.y, height);
    let Curve::Arc { center, radius: distance, .. } = edge.curve else {
        return frustum((at(edge.from), radius), (at(edge.to), radius));
    };
    let Some((_, ahead)) = edge.sweep() else { return Solid::empty() };
    let torus = Primitive::Torus { minor: radius / distance };
    let ring = Solid::primitive(torus).scale(Vec3::splat(distance)).translate(at(center));
    if ahead.abs() >= TAU {
        return ring;
    }
    let (start, end) = if ahead > 0.0 { (edge.from, edge.to) } else { (edge.to, edge.from) };
    let left_of = |p: Vec2, sign: f64| {
        let side = p - center;
        half_space(at(center), Vec3::new(-side.y, side.x, 0.0) * sign)
    };
    let [after, before] = [left_of(start, 1.0), left_of(end, -1.0)];
    ring & if ahead.abs() <= PI { after & before } else { after + before }
}

/// What is on the side of a point to which a direction points.
fn half_space(point: Vec3, inward: Vec3) -> Solid {
    let Some(w) = inward.normalized() else { return Solid::empty() };
    let [u, v] = across(w);
    let row = |axis: usize| Vec3::new(u[axis], v[axis], w[axis]);
    Solid::half_space().transform(Affine { rows: [row(0), row(1), row(2)], translation: point })
}
