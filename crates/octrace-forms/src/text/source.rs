//! Where fonts come from.

use super::font::{self, Font, Wanted};
use super::{TextError, TextWarning};
use fontdb::{Database, ID};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Fonts to set text in. Cheap to make: folders are looked through when the first text is set. Can be shared by threads.
#[derive(Default)]
pub struct FontSource {
    system: bool,
    folders: Vec<PathBuf>,
    files: Vec<Vec<u8>>,
    database: OnceLock<Database>,
    loaded: Mutex<BTreeMap<ID, Arc<Font>>>,
}

impl std::fmt::Debug for FontSource {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { system, folders, files, .. } = self;
        write!(f, "FontSource {{ system: {system}, folders: {folders:?}, files: {} }}", files.len())
    }
}

/// A font, and what is to be said about it.
pub(super) struct Chosen {
    pub font: Arc<Font>,
    pub warning: Option<TextWarning>,
}

impl FontSource {
    /// The fonts that are installed, and those in these folders.
    pub fn system(folders: Vec<PathBuf>) -> Self {
        Self { system: true, folders, ..Self::default() }
    }

    /// The fonts in these font files, and no others.
    pub fn files(files: Vec<Vec<u8>>) -> Self {
        Self { files, ..Self::default() }
    }

    fn database(&self) -> &Database {
        self.database.get_or_init(|| {
            let mut database = Database::new();
            if self.system {
                database.load_system_fonts();
            }
            self.folders.iter().for_each(|folder| database.load_fonts_dir(folder));
            self.files.iter().for_each(|file| database.load_font_data(file.clone()));
            database
        })
    }

    /// The font that fits the name best.
    pub(super) fn choose(&self, name: &str) -> Result<Chosen, TextError> {
        let wanted = Wanted::parse(name);
        let no_font = || TextError::NoFont { asked: wanted.asked() };
        let (face, is_asked) = font::best(self.database(), &wanted).ok_or_else(no_font)?;
        let font = self.load(face)?;
        let warning = (!is_asked).then(|| TextWarning::OtherFont { asked: wanted.asked(), used: font.name.clone() });
        Ok(Chosen { font, warning })
    }

    fn load(&self, face: &fontdb::FaceInfo) -> Result<Arc<Font>, TextError> {
        let mut loaded = self.loaded.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(font) = loaded.get(&face.id) {
            return Ok(Arc::clone(font));
        }
        let name = font::name_of(face);
        let read =
            self.database().with_face_data(face.id, |bytes, index| Font::new(bytes.to_vec(), index, name.clone()));
        let font = Arc::new(read.flatten().ok_or(TextError::BadFont { font: name })?);
        loaded.insert(face.id, Arc::clone(&font));
        Ok(font)
    }
}
