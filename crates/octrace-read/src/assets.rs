//! What an input file names: meshes, drawings, height fields; fonts.

use octrace_forms::text::FontSource;
use std::fmt::Debug;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// The fonts of the system, looked for when the first text is set.
static SYSTEM_FONTS: LazyLock<FontSource> = LazyLock::new(|| FontSource::system(Vec::new()));

/// Where the things are that an input file names.
pub trait Assets: Debug + Send + Sync {
    /// The content of a file, by the name that the input file has for it.
    ///
    /// # Errors
    /// If there is no such file, or it cannot be read.
    fn read(&self, name: &str) -> io::Result<Vec<u8>>;

    /// The fonts that texts are set in; those of the system, if nothing else is said.
    fn fonts(&self) -> &FontSource {
        &SYSTEM_FONTS
    }
}

/// No files at all.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoAssets;

impl Assets for NoAssets {
    fn read(&self, _: &str) -> io::Result<Vec<u8>> {
        Err(io::Error::new(io::ErrorKind::NotFound, "files cannot be read from here"))
    }
}

/// Files by names relative to a folder.
#[derive(Clone, Debug)]
pub struct Folder(pub PathBuf);

impl Folder {
    /// The folder that a file is in.
    pub fn of(file: &Path) -> Self {
        Self(file.parent().map_or_else(PathBuf::new, Path::to_owned))
    }
}

impl Assets for Folder {
    fn read(&self, name: &str) -> io::Result<Vec<u8>> {
        std::fs::read(self.0.join(name))
    }
}
