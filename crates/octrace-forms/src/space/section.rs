//! Sections of solids with the plane z = 0: OpenSCAD's `projection(cut = true)`.
//!
//! The section of a boolean combination is the combination of the sections. Those of the primitives are taken closed, as
//! OpenSCAD does: what only touches the plane, with a face, from above or from below, has that face as its section. (So a
//! hole that ends in the plane is a hole of the section.)

use super::SpaceError;
use super::bounds::bounds;
use super::contour::{circle, convex_polygon, ellipse, nothing, plan, region, rings};
use super::convex::convex;
use super::fold::fold;
use super::mesh::{TriangleMesh, faceted};
use super::pieces::is_convex_primitive;
use super::swept;
use crate::Tolerance;
use crate::plane::{Affine2, Flat};
use octrace::{Affine, Bounds, Polyhedron, Primitive, Profile, Solid, Vec2, Vec3};

/// Heights smaller than this, as a share of the size, are zero.
const LEVEL: f64 = 1e-9;

/// The section with the plane z = 0, as a tree like that of the solid. Circles and straight lines are exact; ellipses, and
/// curves of higher degree, are polygons within the tolerance.
///
/// # Errors
/// If the solid is unbounded, or a polyhedron in it has no mesh that can be cut.
pub fn section(solid: &Solid, tolerance: Tolerance) -> Result<Flat, SpaceError> {
    let whole = bounds(solid);
    if !whole.is_bounded() {
        return Err(SpaceError::Unbounded);
    }
    let knife = Knife { deviation: tolerance.relative * whole.diagonal(), level: LEVEL * whole.diagonal(), whole };
    let mut failure = None;
    let flat = fold(
        solid,
        |primitive, map| {
            knife.primitive(primitive, map).unwrap_or_else(|error| {
                failure = Some(error);
                nothing()
            })
        },
        |op, operands: Vec<Flat>| match operands.len() {
            0 => nothing(),
            _ => Flat::Combined(op, operands.into()),
        },
    );
    failure.map_or(Ok(flat), Err)
}

/// What cuts, with what it has to know of the whole.
struct Knife {
    deviation: f64,
    level: f64,
    whole: Bounds,
}

impl Knife {
    fn primitive(&self, primitive: &Primitive, map: &Affine) -> Result<Flat, SpaceError> {
        let around = primitive.bounds(map);
        if around.min.z > self.level || around.max.z < -self.level {
            return Ok(nothing());
        }
        match primitive {
            Primitive::Sphere => Ok(self.ellipsoid(map)),
            Primitive::Cylinder if self.is_upright(map) => Ok(self.upright(1.0, map)),
            Primitive::Cone { top } if self.is_upright(map) => Ok(self.upright(*top, map)),
            Primitive::Torus { minor } if *minor < 1.0 && self.is_upright(map) && is_round(map) => {
                Ok(self.lying_ring(*minor, map))
            }
            Primitive::Prism { profile, top } if self.is_upright(map) => Ok(self.prism(profile, *top, map)),
            Primitive::Revolution(profile) if self.is_upright(map) && is_turned(map) => {
                let height = -map.translation.z / map.column(2).z;
                let discs = swept::rings_at(profile.contours(), height, self.level / map.column(2).z.abs());
                Ok(rings(&discs, map))
            }
            _ if !is_convex_primitive(primitive) => self.mesh(faceted(primitive, map, self.deviation, &self.whole)),
            _ => {
                let mesh = faceted(primitive, map, self.deviation, &self.whole);
                Ok(convex(&mesh.points).map_or_else(nothing, |p| self.convex(&p)))
            }
        }
    }

    /// Whether what is horizontal in the primitive stays so.
    fn is_upright(&self, map: &Affine) -> bool {
        map.rows[2].x.abs().max(map.rows[2].y.abs()) <= self.level
    }

