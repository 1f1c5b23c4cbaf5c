//! Colours and materials: which part of the scene a leaf belongs to.
//!
//! A leaf is made of the innermost `material` around it, else of plastic. Its colour is that of the outermost `color`
//! around it, as in OpenSCAD, else that of its material.

use super::args::Args;
use super::language::nearest;
use super::report::Report;
use crate::SourceRange;
use crate::diagnostic::Diagnostic;
use crate::syntax::View;
use octrace::{Material, Part, PartId, Rgb};
use std::collections::HashMap;

/// What the nodes around a place ask for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Look {
    color: Option<Color>,
    material: Option<Material>,
}

/// A colour as in OpenSCAD.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Color {
    /// Absent for OpenSCAD's [-1, -1, -1], its way to write `color(alpha = ...)`.
    rgb: Option<Rgb>,
    /// How opaque it is.
    alpha: f64,
}

impl Look {
    /// Whether nothing is asked for.
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    /// With a `color` node inside: it counts unless there is a colour already.
    pub fn with_color(mut self, args: &Args<'_>, report: &mut Report<'_>) -> Self {
        let alpha = args.number("alpha").map(|(alpha, _)| alpha);
        let inner = match (color(args, "c", report), alpha) {
            (None, None) => return self,
            (Some((rgb, own_alpha)), alpha) => Color { rgb, alpha: alpha.unwrap_or(own_alpha) },
            (None, Some(alpha)) => Color { rgb: None, alpha },
        };
        let alpha = if inner.alpha.is_nan() { 1.0 } else { inner.alpha.clamp(0.0, 1.0) };
        let says_something = inner.rgb.is_some() || alpha < 1.0;
        if says_something && self.color.is_none_or(|outer| outer.rgb.is_none()) {
            self.color = Some(Color { alpha, ..inner });
        }
        self
    }

    /// With a `material` node inside: it replaces the one around it.
    pub fn with_material(mut self, args: &Args<'_>, report: &mut Report<'_>) -> Self {
        let preset = args.text("preset").unwrap_or(("plastic", args.name_at));
        let own_color = color(args, "color", report).and_then(|(rgb, _)| rgb);
        let Some(make) = preset_named(preset.0) else {
            let near = nearest(preset.0, PRESETS.iter().map(|(name, ..)| *name));
            let all = PRESETS.map(|(name, ..)| format!("\"{name}\"")).join(", ");
            let help = near.map_or(format!("there are {all}"), |near| format!("did you mean \"{near}\"?"));
            let message = format!("there is no material \"{}\"", preset.0);
            report.push(Diagnostic::error("unknown-material", preset.1, message).with_help(help));
            return self;
        };
        let mut material = make(own_color);
        let fields: [(&str, &mut f64, f64, f64); 8] = [
            ("ka", &mut material.ka, 0.0, f64::MAX),
            ("kd", &mut material.kd, 0.0, f64::MAX),
            ("ks", &mut material.ks, 0.0, f64::MAX),
            ("shininess", &mut material.shininess, 0.0, f64::MAX),
            ("kr", &mut material.kr, 0.0, 1.0),
            ("kt", &mut material.kt, 0.0, 1.0),
            ("ior", &mut material.ior, f64::MIN_POSITIVE, f64::MAX),
            ("tint", &mut material.tint, 0.0, 1.0),
        ];
        for (name, field, least, most) in fields {
            let Some((value, at)) = args.number(name) else { continue };
            if (least..=most).contains(&value) {
                *field = value;
            } else {
                let range = match (least, most) {
                    (0.0, 1.0) => "between 0 and 1",
                    (0.0, _) => "zero or more",
                    _ => "greater than zero",
                };
                report.push(Diagnostic::error("coefficient-range", at, format!("`{name}` must be {range}")));
            }
        }
        self.material = Some(material);
        self
    }

