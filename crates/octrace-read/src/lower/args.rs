//! The arguments of a node, matched with what it takes.

use super::language::{Word, nearest};
use super::report::Report;
use super::types::Type;
use crate::diagnostic::{Diagnostic, Severity};
use crate::syntax::{Arg, Ast, NodeId, Rows, Value, View, element_range};
use crate::{Dialect, SourceRange};

/// The arguments of one node, checked: of the right type, or absent.
pub(super) struct Args<'a> {
    ast: &'a Ast,
    word: &'static Word,
    given: Vec<(&'static str, &'a Arg)>,
    /// Where the node's name is written, modifiers excluded: the place for what is missing.
    pub name_at: SourceRange,
    /// Whether arguments may be missing because of an error that was reported already.
    pub damaged: bool,
}

impl<'a> Args<'a> {
    /// Matches a node's arguments with what the word takes, and reports what does not fit.
    pub fn of(ast: &'a Ast, node: NodeId, word: &'static Word, report: &mut Report<'_>) -> Self {
        let mut args = Self { ast, word, given: Vec::new(), name_at: ast.name_at(node), damaged: ast.is_damaged(node) };
        let mut unnamed = word.params.iter().filter(|(name, _)| !name.starts_with('$'));
        for arg in ast.args(node) {
            let param = match ast.arg_name(arg) {
                None => unnamed.next(),
                Some(name) => word.params.iter().find(|(param, _)| *param == name),
            };
            match param {
                Some(&(name, ty)) => args.take(name, ty, arg, report),
                None => args.unknown(arg, report),
            }
        }
        args
    }

    fn take(&mut self, name: &'static str, ty: Type, arg: &'a Arg, report: &mut Report<'_>) {
        if let Err(path) = ty.check(self.ast, arg.value) {
            self.damaged = true;
            let at = element_range(report.text, arg.at, &path);
            let place = path.iter().map(|i| format!("[{i}]")).collect::<String>();
            let found = match self.ast.view(arg.value) {
                _ if !path.is_empty() => format!("; `{name}{place}` is not that"),
                View::Undef => ", not `undef`".to_owned(),
                View::Bool(b) => format!(", not `{b}`"),
                View::Number(_) => ", not a number".to_owned(),
                View::Text(_) => ", not a text".to_owned(),
                View::Numbers(n) => format!(", not a vector of {}", n.len()),
                View::Rows(_) | View::List(_) => ", not this vector".to_owned(),
            };
            let message = format!("`{name}` of `{}` should be {}{found}", self.word.name, ty.expected());
            if ty.is_dumped_raw() {
                report.degenerate("argument-type", at, message, "this is empty", None);
            } else {
                report.push(Diagnostic::error("argument-type", at, message));
            }
        } else if matches!(self.ast.view(arg.value), View::Undef) {
            // The same as not given.
        } else if let Some((_, earlier)) = self.given.iter_mut().find(|(given, _)| *given == name) {
            let message = format!("`{name}` is given twice; this one counts");
            let note = "this one does not";
            report.push(Diagnostic::warning("duplicate-argument", arg.at, message).with_note(earlier.at, note));
            *earlier = arg;
        } else {
            self.given.push((name, arg));
        }
    }

    fn unknown(&self, arg: &Arg, report: &mut Report<'_>) {
        let word = self.word.name;
        let Some(name) = self.ast.arg_name(arg) else {
            let message = format!("`{word}` does not take that many arguments; this one is ignored");
            report.push(Diagnostic::warning("unknown-argument", arg.at, message));
            return;
        };
        if name.starts_with('$') {
            return;
        }
        let message = format!("`{word}` has no argument `{name}`; it is ignored");
        match report.dialect {
            Dialect::Scene => {
                let names = || self.word.params.iter().map(|(param, _)| *param).filter(|param| !param.starts_with('$'));
                let near = nearest(name, names()).or_else(|| names().find(|param| name.starts_with(param)));
                let help = match near {
                    Some(near) => Some(format!("did you mean `{near}`?")),
                    None if self.word.params.is_empty() => Some(format!("`{word}` takes no arguments")),
                    None => Some(format!("it takes {}", names().collect::<Vec<_>>().join(", "))),
                };
                let diagnostic = Diagnostic::new(Severity::Warning, "unknown-argument", arg.name_at, message);
                report.push(Diagnostic { help, ..diagnostic });
            }
            // Newer versions of OpenSCAD write more; once is enough to know.
            Dialect::Dump => {
                if report.is_news(word, name) {
                    report.push(Diagnostic::note("unknown-argument", arg.name_at, message));
                }
            }
        }
    }

    /// The argument as it stands in the file.
    pub fn get(&self, name: &str) -> Option<&'a Arg> {
        self.given.iter().find(|(given, _)| *given == name).map(|(_, arg)| *arg)
    }

    /// What is in the argument.
    pub fn view(&self, name: &str) -> Option<View<'a>> {
        self.get(name).map(|arg| self.ast.view(arg.value))
    }

    /// Whether the node has this name.
    pub fn is_of(&self, word: &str) -> bool {
        self.word.name == word
    }

    /// Whether a `file` is named.
    pub fn names_a_file(&self) -> bool {
        self.text("file").is_some_and(|(name, _)| !name.is_empty())
    }

    /// What is in a value of an argument.
    pub fn look(&self, value: Value) -> View<'a> {
        self.ast.view(value)
    }

    /// A number and its place.
    pub fn number(&self, name: &str) -> Option<(f64, SourceRange)> {
        match (self.get(name)?, self.view(name)?) {
            (arg, View::Number(v)) => Some((v, arg.at)),
            _ => None,
        }
    }

    /// Whether a flag is given and true.
    pub fn flag(&self, name: &str) -> bool {
        match self.view(name) {
            Some(View::Bool(b)) => b,
            Some(View::Number(v)) => v != 0.0,
            _ => false,
        }
    }

    /// A text.
    pub fn text(&self, name: &str) -> Option<(&'a str, SourceRange)> {
        match (self.get(name)?, self.view(name)?) {
            (arg, View::Text(text)) => Some((text, arg.at)),
            _ => None,
        }
    }

    /// A vector of numbers.
    pub fn numbers(&self, name: &str) -> Option<(&'a [f64], SourceRange)> {
        match (self.get(name)?, self.view(name)?) {
            (arg, View::Numbers(numbers)) => Some((numbers, arg.at)),
            _ => None,
        }
    }

    /// Three numbers; those that lack are `fill`.
    pub fn triple(&self, name: &str, fill: f64) -> Option<([f64; 3], SourceRange)> {
        let (numbers, at) = self.numbers(name)?;
        let item = |i: usize| numbers.get(i).copied().unwrap_or(fill);
        Some(([item(0), item(1), item(2)], at))
    }

    /// A vector of vectors of numbers; an empty vector is one of no vectors.
    pub fn rows(&self, name: &str) -> Option<(Rows<'a>, SourceRange)> {
        match (self.get(name)?, self.view(name)?) {
            (arg, View::Rows(rows)) => Some((rows, arg.at)),
            (arg, View::Numbers([])) => Some((Rows::default(), arg.at)),
            _ => None,
        }
    }
}
