//! From chords on the grid back to lines and arcs.

use super::Origin;
use super::carrier::Carrier;
use super::grid::GridPoint;
use super::runs::{Run, RunCurve, runs, without};
use super::source::Sources;
use crate::plane::Outline;
use crate::plane::curve::{edges, signed_area, sweep};
use crate::plane::outline::{full_circle, straight};
use i_overlay::vector::edge::{DataVectorEdge, DataVectorPath, DataVectorShape};
use octrace::{Contour, Curve, Edge, Vec2};
use std::f64::consts::PI;

/// The outline that polygons on the grid stand for.
pub(super) fn outline(sources: &Sources, shapes: &[DataVectorShape<i64, Origin>]) -> Outline {
    Outline { contours: shapes.iter().flatten().flat_map(|path| contours(sources, path)).collect() }
}

/// The contours that a closed chain of chords stands for: one, and the circles that touch it. The chain itself where the two
/// would differ by more than chords and grid explain; none for what is only a sliver between points of the grid.
fn contours(sources: &Sources, path: &DataVectorPath<i64, Origin>) -> Vec<Contour> {
    let corners: Vec<Vec2> = path.iter().map(|chord| sources.grid.place(chord.a)).collect();
    let polygon = straight(&corners);
    let area = signed_area(&polygon);
    let length: f64 = path.iter().map(|chord| chord_length(sources, chord)).sum();
    if area.abs() <= length * sources.grid.step() {
        return Vec::new();
    }
    // Chords of arcs are away from them by two thirds of the sagitta on average.
    let rounded: f64 = path.iter().map(|chord| chord_length(sources, chord) * slack(sources, chord.data.0)).sum();
    let recovered = with_circles_apart(curved(sources, path));
    let difference = (recovered.iter().map(signed_area).sum::<f64>() - area).abs();
    if difference <= 2.0 * rounded { recovered } else { vec![polygon] }
}

/// Makes each edge that is a whole circle a contour.
fn with_circles_apart(contour: Contour) -> Vec<Contour> {
    let closed: Vec<bool> =
        edges(&contour).map(|(edge, to)| edge.curve != Curve::Line && edge.from == to && contour.len() > 1).collect();
    let mut contours: Vec<Contour> = vec![Vec::new()];
    for (edge, closed) in contour.into_iter().zip(closed) {
        if closed { contours.push(vec![edge]) } else { contours[0].push(edge) }
    }
    contours.retain(|contour| !contour.is_empty());
    contours
}

fn chord_length(sources: &Sources, chord: &DataVectorEdge<i64, Origin>) -> f64 {
    (sources.grid.place(chord.b) - sources.grid.place(chord.a)).length()
}

/// How far the chords of an edge may be from it.
fn slack(sources: &Sources, source: u32) -> f64 {
    let circle = sources.edges[source as usize].circle.map(|circle| &sources.circles[circle as usize]);
    4.0 * sources.grid.step() + circle.map_or(0.0, |circle| circle.sagitta())
}

fn curved(sources: &Sources, path: &DataVectorPath<i64, Origin>) -> Contour {
    let mut runs = runs(sources, path);
    loop {
        if let [Run { curve: RunCurve::Circle { circle, ccw }, .. }] = runs[..] {
            let circle = &sources.circles[circle as usize];
            let whole = full_circle(circle.center, circle.radius);
            return if ccw { whole } else { crate::plane::curve::reversed(&whole) };
        }
        let count = runs.len();
        let mut corners: Vec<Vec2> =
            (0..count).map(|i| corner(sources, &runs[(i + count - 1) % count], &runs[i])).collect();
        // Nearly a full turn that ends where it began, but for rounding, is a full one.
        for (i, _) in runs.iter().enumerate().filter(|(_, run)| run.turn.abs() > PI) {
            let (from, to) = (corners[i], &mut corners[(i + 1) % count]);
            if (*to - from).length() <= rounding(sources) {
                *to = from;
            }
        }
        let edges: Vec<Option<Edge>> =
            (0..count).map(|i| edge(sources, &runs[i], corners[i], corners[(i + 1) % count])).collect();
        let dropped: Vec<bool> = edges.iter().map(Option::is_none).collect();
        if count < 2 || dropped.iter().all(|&d| !d) || dropped.iter().all(|&d| d) {
            return without_straight_corners(edges.into_iter().flatten().collect());
        }
        runs = without(&runs, &dropped);
    }
}

