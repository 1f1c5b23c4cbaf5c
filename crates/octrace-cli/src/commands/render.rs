//! `octrace render`: from a file to a picture.

use crate::args::{RenderArgs, StatsFormat};
use crate::failure::Failure;
use crate::input;
use crate::output::{Destination, say, write_stdout};
use crate::picture::{Alpha, encode_png};
use crate::session::Session;
use crate::stats::{Rays, Seconds, Stats, Stopwatch, peak_memory_bytes};
use octrace::film::{Background, RenderStats, View, render};
use octrace::{Scene, Tracer};
use octrace_read::Loaded;
use std::path::{Path, PathBuf};

/// Draws one file.
pub fn run(args: &RenderArgs, session: &Session) -> Result<(), Failure> {
    let output = output_path(args)?;
    let destination = Destination::new(&output)?;
    let started = Stopwatch::start();
    let (mut watch, mut seconds) = (Stopwatch::start(), Seconds::default());

    let (source, Loaded { scene, .. }) = input::load(&args.file, &args.read, session)?;
    seconds.read = watch.lap();

    let (exec, listening) = session.exec(&args.trace);
    let tracer = Tracer::build_bodies(&scene.bodies().solids, &args.trace.options(scene.snap), &exec)?;
    seconds.build = watch.lap();
    session.remark_on_snapping(&tracer);

    let view = view(args, &scene, &tracer);
    let (film, counts) = render(&scene, &tracer, &view, &exec)?;
    seconds.render = watch.lap();

    let alpha = match view.background {
        Background::Scene | Background::Color(_) => Alpha::Opaque,
        Background::Transparent => Alpha::Straight,
    };
    let picture = encode_png(&film, args.look.bit_depth, alpha).map_err(|e| Failure::file("write", &output, &e))?;
    destination.write(&picture, &session.interrupt)?;
    drop(listening);
    seconds.write = watch.lap();
    seconds.total = started.elapsed();

    match destination {
        Destination::Stdout => {}
        _ => session.remark(&format!("{}: {} x {} pixels", output.display(), view.width_px, view.height_px)),
    }
    match args.stats {
        None => Ok(()),
        Some(StatsFormat::Json) => {
            let line = serde_json::to_string(&stats(args, source.name(), &tracer, seconds, &counts))
                .expect("numbers and names are plain data");
            match destination {
                Destination::Stdout => say(&line),
                _ => write_stdout(format!("{line}\n").as_bytes())?,
            }
            Ok(())
        }
    }
}

/// Where the picture goes: by default the input's name with `.png`, in the current folder.
fn output_path(args: &RenderArgs) -> Result<PathBuf, Failure> {
    match (&args.output, args.file.file_stem()) {
        (Some(output), _) => {
            refuse_mistake(output, &args.file)?;
            Ok(output.clone())
        }
        (None, _) if args.file == Path::new("-") => {
            Err(Failure::Usage("say with -o where the picture of standard input is to go".into()))
        }
        (None, Some(stem)) => {
            let mut name = stem.to_owned();
            name.push(".png");
            Ok(name.into())
        }
        (None, None) => Err(Failure::folder("read", &args.file)),
    }
}

/// Names that promise what a picture is not, or that would cost the user a file.
fn refuse_mistake(output: &Path, input: &Path) -> Result<(), Failure> {
    let name = output.display();
    let same = |a: &Path, b: &Path| matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if same(output, input) {
        return Err(Failure::Usage(format!("the picture would replace the file that it is of, {name}")));
    }
    let extension = output.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    match extension.as_deref() {
        Some(other) if OTHER_FORMATS.contains(&other) => {
            let png = output.with_extension("png");
            Err(Failure::Usage(format!("{name}: pictures are PNG files, nothing else; name it {}", png.display())))
        }
        _ => Ok(()),
    }
}

/// What a file may be meant to be by its name, but is not. Names that say nothing, as `mktemp` makes them, are fine.
const OTHER_FORMATS: [&str; 27] = [
    "jpg", "jpeg", "gif", "bmp", "tif", "tiff", "webp", "avif", "heic", "ppm", "pgm", "pnm", "tga", "exr", "hdr",
    "svg", "pdf", "dxf", "stl", "off", "obj", "3mf", "amf", "wrl", "scad", "csg", "oct",
];

fn view(args: &RenderArgs, scene: &Scene, tracer: &Tracer) -> View {
    let (width_px, height_px) = args.view.size_px();
    View {
        camera: args.view.framing().camera_for(tracer, scene.camera, (width_px, height_px)),
        width_px,
        height_px,
        samples: args.look.samples,
        max_bounces: args.look.max_bounces,
        background: args.look.background(),
    }
}

fn stats<'a>(args: &RenderArgs, file: &'a str, tracer: &Tracer, seconds: Seconds, counts: &RenderStats) -> Stats<'a> {
    let rays = Rays::from(&counts.rays);
    Stats {
        file,
        width: args.view.size.width_px,
        height: args.view.size.height_px,
        samples: args.look.samples,
        threads: args.trace.threads(),
        accel: args.trace.accel.to_string(),
        traversal: args.trace.traversal.to_string(),
        seconds,
        peak_memory_bytes: peak_memory_bytes(),
        rays,
        mrays_per_second: rays.total as f64 / seconds.render.max(f64::MIN_POSITIVE) / 1e6,
        cells_visited: counts.counters.cells,
        surface_tests: counts.counters.surface_tests,
        leaks: counts.counters.leaks,
        solid: tracer.into(),
        octree: tracer.stats().octree.as_ref().map(Into::into),
        snap: tracer.into(),
    }
}
