//! What readers have to say, shown to people and to programs.

mod draw;
mod excerpt;
mod json;
mod place;

pub use excerpt::printable_text;
pub use json::{JsonDiagnostic, json};

use crate::output::say;
use draw::{Colors, draw};
use octrace_read::{Diagnostic, Severity, Source};
use place::Places;
use std::collections::BTreeMap;

/// Which diagnostics are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Show {
    /// All of them.
    All,
    /// Errors only.
    Errors,
}

/// How many diagnostics with the same message, and with the same code, are drawn with an excerpt of the source; the
/// others get a line each. A dump that uses something unsupported does so hundreds of times, and the first places tell
/// what it looks like.
const DRAWN_PER_MESSAGE: usize = 2;
const DRAWN_PER_CODE: usize = 10;

/// Columns of an excerpt where there is no terminal to ask.
const WIDTH: usize = 160;

/// How many different messages are counted at the end.
const MESSAGES_COUNTED: usize = 12;

/// Prints the diagnostics of one file to standard error.
pub fn print(source: &Source, diagnostics: &[Diagnostic], show: Show) {
    let width = terminal_size::terminal_size_of(std::io::stderr()).map_or(WIDTH, |(width, _)| width.0.into());
    let report = report(source, diagnostics, show, width, Colors::Ansi);
    if !report.is_empty() {
        say(report.trim_end());
    }
}

fn report(source: &Source, diagnostics: &[Diagnostic], show: Show, width: usize, colors: Colors) -> String {
    let mut shown: Vec<&Diagnostic> =
        diagnostics.iter().filter(|d| show == Show::All || d.severity == Severity::Error).collect();
    if shown.is_empty() {
        return String::new();
    }
    shown.sort_by_key(|d| d.at.start);
    let places = Places::new(source);
    let name = printable_text(source.name());
    let mut by_code: BTreeMap<&str, usize> = BTreeMap::new();
    let mut by_message: BTreeMap<&str, usize> = BTreeMap::new();
    let mut report = String::new();
    for diagnostic in &shown {
        let same_code = count(&mut by_code, diagnostic.code);
        // One that stands for many is no message of its own.
        let same_message = if diagnostic.count == 1 { count(&mut by_message, &diagnostic.message) } else { usize::MAX };
        if same_code <= DRAWN_PER_CODE && same_message <= DRAWN_PER_MESSAGE {
            report += &draw(diagnostic, &places, width, colors);
            report += "\n\n";
        } else {
            let place = places.place(diagnostic.at.start);
            let (severity, code) = (word(diagnostic.severity), diagnostic.code);
            let message = printable_text(&diagnostic.message);
            report += &format!("{name}:{}:{}: {severity}[{code}]: {message}\n", place.line, place.column);
        }
    }
    report += &format!("{name}: {}\n", totals(&shown));
    let all: usize = shown.iter().map(|d| d.count).sum();
    if all > by_message.len() {
        report += &most_frequent(by_message, all);
    }
    report
}

fn count<'a>(counts: &mut BTreeMap<&'a str, usize>, key: &'a str) -> usize {
    let count = counts.entry(key).or_default();
    *count += 1;
    *count
}

/// "2 errors, 1 warning".
fn totals(shown: &[&Diagnostic]) -> String {
    let counts = [Severity::Error, Severity::Warning, Severity::Note].into_iter().filter_map(|severity| {
        let word = word(severity);
        match shown.iter().filter(|d| d.severity == severity).map(|d| d.count).sum() {
            0 => None,
            1 => Some(format!("1 {word}")),
            count => Some(format!("{count} {word}s")),
        }
    });
    counts.collect::<Vec<_>>().join(", ")
}

/// A line for each of the most frequent messages, of which there are so many in all.
fn most_frequent(by_message: BTreeMap<&str, usize>, all: usize) -> String {
    let mut by_count: Vec<(&str, usize)> = by_message.into_iter().collect();
    by_count.sort_by_key(|&(_, count)| std::cmp::Reverse(count));
    by_count.truncate(MESSAGES_COUNTED);
    let lines = by_count.iter().map(|(message, count)| format!("{count:>6} x {}\n", printable_text(message)));
    let rest = all - by_count.iter().map(|&(_, count)| count).sum::<usize>();
    let rest = if rest > 0 { format!("{rest:>6} others\n") } else { String::new() };
    lines.collect::<String>() + &rest
}