/// The edge of a run between two corners; `None` where nothing but rounding is left between them.
fn edge(sources: &Sources, run: &Run, from: Vec2, to: Vec2) -> Option<Edge> {
    let apart = (to - from).length() > rounding(sources);
    match run.curve {
        RunCurve::Line { .. } => apart.then_some(Edge { from, curve: Curve::Line }),
        RunCurve::Circle { circle, ccw } => {
            let circle = &sources.circles[circle as usize];
            let curve = Curve::Arc { center: circle.center, radius: circle.radius, ccw };
            // What the chords say tells nothing from nearly a full turn.
            let turn = if apart { sweep(circle.center, ccw, from, to).abs() } else { 0.0 };
            let closed = from == to && run.turn.abs() > PI;
            (closed || (apart && turn - run.turn.abs() < PI)).then_some(Edge { from, curve })
        }
    }
}

/// Corners that were computed before may be off by this much.
fn rounding(sources: &Sources) -> f64 {
    sources.grid.step() * 1e-4
}

/// Where one run ends and the next begins.
fn corner(sources: &Sources, last: &Run, next: &Run) -> Vec2 {
    let (a, b) = (last.sources[1], next.sources[0]);
    let (on_a, on_b) = (sources.carrier(a), sources.carrier(b));
    let (at, also) = (last.ends[1], next.ends[0]);
    let exact = rounding(sources);
    let mut known =
        [a, b].into_iter().flat_map(|s| sources.edges[s as usize].ends).filter(|end| end.1 == at || end.1 == also);
    let corners: Vec<Vec2> = known.by_ref().map(|end| end.0).collect();
    if let Some(&corner) = corners.iter().find(|&&p| on_a.distance(p) <= exact && on_b.distance(p) <= exact) {
        return corner;
    }
    let place = |p: GridPoint| sources.grid.place(p);
    let near = (place(at) + place(also)) * 0.5;
    let apart = (place(at) - place(also)).length();
    let slack = slack(sources, a).max(slack(sources, b));
    // Where curves nearly touch, chords cross up to a chord away from the curves.
    let reach = [a, b].map(|s| reach(sources, s, &on_a, &on_b)).into_iter().fold(apart * 2.0, f64::max);
    let met = on_a.meet(&on_b, near, slack).filter(|&p| (p - near).length() <= reach);
    let corner = met.or_else(|| corners.first().copied()).unwrap_or(near);
    match (on_a, on_b) {
        _ if met.is_some() => corner,
        (Carrier::Circle { .. }, _) => on_a.nearest(corner),
        (_, Carrier::Circle { .. }) => on_b.nearest(corner),
        _ => corner,
    }
}

/// How far from where chords meet their curves may meet.
fn reach(sources: &Sources, source: u32, a: &Carrier, b: &Carrier) -> f64 {
    let steps = 8.0 * sources.grid.step();
    match sources.edges[source as usize].circle {
        Some(circle) => steps + 2.0 * sources.circles[circle as usize].chord(),
        None => match (a, b) {
            (Carrier::Line { from, to }, Carrier::Line { from: from2, to: to2 }) => {
                let (u, v) = (*to - *from, *to2 - *from2);
                let sine = u.cross(v).abs() / (u.length() * v.length());
                if sine > 0.0 { steps / sine } else { 0.0 }
            }
            _ => steps,
        },
    }
}

/// Takes out corners between two lines that go on straight.
pub(in crate::plane) fn without_straight_corners(contour: Contour) -> Contour {
    let count = contour.len();
    let straight = |i: usize| {
        let (last, next) = (&contour[(i + count - 1) % count], &contour[(i + 1) % count]);
        let here = &contour[i];
        if last.curve != Curve::Line || here.curve != Curve::Line {
            return false;
        }
        let (u, v) = (here.from - last.from, next.from - here.from);
        // Collinear up to the rounding of the subtractions.
        u.dot(v) > 0.0 && u.cross(v).abs() <= u.length() * v.length() * 1e-13
    };
    if count < 4 {
        return contour;
    }
    let kept: Contour = (0..count).filter(|&i| !straight(i)).map(|i| contour[i]).collect();
    if kept.len() < 2 { contour } else { kept }
}
