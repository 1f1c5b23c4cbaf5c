//! Sweeping along z: OpenSCAD's `linear_extrude`.

use super::layers::{Diagonal, Ends, Section, Sides};
use super::slices::{self, Fragments};
use super::{SweepError, profile, resolved};
use crate::Tolerance;
use crate::plane::{Affine2, Flat, Outline};
use octrace::geom::sin_cos_deg;
use octrace::{Affine, Primitive, Solid, Vec2, Vec3};
use std::sync::Arc;

/// How a flat shape is swept along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearExtrude {
    /// How far; positive.
    pub height: f64,
    /// Where the lower end is.
    pub base: f64,
    /// How far sideways it goes for each unit upwards.
    pub lean: Vec2,
    /// How far the upper end is turned clockwise, seen from above, in degrees.
    pub twist_deg: f64,
    /// How many times larger the upper end is, along x and y; not negative. Each section is turned first, then scaled.
    pub scale: [f64; 2],
    /// In how many slices, where somebody said so.
    pub slices: Option<u32>,
    /// OpenSCAD's own slices are wanted, by these; otherwise as many as the tolerance asks for.
    pub written: Option<Fragments>,
}

/// The shape swept along z.
///
/// Without a twist and with the same scale along x and y this is exact: lines become planes, arcs cylinders or cones. Else
/// it is a polyhedron in slices. OpenSCAD's slices, where `written` asks for them or a number is given; otherwise fine
/// enough for the tolerance.
///
/// # Errors
/// If the outline, or what comes of it, is not sound.
pub fn linear_extrude(shape: &Flat, how: &LinearExtrude, tolerance: Tolerance) -> Result<Solid, SweepError> {
    let [x, y] = how.scale;
    let leaning = Affine {
        rows: [Vec3::new(1.0, 0.0, how.lean.x), Vec3::new(0.0, 1.0, how.lean.y), Vec3::Z],
        translation: Vec3::ZERO,
    };
    let placed = |solid: Solid| solid.translate([0.0, 0.0, how.base]).transform(leaning);
    if how.twist_deg == 0.0 && x == y {
        return prism(&resolved(shape, tolerance)?, how.height, x).map(placed);
    }
    sliced(shape, how, tolerance).map(placed)
}

/// Sweeping a combination is combining what is swept.
fn prism(shape: &Flat, height: f64, scale: f64) -> Result<Solid, SweepError> {
    let leaf = |outline: &Arc<Outline>, map: &Affine2| upright_prism(outline, map, height, scale);
    shape.fold(leaf, |op, solids| Ok(Solid::combine(op, solids)))
}

fn upright_prism(outline: &Outline, map: &Affine2, height: f64, scale: f64) -> Result<Solid, SweepError> {
    let Some(inverse) = map.inverse() else { return Ok(Solid::empty()) };
    // Scaling is about the origin of the plane: where that is, the outline has to know before it is moved.
    let (first, then) = match scale == 1.0 {
        true => (Affine2::IDENTITY, *map),
        false => {
            let linear = Affine2 { translation: Vec2::ZERO, ..*map };
            (Affine2::translation(inverse.vector(map.translation)), linear)
        }
    };
    let Some(profile) = profile(&outline.moved(&first, Tolerance::default()), Tolerance::default())? else {
        return Ok(Solid::empty());
    };
    // Primitives are wide at z = 0; one that is wide at the top stands on its head.
    let (top, wide, up, base) = match scale > 1.0 {
        true => (1.0 / scale, scale, -height, height),
        false => (scale, 1.0, height, 0.0),
    };
    let map = Affine {
        rows: [
            Vec3::new(then.x.x * wide, then.y.x * wide, 0.0),
            Vec3::new(then.x.y * wide, then.y.y * wide, 0.0),
            Vec3::new(0.0, 0.0, up),
        ],
        translation: Vec3::new(then.translation.x, then.translation.y, base),
    };
    Ok(Solid::primitive(Primitive::Prism { profile, top }).transform(map))
}

