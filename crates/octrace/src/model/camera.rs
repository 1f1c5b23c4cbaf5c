//! From film to rays.

use crate::geom::{Ray, Vec3, sin_cos_deg};

/// How space is projected on the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Rays leave the eye; `fov_deg` is the angle of view from the film's lower to its upper edge, in degrees.
    Perspective {
        /// Vertical angle of view in degrees, between 0 and 180.
        fov_deg: f64,
    },
    /// Parallel rays; `height` is what the film's height covers, in scene units.
    Orthographic {
        /// Height of the view in scene units.
        height: f64,
    },
}

/// An eye, what it looks at, and a projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the eye is.
    pub eye: Vec3,
    /// The point in the middle of the picture.
    pub at: Vec3,
    /// The direction that is up in the picture, roughly; need not be perpendicular to the view.
    pub up: Vec3,
    /// How space is projected.
    pub projection: Projection,
}

impl Camera {
    /// OpenSCAD's vertical angle of view.
    pub const OPENSCAD_FOV_DEG: f64 = 22.5;

    /// Right-handed frame `(right, up, forward)` of unit vectors. Where `up` does not tell (it is parallel to the view),
    /// y is up, and if that is parallel too, z; an eye that is where it looks to, or is nowhere, looks along +y.
    pub fn frame(&self) -> (Vec3, Vec3, Vec3) {
        let forward = (self.at - self.eye).normalized().filter(|f| f.is_finite()).unwrap_or(Vec3::Y);
        let right = [self.up, Vec3::Y, Vec3::Z]
            .into_iter()
            .filter_map(Vec3::normalized)
            .map(|up| forward.cross(up))
            .find(|right| right.length() > 1e-9)
            .and_then(Vec3::normalized)
            .unwrap_or(Vec3::X);
        (right, right.cross(forward), forward)
    }

    /// What [`CameraRays`] needs to answer for a film of `width_px` by `height_px` pixels.
    pub fn rays(&self, width_px: u32, height_px: u32) -> CameraRays {
        let (right, up, forward) = self.frame();
        let (half_height, orthographic) = match self.projection {
            Projection::Perspective { fov_deg } => {
                let (s, c) = sin_cos_deg(fov_deg / 2.0);
                (s / c, false)
            }
            Projection::Orthographic { height } => (height / 2.0, true),
        };
        let per_pixel = 2.0 * half_height / f64::from(height_px);
        CameraRays {
            eye: self.eye,
            forward,
            right: right * per_pixel,
            down: -up * per_pixel,
            center: (f64::from(width_px) / 2.0, f64::from(height_px) / 2.0),
            orthographic,
        }
    }
}

/// The rays through the pixels of one film.
#[derive(Clone, Copy, Debug)]
pub struct CameraRays {
    pub(crate) eye: Vec3,
    /// Of unit length.
    pub(crate) forward: Vec3,
    /// From a pixel to the next in its row, at distance 1 if rays spread.
    pub(crate) right: Vec3,
    /// From a pixel to the next in its column.
    pub(crate) down: Vec3,
    /// The film's middle, in pixels.
    pub(crate) center: (f64, f64),
    pub(crate) orthographic: bool,
}

impl CameraRays {
    /// The ray through the point `(x, y)` of the film, in pixels from its upper left corner; a pixel's middle is at
    /// `+0.5`. The direction has unit length, so `t` is a distance: from the eye, or from the plane through the eye where
    /// the projection is orthographic.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let offset = self.right * (x - self.center.0) + self.down * (y - self.center.1);
        if self.orthographic {
            Ray { origin: self.eye + offset, direction: self.forward }
        } else {
            let direction = self.forward + offset;
            Ray { origin: self.eye, direction: direction / direction.length() }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRONT: Camera = Camera {
        eye: Vec3::new(0.0, -10.0, 0.0),
        at: Vec3::ZERO,
        up: Vec3::Z,
        projection: Projection::Perspective { fov_deg: 90.0 },
    };

    #[test]
    fn the_middle_of_the_film_looks_at_the_target() {
        let rays = FRONT.rays(640, 480);
        assert_eq!(rays.ray(320.0, 240.0), Ray::new([0.0, -10.0, 0.0], [0.0, 1.0, 0.0]));
    }

    #[test]
    fn the_upper_edge_is_half_the_angle_away_and_right_is_right() {
        let top = FRONT.rays(640, 480).ray(320.0, 0.0).direction;
        assert!((top.z - top.y).abs() < 1e-15, "45 degrees up: {top:?}");
        assert!(FRONT.rays(640, 480).ray(640.0, 240.0).direction.x > 0.0);
    }

    #[test]
    fn an_eye_that_is_nowhere_still_has_a_frame() {
        let nowhere = Camera { eye: Vec3::splat(f64::NAN), ..FRONT };
        assert_eq!(nowhere.frame(), (Vec3::X, Vec3::Z, Vec3::Y));
    }

    #[test]
    fn looking_straight_down_works() {
        let down = Camera { eye: Vec3::new(0.0, 0.0, 5.0), ..FRONT };
        let (right, up, forward) = down.frame();
        assert_eq!((right, up, forward), (Vec3::X, Vec3::Y, -Vec3::Z));
    }
}
