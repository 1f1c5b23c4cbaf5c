//! Where light comes from.

use super::Rgb;
use crate::geom::Vec3;

/// A light source. Its intensity does not fall off with distance [Comba-Persiano, §2.3].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Shines from one point in all directions.
    Point {
        /// Where it stands, in scene units.
        position: Vec3,
        /// Linear colour times strength.
        intensity: Rgb,
    },
    /// Shines from infinitely far away.
    Directional {
        /// The way the light travels; any non-zero length.
        direction: Vec3,
        /// Linear colour times strength.
        intensity: Rgb,
    },
}
