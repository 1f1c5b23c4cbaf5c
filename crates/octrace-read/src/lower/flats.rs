//! The leaves in the plane: squares, circles, polygons.

use super::args::Args;
use super::facets;
use super::report::Report;
use super::shapes::{is_positive, radius};
use crate::Facets;
use crate::diagnostic::{Diagnostic, Severity};
use crate::syntax::element_range;
use octrace::Vec2;
use octrace::geom::sin_cos_deg;
use octrace_forms::plane::{Flat, Outline};

/// More corners than these are as good as none.
const MOST_CORNERS: u32 = 100_000;

/// `square(size, center)`; `None` where it is nothing, and why was said.
pub(super) fn square(args: &Args<'_>, report: &mut Report<'_>) -> Option<Flat> {
    let ([x, y], at) = match (args.number("size"), args.numbers("size")) {
        (Some((edge, at)), _) => ([edge; 2], at),
        (_, Some((&[x, y, ..], at))) => ([x, y], at),
        _ => ([1.0; 2], args.name_at),
    };
    for edge in [x, y] {
        is_positive(edge, at, "size-not-positive", "each size of a square", "the square is empty", report)?;
    }
    let low = if args.flag("center") { Vec2::new(-0.5 * x, -0.5 * y) } else { Vec2::ZERO };
    Some(Flat::from(Outline::rectangle(low, low + Vec2::new(x, y))))
}

/// `circle(r)`; `None` where it is nothing, and why was said.
pub(super) fn circle(args: &Args<'_>, mode: Facets, report: &mut Report<'_>) -> Option<Flat> {
    let (radius, at) = radius(args, "d", "r").unwrap_or((1.0, args.name_at));
    is_positive(radius, at, "radius-not-positive", "circle radius", "the circle is empty", report)?;
    Some(Flat::from(match facets::around(mode, args, radius) {
        Some(n) if n <= MOST_CORNERS => Outline::polygon(&[ring(n, radius)]).unwrap_or_default(),
        _ => Outline::circle(radius),
    }))
}

fn ring(n: u32, radius: f64) -> Vec<Vec2> {
    let corner = |i| {
        let (sin, cos) = sin_cos_deg(360.0 * f64::from(i) / f64::from(n));
        Vec2::new(radius * cos, radius * sin)
    };
    (0..n).map(corner).collect()
}

/// `polygon(points, paths)`; `None` where it is nothing, and why was said.
pub(super) fn polygon(args: &Args<'_>, report: &mut Report<'_>) -> Option<Flat> {
    const NOTHING: &str = "the polygon is empty";
    if args.damaged {
        return None;
    }
    let Some((points, points_at)) = args.rows("points") else {
        let wrong = "a polygon needs `points`".to_owned();
        report.degenerate("missing-argument", args.name_at, wrong, NOTHING, None);
        return None;
    };
    let mut sound = true;
    for (i, p) in points.iter().enumerate().filter(|(_, p)| p.iter().any(|v| !v.is_finite())) {
        sound = false;
        let wrong = format!("point {i} of this polygon has a coordinate that is not finite: {p:?}");
        report.degenerate("polygon-point", element_range(report.text, points_at, &[i]), wrong, NOTHING, None);
    }
    if !sound {
        return None;
    }
    let points: Vec<Vec2> = points.iter().map(|p| Vec2::new(p[0], p[1])).collect();
    let mut paths: Vec<Vec<u32>> = Vec::new();
    match args.rows("paths") {
        None => paths.push((0..points.len() as u32).collect()),
        Some((rows, at)) => {
            let is_index = report.index_below(points.len());
            for (row, path) in rows.iter().enumerate() {
                for (k, index) in path.iter().enumerate().filter(|(_, v)| !is_index(**v)) {
                    let message = format!(
                        "path {row} names point {index}, but there are {} points, numbered from 0",
                        points.len()
                    );
                    let at = element_range(report.text, at, &[row, k]);
                    // OpenSCAD goes on without the point.
                    let severity = if report.forgives() { Severity::Warning } else { Severity::Error };
                    report.push(Diagnostic::new(severity, "polygon-index", at, message));
                }
                paths.push(path.iter().filter(|v| is_index(**v)).map(|&v| v as u32).collect());
            }
            if paths.is_empty() {
                paths.push((0..points.len() as u32).collect());
            }
        }
    }
    let path_of = |path: &Vec<u32>| path.iter().map(|&i| points[i as usize]).collect();
    let outline = match Outline::polygon(&paths.iter().map(path_of).collect::<Vec<_>>()) {
        Ok(outline) => outline,
        Err(error) => {
            report.push(Diagnostic::error(
                "polygon-unsound",
                args.name_at,
                format!("this polygon is not sound: {error}"),
            ));
            return None;
        }
    };
    if outline.is_empty() {
        report.degenerate("polygon-empty", args.name_at, "this polygon has no area".to_owned(), "it is empty", None);
        return None;
    }
    Some(Flat::from(outline))
}
