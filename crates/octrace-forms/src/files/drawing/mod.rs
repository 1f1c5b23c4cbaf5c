//! Drawings from files: DXF and SVG.
//!
//! In come bytes, out come closed curves in millimetres, y up, where OpenSCAD 2021.01 puts them. Arcs stay arcs.

mod dxf;
mod join;
mod spline;
mod stroke;
mod svg;
mod svg_page;
mod svg_path;

use crate::Tolerance;
use crate::curve::Paths;
use octrace::{Curve, Edge, Vec2};

/// Shapes of a drawing, which together cover the union of all. Each is what an odd number of its curves surround; these
/// may cross.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The shapes.
    pub shapes: Vec<Paths>,
    /// What was passed over, or is not as it may be meant.
    pub warnings: Vec<DrawingWarning>,
}

/// A file format for drawings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawingFormat {
    /// AutoCAD's exchange format, as text.
    Dxf,
    /// Scalable vector graphics.
    Svg,
}

impl DrawingFormat {
    /// The format that a file name says by its ending, in capitals or not.
    pub fn of_name(name: &str) -> Option<Self> {
        let (_, ending) = name.rsplit_once('.')?;
        Some(match ending.to_ascii_lowercase().as_str() {
            "dxf" => Self::Dxf,
            "svg" => Self::Svg,
            _ => return None,
        })
    }
}

/// How a drawing is read.
#[derive(Clone, Copy)]
pub struct DrawingOptions<'a> {
    /// Only what is on that layer (DXF), or below an element with that label or identifier (SVG).
    pub layer: Option<&'a str>,
    /// Which point of the drawing becomes the origin (DXF).
    pub origin: Vec2,
    /// By what all is multiplied (DXF).
    pub scale: f64,
    /// How many units without a name are an inch (SVG).
    pub dpi: f64,
    /// Whether the middle of the drawing becomes the origin (SVG).
    pub place: Place,
    /// How many chords OpenSCAD would make of a circle with that radius (DXF); in SVG files it makes 40 of each circle
    /// and 20 of each Bézier curve. `None` for arcs.
    pub fragments: Option<&'a dyn Fn(f64) -> u32>,
    /// How far arcs may be from Bézier curves and ellipses, as a share of the size of the shape.
    pub tolerance: Tolerance,
}

/// Where a drawing goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Place {
    /// The lower left corner of the page is at the origin.
    #[default]
    Page,
    /// The middle of the box around all shapes is at the origin.
    Centered,
}

impl Default for DrawingOptions<'_> {
    fn default() -> Self {
        Self {
            layer: None,
            origin: Vec2::ZERO,
            scale: 1.0,
            dpi: 72.0,
            place: Place::default(),
            fragments: None,
            tolerance: Tolerance::default(),
        }
    }
}

impl std::fmt::Debug for DrawingOptions<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("DrawingOptions")
            .field("layer", &self.layer)
            .field("origin", &self.origin)
            .field("scale", &self.scale)
            .field("dpi", &self.dpi)
            .field("place", &self.place)
            .field("chords", &self.fragments.is_some())
            .finish_non_exhaustive()
    }
}

/// What was passed over, or is not as it may be meant.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DrawingWarning {
    /// Elements of a kind that is not read.
    #[error("{count} elements of the kind {kind} were passed over")]
    PassedOver {
        /// The kind.
        kind: String,
        /// How many.
        count: usize,
    },
    /// Lines that come to an end were closed.
    #[error("{count} curves are open; their ends were joined by a line")]
    Open {
        /// How many.
        count: usize,
    },
    /// There is no such layer.
    #[error("nothing is on the layer `{0}`")]
    NoLayer(String),
}

/// Why bytes are not a drawing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DrawingError {
    /// A line of text is not what the format has there.
    #[error("line {line}: {problem}")]
    Line {
        /// Line of the file, from 1.
        line: u32,
        /// What is wrong.
        problem: String,
    },
    /// XML that is not well formed.
    #[error("the drawing is not well-formed XML")]
    Xml(#[from] roxmltree::Error),
    /// Products of its numbers are larger than numbers get.
    #[error("the drawing reaches to where there are no numbers any more")]
    OutOfRange,
    /// More than can be worked with, by copies of copies.
    #[error("the drawing has more than {0} lines and arcs")]
    TooLarge(usize),
}

/// Drawings that make more lines and arcs than these, by repeating parts of themselves, are refused.
const MOST_PIECES: usize = 1 << 22;

/// Reads a drawing.
///
/// # Errors
/// If the bytes are not of that format: see [`DrawingError`].
pub fn read(format: DrawingFormat, bytes: &[u8], options: &DrawingOptions) -> Result<Drawing, DrawingError> {
    let drawing = match format {
        DrawingFormat::Dxf => dxf::read(bytes, options),
        DrawingFormat::Svg => svg::read(bytes, options),
    }?;
    match drawing.shapes.iter().flatten().flatten().all(is_finite) {
        true => Ok(drawing),
        false => Err(DrawingError::OutOfRange),
    }
}

fn is_finite(edge: &Edge) -> bool {
    let at = |p: Vec2| p.x.is_finite() && p.y.is_finite();
    at(edge.from)
        && match edge.curve {
            Curve::Line => true,
            Curve::Arc { center, radius, .. } => at(center) && radius.is_finite(),
        }
}

#[cfg(test)]
mod tests;
