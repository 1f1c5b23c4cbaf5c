//! A sheet to draw on: the few shapes that figures are made of, in one style. Numbers have two decimals, so that the same
//! figure is the same file.

use svg::Document;
use svg::node::element::{Circle, Element, Line, Path, Rectangle};
use svg::node::{Node, Text as Words};

/// The colours of all figures, and what they stand for.
pub mod palette {
    /// Behind everything: figures are opaque, so that they can be read on dark pages too.
    pub const PAPER: &str = "#ffffff";
    /// Words and important lines.
    pub const INK: &str = "#1f2933";
    /// Notes.
    pub const MUTED: &str = "#5f6b7a";
    /// Lines that only help.
    pub const FAINT: &str = "#c3cad3";
    /// What stands behind words.
    pub const PANEL: &str = "#f4f6f8";
    /// The solid.
    pub const SOLID: &str = "#3f74b5";
    /// What is all inside the solid.
    pub const INSIDE: &str = "#bcd3ec";
    /// What is partly inside.
    pub const LEAF: &str = "#fdf1d3";
    /// Union; moves across the top.
    pub const GREEN: &str = "#2b8a63";
    /// Intersection; refraction.
    pub const PURPLE: &str = "#7b4fb0";
    /// Difference; the ray.
    pub const RED: &str = "#c43f35";
    /// Light.
    pub const AMBER: &str = "#d18a12";
}

/// Where a text is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// At its beginning.
    Start,
    /// In its middle.
    Middle,
    /// At its end.
    End,
}

/// How a shape is filled and outlined.
#[derive(Clone, Copy, Debug)]
pub struct Ink<'a> {
    /// The colour inside, or `none`.
    pub fill: &'a str,
    /// The colour of the outline, or `none`.
    pub stroke: &'a str,
    /// The outline's width.
    pub width: f64,
    /// Lengths of dashes and gaps; empty for a solid line.
    pub dashes: &'a str,
    /// From 0, nothing to be seen, to 1.
    pub opacity: f64,
}

impl<'a> Ink<'a> {
    /// An outline.
    pub const fn line(stroke: &'a str, width: f64) -> Self {
        Self { fill: "none", stroke, width, dashes: "", opacity: 1.0 }
    }

    /// An area without an outline.
    pub const fn area(fill: &'a str) -> Self {
        Self { fill, stroke: "none", width: 0.0, dashes: "", opacity: 1.0 }
    }

    /// An area with an outline.
    pub const fn both(fill: &'a str, stroke: &'a str, width: f64) -> Self {
        Self { fill, stroke, width, dashes: "", opacity: 1.0 }
    }

    fn on(self, element: &mut Element) {
        element.assign("fill", self.fill);
        if self.stroke != "none" {
            element.assign("stroke", self.stroke);
            element.assign("stroke-width", number(self.width));
        }
        if !self.dashes.is_empty() {
            element.assign("stroke-dasharray", self.dashes);
        }
        if self.opacity != 1.0 {
            element.assign("opacity", number(self.opacity));
        }
    }
}

/// A text with its looks.
#[derive(Clone, Copy, Debug)]
pub struct Label<'a> {
    /// What it says.
    pub text: &'a str,
    /// Its height in pixels.
    pub size: f64,
    /// Its colour.
    pub color: &'a str,
    /// Where it is held.
    pub anchor: Anchor,
    /// Whether it is bold.
    pub bold: bool,
}

impl<'a> Label<'a> {
    /// A text of ordinary looks, held in its middle.
    pub const fn new(text: &'a str, size: f64) -> Self {
        Self { text, size, color: palette::INK, anchor: Anchor::Middle, bold: false }
    }

    /// The same, held elsewhere.
    pub const fn held(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// The same in another colour.
    pub const fn colored(self, color: &'a str) -> Self {
        Self { color, ..self }
    }

    /// The same in bold.
    pub const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }
}

/// A figure in the making.
#[derive(Debug)]
pub struct Sheet {
    document: Document,
}

/// All figures are as wide as this.
pub const WIDTH: f64 = 960.0;
/// Left and right stay empty.
pub const MARGIN: f64 = 24.0;
/// Where what a figure shows begins, below its title.
pub const TOP: f64 = 78.0;

impl Sheet {
    /// A sheet with a title and a line that explains it.
    pub fn new(height: f64, title: &str, note: &str) -> Self {
        let document = Document::new()
            .set("viewBox", format!("0 0 {} {}", number(WIDTH), number(height)))
            .set("width", number(WIDTH))
            .set("height", number(height))
            .set("role", "img")
            .set("font-family", "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif");
        let mut sheet = Self { document };
        let mut spoken = Element::new("title");
        spoken.append(Words::new(title));
        sheet.document.append(spoken);
        sheet.rect((0.0, 0.0), (WIDTH, height), 0.0, Ink::area(palette::PAPER));
        sheet.label((MARGIN, 32.0), Label::new(title, 18.0).held(Anchor::Start).bold());
        sheet.label((MARGIN, 53.0), Label::new(note, 13.0).held(Anchor::Start).colored(palette::MUTED));
        sheet
    }

