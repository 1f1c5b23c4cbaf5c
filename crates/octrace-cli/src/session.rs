//! What every command needs: Ctrl-C, progress, and how much to say.

use crate::args::TraceArgs;
use crate::diagnostics::Show;
use crate::interrupt::{Interrupt, Listening};
use crate::output::say;
use crate::progress::{Bar, Spinner};
use octrace::Tracer;
use octrace::exec::{Exec, Progress, Silent};
use std::sync::Arc;

/// One run of the program.
pub struct Session {
    /// Ctrl-C.
    pub interrupt: Interrupt,
    /// Which diagnostics are shown; with errors only, nothing else is said either.
    pub show: Show,
}

impl Session {
    /// Takes over Ctrl-C.
    pub fn start(show: Show) -> Self {
        Self { interrupt: Interrupt::install(), show }
    }

    /// How the core is to work. While the second value lives, Ctrl-C is left to the core.
    pub fn exec(&self, args: &TraceArgs) -> (Exec, Listening) {
        let progress = self.progress("compiling");
        let threads = args.threads.unwrap_or(0) as usize;
        (Exec { threads, cancel: self.interrupt.token(), progress }, self.interrupt.listen())
    }

    /// The same for work that is too short for a progress bar.
    pub fn silent_exec(&self) -> (Exec, Listening) {
        (Exec { threads: 0, cancel: self.interrupt.token(), progress: Arc::new(Silent) }, self.interrupt.listen())
    }

    /// Shows the stages of long work to people; before the first one begins, what stands in `before`.
    pub fn progress(&self, before: &'static str) -> Arc<dyn Progress> {
        match self.show {
            Show::All => Arc::new(Bar::new(before)),
            Show::Errors => Arc::new(Silent),
        }
    }

    /// While the value lives, people who wait see what for.
    pub fn busy(&self, with: &'static str) -> Option<Spinner> {
        (self.show == Show::All).then(|| Spinner::start(with))
    }

    /// Says what the import tolerance did to the solid, if it did anything.
    pub fn remark_on_snapping(&self, tracer: &Tracer) {
        let report = tracer.compile_report();
        let moved = match report.snapped_surfaces {
            0 => return,
            1 => "1 surface was moved".to_owned(),
            n => format!("{n} surfaces were moved"),
        };
        self.remark(&format!(
            "note: {moved}, by {:.1e} at most, to coincide with others; --snap 0 prevents that",
            report.largest_move
        ));
    }

    /// Says something that is not an error, unless quiet is wanted.
    pub fn remark(&self, text: &str) {
        if self.show == Show::All {
            say(text);
        }
    }
}
