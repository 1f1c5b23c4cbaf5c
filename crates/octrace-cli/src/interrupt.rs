//! Ctrl-C: asks the running stage to stop, and ends the process where nobody listens or answers. No file is left behind
//! either way.

use crate::failure::Failure;
use crate::output::{clear_line, say_error};
use octrace::exec::CancelToken;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// How long a stage may take to stop.
const PATIENCE: Duration = Duration::from_secs(1);

/// What Ctrl-C does, shared with the signal handler.
#[derive(Clone, Default)]
pub struct Interrupt {
    token: CancelToken,
    listeners: Arc<AtomicUsize>,
    files: Arc<Mutex<()>>,
    announced: Arc<AtomicBool>,
}

/// While this lives, somebody polls the token.
pub struct Listening(Arc<AtomicUsize>);

impl Interrupt {
    /// Takes Ctrl-C over for this process.
    pub fn install() -> Self {
        let interrupt = Self::default();
        let handler = interrupt.clone();
        // Where there is no handler to be had, Ctrl-C still ends the process, at once.
        let _ = ctrlc::set_handler(move || handler.happen());
        interrupt
    }

    /// An interrupt that no key triggers.
    #[cfg(test)]
    pub fn never() -> Self {
        Self::default()
    }

    /// While the value lives, Ctrl-C leaves it to whoever polls the token to stop, if that does not take long.
    #[must_use]
    pub fn listen(&self) -> Listening {
        self.listeners.fetch_add(1, Ordering::SeqCst);
        Listening(Arc::clone(&self.listeners))
    }

    /// While the value lives, there may be temporary files, and Ctrl-C does not end the process.
    pub fn hold_back(&self) -> MutexGuard<'_, ()> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The token for the core.
    pub fn token(&self) -> CancelToken {
        self.token.clone()
    }

    /// Whether Ctrl-C was pressed.
    pub fn happened(&self) -> bool {
        self.token.is_cancelled()
    }

    /// Says that the process was interrupted, if that was not said yet.
    pub fn announce(&self) {
        if !self.announced.swap(true, Ordering::SeqCst) {
            // There may be a progress bar.
            clear_line();
            say_error(&Failure::Interrupted.to_string());
        }
    }

    /// Runs in a thread of its own.
    fn happen(&self) {
        self.token.cancel();
        if self.listeners.load(Ordering::SeqCst) > 0 {
            thread::sleep(PATIENCE);
        }
        // Kept to the end, so that no temporary file can appear any more.
        let _no_files = self.hold_back();
        self.announce();
        std::process::exit(Failure::INTERRUPTED.into());
    }
}

impl Drop for Listening {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::SeqCst);
    }
}
