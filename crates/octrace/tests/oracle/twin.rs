//! The twin: whether a point is in a solid, by the definition of every primitive, in its own coordinates.

use octrace::model::Node;
use octrace::{Affine, BoolOp, Curve, Polyhedron, Primitive, Profile, Solid, Vec2, Vec3};

/// What is known about a point.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    /// Whether the point is in the solid.
    pub inside: bool,
    /// How near it is to the nearest surface of any primitive, seen or not; in the primitive's coordinates, roughly.
    pub clearance: f64,
}

/// Asks the twin.
pub fn ask(solid: &Solid, p: Vec3) -> Answer {
    match solid.node() {
        Node::Empty => Answer { inside: false, clearance: f64::INFINITY },
        Node::Primitive(primitive) => {
            let level = level(primitive, p);
            Answer { inside: level < 0.0, clearance: level.abs() }
        }
        Node::Transform(map, child) => ask(child, undo(map, p)),
        Node::Part(_, child) => ask(child, p),
        Node::Combine(op, children) => {
            let answers: Vec<Answer> = children.iter().map(|child| ask(child, p)).collect();
            let mut insides = answers.iter().map(|answer| answer.inside);
            let inside = match op {
                BoolOp::Union => insides.any(|inside| inside),
                BoolOp::Intersection => insides.all(|inside| inside),
                BoolOp::Difference => insides.next() == Some(true) && !insides.any(|inside| inside),
            };
            Answer { inside, clearance: answers.iter().map(|a| a.clearance).fold(f64::INFINITY, f64::min) }
        }
    }
}

/// Where `map` takes `p` from: Cramer's rule.
fn undo(map: &Affine, p: Vec3) -> Vec3 {
    let wanted = p - map.translation;
    let columns = [map.column(0), map.column(1), map.column(2)];
    let determinant = |c: [Vec3; 3]| c[0].dot(c[1].cross(c[2]));
    let whole = determinant(columns);
    let unknown = |i: usize| {
        let mut replaced = columns;
        replaced[i] = wanted;
        determinant(replaced) / whole
    };
    Vec3::new(unknown(0), unknown(1), unknown(2))
}

/// Negative inside the primitive, positive outside; the magnitude is roughly the distance from its surface, nearby.
fn level(primitive: &Primitive, p: Vec3) -> f64 {
    let largest = |levels: &[f64]| levels.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let rho = libm::hypot(p.x, p.y);
    match primitive {
        Primitive::Block => largest(&[-p.x, p.x - 1.0, -p.y, p.y - 1.0, -p.z, p.z - 1.0]),
        Primitive::Sphere => libm::hypot(rho, p.z) - 1.0,
        Primitive::Cylinder => largest(&[rho - 1.0, -p.z, p.z - 1.0]),
        Primitive::HalfSpace => -p.z,
        Primitive::Cone { top } => largest(&[rho - (1.0 + (top - 1.0) * p.z), -p.z, p.z - 1.0]),
        Primitive::Torus { minor } => libm::hypot(rho - 1.0, p.z) - minor,
        Primitive::Polyhedron(polyhedron) => polyhedron_level(polyhedron, p),
        Primitive::Prism { profile, top } => {
            let scale = 1.0 - (1.0 - top) * p.z;
            let side = match scale > 0.0 {
                true => profile_level(profile, Vec2::new(p.x / scale, p.y / scale)) * scale,
                false => libm::hypot(p.x, p.y),
            };
            largest(&[side, -p.z, p.z - 1.0])
        }
        // Near the axis nothing is lost by what is cut off.
        Primitive::Revolution(profile) => profile_level(profile, Vec2::new(rho, p.z)),
    }
}

