//! Input files whose comments state what the reader must say about them.
//!
//! In `tests/suite/<format>/`, the lines `//? ...` of a file are its expectations:
//!
//! ```text
//! //? options: facets=written skip-unsupported
//! //? error[radius-not-positive] 7:16-7:18 sphere radius must be greater than zero
//! //?   note 3:1-3:4 what the note says
//! //?   help write `r = 2`; to cut something away, use `difference`
//! //? solid: union(block, sphere)
//! ```
//!
//! All diagnostics must be there, in this order, and no others. If one differs, the failure shows what would be right
//! to write, provided that it is what the reader should say. A file that cannot hold comments has a file beside it for
//! them, with `.expected` after its name.

mod common;

use common::describe;
use octrace_read::{Checked, Loaded, ReadOptions, Severity, Source, SourceRange, read_scene};
use std::path::{Path, PathBuf};

fn files() -> Vec<PathBuf> {
    let suite = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/suite");
    let entries = |folder: &Path| -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).expect("the suite is there");
        entries.map(|entry| entry.expect("the suite can be listed").path()).collect()
    };
    let mut files: Vec<PathBuf> = entries(&suite).iter().flat_map(|folder| entries(folder)).collect();
    files.retain(|path| path.extension() != Some("expected".as_ref()));
    files.sort();
    files
}

fn options(words: &str) -> ReadOptions {
    let mut options = ReadOptions::default();
    for word in words.split_whitespace() {
        match word.split_once('=') {
            Some(("facets", facets)) => options.facets = facets.parse().expect("known facets"),
            Some(("snap", snap)) => options.snap = Some(snap.parse().expect("a number")),
            None if word == "skip-unsupported" => options.skip_unsupported = true,
            _ => panic!("unknown option {word}"),
        }
    }
    options
}

fn place(source: &Source, at: SourceRange) -> String {
    let ((line, column), (end_line, end_column)) = (source.line_col(at.start), source.line_col(at.end));
    format!("{line}:{column}-{end_line}:{end_column}")
}

fn said(source: &Source, checked: &Checked<Loaded>) -> Vec<String> {
    let mut lines = Vec::new();
    for d in &checked.diagnostics {
        let severity = match d.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        };
        lines.push(format!("//? {severity}[{}] {} {}", d.code, place(source, d.at), d.message));
        lines.extend(d.notes.iter().map(|(at, note)| format!("//?   note {} {note}", place(source, *at))));
        lines.extend(d.help.iter().map(|help| format!("//?   help {help}")));
    }
    if let Some(loaded) = &checked.value {
        lines.push(format!("//? solid: {}", describe(&loaded.scene.solid)));
    }
    lines
}

#[test]
fn the_suite_is_read_as_its_comments_say() {
    let mut failures = Vec::new();
    let files = files();
    for path in &files {
        let bytes = std::fs::read(path).expect("a file of the suite can be read");
        let beside =
            path.with_file_name(format!("{}.expected", path.file_name().unwrap_or_default().to_string_lossy()));
        let comments = std::fs::read(beside).unwrap_or_else(|_| bytes.clone());
        let text = String::from_utf8_lossy(&comments).into_owned();
        let stated: Vec<&str> = text.lines().map(str::trim_end).filter(|line| line.starts_with("//?")).collect();
        let (chosen, expected): (Vec<&str>, Vec<&str>) = stated.iter().partition(|l| l.starts_with("//? options:"));
        let options = options(&chosen.iter().map(|line| &line["//? options:".len()..]).collect::<String>());
        let source = Source::new(path.to_string_lossy(), bytes);
        let checked = read_scene(&source, &options);
        let has_errors = checked.diagnostics.iter().any(|d| d.severity == Severity::Error);
        assert_eq!(checked.value.is_none(), has_errors, "{}", path.display());
        let found = said(&source, &checked);
        if found != expected {
            failures.push(format!("{}:\n{}", path.display(), found.join("\n")));
        }
    }
    assert!(files.len() >= 20, "the suite has {} files", files.len());
    assert!(failures.is_empty(), "{} of {} files differ\n{}", failures.len(), files.len(), failures.join("\n\n"));
}
