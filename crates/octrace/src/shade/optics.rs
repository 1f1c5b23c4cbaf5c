//! Where rays go on from a surface, and through what.

use crate::geom::{Ray, Vec3};
use crate::model::Rgb;

/// The transparent bodies that a ray is inside, in the order in which it went in.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Media {
    bodies: [u16; Self::MAX],
    count: u8,
}

impl Media {
    /// Nested deeper, bodies no longer bend light.
    const MAX: usize = 8;

    pub fn inside(&self) -> &[u16] {
        &self.bodies[..usize::from(self.count)]
    }

    pub fn enter(mut self, body: usize) -> Self {
        let count = usize::from(self.count);
        if count < Self::MAX {
            self.bodies[count] = body as u16;
            self.count += 1;
        }
        self
    }

    pub fn leave(mut self, body: usize) -> Self {
        if let Some(at) = self.inside().iter().rposition(|&b| usize::from(b) == body) {
            self.bodies.copy_within(at + 1..usize::from(self.count), at);
            self.count -= 1;
        }
        self
    }
}

/// A ray that goes on from a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Branch {
    pub ray: Ray,
    pub media: Media,
    /// By what the light along it is multiplied.
    pub factor: Rgb,
    /// How much of the pixel it makes at most.
    pub weight: f64,
}

/// Where a ray stands in its tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    pub media: Media,
    pub bounce: u32,
    /// How much of the pixel it makes at most.
    pub weight: f64,
    /// Whether it comes from the camera, if through glass.
    pub direct: bool,
}

impl Standing {
    /// The standing of a ray that goes on from the end of this one.
    pub fn of(self, branch: &Branch, refracted: bool) -> Self {
        let Branch { media, weight, .. } = *branch;
        Self { media, bounce: self.bounce + 1, weight, direct: self.direct && refracted }
    }
}

/// The direction after reflection at a plane with this normal.
pub(super) fn mirror(direction: Vec3, normal: Vec3) -> Vec3 {
    direction - normal * (2.0 * normal.dot(direction))
}

/// Snell's law: the unit direction behind a surface whose normal opposes `direction`; `ratio` is the index before over
/// the one behind. `None` where all light is reflected.
pub(super) fn refract(direction: Vec3, normal: Vec3, ratio: f64) -> Option<Vec3> {
    let direction = direction.normalized()?;
    let cosine = -normal.dot(direction);
    let squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if squared < 0.0 {
        return None;
    }
    (direction * ratio + normal * (ratio * cosine - squared.sqrt())).normalized()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_media_do_not_bend() {
        let d = Vec3::new(0.6, 0.0, -0.8);
        let through = refract(d, Vec3::Z, 1.0).unwrap();
        assert!((through - d).length() < 1e-15);
    }

    #[test]
    fn glass_bends_towards_the_normal_and_reflects_totally_beyond_the_critical_angle() {
        let d = Vec3::new(0.6, 0.0, -0.8);
        let into_glass = refract(d, Vec3::Z, 1.0 / 1.5).unwrap();
        assert!((into_glass.x - 0.4).abs() < 1e-15);
        assert_eq!(refract(Vec3::new(0.8, 0.0, -0.6), Vec3::Z, 1.5), None);
    }
}
