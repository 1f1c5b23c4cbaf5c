//! What becomes of a node when its children are known.

use super::operand::{Made, Operand, Operands, combine};
use super::operation::{Operation, Resize, misfit};
use super::transforms::{Placement, singular};
use super::walk::{Frame, Walk};
use crate::SourceRange;
use crate::diagnostic::Diagnostic;
use octrace::model::Node;
use octrace::{BoolOp, Solid, Vec2, Vec3};
use octrace_forms::Tolerance;
use octrace_forms::plane::{self, Affine2, Flat, PlaneError};
use octrace_forms::space::{self, SpaceError};
use octrace_forms::sweep::{self, SweepError};

impl<'a> Walk<'a, '_> {
    /// Combines what the children of a node are.
    pub(super) fn leave(&mut self, frame: Frame<'a>) -> Operand {
        let Frame { node, operation, operands, look, new_look, placement, placement_at, in_hull, .. } = frame;
        let at = node.map_or(SourceRange::default(), |node| self.ast.name_at(node));
        let tolerance = self.options.tolerance;
        let operands = self.of_one_dimension(node.map_or("the file", |node| self.ast.name(node)), &operation, operands);
        let combined = match operation {
            Operation::LeaveOut => return Operand::LeftOut,
            Operation::Drop => return Operand::Empty,
            Operation::Subtract => self.difference(at, operands, look.is_plain()),
            Operation::Intersect => self.intersection(at, operands),
            Operation::Unite => combine(BoolOp::Union, operands),
            Operation::Hull => self.settled(hull(operands, tolerance), at),
            Operation::Minkowski => self.settled(minkowski(operands, tolerance), at),
            other => match combine(BoolOp::Union, operands) {
                Operand::Flat(flat) => self.settled(on_flat(&other, flat, tolerance), at),
                Operand::Solid(made) => self.settled(on_solid(&other, made, tolerance), at),
                nothing => nothing,
            },
        };
        let placed = self.placed(combined, placement, placement_at, in_hull);
        match (placed, node) {
            (Operand::Solid(made), Some(node)) if new_look && made.bare => {
                let part = self.parts.of(look.material(), self.ast.name_at(node));
                Operand::Solid(made.part(part))
            }
            (placed, _) => placed,
        }
    }

    /// Operations go on with what has the dimension that they take, or else that of their first operand; the rest becomes
    /// nothing.
    fn of_one_dimension(&mut self, name: &str, operation: &Operation, mut operands: Operands) -> Operands {
        let first = || operands.iter().find_map(|(_, operand)| operand.dimension());
        let Some(wanted) = operation.takes().or_else(first) else { return operands };
        for (at, operand) in &mut operands {
            if let Some(found) = operand.dimension()
                && found != wanted
            {
                self.report.push(misfit(found, *at, name));
                *operand = Operand::Empty;
            }
        }
        operands
    }

    fn difference(&mut self, at: SourceRange, operands: Operands, is_plain: bool) -> Operand {
        let wall = match operands.first() {
            // The wall of a hole drilled into red plastic is red.
            Some((_, Operand::Solid(first))) => first.first_part.filter(|_| is_plain),
            Some((_, Operand::Flat(_))) => None,
            Some((_, Operand::LeftOut)) => {
                self.consequence(at, "the first operand of this difference is left out, and so is all of it");
                return Operand::LeftOut;
            }
            Some((_, Operand::Empty | Operand::Corners(_))) | None => return Operand::Empty,
        };
        let paint = |(i, (at, operand))| match (operand, wall) {
            (Operand::Solid(tool), Some(part)) if i > 0 => (at, Operand::Solid(tool.part(part))),
            (operand, _) => (at, operand),
        };
        combine(BoolOp::Difference, operands.into_iter().enumerate().map(paint).collect())
    }

    fn intersection(&mut self, at: SourceRange, operands: Operands) -> Operand {
        if operands.is_empty() || operands.iter().any(|(_, o)| matches!(o, Operand::Empty)) {
            return Operand::Empty;
        }
        if operands.iter().any(|(_, o)| matches!(o, Operand::LeftOut)) {
            self.consequence(at, "an operand of this intersection is left out; it is that of the others");
        }
        combine(BoolOp::Intersection, operands)
    }

    /// What came of an operation, or a word about why nothing did.
    fn settled(&mut self, outcome: Result<Operand, OperationError>, at: SourceRange) -> Operand {
        let error = match outcome {
            Ok(Operand::Solid(made)) if matches!(made.solid.node(), Node::Empty) => return Operand::Empty,
            Ok(Operand::Flat(flat)) if flat.is_empty() => return Operand::Empty,
            Ok(operand) => return operand,
            Err(error) => error,
        };
        if let OperationError::Sweep(SweepError::AcrossAxis { .. }) = error {
            // OpenSCAD says so, and goes on without.
            let help = "move it to one side, or intersect it with a square on one side".to_owned();
            self.report.degenerate("across-axis", at, error.to_string(), "it is left out", Some(help));
        } else {
            self.report.push(failed(&error, at));
        }
        Operand::Empty
    }

    fn placed(&mut self, operand: Operand, placement: Placement, at: SourceRange, in_hull: bool) -> Operand {
        let Placement::Moved(map) = placement else { return Operand::Empty };
        match operand {
            Operand::Corners(corners) if map.is_finite() => {
                Operand::Corners(corners.into_iter().map(|corner| map.point(corner)).collect())
            }
            // A hull takes what is flattened for what it still is: a surface.
            Operand::Solid(made) if in_hull && map.is_finite() && map.inverse().is_none() => {
                let surface = space::mesh(&made.solid, self.options.tolerance).map_err(OperationError::from);
                let corners = |mesh: space::TriangleMesh| mesh.points.into_iter().map(|p| map.point(p)).collect();
                self.settled(surface.map(|mesh| Operand::Corners(corners(mesh))), at)
            }
            Operand::Solid(made) if map.inverse().is_some() => {
                Operand::Solid(Made { solid: made.solid.transform(map), ..made })
            }
            Operand::Flat(flat) => {
                let flat_map = Affine2::of_space(&map);
                if flat_map.inverse().is_some() {
                    return Operand::Flat(flat.moved(flat_map));
                }
                self.report.push(singular(&map, at));
                Operand::Empty
            }
            Operand::Solid(_) => {
                self.report.push(singular(&map, at));
                Operand::Empty
            }
            nothing => nothing,
        }
    }

    /// Leaving something out changes something else.
    fn consequence(&mut self, at: SourceRange, message: &str) {
        if self.options.skip_unsupported {
            self.report.push(Diagnostic::warning("left-out-operand", at, message));
        }
    }
}

