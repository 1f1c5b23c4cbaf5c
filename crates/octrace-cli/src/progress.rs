//! What is going on, on standard error, if that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use octrace::exec::Progress;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// What appears and vanishes before it can be read only flickers.
const PATIENCE: Duration = Duration::from_millis(300);

/// Shows one bar per stage, and takes it away when the stage ends. Stages that are over at once show none.
pub struct Bar {
    stage: Mutex<Stage>,
}

struct Stage {
    bar: ProgressBar,
    /// When the bar is to appear; `None` once it has.
    appears: Option<Instant>,
    /// What is shown before the first stage.
    before: Option<Spinner>,
}

impl Bar {
    /// No stage yet, but work nobody can tell the length of.
    pub fn new(before: &'static str) -> Self {
        let before = Some(Spinner::start(before));
        Self { stage: Mutex::new(Stage { bar: ProgressBar::hidden(), appears: None, before }) }
    }

    fn stage(&self) -> MutexGuard<'_, Stage> {
        self.stage.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Progress for Bar {
    fn begin(&self, stage: &'static str, total: u64) {
        let style = ProgressStyle::with_template("{prefix} {wide_bar} {percent:>3} %  {eta} left")
            .expect("the template is well formed");
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::hidden());
        bar.set_style(style);
        bar.set_prefix(stage);
        let mut current = self.stage();
        current.before = None;
        *current = Stage { bar, appears: Some(Instant::now() + PATIENCE), before: None };
    }

    fn advance(&self, steps: u64) {
        let mut stage = self.stage();
        stage.bar.inc(steps);
        if stage.appears.is_some_and(|appears| appears <= Instant::now()) {
            stage.appears = None;
            // Hidden where standard error is no terminal.
            stage.bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(10));
        }
    }

    fn end(&self) {
        self.stage().bar.finish_and_clear();
    }
}

/// Says that something takes its time, for as long as the value lives.
pub struct Spinner {
    /// Dropped to end the thread.
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Spinner {
    /// Appears after a moment.
    pub fn start(what: &'static str) -> Self {
        let (stop, stopped) = channel::<()>();
        let show = move || {
            if stopped.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                let style = ProgressStyle::with_template("{msg} {spinner}  {elapsed}").expect("it is well formed");
                let spinner = ProgressBar::new_spinner().with_style(style).with_message(what);
                while stopped.recv_timeout(PATIENCE / 2) == Err(RecvTimeoutError::Timeout) {
                    spinner.tick();
                }
                spinner.finish_and_clear();
            }
        };
        // Without a thread to be had, nothing is shown.
        Self { stop: Some(stop), thread: thread::Builder::new().spawn(show).ok() }
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        self.stop = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
