//! Text to tree: nodes and their arguments. Goes on after an error, so that all of a file's errors are found at once.

use super::ast::{Ast, Modifiers, NodeId};
use super::build::AstBuilder;
use super::cursor::{Cursor, UnclosedComment};
use super::repeats::{Beginning, Repeats};
use crate::diagnostic::{Checked, Collector, Diagnostic};
use crate::{Source, SourceRange};

/// Reads the syntax of a file. The tree holds what was understood, also where there are errors.
pub fn parse(source: &Source) -> Checked<Ast> {
    let mut diagnostics = Collector::default();
    let ast = parse_into(source, &mut diagnostics);
    Checked { value: Some(ast), diagnostics: diagnostics.finish() }
}

pub(crate) fn parse_into(source: &Source, diagnostics: &mut Collector) -> Ast {
    if let Some(diagnostic) = unreadable(source) {
        diagnostics.push(diagnostic);
        return Ast::default();
    }
    let start = if source.text().starts_with('\u{FEFF}') { '\u{FEFF}'.len_utf8() } else { 0 };
    let mut parser = Parser {
        cursor: Cursor::new(source.text(), start),
        builder: AstBuilder::new(),
        repeats: Repeats::of(source.text()),
        open: Vec::new(),
        evaluated: Vec::new(),
        ended: false,
        diagnostics,
    };
    parser.file();
    parser.report_evaluated();
    parser.builder.finish()
}

/// What keeps a file from being read as text at all.
fn unreadable(source: &Source) -> Option<Diagnostic> {
    const HELP: &str = "octrace reads `.oct` scenes, `.csg` dumps and `.scad` files";
    let byte = |at: u32| SourceRange::new(at, at + 1);
    if source.is_too_large() {
        return Some(Diagnostic::error("file-too-large", SourceRange::default(), "the file is larger than 4 GiB"));
    }
    let (at, what) = match (source.not_utf8_at(), source.text().find('\0')) {
        (Some(at), _) => (at, "not UTF-8"),
        (None, Some(at)) => (at as u32, "zero"),
        (None, None) => return None,
    };
    let message = format!("this is not a text file: byte {at} is {what}");
    Some(Diagnostic::error("not-text", byte(at), message).with_help(HELP))
}

/// Whether it is a word of OpenSCAD's language that only its evaluator understands.
fn is_evaluated(word: &str) -> bool {
    matches!(
        word,
        "module"
            | "function"
            | "for"
            | "intersection_for"
            | "if"
            | "else"
            | "let"
            | "assign"
            | "each"
            | "echo"
            | "assert"
            | "include"
            | "use"
    )
}

/// A node that waits for children.
#[derive(Clone, Copy, Debug)]
enum Open {
    /// A block, opened by the brace at this offset.
    Block { entered: Entered, brace: u32 },
    /// A node followed by its only child.
    Chain { entered: Entered },
}

/// A node, and what there was when it began.
#[derive(Clone, Copy, Debug)]
struct Entered {
    node: NodeId,
    beginning: Option<Beginning>,
    /// How much had been found wrong.
    wrong: usize,
}

/// Stops what is being parsed: there is an error, and it has been reported.
pub(super) struct Reported;

/// The state of reading one file.
pub(super) struct Parser<'s, 'd> {
    pub(super) cursor: Cursor<'s>,
    pub(super) builder: AstBuilder,
    repeats: Repeats<'s>,
    open: Vec<Open>,
    /// Places where the file asks for evaluation.
    evaluated: Vec<SourceRange>,
    /// Whether the end of the file came too early, and that was said.
    ended: bool,
    diagnostics: &'d mut Collector,
}

impl Parser<'_, '_> {
    fn file(&mut self) {
        loop {
            self.skip_blanks();
            match self.cursor.peek() {
                None => break,
                Some(b';') => self.cursor.bump(),
                Some(b'}') => self.closing_brace(),
                Some(_) => {
                    if self.item() == Item::Ended {
                        self.close_chains();
                    }
                }
            }
        }
        self.unclosed_blocks();
    }

