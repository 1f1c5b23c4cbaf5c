//! Why a command did not succeed, and the exit code that says so. Every way to fail ends here.

use std::io;
use std::path::Path;

/// Why a command did not succeed.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The input has errors; they have been drawn already.
    #[error("the input has errors")]
    Input,
    /// The input is sound, but what was asked of it has no answer.
    #[error("{0}")]
    NoAnswer(String),
    /// The arguments contradict each other or the input; clap finds most of these itself.
    #[error("{0}")]
    Usage(String),
    /// A file cannot be read or written.
    #[error("cannot {verb} {what}: {why}")]
    File {
        /// What was to be done: "read", "write".
        verb: &'static str,
        /// The file's name, or what stands for it.
        what: String,
        /// What is in the way.
        why: String,
    },
    /// Somebody pressed Ctrl-C.
    #[error("interrupted")]
    Interrupted,
    /// Whoever read standard output has read enough. Not an error.
    #[error("standard output was closed")]
    ClosedPipe,
}

impl Failure {
    /// Interrupted: 128 + SIGINT, as shells report it.
    pub const INTERRUPTED: u8 = 130;

    /// `verb`ing the file at `path` failed.
    pub fn file(verb: &'static str, path: &Path, error: &io::Error) -> Self {
        Self::File { verb, what: path.display().to_string(), why: plain(error) }
    }

    /// `verb`ing the file at `path` is impossible: it is a folder.
    pub fn folder(verb: &'static str, path: &Path) -> Self {
        Self::File { verb, what: path.display().to_string(), why: "it is a folder".into() }
    }

    /// Writing to standard output failed.
    pub fn stdout(error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self::ClosedPipe,
            _ => Self::File { verb: "write", what: "standard output".into(), why: plain(error) },
        }
    }

    /// The process's exit code; `--help` and `docs/command-line.md` list them.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::ClosedPipe => 0,
            Self::Input | Self::NoAnswer(_) => 1,
            Self::Usage(_) => 2,
            Self::File { .. } => 3,
            Self::Interrupted => Self::INTERRUPTED,
        }
    }

    /// Whether the message is still to be printed: not where diagnostics have said it all, or silence is wanted.
    pub fn wants_message(&self) -> bool {
        !matches!(self, Self::Input | Self::ClosedPipe)
    }
}

impl From<octrace::exec::Cancelled> for Failure {
    fn from(_: octrace::exec::Cancelled) -> Self {
        Self::Interrupted
    }
}

/// The error in words, without Rust's "(os error 2)".
fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    let text = text.split(" (os error").next().unwrap_or(&text);
    let mut chars = text.chars();
    match chars.next() {
        Some(first) => first.to_lowercase().chain(chars).collect(),
        None => "unknown error".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_name_the_file_and_speak_plainly() {
        let missing = std::fs::read("no/such/file").unwrap_err();
        let failure = Failure::file("read", Path::new("no/such/file"), &missing);
        assert_eq!(failure.to_string(), "cannot read no/such/file: no such file or directory");
        assert_eq!(failure.exit_code(), 3);
    }

    #[test]
    fn a_closed_pipe_is_no_error() {
        let failure = Failure::stdout(&io::Error::from(io::ErrorKind::BrokenPipe));
        assert_eq!((failure.exit_code(), failure.wants_message()), (0, false));
    }
}
