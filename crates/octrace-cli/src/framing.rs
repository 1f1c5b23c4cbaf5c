//! Which camera a picture is taken with: what the command line says, else the file, else a view of everything.

use crate::values::Viewpoint;
use octrace::model::frame_all;
use octrace::{Bounds, Camera, Projection, Vec3};

/// What the command line says about the camera.
#[derive(Clone, Copy, Debug, Default)]
pub struct Framing {
    /// `--camera`.
    pub viewpoint: Option<Viewpoint>,
    /// `--viewall`: go as far away as needed to see everything.
    pub view_all: bool,
    /// `--autocenter`: look at the middle of everything.
    pub auto_center: bool,
    /// `--projection`.
    pub projection: Option<ProjectionKind>,
}

/// How space is projected on the film, without the measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum ProjectionKind {
    /// Farther is smaller.
    #[value(alias = "p")]
    Perspective,
    /// Parallel lines stay parallel.
    #[value(name = "ortho", aliases = ["o", "orthographic", "orthogonal"])]
    Orthographic,
}

const PERSPECTIVE: Projection = Projection::Perspective { fov_deg: Camera::OPENSCAD_FOV_DEG };

impl Framing {
    /// The camera for a film of `size_px`, for a solid within `bounds` in a file that names the camera `in_file`.
    pub fn camera(&self, in_file: Option<Camera>, bounds: &Bounds, size_px: (u32, u32)) -> Camera {
        let Some(named) = self.viewpoint.map(Viewpoint::camera).or(in_file) else {
            return frame_all(bounds, None, self.projected(PERSPECTIVE, 1.0), size_px);
        };
        let distance = (named.at - named.eye).length();
        let mut camera = Camera { projection: self.projected(named.projection, distance), ..named };
        let something = !bounds.is_empty() && bounds.is_bounded();
        if self.auto_center && something {
            let shift = bounds.center() - camera.at;
            camera = Camera { eye: camera.eye + shift, at: camera.at + shift, ..camera };
        }
        if self.view_all && something {
            let around_target = if self.auto_center { *bounds } else { centered(bounds, camera.at) };
            camera = frame_all(&around_target, Some(&camera), camera.projection, size_px);
        }
        if self.viewpoint.is_some() && something {
            camera = behind_nothing(camera, bounds);
        }
        camera
    }

    /// The projection asked for, else `named`. Across kinds, what is `distance` away keeps its size, as in OpenSCAD.
    fn projected(&self, named: Projection, distance: f64) -> Projection {
        match (self.projection, named) {
            (Some(ProjectionKind::Perspective), Projection::Orthographic { .. }) => PERSPECTIVE,
            (Some(ProjectionKind::Orthographic), Projection::Perspective { fov_deg }) => {
                let (sin, cos) = octrace::geom::sin_cos_deg(fov_deg / 2.0);
                Projection::Orthographic { height: 2.0 * distance * sin / cos }
            }
            _ => named,
        }
    }
}

/// The smallest box about `center` that holds `bounds`.
fn centered(bounds: &Bounds, center: Vec3) -> Bounds {
    let reach = (bounds.min - center).abs().max((bounds.max - center).abs());
    Bounds::new(center - reach, center + reach)
}

/// As in OpenSCAD, an orthographic camera sees what is behind its eye as well: the eye steps back until nothing is.
fn behind_nothing(camera: Camera, bounds: &Bounds) -> Camera {
    let Projection::Orthographic { .. } = camera.projection else {
        return camera;
    };
    let forward = camera.frame().2;
    let to_middle = (bounds.center() - camera.eye).dot(forward);
    let missing = bounds.diagonal() - to_middle;
    if missing <= 0.0 {
        return camera;
    }
    Camera { eye: camera.eye - forward * missing, ..camera }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: Bounds = Bounds::new(Vec3::new(2.0, 2.0, 2.0), Vec3::new(4.0, 4.0, 4.0));

    fn framing(viewpoint: &str) -> Framing {
        Framing { viewpoint: Some(viewpoint.parse().unwrap()), ..Framing::default() }
    }

    fn close(a: Vec3, b: Vec3) -> bool {
        (a - b).length() < 1e-12
    }

    #[test]
    fn nothing_said_shows_everything() {
        let camera = Framing::default().camera(None, &BOX, (100, 100));
        assert!(close(camera.at, BOX.center()));
    }

    #[test]
    fn the_command_line_wins_over_the_file() {
        let in_file = "9,9,9,0,0,0".parse::<Viewpoint>().unwrap().camera();
        assert_eq!(framing("0,-9,0,0,0,0").camera(Some(in_file), &BOX, (100, 100)).eye, Vec3::new(0.0, -9.0, 0.0));
        assert_eq!(Framing::default().camera(Some(in_file), &BOX, (100, 100)), in_file);
    }

    #[test]
    fn view_all_keeps_the_target_and_the_direction() {
        let far = Framing { view_all: true, ..framing("0,-1,0,0,0,0") }.camera(None, &BOX, (100, 100));
        assert!(close(far.at, Vec3::ZERO) && far.eye.y < -8.0 && far.eye.x.abs() < 1e-12);
        let centered = Framing { view_all: true, auto_center: true, ..framing("0,-1,0,0,0,0") };
        assert!(close(centered.camera(None, &BOX, (100, 100)).at, BOX.center()));
    }

    #[test]
    fn auto_center_shifts_the_camera() {
        let camera = Framing { auto_center: true, ..framing("0,-9,0,0,0,0") }.camera(None, &BOX, (100, 100));
        assert_eq!((camera.eye, camera.at), (Vec3::new(3.0, -6.0, 3.0), BOX.center()));
    }

    #[test]
    fn an_orthographic_eye_inside_the_model_steps_back() {
        let inside = Framing { projection: Some(ProjectionKind::Orthographic), ..framing("3,3,3,3,4,3") };
        let camera = inside.camera(None, &BOX, (100, 100));
        assert!(camera.eye.y < 2.0, "{camera:?}");
        let Projection::Orthographic { height } = camera.projection else { panic!("{camera:?}") };
        assert!((height - 2.0 * libm::tan(11.25_f64.to_radians())).abs() < 1e-12);
    }
}
