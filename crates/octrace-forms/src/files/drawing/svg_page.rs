//! From the units of an SVG file to millimetres, as OpenSCAD 2021.01 goes.

use super::{DrawingOptions, Place};
use octrace::Vec2;
use octrace::geom::sin_cos_deg;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, TransformListParser, TransformListToken, ViewBox};

const MM_PER_INCH: f64 = 25.4;

/// An affine map of the plane: where the unit vectors and the origin go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Map {
    pub x: Vec2,
    pub y: Vec2,
    pub origin: Vec2,
}

impl Map {
    pub fn new(x: Vec2, y: Vec2, origin: Vec2) -> Self {
        Self { x, y, origin }
    }

    pub fn translate(to: Vec2) -> Self {
        Self::new(Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0), to)
    }

    pub fn vector(&self, v: Vec2) -> Vec2 {
        self.x * v.x + self.y * v.y
    }

    pub fn point(&self, p: Vec2) -> Vec2 {
        self.vector(p) + self.origin
    }

    /// `inner` first, then this one.
    pub fn after(&self, inner: &Self) -> Self {
        Self::new(self.vector(inner.x), self.vector(inner.y), self.point(inner.origin))
    }

    /// What a `transform` attribute says; what cannot be read of it, and the rest, says nothing.
    pub fn of_transform(text: &str) -> Self {
        let (one, zero) = (1.0, 0.0);
        let mut map = Self::translate(Vec2::ZERO);
        for token in TransformListParser::from(text).map_while(Result::ok) {
            let [a, b, c, d, e, f] = match token {
                TransformListToken::Matrix { a, b, c, d, e, f } => [a, b, c, d, e, f],
                TransformListToken::Translate { tx, ty } => [one, zero, zero, one, tx, ty],
                TransformListToken::Scale { sx, sy } => [sx, zero, zero, sy, zero, zero],
                TransformListToken::Rotate { angle } => {
                    let (sin, cos) = sin_cos_deg(angle);
                    [cos, sin, -sin, cos, zero, zero]
                }
                TransformListToken::SkewX { angle } => {
                    let (sin, cos) = sin_cos_deg(angle);
                    [one, zero, sin / cos, one, zero, zero]
                }
                TransformListToken::SkewY { angle } => {
                    let (sin, cos) = sin_cos_deg(angle);
                    [one, sin / cos, zero, one, zero, zero]
                }
            };
            map = map.after(&Self::new(Vec2::new(a, b), Vec2::new(c, d), Vec2::new(e, f)));
        }
        map
    }
}

/// The page of a drawing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Page {
    /// Millimetres per unit.
    pub scale: Vec2,
    /// Where the file's origin would be: in millimetres, y up.
    offset: Vec2,
    /// The corner of the view box, in millimetres.
    corner: Vec2,
}

impl Page {
    /// From the attributes of the `svg` element.
    pub fn of(root: roxmltree::Node, options: &DrawingOptions) -> Self {
        let view = root.attribute("viewBox").and_then(|text| text.parse::<ViewBox>().ok());
        let side = |name: &str, view: Option<f64>| {
            let Some(length) = root.attribute(name).and_then(|text| text.trim().parse::<Length>().ok()) else {
                return view.map_or(0.0, |units| MM_PER_INCH * units / options.dpi);
            };
            match length.unit {
                LengthUnit::None => MM_PER_INCH * length.number / options.dpi,
                LengthUnit::Px => MM_PER_INCH * length.number / 96.0,
                LengthUnit::Pt => MM_PER_INCH * length.number / 72.0,
                LengthUnit::Pc => MM_PER_INCH * length.number / 6.0,
                LengthUnit::In => MM_PER_INCH * length.number,
                LengthUnit::Cm => 10.0 * length.number,
                LengthUnit::Mm => length.number,
                LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => view.unwrap_or(0.0),
            }
        };
        let (width, height) = (side("width", view.map(|v| v.w)), side("height", view.map(|v| v.h)));
        let Some(view) = view else {
            // Without a view box a unit is a millimetre.
            return Self { scale: Vec2::new(1.0, 1.0), offset: Vec2::new(0.0, height), corner: Vec2::ZERO };
        };
        let mut scale = Vec2::new(width / view.w, height / view.h);
        let aspect = root.attribute("preserveAspectRatio").and_then(|text| text.parse::<AspectRatio>().ok());
        let (align, slice) = aspect.map_or((Align::XMidYMid, false), |aspect| (aspect.align, aspect.slice));
        let mut room = Vec2::ZERO;
        if align != Align::None {
            let both = if slice { scale.x.max(scale.y) } else { scale.x.min(scale.y) };
            scale = Vec2::new(both, both);
            let share = share_of(align);
            room = Vec2::new((width - both * view.w) * share.x, (height - both * view.h) * share.y);
        }
        // OpenSCAD takes the upper edge of the view box the wrong way; so it is here.
        let corner = Vec2::new(scale.x * view.x, scale.y * view.y);
        Self { scale, offset: Vec2::new(room.x, height - room.y), corner }
    }

    /// What to add to shapes of that extent that were scaled about the file's origin.
    pub fn shift(&self, extent: (Vec2, Vec2), place: Place) -> Vec2 {
        match place {
            Place::Page => self.offset - self.corner,
            Place::Centered => -(extent.0 + extent.1) * 0.5 - self.corner,
        }
    }
}

/// Which share of the room that is left goes before the drawing.
fn share_of(align: Align) -> Vec2 {
    let x = match align {
        Align::XMidYMin | Align::XMidYMid | Align::XMidYMax => 0.5,
        Align::XMaxYMin | Align::XMaxYMid | Align::XMaxYMax => 1.0,
        _ => 0.0,
    };
    let y = match align {
        Align::XMinYMid | Align::XMidYMid | Align::XMaxYMid => 0.5,
        Align::XMinYMax | Align::XMidYMax | Align::XMaxYMax => 1.0,
        _ => 0.0,
    };
    Vec2::new(x, y)
}
