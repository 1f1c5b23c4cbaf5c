//! Real models, where there are any: tests that want them say so and pass without.
#![allow(dead_code, reason = "each test file uses a part of this")]

use octrace_forms::text::FontSource;
use octrace_read::{Assets, Folder, Source};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// The folder of real models, if it is there: `OCTRACE_CORPORA`, or beside the repository.
pub fn corpora() -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/corpora");
    let folder = std::env::var_os("OCTRACE_CORPORA").map_or_else(beside, PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("SKIPPED: no corpora at {}", folder.display());
    None
}

/// OpenSCAD's dumps among them, sorted.
pub fn openscad_dumps() -> Option<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut pending = vec![corpora()?.join("openscad")];
    while let Some(folder) = pending.pop() {
        for entry in std::fs::read_dir(&folder).expect("the corpus can be listed") {
            let path = entry.expect("the corpus can be listed").path();
            if path.is_dir() {
                pending.push(path);
            } else if path.extension() == Some("csg".as_ref()) {
                files.push(path);
            }
        }
    }
    files.sort();
    Some(files)
}

/// The files beside a model, and always the same font, whatever the machine has.
#[derive(Debug)]
struct BesideModel(Folder);

static FONTS: LazyLock<FontSource> = LazyLock::new(|| FontSource::files(vec![dejavu::sans::regular().to_vec()]));

impl Assets for BesideModel {
    fn read(&self, name: &str) -> std::io::Result<Vec<u8>> {
        self.0.read(name)
    }

    fn fonts(&self) -> &FontSource {
        &FONTS
    }
}

/// The text of a model, with what it names at hand.
pub fn source(path: &Path) -> Source {
    let text = std::fs::read(path).expect("a dump can be read");
    Source::new(path.to_string_lossy(), text).with_assets(BesideModel(Folder::of(path)))
}