    pub(super) fn skip_blanks(&mut self) {
        if let Err(UnclosedComment { at }) = self.cursor.skip_blanks() {
            self.report(Diagnostic::error("unclosed-comment", SourceRange::new(at, at + 2), "this comment has no end"));
            self.ended = true;
        }
    }

    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// The range from `start` to here.
    pub(super) fn since(&self, start: u32) -> SourceRange {
        SourceRange::new(start, self.cursor.pos())
    }

    /// The next byte's place; empty at the end of the file.
    pub(super) fn here(&self) -> SourceRange {
        let pos = self.cursor.pos();
        let length = self.cursor.text()[pos as usize..].chars().next().map_or(0, char::len_utf8);
        SourceRange::new(pos, pos + length as u32)
    }

    /// The file ends too early. Said once: what lacks further out follows from it.
    pub(super) fn ends_inside(&mut self, code: &'static str, what: &str, opened: SourceRange) {
        if !std::mem::replace(&mut self.ended, true) {
            let note = "this is still open";
            self.report(Diagnostic::error(code, self.here(), format!("the file ends {what}")).with_note(opened, note));
        }
    }

    /// Something here would have to be evaluated.
    pub(super) fn needs_evaluation(&mut self, at: SourceRange) {
        self.evaluated.push(at);
    }

    fn report_evaluated(&mut self) {
        const FURTHER_PLACES: usize = 4;
        let Some(&first) = self.evaluated.first() else { return };
        let word = &self.cursor.text()[first.start as usize..first.end as usize];
        let message = format!("`{word}` would have to be evaluated; here are only nodes with constant arguments");
        let mut diagnostic = Diagnostic::error("not-evaluated", first, message)
            .with_help("let OpenSCAD evaluate it: name the file `.scad`, or run `openscad -o model.csg model.scad`");
        for &at in self.evaluated.iter().skip(1).take(FURTHER_PLACES) {
            diagnostic = diagnostic.with_note(at, "and this");
        }
        if let Some(&at) = self.evaluated.get(1 + FURTHER_PLACES) {
            let more = self.evaluated.len() - 1 - FURTHER_PLACES;
            diagnostic = diagnostic.with_note(at, format!("and {more} more places from here on"));
        }
        self.report(diagnostic);
    }

    fn closing_brace(&mut self) {
        let at = self.here();
        self.cursor.bump();
        match self.open.pop() {
            Some(Open::Block { entered, .. }) => {
                self.close(entered);
                self.close_chains();
            }
            Some(Open::Chain { .. }) | None => {
                self.report(Diagnostic::error("unmatched-brace", at, "this `}` closes nothing"))
            }
        }
    }

    /// Ends the nodes whose only child has just ended.
    fn close_chains(&mut self) {
        while let Some(&Open::Chain { entered }) = self.open.last() {
            self.open.pop();
            self.close(entered);
        }
    }

    /// Ends a node here. It is kept in mind, for its text may come again, if nothing is wrong with it.
    fn close(&mut self, Entered { node, beginning, wrong }: Entered) {
        let end = self.cursor.pos();
        self.builder.end_at(node, end);
        self.builder.close_node();
        if let Some(beginning) = beginning
            && self.wrong() == wrong
        {
            self.repeats.keep(node, beginning, end);
        }
    }

    /// How much was found wrong so far.
    fn wrong(&self) -> usize {
        self.diagnostics.count() + self.evaluated.len()
    }

    fn unclosed_blocks(&mut self) {
        let brace_at = |open: &Open| match open {
            Open::Block { brace, .. } => Some(SourceRange::new(*brace, brace + 1)),
            Open::Chain { .. } => None,
        };
        let braces: Vec<SourceRange> = self.open.iter().filter_map(brace_at).collect();
        if let (Some(&outermost), Some(&innermost), false) = (braces.first(), braces.last(), self.ended) {
            let message = match braces.len() {
                1 => "the file ends, but a `}` is missing".to_owned(),
                n => format!("the file ends, but {n} `}}` are missing"),
            };
            let mut diagnostic = Diagnostic::error("unclosed-block", self.here(), message)
                .with_note(innermost, "this is still open")
                .with_help("was the file cut short?");
            if braces.len() > 1 {
                diagnostic = diagnostic.with_note(outermost, "and so is everything from here on");
            }
            self.report(diagnostic);
        }
        while let Some(Open::Block { entered, .. } | Open::Chain { entered }) = self.open.pop() {
            self.builder.end_at(entered.node, self.cursor.pos());
        }
    }