fn sliced(shape: &Flat, how: &LinearExtrude, tolerance: Tolerance) -> Result<Solid, SweepError> {
    let polygons = polygons(&*shape.outline(tolerance)?, tolerance);
    if polygons.is_empty() {
        return Ok(Solid::empty());
    }
    let corners = || polygons.iter().flatten();
    let radius = corners().map(|p| p.length()).fold(0.0, f64::max);
    let [x, y] = how.scale;
    let farthest = corners().map(|p| Vec2::new(p.x * (1.0 - x), p.y * (1.0 - y)).length()).fold(0.0, f64::max);
    let (slices, polygons) = match (how.slices, how.written) {
        (Some(slices), _) => (slices.clamp(1, MOST_SLICES), polygons),
        (None, Some(by)) => (openscad_slices(how, radius, farthest, &by), polygons),
        (None, None) => fine(how, radius, tolerance, &polygons),
    };
    let or = if how.twist_deg > 0.0 { Diagonal::Rising } else { Diagonal::Falling };
    let sides = if how.scale.contains(&0.0) { Sides::CutToLine(or) } else { Sides::Cut(or) };
    let section = Section::new(&polygons);
    let place = |layer: usize, corner: Vec2| {
        let part = layer as f64 / f64::from(slices);
        let (sin, cos) = sin_cos_deg(-how.twist_deg * part);
        let turned = Vec2::new(cos * corner.x - sin * corner.y, sin * corner.x + cos * corner.y);
        let scale = how.scale.map(|end| 1.0 - (1.0 - end) * part);
        Vec3::new(turned.x * scale[0], turned.y * scale[1], how.height * part)
    };
    Ok(section.sweep(slices as usize + 1, Ends::Capped, sides, place)?)
}

/// The corners of an outline's contours, arcs cut into chords.
pub(super) fn polygons(outline: &Outline, tolerance: Tolerance) -> Vec<Vec<Vec2>> {
    let straight = outline.polygonised(tolerance);
    straight.contours.iter().map(|contour| contour.iter().map(|edge| edge.from).collect()).collect()
}

const MOST_SLICES: u32 = 100_000;

fn openscad_slices(how: &LinearExtrude, radius: f64, farthest: f64, by: &Fragments) -> u32 {
    let [x, y] = how.scale;
    let helix = || slices::of_helix(radius, how.height, how.twist_deg, by);
    let scaling = || slices::of_scaling(farthest, how.height, by);
    match (how.twist_deg == 0.0, x == y) {
        (true, true) => 1,
        (true, false) => scaling(),
        (false, true) if x == 1.0 => helix(),
        (false, true) => slices::of_spiral(radius, how.height, how.twist_deg, x, by),
        (false, false) => helix().max(scaling()),
    }
}

