//! Planes.

use super::{CellBox, Crossings, Side};
use crate::geom::{Ray, Vec3};

/// The plane `normal . p = offset`; inside is where `normal . p < offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal, pointing outside.
    pub normal: Vec3,
    /// Distance from the origin along the normal.
    pub offset: f64,
}

impl Plane {
    /// See [`Surface::crossings`](super::Surface::crossings). A line in the plane is outside.
    pub fn crossings(&self, ray: &Ray) -> Crossings {
        let height = self.normal.dot(ray.origin) - self.offset;
        let slope = self.normal.dot(ray.direction);
        if slope == 0.0 { Crossings::none(height < 0.0) } else { Crossings::one(slope > 0.0, -height / slope) }
    }

    /// See [`Surface::classify`](super::Surface::classify).
    pub fn classify(&self, cell: &CellBox) -> Side {
        let height = self.normal.dot(cell.center) - self.offset;
        let reach = self.normal.abs().dot(cell.half);
        if height >= reach {
            Side::Outside
        } else if height <= -reach {
            Side::Inside
        } else {
            Side::Crossing
        }
    }
}
