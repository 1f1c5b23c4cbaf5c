//! The text of an input file and places in it.

use crate::assets::{Assets, NoAssets};
use std::path::Path;
use std::sync::{Arc, OnceLock};

/// A stretch of an input file, in bytes: from `start` up to but without `end`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SourceRange {
    /// The first byte.
    pub start: u32,
    /// The byte after the last one.
    pub end: u32,
}

impl SourceRange {
    /// The range from `start` up to but without `end`.
    pub const fn new(start: u32, end: u32) -> Self {
        Self { start, end }
    }

    /// The smallest range around both.
    pub fn to(self, o: Self) -> Self {
        Self { start: self.start.min(o.start), end: self.end.max(o.end) }
    }
}

/// Which language a file is written in. There is one grammar; the dialects differ in what a mistake means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dialect {
    /// A dump written by OpenSCAD (`.csg`): numbers carry six digits, and what OpenSCAD would ignore is ignored.
    Dump,
    /// Written by hand (`.oct`): numbers mean what they say, and a size that makes no sense is an error.
    Scene,
}

/// An input file: its name, for messages and to tell the dialect, its text, and the files that it can name.
#[derive(Debug)]
pub struct Source {
    name: String,
    text: String,
    not_utf8_at: Option<u32>,
    too_large: bool,
    line_starts: OnceLock<Vec<u32>>,
    assets: Arc<dyn Assets>,
}

impl Source {
    /// A file with this name and content, which can name no other files. Bytes that are not UTF-8 are kept in mind and reported by the reader.
    pub fn new(name: impl Into<String>, content: impl Into<Vec<u8>>) -> Self {
        let mut content: Vec<u8> = content.into();
        let too_large = u32::try_from(content.len()).is_err();
        if too_large {
            content.clear();
        }
        let (text, not_utf8_at) = match String::from_utf8(content) {
            Ok(text) => (text, None),
            Err(error) => {
                let at = error.utf8_error().valid_up_to() as u32;
                (String::from_utf8_lossy(error.as_bytes()).into_owned(), Some(at))
            }
        };
        let (line_starts, assets) = (OnceLock::new(), Arc::new(NoAssets));
        Self { name: name.into(), text, not_utf8_at, too_large, line_starts, assets }
    }

    /// The same file; what it names is to be found there.
    pub fn with_assets(self, assets: impl Assets + 'static) -> Self {
        Self { assets: Arc::new(assets), ..self }
    }

    /// Where the files are that it names.
    pub fn assets(&self) -> &dyn Assets {
        &*self.assets
    }

    /// What the file is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its text; bytes that are not UTF-8 appear as replacement characters.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The dialect that the file's name asks for: [`Dialect::Scene`] for `.oct`, otherwise [`Dialect::Dump`].
    pub fn dialect(&self) -> Dialect {
        match Path::new(&self.name).extension() {
            Some(extension) if extension.eq_ignore_ascii_case("oct") => Dialect::Scene,
            _ => Dialect::Dump,
        }
    }

    /// Offset of the first byte that is not UTF-8.
    pub fn not_utf8_at(&self) -> Option<u32> {
        self.not_utf8_at
    }

    /// Whether the content was dropped because offsets into it do not fit 32 bits.
    pub fn is_too_large(&self) -> bool {
        self.too_large
    }

    /// The text of a range; empty where the range is not one of this text.
    pub fn slice(&self, range: SourceRange) -> &str {
        self.text.get(range.start as usize..range.end as usize).unwrap_or("")
    }

    /// Line and column of a byte offset, both from 1; columns count characters. An offset past the end means the end.
    pub fn line_col(&self, offset: u32) -> (usize, usize) {
        let starts = self.line_starts.get_or_init(|| {
            let after_newline = |(at, &byte): (usize, &u8)| (byte == b'\n').then_some(at as u32 + 1);
            std::iter::once(0)
                .chain(self.text.bytes().enumerate().filter_map(|(i, b)| after_newline((i, &b))))
                .collect()
        });
        let offset = (offset as usize).min(self.text.len());
        let line = starts.partition_point(|&start| start as usize <= offset);
        let start = starts[line - 1] as usize;
        let before = &self.text.as_bytes()[start..offset];
        let continuation = |byte: &&u8| **byte & 0xC0 == 0x80;
        (line, 1 + before.len() - before.iter().filter(continuation).count())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_characters_from_one() {
        let source = Source::new("a.oct", "ab\né(c)\r\nd");
        assert_eq!(source.line_col(0), (1, 1));
        assert_eq!(source.line_col(2), (1, 3), "the newline belongs to its line");
        assert_eq!(source.line_col(3), (2, 1));
        assert_eq!(source.line_col(5), (2, 2), "one character of two bytes");
        assert_eq!(source.line_col(10), (3, 1));
        assert_eq!(source.line_col(11), (3, 2));
        assert_eq!(source.line_col(1000), (3, 2));
        assert_eq!(Source::new("", "").line_col(0), (1, 1));
    }

    #[test]
    fn the_name_tells_the_dialect() {
        assert_eq!(Source::new("a/b.OCT", "").dialect(), Dialect::Scene);
        assert_eq!(Source::new("a.oct/b.csg", "").dialect(), Dialect::Dump);
        assert_eq!(Source::new("-", "").dialect(), Dialect::Dump);
    }

    #[test]
    fn junk_is_kept_in_mind() {
        assert_eq!(Source::new("", vec![b'a', b'b', 0xFF, b'c']).not_utf8_at(), Some(2));
        assert_eq!(Source::new("", "abc").not_utf8_at(), None);
    }
}
