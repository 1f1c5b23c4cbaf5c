//! Values of options: from words on the command line to checked, plain data. Clap turns every `Err` here into a usage
//! error that names the option.

use octrace::{Camera, Projection, Rgb, Vec3};
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Width and height of a picture in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pixels per row.
    pub width_px: u32,
    /// Rows.
    pub height_px: u32,
}

impl Size {
    /// The most pixels a picture may have: at some 40 bytes each while rendering, more needs more memory than most
    /// machines have.
    pub const MOST_PIXELS: u64 = 1 << 27;
}

impl FromStr for Size {
    type Err = String;

    /// `1024x768`, or OpenSCAD's `1024,768`.
    fn from_str(text: &str) -> Result<Self, String> {
        let side = |word: &str| word.trim().parse::<u32>().ok();
        let sides = text.split_once(['x', 'X', '×', ',']).and_then(|(w, h)| Some((side(w)?, side(h)?)));
        let Some((width_px, height_px)) = sides else {
            return Err("write width and height in pixels, as in 1024x768".into());
        };
        let pixels = u64::from(width_px) * u64::from(height_px);
        if pixels == 0 {
            return Err("a picture has at least one pixel".into());
        }
        if pixels > Self::MOST_PIXELS {
            return Err(format!("that is {pixels} pixels; {} (16384x8192) are the most", Self::MOST_PIXELS));
        }
        Ok(Self { width_px, height_px })
    }
}

/// A pixel, counted from 0 at the upper left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pixel {
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
}

impl FromStr for Pixel {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let pixel =
            text.split_once(',').and_then(|(x, y)| Some(Self { x: x.trim().parse().ok()?, y: y.trim().parse().ok()? }));
        pixel.ok_or_else(|| "write column and row, counted from 0 at the upper left, as in 512,384".into())
    }
}

/// OpenSCAD's two ways to say where the camera is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewpoint {
    /// Six numbers: the eye, and what it looks at.
    Vector {
        /// Where the eye is.
        eye: Vec3,
        /// What it looks at.
        center: Vec3,
    },
    /// Seven numbers: what the camera looks at, how it is turned about that, and how far away it is.
    Gimbal {
        /// What the camera looks at.
        target: Vec3,
        /// Angles in degrees about X, then Y, then Z; all zero looks straight down, with y up.
        angles_deg: Vec3,
        /// From target to eye, in scene units.
        distance: f64,
    },
}

impl FromStr for Viewpoint {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split(',').map(|word| word.trim().parse::<f64>().ok().filter(|v| v.is_finite()));
        let numbers: Option<Vec<f64>> = numbers.collect();
        match numbers.as_deref() {
            Some(&[ex, ey, ez, cx, cy, cz]) => {
                let (eye, center) = (Vec3::new(ex, ey, ez), Vec3::new(cx, cy, cz));
                if eye == center {
                    return Err("the eye is where it looks to".into());
                }
                Ok(Self::Vector { eye, center })
            }
            Some(&[x, y, z, rx, ry, rz, distance]) => {
                if distance <= 0.0 {
                    return Err("the distance, the last of seven numbers, must be greater than 0".into());
                }
                Ok(Self::Gimbal { target: Vec3::new(x, y, z), angles_deg: Vec3::new(rx, ry, rz), distance })
            }
            _ => Err("write six numbers, eye_x,y,z,center_x,y,z, or seven, translate_x,y,z,rot_x,y,z,distance".into()),
        }
    }
}

impl Viewpoint {
    /// The camera there, in perspective.
    pub fn camera(self) -> Camera {
        let projection = Projection::Perspective { fov_deg: Camera::OPENSCAD_FOV_DEG };
        match self {
            Self::Vector { eye, center } => Camera { eye, at: center, up: Vec3::Z, projection },
            Self::Gimbal { target, angles_deg, distance } => {
                let turn = octrace::Affine::rotation_deg(angles_deg);
                Camera {
                    eye: target + turn.vector(Vec3::Z) * distance,
                    at: target,
                    up: turn.vector(Vec3::Y),
                    projection,
                }
            }
        }
    }
}

/// A colour as on the web, `red`, `#f00`, `#ff0000`, or as in OpenSCAD, three numbers from 0 to 1: `1,0,0`.
pub fn color(text: &str) -> Result<Rgb, String> {
    let help = "write a name such as white, #rrggbb, or three numbers from 0 to 1 as in 1,0.5,0";
    if text.contains(',') && !text.contains('(') {
        let numbers: Option<Vec<f64>> =
            text.split(',').map(|word| word.trim().parse().ok().filter(|v| (0.0..=1.0).contains(v))).collect();
        return match numbers.as_deref() {
            Some(&[r, g, b]) => Ok(Rgb::from_srgb([r, g, b])),
            _ => Err(help.into()),
        };
    }
    match csscolorparser::parse(text) {
        Ok(color) if color.a >= 1.0 => Ok(Rgb::from_srgb([color.r, color.g, color.b].map(f64::from))),
        Ok(_) => Err("a background is either opaque or, as a whole, transparent".into()),
        Err(_) => Err(help.into()),
    }
}

