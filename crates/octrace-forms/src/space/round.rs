//! What convex hulls depend on: corners, circles and balls instead of solids.

use crate::Tolerance;
use octrace::geom::sin_cos_deg;
use octrace::{Affine, Bounds, Primitive, Vec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Where corners are few they may be closer together: planes that touch what is round move by as much as its corners do,
/// and that counts for flat things.
const FINER: f64 = 1.0 / 16.0;

/// Where the points are that replace something round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fit {
    /// On it, so that their hull is inside. Where a hull and what it is the hull of are united, or one is cut out of the
    /// other, corners shall not poke through.
    Inside,
    /// A little outside of it, so that areas and volumes are right.
    Even,
}

impl Fit {
    /// What the distance from the middle is multiplied by.
    fn factor(self, even: f64) -> f64 {
        if self == Self::Even { even } else { 1.0 }
    }
}

/// Curved things whose hull is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Round {
    /// The points `center + cos a * axes[0] + sin a * axes[1]`.
    Ellipse { center: Vec3, axes: [Vec3; 2] },
    /// The image of the unit ball under the map with these columns.
    Ellipsoid { center: Vec3, axes: [Vec3; 3] },
    /// A ring about the third axis, the image of one with major radius 1.
    Ring { center: Vec3, axes: [Vec3; 3], minor: f64 },
}

/// Corners and curved things; together they have the same hull as some solids.
#[derive(Clone, Debug, Default)]
pub(crate) struct Extremes {
    pub points: Vec<Vec3>,
    pub rounds: Vec<Round>,
}

/// A solid has no bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unbounded;

impl Extremes {
    /// Adds what the moved primitive has. Arcs of circles that are not in its hull as a whole become corners, within the
    /// tolerance.
    ///
    /// # Errors
    /// If the primitive is a half-space.
    pub fn add(&mut self, primitive: &Primitive, map: &Affine, tolerance: Tolerance) -> Result<(), Unbounded> {
        let axes = [0, 1, 2].map(|axis| map.column(axis));
        let center = map.translation;
        let circle = |z: f64, radius: f64| Round::Ellipse {
            center: center + axes[2] * z,
            axes: [axes[0] * radius, axes[1] * radius],
        };
        match primitive {
            Primitive::Block => self.points.extend((0..8).map(|i: u32| {
                let bit = |b: u32| f64::from(i >> b & 1);
                map.point(Vec3::new(bit(0), bit(1), bit(2)))
            })),
            Primitive::Polyhedron(p) => self.points.extend(p.points().iter().map(|&p| map.point(p))),
            Primitive::Sphere => self.rounds.push(Round::Ellipsoid { center, axes }),
            Primitive::Cylinder => self.rounds.extend([circle(0.0, 1.0), circle(1.0, 1.0)]),
            Primitive::Cone { top: 0.0 } => {
                self.rounds.push(circle(0.0, 1.0));
                self.points.push(center + axes[2]);
            }
            Primitive::Cone { top } => self.rounds.extend([circle(0.0, 1.0), circle(1.0, *top)]),
            Primitive::Torus { minor } => self.rounds.push(Round::Ring { center, axes, minor: *minor }),
            Primitive::Prism { profile, top } => self.add_prism(profile.contours(), *top, map, tolerance.relative),
            Primitive::Revolution(profile) => self.add_revolution(profile.contours(), map, tolerance.relative),
            Primitive::HalfSpace => return Err(Unbounded),
        }
        Ok(())
    }

    /// Adds everything that `more` has.
    pub fn append(&mut self, more: Self) {
        self.points.extend(more.points);
        self.rounds.extend(more.rounds);
    }

    /// Length of the diagonal of the box around everything.
    pub fn size(&self) -> f64 {
        let around = Bounds::around(self.points.iter().copied());
        self.rounds.iter().fold(around, |b, round| b.union(round.bounds())).diagonal()
    }

    /// Points in place of everything, whose hull is nowhere further than `tolerance` (scene units) from that of this.
    pub fn sampled(&self, tolerance: f64, fit: Fit) -> Vec<Vec3> {
        let mut points = self.points.clone();
        self.rounds.iter().for_each(|round| round.sample(tolerance, fit, &mut points));
        points
    }
}

impl Round {
    /// The smallest box around it.
    pub fn bounds(&self) -> Bounds {
        let (center, extent) = match *self {
            Self::Ellipse { center, axes: [a, b] } => (center, extent(&[a, b])),
            Self::Ellipsoid { center, axes } => (center, extent(&axes)),
            Self::Ring { center, axes, minor } => (center, extent(&axes[..2]) + extent(&axes) * minor),
        };
        Bounds::new(center - extent, center + extent)
    }

    /// Points on it, whose hull is nowhere further than `tolerance` (scene units) from its own.
    pub fn points_on(&self, tolerance: f64, points: &mut Vec<Vec3>) {
        match *self {
            // A circle has fewer points than a ball: they may be as close.
            Self::Ellipse { center, axes: [a, b] } => {
                circle(center, a, b, fragments(longest(&[a, b]), tolerance).max(64), Fit::Inside, points);
            }
            Self::Ellipsoid { .. } => self.sample(tolerance, Fit::Inside, points),
            Self::Ring { center, axes: [a, b, c], minor } => {
                let (around, along) = (longest(&[a, b]) * (1.0 + minor), longest(&[a, b, c]) * minor);
                let (n, m) = (fragments(around, tolerance).max(64), fragments(along, tolerance).max(32));
                ring(center, [a, b, c], minor, [n, m], Fit::Inside, points);
            }
        }
    }