fn word(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace_read::SourceRange;

    fn find(text: &str, what: &str) -> SourceRange {
        let start = text.find(what).unwrap();
        SourceRange::new(start as u32, (start + what.len()) as u32)
    }

    fn plain(text: &str, diagnostics: &[Diagnostic]) -> String {
        report(&Source::new("bracket.oct", text), diagnostics, Show::All, WIDTH, Colors::None)
    }

    #[test]
    fn one_error_with_a_note_and_help() {
        let text = "difference() {\n  cube(5);\n\tsphere(r = -2); // é\n}\n";
        let bad = Diagnostic::error("radius-not-positive", find(text, "-2"), "sphere radius must be greater than zero")
            .with_note(find(text, "r ="), "given here")
            .with_note(find(text, "cube(5)"), "it would be cut from this")
            .with_help("write `r = 2`; to cut a ball away, use `difference`");
        insta::assert_snapshot!(plain(text, &[bad]));
    }

    #[test]
    fn a_warning_over_several_lines_on_a_long_line() {
        let text = "a".repeat(5_000_000) + "group() {\n}\n" + &"b".repeat(5_000_000);
        let long = Diagnostic::warning("empty-group", find(&text, "group() {\n}"), "a group without children");
        insta::assert_snapshot!(plain(&text, &[long]));
    }

    #[test]
    fn an_error_at_the_end_of_an_empty_file_has_a_place() {
        let at_end = Diagnostic::error("empty", SourceRange::new(0, 0), "nothing here");
        insta::assert_snapshot!(plain("", &[at_end]));
    }

    #[test]
    fn of_many_the_first_are_drawn_and_all_are_placed() {
        let text = "hull();\n".repeat(9);
        let many: Vec<Diagnostic> = (0..9)
            .map(|i| Diagnostic::error("unsupported", SourceRange::new(i * 8, i * 8 + 4), "hull is not supported yet"))
            .collect();
        let report = plain(&text, &many);
        for line in 1..=9 {
            assert!(report.contains(&format!("bracket.oct:{line}:1")), "line {line} in:\n{report}");
        }
        assert!(
            report.ends_with(
                "bracket.oct: 9 errors
     9 x hull is not supported yet
"
            ),
            "{report}"
        );
        assert_eq!(report.matches("━━━━").count(), DRAWN_PER_MESSAGE, "{report}");
    }

    #[test]
    fn one_that_stands_for_many_counts_for_all_of_them() {
        let mut many = vec![Diagnostic::error("noise", SourceRange::new(0, 1), "again"); 3];
        many.push(Diagnostic { count: 997, ..Diagnostic::error("noise", SourceRange::new(1, 2), "and 997 more") });
        let report = plain("abc", &many);
        assert!(
            report.ends_with("and 997 more\nbracket.oct: 1000 errors\n     3 x again\n   997 others\n"),
            "{report}"
        );
    }

    #[test]
    fn ten_thousand_errors_on_a_line_of_ten_megabytes_take_no_time_to_speak_of() {
        let text = "hull() {} ".repeat(1_000_000);
        let many: Vec<Diagnostic> = (0..10_000)
            .map(|i| SourceRange::new(i * 1000, i * 1000 + 4))
            .map(|at| Diagnostic::error("unsupported", at, "hull is not supported yet"))
            .collect();
        let report = plain(&text, &many);
        assert!(report.contains("bracket.oct:1:9999001: error[unsupported]"));
        assert!(report.len() < 1_000_000);
    }

    #[test]
    fn quiet_leaves_the_errors() {
        let source = Source::new("a", "cube();");
        let at = SourceRange::new(0, 4);
        let both = [Diagnostic::warning("w", at, "just saying"), Diagnostic::error("e", at, "wrong")];
        let report = report(&source, &both, Show::Errors, WIDTH, Colors::None);
        assert!(report.contains("wrong") && !report.contains("just saying"));
    }
}
