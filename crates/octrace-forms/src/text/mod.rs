//! Text as outlines, placed as OpenSCAD 2021.01 places it.
//!
//! In come a text and where fonts are; out come the outlines of its glyphs, to be filled where the winding number is not
//! zero. HarfBuzz's rules say which glyphs follow each other where. Curves become arcs, or chords as many as OpenSCAD's.

mod font;
mod layout;
mod source;

pub use source::FontSource;

use crate::Tolerance;
use crate::curve::{Paths, Pen, Strokes};
use octrace::Vec2;

/// A text and how it is set, in OpenSCAD's words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextSpec<'a> {
    /// What it says.
    pub text: &'a str,
    /// About the height of its capitals.
    pub size: f64,
    /// What advances are multiplied by.
    pub spacing: f64,
    /// Family and style, for example `Liberation Sans:style=Bold Italic`; empty for Liberation Sans.
    pub font: &'a str,
    /// `left`, `center` or `right`.
    pub halign: &'a str,
    /// `top`, `center`, `baseline` or `bottom`.
    pub valign: &'a str,
    /// `ltr`, `rtl`, `ttb` or `btt`; empty to go by the script.
    pub direction: &'a str,
    /// The language's tag, for example `en`.
    pub language: &'a str,
    /// The script's tag, for example `Latn`; empty to go by the text.
    pub script: &'a str,
    /// How many chords OpenSCAD would give a circle with the text's size as its radius; `None` for arcs.
    pub facets: Option<u32>,
    /// How far arcs may be off, as a share of the size.
    pub tolerance: Tolerance,
}

impl Default for TextSpec<'_> {
    fn default() -> Self {
        Self {
            text: "",
            size: 10.0,
            spacing: 1.0,
            font: "",
            halign: "left",
            valign: "baseline",
            direction: "ltr",
            language: "en",
            script: "",
            facets: None,
            tolerance: Tolerance::default(),
        }
    }
}

/// The outlines of a text.
#[derive(Clone, Debug, PartialEq)]
pub struct TextOutline {
    /// Closed curves: inside is where the winding number is not zero. Glyphs may overlap.
    pub paths: Paths,
    /// The font that was used: family and style.
    pub font: String,
    /// What may not be as it was meant.
    pub warnings: Vec<TextWarning>,
}

/// What may not be as it was meant.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextWarning {
    /// Another font was taken.
    #[error("there is no font `{asked}`; `{used}` is used instead")]
    OtherFont {
        /// The font that the text names.
        asked: String,
        /// The one that was taken.
        used: String,
    },
    /// The font has no glyphs for these; it has a box for all of them.
    #[error("the font `{font}` has no glyphs for `{characters}`")]
    NoGlyphs {
        /// The font.
        font: String,
        /// The characters, each once.
        characters: String,
    },
    /// An alignment that is none: the usual one is used.
    #[error("`{value}` is no {argument}")]
    Unknown {
        /// Which argument.
        argument: &'static str,
        /// What it is.
        value: String,
    },
}

impl TextWarning {
    /// What the user can do.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            Self::OtherFont { asked, .. } if asked.starts_with("Liberation") => Some(font::LIBERATION_HELP),
            Self::OtherFont { .. } => Some("install the font, or name one that is installed"),
            Self::NoGlyphs { .. } => Some("name a font that has these characters"),
            Self::Unknown { argument: "halign", .. } => Some("`left`, `center` or `right`"),
            Self::Unknown { .. } => Some("`top`, `center`, `baseline` or `bottom`"),
        }
    }
}

/// Why there is no text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TextError {
    /// There is no font at all that could be used.
    #[error("there is no font `{asked}`, and no other that could stand for it")]
    NoFont {
        /// The font that the text names.
        asked: String,
    },
    /// A font file is damaged, or of a kind that is not understood.
    #[error("the font `{font}` cannot be read")]
    BadFont {
        /// The font.
        font: String,
    },
}

impl TextError {
    /// What the user can do.
    pub fn help(&self) -> Option<&'static str> {
        match self {
            Self::NoFont { .. } => Some(font::LIBERATION_HELP),
            Self::BadFont { .. } => Some("install the font again, or name another one"),
        }
    }
}

/// The outlines of a text. A size or spacing that is not finite gives no outlines.
///
/// # Errors
/// If there is no font to take: see [`TextError`].
pub fn outline(spec: &TextSpec, fonts: &FontSource) -> Result<TextOutline, TextError> {
    let chosen = fonts.choose(spec.font)?;
    let mut warnings: Vec<TextWarning> = chosen.warning.into_iter().collect();
    let line = layout::lay_out(spec, &chosen.font, &mut warnings)?;
    let mut paths = Vec::new();
    if spec.size.is_finite() && spec.spacing.is_finite() {
        let strokes = match spec.facets {
            None => Strokes::Arcs { tolerance: spec.tolerance.relative * spec.size.abs() },
            // Glyphs' curves are short: an eighth of a circle's chords each, and one, but never one alone.
            Some(facets) => Strokes::Chords((facets / 8 + 1).max(2)),
        };
        for glyph in &line {
            let mut pen = Pen::new(strokes);
            glyph.outline.draw(&mut pen, &|p| (p * layout::EM + glyph.at) * spec.size);
            paths.append(&mut pen.finish());
        }
        paths.retain(|contour| contour.iter().all(|edge| finite(edge.from)));
    }
    Ok(TextOutline { paths, font: chosen.font.name.clone(), warnings })
}

fn finite(p: Vec2) -> bool {
    p.x.is_finite() && p.y.is_finite()
}

#[cfg(test)]
mod tests;
