//! The edges that go into a boolean operation, and the chords that stand for them.

use super::carrier::Carrier;
use super::grid::{Grid, GridPoint};
use crate::plane::PlaneError;
use crate::plane::curve::{angle, edges, sweep};
use i_overlay::core::overlay::ShapeType;
use octrace::{Contour, Curve, Edge, Vec2, geom::sin_cos_deg};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// An edge of an operand.
#[derive(Debug)]
pub(super) struct Source {
    role: ShapeType,
    /// Its ends, and where they are on the grid.
    pub(super) ends: [(Vec2, GridPoint); 2],
    /// The circle that it is a part of; `None` for a line.
    pub(super) circle: Option<u32>,
    ccw: bool,
}

/// A circle that arcs are parts of. Arcs of circles that nearly coincide are parts of the first of them.
#[derive(Debug)]
pub(super) struct Circle {
    pub(super) center: Vec2,
    pub(super) radius: f64,
    /// The number of chords of a full turn. All circles of a size have the same, so that chords of equal or concentric
    /// circles are parallel.
    per_turn: f64,
    /// Where its chords end that are not at multiples of the chord's angle: in chords from the x axis, in order.
    ends: Vec<(f64, GridPoint)>,
}

/// A straight piece of an edge, on the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chord {
    pub(super) from: GridPoint,
    pub(super) to: GridPoint,
    pub(super) source: u32,
    pub(super) role: ShapeType,
}

/// All edges of all operands.
#[derive(Debug)]
pub(super) struct Sources {
    pub(super) grid: Grid,
    pub(super) edges: Vec<Source>,
    pub(super) circles: Vec<Circle>,
}

/// How many chords a circle that is as large as everything has.
const CHORDS_PER_TURN: f64 = 512.0;

/// Arcs of circles larger than this many times everything cannot be told from their chords.
const FLATTEST: f64 = 1e7;

/// Ends of arcs may be off their circles by this share of everything: numbers in files have few digits.
const OFF_THE_CIRCLE: f64 = 1e-3;

impl Circle {
    /// The farthest that a chord is from the circle.
    pub(super) fn sagitta(&self) -> f64 {
        let half = TAU * 0.5 / self.per_turn;
        self.radius * half * half * 0.5
    }

    /// The length of a chord.
    pub(super) fn chord(&self) -> f64 {
        self.radius * TAU / self.per_turn
    }

    /// The place of a point, in chords from the x axis: from 0 to the number of chords.
    fn place(&self, p: Vec2) -> f64 {
        let turns = angle(p - self.center) / TAU;
        (if turns < 0.0 { turns + 1.0 } else { turns }) * self.per_turn
    }

    /// Corners of the chords strictly between two places, `reach` chords apart, counter-clockwise.
    fn between(&self, grid: &Grid, start: f64, reach: f64, into: &mut Vec<GridPoint>) {
        const APART: f64 = 1e-6;
        let mut places: Vec<(f64, Option<GridPoint>)> = Vec::new();
        for turn in [0.0, self.per_turn] {
            let first = self.ends.partition_point(|end| end.0 + turn <= start + APART);
            let inside = self.ends[first..].iter().take_while(|end| end.0 + turn < start + reach - APART);
            places.extend(inside.map(|end| (end.0 + turn, Some(end.1))));
        }
        let near_an_end = |place: f64| {
            let place = place % self.per_turn;
            let next = self.ends.partition_point(|end| end.0 < place);
            let ends =
                [next.checked_sub(1), Some(next % self.ends.len().max(1)), self.ends.len().checked_sub(1), Some(0)];
            let distance = |end: f64| ((end - place).abs()).min(self.per_turn - (end - place).abs());
            ends.into_iter().flatten().filter_map(|i| self.ends.get(i)).any(|end| distance(end.0) < 0.25)
        };
        let mut place = start.floor() + 1.0;
        while place < start + reach {
            if !near_an_end(place) {
                places.push((place, None));
            }
            place += 1.0;
        }
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        into.extend(places.into_iter().map(|(place, end)| {
            end.unwrap_or_else(|| {
                let (s, c) = sin_cos_deg(place % self.per_turn / self.per_turn * 360.0);
                grid.nearest(self.center + Vec2::new(c, s) * self.radius)
            })
        }));
    }
}

