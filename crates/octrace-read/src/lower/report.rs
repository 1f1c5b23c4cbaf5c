//! Where lowering says what it has to say, and what it must know to say it right.

use crate::diagnostic::{Collector, Diagnostic};
use crate::{Dialect, SourceRange};
use std::collections::HashSet;

/// The ear for diagnostics.
pub(super) struct Report<'r> {
    pub text: &'r str,
    pub dialect: Dialect,
    out: &'r mut Collector,
    said: HashSet<(String, String)>,
}

impl<'r> Report<'r> {
    pub fn new(text: &'r str, dialect: Dialect, out: &'r mut Collector) -> Self {
        Self { text, dialect, out, said: HashSet::new() }
    }

    /// How much there was to say so far.
    pub fn count(&self) -> usize {
        self.out.count()
    }

    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.out.push(diagnostic);
    }

    /// Whether this pair of words has not been seen before.
    pub fn is_news(&mut self, a: &str, b: &str) -> bool {
        self.said.insert((a.to_owned(), b.to_owned()))
    }

    /// Whether what makes no sense is nothing, as for OpenSCAD, and not a mistake.
    pub fn forgives(&self) -> bool {
        self.dialect == Dialect::Dump
    }

    /// Whether a number names one of `count` things, counted from 0. OpenSCAD drops what is behind the point.
    pub fn index_below(&self, count: usize) -> impl Fn(f64) -> bool + use<> {
        let forgives = self.forgives();
        move |v| 0.0 <= v && v < count as f64 && (forgives || v.fract() == 0.0)
    }

    /// A size that makes no sense. Whoever writes a scene by hand is wrong there; in a dump the thing is nothing, as it
    /// is for OpenSCAD.
    pub fn degenerate(
        &mut self,
        code: &'static str,
        at: SourceRange,
        wrong: String,
        nothing: &str,
        help: Option<String>,
    ) {
        self.push(match self.dialect {
            Dialect::Scene => Diagnostic { help, ..Diagnostic::error(code, at, wrong) },
            Dialect::Dump => Diagnostic::warning(code, at, format!("{wrong}; {nothing}")),
        });
    }
}