    fn convex(&self, polyhedron: &Polyhedron) -> Flat {
        let points = polyhedron.points();
        let height = |i: u32| match points[i as usize].z {
            z if z.abs() <= self.level => 0.0,
            z => z,
        };
        let mut cut: Vec<Vec2> =
            (0..points.len() as u32).filter(|&i| height(i) == 0.0).map(|i| plan(points[i as usize])).collect();
        for corners in polyhedron.faces() {
            for (&i, &j) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                let (a, b) = (height(i), height(j));
                if a < 0.0 && b > 0.0 {
                    let (p, q) = (points[i as usize], points[j as usize]);
                    cut.push(plan(p + (q - p) * (a / (a - b))));
                }
            }
        }
        convex_polygon(cut)
    }

    /// In the coordinates of the unit ball the plane cuts a circle.
    fn ellipsoid(&self, map: &Affine) -> Flat {
        let up = map.rows[2];
        let (length, Some(normal)) = (up.length(), up.normalized()) else { return nothing() };
        let distance = -map.translation.z / length;
        let squared = 1.0 - distance * distance;
        if squared <= 0.0 {
            return nothing();
        }
        let [u, v] = super::frusta::across(normal).map(|d| plan(map.vector(d * squared.sqrt())));
        ellipse(plan(map.point(normal * distance)), [u, v], self.deviation)
    }

    /// A cylinder or cone, or an oblique one, with horizontal circles.
    fn upright(&self, top: f64, map: &Affine) -> Flat {
        let up = map.column(2);
        let share = (-map.translation.z / up.z).clamp(0.0, 1.0);
        let radius = 1.0 + (top - 1.0) * share;
        if radius <= 0.0 {
            return nothing();
        }
        let axes = [0, 1].map(|axis| plan(map.column(axis)) * radius);
        ellipse(plan(map.translation + up * share), axes, self.deviation)
    }

    fn prism(&self, profile: &Profile, top: f64, map: &Affine) -> Flat {
        let up = map.column(2);
        let share = (-map.translation.z / up.z).clamp(0.0, 1.0);
        let scale = 1.0 + (top - 1.0) * share;
        let [x, y] = [0, 1].map(|axis| plan(map.column(axis)) * scale);
        let moved = Affine2 { x, y, translation: plan(map.translation + up * share) };
        if moved.inverse().is_none() { nothing() } else { region(profile.contours().to_vec()).moved(moved) }
    }

    fn lying_ring(&self, minor: f64, map: &Affine) -> Flat {
        let height = map.translation.z / map.column(2).z;
        let squared = minor * minor - height * height;
        if squared <= 0.0 {
            return nothing();
        }
        let (radius, center) = (map.column(0).length(), plan(map.translation));
        let [inner, outer] = [-1.0, 1.0].map(|sign| radius * (1.0 + sign * squared.sqrt()));
        region(vec![circle(center, outer, true), circle(center, inner, false)])
    }

    /// What is just above the plane, and what is just below.
    fn mesh(&self, mut mesh: TriangleMesh) -> Result<Flat, SpaceError> {
        let mut touches = false;
        for p in &mut mesh.points {
            if p.z.abs() <= self.level {
                p.z = 0.0;
                touches = true;
            }
        }
        let above = mesh.slice()?;
        if !touches {
            return Ok(above);
        }
        mesh.points.iter_mut().for_each(|p| p.z = -p.z);
        mesh.triangles.iter_mut().for_each(|t| t.reverse());
        Ok(Flat::Combined(octrace::BoolOp::Union, [above, mesh.slice()?].into()))
    }
}

/// Whether a map keeps upright things upright, and horizontal circles circles.
pub(super) fn is_turned(map: &Affine) -> bool {
    let [u, v, w] = [0, 1, 2].map(|axis| map.column(axis));
    w.x.abs().max(w.y.abs()) <= LEVEL * w.length() && super::hull::square(u, v)
}

/// Whether a map takes upright balls to balls.
fn is_round(map: &Affine) -> bool {
    let [u, v, w] = [0, 1, 2].map(|axis| map.column(axis));
    super::hull::square(u, v) && super::hull::square(u, w) && Vec3::dot(v, w).abs() <= 1e-5 * v.length() * w.length()
}

#[cfg(test)]
mod tests {
    use super::super::contour::tests::{check, contains};
    use super::*;
    use std::f64::consts::PI;

    fn section_of(solid: Solid) -> Flat {
        section(&solid, Tolerance::default()).unwrap()
    }

    fn block(x: f64, y: f64, z: f64) -> Solid {
        Solid::block().scale([x, y, z])
    }

    #[test]
    fn faces_in_the_plane_count_from_above_and_from_below() {
        for z in [0.0, -0.5, -1.0] {
            check(&section_of(Solid::block().translate([0.0, 0.0, z])), 1.0);
        }
        check(&section_of(Solid::block().translate([0.0, 0.0, 0.25])), 0.0);
        check(&section_of(Solid::primitive(Primitive::Cone { top: 0.0 }).translate([0.0, 0.0, -1.0])), 0.0);
    }

