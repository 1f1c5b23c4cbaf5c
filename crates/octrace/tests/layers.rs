//! A module of the core uses only those above it: the order of ARCHITECTURE.md, kept by reading the `use` lines.

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
