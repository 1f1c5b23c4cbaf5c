//! Long work says how far it is, and stops when it is told to.

use octrace::exec::{CancelToken, Cancelled, Exec, Progress};
use octrace::film::{Background, View, render};
use octrace::model::frame_all;
use octrace::query::{MeasureOptions, measure};
use octrace::{Accel, Projection, Scene, Solid, Tracer, TracerOptions};
use std::sync::{Arc, Mutex};

/// What one stage said.
#[derive(Clone, Debug, PartialEq)]
struct Stage {
    name: &'static str,
    total: u64,
    done: u64,
    ended: bool,
}

/// Writes down what it hears; interrupts the work at its first step, if it is to.
#[derive(Default)]
struct Witness {
    stages: Mutex<Vec<Stage>>,
    interrupts: Option<CancelToken>,
}

impl Progress for Witness {
    fn begin(&self, name: &'static str, total: u64) {
        self.stages.lock().unwrap().push(Stage { name, total, done: 0, ended: false });
    }

    fn advance(&self, steps: u64) {
        self.stages.lock().unwrap().last_mut().expect("a stage has begun").done += steps;
        if let Some(token) = &self.interrupts {
            token.cancel();
        }
    }

    fn end(&self) {
        self.stages.lock().unwrap().last_mut().expect("a stage has begun").ended = true;
    }
}

fn drilled() -> Solid {
    let holes = (0..9).map(|i| Solid::cylinder().scale([0.1, 0.1, 1.0]).translate([0.1 * f64::from(i), 0.4, 0.0]));
    Solid::difference([Solid::block()].into_iter().chain(holes))
}

fn build(exec: &Exec) -> Result<Tracer, Cancelled> {
    Tracer::build(&drilled(), &TracerOptions::default(), exec)
}

fn draw(tracer: &Tracer, exec: &Exec) -> Result<(), Cancelled> {
    let camera = frame_all(&tracer.bounds(), None, Projection::Perspective { fov_deg: 22.5 }, (100, 60));
    let view = View { camera, width_px: 100, height_px: 60, samples: 1, max_bounces: 0, background: Background::Scene };
    render(&Scene::new(drilled()), tracer, &view, exec).map(|_| ())
}

#[test]
fn every_stage_ends_with_all_its_steps_done() {
    for threads in [1, 3] {
        let witness = Arc::new(Witness::default());
        let exec = Exec { progress: witness.clone(), ..Exec::with_threads(threads) };
        let tracer = build(&exec).expect("nobody cancels");
        draw(&tracer, &exec).expect("nobody cancels");
        measure(&tracer, &MeasureOptions { tolerance: 1e-2, ..MeasureOptions::default() }, &exec).expect("a solid");
        let stages = witness.stages.lock().unwrap();
        for stage in stages.iter() {
            assert!(stage.ended && stage.done == stage.total, "{stage:?}");
        }
        let mut names: Vec<&str> = stages.iter().map(|stage| stage.name).collect();
        names.dedup();
        assert_eq!(names, ["building the octree", "rendering", "finding the bounding box", "measuring"]);
    }
}

#[test]
fn work_that_is_interrupted_ends_with_its_stage() {
    let tracer = build(&Exec::default()).expect("nobody cancels");
    type Work<'a> = Box<dyn Fn(&Exec) -> bool + 'a>;
    let all: [(&str, Work); 3] = [
        ("build", Box::new(|exec| build(exec).is_err())),
        ("draw", Box::new(|exec| draw(&tracer, exec).is_err())),
        ("measure", Box::new(|exec| measure(&tracer, &MeasureOptions::default(), exec).is_err())),
    ];
    for (name, work) in &all {
        let cancel = CancelToken::new();
        let witness = Arc::new(Witness { interrupts: Some(cancel.clone()), ..Witness::default() });
        let exec = Exec { threads: 1, cancel, progress: witness.clone() };
        assert!(work(&exec), "{name} was not interrupted");
        let stages = witness.stages.lock().unwrap();
        assert!(stages.len() == 1 && stages[0].ended, "{name}: {stages:?}");
    }
}

#[test]
fn compiling_is_interrupted_too() {
    let cancel = CancelToken::new();
    cancel.cancel();
    let exec = Exec { cancel, ..Exec::with_threads(1) };
    let copies = Solid::union((0..40).map(|i| drilled().translate([3.0 * f64::from(i), 0.0, 0.0])));
    for solid in [drilled(), copies] {
        let without_octree = TracerOptions { accel: Accel::None, ..TracerOptions::default() };
        assert_eq!(Tracer::build(&solid, &without_octree, &exec).err(), Some(Cancelled));
    }
}