/// A `name=value` for OpenSCAD's `-D`; the value is an OpenSCAD expression, which OpenSCAD checks.
pub fn definition(text: &str) -> Result<String, String> {
    let name = text.split_once('=').map(|(name, _)| name.trim());
    let is_name = |name: &str| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '$');
    match name {
        Some(name) if !name.is_empty() && is_name(name) => Ok(text.to_owned()),
        _ => Err("write name=value, as in -D width=20 or -D 'label=\"abc\"'".into()),
    }
}

/// A whole number within limits.
pub fn count(limits: RangeInclusive<u32>) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync + 'static {
    move |text| match text.trim().parse() {
        Ok(n) if limits.contains(&n) => Ok(n),
        _ => Err(format!("write a whole number from {} to {}", limits.start(), limits.end())),
    }
}

/// A number.
pub fn finite(text: &str) -> Result<f64, String> {
    text.trim().parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| "write a number, as in 2.5".into())
}

/// A number that is `0 <= x < 1`: a tolerance relative to the model's size, possibly none.
pub fn relative_or_zero(text: &str) -> Result<f64, String> {
    relative(text, |v| (0.0..1.0).contains(&v)).ok_or_else(|| "write a number from 0 to below 1, as in 2e-6".into())
}

/// A number that is `0 < x < 1`: a tolerance that is to be reached.
pub fn relative_above_zero(text: &str) -> Result<f64, String> {
    relative(text, |v| 0.0 < v && v < 1.0).ok_or_else(|| "write a number between 0 and 1, as in 1e-4".into())
}

fn relative(text: &str, fits: impl Fn(f64) -> bool) -> Option<f64> {
    text.trim().parse().ok().filter(|&v| fits(v))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        let size = |width_px, height_px| Ok(Size { width_px, height_px });
        assert_eq!("1024x768".parse(), size(1024, 768));
        assert_eq!("640, 480".parse(), size(640, 480));
        for wrong in ["", "640", "640x", "x480", "0x480", "-1x5", "640x480x3", "100000x100000", "99999999999x1"] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_gimbal_at_rest_looks_straight_down() {
        let camera = "1,2,3,0,0,0,10".parse::<Viewpoint>().unwrap().camera();
        assert_eq!((camera.eye, camera.at, camera.up), (Vec3::new(1.0, 2.0, 13.0), Vec3::new(1.0, 2.0, 3.0), Vec3::Y));
    }

    #[test]
    fn a_gimbal_tilted_by_90_degrees_looks_along_y() {
        let camera = "0,0,0,90,0,0,10".parse::<Viewpoint>().unwrap().camera();
        assert_eq!((camera.eye, camera.up), (Vec3::new(0.0, -10.0, 0.0), Vec3::Z));
        let from_the_right = "0,0,0,90,0,90,10".parse::<Viewpoint>().unwrap().camera();
        assert_eq!(from_the_right.eye, Vec3::new(10.0, 0.0, 0.0));
    }

    #[test]
    fn viewpoints_that_see_nothing_are_refused() {
        for wrong in ["1,2,3", "0,0,0,0,0,0", "0,0,0,0,0,0,0", "0,0,0,0,0,0,-5", "nan,0,0,1,1,1", "1,2,3,4,5,6,7,8"] {
            assert!(wrong.parse::<Viewpoint>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn colors() {
        for white in ["white", "#fff", "#FFFFFF", "1,1,1", "rgb(255,255,255)"] {
            assert_eq!(color(white), Ok(Rgb::WHITE), "{white}");
        }
        for wrong in ["whiteish", "1,1", "2,0,0", "#ff000080", ""] {
            assert!(color(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn counts_have_limits() {
        let count = count(1..=64);
        assert_eq!((count("1"), count(" 64 ")), (Ok(1), Ok(64)));
        for wrong in ["0", "65", "-1", "1.5", "x", ""] {
            assert_eq!(count(wrong), Err("write a whole number from 1 to 64".into()), "{wrong}");
        }
    }

    #[test]
    fn definitions_have_a_name() {
        assert!(definition("$fn=20").is_ok() && definition("a=\"x=y\"").is_ok());
        assert!(definition("a").is_err() && definition("=3").is_err() && definition("a b=3").is_err());
    }
}
