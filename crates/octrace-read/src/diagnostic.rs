//! What a reader has to say about a file: plain data. How it is drawn is the caller's business.

use crate::SourceRange;

/// How serious a [`Diagnostic`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Severity {
    /// Worth knowing; nothing is wrong.
    Note,
    /// The file can be used, but perhaps not as meant.
    Warning,
    /// The file cannot be used as it is.
    Error,
}

/// One thing that a reader has to say, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How serious it is.
    pub severity: Severity,
    /// A stable name for this kind of diagnostic, such as `radius-not-positive`.
    pub code: &'static str,
    /// What was found, in a sentence without a full stop.
    pub message: String,
    /// The place.
    pub at: SourceRange,
    /// Other places that matter, each with what it is.
    pub notes: Vec<(SourceRange, String)>,
    /// What would be right.
    pub help: Option<String>,
    /// How many of this kind it stands for: 1, but for the last one where there are too many to say each.
    pub count: usize,
}

impl Diagnostic {
    /// A diagnostic without notes and help.
    pub fn new(severity: Severity, code: &'static str, at: SourceRange, message: impl Into<String>) -> Self {
        Self { severity, code, message: message.into(), at, notes: Vec::new(), help: None, count: 1 }
    }

    /// An error without notes and help.
    pub fn error(code: &'static str, at: SourceRange, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, at, message)
    }

    /// A warning without notes and help.
    pub fn warning(code: &'static str, at: SourceRange, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, at, message)
    }

    /// A note: something worth knowing.
    pub fn note(code: &'static str, at: SourceRange, message: impl Into<String>) -> Self {
        Self::new(Severity::Note, code, at, message)
    }

    /// The same with another place that matters.
    #[must_use]
    pub fn with_note(mut self, at: SourceRange, message: impl Into<String>) -> Self {
        self.notes.push((at, message.into()));
        self
    }

    /// The same with a word on what would be right.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// What a reader returns: all that it understood, and all that it has to say.
#[derive(Clone, Debug)]
pub struct Checked<T> {
    /// What was understood.
    pub value: Option<T>,
    /// In the order of the file.
    pub diagnostics: Vec<Diagnostic>,
}

impl<T> Checked<T> {
    /// Whether any diagnostic is an error.
    pub fn has_errors(&self) -> bool {
        has_errors(&self.diagnostics)
    }
}

/// Whether any of the diagnostics is an error.
pub(crate) fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|d| d.severity == Severity::Error)
}

/// Collects diagnostics and keeps repeated noise short: of each code the first few are kept, the others counted.
#[derive(Debug, Default)]
pub(crate) struct Collector {
    kept: Vec<Diagnostic>,
    codes: Vec<CodeCount>,
}

#[derive(Debug)]
struct CodeCount {
    code: &'static str,
    severity: Severity,
    count: usize,
    first_left_out: SourceRange,
}

impl Collector {
    /// How many diagnostics of one code and severity are kept.
    pub const KEPT_PER_CODE: usize = 50;

    /// Codes of which every single one is wanted: a list of these is what the user asked for.
    const NEVER_SHORTENED: [&'static str; 1] = ["unsupported-node"];

    pub fn push(&mut self, diagnostic: Diagnostic) {
        let Diagnostic { code, severity, at, .. } = diagnostic;
        let known = self.codes.iter().position(|c| c.code == code && c.severity == severity);
        let index = known.unwrap_or_else(|| {
            self.codes.push(CodeCount { code, severity, count: 0, first_left_out: at });
            self.codes.len() - 1
        });
        let entry = &mut self.codes[index];
        entry.count += 1;
        if entry.count <= Self::KEPT_PER_CODE || Self::NEVER_SHORTENED.contains(&code) {
            self.kept.push(diagnostic);
        } else if entry.count == Self::KEPT_PER_CODE + 1 {
            entry.first_left_out = at;
        }
    }

    /// How many there were.
    pub fn count(&self) -> usize {
        self.codes.iter().map(|code| code.count).sum()
    }

    /// Whether an error was among them.
    pub fn has_errors(&self) -> bool {
        has_errors(&self.kept)
    }

    /// Everything that was said, in the order of the file.
    pub fn finish(mut self) -> Vec<Diagnostic> {
        for c in &self.codes {
            if c.count > Self::KEPT_PER_CODE && !Self::NEVER_SHORTENED.contains(&c.code) {
                let more = c.count - Self::KEPT_PER_CODE;
                let message = format!("and {more} more of this kind, from here on");
                let rest = Diagnostic::new(c.severity, c.code, c.first_left_out, message);
                self.kept.push(Diagnostic { count: more, ..rest });
            }
        }
        self.kept.sort_by_key(|d| d.at.start);
        self.kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_noise_is_counted() {
        let mut collector = Collector::default();
        for i in 0..80 {
            collector.push(Diagnostic::error("noise", SourceRange::new(i, i + 1), "again"));
            collector.push(Diagnostic::error("unsupported-node", SourceRange::new(i, i + 1), "hull"));
        }
        let all = collector.finish();
        assert_eq!(all.iter().filter(|d| d.code == "unsupported-node").count(), 80);
        let noise: Vec<_> = all.iter().filter(|d| d.code == "noise").collect();
        assert_eq!(noise.len(), 51);
        assert_eq!(noise[50].message, "and 30 more of this kind, from here on");
        assert_eq!(noise[50].at, SourceRange::new(50, 51));
        assert_eq!(noise.iter().map(|d| d.count).sum::<usize>(), 80);
    }
}
