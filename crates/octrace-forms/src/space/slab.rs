//! Solids that are an outline between two heights: upright prisms, blocks and cylinders, and what is cut out of them from
//! bottom to top. What is cut out of them from above or below leaves several, one above the other.

use super::SpaceError;
use super::fold::fold;
use crate::Tolerance;
use crate::plane::{Affine2, Outline, combine};
use octrace::{Affine, BoolOp, Primitive, Profile, Solid, Vec2};

/// Heights that differ by less than this share of them are the same, and so are directions: files have six digits.
const LEVEL: f64 = 2e-6;

/// So many heights are told apart at most.
const MOST: usize = 100;

/// An outline between two heights.
#[derive(Clone, Debug)]
pub(super) struct Slab {
    pub outline: Outline,
    pub low: f64,
    pub high: f64,
}

/// The solid as slabs one above the other; `None` where it is none. Ellipses become polygons within the tolerance.
///
/// # Errors
/// If outlines have too many edges to be combined.
pub(super) fn slabs(solid: &Solid, tolerance: Tolerance) -> Result<Option<Vec<Slab>>, SpaceError> {
    fold(
        solid,
        |primitive, map| Ok(Slab::of_primitive(primitive, map, tolerance).map(|slab| vec![slab])),
        |op, operands: Vec<Result<Option<Vec<Slab>>, SpaceError>>| {
            let operands: Option<Vec<Vec<Slab>>> = operands.into_iter().collect::<Result<_, _>>()?;
            operands.map_or(Ok(None), |operands| combined(op, &operands))
        },
    )
}

/// What is between one height and the next, for all heights at which an operand begins or ends; `None` where these are many.
fn combined(op: BoolOp, operands: &[Vec<Slab>]) -> Result<Option<Vec<Slab>>, SpaceError> {
    let mut heights: Vec<f64> = operands.iter().flatten().flat_map(|slab| [slab.low, slab.high]).collect();
    heights.sort_unstable_by(f64::total_cmp);
    let (Some(lowest), Some(highest)) = (heights.first(), heights.last()) else { return Ok(Some(Vec::new())) };
    let same = LEVEL * (highest - lowest);
    heights.dedup_by(|height, kept| *height - *kept <= same);
    if heights.len() > MOST {
        return Ok(None);
    }
    let mut slabs: Vec<Slab> = Vec::new();
    for ends in heights.windows(2) {
        let (low, high) = (ends[0], ends[1]);
        let middle = 0.5 * (low + high);
        let at_middle = |slabs: &Vec<Slab>| slabs.iter().find(|slab| slab.low < middle && middle < slab.high).cloned();
        let outlines: Vec<Outline> =
            operands.iter().map(|slabs| at_middle(slabs).map_or(Outline::EMPTY, |slab| slab.outline)).collect();
        let outline = combine(op, &outlines.iter().collect::<Vec<&Outline>>())?;
        match slabs.last_mut() {
            _ if outline.is_empty() => {}
            Some(below) if below.high == low && below.outline == outline => below.high = high,
            _ => slabs.push(Slab { outline, low, high }),
        }
    }
    Ok(Some(slabs))
}

impl Slab {
    fn of_primitive(primitive: &Primitive, map: &Affine, tolerance: Tolerance) -> Option<Self> {
        let upright = |v: octrace::Vec3| v.x.abs().max(v.y.abs()) <= LEVEL * v.length();
        let level = |v: octrace::Vec3| v.z.abs() <= LEVEL * v.length();
        if !(upright(map.column(2)) && level(map.column(0)) && level(map.column(1))) {
            return None;
        }
        let outline = match primitive {
            Primitive::Block => Outline::rectangle(Vec2::ZERO, Vec2::new(1.0, 1.0)),
            Primitive::Cylinder => Outline::circle(1.0),
            Primitive::Prism { profile, top: 1.0 } => Outline { contours: profile.contours().to_vec() },
            _ => return None,
        };
        let ends = [map.translation.z, map.translation.z + map.column(2).z];
        Some(Self {
            outline: outline.moved(&Affine2::of_space(map), tolerance),
            low: ends[0].min(ends[1]),
            high: ends[0].max(ends[1]),
        })
    }

    /// The Minkowski sum.
    pub fn plus(&self, other: &Self, tolerance: Tolerance) -> Result<Self, SpaceError> {
        let outline = self.outline.minkowski(&other.outline, tolerance)?;
        Ok(Self { outline, low: self.low + other.low, high: self.high + other.high })
    }

    pub fn solid(self) -> Solid {
        prism(self.outline, self.low, self.high)
    }
}

/// What is above an outline between two heights.
pub(super) fn prism(outline: Outline, low: f64, high: f64) -> Solid {
    let Ok(profile) = Profile::new(outline.contours) else { return Solid::empty() };
    Solid::prism(profile).scale([1.0, 1.0, high - low]).translate([0.0, 0.0, low])
}
