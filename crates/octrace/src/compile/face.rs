//! Faces of primitives, where they stand: what wants a surface.

use crate::geom::{Affine, Bounds, Vec3};
use crate::surface::{Plane, QuadricKind, TorusKind};

/// A face that wants a surface.
#[derive(Clone, Debug)]
pub(super) enum Face {
    /// A plane, with some corners of the face in it.
    Plane { plane: Plane, corners: [Vec3; 4] },
    /// A plane without an end.
    Unbounded { plane: Plane },
    /// A quadric patch; `map` takes the unit quadric to the scene, the patch lies between the two local heights.
    Quadric { kind: QuadricKind, map: Affine, to_local: Affine, heights: (f64, f64) },
    /// A torus; `map` takes its own coordinates to the scene.
    Torus { kind: TorusKind, minor: f64, map: Affine, to_local: Affine },
}

/// The corners of a regular pentagon. Five points fix a conic.
const FIVE: [(f64, f64); 5] = [
    (1.0, 0.0),
    (0.309_016_994_374_947_45, 0.951_056_516_295_153_5),
    (-0.809_016_994_374_947_3, 0.587_785_252_292_473_2),
    (-0.809_016_994_374_947_6, -0.587_785_252_292_472_9),
    (0.309_016_994_374_947_23, -0.951_056_516_295_153_6),
];

impl Face {
    /// Points of the face that fix its surface, in `room` if not in the face itself: another surface near all of them is the
    /// same.
    pub fn samples<'a>(&'a self, room: &'a mut Vec<Vec3>) -> &'a [Vec3] {
        room.clear();
        match self {
            Self::Plane { corners, .. } => return corners,
            Self::Unbounded { .. } => {}
            Self::Quadric { kind: QuadricKind::Sphere, map, .. } => {
                const H: f64 = std::f64::consts::FRAC_1_SQRT_2;
                let local = [
                    Vec3::X,
                    -Vec3::X,
                    Vec3::Y,
                    -Vec3::Y,
                    Vec3::Z,
                    -Vec3::Z,
                    Vec3::new(H, H, 0.0),
                    Vec3::new(H, 0.0, H),
                    Vec3::new(0.0, H, H),
                ];
                room.extend(local.map(|p| map.point(p)));
            }
            Self::Quadric { kind, map, heights, .. } => {
                // Five points fix the conic, three more the direction.
                let radius = |z: f64| if *kind == QuadricKind::Cone { z.abs() } else { 1.0 };
                let at = |(x, y): (f64, f64), z: f64| map.point(Vec3::new(x * radius(z), y * radius(z), z));
                let (low, high) = *heights;
                room.extend(FIVE.iter().map(|&p| at(p, low)).chain([0, 2, 3].map(|i| at(FIVE[i], high))));
            }
            Self::Torus { kind, minor, map, .. } => {
                let around = |(c, s): (f64, f64)| {
                    let tube = match kind {
                        TorusKind::Outer => [(1.0 + minor, 0.0), (1.0, *minor), (1.0, -minor), (1.0 - minor, 0.0)],
                        TorusKind::Inner => {
                            let (radius, tip) = (minor - 1.0, ((minor - 1.0) * (minor + 1.0)).sqrt());
                            // At a third of the height the radius is this.
                            let third = ((minor * minor) - tip * tip / 9.0).sqrt() - 1.0;
                            [(radius, 0.0), (third, tip / 3.0), (third, -tip / 3.0), (0.0, tip)]
                        }
                    };
                    // Of a spindle, what is beyond the axis is no part of the surface.
                    let tube = tube.into_iter().filter(|(radius, _)| *radius > 0.0);
                    tube.map(move |(radius, z)| map.point(Vec3::new(c * radius, s * radius, z)))
                };
                room.extend(FIVE.into_iter().flat_map(around));
            }
        }
        room
    }

    /// A length for "the larger face first". `samples` are its [`samples`](Self::samples).
    pub fn size(&self, samples: &[Vec3]) -> f64 {
        match self {
            Self::Unbounded { .. } => f64::INFINITY,
            _ => Bounds::around(samples.iter().copied()).diagonal(),
        }
    }
}
