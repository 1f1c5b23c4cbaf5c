//! What a node is to the operation around it, and how operands are combined.

use crate::SourceRange;
use octrace::{BoolOp, PartId, Solid, Vec3};
use octrace_forms::plane::Flat;

/// What a node is to the operation around it.
#[derive(Clone, Debug)]
pub(super) enum Operand {
    /// A solid.
    Solid(Made),
    /// A shape in the plane z = 0.
    Flat(Flat),
    /// The corners of a surface that bounds no solid. They count for a hull, and are nothing to all else.
    Corners(Vec<Vec3>),
    /// Nothing, and meant to be.
    Empty,
    /// Something that cannot be rendered.
    LeftOut,
}

/// A solid, and what is known of its leaves.
#[derive(Clone, Debug)]
pub(super) struct Made {
    pub solid: Solid,
    /// The part of the first leaf that has one.
    pub first_part: Option<PartId>,
    /// Whether there are leaves that belong to no part yet.
    pub bare: bool,
}

impl Made {
    /// A solid with nothing but leaves that belong to no part yet.
    pub fn bare(solid: Solid) -> Self {
        Self { solid, first_part: None, bare: true }
    }

    /// With its bare leaves put into `part`.
    pub fn part(self, part: PartId) -> Self {
        let first_part = self.first_part.or(Some(part));
        let solid = if self.bare { self.solid.part(part) } else { self.solid };
        Self { solid, first_part, bare: false }
    }
}

/// How many dimensions a shape has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dimension {
    Two,
    Three,
}

impl Dimension {
    /// In OpenSCAD's words.
    pub fn word(self) -> &'static str {
        match self {
            Self::Two => "2-D",
            Self::Three => "3-D",
        }
    }
}

impl Operand {
    /// How many dimensions it has, if it is anything.
    pub fn dimension(&self) -> Option<Dimension> {
        match self {
            Self::Solid(_) | Self::Corners(_) => Some(Dimension::Three),
            Self::Flat(_) => Some(Dimension::Two),
            Self::Empty | Self::LeftOut => None,
        }
    }
}

/// The operands of a node, and where each is written.
pub(super) type Operands = Vec<(SourceRange, Operand)>;

/// Combines operands of one dimension. Without any, it is left out if some operand is.
pub(super) fn combine(op: BoolOp, mut operands: Operands) -> Operand {
    if operands.len() == 1 {
        return operands.pop().map_or(Operand::Empty, |(_, only)| only);
    }
    let left_out = operands.iter().any(|(_, o)| matches!(o, Operand::LeftOut));
    let (mut first_part, mut bare) = (None, false);
    let mut solids = Vec::with_capacity(operands.len());
    let mut flats = Vec::new();
    for (_, operand) in operands {
        match operand {
            Operand::Solid(made) => {
                first_part = first_part.or(made.first_part);
                bare |= made.bare;
                solids.push(made.solid);
            }
            Operand::Flat(flat) => flats.push(flat),
            Operand::Corners(_) | Operand::Empty | Operand::LeftOut => {}
        }
    }
    if !solids.is_empty() {
        Operand::Solid(Made { solid: Solid::combine(op, solids), first_part, bare })
    } else if !flats.is_empty() {
        Operand::Flat(Flat::combined(op, flats))
    } else if left_out {
        Operand::LeftOut
    } else {
        Operand::Empty
    }
}