/// Slices and pieces of edges so fine that no side lies farther than the tolerance from the surface that it stands for.
///
/// A corner goes along a chord instead of a helix: `radius (1 - cos(turn / 2))` off. Between two layers an edge of length
/// `l` sweeps a ruled surface, which the diagonal of its side misses by `l turn / 4`, and more with scaling.
fn fine(how: &LinearExtrude, radius: f64, tolerance: Tolerance, polygons: &[Vec<Vec2>]) -> (u32, Vec<Vec<Vec2>>) {
    const MOST_FACES: f64 = 1e6;
    let [x, y] = how.scale;
    let largest = radius * x.max(y).max(1.0);
    let off = tolerance.relative * (2.0 * largest + how.height);
    let twist = how.twist_deg.abs().to_radians();
    let edges: f64 = polygons.iter().map(|p| p.len() as f64).sum();
    let turn = libm::sqrt(8.0 * off / largest).min(1.0);
    let most = (MOST_FACES / edges).max(1.0);
    let slices = (twist / turn).max(((x - y).abs() * 16.0).sqrt() * 4.0).ceil().clamp(1.0, most);
    let slope = twist / slices + (x - y).abs() / slices;
    let longest = 4.0 * off / slope;
    let pieces = |from: Vec2, to: Vec2| {
        let most = (MOST_FACES / (edges * slices)).max(1.0);
        ((to - from).length() * x.max(y).max(1.0) / longest).ceil().clamp(1.0, most) as u32
    };
    let divided = polygons.iter().map(|polygon| {
        let mut fine = Vec::new();
        for (i, &from) in polygon.iter().enumerate() {
            let to = polygon[(i + 1) % polygon.len()];
            let count = pieces(from, to);
            fine.extend((0..count).map(|k| from + (to - from) * (f64::from(k) / f64::from(count))));
        }
        fine
    });
    (slices as u32, divided.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::BoolOp;
    use octrace::model::Node;

    fn how(height: f64, twist_deg: f64, scale: [f64; 2], slices: Option<u32>) -> LinearExtrude {
        let written = Some(Fragments::default());
        LinearExtrude { height, base: 0.0, lean: Vec2::ZERO, twist_deg, scale, slices, written }
    }

    fn square(size: f64) -> Flat {
        Outline::rectangle(Vec2::ZERO, Vec2::new(size, size)).into()
    }

    fn centered(size: f64) -> Flat {
        Outline::rectangle(Vec2::new(-0.5 * size, -0.5 * size), Vec2::new(0.5 * size, 0.5 * size)).into()
    }

    /// The volume of a solid that is one polyhedron, maybe moved by a map that keeps volumes.
    fn volume(solid: &Solid) -> f64 {
        match solid.node() {
            Node::Primitive(Primitive::Polyhedron(polyhedron)) => polyhedron.volume(),
            Node::Transform(_, child) => volume(child),
            other => panic!("{other:?}"),
        }
    }

    fn check(shape: &Flat, how: &LinearExtrude, expected: f64) {
        let found = volume(&linear_extrude(shape, how, Tolerance::default()).expect("it can be swept"));
        assert!((found - expected).abs() < 2e-5 * expected, "{how:?}: {found} is not {expected}");
    }

    /// Volumes of what OpenSCAD 2021.01 exports for the same.
    #[test]
    fn slices_are_those_of_openscad() {
        check(&square(2.0), &how(10.0, 90.0, [1.0; 2], None), 42.9966);
        check(&square(2.0), &how(10.0, 90.0, [1.0; 2], Some(4)), 44.0875);
        check(&square(2.0), &how(10.0, 90.0, [2.0; 2], None), 96.2875);
        check(&square(2.0), &how(10.0, 360.0, [1.0; 2], Some(2)), 40.0 / 3.0);
        check(&square(2.0), &how(10.0, 5.0, [1.0; 2], None), 41.1113);
        check(&centered(2.0), &how(10.0, -90.0, [1.0, 2.0], Some(3)), 67.3207);
        let frame = Flat::combined(BoolOp::Difference, [centered(4.0), centered(1.0)]);
        check(&frame, &how(10.0, 90.0, [1.0; 2], Some(3)), 168.301);
    }

    /// Everything but a square, and everything but that: the square, and of its size.
    #[test]
    fn shapes_cut_out_of_the_whole_plane_keep_their_size() {
        let plane = || centered(1e6);
        let all_but = |shape: Flat| Flat::combined(BoolOp::Difference, [plane(), shape]);
        let solid =
            linear_extrude(&all_but(all_but(square(2.0))), &how(1.0, 0.0, [1.0; 2], None), Tolerance::default());
        let bounds = crate::space::bounds(&solid.expect("it can be swept"));
        assert!((bounds.max - Vec3::new(2.0, 2.0, 1.0)).length() < 1e-4, "{bounds:?}");
        assert!(bounds.min.length() < 1e-4, "{bounds:?}");
    }

    #[test]
    fn sides_of_uneven_scaling_are_cut_as_openscad_does() {
        check(&square(3.0), &how(2.0, 0.0, [2.0, 1.0], None), 27.0);
        check(&square(3.0), &how(2.0, 0.0, [0.0, 1.0], None), 9.0);
        let triangle = [[20.0, 0.0], [0.0, 10.0], [0.0, -10.0]].map(|[x, y]| Vec2::new(x, y)).to_vec();
        let triangle = Flat::from(Outline::polygon(&[triangle]).expect("a triangle"));
        check(&triangle, &how(10.0, 0.0, [1.0, 0.0], Some(1)), 4000.0 / 3.0);
        check(&triangle, &how(10.0, 0.0, [1.0, 0.0], Some(2)), 1000.0);
        let pentagon: Vec<Vec2> = (0..5)
            .map(|i| {
                let (sin, cos) = sin_cos_deg(72.0 * f64::from(i));
                Vec2::new(2.0 * cos, 2.0 * sin)
            })
            .collect();
        let pentagon = Flat::from(Outline::polygon(&[pentagon]).expect("a pentagon"));
        check(&pentagon, &how(10.0, 0.0, [1.0, 3.0], None), 187.848);
        check(&pentagon, &how(10.0, 0.0, [2.0, 3.0], Some(7)), 300.155);
    }

    /// A square turned about its middle keeps its area: the volume of a twisted bar is that of a straight one.
    #[test]
    fn fine_slices_keep_to_the_tolerance() {
        for scale in [[1.0; 2], [1.0, 2.0]] {
            let fine = LinearExtrude { written: None, ..how(10.0, 200.0, scale, None) };
            let found = volume(&linear_extrude(&centered(2.0), &fine, Tolerance::default()).expect("it can be swept"));
            let mean = 0.5 * (scale[0] * scale[1] + 1.0);
            assert!((found - 40.0 * mean).abs() < 40.0 * 1e-3, "{found}");
        }
    }
}
