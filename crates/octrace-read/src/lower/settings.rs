//! Lights, camera and surroundings: what a file says besides solids. They stand anywhere, also inside transforms, and
//! move with these.

use super::args::Args;
use super::language::Kind;
use super::looks::color;
use super::report::Report;
use super::transforms::no_direction;
use crate::SourceRange;
use crate::diagnostic::Diagnostic;
use crate::syntax::View;
use octrace::geom::sin_cos_deg;
use octrace::{Affine, Camera, Light, Projection, Rgb, Vec3};

/// What was found.
#[derive(Debug, Default)]
pub(super) struct Settings {
    pub lights: Vec<Light>,
    pub camera: Option<Camera>,
    pub ambient: Option<Rgb>,
    pub background: Option<Rgb>,
    camera_at: Option<SourceRange>,
    ambient_at: Option<SourceRange>,
    background_at: Option<SourceRange>,
}

impl Settings {
    /// Takes in a node of one of these kinds. `map` is where it stands.
    pub fn take(&mut self, kind: Kind, args: &Args<'_>, map: &Affine, report: &mut Report<'_>) {
        match kind {
            Kind::Light => self.lights.extend(light(args, map, report)),
            Kind::Camera => {
                if let Some(camera) = camera(args, map, report) {
                    only_once(&mut self.camera_at, args.name_at, "camera", report);
                    self.camera = Some(camera);
                }
            }
            Kind::Ambient => {
                if let Some(level) = brightness(args, report) {
                    only_once(&mut self.ambient_at, args.name_at, "ambient", report);
                    let strength = intensity(args, report).unwrap_or(1.0);
                    self.ambient = Some(level * strength);
                }
            }
            Kind::Background => {
                if let Some(color) = brightness(args, report) {
                    only_once(&mut self.background_at, args.name_at, "background", report);
                    self.background = Some(color);
                }
            }
            _ => {}
        }
    }
}

fn only_once(earlier: &mut Option<SourceRange>, at: SourceRange, what: &str, report: &mut Report<'_>) {
    if let Some(earlier) = earlier.replace(at) {
        let message = format!("there is more than one `{what}`; the last one counts");
        report.push(Diagnostic::warning("several-settings", at, message).with_note(earlier, "this one does not"));
    }
}

fn missing(args: &Args<'_>, message: &str, report: &mut Report<'_>) {
    if !args.damaged {
        report.push(Diagnostic::error("missing-argument", args.name_at, message));
    }
}

fn intensity(args: &Args<'_>, report: &mut Report<'_>) -> Option<f64> {
    let (value, at) = args.number("intensity")?;
    if value >= 0.0 && value.is_finite() {
        return Some(value);
    }
    report.push(Diagnostic::error("intensity-range", at, "an intensity must be zero or more, and finite"));
    None
}

/// A colour, or a number for so much white light.
fn brightness(args: &Args<'_>, report: &mut Report<'_>) -> Option<Rgb> {
    match args.number("color") {
        Some((level, _)) if level >= 0.0 && level.is_finite() => Some(Rgb::gray(level)),
        Some((_, at)) => {
            report.push(Diagnostic::error("intensity-range", at, "an intensity must be zero or more, and finite"));
            None
        }
        None if args.get("color").is_none() => {
            missing(args, "a colour or a brightness is needed here", report);
            None
        }
        None => color(args, "color", report).and_then(|(rgb, _)| rgb),
    }
}

fn light(args: &Args<'_>, map: &Affine, report: &mut Report<'_>) -> Option<Light> {
    let tint = match args.get("color") {
        Some(_) => color(args, "color", report)?.0.unwrap_or(Rgb::WHITE),
        None => Rgb::WHITE,
    };
    let strength = intensity(args, report).unwrap_or(1.0);
    let intensity = tint * strength;
    match (args.triple("position", 0.0), args.triple("direction", 0.0)) {
        (Some((position, at)), None) => {
            let position = finite(map.point(position.into()), at, report)?;
            Some(Light::Point { position, intensity })
        }
        (None, Some((direction, at))) => {
            let direction = map.vector(direction.into()).normalized();
            if direction.is_none() {
                report.push(no_direction(at, "this light"));
            }
            Some(Light::Directional { direction: direction?, intensity })
        }
        (Some((_, at)), Some((_, other))) => {
            let message = "a light has either a position or a direction";
            report.push(Diagnostic::error("light-place", other, message).with_note(at, "here is the position"));
            None
        }
        (None, None) => {
            missing(args, "a light needs `position = [x, y, z]` or `direction = [x, y, z]`", report);
            None
        }
    }
}

