//! Timing: every way to trace has its turn in every round, so that whatever the machine does besides meets all alike.

use super::context::Context;
use super::plan::Config;
use super::rays;
use super::scenes::StudyScene;
use super::survey::Picture;
use super::walk::Ways;
use crate::failure::Failure;
use crate::stats::Stopwatch;
use octrace::{Accel, Ray, Tracer, TracerOptions};

/// What one way to trace took, round by round, in seconds.
#[derive(Clone, Debug, Default)]
pub struct Times {
    /// Building the tracer.
    pub build_s: Vec<f64>,
    /// All its rays.
    pub trace_s: Vec<f64>,
    /// The pure walk.
    pub walk_s: Vec<f64>,
}

/// Every so many rays are traced before the clock starts, so that caches and tables are warm.
const WARM_UP_EVERY: usize = 8;

/// Times the configurations and, last in the result, the canonical tracer on its rays.
pub fn rounds(
    scene: &StudyScene,
    configs: &[Config],
    picture: &Picture<'_>,
    repeat: u32,
    context: &Context<'_>,
) -> Result<(Vec<Times>, Times), Failure> {
    let mut times = vec![Times::default(); configs.len()];
    let mut canonical = Times::default();
    context.progress.begin("timing", u64::from(repeat) * (configs.len() as u64 + 1));
    for round in 0..repeat {
        one_canonical(scene, picture, &mut canonical, context)?;
        context.progress.advance(1);
        // There and back again: what comes first in one round comes last in the next.
        for turn in 0..configs.len() {
            let i = if round % 2 == 0 { turn } else { configs.len() - 1 - turn };
            one(scene, &configs[i], picture, &mut times[i], context)?;
            context.progress.advance(1);
        }
    }
    context.progress.end();
    Ok((times, canonical))
}

fn one(
    scene: &StudyScene,
    config: &Config,
    picture: &Picture<'_>,
    times: &mut Times,
    context: &Context<'_>,
) -> Result<(), Failure> {
    let watch = Stopwatch::start();
    let tracer = context.build(scene, &config.options(scene.snap))?;
    times.build_s.push(watch.elapsed());
    times.trace_s.push(time_warm(&tracer, picture.rays, context)?);
    times.walk_s.push(Ways::new(&tracer, picture.walking()).time(context.interrupt)?);
    Ok(())
}

fn one_canonical(
    scene: &StudyScene,
    picture: &Picture<'_>,
    times: &mut Times,
    context: &Context<'_>,
) -> Result<(), Failure> {
    let watch = Stopwatch::start();
    let options = TracerOptions { accel: Accel::None, snap: scene.snap, ..TracerOptions::default() };
    let tracer = context.build(scene, &options)?;
    times.build_s.push(watch.elapsed());
    times.trace_s.push(rays::time(&tracer, picture.sparse.iter().map(|&i| &picture.rays[i]), context.interrupt)?);
    Ok(())
}

/// Times two configurations on a picture by turns, after they were built once: the seconds of each, round by round.
pub fn duel(
    scene: &StudyScene,
    [a, b]: [&Config; 2],
    all: &[Ray],
    repeat: u32,
    context: &Context<'_>,
) -> Result<[Vec<f64>; 2], Failure> {
    let tracers = [context.build(scene, &a.options(scene.snap))?, context.build(scene, &b.options(scene.snap))?];
    let mut times = [Vec::new(), Vec::new()];
    for round in 0..repeat as usize {
        for turn in 0..2 {
            let i = (round + turn) % 2;
            times[i].push(time_warm(&tracers[i], all, context)?);
        }
    }
    Ok(times)
}

fn time_warm(tracer: &Tracer, all: &[Ray], context: &Context<'_>) -> Result<f64, Failure> {
    rays::time(tracer, all.iter().step_by(WARM_UP_EVERY), context.interrupt)?;
    rays::time(tracer, all.iter(), context.interrupt)
}
