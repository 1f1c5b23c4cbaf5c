//! Everything a file asks for.

use super::{Camera, Light, Material, Part, PartId, Rgb, Solid};

/// A scene: checked, finished, immutable.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The solid to look at.
    pub solid: Solid,
    /// The parts that its leaves belong to, by [`PartId`](super::PartId). Leaves without a part look like
    /// [`Part::default`].
    pub parts: Vec<Part>,
    /// Light sources; none means the default lights, which follow the camera.
    pub lights: Vec<Light>,
    /// The camera that the file names, if it does.
    pub camera: Option<Camera>,
    /// Ambient light `Ia`, if the file sets it.
    pub ambient: Option<Rgb>,
    /// What a ray sees that meets nothing, if the file sets it.
    pub background: Option<Rgb>,
    /// Import tolerance, relative to the model's size: surfaces closer than this become one. Zero joins only what
    /// differs by rounding.
    pub snap: f64,
}

impl Scene {
    /// The import tolerance for numbers written with six significant digits, as OpenSCAD does in its dumps.
    pub const SNAP_SIX_DIGITS: f64 = 2e-6;

    /// A scene with nothing but the solid: default looks, no import tolerance.
    pub fn new(solid: Solid) -> Self {
        Self { solid, parts: Vec::new(), lights: Vec::new(), camera: None, ambient: None, background: None, snap: 0.0 }
    }

    /// What a leaf of this part looks like.
    pub fn material(&self, part: Option<PartId>) -> Material {
        part.and_then(|PartId(index)| self.parts.get(index as usize)).cloned().unwrap_or_default().material
    }
}
