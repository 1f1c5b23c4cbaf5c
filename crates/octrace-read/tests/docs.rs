//! The reference of the language says what is so: its examples are read, its codes are those of the reader.

use octrace_read::{ReadOptions, Severity, Source, read_scene};
use std::path::{Path, PathBuf};

const REFERENCE: &str = include_str!("../../../docs/scene-language.md");

#[test]
fn every_example_is_read_without_a_word() {
    let blocks: Vec<&str> = REFERENCE.split("```oct\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert!(blocks.len() >= 10, "{} examples", blocks.len());
    for block in blocks {
        let checked = read_scene(&Source::new("example.oct", block), &ReadOptions::default());
        let wrong: Vec<_> = checked.diagnostics.iter().filter(|d| d.severity != Severity::Note).collect();
        assert!(wrong.is_empty(), "{block}\n{wrong:?}");
        assert!(checked.value.is_some());
    }
}

/// Words in quotes with a hyphen that the sources use as codes.
fn codes(folder: &Path, found: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).expect("the sources can be listed") {
        let path: PathBuf = entry.expect("the sources can be listed").path();
        if path.is_dir() {
            codes(&path, found);
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a source can be read");
        let code = |word: &&str| word.contains('-') && word.bytes().all(|b| b.is_ascii_lowercase() || b == b'-');
        let outside_tests = text.split("#[cfg(test)]").next().unwrap_or_default();
        let quoted = outside_tests
            .lines()
            .filter(|l| !l.trim_start().starts_with("//"))
            .flat_map(|l| l.split('"').skip(1).step_by(2));
        found.extend(quoted.filter(code).map(str::to_owned));
    }
}

#[test]
fn every_code_is_explained() {
    let mut found = Vec::new();
    codes(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut found);
    found.retain(|word| !word.starts_with('-'));
    found.sort();
    found.dedup();
    assert!(found.len() > 40, "{found:?}");
    for code in found {
        assert!(REFERENCE.contains(&format!("`{code}`")), "`{code}` is not in docs/scene-language.md");
    }
}