impl Sources {
    /// Takes contours in. `None` where there is nothing with an extent.
    pub(super) fn new<'a>(
        contours: impl Iterator<Item = (ShapeType, &'a Contour)>,
    ) -> Result<Option<Self>, PlaneError> {
        let all: Vec<(ShapeType, Edge, Vec2)> =
            contours.flat_map(|(role, contour)| edges(contour).map(move |(edge, to)| (role, edge, to))).collect();
        let Some((min, max)) = reach(&all)? else { return Ok(None) };
        let size = (max.x - min.x).max(max.y - min.y);
        let arc = |edge: &Edge, to: Vec2| arc(edge, to, size);
        let corners: Vec<Vec2> = all.iter().map(|(_, edge, _)| edge.from).collect();
        let points = corners.iter().copied().chain(all.iter().flat_map(|(_, edge, _)| sides(edge))).collect::<Vec<_>>();
        let Some(grid) = Grid::new(min, max, &corners, &points) else { return Ok(None) };
        let arcs: Vec<(Vec2, f64)> =
            all.iter().filter_map(|(_, edge, to)| arc(edge, *to)).map(|(center, radius, _)| (center, radius)).collect();
        let same = Same::new(&arcs, grid.step());
        let mut sources = Self { grid, edges: Vec::with_capacity(all.len()), circles: Vec::new() };
        let mut known = BTreeMap::new();
        for (role, edge, to) in all {
            let ends = [edge.from, to].map(|p| (p, sources.grid.corner(p)));
            let mut source = Source { role, ends, circle: None, ccw: true };
            if let Some((center, radius, ccw)) = arc(&edge, to) {
                let circle = *known.entry(same.key(center, radius)).or_insert_with(|| {
                    sources.circles.push(Circle { center, radius, per_turn: per_turn(radius, size), ends: Vec::new() });
                    sources.circles.len() - 1
                });
                source.circle = Some(circle as u32);
                source.ccw = ccw;
                let circle = &mut sources.circles[circle];
                if edge.from != to {
                    circle.ends.extend(ends.map(|(p, at)| (circle.place(p), at)));
                }
            }
            sources.edges.push(source);
        }
        for circle in &mut sources.circles {
            circle.ends.sort_by(|a, b| a.0.total_cmp(&b.0));
            circle.ends.dedup_by(|a, b| a.1 == b.1);
        }
        Ok(Some(sources))
    }

    /// The line or circle of an edge.
    pub(super) fn carrier(&self, source: u32) -> Carrier {
        let edge = &self.edges[source as usize];
        match edge.circle {
            None => Carrier::Line { from: edge.ends[0].0, to: edge.ends[1].0 },
            Some(circle) => {
                let circle = &self.circles[circle as usize];
                Carrier::Circle { center: circle.center, radius: circle.radius }
            }
        }
    }

    /// All edges as chords; those of a contour are closed.
    pub(super) fn chords(&self) -> Vec<Chord> {
        let mut chords = Vec::with_capacity(self.edges.len());
        let mut middle = Vec::new();
        for (source, edge) in self.edges.iter().enumerate() {
            let [(from, first), (to, last)] = edge.ends;
            middle.clear();
            if let Some(circle) = edge.circle {
                let circle = &self.circles[circle as usize];
                let start = if edge.ccw { from } else { to };
                let turn = sweep(circle.center, edge.ccw, from, to).abs();
                circle.between(&self.grid, circle.place(start), turn / TAU * circle.per_turn, &mut middle);
                if !edge.ccw {
                    middle.reverse();
                }
            }
            middle.push(last);
            let mut at = first;
            for &next in &middle {
                if next != at {
                    chords.push(Chord { from: at, to: next, source: source as u32, role: edge.role });
                }
                at = next;
            }
        }
        chords
    }
}