/// The word about it.
pub(super) fn failed(error: &OperationError, at: SourceRange) -> Diagnostic {
    Diagnostic::error("operation-failed", at, format!("this cannot be made: {error}"))
}

/// Why an operation could not be done.
#[derive(Debug, thiserror::Error)]
pub(super) enum OperationError {
    #[error(transparent)]
    Sweep(#[from] SweepError),
    #[error(transparent)]
    Plane(#[from] PlaneError),
    #[error(transparent)]
    Space(#[from] SpaceError),
}

fn hull(operands: Operands, tolerance: Tolerance) -> Result<Operand, OperationError> {
    let loose: Vec<Vec3> = operands.iter().filter_map(|(_, o)| corners(o)).flatten().copied().collect();
    let (solids, flats) = sorted(operands);
    if !solids.is_empty() || !loose.is_empty() {
        return Ok(bare(space::hull_with_corners(&solids, &loose, tolerance)?));
    }
    let outlines = flats.iter().map(|flat| flat.outline(tolerance)).collect::<Result<Vec<_>, _>>()?;
    Ok(Operand::Flat(plane::hull(outlines.iter().map(|outline| &**outline)).into()))
}

fn minkowski(operands: Operands, tolerance: Tolerance) -> Result<Operand, OperationError> {
    let lacks_one = operands.iter().any(|(_, o)| matches!(o, Operand::Empty));
    let (mut solids, flats) = sorted(operands);
    if !solids.is_empty() {
        let sum = space::minkowski(&solids, tolerance)?;
        let count = solids.len();
        if matches!(sum.node(), Node::Empty) {
            // OpenSCAD leaves out what turns out to be empty.
            solids.retain(|solid| !space::tight_bounds(solid).is_ok_and(|bounds| bounds.is_empty()));
        }
        let again = solids.len() < count && !solids.is_empty();
        return Ok(bare(if again { space::minkowski(&solids, tolerance)? } else { sum }));
    }
    // In the plane the sum with nothing is nothing.
    let Some((first, others)) = flats.split_first().filter(|_| !lacks_one) else { return Ok(Operand::Empty) };
    let mut sum = first.outline(tolerance)?.as_ref().clone();
    for other in others {
        sum = sum.minkowski(&*other.outline(tolerance)?, tolerance)?;
    }
    Ok(Operand::Flat(sum.into()))
}

fn on_flat(operation: &Operation, flat: Flat, tolerance: Tolerance) -> Result<Operand, OperationError> {
    let outline = || flat.outline(tolerance);
    Ok(Operand::Flat(match operation {
        Operation::LinearExtrude(how) => return Ok(bare(sweep::linear_extrude(&flat, how, tolerance)?)),
        Operation::RotateExtrude(how) => return Ok(bare(sweep::rotate_extrude(&flat, how, tolerance)?)),
        Operation::Offset(by) => outline()?.offset(*by)?.into(),
        Operation::Fill => outline()?.filled()?.into(),
        Operation::Resize(Resize { size: [x, y, _], auto: [auto_x, auto_y, _] }) => {
            flat.resized(Vec2::new(*x, *y), [*auto_x, *auto_y], tolerance)?
        }
        _ => flat,
    }))
}

fn on_solid(operation: &Operation, made: Made, tolerance: Tolerance) -> Result<Operand, OperationError> {
    Ok(match operation {
        Operation::Project { cut: true } => Operand::Flat(space::section(&made.solid, tolerance)?),
        Operation::Project { cut: false } => Operand::Flat(space::shadow(&made.solid, tolerance)?),
        Operation::Resize(Resize { size, auto }) => {
            let solid = space::resize(&made.solid, (*size).into(), *auto)?;
            Operand::Solid(Made { solid, ..made })
        }
        _ => Operand::Solid(made),
    })
}

/// A flat shape as OpenSCAD's preview shows it: a plate of height 1, half of it below the plane.
pub(super) fn plate(flat: &Flat, tolerance: Tolerance) -> Result<Solid, OperationError> {
    let how = sweep::LinearExtrude {
        height: 1.0,
        base: -0.5,
        lean: Vec2::ZERO,
        twist_deg: 0.0,
        scale: [1.0; 2],
        slices: None,
        written: None,
    };
    Ok(sweep::linear_extrude(flat, &how, tolerance)?)
}

fn bare(solid: Solid) -> Operand {
    Operand::Solid(Made::bare(solid))
}

fn corners(operand: &Operand) -> Option<&Vec<Vec3>> {
    match operand {
        Operand::Corners(corners) => Some(corners),
        _ => None,
    }
}

fn sorted(operands: Operands) -> (Vec<Solid>, Vec<Flat>) {
    let (mut solids, mut flats) = (Vec::new(), Vec::new());
    for (_, operand) in operands {
        match operand {
            Operand::Solid(made) => solids.push(made.solid),
            Operand::Flat(flat) => flats.push(flat),
            Operand::Corners(_) | Operand::Empty | Operand::LeftOut => {}
        }
    }
    (solids, flats)
}
