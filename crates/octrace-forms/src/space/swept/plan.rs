//! What the hulls of swept solids depend on.

use super::edge::{Walk, flattened, right_of_axis, size, walk};
use crate::space::round::{Extremes, Round};
use octrace::geom::sin_cos_deg;
use octrace::{Affine, Contour, Curve, Vec2, Vec3};
use std::f64::consts::TAU;

/// Normals at which it is asked whether a whole circle is in a hull.
const PROBES: u32 = 720;

/// Corners and circles with the same convex hull as the contours: circles where whole ones are in the hull.
struct Plan {
    corners: Vec<Vec2>,
    circles: Vec<(Vec2, f64)>,
}

impl Plan {
    /// Arcs of circles that stick out of the hull become corners within `deviation`. Mirrored at the y axis, where that is
    /// how the hull is meant.
    fn new(contours: &[Contour], deviation: f64, mirrored: bool) -> Self {
        let edges: Vec<Walk> = contours.iter().flat_map(walk).collect();
        let corners: Vec<Vec2> =
            edges.iter().filter(|e| e.sweep().is_none_or(|(_, ahead)| ahead.abs() < TAU)).map(|e| e.from).collect();
        let mut plan = Self { corners, circles: Vec::new() };
        let bulging = edges.iter().filter(|e| e.sweep().is_some_and(|(_, ahead)| ahead > 0.0));
        let bulging: Vec<&Walk> = bulging.collect();
        // The farthest that the region reaches in a direction.
        let reach = |n: Vec2| {
            let far = |n: Vec2| {
                let corners = plan.corners.iter().map(|c| c.dot(n));
                let arcs = bulging.iter().filter_map(|edge| match (edge.curve, edge.sweep()) {
                    (Curve::Arc { center, radius, .. }, Some((start, ahead))) => {
                        let turned = (libm::atan2(n.y, n.x) - start).rem_euclid(TAU);
                        (turned <= ahead).then(|| center.dot(n) + radius)
                    }
                    _ => None,
                });
                corners.chain(arcs).fold(f64::NEG_INFINITY, f64::max)
            };
            if mirrored { far(n).max(far(Vec2::new(-n.x, n.y))) } else { far(n) }
        };
        let probes: Vec<(Vec2, f64)> = (0..PROBES)
            .map(|i| sin_cos_deg(f64::from(i) * 360.0 / f64::from(PROBES)))
            .map(|(s, c)| Vec2::new(c, s))
            .map(|n| (n, reach(n)))
            .collect();
        let mut circles = Vec::new();
        for edge in &bulging {
            let Curve::Arc { center, radius, .. } = edge.curve else { continue };
            let slack = 1e-2 * deviation;
            if probes.iter().all(|&(n, far)| center.dot(n) + radius <= far + slack) {
                if !circles.contains(&(center, radius)) {
                    circles.push((center, radius));
                }
            } else {
                edge.flatten(0.25 * deviation, &mut plan.corners);
            }
        }
        plan.circles = circles;
        plan
    }
}

impl Extremes {
    /// What a prism over the contours from z = 0 to 1 has, tapered to `top` at z = 1, after it was moved by `map`.
    pub fn add_prism(&mut self, contours: &[Contour], top: f64, map: &Affine, tolerance: f64) {
        let plan = Plan::new(contours, tolerance * size(contours), false);
        for (z, scale) in [(0.0, 1.0), (1.0, top)] {
            let at = |p: Vec2| map.point(Vec3::new(p.x * scale, p.y * scale, z));
            if scale == 0.0 {
                self.points.push(at(Vec2::new(0.0, 0.0)));
                continue;
            }
            self.points.extend(plan.corners.iter().map(|&p| at(p)));
            self.rounds.extend(plan.circles.iter().map(|&(center, radius)| Round::Ellipse {
                center: at(center),
                axes: [map.column(0) * (radius * scale), map.column(1) * (radius * scale)],
            }));
        }
    }

    /// What the contours have that are swept about the z axis, x being the distance from it and y the height, after that was
    /// moved by `map`. What is to the left of the axis does not count.
    pub fn add_revolution(&mut self, contours: &[Contour], map: &Affine, tolerance: f64) {
        let deviation = tolerance * size(contours);
        let mut plan = Plan::new(contours, deviation, true);
        let left = -1e-9 * size(contours);
        if plan.corners.iter().chain(plan.circles.iter().map(|(center, _)| center)).any(|p| p.x < left) {
            let corners = flattened(contours, deviation).iter().flat_map(|polygon| right_of_axis(polygon)).collect();
            plan = Plan { corners, circles: Vec::new() };
        }
        let axes = [0, 1, 2].map(|axis| map.column(axis));
        let at = |z: f64| map.point(Vec3::new(0.0, 0.0, z));
        for p in plan.corners {
            if p.x > 0.0 {
                self.rounds.push(Round::Ellipse { center: at(p.y), axes: [axes[0] * p.x, axes[1] * p.x] });
            } else {
                self.points.push(at(p.y));
            }
        }
        for (center, radius) in plan.circles {
            let about_axis = center.x.abs() <= 1e-9 * radius;
            self.rounds.push(if about_axis {
                Round::Ellipsoid { center: at(center.y), axes: axes.map(|a| a * radius) }
            } else {
                Round::Ring { center: at(center.y), axes: axes.map(|a| a * center.x), minor: radius / center.x }
            });
        }
    }
}
