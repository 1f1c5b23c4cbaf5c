//! Diagnostics for programs: plain data with lines and columns.

use super::place::{Place, Places};
use super::word;
use octrace_read::{Diagnostic, Source, SourceRange};
use serde::Serialize;

/// A diagnostic as JSON. Lines and columns count from 1, columns in characters; the end is one past the last.
#[derive(Debug, Serialize)]
pub struct JsonDiagnostic {
    file: String,
    #[serde(flatten)]
    at: JsonRange,
    severity: &'static str,
    code: &'static str,
    message: String,
    count: usize,
    notes: Vec<JsonNote>,
    help: Option<String>,
}

#[derive(Debug, Serialize)]
struct JsonRange {
    line: usize,
    column: usize,
    end_line: usize,
    end_column: usize,
}

#[derive(Debug, Serialize)]
struct JsonNote {
    #[serde(flatten)]
    at: JsonRange,
    message: String,
}

/// The diagnostics of a file, in the order of their places.
pub fn json(source: &Source, diagnostics: &[Diagnostic]) -> Vec<JsonDiagnostic> {
    let places = Places::new(source);
    let mut sorted: Vec<&Diagnostic> = diagnostics.iter().collect();
    sorted.sort_by_key(|d| d.at.start);
    let range = |range: &SourceRange| {
        let (Place { line, column }, end) = (places.place(range.start), places.place(range.end));
        JsonRange { line, column, end_line: end.line, end_column: end.column }
    };
    let convert = |d: &&Diagnostic| JsonDiagnostic {
        file: source.name().to_owned(),
        at: range(&d.at),
        severity: word(d.severity),
        code: d.code,
        message: d.message.clone(),
        count: d.count,
        notes: d.notes.iter().map(|(at, label)| JsonNote { at: range(at), message: label.clone() }).collect(),
        help: d.help.clone(),
    };
    sorted.iter().map(convert).collect()
}
