//! From byte offsets to lines and columns, fast for many offsets in ascending order, on lines of any length.

use super::excerpt::char_start;
use octrace_read::Source;
use std::cell::Cell;
use std::ops::Range;

/// A place in a text, counted from 1 as people and editors do; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

/// Finds places in one file.
pub struct Places<'a> {
    source: &'a Source,
    /// The last offset asked for and its place: ten thousand ascending questions on one line of ten megabytes must not
    /// each count from the start of that line.
    last: Cell<(usize, Place)>,
}

impl<'a> Places<'a> {
    /// Finds places in `source`.
    pub fn new(source: &'a Source) -> Self {
        Self { source, last: Cell::new((0, Place { line: 1, column: 1 })) }
    }

    /// Line and column of a byte; offsets beyond the end, or inside of a character, mean the place before.
    pub fn place(&self, offset: u32) -> Place {
        let text = self.source.text();
        let offset = char_start(text, offset as usize);
        let (known_offset, known) = self.last.get();
        let since = text.get(known_offset..offset).filter(|since| !since.as_bytes().contains(&b'\n'));
        let place = match since {
            Some(since) => Place { column: known.column + since.chars().count(), ..known },
            None => {
                let (line, column) = self.source.line_col(offset as u32);
                Place { line, column }
            }
        };
        self.last.set((offset, place));
        place
    }

    /// The bytes of the line that `offset` is on, without its line break.
    pub fn line_around(&self, offset: u32) -> Range<usize> {
        let text = self.source.text();
        let offset = char_start(text, offset as usize);
        let start = text[..offset].rfind('\n').map_or(0, |at| at + 1);
        let end = text[offset..].find('\n').map_or(text.len(), |at| offset + at);
        start..start + text[start..end].trim_end_matches('\r').len()
    }

    /// The file.
    pub fn source(&self) -> &'a Source {
        self.source
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_questions_does_not_matter() {
        let source = Source::new("", "é".repeat(50) + "\nxyz\n");
        let places = Places::new(&source);
        for offset in [40, 10, 10, 50, 103, 0, 101, 100, 104, 105, 999] {
            let (line, column) = source.line_col(offset);
            assert_eq!(places.place(offset), Place { line, column }, "{offset}");
        }
    }

    #[test]
    fn lines_end_before_their_break() {
        let source = Source::new("", "ab\r\nçd\n");
        let places = Places::new(&source);
        assert_eq!([0, 2, 5, 8].map(|at| places.line_around(at)), [0..2, 0..2, 4..7, 8..8]);
        assert_eq!(Places::new(&Source::new("", "")).line_around(5), 0..0);
    }
}
