//! A place in a text, and the small steps over it that every part of the parser takes.

/// A text and how far it has been read.
#[derive(Clone, Debug)]
pub(super) struct Cursor<'s> {
    text: &'s str,
    pos: usize,
}

/// The text ended inside a comment that opened here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct UnclosedComment {
    pub at: u32,
}

impl<'s> Cursor<'s> {
    pub fn new(text: &'s str, pos: usize) -> Self {
        Self { text, pos }
    }

    /// How far it is, in bytes. Offsets fit 32 bits: see [`crate::Source::is_too_large`].
    pub fn pos(&self) -> u32 {
        self.pos as u32
    }

    pub fn set_pos(&mut self, pos: u32) {
        self.pos = pos as usize;
    }

    pub fn text(&self) -> &'s str {
        self.text
    }

    fn bytes(&self) -> &'s [u8] {
        self.text.as_bytes()
    }

    /// The next byte.
    #[inline]
    pub fn peek(&self) -> Option<u8> {
        self.bytes().get(self.pos).copied()
    }

    /// The byte after the next.
    pub fn peek_second(&self) -> Option<u8> {
        self.bytes().get(self.pos + 1).copied()
    }

    /// Steps over one byte, which must be ASCII.
    #[inline]
    pub fn bump(&mut self) {
        self.pos += 1;
    }

    /// Steps over the next byte if it is this one.
    #[inline]
    pub fn eat(&mut self, byte: u8) -> bool {
        let found = self.peek() == Some(byte);
        self.pos += usize::from(found);
        found
    }

    /// Steps over blanks, line ends and comments.
    ///
    /// # Errors
    /// If the text ends inside a comment.
    #[inline]
    pub fn skip_blanks(&mut self) -> Result<(), UnclosedComment> {
        loop {
            match self.peek() {
                Some(b' ' | b'\t' | b'\r' | b'\n') => self.pos += 1,
                Some(b'/') if matches!(self.peek_second(), Some(b'/' | b'*')) => self.skip_comment()?,
                _ => return Ok(()),
            }
        }
    }

    #[cold]
    fn skip_comment(&mut self) -> Result<(), UnclosedComment> {
        let rest = &self.text[self.pos..];
        if rest.starts_with("//") {
            self.pos += rest.find('\n').unwrap_or(rest.len());
            return Ok(());
        }
        match rest[2..].find("*/") {
            Some(length) => self.pos += 2 + length + 2,
            None => {
                let at = self.pos();
                self.pos = self.text.len();
                return Err(UnclosedComment { at });
            }
        }
        Ok(())
    }

    /// Whether a name may start with the next byte.
    pub fn at_name(&self) -> bool {
        self.peek().is_some_and(|b| b.is_ascii_alphabetic() || b == b'_' || b == b'$')
    }

    /// Steps over a name and returns it; empty where there is none.
    pub fn name(&mut self) -> &'s str {
        let start = self.pos;
        if self.at_name() {
            while self.peek().is_some_and(is_name_byte) {
                self.pos += 1;
            }
        }
        &self.text[start..self.pos]
    }

    /// Steps over a number. `None`, and no step, where there is none or it runs on into something else, as in `12ab`.
    #[inline]
    pub fn number(&mut self) -> Option<f64> {
        if let Some(value) = self.short_integer() {
            return Some(value);
        }
        let (value, length) = fast_float2::parse_partial::<f64, _>(&self.bytes()[self.pos..]).ok()?;
        match self.bytes().get(self.pos + length) {
            Some(&b) if is_name_byte(b) || b == b'.' => None,
            _ => {
                self.pos += length;
                Some(value)
            }
        }
    }

    /// A number of a few digits and nothing else. Most numbers of matrices are zero or one.
    #[inline]
    fn short_integer(&mut self) -> Option<f64> {
        /// An `f64` holds so many digits exactly.
        const MOST_DIGITS: usize = 15;
        let rest = &self.bytes()[self.pos..];
        let negative = rest.first() == Some(&b'-');
        let digits = &rest[usize::from(negative)..];
        let (mut value, mut count) = (0_u64, 0);
        while let Some(digit @ b'0'..=b'9') = digits.get(count) {
            if count == MOST_DIGITS {
                return None;
            }
            value = 10 * value + u64::from(digit - b'0');
            count += 1;
        }
        let runs_on = digits.get(count).is_some_and(|&b| is_name_byte(b) || b == b'.');
        if count == 0 || runs_on {
            return None;
        }
        self.pos += usize::from(negative) + count;
        Some(if negative { -(value as f64) } else { value as f64 })
    }

    /// Steps over everything up to the end of the line, or a byte that ends or opens statements.
    pub fn skip_junk(&mut self) {
        while self.peek().is_some_and(|b| !matches!(b, b'\n' | b';' | b'{' | b'}')) {
            self.pos += 1;
        }
    }

    /// Steps over a statement that means nothing here: up to and with its `;`, or the `}` that closes its first block.
    /// Stops in front of a `}` that it did not open.
    pub fn skip_statement(&mut self) {
        let (mut braces, mut others) = (0_usize, 0_usize);
        while let Some(byte) = self.peek() {
            match byte {
                b'"' => {
                    self.skip_string();
                    continue;
                }
                b'/' => {
                    let before = self.pos;
                    if self.skip_blanks().is_err() {
                        return;
                    }
                    self.pos += usize::from(self.pos == before);
                    continue;
                }
                b'(' | b'[' => others += 1,
                b')' | b']' => others = others.saturating_sub(1),
                b'{' => braces += 1,
                b'}' if braces == 0 => return,
                b'}' => {
                    braces -= 1;
                    if braces == 0 {
                        self.pos += 1;
                        return;
                    }
                }
                b';' if braces == 0 && others == 0 => {
                    self.pos += 1;
                    return;
                }
                _ => {}
            }
            self.pos += 1;
        }
    }

    /// Steps over what is left of an argument, in which so many `[` are open: up to a `,` or `)` of its own list, or a
    /// byte that can be in none.
    pub fn skip_argument(&mut self, open_brackets: usize) {
        let (mut parentheses, mut brackets) = (0_usize, open_brackets);
        while let Some(byte) = self.peek() {
            match byte {
                b'"' => {
                    self.skip_string();
                    continue;
                }
                b'(' => parentheses += 1,
                b')' if parentheses == 0 => return,
                b')' => parentheses -= 1,
                b'[' => brackets += 1,
                b']' => brackets = brackets.saturating_sub(1),
                b',' if parentheses == 0 && brackets == 0 => return,
                b';' | b'{' | b'}' => return,
                _ => {}
            }
            self.pos += 1;
        }
    }

    /// Steps over a string: past its closing quote, or to the end of the line if it has none there.
    fn skip_string(&mut self) {
        self.pos += 1;
        while let Some(byte) = self.peek() {
            match byte {
                b'\\' => self.pos += 1,
                b'"' => {
                    self.pos += 1;
                    return;
                }
                b'\n' => return,
                _ => {}
            }
            self.pos += 1;
        }
        self.pos = self.text.len();
    }
}

fn is_name_byte(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'$'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_integers_are_what_any_parser_makes_of_them() {
        for text in [
            "0",
            "-0",
            "7",
            "-12",
            "007",
            "123456789012345",
            "1234567890123456",
            "9007199254740993",
            "1e3",
            "1.5",
            "-.5",
        ] {
            for end in ["", ",", "]", " "] {
                let all = format!("{text}{end}");
                let mut cursor = Cursor::new(&all, 0);
                let expected: f64 = text.parse().expect("a number");
                assert_eq!(cursor.number().map(f64::to_bits), Some(expected.to_bits()), "{all}");
                assert_eq!(cursor.pos() as usize, text.len());
            }
        }
        for text in ["12ab", "-", "1.2.3", "x", "", "3$"] {
            let mut cursor = Cursor::new(text, 0);
            assert_eq!((cursor.number(), cursor.pos()), (None, 0), "{text}");
        }
    }
}
