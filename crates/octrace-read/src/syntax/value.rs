//! Text to tree: values. The inner loop of reading a large file, nearly all of whose bytes are numbers in vectors.

use super::parse::{Parser, Reported};
use crate::SourceRange;
use crate::diagnostic::Diagnostic;

impl Parser<'_, '_> {
    /// Reads a value into the builder; returns where it is written.
    pub(super) fn value(&mut self) -> Result<SourceRange, Reported> {
        let start = self.cursor.pos();
        loop {
            self.skip_blanks();
            match self.cursor.peek() {
                Some(b'[') => {
                    self.cursor.bump();
                    self.builder.open_vector();
                    continue;
                }
                // An empty vector, or a comma before the closing bracket.
                Some(b']') if self.builder.open_vectors() > 0 => {
                    self.cursor.bump();
                    self.builder.close_vector();
                }
                Some(b'0'..=b'9' | b'-' | b'+' | b'.') => self.number()?,
                Some(b'"') => self.string()?,
                Some(_) => self.word(start)?,
                None => return self.end_in_value(start),
            }
            loop {
                if self.builder.open_vectors() == 0 {
                    return Ok(self.since(start));
                }
                self.skip_blanks();
                match self.cursor.peek() {
                    Some(b',') => {
                        self.cursor.bump();
                        break;
                    }
                    Some(b']') => {
                        self.cursor.bump();
                        self.builder.close_vector();
                    }
                    None => return self.end_in_value(start),
                    Some(_) => return self.after_element(start),
                }
            }
        }
    }

    fn end_in_value<T>(&mut self, start: u32) -> Result<T, Reported> {
        // Otherwise it is the argument list that is cut short, and that says so.
        if self.builder.open_vectors() > 0 {
            self.ends_inside("unclosed-bracket", "inside a vector", SourceRange::new(start, start + 1));
        }
        Err(Reported)
    }

    /// Neither a comma nor a bracket after an element of a vector.
    fn after_element<T>(&mut self, start: u32) -> Result<T, Reported> {
        match self.cursor.peek() {
            Some(b')' | b';' | b'{' | b'}') => {
                let bracket = SourceRange::new(start, start + 1);
                let diagnostic = Diagnostic::error("unclosed-bracket", self.here(), "a `]` should come before this");
                self.report(diagnostic.with_note(bracket, "this is still open"));
            }
            Some(b'"' | b'[' | b'0'..=b'9' | b'-' | b'a'..=b'z' | b'A'..=b'Z') => {
                let gap = SourceRange::new(self.cursor.pos().saturating_sub(1), self.cursor.pos());
                self.report(Diagnostic::error("missing-comma", gap, "a `,` or `]` should follow here"));
            }
            _ => self.needs_evaluation(self.here()),
        }
        Err(Reported)
    }

    #[inline]
    fn number(&mut self) -> Result<(), Reported> {
        match self.cursor.number() {
            Some(v) => {
                self.builder.number(v);
                Ok(())
            }
            None => self.bad_number(),
        }
    }

    #[cold]
    fn bad_number(&mut self) -> Result<(), Reported> {
        let start = self.cursor.pos();
        let part = |b: u8| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'_');
        self.cursor.bump();
        while self.cursor.peek().is_some_and(part) {
            self.cursor.bump();
        }
        let at = self.since(start);
        let text = &self.cursor.text()[at.start as usize..at.end as usize];
        match text.strip_prefix(['-', '+']) {
            Some(name) if !name.starts_with(|c: char| c.is_ascii_digit() || c == '.') => self.needs_evaluation(at),
            _ => self.report(Diagnostic::error("bad-number", at, format!("`{text}` is not a number"))),
        }
        Err(Reported)
    }

    /// A word in a value that begins at `value_start`.
    fn word(&mut self, value_start: u32) -> Result<(), Reported> {
        let at = self.here();
        let start = self.cursor.pos();
        match self.cursor.name() {
            "true" => self.builder.bool(true),
            "false" => self.builder.bool(false),
            "undef" => self.builder.undef(),
            "inf" => self.builder.number(f64::INFINITY),
            "nan" => self.builder.number(f64::NAN),
            "" => {
                let c = &self.cursor.text()[at.start as usize..at.end as usize];
                match c {
                    "(" | "!" => self.needs_evaluation(at),
                    _ => self.report(Diagnostic::error("not-a-value", at, format!("`{c}` is not a value"))),
                }
                return Err(Reported);
            }
            // Perhaps only the first half of a word.
            _ if self.cursor.peek().is_none() => return self.end_in_value(value_start),
            _ => {
                self.needs_evaluation(self.since(start));
                return Err(Reported);
            }
        }
        Ok(())
    }

    fn string(&mut self) -> Result<(), Reported> {
        let quote = self.cursor.pos() as usize;
        let text = self.cursor.text();
        let Some(end) = closing_quote(text, quote) else {
            // The rest of the line belongs to the string, but for what closes the node.
            let line = text[quote..].lines().next().unwrap_or_default();
            let resume = quote + line.rfind(')').unwrap_or(line.len());
            let message = "this string has no closing quote";
            self.report(Diagnostic::error(
                "unclosed-string",
                SourceRange::new(quote as u32, quote as u32 + 1),
                message,
            ));
            self.cursor.set_pos(resume as u32);
            return Err(Reported);
        };
        let content = &text[quote + 1..end];
        if content.contains('\\') {
            self.builder.text(&unescape(content));
        } else {
            self.builder.text(content);
        }
        self.cursor.set_pos(end as u32 + 1);
        Ok(())
    }
}

/// The closing quote of the string that opens at `quote`.
///
/// OpenSCAD 2021.01 writes the text of `text()` as it is, quotes included. So a quote counts as the closing one if
/// something follows that can follow a value; if there is none such nearby, the first quote is taken.
fn closing_quote(text: &str, quote: usize) -> Option<usize> {
    const NEARBY: usize = 1000;
    let bytes = text.as_bytes();
    let mut first = None;
    let mut i = quote + 1;
    while let Some(&byte) = bytes.get(i) {
        match byte {
            b'\\' => i += 1,
            b'"' => {
                let next = bytes[i + 1..].iter().find(|b| !b.is_ascii_whitespace());
                if matches!(next, None | Some(b',' | b')' | b']')) {
                    return Some(i);
                }
                first = first.or(Some(i));
            }
            _ => {}
        }
        if first.is_some() && (byte == b'\n' || i - quote > NEARBY) {
            break;
        }
        i += 1;
    }
    first
}

/// Resolves `\"`, `\\`, `\n`, `\t` and `\r`; any other backslash stands for itself.
fn unescape(content: &str) -> String {
    let mut out = String::with_capacity(content.len());
    let mut chars = content.chars();
    while let Some(c) = chars.next() {
        if c != '\\' {
            out.push(c);
            continue;
        }
        match chars.clone().next() {
            Some(escaped @ ('"' | '\\')) => out.push(escaped),
            Some('n') => out.push('\n'),
            Some('t') => out.push('\t'),
            Some('r') => out.push('\r'),
            _ => {
                out.push('\\');
                continue;
            }
        }
        chars.next();
    }
    out
}
