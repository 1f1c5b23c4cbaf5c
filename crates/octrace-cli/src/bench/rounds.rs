//! Timing one scene: everything has its turn in every round, so that whatever the machine does besides meets all alike.

use super::clock::timed;
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
use octrace::trace::Told;
use octrace::{Scene, Solid, Tracer, TracerOptions};
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

/// Each round's values, in seconds of processor time.
#[derive(Debug, Default)]
struct Times {
    parse: Vec<f64>,
    compile: Vec<f64>,
    build: Vec<f64>,
    picture: Vec<f64>,
    /// The picture if each pixel were told what it shows.
    limit: Vec<f64>,
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
    let workshop = Workshop { scene, plan, exec: &exec, bodies: scene.scene.bodies().solids };
    let mut times = Times::default();

    progress.begin("measuring", u64::from(plan.repeat) + 1);
    let tracer = workshop.build(&mut times)?;
    let mut studio = Studio::new(&scene.scene, &tracer, plan, session, &exec);
    studio.warm_up()?;
    progress.advance(1);
    for round in 0..plan.repeat {
        workshop.read(&mut times);
        if round > 0 && times.build[0] < LONG_BUILD_S {
            workshop.build(&mut times)?;
        }
        studio.pictures(&mut times)?;
        studio.frames(&mut times)?;
        progress.advance(1);
    }
    progress.end();
    Ok(row(scene, &tracer, &studio, &times, plan))
}

/// From text to tracer.
struct Workshop<'a> {
    scene: &'a BenchScene,
    plan: &'a Plan,
    exec: &'a Exec,
    bodies: Vec<Solid>,
}

impl Workshop<'_> {
    /// Reads the file again, if there is one.
    fn read(&self, times: &mut Times) {
        if let Some(source) = &self.scene.source {
            let (_, took) = timed(|| black_box(read_scene(source, &self.plan.read)));
            times.parse.push(took.cpu_s);
        }
    }

    /// Compiles; and compiles and builds.
    fn build(&self, times: &mut Times) -> Result<Tracer, Failure> {
        let options = TracerOptions { snap: self.scene.scene.snap, ..self.plan.tracer };
        let (_, took) = timed(|| black_box(compile(&self.bodies, options.snap, options.copies)));
        times.compile.push(took.cpu_s);
        let (tracer, took) = timed(|| Tracer::build_bodies(&self.bodies, &options, self.exec));
        times.build.push(took.cpu_s);
        Ok(tracer?)
    }
}

/// From tracer to pictures.
struct Studio<'a> {
    scene: &'a Scene,
    /// The same with the light of the plain picture only.
    lit_once: Scene,
    tracer: &'a Tracer,
    plan: &'a Plan,
    session: &'a Session,
    exec: &'a Exec,
    picture: Picture<'a>,
    pixels: Vec<f32>,
    /// What each pixel shows, if it can be told.
    told: Option<Vec<Told>>,
    view: View,
    /// Camera and shadow rays of the scene lit once.
    shadowed_rays: u64,
    /// What was counted in the last whole frame.
    counted: RenderStats,
    leaks: u64,
}

impl<'a> Studio<'a> {
    fn new(scene: &'a Scene, tracer: &'a Tracer, plan: &'a Plan, session: &'a Session, exec: &'a Exec) -> Self {
        let camera = Framing::default().camera_for(tracer, scene.camera, plan.size_px);
        let lights = if scene.lights.is_empty() { default_lights(&camera) } else { scene.lights.clone() };
        let light = lights[0];
        let picture = Picture::new(tracer, &camera, light, plan.size_px);
        let (width_px, height_px) = plan.size_px;
        let background = Background::Scene;
        Self {
            scene,
            lit_once: Scene { lights: vec![light], ..scene.clone() },
            tracer,
            plan,
            session,
            exec,
            pixels: picture.pixels(),
            told: picture.told(),
            picture,
            view: View { camera, width_px, height_px, samples: 1, max_bounces: MAX_BOUNCES, background },
            shadowed_rays: 0,
            counted: RenderStats::default(),
            leaks: 0,
        }
    }

