//! The leaves: primitives with their sizes checked.

use super::args::Args;
use super::facets;
use super::language::Kind;
use super::report::Report;
use crate::diagnostic::Diagnostic;
use crate::{Facets, SourceRange};
use octrace::model::Node;
use octrace::{Affine, Bounds, Polyhedron, PolyhedronError, Primitive, Solid, Vec3};
use std::collections::HashMap;

/// Makes leaves, and each primitive only once.
pub(super) struct Shapes {
    facets: Facets,
    units: HashMap<Unit, Solid>,
}

/// A primitive of unit size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Unit {
    Block,
    Sphere,
    Cylinder,
    HalfSpace,
    /// The bits of its top radius.
    Cone(u64),
    /// The bits of its minor radius.
    Torus(u64),
    /// Facets around, bits of the top radius.
    Frustum(u32, u64),
    /// Facets around.
    Ball(u32),
}

/// More facets than these are as good as none, and would only take memory.
const MOST_FACETS_OF_A_CYLINDER: u32 = 100_000;
const MOST_FACETS_OF_A_BALL: u32 = 2_000;

impl Shapes {
    pub fn new(facets: Facets) -> Self {
        Self { facets, units: HashMap::new() }
    }

    /// The solid of a leaf, or `None` where it is nothing; why was said.
    pub fn leaf(&mut self, kind: Kind, args: &Args<'_>, report: &mut Report<'_>) -> Option<Solid> {
        match kind {
            Kind::Block => Some(self.unit(Unit::Block)),
            Kind::HalfSpace => Some(self.unit(Unit::HalfSpace)),
            Kind::Cube => self.cube(args, report),
            Kind::Sphere => self.sphere(args, report),
            Kind::Cylinder => self.cylinder(args, report),
            Kind::Torus => self.torus(args, report),
            _ => None,
        }
    }

    fn cube(&mut self, args: &Args<'_>, report: &mut Report<'_>) -> Option<Solid> {
        let (size, at) = match (args.number("size"), args.triple("size", 1.0)) {
            (Some((edge, at)), _) => ([edge; 3], at),
            (_, Some(triple)) => triple,
            _ => ([1.0; 3], args.name_at),
        };
        for edge in size {
            is_positive(edge, at, "size-not-positive", "each size of a cube", "the cube is empty", report)?;
        }
        let size = Vec3::from(size);
        let corner = if args.flag("center") { size * -0.5 } else { Vec3::ZERO };
        place(self.unit(Unit::Block), Affine { translation: corner, ..Affine::scale(size) }, at, report)
    }

    fn sphere(&mut self, args: &Args<'_>, report: &mut Report<'_>) -> Option<Solid> {
        let (radius, at) = radius(args, "d", "r").unwrap_or((1.0, args.name_at));
        is_positive(radius, at, "radius-not-positive", "sphere radius", "the sphere is empty", report)?;
        let unit = match facets::around(self.facets, args, radius) {
            Some(n) if n > MOST_FACETS_OF_A_BALL => too_many_facets(n, args, Unit::Sphere, report),
            Some(n) => Unit::Ball(n),
            None => Unit::Sphere,
        };
        place(self.unit(unit), Affine::scale(Vec3::splat(radius)), at, report)
    }

    fn cylinder(&mut self, args: &Args<'_>, report: &mut Report<'_>) -> Option<Solid> {
        const NOTHING: &str = "the cylinder is empty";
        let (height, height_at) = args.number("h").unwrap_or((1.0, args.name_at));
        let both = radius(args, "d", "r").unwrap_or((1.0, args.name_at));
        let (low, low_at) = radius(args, "d1", "r1").unwrap_or(both);
        let (high, high_at) = radius(args, "d2", "r2").unwrap_or(both);
        is_positive(height, height_at, "height-not-positive", "cylinder height", NOTHING, report)?;
        for (radius, at) in [(low, low_at), (high, high_at)] {
            // One of the two may be zero: a cone.
            if radius != 0.0 || low == high {
                is_positive(radius, at, "radius-not-positive", "cylinder radius", NOTHING, report)?;
            }
        }
        let (wide, top) = (low.max(high), low.min(high) / low.max(high));
        let unit = match facets::around(self.facets, args, wide) {
            Some(n) if n > MOST_FACETS_OF_A_CYLINDER => too_many_facets(n, args, round_unit(top), report),
            Some(n) => Unit::Frustum(n, top.to_bits()),
            None => round_unit(top),
        };
        // Primitives are wide at z = 0; one that is wide at the top stands on its head.
        let (up, base) = if low >= high { (height, 0.0) } else { (-height, height) };
        let lift = if args.flag("center") { height * -0.5 } else { 0.0 };
        let map = Affine { translation: Vec3::new(0.0, 0.0, base + lift), ..Affine::scale(Vec3::new(wide, wide, up)) };
        place(self.unit(unit), map, low_at.to(high_at).to(height_at), report)
    }

