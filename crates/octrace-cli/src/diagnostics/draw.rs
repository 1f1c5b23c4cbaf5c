//! One diagnostic in words for a person: title, place, the source line with a mark under it, notes, help.
//!
//! The annotate-snippets crate draws; it is given a few hundred bytes at a time, never the file.

use super::excerpt::{Excerpt, printable_text};
use super::place::Places;
use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use octrace_read::{Diagnostic, Severity, SourceRange};

/// Whether to draw with colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colors {
    /// ANSI escapes, which [`anstream`] takes away again where they do not belong.
    Ansi,
    /// Characters only.
    #[cfg(test)]
    None,
}

/// Longer than any excerpt, so that the crate has nothing left to cut.
const WIDTH: usize = 1000;

/// Ends the place in front of an excerpt. The crate only sees the excerpt and appends a place of its own, which is to go.
const PLACE_END: char = '\u{e000}';

/// The diagnostic with excerpts of its file, in lines of `width` columns as far as the excerpts are concerned.
pub fn draw(diagnostic: &Diagnostic, places: &Places, width: usize, colors: Colors) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let name = printable_text(places.source().name());
    let mut group = Group::with_title(level.primary_title(printable_text(&diagnostic.message)).id(diagnostic.code));
    for (nth, window) in windows(diagnostic, places, width).iter().enumerate() {
        let place = places.place(window.marks[0].0.start);
        let annotations = window.marks.iter().enumerate().map(|(i, &(range, label))| {
            let kind = if (nth, i) == (0, 0) { AnnotationKind::Primary } else { AnnotationKind::Context };
            kind.span(window.locate(range)).label(label.map(printable_text))
        });
        let snippet = Snippet::source(window.excerpt.text.clone()).line_start(place.line).annotations(annotations);
        group = group.element(snippet.path(format!("{name}:{}:{}{PLACE_END}", place.line, place.column)));
    }
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(printable_text(help)));
    }
    let renderer = match colors {
        Colors::Ansi => Renderer::styled(),
        #[cfg(test)]
        Colors::None => Renderer::plain(),
    };
    let drawn = renderer.decor_style(DecorStyle::Unicode).term_width(WIDTH).render(&[group]);
    let mut pieces = drawn.split(PLACE_END);
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.fold(first, |text, piece| text + piece.trim_start_matches(|c: char| c == ':' || c.is_ascii_digit()))
}

/// A piece of one line with everything of a diagnostic that is marked in it.
struct Window<'d> {
    line_start: usize,
    excerpt: Excerpt,
    marks: Vec<(SourceRange, Option<&'d str>)>,
}

impl Window<'_> {
    /// Where a range of the file is in the excerpt.
    fn locate(&self, range: SourceRange) -> std::ops::Range<usize> {
        let on_line = |at: u32| (at as usize).saturating_sub(self.line_start);
        self.excerpt.locate(&(on_line(range.start)..on_line(range.end)))
    }
}

/// One window per line, in the order of first mention. Of a range of several lines the first one is marked.
fn windows<'d>(diagnostic: &'d Diagnostic, places: &Places, width: usize) -> Vec<Window<'d>> {
    let ranges = std::iter::once(diagnostic.at).chain(diagnostic.notes.iter().map(|(range, _)| *range));
    let last_line = ranges.map(|range| places.place(range.start).line).max().unwrap_or(1);
    // What stands in front of the text: the line's number and " │ ".
    let room = width.saturating_sub(last_line.to_string().len() + 3);
    let mut windows: Vec<Window> = Vec::new();
    let notes = diagnostic.notes.iter().map(|(range, label)| (*range, Some(label.as_str())));
    for (range, label) in std::iter::once((diagnostic.at, None)).chain(notes) {
        let line = places.line_around(range.start);
        let at = (range.start as usize).saturating_sub(line.start);
        let seen = |w: &&mut Window| w.line_start == line.start && w.excerpt.of.start <= at && at <= w.excerpt.of.end;
        match windows.iter_mut().find(seen) {
            Some(window) => window.marks.push((range, label)),
            None => {
                let excerpt = Excerpt::cut(&places.source().text()[line.clone()], at, room);
                windows.push(Window { line_start: line.start, excerpt, marks: vec![(range, label)] });
            }
        }
    }
    windows
}