    /// One picture that is not timed, so that caches and tables are warm.
    fn warm_up(&mut self) -> Result<(), Failure> {
        self.draw(self.plan.threads).map(|_| ())
    }

    /// The plain picture, by one thread and by several, and the limit.
    fn pictures(&mut self, times: &mut Times) -> Result<(), Failure> {
        let (one_cpu_s, one_wall_s) = self.draw(1)?;
        times.picture.push(one_cpu_s);
        if let Some(told) = &self.told {
            let (_, took) = timed(|| self.picture.draw_told(told, &mut self.pixels));
            times.limit.push(took.cpu_s);
        }
        if self.plan.threads > 1 {
            let (_, several_wall_s) = self.draw(self.plan.threads)?;
            times.speedup.push(one_wall_s / several_wall_s.max(f64::MIN_POSITIVE));
        }
        Ok(())
    }

    /// Draws the plain picture; seconds of processor time, and on the wall.
    fn draw(&mut self, threads: usize) -> Result<(f64, f64), Failure> {
        let (counters, took) = timed(|| self.picture.draw(&mut self.pixels, threads, &self.session.interrupt));
        black_box(&self.pixels);
        self.leaks += counters.leaks;
        if self.session.interrupt.happened() { Err(Failure::Interrupted) } else { Ok((took.cpu_s, took.wall_s)) }
    }

    /// The frame with one light and nothing mirrored, and the whole frame, which begins with finding where to look from.
    fn frames(&mut self, times: &mut Times) -> Result<(), Failure> {
        let view = View { max_bounces: 0, ..self.view };
        let (rendered, took) = timed(|| render(&self.lit_once, self.tracer, &view, self.exec));
        let (_, stats) = rendered?;
        self.shadowed_rays = stats.rays.camera + stats.rays.shadow;
        times.shadowed.push(took.cpu_s);

        let (rendered, took) = timed(|| {
            black_box(Framing::default().camera_for(self.tracer, self.scene.camera, self.plan.size_px));
            render(self.scene, self.tracer, &self.view, self.exec)
        });
        self.counted = rendered?.1;
        self.leaks += self.counted.counters.leaks;
        times.frame.push(took.cpu_s);
        Ok(())
    }
}

fn row(scene: &BenchScene, tracer: &Tracer, studio: &Studio<'_>, times: &Times, plan: &Plan) -> Row {
    let stats = tracer.stats();
    let (width, height) = plan.size_px;
    let spread = spreads(times, u64::from(width) * u64::from(height), studio.shadowed_rays);
    Row {
        scene: scene.name.clone(),
        primitives: stats.primitives,
        surfaces: stats.surfaces,
        bytes: stats.octree.map_or(0, |octree| octree.bytes),
        file_bytes: scene.source.as_ref().map(|source| source.text().len()),
        parse_s: spread.parse_s.map(|spread| spread.median),
        compile_s: spread.compile_s.median,
        build_s: spread.build_s.median,
        mrays_per_s: spread.mrays_per_s.median,
        limit_mrays_per_s: spread.limit_mrays_per_s.map(|spread| spread.median),
        ratio_to_limit: spread.ratio_to_limit.map(|spread| spread.median),
        threads: plan.threads,
        speedup: spread.speedup.map(|spread| spread.median),
        shadowed_mrays_per_s: spread.shadowed_mrays_per_s.median,
        frame_s: spread.frame_s.median,
        frame_rays: (&studio.counted.rays).into(),
        leaks: studio.leaks,
        spread,
    }
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
        limit_mrays_per_s: (!times.limit.is_empty()).then(|| rates(&times.limit, pixels)),
        ratio_to_limit: (!times.limit.is_empty()).then(|| Spread::of_ratios(&times.picture, &times.limit)),
        speedup: some(&times.speedup),
        shadowed_mrays_per_s: rates(&times.shadowed, shadowed_rays),
        frame_s: seconds(&times.frame),
    }
}
