//! What every measurement needs: one thread, Ctrl-C, and whoever wants to know how far it is.

use super::scenes::StudyScene;
use crate::failure::Failure;
use crate::interrupt::{Interrupt, Listening};
use crate::session::Session;
use octrace::compile::Copies;
use octrace::exec::{Exec, Progress, Silent};
use octrace::{Tracer, TracerOptions};
use std::sync::Arc;

/// How measurements are made.
pub struct Context<'a> {
    /// Ctrl-C.
    pub interrupt: &'a Interrupt,
    /// Hears how far the study is.
    pub progress: Arc<dyn Progress>,
    exec: Exec,
    _listening: Listening,
}

impl<'a> Context<'a> {
    /// Threads that measure: what two threads do to each other's time differs from machine to machine.
    pub const THREADS: usize = 1;

    /// For one run of the program.
    pub fn new(session: &'a Session) -> Self {
        let exec = Exec { threads: Self::THREADS, cancel: session.interrupt.token(), progress: Arc::new(Silent) };
        let progress = session.progress("preparing");
        Self { interrupt: &session.interrupt, progress, exec, _listening: session.interrupt.listen() }
    }

    /// Builds a tracer for a scene. What is studied are octrees of whole scenes, so no solid stands for others.
    pub fn build(&self, scene: &StudyScene, options: &TracerOptions) -> Result<Tracer, Failure> {
        let options = TracerOptions { copies: Copies::Apart, ..*options };
        Ok(Tracer::build_bodies(&scene.bodies, &options, &self.exec)?)
    }
}