    /// A node with its arguments, up to and with its `;` or `{`; or something that should have been one.
    fn item(&mut self) -> Item {
        // Once for each node of a chain.
        loop {
            let start = self.cursor.pos();
            let beginning = self.repeats.beginning(start);
            if let Some((node, length)) = beginning.and_then(|beginning| self.repeats.find(beginning)) {
                self.builder.repeat(node, start);
                self.cursor.set_pos(start + length);
                return Item::Ended;
            }
            let wrong = self.wrong();
            let Some(node) = self.head() else { return Item::Ended };
            let entered = Entered { node, beginning, wrong };
            let end = self.cursor.pos();
            self.builder.end_at(node, end);
            self.skip_blanks();
            match self.cursor.peek() {
                Some(b'{') => {
                    self.open.push(Open::Block { entered, brace: self.cursor.pos() });
                    self.cursor.bump();
                    return Item::Opened;
                }
                Some(b'%' | b'#' | b'!' | b'*') => self.open.push(Open::Chain { entered }),
                Some(_) if self.cursor.at_name() => self.open.push(Open::Chain { entered }),
                next => {
                    self.builder.close_node();
                    match next {
                        Some(b';') => self.cursor.bump(),
                        None => self.ends_inside(
                            "unexpected-end",
                            "where a `;` or `{` should follow",
                            SourceRange::new(start, end),
                        ),
                        Some(_) => self.missing_semicolon(end),
                    }
                    return Item::Ended;
                }
            }
        }
    }

    /// Modifiers, name and arguments. `None` where there is no node, and everything that should have been one has been
    /// stepped over.
    fn head(&mut self) -> Option<NodeId> {
        let start = self.cursor.pos();
        let modifiers = self.modifiers();
        let name_start = self.cursor.pos();
        let name = self.cursor.name();
        let name_at = self.since(name_start);
        if name.is_empty() {
            self.junk(start);
            return None;
        }
        if is_evaluated(name) {
            self.needs_evaluation(name_at);
            self.skip_evaluated_statement(name);
            return None;
        }
        self.skip_blanks();
        match self.cursor.peek() {
            Some(b'(') => {
                let node = self.builder.open_node_at(name, modifiers, name_at, SourceRange::new(start, name_at.end));
                self.arguments(node);
                Some(node)
            }
            Some(b';' | b'{') => {
                let message = format!("`{name}` lacks its parentheses");
                let help = format!("write `{name}()`");
                self.report(Diagnostic::error("missing-parentheses", name_at, message).with_help(help));
                let node = self.builder.open_node_at(name, modifiers, name_at, SourceRange::new(start, name_at.end));
                self.builder.mark_damaged(node);
                Some(node)
            }
            Some(b'=') => {
                self.needs_evaluation(SourceRange::new(name_start, self.cursor.pos() + 1));
                self.cursor.skip_statement();
                None
            }
            None => {
                self.ends_inside("unexpected-end", "where a `(` should follow", name_at);
                None
            }
            Some(_) => {
                self.junk(start);
                None
            }
        }
    }

    fn modifiers(&mut self) -> Modifiers {
        let mut modifiers = Modifiers::NONE;
        while let Some(modifier) = self.cursor.peek().and_then(Modifiers::from_byte) {
            modifiers = modifiers.with(modifier);
            self.cursor.bump();
            self.skip_blanks();
        }
        modifiers
    }

