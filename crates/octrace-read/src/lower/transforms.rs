//! Nodes that move their children.

use super::args::Args;
use super::language::Kind;
use super::report::Report;
use crate::SourceRange;
use crate::diagnostic::Diagnostic;
use octrace::{Affine, Vec3};

/// What a node does to its children's place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Placement {
    /// Moves them. The map may be flat, which leaves nothing of solids.
    Moved(Affine),
    /// Leaves nothing of them: there is no map. That was said.
    Nowhere,
}

/// What the node does; nothing where it is not a transform.
pub(super) fn placement(kind: Kind, args: &Args<'_>, report: &mut Report<'_>) -> Placement {
    let map = match kind {
        Kind::Multmatrix => matrix(args, report),
        Kind::Translate => Some(Affine::translation(args.triple("v", 0.0).map_or(Vec3::ZERO, |(v, _)| v.into()))),
        Kind::Rotate => rotation(args, report),
        Kind::Scale => Some(Affine::scale(match (args.number("v"), args.triple("v", 1.0)) {
            (Some((factor, _)), _) => Vec3::splat(factor),
            (_, Some((factors, _))) => factors.into(),
            _ => Vec3::splat(1.0),
        })),
        Kind::Mirror => mirror(args, report),
        _ => Some(Affine::IDENTITY),
    };
    match map {
        Some(map) => Placement::Moved(map),
        None => Placement::Nowhere,
    }
}

/// Where the numbers are that say how a node moves its children.
pub(super) fn place_of_map(kind: Kind, args: &Args<'_>) -> SourceRange {
    let name = match kind {
        Kind::Multmatrix => "m",
        Kind::Translate | Kind::Rotate | Kind::Scale | Kind::Mirror => "v",
        _ => return args.name_at,
    };
    args.get(name).map_or(args.name_at, |arg| arg.at)
}

/// A warning that a map leaves nothing of what it moves.
pub(super) fn singular(map: &Affine, at: SourceRange) -> Diagnostic {
    let message = if !map.is_finite() {
        "this moves its children to infinity, which leaves nothing of them"
    } else if map.determinant().is_finite() {
        "this flattens its children, which leaves nothing of them"
    } else {
        "these numbers are too large to compute with, which leaves nothing of the children"
    };
    Diagnostic::warning("singular-matrix", at, message)
}

fn matrix(args: &Args<'_>, report: &mut Report<'_>) -> Option<Affine> {
    let Some((rows, at)) = args.rows("m") else {
        if !args.damaged {
            let message = "`multmatrix` needs a matrix";
            report.push(Diagnostic::error("missing-argument", args.name_at, message));
        }
        return None;
    };
    let identity = |i: usize, j: usize| f64::from(u8::from(i == j));
    let entry = |i: usize, j: usize| rows.get(i).and_then(|row| row.get(j)).copied().unwrap_or(identity(i, j));
    let last = [0, 1, 2, 3].map(|j| entry(3, j));
    if last[..3] != [0.0; 3] || last[3] == 0.0 || last[3].is_nan() {
        let place = crate::syntax::element_range(report.text, at, &[3]);
        let wrong = "the last row of the matrix should be [0, 0, 0, 1]: a perspective map is not a transform";
        // OpenSCAD looks at its last number only.
        report.degenerate("not-affine", place, wrong.to_owned(), "its first three numbers are ignored", None);
        if !report.forgives() {
            return None;
        }
    }
    Some(Affine::from_rows([0, 1, 2].map(|i| [0, 1, 2, 3].map(|j| entry(i, j) / last[3]))))
}

/// `rotate([a, b, c])`, `rotate(a)` about z, `rotate(a, v)` about an axis.
fn rotation(args: &Args<'_>, report: &mut Report<'_>) -> Option<Affine> {
    let Some((angle, _)) = args.number("a") else {
        let angles = args.triple("a", 0.0).map_or([0.0; 3], |(angles, _)| angles);
        return Some(Affine::rotation_deg(angles.into()));
    };
    let Some((axis, at)) = args.triple("v", 0.0) else {
        return Some(Affine::rotation_deg(Vec3::new(0.0, 0.0, angle)));
    };
    let map = Affine::rotation_about_deg(axis.into(), angle);
    if map.is_none() {
        report.push(no_direction(at, "the axis"));
    }
    map
}

fn mirror(args: &Args<'_>, report: &mut Report<'_>) -> Option<Affine> {
    let Some((normal, at)) = args.triple("v", 0.0) else { return Affine::mirror(Vec3::X) };
    let map = Affine::mirror(normal.into());
    if map.is_none() {
        report.push(no_direction(at, "the normal of the mirror"));
    }
    map
}

/// A vector that should be a direction is zero or infinite.
pub(super) fn no_direction(at: SourceRange, what: &str) -> Diagnostic {
    Diagnostic::error(
        "no-direction",
        at,
        format!("{what} has no direction: all its numbers are zero, or one is not finite"),
    )
}
