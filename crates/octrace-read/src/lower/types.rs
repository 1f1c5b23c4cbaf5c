//! The types of arguments: what a value may be, in words and as a check.

use crate::syntax::{Ast, Value, View};

/// What a value may be. `undef` always may: it means that the argument is not given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Type {
    Number,
    Flag,
    Text,
    /// So many numbers, from and to.
    Numbers(usize, usize),
    /// A number, or so many, from and to.
    Scale(usize, usize),
    /// A vector of points of two numbers.
    Points,
    /// A vector of points of three numbers; the last may be left away, and is 0 then.
    Corners,
    /// A vector of vectors of numbers.
    Lists,
    /// Three or four rows of three or four numbers.
    Matrix,
    /// A name, `#rrggbb`, or three or four numbers.
    Color,
    /// A number, or a colour.
    Brightness,
    Any,
}

impl Type {
    /// What it may be, in words.
    pub fn expected(self) -> String {
        let times = |n: usize| ["", "a number", "two numbers", "three numbers"].get(n).copied().unwrap_or("numbers");
        match self {
            Self::Number => "a number".to_owned(),
            Self::Flag => "`true` or `false`".to_owned(),
            Self::Text => "a text in quotes".to_owned(),
            Self::Numbers(from, to) if from == to => format!("a vector of {}", times(from)),
            Self::Numbers(from, to) => format!("a vector of {from} to {to} numbers"),
            Self::Scale(from, to) if from == to => format!("a number or a vector of {}", times(from)),
            Self::Scale(from, to) => format!("a number or a vector of {from} to {to} numbers"),
            Self::Points => "a vector of points of two numbers".to_owned(),
            Self::Corners => "a vector of points of three numbers".to_owned(),
            Self::Lists => "a vector of vectors of numbers".to_owned(),
            Self::Matrix => "a vector of three or four rows of four numbers".to_owned(),
            Self::Color => "a colour: a name, \"#rrggbb\" or [r, g, b]".to_owned(),
            Self::Brightness => "a number, or a colour: a name, \"#rrggbb\" or [r, g, b]".to_owned(),
            Self::Any => "anything".to_owned(),
        }
    }

    /// Whether a value is one of these; if not, the way to the first element that is wrong.
    pub fn check(self, ast: &Ast, value: Value) -> Result<(), Vec<usize>> {
        let all = |ok: bool| if ok { Ok(()) } else { Err(Vec::new()) };
        let view = ast.view(value);
        match (self, view) {
            (_, View::Undef) | (Self::Any, _) => Ok(()),
            (Self::Number, _) => all(matches!(view, View::Number(_))),
            (Self::Flag, _) => all(matches!(view, View::Bool(_) | View::Number(_))),
            (Self::Text, _) => all(matches!(view, View::Text(_))),
            (Self::Numbers(from, to) | Self::Scale(from, to), View::Numbers(n)) => all((from..=to).contains(&n.len())),
            (Self::Scale(..) | Self::Brightness, View::Number(_)) => Ok(()),
            (Self::Color | Self::Brightness, View::Numbers(n)) => all((3..=4).contains(&n.len())),
            (Self::Color | Self::Brightness, View::Text(_)) => Ok(()),
            (Self::Points | Self::Corners | Self::Lists, View::Numbers([])) => Ok(()),
            (Self::Points | Self::Corners, View::Rows(rows)) => first_bad(rows.iter(), |row| self.fits(row)),
            (Self::Lists, View::Rows(_)) => Ok(()),
            (Self::Matrix, View::Rows(rows)) if (3..=4).contains(&rows.len()) => {
                first_bad(rows.iter(), |row| (3..=4).contains(&row.len()))
            }
            (Self::Points | Self::Corners | Self::Lists | Self::Matrix, View::List(items)) => {
                self.check_items(ast, items)
            }
            _ => Err(Vec::new()),
        }
    }

    /// Whether a row of numbers has the length that it should have.
    fn fits(self, row: &[f64]) -> bool {
        match self {
            Self::Points => row.len() == 2,
            Self::Corners => (2..=3).contains(&row.len()),
            _ => true,
        }
    }

    /// Whether OpenSCAD makes nothing of a shape with a wrong value, and says so in its dump.
    pub fn is_dumped_raw(self) -> bool {
        matches!(self, Self::Points | Self::Corners | Self::Lists)
    }

    fn check_items(self, ast: &Ast, items: &[Value]) -> Result<(), Vec<usize>> {
        let row = items.iter().position(|&item| !matches!(ast.view(item), View::Numbers(row) if self.fits(row)));
        let Some(row) = row else { return Err(Vec::new()) };
        match ast.view(items[row]) {
            View::List(inner) => {
                let not_a_number = |&item: &Value| !matches!(ast.view(item), View::Number(_));
                Err(inner.iter().position(not_a_number).map_or_else(|| vec![row], |column| vec![row, column]))
            }
            _ => Err(vec![row]),
        }
    }
}

fn first_bad<'r>(rows: impl Iterator<Item = &'r [f64]>, good: impl Fn(&[f64]) -> bool) -> Result<(), Vec<usize>> {
    rows.enumerate().find(|(_, row)| !good(row)).map_or(Ok(()), |(i, _)| Err(vec![i]))
}
