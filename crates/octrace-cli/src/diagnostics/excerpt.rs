//! A short piece of one source line, fit to be printed on any terminal.
//!
//! Lines of a dump may be a megabyte long and hold anything at all: only the neighbourhood of what is marked is kept,
//! and characters that would steer the terminal or turn the text around are replaced.

use std::ops::Range;

/// A printable piece of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// What to print.
    pub text: String,
    /// The bytes of the original line that `text` stands for.
    pub of: Range<usize>,
    /// For every byte offset of the original in `of`, in steps of whole characters, the offset in `text`.
    offsets: Vec<(usize, usize)>,
}

impl Excerpt {
    /// Bytes kept in front of and behind the start of what is marked.
    const REACH: (usize, usize) = (60, 100);

    /// The neighbourhood of the byte `around` in `line`, which has no line break.
    pub fn cut(line: &str, around: usize) -> Self {
        let around = char_start(line, around);
        let start = char_start(line, around.saturating_sub(Self::REACH.0));
        let end = char_start(line, (around + Self::REACH.1).min(line.len()));
        let mut text = String::new();
        let mut offsets = Vec::new();
        if start > 0 {
            text.push('…');
        }
        for (at, c) in line[start..end].char_indices() {
            offsets.push((start + at, text.len()));
            text.push(printable(c));
        }
        offsets.push((end, text.len()));
        if end < line.len() {
            text.push('…');
        }
        Self { text, of: start..end, offsets }
    }

    /// Where the bytes `range` of the original line are in `text`, as far as they are; one past the end at most.
    pub fn locate(&self, range: &Range<usize>) -> Range<usize> {
        let find = |at: usize| {
            let index = self.offsets.partition_point(|&(original, _)| original < at);
            self.offsets[index.min(self.offsets.len() - 1)].1
        };
        let (start, end) = (find(range.start), find(range.end));
        start..end.max(start)
    }
}

/// The start of the character that the byte `at` belongs to; the text's end for bytes beyond.
pub fn char_start(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0)
}

/// The text with everything replaced that a terminal might not print as it stands. Line breaks stay.
pub fn printable_text(text: &str) -> String {
    text.chars().map(|c| if c == '\n' { c } else { printable(c) }).collect()
}

/// The character, or the replacement character for controls and those that change the direction of writing.
fn printable(c: char) -> char {
    match c {
        '\t' => c,
        _ if c.is_control() => char::REPLACEMENT_CHARACTER,
        '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' => {
            char::REPLACEMENT_CHARACTER
        }
        _ => c,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marked(line: &str, range: Range<usize>) -> String {
        let excerpt = Excerpt::cut(line, range.start);
        excerpt.text[excerpt.locate(&range)].to_owned()
    }

    #[test]
    fn short_lines_stay_whole() {
        let excerpt = Excerpt::cut("cube(5);", 5);
        assert_eq!((excerpt.text.as_str(), excerpt.locate(&(5..6))), ("cube(5);", 5..6));
    }

    #[test]
    fn of_a_long_line_the_neighbourhood_is_left() {
        let line = "x".repeat(1_000_000) + "HERE" + &"y".repeat(1_000_000);
        assert_eq!(marked(&line, 1_000_000..1_000_004), "HERE");
        let excerpt = Excerpt::cut(&line, 1_000_000);
        assert!(excerpt.text.len() < 200 && excerpt.text.starts_with("…x") && excerpt.text.ends_with("y…"));
    }

    #[test]
    fn a_mark_that_goes_on_ends_with_the_excerpt() {
        assert_eq!(marked(&"ab".repeat(1000), 0..2000).len(), Excerpt::REACH.1);
    }

    #[test]
    fn marks_count_bytes_and_never_split_characters() {
        assert_eq!(marked("aé\tz", 1..4), "é\t");
        assert_eq!(marked(&"é".repeat(500), 500..502), "é");
        assert_eq!(marked("ab", 2..2), "");
        assert_eq!(marked("ab", 7..9), "");
    }

    #[test]
    fn nothing_steers_the_terminal() {
        assert_eq!(Excerpt::cut("a\x1b[31mb\u{202e}c\0", 0).text, "a\u{fffd}[31mb\u{fffd}c\u{fffd}");
        assert_eq!(printable_text("a\nb\x07"), "a\nb\u{fffd}");
    }
}
