//! Which camera a picture is taken with: what the command line says, else the file, else a view of everything.

use crate::values::Viewpoint;
use octrace::model::frame_all;
use octrace::query::{occupied_bounds, occupied_bounds_closely};
use octrace::{Bounds, Camera, Projection, Tracer};

/// What the command line says about the camera.
#[derive(Clone, Copy, Debug, Default)]
pub struct Framing {
    /// `--camera`.
    pub viewpoint: Option<Viewpoint>,
    /// `--viewall`: go as far away as OpenSCAD does to see everything.
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
    /// The camera for a picture of what `tracer` traces, of `size_px`, from a file that names the camera `in_file`.
    pub fn camera_for(&self, tracer: &Tracer, in_file: Option<Camera>, size_px: (u32, u32)) -> Camera {
        // A camera that stands as the file says need not know where things are.
        let stands = in_file.is_some() && self.viewpoint.is_none() && !self.auto_center && !self.view_all;
        let bounds = match (stands, self.view_all) {
            (true, _) => Bounds::EMPTY,
            (false, true) => occupied_bounds_closely(tracer),
            (false, false) => occupied_bounds(tracer),
        };
        self.camera(in_file, &bounds, size_px)
    }

    /// The camera for a film of `size_px`, for a solid within `bounds` in a file that names the camera `in_file`.
    fn camera(&self, in_file: Option<Camera>, bounds: &Bounds, size_px: (u32, u32)) -> Camera {
        let Some(named) = self.viewpoint.map(Viewpoint::camera).or(in_file) else {
            let all = frame_all(bounds, None, self.projected(PERSPECTIVE, 1.0), size_px);
            return if self.view_all { from_afar(all, bounds) } else { all };
        };
        let distance = (named.at - named.eye).length();
        let mut camera = Camera { projection: self.projected(named.projection, distance), ..named };
        let something = !bounds.is_empty() && bounds.is_bounded();
        if self.auto_center && something {
            let shift = bounds.center() - camera.at;
            camera = Camera { eye: camera.eye + shift, at: camera.at + shift, ..camera };
        }
        if self.view_all && something {
            camera = from_afar(camera, bounds);
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

/// The camera moved as far away from its target as OpenSCAD does: a ball about the target, in which is a ball about
/// everything, just fits between the lower and the upper edge.
fn from_afar(camera: Camera, bounds: &Bounds) -> Camera {
    if bounds.is_empty() || !bounds.is_bounded() {
        return camera;
    }
    let radius = (bounds.center() - camera.at).length() + bounds.diagonal() / 2.0;
    let fov_deg = match camera.projection {
        Projection::Perspective { fov_deg } => fov_deg,
        Projection::Orthographic { .. } => Camera::OPENSCAD_FOV_DEG,
    };
    let (sin, cos) = octrace::geom::sin_cos_deg(fov_deg / 2.0);
    let distance = radius / sin;
    let projection = match camera.projection {
        Projection::Orthographic { .. } => Projection::Orthographic { height: 2.0 * distance * sin / cos },
        perspective => perspective,
    };
    Camera { eye: camera.at - camera.frame().2 * distance, projection, ..camera }
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
    use octrace::Vec3;

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

    /// As measured on pictures of OpenSCAD 2021.01.
    #[test]
    fn view_all_goes_as_far_as_openscad() {
        let framing = Framing { view_all: true, ..framing("0,-1,0,0,0,0") };
        let radius = 27.0_f64.sqrt() + 3.0_f64.sqrt();
        let angle = 11.25_f64.to_radians();
        let camera = framing.camera(None, &BOX, (400, 300));
        assert!((camera.eye.y + radius / libm::sin(angle)).abs() < 1e-9, "{camera:?}");
        let flat = Framing { projection: Some(ProjectionKind::Orthographic), ..framing }.camera(None, &BOX, (400, 300));
        let Projection::Orthographic { height } = flat.projection else { panic!("{flat:?}") };
        assert!((height - 2.0 * radius / libm::cos(angle)).abs() < 1e-9, "{flat:?}");
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
