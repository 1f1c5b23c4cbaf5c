//! The path language of SVG, and shapes that are written in it.

use super::svg_page::Map;
use crate::curve::{EllipticArc, Pen};
use octrace::Vec2;
use octrace::geom::sin_cos_deg;
use svgtypes::{PathParser, PathSegment};

/// OpenSCAD makes so many chords of each Bézier curve.
const BEZIER_CHORDS: u32 = 20;

/// A stroke from where the one before ended.
#[derive(Clone, Copy, Debug)]
pub(super) enum Stroke {
    Line(Vec2),
    Quad(Vec2, Vec2),
    Cubic(Vec2, Vec2, Vec2),
    /// With the number of chords that OpenSCAD makes of it.
    Arc(EllipticArc, u32, Vec2),
}

/// A part of a path, from one move of the pen to the next.
#[derive(Clone, Debug)]
pub(super) struct Subpath {
    pub start: Vec2,
    pub strokes: Vec<Stroke>,
}

impl Stroke {
    fn end(&self) -> Vec2 {
        match *self {
            Self::Line(p) | Self::Quad(_, p) | Self::Cubic(_, _, p) | Self::Arc(_, _, p) => p,
        }
    }
}

impl Subpath {
    pub fn new(start: Vec2) -> Self {
        Self { start, strokes: Vec::new() }
    }

    pub fn polygon(points: impl IntoIterator<Item = Vec2>) -> Self {
        let mut points = points.into_iter();
        let start = points.next().unwrap_or_default();
        Self { start, strokes: points.map(Stroke::Line).collect() }
    }

    /// A whole ellipse along the axes.
    pub fn ellipse(center: Vec2, x: f64, y: f64, chords: u32) -> Self {
        let (x, y) = (Vec2::new(x, 0.0), Vec2::new(0.0, y));
        let start = center + x;
        let arc = EllipticArc { center, x, y, start_deg: 0.0, sweep_deg: 360.0 };
        Self { start, strokes: vec![Stroke::Arc(arc, chords, start)] }
    }

    pub fn end(&self) -> Vec2 {
        self.strokes.last().map_or(self.start, Stroke::end)
    }

    /// All points that say where it goes.
    pub fn points(&self) -> impl Iterator<Item = Vec2> {
        let strokes = self.strokes.iter().flat_map(|stroke| match *stroke {
            Stroke::Line(p) => vec![p],
            Stroke::Quad(c, p) => vec![c, p],
            Stroke::Cubic(c, d, p) => vec![c, d, p],
            Stroke::Arc(arc, _, p) => {
                vec![arc.center + arc.x, arc.center - arc.x, arc.center + arc.y, arc.center - arc.y, p]
            }
        });
        std::iter::once(self.start).chain(strokes)
    }

    /// Draws it moved by `map`; with chords for everything that is round, or not.
    pub fn draw(&self, map: &Map, as_chords: bool, pen: &mut Pen) {
        pen.move_to(map.point(self.start));
        for stroke in &self.strokes {
            match *stroke {
                Stroke::Line(p) => pen.line_to(map.point(p)),
                Stroke::Quad(c, p) => pen.quad_to(map.point(c), map.point(p)),
                Stroke::Cubic(c, d, p) => pen.cubic_to(map.point(c), map.point(d), map.point(p)),
                Stroke::Arc(arc, chords, p) => {
                    let (x, y) = (map.vector(arc.x), map.vector(arc.y));
                    let arc = EllipticArc { center: map.point(arc.center), x, y, ..arc };
                    match as_chords {
                        true => arc.draw_chords(pen, chords, map.point(p)),
                        false => arc.draw(pen, map.point(p)),
                    }
                }
            }
        }
    }

    /// The corners of OpenSCAD's chords.
    pub fn chords(&self) -> Vec<Vec2> {
        let mut corners = vec![self.start];
        for stroke in &self.strokes {
            let from = corners[corners.len() - 1];
            let steps = |count: u32| (1..=count).map(move |i| f64::from(i) / f64::from(count));
            match *stroke {
                Stroke::Line(p) => corners.push(p),
                Stroke::Quad(c, p) => corners.extend(steps(BEZIER_CHORDS).map(|t| {
                    let s = 1.0 - t;
                    from * (s * s) + c * (2.0 * s * t) + p * (t * t)
                })),
                Stroke::Cubic(c, d, p) => corners.extend(steps(BEZIER_CHORDS).map(|t| {
                    let s = 1.0 - t;
                    from * (s * s * s) + c * (3.0 * s * s * t) + d * (3.0 * s * t * t) + p * (t * t * t)
                })),
                Stroke::Arc(arc, chords, _) => {
                    let sweep = arc.end_deg() - arc.start_deg;
                    corners.extend(steps(chords).map(|t| arc.at(arc.start_deg + sweep * t)));
                }
            }
        }
        corners
    }
}

