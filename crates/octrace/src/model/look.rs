//! The default look of a scene that names no camera and no lights: a three-quarter view of everything, a key light over
//! the viewer's left shoulder, a weak fill light from the right.

use super::{Camera, Light, Projection, Rgb};
use crate::geom::{Bounds, Vec3, sin_cos_deg};

/// Ambient light where the scene sets none.
pub const DEFAULT_AMBIENT: Rgb = Rgb::gray(0.14);

/// The background where the scene sets none: a light, slightly blue grey.
pub const DEFAULT_BACKGROUND: Rgb = Rgb::new(0.83, 0.87, 0.92);

/// A camera that sees all of `bounds` in a film of `width_px` by `height_px`, looking the way that `toward` looks, or
/// from front, right and above (OpenSCAD's 55 and 25 degrees) where there is none.
///
/// Empty or unbounded bounds are seen as the unit cube about the origin.
pub fn frame_all(bounds: &Bounds, toward: Option<&Camera>, projection: Projection, size_px: (u32, u32)) -> Camera {
    let bounds = if bounds.is_empty() || !bounds.is_bounded() {
        Bounds::new(Vec3::splat(-0.5), Vec3::splat(0.5))
    } else {
        *bounds
    };
    let center = bounds.center();
    let (forward, up) = match toward {
        Some(camera) => (camera.frame().2, camera.up),
        None => {
            let (sin_tilt, cos_tilt) = sin_cos_deg(55.0);
            let (sin_turn, cos_turn) = sin_cos_deg(25.0);
            (-Vec3::new(sin_tilt * sin_turn, -sin_tilt * cos_turn, cos_tilt), Vec3::Z)
        }
    };
    let aimed = Camera { eye: center - forward, at: center, up, projection };
    let (right, up_exact, forward) = aimed.frame();
    let aspect = f64::from(size_px.0) / f64::from(size_px.1);
    let half = bounds.size() * 0.5;
    let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
        let sign = |bit: i32| if i & bit == 0 { -1.0 } else { 1.0 };
        half * Vec3::new(sign(1), sign(2), sign(4))
    });
    const MARGIN: f64 = 1.08;
    let radius = half.length().max(f64::MIN_POSITIVE);
    match projection {
        Projection::Perspective { fov_deg } => {
            let (s, c) = sin_cos_deg(fov_deg / 2.0);
            let tan_up = s / c / MARGIN;
            let tan_right = tan_up * aspect;
            let needed = |p: &Vec3| {
                let aside = (p.dot(up_exact).abs() / tan_up).max(p.dot(right).abs() / tan_right);
                aside - p.dot(forward)
            };
            let distance = corners.iter().map(needed).fold(radius * 1e-3, f64::max);
            Camera { eye: center - forward * distance, ..aimed }
        }
        Projection::Orthographic { .. } => {
            let height =
                corners.iter().map(|p| p.dot(up_exact).abs().max(p.dot(right).abs() / aspect)).fold(0.0, f64::max)
                    * 2.0
                    * MARGIN;
            let projection = Projection::Orthographic { height: height.max(f64::MIN_POSITIVE) };
            Camera { eye: center - forward * (3.0 * radius), projection, ..aimed }
        }
    }
}

/// The default lights for a scene seen by `camera`: directional, fixed to the viewer.
pub fn default_lights(camera: &Camera) -> Vec<Light> {
    let (right, up, forward) = camera.frame();
    let from = |r: f64, u: f64, f: f64| right * -r + up * -u + forward * f;
    vec![
        Light::Directional { direction: from(-0.55, 0.85, 0.8), intensity: Rgb::new(0.86, 0.85, 0.82) },
        Light::Directional { direction: from(0.9, 0.2, 0.6), intensity: Rgb::new(0.24, 0.26, 0.30) },
    ]
}
