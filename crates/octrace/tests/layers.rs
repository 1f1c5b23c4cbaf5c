//! What can be held true by reading the sources: a module of the core uses only those above it, in the order of
//! ARCHITECTURE.md; and what comments cite is listed in docs/references.md.

use std::fs;
use std::path::{Path, PathBuf};

const LAYERS: [&str; 13] = [
    "num",
    "geom",
    "exec",
    "primitive",
    "surface",
    "model",
    "compile",
    "octree",
    "traverse",
    "trace",
    "shade",
    "film",
    "query",
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the sources are readable") {
        let path = entry.expect("the sources are readable").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn modules_use_only_what_is_above_them() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let rank = |module: &str| LAYERS.iter().position(|&l| l == module);
    let mut wrong = Vec::new();
    let mut lines_seen = 0;
    for (layer, name) in LAYERS.iter().enumerate() {
        let mut files = Vec::new();
        sources(&root.join(name), &mut files);
        for file in files {
            for line in fs::read_to_string(&file).expect("sources are UTF-8").lines() {
                for used in line.split("crate::").skip(1) {
                    let module: String = used.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                    lines_seen += 1;
                    if rank(&module).is_some_and(|used| used > layer) {
                        wrong.push(format!("{}: {}", file.display(), line.trim()));
                    }
                }
            }
        }
    }
    assert!(lines_seen > 50, "the test reads the sources");
    assert!(wrong.is_empty(), "lower layers reach up:\n{}", wrong.join("\n"));
}

/// Keys such as `Roth 1982` in `[Roth 1982; Comba-Persiano, §2.1]`.
fn citations(text: &str) -> impl Iterator<Item = &str> {
    let comments = text.lines().filter(|line| line.trim_start().starts_with("//"));
    let brackets = comments.flat_map(|line| line.split('[').skip(1).filter_map(|rest| Some(rest.split_once(']')?.0)));
    let keys = brackets.flat_map(|inner| inner.split("; ")).map(|key| key.split(", §").next().unwrap_or(key));
    let dated = |key: &&str| key.len() > 5 && key[..1] != *"`" && key.split(' ').next_back().is_some_and(is_year);
    keys.filter(move |key| *key == "Comba-Persiano" || dated(key))
}

fn is_year(word: &str) -> bool {
    word.len() == 4 && word.bytes().all(|b| b.is_ascii_digit())
}

#[test]
fn what_is_cited_is_in_the_references_and_the_other_way_round() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let references = fs::read_to_string(root.join("../../docs/references.md")).expect("the references are readable");
    let listed: Vec<&str> =
        references.lines().filter_map(|line| Some(line.strip_prefix("- [")?.split_once(']')?.0)).collect();
    let mut files = Vec::new();
    sources(root, &mut files);
    let texts: Vec<String> = files.iter().map(|file| fs::read_to_string(file).expect("sources are UTF-8")).collect();
    let cited: Vec<&str> = texts.iter().flat_map(|text| citations(text)).collect();
    assert!(cited.len() > 10, "the test reads the sources");
    for key in &cited {
        assert!(listed.contains(key), "[{key}] is not in docs/references.md");
    }
    for key in &listed {
        assert!(cited.contains(key), "[{key}] of docs/references.md is cited nowhere");
    }
}