    fn sample(&self, tolerance: f64, fit: Fit, points: &mut Vec<Vec3>) {
        // Rounded edges of large things are small; they shall look round too.
        let fragments = |radius: f64, tolerance: f64, least: u32| match fit {
            Fit::Inside => fragments(radius, tolerance).max(least),
            Fit::Even => fragments(radius, tolerance),
        };
        match *self {
            Self::Ellipse { center, axes: [a, b] } => {
                circle(center, a, b, fragments(longest(&[a, b]), tolerance * FINER, 96), fit, points)
            }
            Self::Ellipsoid { center, axes } => {
                let n = fragments(longest(&axes), tolerance, 64);
                let ball = unit_ball(n).filter_map(|p| if fit == Fit::Inside { p.normalized() } else { Some(p) });
                points.extend(ball.map(|p| center + axes[0] * p.x + axes[1] * p.y + axes[2] * p.z));
            }
            Self::Ring { center, axes: [a, b, c], minor } => {
                let (around, along) = (longest(&[a, b]) * (1.0 + minor), longest(&[a, b, c]) * minor);
                let (n, m) = (fragments(around, tolerance, 96), fragments(along, tolerance * FINER, 64));
                ring(center, [a, b, c], minor, [n, m], fit, points);
            }
        }
    }
}

/// Half the lengths of the sides of the box around an ellipsoid or an ellipse.
fn extent(axes: &[Vec3]) -> Vec3 {
    let along = |axis: usize| axes.iter().map(|a| a[axis] * a[axis]).sum::<f64>().sqrt();
    Vec3::new(along(0), along(1), along(2))
}

/// At least as long as the longest half-axis, and not twice as long.
fn longest(axes: &[Vec3]) -> f64 {
    axes.iter().map(|a| a.dot(*a)).fold(0.0, f64::max).sqrt()
}

/// So many corners has a polygon that is nowhere further than `tolerance` from the circle of that radius, and has its
/// area. A multiple of four, so that it reaches the same to all four sides.
pub(crate) fn fragments(radius: f64, tolerance: f64) -> u32 {
    // Between corners it is inside by half the sagitta, r (1 - cos(pi/n)) / 2, about r (pi/n)² / 4.
    let n = FRAC_PI_2 * (radius / tolerance).sqrt();
    let quarters = (n / 4.0).ceil();
    if quarters.is_finite() { 4 * (quarters as u32).clamp(4, 128) } else { 512 }
}

/// The ratio of the radius of a polygon's corners to that of the circle with the same area.
pub(crate) fn swelling(fragments: u32) -> f64 {
    let n = f64::from(fragments);
    (TAU / (n * libm::sin(TAU / n))).sqrt()
}

/// The corners of a polygon in place of an ellipse.
fn circle(center: Vec3, a: Vec3, b: Vec3, n: u32, fit: Fit, points: &mut Vec<Vec3>) {
    let factor = fit.factor(swelling(n));
    points.extend((0..n).map(|i| {
        let (s, c) = sin_cos_deg(360.0 * f64::from(i) / f64::from(n));
        center + (a * c + b * s) * factor
    }));
}

/// The corners of `m` polygons of `n` corners in place of a ring. Those on the side of the axis are in no hull.
fn ring(center: Vec3, [a, b, c]: [Vec3; 3], minor: f64, [n, m]: [u32; 2], fit: Fit, points: &mut Vec<Vec3>) {
    let tube = minor * fit.factor(swelling(m));
    for i in 0..m {
        let (s, c_) = sin_cos_deg(360.0 * f64::from(i) / f64::from(m));
        if c_ < 0.0 {
            continue;
        }
        let radius = 1.0 + tube * c_;
        circle(center + c * (tube * s), a * radius, b * radius, n, fit, points);
    }
}

/// The corners of a polyhedron with the volume of the unit ball: two poles, and rings of `n` corners.
pub(crate) fn unit_ball(n: u32) -> impl Iterator<Item = Vec3> {
    let rings = n / 2;
    let level = move |k: u32| sin_cos_deg(180.0 * f64::from(k) / f64::from(rings));
    // The volume of the polyhedron with corners on the unit ball, a stack of frusta of pyramids.
    let base = 0.5 * f64::from(n) * libm::sin(TAU / f64::from(n));
    let slice = |k: u32| {
        let ((r, z), (s, w)) = (level(k), level(k + 1));
        (z - w) * (r * r + r * s + s * s) / 3.0
    };
    let volume = base * (0..rings).map(slice).sum::<f64>();
    let swelling = libm::cbrt(4.0 / 3.0 * PI / volume);
    let ring = move |k: u32| {
        let (r, z) = level(k);
        (0..n).map(move |i| {
            let (s, c) = sin_cos_deg(360.0 * f64::from(i) / f64::from(n));
            Vec3::new(r * c, r * s, z) * swelling
        })
    };
    [Vec3::Z * swelling, Vec3::Z * -swelling].into_iter().chain((1..rings).flat_map(ring))
}
