//! Where an element of a vector is written. The tree does not keep a place for each of millions of numbers; the few
//! that are complained of are looked up in the text again.

use super::cursor::Cursor;
use crate::SourceRange;

/// The place of an element of the vector written at `at`: of element `path[0]`, of element `path[1]` of that, and so
/// on. Where the vector is not that deep or long, the place of as much of the path as there is.
pub fn element_range(text: &str, at: SourceRange, path: &[usize]) -> SourceRange {
    path.iter().try_fold(at, |at, &index| nth(text, at, index).ok_or(at)).unwrap_or_else(|found| found)
}

fn nth(text: &str, at: SourceRange, index: usize) -> Option<SourceRange> {
    let mut cursor = Cursor::new(text.get(..at.end as usize)?, at.start as usize);
    if !cursor.eat(b'[') {
        return None;
    }
    for _ in 0..index {
        cursor.skip_element()?;
        if !cursor.eat(b',') {
            return None;
        }
    }
    cursor.skip_blanks().ok()?;
    let start = cursor.pos();
    let end = cursor.skip_element()?;
    (start < end).then_some(SourceRange::new(start, end))
}

impl Cursor<'_> {
    /// Steps over an element of a vector, up to the `,` or `]` after it; returns where its last byte that is not blank
    /// ends. `None` where the text ends.
    fn skip_element(&mut self) -> Option<u32> {
        let mut depth = 0_usize;
        let mut end = self.pos();
        loop {
            self.skip_blanks().ok()?;
            match self.peek()? {
                b',' | b']' if depth == 0 => return Some(end),
                b'[' => depth += 1,
                b']' => depth -= 1,
                b'"' => self.skip_quoted()?,
                _ => {}
            }
            self.bump();
            end = self.pos();
        }
    }

    fn skip_quoted(&mut self) -> Option<()> {
        self.bump();
        while self.peek()? != b'"' {
            if self.peek() == Some(b'\\') {
                self.bump();
            }
            self.bump();
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, path: &[usize], expected: &str) {
        let whole = SourceRange::new(0, text.len() as u32);
        let found = element_range(text, whole, path);
        assert_eq!(&text[found.start as usize..found.end as usize], expected);
    }

    #[test]
    fn elements_are_found_again() {
        check("[1, [22 , 3], /* , */ \"a,]\\\"\", 4]", &[0], "1");
        check("[1, [22 , 3], /* , */ \"a,]\\\"\", 4]", &[1], "[22 , 3]");
        check("[1, [22 , 3], /* , */ \"a,]\\\"\", 4]", &[1, 0], "22");
        check("[1, [22 , 3], /* , */ \"a,]\\\"\", 4]", &[2], "\"a,]\\\"\"");
        check("[1, [22 , 3], 4]", &[2], "4");
    }

    #[test]
    fn what_is_not_there_is_not_found() {
        check("[1, 2]", &[2], "[1, 2]");
        check("[1, [2]]", &[1, 5], "[2]");
        check("[]", &[0], "[]");
        check("7", &[0], "7");
        check("[1, \"ab", &[1], "[1, \"ab");
    }
}
