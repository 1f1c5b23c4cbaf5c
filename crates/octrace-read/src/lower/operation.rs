//! What a node does with its children, as its arguments have it.

use super::args::Args;
use super::facets;
use super::language::Kind;
use super::operand::Dimension;
use super::report::Report;
use super::shapes::is_positive;
use crate::Facets;
use crate::diagnostic::Diagnostic;
use crate::syntax::View;
use octrace::{Vec2, Vec3};
use octrace_forms::plane::Offset;
use octrace_forms::sweep::{LinearExtrude, RotateExtrude};

/// What a node does with its children.
#[derive(Clone, Debug)]
pub(super) enum Operation {
    Unite,
    Subtract,
    Intersect,
    LinearExtrude(LinearExtrude),
    RotateExtrude(RotateExtrude),
    Offset(Offset),
    Fill,
    Hull,
    Minkowski,
    Resize(Resize),
    /// Onto z = 0: the shadow, or what the plane cuts.
    Project {
        cut: bool,
    },
    /// Nothing comes of the children. That was said.
    Drop,
    /// It is left out. That was said.
    LeaveOut,
}

/// New extents, by axis; zero keeps an axis as it is, unless it is `auto`: then it grows with the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Resize {
    pub size: [f64; 3],
    pub auto: [bool; 3],
}

impl Operation {
    /// What the node does, with its arguments checked.
    pub fn of(kind: Kind, args: &Args<'_>, mode: Facets, report: &mut Report<'_>) -> Self {
        match kind {
            Kind::Difference => Self::Subtract,
            Kind::Intersection => Self::Intersect,
            Kind::LinearExtrude => linear(args, mode, report).map_or(Self::Drop, Self::LinearExtrude),
            Kind::RotateExtrude => rotate(args, mode),
            Kind::Offset => offset(args, mode),
            Kind::Fill => Self::Fill,
            Kind::Hull => Self::Hull,
            Kind::Minkowski => Self::Minkowski,
            Kind::Resize => Self::Resize(resize(args)),
            Kind::Projection => Self::Project { cut: args.flag("cut") },
            Kind::Unsupported(_) => Self::LeaveOut,
            _ => Self::Unite,
        }
    }

    /// The dimension that its children must have, if it is not for the first of them to say.
    pub fn takes(&self) -> Option<Dimension> {
        match self {
            Self::LinearExtrude(_) | Self::RotateExtrude(_) | Self::Offset(_) | Self::Fill => Some(Dimension::Two),
            Self::Project { .. } => Some(Dimension::Three),
            _ => None,
        }
    }
}

fn linear(args: &Args<'_>, mode: Facets, report: &mut Report<'_>) -> Option<LinearExtrude> {
    // Newer versions of OpenSCAD can sweep along a direction, as far as the height says, or else as long as it is.
    let (length, along, at) = match (args.number("height"), args.triple("v", 0.0)) {
        (Some((height, at)), None) => (height, [0.0, 0.0, height], at),
        (Some((height, at)), Some((v, _))) => {
            let unit = Vec3::from(v).normalized().unwrap_or(Vec3::Z);
            (height, (unit * height).to_array(), at)
        }
        (None, Some((v, at))) => (Vec3::from(v).length(), v, at),
        (None, None) => (100.0, [0.0, 0.0, 100.0], args.name_at),
    };
    let [x, y, height] = along;
    is_positive(length, at, "height-not-positive", "height of an extrusion", "the extrusion is empty", report)?;
    is_positive(height, at, "height-not-positive", "height of an extrusion", "the extrusion is empty", report)?;
    let scale = match (args.number("scale"), args.numbers("scale")) {
        (Some((both, _)), _) => [both; 2],
        (None, Some((&[x, y, ..], _))) => [x, y],
        _ => [1.0; 2],
    };
    // OpenSCAD takes what is not a number of times larger for a point.
    let scale = scale.map(|s| if s.is_finite() { s.max(0.0) } else { 1.0 });
    let twist = args.number("twist").map_or(0.0, |(twist, _)| if twist.is_finite() { twist } else { 0.0 });
    let slices = args.number("slices").map(|(slices, _)| slices.max(1.0) as u32);
    Some(LinearExtrude {
        height,
        base: if args.flag("center") { -0.5 * height } else { 0.0 },
        lean: Vec2::new(x / height, y / height),
        twist_deg: twist,
        scale,
        slices,
        written: facets::meant(mode, args),
    })
}

fn rotate(args: &Args<'_>, mode: Facets) -> Operation {
    let finite = |name: &str| args.number(name).map(|(v, _)| v).filter(|v| v.is_finite());
    let angle_deg = finite("angle").unwrap_or(360.0);
    Operation::RotateExtrude(RotateExtrude {
        angle_deg,
        start_deg: finite("start").unwrap_or(0.0),
        written: facets::meant(mode, args),
    })
}

fn offset(args: &Args<'_>, mode: Facets) -> Operation {
    let number = |name: &str| args.number(name).map(|(v, _)| v).filter(|v| v.is_finite());
    Operation::Offset(match (number("r"), number("delta")) {
        (Some(r), _) => Offset::Round { r, facets: facets::around(mode, args, r.abs()) },
        (None, Some(delta)) => Offset::Delta { delta, chamfer: args.flag("chamfer") },
        (None, None) => Offset::Round { r: 1.0, facets: facets::around(mode, args, 1.0) },
    })
}

fn resize(args: &Args<'_>) -> Resize {
    let size = match (args.number("newsize"), args.triple("newsize", 0.0)) {
        (Some((x, _)), _) => [x, 0.0, 0.0],
        (_, Some((size, _))) => size,
        _ => [0.0; 3],
    };
    let auto = match args.view("auto") {
        Some(View::Bool(all)) => [all; 3],
        Some(View::Number(all)) => [all != 0.0; 3],
        Some(View::Numbers(flags)) => [0, 1, 2].map(|i| flags.get(i).is_some_and(|&flag| flag != 0.0)),
        Some(View::List(flags)) => {
            [0, 1, 2].map(|i| flags.get(i).is_some_and(|&flag| matches!(args.look(flag), View::Bool(true))))
        }
        _ => [false; 3],
    };
    // OpenSCAD ignores what is not a size.
    Resize { size: size.map(|s| if s.is_finite() { s.max(0.0) } else { 0.0 }), auto }
}

/// A warning that something in the plane is where only solids count, or the other way round.
pub(super) fn misfit(found: Dimension, at: crate::SourceRange, around: &str) -> Diagnostic {
    let wanted = match found {
        Dimension::Two => Dimension::Three,
        Dimension::Three => Dimension::Two,
    };
    let message =
        format!("this is {}, but `{around}` goes on with what is {}: it is ignored", found.word(), wanted.word());
    let help = match found {
        Dimension::Two => "a flat shape becomes solid by `linear_extrude` or `rotate_extrude`",
        Dimension::Three => "a solid becomes flat by `projection`",
    };
    Diagnostic::warning("mixed-dimensions", at, message).with_help(help)
}
