//! Solids that are an outline between two heights: upright prisms, blocks and cylinders, and what is cut out of them from
//! bottom to top.

use super::SpaceError;
use super::fold::fold;
use crate::Tolerance;
use crate::plane::{Affine2, Outline, combine};
use octrace::{Affine, BoolOp, Primitive, Profile, Solid, Vec2};

/// Heights that differ by less than this share of them are the same, and so are directions: files have six digits.
const LEVEL: f64 = 2e-6;

/// An outline between two heights.
#[derive(Clone, Debug)]
pub(super) struct Slab {
    pub outline: Outline,
    pub low: f64,
    pub high: f64,
}

impl Slab {
    /// The solid as a slab; `None` where it is none. Ellipses become polygons within the tolerance.
    ///
    /// # Errors
    /// If outlines have too many edges to be combined.
    pub fn new(solid: &Solid, tolerance: Tolerance) -> Result<Option<Self>, SpaceError> {
        fold(
            solid,
            |primitive, map| Ok(Self::of_primitive(primitive, map, tolerance)),
            |op, slabs: Vec<Result<Option<Self>, SpaceError>>| {
                let slabs: Option<Vec<Self>> = slabs.into_iter().collect::<Result<_, _>>()?;
                slabs.map_or(Ok(None), |slabs| Self::combined(op, &slabs))
            },
        )
    }

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

    fn combined(op: BoolOp, slabs: &[Self]) -> Result<Option<Self>, SpaceError> {
        let Some(first) = slabs.first() else { return Ok(None) };
        let same = |a: f64, b: f64| (a - b).abs() <= LEVEL * (first.high - first.low);
        let (mut low, mut high) = (first.low, first.high);
        let fits = |slab: &Self| match op {
            BoolOp::Union => same(slab.low, low) && same(slab.high, high),
            BoolOp::Difference => {
                (slab.low <= low || same(slab.low, low)) && (slab.high >= high || same(slab.high, high))
            }
            BoolOp::Intersection => true,
        };
        if !slabs[1..].iter().all(fits) {
            return Ok(None);
        }
        if op == BoolOp::Intersection {
            low = slabs.iter().map(|slab| slab.low).fold(low, f64::max);
            high = slabs.iter().map(|slab| slab.high).fold(high, f64::min);
            if low >= high {
                return Ok(None);
            }
        }
        let outlines: Vec<&Outline> = slabs.iter().map(|slab| &slab.outline).collect();
        Ok(Some(Self { outline: combine(op, &outlines)?, low, high }))
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
