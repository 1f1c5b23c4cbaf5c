//! What a surface looks like: the coefficients of Whitted's model [Whitted 1980; Comba-Persiano, §2.3].

use super::Rgb;

/// Coefficients of `I = Ka Ia + Kd sum I_j (N.L_j) + Ks sum I_j (S.R_j)^n + Kr Is + Kt It`.
///
/// The paper's `Ks Is` (light along the reflected ray) has a coefficient of its own here, `kr`, so that a glossy
/// surface need not be a mirror; its refraction coefficient is `kt`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// The body colour; ambient, diffuse and transmitted light are filtered by it.
    pub color: Rgb,
    /// Ambient coefficient `Ka`.
    pub ka: f64,
    /// Diffuse coefficient `Kd`.
    pub kd: f64,
    /// Specular coefficient `Ks` of highlights.
    pub ks: f64,
    /// Phong's exponent `n`.
    pub shininess: f64,
    /// Share of light along the reflected ray, `Kr`.
    pub kr: f64,
    /// Share of light along the refracted ray, `Kt`.
    pub kt: f64,
    /// Index of refraction relative to the surroundings; 1 does not bend light.
    pub ior: f64,
    /// How far the body colour filters transmitted light at each surface: 0 not at all, 1 fully.
    pub tint: f64,
}

impl Material {
    /// OpenSCAD's default yellow, encoded as it is there: `#f9d72c`.
    pub const DEFAULT_SRGB: [f64; 3] = [249.0 / 255.0, 215.0 / 255.0, 44.0 / 255.0];

    /// Dull: no highlight.
    pub const fn matte(color: Rgb) -> Self {
        Self { color, ka: 1.0, kd: 0.85, ks: 0.0, shininess: 1.0, kr: 0.0, kt: 0.0, ior: 1.0, tint: 1.0 }
    }

    /// A soft highlight: what parts without a material of their own are made of.
    pub const fn plastic(color: Rgb) -> Self {
        Self { color, ka: 1.0, kd: 0.8, ks: 0.25, shininess: 40.0, kr: 0.0, kt: 0.0, ior: 1.0, tint: 1.0 }
    }

    /// Dark body, strong highlight, some reflection.
    pub const fn metal(color: Rgb) -> Self {
        Self { color, ka: 0.6, kd: 0.45, ks: 0.7, shininess: 90.0, kr: 0.3, kt: 0.0, ior: 1.0, tint: 1.0 }
    }

    /// Clear, refracting, with a faint mirror image; the colour filters what passes.
    pub const fn glass(color: Rgb) -> Self {
        Self { color, ka: 0.0, kd: 0.02, ks: 0.7, shininess: 200.0, kr: 0.1, kt: 0.88, ior: 1.5, tint: 1.0 }
    }

    /// Nearly everything is reflected.
    pub const fn mirror(color: Rgb) -> Self {
        Self { color, ka: 0.05, kd: 0.08, ks: 0.6, shininess: 150.0, kr: 0.85, kt: 0.0, ior: 1.0, tint: 1.0 }
    }
}

impl Material {
    /// Whether light passes.
    pub fn is_transparent(&self) -> bool {
        self.kt > 0.0
    }

    /// The factor for light that passes the surface.
    pub fn transmission(&self) -> Rgb {
        let keep = 1.0 - self.tint;
        (Rgb::gray(keep) + self.color * self.tint) * self.kt
    }
}

impl Default for Material {
    /// Plastic in OpenSCAD's yellow.
    fn default() -> Self {
        Self::plastic(Rgb::from_srgb(Self::DEFAULT_SRGB))
    }
}

/// A part of the model: what its leaves have in common.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// What it looks like.
    pub material: Material,
}

/// Which [`Part`] of a scene a leaf of the CSG tree belongs to: an index into [`Scene::parts`](super::Scene::parts).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PartId(pub u32);
