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
    /// Columns that are kept however narrow the terminal is.
    const LEAST_COLUMNS: usize = 40;

    /// The neighbourhood of the byte `around` in `line`, which has no line break, in about `columns` columns.
    pub fn cut(line: &str, around: usize, columns: usize) -> Self {
        let columns = columns.max(Self::LEAST_COLUMNS);
        let around = char_start(line, around);
        let (start, end) = match end_within(line, 0, columns) {
            end if end == line.len() => (0, end),
            _ => {
                // One column for each of the two marks of omission. What is looked for is seldom far inside of a line
                // but for its indentation, which says nothing.
                let indentation = line.len() - line.trim_start().len();
                let start = start_within(line, around, columns * 3 / 8).max(indentation.min(around));
                (start, end_within(line, start, columns - 2))
            }
        };
        let mut text = String::new();
        let mut offsets = Vec::new();
        if !line[..start].trim_start().is_empty() {
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

/// How wide a character is drawn, roughly.
fn columns_of(c: char) -> usize {
    // What the crate that draws makes of tabs.
    if c == '\t' { 4 } else { 1 }
}

/// Where the text from `start` on fills so many columns; its end if it does not.
fn end_within(text: &str, start: usize, columns: usize) -> usize {
    let mut used = 0;
    let overflow = text[start..].char_indices().find(|&(_, c)| {
        used += columns_of(c);
        used > columns
    });
    overflow.map_or(text.len(), |(at, _)| start + at)
}

/// From where on the text in front of `end` fills so many columns; 0 if it does not.
fn start_within(text: &str, end: usize, columns: usize) -> usize {
    let mut used = 0;
    let overflow = text[..end].char_indices().rev().find(|&(_, c)| {
        used += columns_of(c);
        used > columns
    });
    overflow.map_or(0, |(at, c)| at + c.len_utf8())
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
        let excerpt = Excerpt::cut(line, range.start, 160);
        excerpt.text[excerpt.locate(&range)].to_owned()
    }

    #[test]
    fn short_lines_stay_whole() {
        let excerpt = Excerpt::cut("cube(5);", 5, 160);
        assert_eq!((excerpt.text.as_str(), excerpt.locate(&(5..6))), ("cube(5);", 5..6));
    }

    #[test]
    fn of_a_long_line_the_neighbourhood_is_left() {
        let line = "x".repeat(1_000_000) + "HERE" + &"y".repeat(1_000_000);
        assert_eq!(marked(&line, 1_000_000..1_000_004), "HERE");
        let excerpt = Excerpt::cut(&line, 1_000_000, 160);
        assert!(excerpt.text.len() < 200 && excerpt.text.starts_with("…x") && excerpt.text.ends_with("y…"));
    }

    #[test]
    fn a_mark_that_goes_on_ends_with_the_excerpt() {
        assert_eq!(marked(&"ab".repeat(1000), 0..2000).len(), 158);
    }

    #[test]
    fn excerpts_are_as_wide_as_there_is_room() {
        let line = format!("{}linear_extrude({}) {{", "\t".repeat(30), "height = 1, ".repeat(30));
        for columns in [60, 80, 200] {
            let text = Excerpt::cut(&line, 30, columns).text;
            assert!(text.starts_with("linear_extrude(") && text.ends_with('…'), "{text}");
            assert!((columns - 2..=columns).contains(&text.chars().count()), "{text}");
        }
        let middle = Excerpt::cut(&"é".repeat(1000), 1000, 60).text;
        assert_eq!(middle.chars().count(), 60, "{middle}");
        assert_eq!(Excerpt::cut("\t\tcube(5);", 2, 60).text, "\t\tcube(5);", "what fits keeps its indentation");
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
        assert_eq!(Excerpt::cut("a\x1b[31mb\u{202e}c\0", 0, 160).text, "a\u{fffd}[31mb\u{fffd}c\u{fffd}");
        assert_eq!(printable_text("a\nb\x07"), "a\nb\u{fffd}");
    }
}
