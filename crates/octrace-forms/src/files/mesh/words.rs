//! Lines and numbers of text formats.

use super::MeshError;
use octrace::Vec3;

/// The words of one line, and which line it is.
pub(super) struct Words<'a> {
    line: usize,
    words: std::str::SplitWhitespace<'a>,
}

/// Lines that have words after what follows `comment` is cut off. Bytes that are not text make words of their own.
pub(super) fn lines(bytes: &[u8], comment: Option<u8>) -> impl Iterator<Item = Words<'_>> {
    let lines = (1..).zip(bytes.split(|&b| b == b'\n'));
    lines.filter_map(move |(line, content)| {
        let end = content.iter().position(|&b| Some(b) == comment).unwrap_or(content.len());
        let text = std::str::from_utf8(&content[..end]).unwrap_or("?");
        let words = Words { line, words: text.split_whitespace() };
        words.words.clone().next().is_some().then_some(words)
    })
}

impl<'a> Words<'a> {
    /// The next word, if there is one.
    pub fn next(&mut self) -> Option<&'a str> {
        self.words.next()
    }

    /// An error about this line.
    pub fn error(&self, problem: impl Into<String>) -> MeshError {
        MeshError::Line { line: self.line, problem: problem.into() }
    }

    /// The next word as a finite number.
    pub fn number(&mut self, what: &str) -> Result<f64, MeshError> {
        let word = self.next().ok_or_else(|| self.error(format!("{what} is missing")))?;
        match word.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(self.error(format!("{what} is `{}`, which is no finite number", cut(word)))),
        }
    }

    /// The next three words as a point.
    pub fn point(&mut self) -> Result<Vec3, MeshError> {
        Ok(Vec3::new(self.number("x")?, self.number("y")?, self.number("z")?))
    }

    /// The next word as a count or an index.
    pub fn count(&mut self, what: &str) -> Result<usize, MeshError> {
        let word = self.next().ok_or_else(|| self.error(format!("{what} is missing")))?;
        word.parse().map_err(|_| self.error(format!("{what} is `{}`, which is no whole number", cut(word))))
    }
}

/// A word, short enough to be shown.
pub(super) fn cut(word: &str) -> String {
    word.chars().take(40).collect()
}
