//! Fonts: which one is meant, and what its glyphs look like.

use super::TextError;
use super::layout::UNITS_PER_EM;
use crate::curve::Pen;
use fontdb::{Database, FaceInfo, Style};
use octrace::Vec2;
use skrifa::outline::{DrawSettings, HintingInstance, HintingOptions, OutlinePen};
use skrifa::prelude::{LocationRef, Size};
use skrifa::{FontRef, GlyphId, MetadataProvider};
use std::sync::OnceLock;

/// What to do where OpenSCAD's usual font is missing.
pub(super) const LIBERATION_HELP: &str = "install the Liberation fonts (Debian: `apt install fonts-liberation`)";

const DEFAULT: &str = "Liberation Sans";

/// Families that stand for others, as fontconfig has it: the first that is there.
const STAND_INS: [(&str, &[&str]); 8] = [
    ("liberationsans", &["Arimo", "Arial", "Nimbus Sans", "Helvetica"]),
    ("arial", &["Liberation Sans", "Arimo"]),
    ("helvetica", &["Nimbus Sans", "Liberation Sans", "Arimo", "Arial"]),
    ("timesnewroman", &["Liberation Serif", "Tinos"]),
    ("times", &["Nimbus Roman", "Liberation Serif", "Times New Roman"]),
    ("couriernew", &["Liberation Mono", "Cousine"]),
    ("courier", &["Nimbus Mono PS", "Liberation Mono", "Courier New"]),
    ("bitstreamverasans", &["DejaVu Sans"]),
];

/// Families that stand for what is not known, by kind.
const SANS: &[&str] = &["DejaVu Sans", "Liberation Sans", "Arimo", "Arial", "Helvetica", "Noto Sans"];
const SERIF: &[&str] = &["DejaVu Serif", "Liberation Serif", "Tinos", "Times New Roman", "Noto Serif"];
const MONO: &[&str] = &["DejaVu Sans Mono", "Liberation Mono", "Cousine", "Courier New", "Noto Sans Mono"];

/// A font as a text names it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wanted {
    families: Vec<String>,
    /// 100 to 900; 400 is regular.
    weight: u16,
    slanted: bool,
    /// Condensed or narrow.
    narrow: bool,
}

impl Wanted {
    /// Reads a fontconfig name: families between commas, then properties between colons.
    pub fn parse(name: &str) -> Self {
        let mut parts = name.trim().split(':');
        let families = parts.next().unwrap_or_default();
        // After a hyphen there may be sizes.
        let families = match families.rsplit_once('-') {
            Some((families, size)) if size.trim().parse::<f64>().is_ok() => families,
            _ => families,
        };
        let mut families: Vec<String> =
            families.split(',').map(|f| f.trim().replace('\\', "")).filter(|f| !f.is_empty()).collect();
        if families.is_empty() {
            families.push(DEFAULT.to_string());
        }
        let mut wanted = Self { families, weight: 400, slanted: false, narrow: false };
        for property in parts {
            match property.split_once('=') {
                None => wanted.style(property),
                Some((key, value)) if ["style", "weight", "slant", "width"].contains(&key.trim()) => {
                    wanted.style(value)
                }
                Some(_) => {}
            }
        }
        wanted
    }

    /// Takes the words of a style for what they say; others say nothing.
    fn style(&mut self, words: &str) {
        let words = words.to_lowercase();
        let mut weight = 400;
        let mut lighter = 0;
        for word in words.split([' ', '-', '_']) {
            match word {
                "italic" | "oblique" | "kursiv" => self.slanted = true,
                "condensed" | "narrow" | "cond" => self.narrow = true,
                "extra" | "ultra" => lighter = 1,
                "semi" | "demi" => (lighter, weight) = (-1, 600),
                "thin" | "hairline" => weight = 100,
                "extralight" | "ultralight" => weight = 200,
                "light" => weight = 300 - 100 * lighter.max(0),
                "medium" => weight = 500,
                "semibold" | "demibold" => weight = 600,
                "bold" => weight = 700 + 100 * lighter,
                "extrabold" | "ultrabold" => weight = 800,
                "black" | "heavy" => weight = 900,
                _ => {}
            }
        }
        if weight != 400 {
            self.weight = weight as u16;
        }
    }

    /// The name, for people.
    pub fn asked(&self) -> String {
        let style = [(self.narrow, " Condensed"), (self.weight >= 600, " Bold"), (self.slanted, " Italic")];
        let style: String = style.iter().filter(|(is_so, _)| *is_so).map(|(_, word)| *word).collect();
        self.families[0].clone() + &style
    }

    /// How far a face is from the style; smaller is better.
    fn distance(&self, face: &FaceInfo) -> (bool, bool, u16) {
        let slanted = face.style != Style::Normal;
        let narrow = face.stretch.to_number() < 5;
        (narrow != self.narrow, slanted != self.slanted, face.weight.0.abs_diff(self.weight))
    }
}