    /// As OpenSCAD 2021.01 has it.
    #[test]
    fn holes_that_end_in_the_plane_are_holes() {
        for z in [0.0, -1.0] {
            let notched = block(2.0, 2.0, 2.0).translate([0.0, 0.0, -1.0]) - Solid::block().translate([0.0, 0.0, z]);
            let flat = section_of(notched);
            check(&flat, 3.0);
            assert!(!contains(&flat, Vec2::new(0.5, 0.5)));
        }
    }

    #[test]
    fn circles_are_circles() {
        let exact = |solid: Solid, center: Vec2, radius: f64| {
            let flat = section_of(solid);
            let Flat::Outline(outline) = &flat else { panic!("{flat:?}") };
            let [contour] = outline.contours.as_slice() else { panic!("{outline:?}") };
            let [octrace::Edge { curve: octrace::Curve::Arc { center: c, radius: r, .. }, .. }] = contour.as_slice()
            else {
                panic!("{contour:?}")
            };
            assert!((*c - center).length() < 1e-15 && (r - radius).abs() < 1e-15, "{contour:?}");
        };
        exact(Solid::sphere().scale([5.0; 3]).translate([1.0, 2.0, 3.0]), Vec2::new(1.0, 2.0), 4.0);
        exact(Solid::cylinder().scale([2.0, 2.0, 9.0]).translate([0.0, 0.0, -4.0]), Vec2::new(0.0, 0.0), 2.0);
        exact(Solid::cylinder().translate([0.0, 0.0, -1.0]), Vec2::new(0.0, 0.0), 1.0);
        exact(Solid::primitive(Primitive::Cone { top: 0.5 }).translate([0.0, 0.0, -0.5]), Vec2::new(0.0, 0.0), 0.75);
    }

    #[test]
    fn profiles_are_cut_as_they_are() {
        let circle = vec![octrace::Edge {
            from: Vec2::new(4.0, 0.0),
            curve: octrace::Curve::Arc { center: Vec2::new(3.0, 0.0), radius: 1.0, ccw: true },
        }];
        let profile = std::sync::Arc::new(Profile::new(vec![circle]).unwrap());
        let cone = Solid::primitive(Primitive::Prism { profile: profile.clone(), top: 0.0 });
        let ring = Solid::primitive(Primitive::Revolution(profile));
        let at = |solid: &Solid, z: f64| {
            let Ok(outline) = section_of(solid.clone().translate([0.0, 0.0, -z])).outline(Tolerance::default()) else {
                panic!("nothing is too complex here")
            };
            outline.area()
        };
        assert!((at(&cone, 0.5) - PI / 4.0).abs() < 1e-12);
        assert!((at(&cone, 0.0) - PI).abs() < 1e-12 && at(&cone, 1.0) == 0.0);
        assert!((at(&ring, 0.0) - 12.0 * PI).abs() < 1e-12);
        assert!((at(&ring, 0.6) - PI * (3.8 * 3.8 - 2.2 * 2.2)).abs() < 1e-12);
    }

    #[test]
    fn areas_are_right() {
        check(
            &section_of(Solid::sphere().scale([3.0, 2.0, 1.0]).rotate([20.0, 0.0, 0.0])),
            0.0_f64.max({
                // Semi-axes 3 along x, and the ellipse of half-axes 2 and 1 turned by 20 degrees met by a horizontal line.
                let (s, c) = octrace::geom::sin_cos_deg(20.0);
                3.0 * PI / (c * c / 4.0 + s * s).sqrt()
            }),
        );
        check(
            &section_of(Solid::cylinder().scale([1.0, 1.0, 10.0]).translate([0.0, 0.0, -5.0]).rotate([60.0, 0.0, 0.0])),
            2.0 * PI,
        );
        check(&section_of(Solid::primitive(Primitive::Torus { minor: 0.5 })), 2.0 * PI);
        check(&section_of(Solid::primitive(Primitive::Torus { minor: 0.5 }).rotate([90.0, 0.0, 0.0])), 0.5 * PI);
        let both = Solid::block() + block(2.0, 2.0, 2.0).translate([0.5, 0.5, -1.0]);
        check(&section_of(both), 4.75);
        check(&section_of(Solid::sphere() & Solid::half_space().rotate([90.0, 0.0, 0.0])), 0.5 * PI);
    }
}
