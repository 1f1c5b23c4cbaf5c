//! Outlines between two heights, moved out by a ball: exactly.
//!
//! A point outside is nearest to a wall, to one of the flat ends, to an edge of the ends or to a corner there. So the sum is
//! the union of the grown outline at the old heights, of the outline between heights moved apart, of tubes around the
//! edges, cylinders and parts of rings, and of balls at the corners.

use super::SpaceError;
use super::frusta::frustum;
use super::slab::{Slab, prism};
use super::swept::{Walk, walk};
use crate::plane::{Offset, Outline};
use octrace::{Contour, Curve, Edge, Primitive, Solid, Vec2, Vec3};
use std::f64::consts::{FRAC_PI_4, TAU};

/// Rings are cut to a sector that is wider than their tubes by this factor.
const WIDER: f64 = 1.0625;

/// Sectors have corners so close at least (radians).
const STEP: f64 = FRAC_PI_4;

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
    let sector = sector(edge, center, [(distance - WIDER * radius).max(0.0), distance + WIDER * radius]);
    ring & prism(Outline { contours: vec![sector] }, height - WIDER * radius, height + WIDER * radius)
}

/// A polygon that has the arc's directions from its centre, and distances between two at least.
fn sector(arc: &Walk, center: Vec2, [inner, outer]: [f64; 2]) -> Contour {
    let Some((start, ahead)) = arc.sweep() else { return Vec::new() };
    let steps = (ahead.abs() / STEP).ceil().max(1.0);
    let step = ahead / steps;
    let toward = |at: f64| match at {
        // Where the arc meets others, planes have to be the same.
        0.0 => unit(arc.from - center),
        end if end == steps => unit(arc.to - center),
        at => {
            let (sin, cos) = libm::sincos(start + step * at);
            Vec2::new(cos, sin)
        }
    };
    let stops = (0..=steps as u32).map(f64::from);
    let mut corners: Vec<Vec2> = stops.clone().rev().map(|at| center + toward(at) * inner).collect();
    if inner == 0.0 {
        corners.truncate(1);
    }
    corners.push(center + toward(0.0) * outer);
    // The tangents of the outer circle meet halfway.
    let farther = outer / libm::cos(0.5 * step);
    corners.extend(stops.take(steps as usize).map(|at| center + toward(at + 0.5) * farther));
    corners.push(center + toward(steps) * outer);
    corners.into_iter().map(|from| Edge { from, curve: Curve::Line }).collect()
}

fn unit(v: Vec2) -> Vec2 {
    v * (1.0 / v.dot(v).sqrt())
}
