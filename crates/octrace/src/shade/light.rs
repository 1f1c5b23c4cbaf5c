//! Light: where it comes from, what is seen of it, and how many rays were asked for that.

use crate::model::{Light, Rgb};
use crate::trace::lanes::Stored;
use std::ops::AddAssign;

/// What lights the scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lighting {
    /// The sources.
    pub lights: Vec<Light>,
    /// Ambient light `Ia`.
    pub ambient: Rgb,
    /// What a ray sees that meets nothing.
    pub background: Rgb,
    /// Whether such camera rays leave the film transparent instead.
    pub transparent: bool,
}

/// How many rays were traced, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// From the camera.
    pub camera: u64,
    /// Towards lights.
    pub shadow: u64,
    /// Reflected.
    pub reflected: u64,
    /// Refracted.
    pub refracted: u64,
}

impl AddAssign for RayCounts {
    fn add_assign(&mut self, o: Self) {
        let Self { camera, shadow, reflected, refracted } = o;
        self.camera += camera;
        self.shadow += shadow;
        self.reflected += reflected;
        self.refracted += refracted;
    }
}

/// Light along a ray, and how much of the film it covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Seen {
    pub color: Rgb,
    pub alpha: f64,
}

impl Seen {
    /// Adds what is seen along the refracted ray: `through` is the share of light that comes from there.
    pub(super) fn refract(&mut self, behind: Self, factor: Rgb, through: f64) {
        self.color += behind.color * factor;
        self.alpha = (self.alpha - through * (1.0 - behind.alpha)).clamp(0.0, 1.0);
    }

    /// Adds what is seen along the reflected ray.
    pub(super) fn reflect(&mut self, mirrored: Self, factor: Rgb) {
        self.color += mirrored.color * factor;
    }
}

/// What is seen along eight rays.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct EightSeen {
    /// Red, green and blue.
    pub color: [Stored; 3],
    pub alpha: Stored,
}

impl EightSeen {
    /// What is seen along one of them.
    pub fn lane(&self, lane: usize) -> Seen {
        let [r, g, b] = [0, 1, 2].map(|axis| self.color[axis].0[lane]);
        Seen { color: Rgb::new(r, g, b), alpha: self.alpha.0[lane] }
    }

    /// Adds what is seen elsewhere.
    pub fn add(&mut self, o: &Self) {
        let [r, g, b] = &mut self.color;
        for (sum, more) in [r, g, b, &mut self.alpha].into_iter().zip([&o.color[0], &o.color[1], &o.color[2], &o.alpha])
        {
            for (sum, more) in sum.0.iter_mut().zip(&more.0) {
                *sum += more;
            }
        }
    }

    /// Sets what is seen along one of them.
    pub fn put(&mut self, lane: usize, Seen { color, alpha }: Seen) {
        for (stored, v) in self.color.iter_mut().zip([color.r, color.g, color.b]) {
            stored.0[lane] = v;
        }
        self.alpha.0[lane] = alpha;
    }
}