fn finite(v: Vec3, at: SourceRange, report: &mut Report<'_>) -> Option<Vec3> {
    if !v.is_finite() {
        report.push(Diagnostic::error("not-finite", at, "these numbers must be finite"));
        return None;
    }
    Some(v)
}

fn camera(args: &Args<'_>, map: &Affine, report: &mut Report<'_>) -> Option<Camera> {
    let (mut aimed, at) = match args.numbers("view") {
        Some((numbers, at)) => (openscad_camera(numbers), at),
        None => {
            let eye = args.triple("eye", 0.0).or_else(|| args.triple("from", 0.0));
            let target = args.triple("at", 0.0).or_else(|| args.triple("look_at", 0.0));
            let Some((eye, place)) = eye else {
                missing(args, "a camera needs `eye = [x, y, z]`, or OpenSCAD's six or seven numbers", report);
                return None;
            };
            (Aim { eye: eye.into(), at: target.map_or(Vec3::ZERO, |(v, _)| v.into()), up: Vec3::Z }, place)
        }
    };
    if let Some((up, place)) = args.triple("up", 0.0) {
        aimed.up = up.into();
        if aimed.up.normalized().is_none() {
            report.push(no_direction(place, "`up`"));
            return None;
        }
    }
    let eye = finite(map.point(aimed.eye), at, report)?;
    let target = finite(map.point(aimed.at), at, report)?;
    let up = finite(map.vector(aimed.up), at, report)?;
    if (target - eye).normalized().is_none() {
        report.push(Diagnostic::error("camera-aim", at, "the camera stands where it looks to"));
        return None;
    }
    let projection = projection(args, (target - eye).length(), report)?;
    Some(Camera { eye, at: target, up, projection })
}

/// Where a camera stands and looks.
struct Aim {
    eye: Vec3,
    at: Vec3,
    up: Vec3,
}

/// OpenSCAD's six numbers (eye and centre) or seven (centre, angles, distance).
fn openscad_camera(n: &[f64]) -> Aim {
    let triple = |i: usize| Vec3::new(n[i], n[i + 1], n[i + 2]);
    match n.len() {
        6 => Aim { eye: triple(0), at: triple(3), up: Vec3::Z },
        _ => {
            let turn = Affine::rotation_deg(triple(3));
            let at = triple(0);
            Aim { eye: at + turn.vector(Vec3::Z * n[6]), at, up: turn.vector(Vec3::Y) }
        }
    }
}

/// The projection; an orthographic one covers by default what a perspective one would at this distance.
fn projection(args: &Args<'_>, distance: f64, report: &mut Report<'_>) -> Option<Projection> {
    let (fov_deg, fov_at) = args.number("fov").unwrap_or((Camera::OPENSCAD_FOV_DEG, args.name_at));
    if !(fov_deg > 0.0 && fov_deg < 180.0) {
        report.push(Diagnostic::error("camera-fov", fov_at, "an angle of view lies between 0 and 180 degrees"));
        return None;
    }
    let height = args.number("height");
    let orthographic = match args.view("projection") {
        None => height.is_some(),
        Some(View::Text("perspective" | "p")) => false,
        Some(View::Text("orthographic" | "ortho" | "o")) => true,
        Some(_) => {
            let at = args.get("projection").map_or(args.name_at, |arg| arg.at);
            let message = "a projection is \"perspective\" or \"orthographic\"";
            report.push(Diagnostic::error("camera-projection", at, message));
            return None;
        }
    };
    if !orthographic {
        return Some(Projection::Perspective { fov_deg });
    }
    let (sin, cos) = sin_cos_deg(fov_deg / 2.0);
    let (height, at) = height.unwrap_or((2.0 * distance * sin / cos, args.name_at));
    if !(height > 0.0 && height.is_finite()) {
        report.push(Diagnostic::error("camera-height", at, "the height of the view must be greater than zero"));
        return None;
    }
    Some(Projection::Orthographic { height })
}