/// The name of a family, however it is written.
fn plain(family: &str) -> String {
    family.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase).collect()
}

/// The face that fits best, and whether it is of a family that was asked for, or made to stand for it.
pub(super) fn best<'a>(database: &'a Database, wanted: &Wanted) -> Option<(&'a FaceInfo, bool)> {
    let of_family = |family: &str| {
        let family = plain(family);
        let members = database.faces().filter(|face| face.families.iter().any(|(name, _)| plain(name) == family));
        members.min_by_key(|face| (wanted.distance(face), face.post_script_name.clone(), face.index))
    };
    if let Some(face) = wanted.families.iter().find_map(|family| of_family(family)) {
        return Some((face, true));
    }
    let stand_ins = |family: &String| {
        let known = STAND_INS.iter().find(|(name, _)| *name == plain(family));
        known.and_then(|(_, others)| others.iter().find_map(|other| of_family(other)))
    };
    if let Some(face) = wanted.families.iter().find_map(stand_ins) {
        // What fontconfig takes for Liberation Sans is not the same to the digit.
        return Some((face, plain(&wanted.families[0]) != plain(DEFAULT)));
    }
    let first = plain(&wanted.families[0]);
    let (generic, is_asked) = match first.as_str() {
        "sans" | "sans-serif" | "sansserif" => (SANS, true),
        "serif" => (SERIF, true),
        "mono" | "monospace" => (MONO, true),
        _ => (SANS, false),
    };
    let by_kind = generic.iter().find_map(|family| of_family(family));
    let any = || {
        // Whatever calls itself sans, or else whatever there is.
        let key = |face: &&FaceInfo| {
            let family = face.families.first().map(|(name, _)| name.to_lowercase()).unwrap_or_default();
            (!family.contains("sans"), face.monospaced, wanted.distance(face), family, face.post_script_name.clone())
        };
        database.faces().min_by_key(key)
    };
    by_kind.map(|face| (face, is_asked)).or_else(|| any().map(|face| (face, false)))
}

/// Family and style of a face.
pub(super) fn name_of(face: &FaceInfo) -> String {
    let family = face.families.first().map_or(face.post_script_name.as_str(), |(name, _)| name);
    let style = [
        (face.stretch.to_number() < 5, " Condensed"),
        (face.weight.0 <= 300, " Light"),
        (face.weight.0 >= 600, " Bold"),
        (face.style != Style::Normal, " Italic"),
    ];
    family.to_string() + &style.iter().filter(|(is_so, _)| *is_so).map(|(_, word)| *word).collect::<String>()
}

/// A font file that is understood.
pub(super) struct Font {
    pub name: String,
    /// For shaping.
    pub shaped: harfrust::Font,
    bytes: Vec<u8>,
    index: u32,
    hints: OnceLock<Option<HintingInstance>>,
}

impl Font {
    pub fn new(bytes: Vec<u8>, index: u32, name: String) -> Option<Self> {
        FontRef::from_index(&bytes, index).ok()?;
        let shaped = harfrust::Font::new(bytes.clone(), index)?;
        Some(Self { name, shaped, bytes, index, hints: OnceLock::new() })
    }

    /// The glyphs' outlines.
    pub fn glyphs(&self) -> Result<Glyphs<'_>, TextError> {
        let bad = || TextError::BadFont { font: self.name.clone() };
        let font = FontRef::from_index(&self.bytes, self.index).map_err(|_| bad())?;
        let units = font.metrics(Size::unscaled(), LocationRef::default()).units_per_em;
        if units == 0 {
            return Err(bad());
        }
        // Many fonts are for whole numbers of pixels.
        let is_whole = !font.outline_glyphs().fractional_size_hinting();
        let size = Size::new(if is_whole { GRID.round() } else { GRID });
        // The instructions of a font that are wrong are not followed.
        let instance = || {
            HintingInstance::new(&font.outline_glyphs(), size, LocationRef::default(), HintingOptions::default()).ok()
        };
        let hints = self.hints.get_or_init(instance).as_ref().filter(|hints| hints.is_enabled());
        Ok(Glyphs { font, units: f64::from(units), size, hints })
    }
}

/// The pixels of an em where OpenSCAD has FreeType draw: 100 dots an inch, and 10^5 times 1/64 of a point.
const GRID: f32 = 138_889.0 / 64.0;

/// Outlines by glyph.
pub(super) struct Glyphs<'a> {
    pub font: FontRef<'a>,
    units: f64,
    /// What OpenSCAD has FreeType draw.
    size: Size,
    /// The font's instructions for that, if it has any for so large a size.
    hints: Option<&'a HintingInstance>,
}

