//! Timing one scene: everything has its turn in every round, so that whatever the machine does besides meets all alike.

use super::clock::{Took, timed};
use super::picture::Picture;
use super::results::{Row, Spreads};
use super::scenes::BenchScene;
use crate::failure::Failure;
use crate::framing::Framing;
use crate::session::Session;
use crate::statistics::Spread;
use octrace::compile::compile;
use octrace::exec::{Exec, Silent};
use octrace::film::{Background, RenderStats, View, render};
use octrace::model::default_lights;
use octrace::{Camera, Light, Scene, Solid, Tracer, TracerOptions};
use octrace_read::{ReadOptions, read_scene};
use std::hint::black_box;
use std::sync::Arc;

/// How is measured.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Rounds.
    pub repeat: u32,
    /// Threads of the measurement with several; 1 leaves it out.
    pub threads: usize,
    /// Pixels of the pictures.
    pub size_px: (u32, u32),
    /// How files are read.
    pub read: ReadOptions,
    /// How tracers are built.
    pub tracer: TracerOptions,
}

/// How often light is followed, as `render` does by default.
const MAX_BOUNCES: u32 = 8;

/// What takes longer than this is built in the first round only.
const LONG_BUILD_S: f64 = 1.0;

/// Each round's values, in seconds.
#[derive(Debug, Default)]
struct Times {
    parse: Vec<f64>,
    compile: Vec<f64>,
    build: Vec<f64>,
    /// One thread, by processor time.
    picture: Vec<f64>,
    /// One thread over several, by the wall's clock.
    speedup: Vec<f64>,
    shadowed: Vec<f64>,
    frame: Vec<f64>,
}

/// Measures a scene.
pub fn measure(scene: &BenchScene, plan: &Plan, session: &Session) -> Result<Row, Failure> {
    let progress = session.progress("preparing");
    let exec = Exec { threads: 1, cancel: session.interrupt.token(), progress: Arc::new(Silent) };
    let _listening = session.interrupt.listen();
    let bench = Bench { scene, plan, session, exec, bodies: scene.scene.bodies().solids };
    let mut times = Times::default();

    progress.begin("measuring", u64::from(plan.repeat) + 1);
    let tracer = bench.build(&mut times)?;
    let camera = Framing::default().camera_for(&tracer, scene.scene.camera, plan.size_px);
    let frames = Frames::new(&scene.scene, camera, plan.size_px);
    let picture = Picture::new(&tracer, &camera, frames.light, plan.size_px);
    let mut pixels = picture.pixels();
    // Not timed: so that caches and tables are warm.
    let mut leaks = picture.draw(&mut pixels, plan.threads, &session.interrupt).leaks;
    progress.advance(1);
    let (mut rays, mut one_light) = (RenderStats::default(), RenderStats::default());
    for round in 0..plan.repeat {
        bench.read(&mut times);
        if round > 0 && times.build[0] < LONG_BUILD_S {
            bench.build(&mut times)?;
        }
        let one = bench.picture(&picture, &mut pixels, 1)?;
        times.picture.push(one.cpu_s);
        if plan.threads > 1 {
            let several = bench.picture(&picture, &mut pixels, plan.threads)?;
            times.speedup.push(one.wall_s / several.wall_s.max(f64::MIN_POSITIVE));
        }
        one_light = bench.frame(&frames.lit_once, &tracer, &frames.view_of_one_bounce(), &mut times.shadowed)?;
        rays = bench.frame(&scene.scene, &tracer, &frames.view, &mut times.frame)?;
        leaks += rays.counters.leaks;
        progress.advance(1);
    }
    progress.end();

    let stats = tracer.stats();
    let spreads = spreads(&times, frames.pixels(), one_light.rays.camera + one_light.rays.shadow);
    Ok(Row {
        scene: scene.name.clone(),
        primitives: stats.primitives,
        surfaces: stats.surfaces,
        bytes: stats.octree.map_or(0, |octree| octree.bytes),
        file_bytes: scene.source.as_ref().map(|source| source.text().len()),
        parse_s: spreads.parse_s.map(|spread| spread.median),
        compile_s: spreads.compile_s.median,
        build_s: spreads.build_s.median,
        mrays_per_s: spreads.mrays_per_s.median,
        limit_mrays_per_s: None,
        ratio_to_limit: None,
        threads: plan.threads,
        speedup: spreads.speedup.map(|spread| spread.median),
        shadowed_mrays_per_s: spreads.shadowed_mrays_per_s.median,
        frame_s: spreads.frame_s.median,
        frame_rays: (&rays.rays).into(),
        leaks,
        spread: spreads,
    })
}