    fn torus(&mut self, args: &Args<'_>, report: &mut Report<'_>) -> Option<Solid> {
        const NOTHING: &str = "the torus is empty";
        let (major, major_at) = args.number("major").unwrap_or((1.0, args.name_at));
        let (minor, minor_at) = args.number("minor").unwrap_or((0.25 * major, args.name_at));
        is_positive(major, major_at, "radius-not-positive", "major radius of a torus", NOTHING, report)?;
        is_positive(minor, minor_at, "radius-not-positive", "minor radius of a torus", NOTHING, report)?;
        let unit = self.unit(Unit::Torus((minor / major).to_bits()));
        place(unit, Affine::scale(Vec3::splat(major)), major_at, report)
    }

    /// The primitive, the same one each time.
    fn unit(&mut self, unit: Unit) -> Solid {
        if let Some(solid) = self.units.get(&unit) {
            return solid.clone();
        }
        let faceted = |made: Result<Polyhedron, PolyhedronError>| made.ok().map(Solid::primitive);
        let solid = match unit {
            Unit::Block => Some(Solid::block()),
            Unit::Sphere => Some(Solid::sphere()),
            Unit::Cylinder => Some(Solid::cylinder()),
            Unit::HalfSpace => Some(Solid::half_space()),
            Unit::Cone(top) => Some(Solid::primitive(Primitive::Cone { top: f64::from_bits(top) })),
            Unit::Torus(minor) => Some(Solid::primitive(Primitive::Torus { minor: f64::from_bits(minor) })),
            Unit::Frustum(n, top) => faceted(facets::frustum(n, f64::from_bits(top))),
            Unit::Ball(n) => faceted(facets::ball(n)),
        };
        // Facets too fine for a polyhedron to be sound cannot be told from none.
        let solid = solid.unwrap_or_else(|| match unit {
            Unit::Frustum(_, top) => self.unit(round_unit(f64::from_bits(top))),
            _ => self.unit(Unit::Sphere),
        });
        self.units.insert(unit, solid.clone());
        solid
    }
}

fn round_unit(top: f64) -> Unit {
    if top < 1.0 { Unit::Cone(top.to_bits()) } else { Unit::Cylinder }
}

fn too_many_facets(n: u32, args: &Args<'_>, instead: Unit, report: &mut Report<'_>) -> Unit {
    let message = format!("{n} facets cannot be told from none; this becomes round");
    report.push(Diagnostic::warning("too-many-facets", args.name_at, message));
    instead
}

/// A radius, given as such or as a diameter.
pub(super) fn radius(args: &Args<'_>, diameter: &str, radius: &str) -> Option<(f64, SourceRange)> {
    args.number(diameter).map(|(d, at)| (d / 2.0, at)).or_else(|| args.number(radius))
}

/// `None`, and a word about it, where a size is not positive and finite.
pub(super) fn is_positive(
    value: f64,
    at: SourceRange,
    code: &'static str,
    what: &str,
    nothing: &str,
    report: &mut Report<'_>,
) -> Option<()> {
    if value > 0.0 && value.is_finite() {
        return Some(());
    }
    let must = if value <= 0.0 && value.is_finite() { "must be greater than zero" } else { "must be finite" };
    let help = (value < 0.0 && value.is_finite())
        .then(|| format!("write {}; to cut something away, use `difference`", -value));
    report.degenerate(code, at, format!("{what} {must}"), nothing, help);
    None
}

/// What is smaller than its distance from the origin by this factor has not enough digits left for a shape.
const LEAST_SHARE: f64 = 1e-13;

/// Whether a leaf can be computed with where `map` puts it; a word about it if not.
pub(super) fn can_be_placed(leaf: &Solid, map: &Affine, at: SourceRange, report: &mut Report<'_>) -> bool {
    let (own, primitive) = match leaf.node() {
        Node::Transform(own, child) => (*own, child.node()),
        node => (Affine::IDENTITY, node),
    };
    let Node::Primitive(primitive) = primitive else { return true };
    let map = *map * own;
    let bounds = match primitive {
        Primitive::HalfSpace => Bounds::around([map.translation]),
        bounded => bounded.bounds(&map),
    };
    let (reach, size) = (bounds.min.abs().max(bounds.max.abs()).max_abs(), bounds.size());
    let thinnest = size.x.min(size.y).min(size.z);
    let wrong = if reach > Primitive::LONGEST || reach.is_nan() {
        "this is too large, or too far from the origin, to compute with"
    } else if !matches!(primitive, Primitive::HalfSpace) && thinnest <= LEAST_SHARE * reach {
        "this is so small, or so far from the origin, that no digits are left for its shape"
    } else if map.inverse().is_some_and(|inverse| primitive.exceeds_numbers(&bounds, &inverse)) {
        "this is too small, or too thin, to compute with"
    } else {
        return true;
    };
    report.degenerate("size-out-of-range", at, wrong.to_owned(), "it is empty", None);
    false
}

/// The solid moved by `map`; `None`, and a word about it, where the map has no inverse to working precision.
fn place(solid: Solid, map: Affine, at: SourceRange, report: &mut Report<'_>) -> Option<Solid> {
    if map.inverse().is_none() {
        let wrong = "these sizes are too large or too different to compute with".to_owned();
        report.degenerate("size-out-of-range", at, wrong, "this is empty", None);
        return None;
    }
    Some(solid.transform(map))
}