/// Inside is what an odd number of contours are around: a ray to the right crosses them as often.
fn profile_level(profile: &Profile, p: Vec2) -> f64 {
    let (mut inside, mut distance) = (false, f64::INFINITY);
    for contour in profile.contours() {
        for (edge, next) in contour.iter().zip(contour.iter().cycle().skip(1)) {
            let (a, b) = (edge.from, next.from);
            let along = b - a;
            if a != b {
                let weight = ((p - a).dot(along) / along.dot(along)).clamp(0.0, 1.0);
                distance = distance.min((a + along * weight - p).length());
                inside ^= (a.y <= p.y) != (b.y <= p.y) && (along.cross(p - a) > 0.0) == (b.y > a.y);
            }
            if let Curve::Arc { center, radius, ccw } = edge.curve {
                // Between the chord, which was looked at, and the arc.
                let off = (p - center).length() - radius;
                distance = distance.min(off.abs());
                inside ^= off < 0.0 && (a == b || (along.cross(p - a) < 0.0) == ccw);
            }
        }
    }
    if inside { -distance } else { distance }
}

/// Inside is where the faces fill the whole sphere of directions.
fn polyhedron_level(polyhedron: &Polyhedron, p: Vec3) -> f64 {
    let (mut angle, mut distance) = (0.0, f64::INFINITY);
    for face in polyhedron.faces() {
        let corners: Vec<Vec3> = face.iter().map(|&i| polyhedron.points()[i as usize]).collect();
        for i in 1..corners.len() - 1 {
            // A fan covers what lies outside a face that is not convex twice, with opposite signs.
            let [a, b, c] = [corners[0] - p, corners[i] - p, corners[i + 1] - p];
            angle += solid_angle(a, b, c);
            distance = distance.min(fan_distance(a, b, c));
        }
    }
    if angle.abs() > 2.0 * std::f64::consts::PI { -distance } else { distance }
}

/// The solid angle of a triangle seen from the origin [van Oosterom, Strackee 1983].
fn solid_angle(a: Vec3, b: Vec3, c: Vec3) -> f64 {
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * libm::atan2(a.dot(b.cross(c)), below)
}

/// How far the origin is from a triangle. (In a fan, parts outside the face count too; that only makes the twin shy.)
fn fan_distance(a: Vec3, b: Vec3, c: Vec3) -> f64 {
    let edge = |from: Vec3, to: Vec3| {
        let along = to - from;
        let weight = (-from.dot(along) / along.dot(along)).clamp(0.0, 1.0);
        (from + along * weight).length()
    };
    let edges = edge(a, b).min(edge(b, c)).min(edge(c, a));
    let Some(normal) = (b - a).cross(c - a).normalized() else { return edges };
    let foot = normal * normal.dot(a);
    let in_triangle =
        [(a, b), (b, c), (c, a)].iter().all(|&(from, to)| normal.dot((to - from).cross(foot - from)) >= 0.0);
    if in_triangle { normal.dot(a).abs() } else { edges }
}

#[test]
fn the_twin_knows_its_primitives() {
    let inside = |solid: &Solid, p: [f64; 3]| ask(solid, p.into()).inside;
    let ring = Solid::primitive(Primitive::Torus { minor: 0.25 }).scale([2.0, 2.0, 2.0]);
    assert!(inside(&ring, [2.4, 0.0, 0.0]) && !inside(&ring, [1.4, 0.0, 0.0]) && !inside(&ring, [0.0, 0.0, 0.0]));
    let cone = Solid::primitive(Primitive::Cone { top: 0.5 });
    assert!(inside(&cone, [0.7, 0.0, 0.5]) && !inside(&cone, [0.8, 0.0, 0.5]));
    let drilled = Solid::block() - Solid::cylinder().scale([0.25, 0.25, 1.0]).translate([0.5, 0.5, 0.0]);
    assert!(inside(&drilled, [0.1, 0.1, 0.5]) && !inside(&drilled, [0.5, 0.5, 0.5]));
    let turned = Solid::block().rotate([0.0, 0.0, 90.0]);
    assert!(inside(&turned, [-0.5, 0.5, 0.5]) && !inside(&turned, [0.5, 0.5, 0.5]));
    let wedge = crate::common::polyhedra()[2].clone();
    assert!(inside(&wedge, [0.5, 1.5, 0.5]) && inside(&wedge, [1.5, 0.5, 0.5]) && !inside(&wedge, [1.5, 1.5, 0.5]));
}