fn spreads(times: &Times, pixels: u64, shadowed_rays: u64) -> Spreads {
    let seconds = |values: &[f64]| Spread::of(values.iter().copied());
    let rates = |values: &[f64], rays: u64| {
        Spread::of(values.iter().map(|seconds| rays as f64 / 1e6 / seconds.max(f64::MIN_POSITIVE)))
    };
    let some = |values: &[f64]| (!values.is_empty()).then(|| seconds(values));
    Spreads {
        parse_s: some(&times.parse),
        compile_s: seconds(&times.compile),
        build_s: seconds(&times.build),
        mrays_per_s: rates(&times.picture, pixels),
        ratio_to_limit: None,
        speedup: some(&times.speedup),
        shadowed_mrays_per_s: rates(&times.shadowed, shadowed_rays),
        frame_s: seconds(&times.frame),
    }
}

/// What is drawn beside the plain picture.
struct Frames {
    view: View,
    /// The light of the plain picture.
    light: Light,
    /// The scene with this light only.
    lit_once: Scene,
}

impl Frames {
    fn new(scene: &Scene, camera: Camera, (width_px, height_px): (u32, u32)) -> Self {
        let lights = if scene.lights.is_empty() { default_lights(&camera) } else { scene.lights.clone() };
        let light = lights[0];
        let view =
            View { camera, width_px, height_px, samples: 1, max_bounces: MAX_BOUNCES, background: Background::Scene };
        Self { view, light, lit_once: Scene { lights: vec![light], ..scene.clone() } }
    }

    fn view_of_one_bounce(&self) -> View {
        View { max_bounces: 0, ..self.view }
    }

    fn pixels(&self) -> u64 {
        u64::from(self.view.width_px) * u64::from(self.view.height_px)
    }
}

/// One scene that is being measured.
struct Bench<'a> {
    scene: &'a BenchScene,
    plan: &'a Plan,
    session: &'a Session,
    /// One thread.
    exec: Exec,
    bodies: Vec<Solid>,
}

impl Bench<'_> {
    /// Reads the file again.
    fn read(&self, times: &mut Times) {
        if let Some(source) = &self.scene.source {
            let (_, took) = timed(|| black_box(read_scene(source, &self.plan.read)));
            times.parse.push(took.cpu_s);
        }
    }

    /// Compiles, and builds.
    fn build(&self, times: &mut Times) -> Result<Tracer, Failure> {
        let options = TracerOptions { snap: self.scene.scene.snap, ..self.plan.tracer };
        let (_, took) = timed(|| black_box(compile(&self.bodies, options.snap)));
        times.compile.push(took.cpu_s);
        let (tracer, took) = timed(|| Tracer::build_bodies(&self.bodies, &options, &self.exec));
        times.build.push(took.cpu_s);
        Ok(tracer?)
    }

    fn picture(&self, picture: &Picture<'_>, pixels: &mut [f32], threads: usize) -> Result<Took, Failure> {
        let (_, took) = timed(|| picture.draw(pixels, threads, &self.session.interrupt));
        black_box(pixels);
        if self.session.interrupt.happened() { Err(Failure::Interrupted) } else { Ok(took) }
    }

    fn frame(&self, scene: &Scene, tracer: &Tracer, view: &View, times: &mut Vec<f64>) -> Result<RenderStats, Failure> {
        let (rendered, took) = timed(|| render(scene, tracer, view, &self.exec));
        let (film, stats) = rendered?;
        black_box(film);
        times.push(took.cpu_s);
        Ok(stats)
    }
}