    /// The file.
    pub fn finish(self) -> String {
        format!("{}\n", self.document)
    }

    /// A rectangle, its corners rounded.
    pub fn rect(&mut self, (x, y): (f64, f64), (width, height): (f64, f64), radius: f64, ink: Ink) {
        let mut rect = Rectangle::new()
            .set("x", number(x))
            .set("y", number(y))
            .set("width", number(width))
            .set("height", number(height));
        if radius > 0.0 {
            rect = rect.set("rx", number(radius));
        }
        self.add(rect, ink);
    }

    /// A straight line.
    pub fn line(&mut self, a: (f64, f64), b: (f64, f64), ink: Ink) {
        let line =
            Line::new().set("x1", number(a.0)).set("y1", number(a.1)).set("x2", number(b.0)).set("y2", number(b.1));
        self.add(line, ink);
    }

    /// A circle.
    pub fn circle(&mut self, (x, y): (f64, f64), radius: f64, ink: Ink) {
        self.add(Circle::new().set("cx", number(x)).set("cy", number(y)).set("r", number(radius)), ink);
    }

    /// A path in SVG's own words.
    pub fn path(&mut self, data: &str, ink: Ink) {
        self.add(Path::new().set("d", data), ink);
    }

    /// A line with an arrow head at its end.
    pub fn arrow(&mut self, a: (f64, f64), b: (f64, f64), color: &str, width: f64) {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let length = (dx * dx + dy * dy).sqrt().max(1e-9);
        let (ux, uy) = (dx / length, dy / length);
        let size = 3.0 + 2.0 * width;
        let back = (b.0 - ux * size, b.1 - uy * size);
        self.line(a, back, Ink::line(color, width));
        let wing = |side: f64| (back.0 - uy * side * size * 0.45, back.1 + ux * side * size * 0.45);
        let data = format!("M{} L{} L{} Z", point(b), point(wing(1.0)), point(wing(-1.0)));
        self.path(&data, Ink::area(color));
    }

    /// A text; `at` is on its base line.
    pub fn label(&mut self, at: (f64, f64), label: Label) {
        let mut text = svg::node::element::Text::new(label.text)
            .set("x", number(at.0))
            .set("y", number(at.1))
            .set("font-size", number(label.size))
            .set("fill", label.color);
        if label.anchor != Anchor::Start {
            text = text.set("text-anchor", if label.anchor == Anchor::Middle { "middle" } else { "end" });
        }
        if label.bold {
            text = text.set("font-weight", "bold");
        }
        self.document.append(text);
    }

    fn add(&mut self, element: impl Into<Element>, ink: Ink) {
        let mut element = element.into();
        ink.on(&mut element);
        self.document.append(element);
    }
}

/// A number with two decimals at most.
pub fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// A number of the scene, for people: about four digits of it.
pub fn value(value: f64) -> String {
    match value.abs() {
        size if size != 0.0 && !(0.01..1e6).contains(&size) => format!("{value:.3e}"),
        _ => {
            let text = format!("{value:.3}");
            text.trim_end_matches('0').trim_end_matches('.').into()
        }
    }
}

/// A point in a path.
pub fn point((x, y): (f64, f64)) -> String {
    format!("{} {}", number(x), number(y))
}

/// How wide a text of this size is at most, in the fonts that are likely.
pub fn text_width(text: &str, size: f64) -> f64 {
    let widths = text.chars().map(|c| match c {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | 'I' => 0.30,
        'f' | 't' | 'r' | ' ' | '(' | ')' | '[' | ']' | '-' | '/' => 0.38,
        'm' | 'w' | 'M' | 'W' | '%' | '…' => 0.95,
        'A'..='Z' => 0.72,
        _ => 0.61,
    });
    widths.sum::<f64>() * size
}

/// The text, cut so that it is at most this wide.
pub fn cut_to(text: &str, size: f64, width: f64) -> String {
    if text_width(text, size) <= width {
        return text.to_owned();
    }
    let mut kept = String::new();
    for c in text.chars() {
        kept.push(c);
        if text_width(&kept, size) + text_width("…", size) > width {
            kept.pop();
            break;
        }
    }
    kept.trim_end().to_owned() + "…"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        let texts = [1.0, -0.001, 2.5, 0.126, 100.0].map(number);
        assert_eq!(texts, ["1", "0", "2.5", "0.13", "100"]);
        let values = [0.0, -0.75, 12.0, 123.4567, 1.5e-20, -2e26].map(value);
        assert_eq!(values, ["0", "-0.75", "12", "123.457", "1.500e-20", "-2.000e26"]);
    }

    #[test]
    fn long_texts_are_cut_and_words_cannot_break_the_file() {
        assert_eq!(cut_to("short", 10.0, 100.0), "short");
        let cut = cut_to("much longer than that", 10.0, 50.0);
        assert!(cut.ends_with('…') && text_width(&cut, 10.0) <= 50.0, "{cut}");
        assert!(Sheet::new(10.0, "a < b & \"c\"", "").finish().contains("a &lt; b &amp; \"c\""));
    }
}