    /// What a leaf here is made of.
    pub fn material(&self) -> Material {
        let mut material = self.material.unwrap_or_default();
        if let Some(Color { rgb, alpha }) = self.color {
            material.color = rgb.unwrap_or(material.color);
            // What is not opaque lets the rest of the light pass.
            material.ka *= alpha;
            material.kd *= alpha;
            if alpha < 1.0 && !material.is_transparent() {
                // As pictures are laid over each other: what is behind keeps its colour.
                material.tint = 0.0;
            }
            material.kt = 1.0 - alpha * (1.0 - material.kt);
        }
        material
    }
}

type Preset = (&'static str, fn(Rgb) -> Material, [f64; 3]);

/// The named materials, and the colours that they have by themselves, sRGB encoded.
const PRESETS: [Preset; 5] = [
    ("matte", Material::matte, Material::DEFAULT_SRGB),
    ("plastic", Material::plastic, Material::DEFAULT_SRGB),
    ("metal", Material::metal, [0.80, 0.80, 0.82]),
    ("glass", Material::glass, [1.0, 1.0, 1.0]),
    ("mirror", Material::mirror, [0.95, 0.95, 0.95]),
];

fn preset_named(name: &str) -> Option<impl Fn(Option<Rgb>) -> Material> {
    let (_, make, own) = PRESETS.into_iter().find(|(preset, ..)| *preset == name)?;
    Some(move |color: Option<Rgb>| make(color.unwrap_or_else(|| Rgb::from_srgb(own))))
}

/// The colour in an argument and its alpha. The colour is absent where the numbers are OpenSCAD's for "none".
pub(super) fn color(args: &Args<'_>, name: &str, report: &mut Report<'_>) -> Option<(Option<Rgb>, f64)> {
    let at = args.get(name)?.at;
    match args.view(name)? {
        View::Numbers([r, g, b, rest @ ..]) => {
            Some((numeric(&[*r, *g, *b], at, report), rest.first().copied().unwrap_or(1.0)))
        }
        View::Text(text) => {
            let (rgb, alpha) = named(text, at, report)?;
            Some((Some(rgb), alpha))
        }
        _ => None,
    }
}

fn numeric(rgb: &[f64; 3], at: SourceRange, report: &mut Report<'_>) -> Option<Rgb> {
    if rgb.iter().any(|v| *v < 0.0 || v.is_nan()) {
        return None;
    }
    if rgb.iter().any(|v| *v > 1.0) {
        let message = "the numbers of a colour go from 0 to 1; larger ones are taken as 1";
        let help = "for 0 to 255, write \"#rrggbb\" or divide by 255";
        report.push(Diagnostic::warning("color-range", at, message).with_help(help));
    }
    Some(Rgb::from_srgb(rgb.map(|v| v.min(1.0))))
}

fn named(text: &str, at: SourceRange, report: &mut Report<'_>) -> Option<(Rgb, f64)> {
    match csscolorparser::parse(text) {
        Ok(color) => {
            let [r, g, b, a] = color.to_rgba8().map(|v| f64::from(v) / 255.0);
            Some((Rgb::from_srgb([r, g, b]), a))
        }
        Err(_) => {
            let names = csscolorparser::NAMED_COLORS.keys().map(|name| name.as_str());
            let help = match nearest(text, names) {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => "colours are named as on the web (\"tomato\"), or written \"#rrggbb\" or [r, g, b]".to_owned(),
            };
            let message = format!("there is no colour \"{text}\"");
            report.push(Diagnostic::error("unknown-color", at, message).with_help(help));
            None
        }
    }
}

/// The parts of a scene, one for each material.
#[derive(Debug, Default)]
pub(super) struct Parts {
    pub list: Vec<Part>,
    /// Where each was asked for first.
    pub places: Vec<SourceRange>,
    index: HashMap<[u64; 11], PartId>,
}

impl Parts {
    /// The part made of this material.
    pub fn of(&mut self, material: Material, at: SourceRange) -> PartId {
        let Material { color: Rgb { r, g, b }, ka, kd, ks, shininess, kr, kt, ior, tint } = material;
        let key = [r, g, b, ka, kd, ks, shininess, kr, kt, ior, tint].map(f64::to_bits);
        *self.index.entry(key).or_insert_with(|| {
            self.list.push(Part { material });
            self.places.push(at);
            PartId(self.list.len() as u32 - 1)
        })
    }
}
