//! How work is done, never what: threads, progress, interruption. Nothing here changes one bit of a result.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Receives progress of long work. Called from several threads.
pub trait Progress: Send + Sync {
    /// A stage begins that consists of `total` steps.
    fn begin(&self, stage: &'static str, total: u64);
    /// So many more steps are done.
    fn advance(&self, steps: u64);
    /// The stage is over.
    fn end(&self);
}

/// Progress that nobody looks at.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn begin(&self, _stage: &'static str, _total: u64) {}
    fn advance(&self, _steps: u64) {}
    fn end(&self) {}
}

/// A flag to interrupt long work; clones share it.
#[derive(Clone, Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// A token that is not cancelled.
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks the work to stop soon.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether somebody asked the work to stop.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// An error as soon as somebody asked the work to stop.
    ///
    /// # Errors
    /// [`Cancelled`] after [`cancel`](Self::cancel).
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}

/// The work was interrupted through its [`CancelToken`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("interrupted")]
pub struct Cancelled;

/// Runs `work`, which recurses up to `levels` deep, where the stack has room for it.
pub(crate) fn with_stack_for<T>(levels: usize, work: impl FnOnce() -> T) -> T {
    /// What one level of any recursion over programs takes at most, in unoptimised code.
    const LEVEL_BYTES: usize = 2 << 10;
    /// Any thread has this much.
    const SHALLOW: usize = 64;
    if levels <= SHALLOW {
        return work();
    }
    let bytes = levels * LEVEL_BYTES;
    stacker::maybe_grow(bytes, 2 * bytes, work)
}

/// Threads, interruption and progress of one piece of work.
#[derive(Clone)]
pub struct Exec {
    /// How many threads to use; 0 means one for each core.
    pub threads: usize,
    /// Interrupts the work.
    pub cancel: CancelToken,
    /// Hears how far the work is.
    pub progress: Arc<dyn Progress>,
}

impl fmt::Debug for Exec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Exec").field("threads", &self.threads).field("cancel", &self.cancel).finish_non_exhaustive()
    }
}

impl Default for Exec {
    /// All cores, silent.
    fn default() -> Self {
        Self { threads: 0, cancel: CancelToken::new(), progress: Arc::new(Silent) }
    }
}

impl Exec {
    /// As many threads as given, silent.
    pub fn with_threads(threads: usize) -> Self {
        Self { threads, ..Self::default() }
    }

    /// Runs `work` where rayon's parallel iterators use the threads asked for.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match rayon::ThreadPoolBuilder::new().num_threads(self.threads).build() {
            Ok(pool) => pool.install(work),
            // No threads to be had: whatever pool there is must do, and at worst this very thread.
            Err(_) => work(),
        }
    }
}