impl Glyphs<'_> {
    /// The outline of a glyph in ems, as the font has it; without strokes where it has none.
    pub fn outline(&self, glyph: u32) -> GlyphOutline {
        self.draw(glyph, DrawSettings::unhinted(Size::unscaled(), LocationRef::default()), self.units)
    }

    /// The outline of a glyph as OpenSCAD has it: at 2170 pixels an em, as the font's instructions move it, in whole 64ths.
    pub fn fitted_outline(&self, glyph: u32) -> GlyphOutline {
        let settings = match self.hints {
            Some(hints) => DrawSettings::hinted(hints, false),
            None => DrawSettings::unhinted(self.size, LocationRef::default()),
        };
        self.draw(glyph, settings, UNITS_PER_EM / 64.0)
    }

    fn draw(&self, glyph: u32, settings: DrawSettings, units: f64) -> GlyphOutline {
        let mut recorder = Recorder { units, strokes: Vec::new() };
        if let Some(glyph) = self.font.outline_glyphs().get(GlyphId::new(glyph)) {
            // A glyph that cannot be drawn is drawn as far as it can be.
            let _ = glyph.draw(settings, &mut recorder);
        }
        GlyphOutline(recorder.strokes)
    }
}

#[derive(Clone, Copy, Debug)]
enum Stroke {
    Move(Vec2),
    Line(Vec2),
    Quad(Vec2, Vec2),
    Cubic(Vec2, Vec2, Vec2),
    Close,
}

/// The strokes of a glyph, in ems.
#[derive(Debug)]
pub(super) struct GlyphOutline(Vec<Stroke>);

impl GlyphOutline {
    /// Draws it where `place` puts its points.
    pub fn draw(&self, pen: &mut Pen, place: &dyn Fn(Vec2) -> Vec2) {
        for stroke in &self.0 {
            match *stroke {
                Stroke::Move(p) => pen.move_to(place(p)),
                Stroke::Line(p) => pen.line_to(place(p)),
                Stroke::Quad(c, p) => pen.quad_to(place(c), place(p)),
                Stroke::Cubic(c, d, p) => pen.cubic_to(place(c), place(d), place(p)),
                Stroke::Close => pen.close(),
            }
        }
    }

    /// The smallest box around all ends and control points: its lower left and upper right corner.
    pub fn control_box(&self) -> Option<(Vec2, Vec2)> {
        let points = self.0.iter().flat_map(|stroke| match *stroke {
            Stroke::Move(p) | Stroke::Line(p) => vec![p],
            Stroke::Quad(c, p) => vec![c, p],
            Stroke::Cubic(c, d, p) => vec![c, d, p],
            Stroke::Close => Vec::new(),
        });
        points.fold(None, |corners, p| {
            let (low, high) = corners.unwrap_or((p, p));
            Some((Vec2::new(low.x.min(p.x), low.y.min(p.y)), Vec2::new(high.x.max(p.x), high.y.max(p.y))))
        })
    }
}

/// Takes what the font draws, in units of which an em has so many, to ems.
struct Recorder {
    units: f64,
    strokes: Vec<Stroke>,
}

impl Recorder {
    fn point(&self, x: f32, y: f32) -> Vec2 {
        Vec2::new(f64::from(x) / self.units, f64::from(y) / self.units)
    }
}

impl OutlinePen for Recorder {
    fn move_to(&mut self, x: f32, y: f32) {
        self.strokes.push(Stroke::Move(self.point(x, y)));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.strokes.push(Stroke::Line(self.point(x, y)));
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.strokes.push(Stroke::Quad(self.point(cx, cy), self.point(x, y)));
    }

    fn curve_to(&mut self, cx: f32, cy: f32, dx: f32, dy: f32, x: f32, y: f32) {
        self.strokes.push(Stroke::Cubic(self.point(cx, cy), self.point(dx, dy), self.point(x, y)));
    }

    fn close(&mut self) {
        self.strokes.push(Stroke::Close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_fontconfig_reads_them() {
        let check = |name: &str, families: &[&str], weight, slanted, narrow| {
            let families = families.iter().map(ToString::to_string).collect();
            assert_eq!(Wanted::parse(name), Wanted { families, weight, slanted, narrow }, "{name}");
        };
        check("", &["Liberation Sans"], 400, false, false);
        check("Liberation Serif:style=Bold Italic", &["Liberation Serif"], 700, true, false);
        check("DejaVu Sans, Arial-12:bold:oblique", &["DejaVu Sans", "Arial"], 700, true, false);
        check("Semi\\-Serif:style=Condensed Extra Bold", &["Semi-Serif"], 800, false, true);
        check("X:style=Semi Bold:lang=de", &["X"], 600, false, false);
        check("X:style=ExtraLight:weight=", &["X"], 200, false, false);
        check("X:style=Extra Light", &["X"], 200, false, false);
    }
}
