//! Where glyphs go.
//!
//! OpenSCAD asks for a font so large that an em has 10^5 * 100/72 units of 1/64, and divides outlines by 10^5. What
//! shaping says, and the heights that alignment goes by, it divides by 64 * 16 * 100 instead. So letters stand closer by a
//! factor of 1000/1024 than the font has it. Heights go up to whole pixels of 64 units.

use super::font::{Font, GlyphOutline, Glyphs};
use super::{TextError, TextSpec, TextWarning};
use harfrust::{Buffer, Direction, FontFuncs, Language, Script, ShapeOptions, ShaperFont};
use octrace::Vec2;
use skrifa::MetadataProvider;
use skrifa::prelude::{LocationRef, Size};
use skrifa::raw::TableProvider;
use std::cell::OnceCell;

/// Ems in a text of size 1: 100 dots an inch, 72 points an inch.
pub(super) const EM: f64 = 100.0 / 72.0;

/// 64ths of pixels in an em.
pub(super) const UNITS_PER_EM: f64 = EM * 1e5;

/// What OpenSCAD divides advances by, as a share of what it should.
const SHRINK: f64 = 1000.0 / 1024.0;

/// A glyph for a text of size 1.
pub(super) struct PlacedGlyph {
    pub outline: GlyphOutline,
    /// Where its origin goes.
    pub at: Vec2,
}

/// What shaping says about a glyph, in texts of size 1 and after OpenSCAD's division.
struct Shaped {
    glyph: u32,
    advance: Vec2,
    offset: Vec2,
}

/// The glyphs of a text of size 1 where it is aligned as the spec says.
pub(super) fn lay_out(
    spec: &TextSpec,
    font: &Font,
    warnings: &mut Vec<TextWarning>,
) -> Result<Vec<PlacedGlyph>, TextError> {
    let glyphs = font.glyphs()?;
    let (shaped, is_vertical) = shape(spec, font, &glyphs, warnings)?;
    let fitted: Vec<GlyphOutline> = shaped.iter().map(|s| glyphs.fitted_outline(s.glyph)).collect();
    let (mut width, mut ascent, mut descent) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (shaped, outline) in shaped.iter().zip(&fitted) {
        let (low, high) = outline.control_box().unwrap_or_default();
        if is_vertical {
            width = width.max(pixels_up(high.x) - pixels_down(low.x));
            ascent += shaped.advance.y * spec.spacing;
        } else {
            width += shaped.advance.x * spec.spacing;
            ascent = ascent.max(pixels_up(high.y));
            descent = descent.max(-pixels_down(low.y));
        }
    }
    let mut unknown =
        |argument, value: &str| warnings.push(TextWarning::Unknown { argument, value: value.to_string() });
    let x = match spec.halign {
        "left" | "" => 0.0,
        "center" => -width / 2.0,
        "right" => -width,
        other => {
            unknown("halign", other);
            0.0
        }
    };
    let y = match spec.valign {
        "baseline" | "" => 0.0,
        "top" => -ascent,
        "center" => (descent - ascent) / 2.0,
        "bottom" => descent,
        other => {
            unknown("valign", other);
            0.0
        }
    };
    let outlines = match spec.facets {
        Some(_) => fitted,
        None => shaped.iter().map(|s| glyphs.outline(s.glyph)).collect(),
    };
    let mut at = Vec2::new(x, y);
    let placed = shaped.iter().zip(outlines).map(|(shaped, outline)| {
        let place = at + shaped.offset;
        at = at + shaped.advance * spec.spacing;
        PlacedGlyph { outline, at: place }
    });
    Ok(placed.collect())
}

/// A coordinate in ems, up to the next whole pixel, in OpenSCAD's measure.
fn pixels_up(ems: f64) -> f64 {
    ((ems * UNITS_PER_EM).round() / 64.0).ceil() * 64.0 / 102_400.0
}

fn pixels_down(ems: f64) -> f64 {
    -pixels_up(-ems)
}

/// The glyphs in the order in which they are drawn, and whether they go up or down.
fn shape(
    spec: &TextSpec,
    font: &Font,
    glyphs: &Glyphs,
    warnings: &mut Vec<TextWarning>,
) -> Result<(Vec<Shaped>, bool), TextError> {
    let bad = || TextError::BadFont { font: font.name.clone() };
    let mut buffer = Buffer::new();
    buffer.push_str(spec.text);
    if let Ok(direction) = spec.direction.parse::<Direction>() {
        buffer.set_direction(direction);
    }
    if !spec.script.is_empty() {
        buffer.set_script(spec.script.parse::<Script>().ok());
    }
    buffer.set_language(Language::new(spec.language));
    buffer.guess_segment_properties();
    let is_vertical = matches!(buffer.direction(), Direction::TopToBottom | Direction::BottomToTop);
    let vertical = Vertical { glyphs, advance: OnceCell::new() };
    let shaper = ShaperFont::new(&font.shaped);
    let shaper = if is_vertical && !vertical.is_known() { shaper.with_font_funcs(Some(&vertical)) } else { shaper };
    harfrust::shape(&shaper, &mut buffer, ShapeOptions::new()).map_err(|_| bad())?;

    let units = UNITS_PER_EM / f64::from(font.shaped.units_per_em().max(1));
    let scaled = |x: i32| (f64::from(x) * units).round() / 1e5 * SHRINK;
    let vector = |x: i32, y: i32| Vec2::new(scaled(x), scaled(y));
    let mut missing = String::new();
    let mut shaped = Vec::with_capacity(buffer.len());
    for (info, position) in buffer.glyph_infos().iter().zip(buffer.glyph_positions()) {
        let character = spec.text.get(info.cluster as usize..).and_then(|rest| rest.chars().next());
        if let Some(character) = character.filter(|&c| info.glyph_id == 0 && !missing.contains(c)) {
            missing.push(character);
        }
        shaped.push(Shaped {
            glyph: info.glyph_id,
            advance: vector(position.x_advance, position.y_advance),
            offset: vector(position.x_offset, position.y_offset),
        });
    }
    if !missing.is_empty() {
        warnings.push(TextWarning::NoGlyphs { font: font.name.clone(), characters: missing });
    }
    Ok((shaped, is_vertical))
}

/// How FreeType has glyphs stand above each other in fonts that do not say: as far apart as the typographic ascender is
/// from the descender, each in the middle of that.
struct Vertical<'a> {
    glyphs: &'a Glyphs<'a>,
    advance: OnceCell<i32>,
}

impl Vertical<'_> {
    /// Whether the font says itself.
    fn is_known(&self) -> bool {
        self.glyphs.font.vmtx().is_ok()
    }

    fn advance(&self) -> i32 {
        *self.advance.get_or_init(|| match self.glyphs.font.os2() {
            Ok(os2) => i32::from(os2.s_typo_ascender()) - i32::from(os2.s_typo_descender()),
            Err(_) => {
                let metrics = self.glyphs.font.metrics(Size::unscaled(), LocationRef::default());
                (metrics.ascent - metrics.descent) as i32
            }
        })
    }
}

impl FontFuncs for Vertical<'_> {
    fn glyph_v_advance(&self, _font: &ShaperFont, _glyph: harfrust::GlyphId) -> i32 {
        -self.advance()
    }

    fn glyph_v_origin(&self, font: &ShaperFont, glyph: harfrust::GlyphId) -> (i32, i32) {
        let (top, height) = font.glyph_extents(glyph).map_or((0, 0), |e| (e.y_bearing, e.height.saturating_abs()));
        let above = self.advance().saturating_sub(height) / 2;
        (font.glyph_h_advance(glyph) / 2, top.saturating_add(above))
    }
}
