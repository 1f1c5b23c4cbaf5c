//! Ctrl-C: the first one asks the running stage to stop, or ends the process where no stage listens; none of them
//! leaves a file behind.

use crate::failure::Failure;
use octrace::exec::CancelToken;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What Ctrl-C does, shared with the signal handler.
#[derive(Clone, Default)]
pub struct Interrupt {
    token: CancelToken,
    listening: Arc<AtomicUsize>,
    holding_back: Arc<AtomicUsize>,
}

/// While this lives, the counter is one higher.
pub struct Counted(Arc<AtomicUsize>);

impl Interrupt {
    /// Takes Ctrl-C over for this process. Until [`listen`](Self::listen), it ends the process at once.
    pub fn install() -> Self {
        let interrupt = Self::default();
        let handler = interrupt.clone();
        // Where there is no handler to be had, Ctrl-C still ends the process; output files are safe either way.
        let _ = ctrlc::set_handler(move || handler.happen());
        interrupt
    }

    /// An interrupt that no key triggers.
    #[cfg(test)]
    pub fn never() -> Self {
        Self::default()
    }

    /// While the value lives, somebody polls the token: the first Ctrl-C only sets it, a second one ends the process.
    #[must_use]
    pub fn listen(&self) -> Counted {
        Counted::up(&self.listening)
    }

    /// While the value lives, the process is not ended, so that a temporary file can be removed.
    #[must_use]
    pub fn hold_back(&self) -> Counted {
        Counted::up(&self.holding_back)
    }

    /// The token for the core.
    pub fn token(&self) -> CancelToken {
        self.token.clone()
    }

    /// Whether Ctrl-C was pressed.
    pub fn happened(&self) -> bool {
        self.token.is_cancelled()
    }

    fn happen(&self) {
        let again = self.token.is_cancelled();
        self.token.cancel();
        let listening = self.listening.load(Ordering::SeqCst) > 0;
        let holding_back = self.holding_back.load(Ordering::SeqCst) > 0;
        if !holding_back && (again || !listening) {
            std::process::exit(Failure::INTERRUPTED.into());
        }
    }
}

impl Counted {
    fn up(counter: &Arc<AtomicUsize>) -> Self {
        counter.fetch_add(1, Ordering::SeqCst);
        Self(Arc::clone(counter))
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::SeqCst);
    }
}