/// The four sides of an arc's circle; none of a line.
fn sides(edge: &Edge) -> impl Iterator<Item = Vec2> + use<> {
    let circle = match edge.curve {
        Curve::Arc { center, radius, .. } => Some((center, radius)),
        Curve::Line => None,
    };
    let ways = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    circle.into_iter().flat_map(move |(center, radius)| ways.map(|[x, y]| center + Vec2::new(x, y) * radius))
}

/// Centre, radius and sense of an arc. `None` for a line, and for what is treated as one: an arc so flat that it cannot be
/// told from its chord, or whose ends are not on its circle.
fn arc(edge: &Edge, to: Vec2, size: f64) -> Option<(Vec2, f64, bool)> {
    let Curve::Arc { center, radius, ccw } = edge.curve else { return None };
    let on_the_circle = |p: Vec2| ((p - center).length() - radius).abs() <= size * OFF_THE_CIRCLE;
    let round = radius <= FLATTEST * size && on_the_circle(edge.from) && on_the_circle(to);
    round.then_some((center, radius, ccw))
}

/// Chords of a full turn so that they are as close to the circle as those of a circle as large as everything.
fn per_turn(radius: f64, size: f64) -> f64 {
    let mut count = CHORDS_PER_TURN;
    let mut larger = radius / size;
    while larger > 1.0 {
        // Twice as many chords are four times closer.
        larger *= 0.25;
        count *= 2.0;
    }
    count
}

/// The smallest rectangle around corners and chords of arcs, a little more for what arcs reach beyond.
fn reach(edges: &[(ShapeType, Edge, Vec2)]) -> Result<Option<(Vec2, Vec2)>, PlaneError> {
    let far = f64::INFINITY;
    let (mut min, mut max) = (Vec2::new(far, far), Vec2::new(-far, -far));
    let mut add = |p: Vec2| {
        min = Vec2::new(min.x.min(p.x), min.y.min(p.y));
        max = Vec2::new(max.x.max(p.x), max.y.max(p.y));
    };
    for (_, edge, to) in edges {
        let finite = |v: Vec2| v.x.is_finite() && v.y.is_finite();
        let curve = match edge.curve {
            Curve::Line => true,
            Curve::Arc { center, radius, .. } => finite(center) && radius.is_finite() && radius > 0.0,
        };
        if !(finite(edge.from) && curve) {
            return Err(PlaneError::NotFinite);
        }
        add(edge.from);
        if let Curve::Arc { center, ccw, .. } = edge.curve {
            // Eighths of the arc, and the tangents' meeting points over them: the arc is within.
            let turn = sweep(center, ccw, edge.from, *to) / 8.0;
            let over = 1.0 / libm::cos(turn * 0.5);
            for i in 0..8 {
                let v = crate::plane::curve::turned(edge.from - center, turn * (f64::from(i) + 0.5));
                add(center + v * over);
            }
        }
    }
    Ok((min.x <= max.x).then_some((min, max)))
}

/// Tells circles that are the same up to the grid.
struct Same {
    values: [Vec<f64>; 3],
}

impl Same {
    fn new(circles: &[(Vec2, f64)], step: f64) -> Self {
        let group = |value: fn(&(Vec2, f64)) -> f64| super::grid::anchors(circles.iter().map(value).collect(), step);
        Self { values: [group(|c| c.0.x), group(|c| c.0.y), group(|c| c.1)] }
    }

    fn key(&self, center: Vec2, radius: f64) -> [usize; 3] {
        let [xs, ys, radii] = &self.values;
        let place = |values: &[f64], v: f64| values.partition_point(|&a| a <= v);
        [place(xs, center.x), place(ys, center.y), place(radii, radius)]
    }
}