    fn skip_evaluated_statement(&mut self, word: &str) {
        self.skip_blanks();
        if matches!(word, "include" | "use") && self.cursor.peek() == Some(b'<') {
            self.cursor.skip_junk();
        } else {
            self.cursor.skip_statement();
        }
    }

    /// Steps over the rest of a line that is not a node.
    fn junk(&mut self, start: u32) {
        let pos = self.cursor.pos();
        self.cursor.skip_junk();
        if self.cursor.pos() == pos && matches!(self.cursor.peek(), Some(b'{')) {
            self.cursor.bump();
        }
        let text = self.cursor.text()[start as usize..self.cursor.pos() as usize].trim_end();
        let at = SourceRange::new(start, start + text.len() as u32);
        let found = match text.chars().next() {
            Some('{') => "a block without a node in front of it".to_owned(),
            Some(c) if text.chars().nth(1).is_none() => format!("`{c}`"),
            Some(_) => "something else".to_owned(),
            None => "nothing".to_owned(),
        };
        let message = format!("here should be a node, such as `cube();`, but there is {found}");
        self.report(Diagnostic::error("not-a-node", at, message));
    }

    fn missing_semicolon(&mut self, end: u32) {
        let at = SourceRange::new(end.saturating_sub(1), end);
        self.report(Diagnostic::error("missing-semicolon", at, "a `;` or a block should follow here"));
        if self.cursor.peek() != Some(b'}') {
            self.cursor.skip_junk();
        }
    }

    /// The arguments of a node, from `(` up to and with `)`.
    fn arguments(&mut self, node: NodeId) {
        let parenthesis = self.here();
        self.cursor.bump();
        loop {
            self.skip_blanks();
            match self.cursor.peek() {
                Some(b')') => {
                    self.cursor.bump();
                    return;
                }
                Some(b',') => self.cursor.bump(),
                Some(b';' | b'{' | b'}') => {
                    self.builder.mark_damaged(node);
                    let message = "a `)` should come before this";
                    let diagnostic = Diagnostic::error("unclosed-parenthesis", self.here(), message);
                    self.report(diagnostic.with_note(parenthesis, "this is still open"));
                    return;
                }
                None => {
                    self.builder.mark_damaged(node);
                    self.ends_inside("unclosed-parenthesis", "inside the arguments of a node", parenthesis);
                    return;
                }
                Some(_) => {
                    if self.argument().is_err() {
                        self.builder.mark_damaged(node);
                        self.cursor.skip_argument(self.builder.open_vectors());
                        self.builder.discard_value();
                    }
                }
            }
        }
    }

    /// One argument and the check that it ends where it should.
    fn argument(&mut self) -> Result<(), Reported> {
        let start = self.cursor.pos();
        let mut name = Some(self.cursor.name()).filter(|name| !name.is_empty());
        let mut name_at = self.since(start);
        self.skip_blanks();
        if name.is_some() && self.cursor.peek().is_none() {
            // Whether this is a word or a name, only what is cut off could tell.
            return Err(Reported);
        }
        if name.is_some() && self.cursor.eat(b'=') {
            self.skip_blanks();
        } else {
            self.cursor.set_pos(start);
            name = None;
            name_at = SourceRange::new(start, start);
        }
        let at = self.value()?;
        self.builder.finish_arg_at(name, name_at, at);
        self.skip_blanks();
        match self.cursor.peek() {
            Some(b',' | b')') | None => Ok(()),
            Some(b'"' | b'[' | b'0'..=b'9' | b'a'..=b'z' | b'A'..=b'Z' | b'$') => {
                let gap = SourceRange::new(at.end.saturating_sub(1), at.end);
                self.report(Diagnostic::error("missing-comma", gap, "a `,` should follow here"));
                Ok(())
            }
            Some(b';' | b'{' | b'}') => Ok(()),
            Some(_) => {
                self.needs_evaluation(self.here());
                Err(Reported)
            }
        }
    }
}

/// How far [`Parser::item`] came.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Item {
    /// To the end of a node without a block, or of something that is no node.
    Ended,
    /// To the first child of a block.
    Opened,
}
