//! A progress bar on standard error, if that is a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use octrace::exec::Progress;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Shows one bar per stage, and takes it away when the stage ends. Stages that are over at once show none.
pub struct Bar {
    stage: Mutex<Stage>,
}

struct Stage {
    bar: ProgressBar,
    /// When the bar is to appear; `None` once it has.
    appears: Option<Instant>,
}

/// A bar that appears and vanishes before it can be read only flickers.
const PATIENCE: Duration = Duration::from_millis(300);

impl Bar {
    /// No stage yet.
    pub fn new() -> Self {
        Self { stage: Mutex::new(Stage { bar: ProgressBar::hidden(), appears: None }) }
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
        *self.stage() = Stage { bar, appears: Some(Instant::now() + PATIENCE) };
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