/// The parts of a path, and whether one of them was closed expressly. It ends where it cannot be read.
pub(super) fn parse(text: &str) -> (Vec<Subpath>, bool) {
    let mut paths: Vec<Subpath> = Vec::new();
    let mut is_closed = false;
    let mut at = Vec2::ZERO;
    // The last control point, of a cubic or of a quadratic curve.
    let (mut cubic, mut quadratic) = (None, None);
    for segment in PathParser::from(text).map_while(Result::ok) {
        let base = if segment.is_abs() { Vec2::ZERO } else { at };
        let from_base = |x: f64, y: f64| base + Vec2::new(x, y);
        let (last_cubic, last_quadratic) = (cubic.take().unwrap_or(at), quadratic.take().unwrap_or(at));
        let stroke = match segment {
            PathSegment::MoveTo { x, y, .. } => {
                at = from_base(x, y);
                paths.push(Subpath::new(at));
                continue;
            }
            PathSegment::ClosePath { .. } => {
                is_closed = true;
                if let Some(path) = paths.last_mut() {
                    at = path.start;
                    path.strokes.push(Stroke::Line(at));
                    paths.push(Subpath::new(at));
                }
                continue;
            }
            PathSegment::LineTo { x, y, .. } => Stroke::Line(from_base(x, y)),
            PathSegment::HorizontalLineTo { x, .. } => Stroke::Line(Vec2::new(base.x + x, at.y)),
            PathSegment::VerticalLineTo { y, .. } => Stroke::Line(Vec2::new(at.x, base.y + y)),
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                Stroke::Cubic(from_base(x1, y1), from_base(x2, y2), from_base(x, y))
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                Stroke::Cubic(at * 2.0 - last_cubic, from_base(x2, y2), from_base(x, y))
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => Stroke::Quad(from_base(x1, y1), from_base(x, y)),
            PathSegment::SmoothQuadratic { x, y, .. } => Stroke::Quad(at * 2.0 - last_quadratic, from_base(x, y)),
            PathSegment::EllipticalArc { rx, ry, x_axis_rotation, large_arc, sweep, x, y, .. } => {
                arc(at, from_base(x, y), Vec2::new(rx, ry), x_axis_rotation, large_arc, sweep)
            }
        };
        match stroke {
            Stroke::Cubic(_, d, _) => cubic = Some(d),
            Stroke::Quad(c, _) => quadratic = Some(c),
            _ => {}
        }
        at = stroke.end();
        match paths.last_mut() {
            Some(path) => path.strokes.push(stroke),
            None => paths.push(Subpath { start: Vec2::ZERO, strokes: vec![stroke] }),
        }
    }
    paths.retain(|path| !path.strokes.is_empty());
    (paths, is_closed)
}

/// An arc by its ends [SVG 1.1, F.6].
fn arc(from: Vec2, to: Vec2, radii: Vec2, rotation_deg: f64, is_large: bool, is_forward: bool) -> Stroke {
    let (sin, cos) = sin_cos_deg(rotation_deg);
    let half = (from - to) * 0.5;
    // The way from the middle of the chord to its start, in the ellipse's axes.
    let (px, py) = (cos * half.x + sin * half.y, cos * half.y - sin * half.x);
    let (mut rx, mut ry) = (radii.x.abs(), radii.y.abs());
    if rx == 0.0 || ry == 0.0 || from == to {
        return Stroke::Line(to);
    }
    let (ux, uy) = (px / rx, py / ry);
    let too_far = ux * ux + uy * uy;
    if too_far > 1.0 {
        (rx, ry) = (rx * too_far.sqrt(), ry * too_far.sqrt());
    }
    // On the unit circle: the chord's half, and from its middle at a right angle to the centre.
    let (ux, uy) = (px / rx, py / ry);
    let squared = ux * ux + uy * uy;
    let reach = ((1.0 - squared).max(0.0) / squared).sqrt() * if is_large == is_forward { -1.0 } else { 1.0 };
    let (cx, cy) = (reach * uy, -reach * ux);
    let angle = |x: f64, y: f64| libm::atan2(y, x).to_degrees();
    let start_deg = angle(ux - cx, uy - cy);
    let turn = (angle(-ux - cx, -uy - cy) - start_deg).rem_euclid(360.0);
    let sweep_deg = if is_forward { turn } else { turn - 360.0 };
    let (x, y) = (Vec2::new(cos, sin) * rx, Vec2::new(-sin, cos) * ry);
    let center = (from + to) * 0.5 + x * cx + y * cy;
    let chords = (sweep_deg.abs() / 18.0 + 4.0) as u32;
    Stroke::Arc(EllipticArc { center, x, y, start_deg, sweep_deg }, chords, to)
}

/// A rectangle, its corners rounded where a radius is not zero.
pub(super) fn rectangle(corner: Vec2, width: f64, height: f64, rx: f64, ry: f64) -> Subpath {
    let (rx, ry) = match (rx.abs() >= 1e-8, ry.abs() >= 1e-8) {
        (false, true) => (ry, ry),
        (true, false) => (rx, rx),
        _ => (rx, ry),
    };
    let (rx, ry) = (rx.min(width / 2.0), ry.min(height / 2.0));
    let at = |x: f64, y: f64| corner + Vec2::new(x, y);
    if rx.abs() < 1e-8 {
        return Subpath::polygon([at(0.0, 0.0), at(width, 0.0), at(width, height), at(0.0, height)]);
    }
    let radii = Vec2::new(rx, ry);
    let round = |from: Vec2, to: Vec2| arc(from, to, radii, 0.0, false, true);
    let corners = [
        (at(width - rx, 0.0), at(width, ry)),
        (at(width, height - ry), at(width - rx, height)),
        (at(rx, height), at(0.0, height - ry)),
        (at(0.0, ry), at(rx, 0.0)),
    ];
    let strokes = corners.into_iter().flat_map(|(from, to)| [Stroke::Line(from), round(from, to)]);
    Subpath { start: at(rx, 0.0), strokes: strokes.collect() }
}
