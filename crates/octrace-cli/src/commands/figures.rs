//! `octrace figures`: the paper's figures of a scene, as SVG files.

use crate::args::FiguresArgs;
use crate::failure::Failure;
use crate::figures::{self, Subject};
use crate::input;
use crate::output::Folder;
use crate::session::Session;
use crate::values::Pixel;
use octrace::film::{Background, View};
use octrace::{Scene, Tracer, TracerOptions};
use octrace_read::{ReadOptions, Source, read_scene};

/// Light is followed as far as `render` does by default.
const MAX_BOUNCES: u32 = 8;

/// Draws the figures, and writes them when all of them are there.
pub fn run(args: &FiguresArgs, session: &Session) -> Result<(), Failure> {
    let (width_px, height_px) = args.view.size_px();
    let Pixel { x, y } = args.pixel.unwrap_or_else(|| pixel(args, (width_px, height_px)));
    if !(x < width_px && y < height_px) {
        return Err(Failure::Usage(format!("pixel {x},{y} is outside of the picture, {width_px}x{height_px}")));
    }
    let folder = Folder::new(&args.output)?;
    let scene = scene(args, session)?;
    let drawn = {
        let _busy = session.busy("drawing");
        let (exec, _listening) = session.silent_exec();
        let bodies = scene.bodies().solids;
        let options = TracerOptions { snap: scene.snap, ..TracerOptions::default() };
        let tracer = Tracer::build_bodies(&bodies, &options, &exec)?;
        let view = View {
            camera: args.view.framing().camera_for(&tracer, scene.camera, (width_px, height_px)),
            width_px,
            height_px,
            samples: 1,
            max_bounces: MAX_BOUNCES,
            background: Background::Scene,
        };
        let slice_z = args.slice.or(args.file.is_none().then_some(figures::EXAMPLE_SLICE_Z));
        let octree = args.octree();
        let (scene, bodies, tracer) = (&scene, &bodies[..], &tracer);
        figures::draw(&Subject { scene, bodies, tracer, view, pixel: (x, y), slice_z, octree }, &exec)?
    };
    let files: Vec<(&str, &[u8])> = figures::FILES.into_iter().zip(drawn.iter().map(String::as_bytes)).collect();
    folder.write(&files, &session.interrupt)?;
    session.remark(&format!("{}: {}", args.output.display(), figures::FILES.join(", ")));
    Ok(())
}

/// The pixel where none is named: the middle one, or the one of the example that has most to tell.
fn pixel(args: &FiguresArgs, (width_px, height_px): (u32, u32)) -> Pixel {
    let (x, y) = match args.file {
        Some(_) => (0.5, 0.5),
        None => figures::EXAMPLE_PIXEL,
    };
    Pixel { x: (f64::from(width_px) * x) as u32, y: (f64::from(height_px) * y) as u32 }
}

fn scene(args: &FiguresArgs, session: &Session) -> Result<Scene, Failure> {
    match &args.file {
        Some(file) => Ok(input::load(file, &args.read, session)?.1.scene),
        None => {
            let source = Source::new("example.oct", figures::EXAMPLE);
            Ok(read_scene(&source, &ReadOptions::default()).value.expect("the example has no errors").scene)
        }
    }
}
