//! One diagnostic in words for a person: title, place, the source line with a mark under it, notes, help.
//!
//! The annotate-snippets crate draws; it is given a few hundred bytes at a time, never the file.

use super::excerpt::{Excerpt, printable_text};
use super::place::Places;
use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
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
const WIDTH: usize = 400;

/// The diagnostic with excerpts of its file.
pub fn draw(diagnostic: &Diagnostic, places: &Places, colors: Colors) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let name = printable_text(places.source().name());
    let mut group = Group::with_title(level.primary_title(printable_text(&diagnostic.message)).id(diagnostic.code));
    for (nth, window) in windows(diagnostic, places).iter().enumerate() {
        let place = places.place(window.marks[0].0.start);
        let annotations = window.marks.iter().enumerate().map(|(i, &(range, label))| {
            let kind = if (nth, i) == (0, 0) { AnnotationKind::Primary } else { AnnotationKind::Context };
            kind.span(window.locate(range)).label(label.map(printable_text))
        });
        let snippet = Snippet::source(window.excerpt.text.clone()).line_start(place.line).annotations(annotations);
        // Where the excerpt begins in mid-line, only we know the column.
        group = if window.excerpt.of.start == 0 {
            group.element(snippet.path(name.clone()))
        } else {
            group.element(Origin::path(name.clone()).line(place.line).char_column(place.column)).element(snippet)
        };
    }
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(printable_text(help)));
    }
    let renderer = match colors {
        Colors::Ansi => Renderer::styled(),
        #[cfg(test)]
        Colors::None => Renderer::plain(),
    };
    renderer.decor_style(DecorStyle::Unicode).term_width(WIDTH).render(&[group])
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
fn windows<'d>(diagnostic: &'d Diagnostic, places: &Places) -> Vec<Window<'d>> {
    let mut windows: Vec<Window> = Vec::new();
    let notes = diagnostic.notes.iter().map(|(range, label)| (*range, Some(label.as_str())));
    for (range, label) in std::iter::once((diagnostic.at, None)).chain(notes) {
        let line = places.line_around(range.start);
        let at = (range.start as usize).saturating_sub(line.start);
        let seen = |w: &&mut Window| w.line_start == line.start && w.excerpt.of.start <= at && at <= w.excerpt.of.end;
        match windows.iter_mut().find(seen) {
            Some(window) => window.marks.push((range, label)),
            None => {
                let excerpt = Excerpt::cut(&places.source().text()[line.clone()], at);
                windows.push(Window { line_start: line.start, excerpt, marks: vec![(range, label)] });
            }
        }
    }
    windows
}
