//! Leaves that other files and fonts say: `import`, `surface`, `text`.

use super::args::Args;
use super::facets;
use super::flats;
use super::language::Kind;
use super::operand::{Made, Operand};
use super::polyhedron;
use super::walk::Walk;
use crate::SourceRange;
use crate::diagnostic::{Diagnostic, Severity};
use octrace::{BoolOp, PolyhedronError, Solid, Vec2};
use octrace_forms::files::drawing::{self, DrawingFormat, DrawingOptions, Place};
use octrace_forms::files::height::{self, HeightField, Shades};
use octrace_forms::files::mesh::{self, MeshError, MeshFormat, RawMesh, SolidError};
use octrace_forms::plane::{Fill, Flat, region};
use octrace_forms::sweep::fragments;
use octrace_forms::text::{self, TextSpec};

impl Walk<'_, '_> {
    /// What a leaf is; where it is nothing, why was said.
    pub(super) fn shape(&mut self, kind: Kind, args: &Args<'_>, in_hull: bool) -> Operand {
        let flat = match kind {
            Kind::Square => flats::square(args, &mut self.report),
            Kind::Circle => flats::circle(args, self.options.facets, &mut self.report),
            Kind::Polygon => flats::polygon(args, &mut self.report),
            Kind::Text => self.text(args),
            Kind::Polyhedron => {
                let made = polyhedron::operand(args, in_hull, self.options.repair, &mut self.report);
                return made.unwrap_or(Operand::Empty);
            }
            Kind::Import => return self.import(args, in_hull),
            Kind::Surface => return self.surface(args),
            solid => return self.shapes.leaf(solid, args, &mut self.report).map_or(Operand::Empty, bare),
        };
        flat.map_or(Operand::Empty, Operand::Flat)
    }

    fn text(&mut self, args: &Args<'_>) -> Option<Flat> {
        let word = |name: &str, default: &'static str| args.text(name).map_or(default, |(word, _)| word);
        let number = |name: &str, default: f64| args.number(name).map_or(default, |(v, _)| v);
        let size = number("size", 10.0);
        let spec = TextSpec {
            text: args.text("text")?.0,
            size,
            spacing: number("spacing", 1.0),
            font: word("font", ""),
            halign: word("halign", "left"),
            valign: word("valign", "baseline"),
            direction: word("direction", ""),
            language: word("language", "en"),
            script: word("script", ""),
            facets: facets::around(self.options.facets, args, size),
            tolerance: self.options.tolerance,
        };
        let at = args.get("text").map_or(args.name_at, |arg| arg.at);
        let outline = match text::outline(&spec, self.assets.fonts()) {
            Ok(outline) => outline,
            Err(error) => {
                let help = error.help().map(str::to_owned);
                self.lacking(Diagnostic { help, ..Diagnostic::error("missing-font", at, error.to_string()) });
                return None;
            }
        };
        for warning in outline.warnings {
            if self.report.is_news("text", &warning.to_string()) {
                let help = warning.help().map(str::to_owned);
                self.report.push(Diagnostic { help, ..Diagnostic::warning("other-font", at, warning.to_string()) });
            }
        }
        match region(&outline.paths, Fill::NonZero) {
            Ok(outline) => Some(Flat::from(outline)).filter(|flat| !flat.is_empty()),
            Err(error) => {
                self.unreadable(spec.text, &error, at);
                None
            }
        }
    }

    pub(super) fn import(&mut self, args: &Args<'_>, in_hull: bool) -> Operand {
        let (name, bytes, at) = match self.file(args) {
            Ok(file) => file,
            Err(nothing) => return nothing,
        };
        if let Some(format) = MeshFormat::of_name(&name) {
            let mesh = match mesh::read(format, &bytes) {
                Ok(mesh) => mesh,
                Err(error @ MeshError::Empty) => {
                    let message = format!("there is nothing in `{name}`: {error}");
                    return self.absent(Diagnostic::error("empty-file", at, message));
                }
                Err(error) => return self.unreadable(&name, &error, at),
            };
            return self.polyhedron(&name, mesh, at, in_hull);
        }
        if let Some(format) = DrawingFormat::of_name(&name) {
            return self.drawing(&name, format, &bytes, args, at);
        }
        let help = "meshes are .stl .off .obj .amf .3mf, drawings .svg .dxf";
        let message = format!("`{name}` is of no kind that can be imported");
        self.absent(Diagnostic::error("unknown-format", at, message).with_help(help))
    }

    fn drawing(
        &mut self,
        name: &str,
        format: DrawingFormat,
        bytes: &[u8],
        args: &Args<'_>,
        at: SourceRange,
    ) -> Operand {
        let number = |name: &str| args.number(name).map(|(v, _)| v);
        let meant = facets::meant(self.options.facets, args);
        let fragments = |radius: f64| meant.map_or(0, |by| fragments(radius, &by));
        let layer = [args.text("layer"), args.text("id")].into_iter().flatten().map(|(layer, _)| layer);
        let options = DrawingOptions {
            layer: layer.into_iter().find(|layer| !layer.is_empty()),
            origin: args.numbers("origin").map_or(Vec2::ZERO, |(v, _)| Vec2::new(v[0], v[1])),
            // An extrusion that names a file has a scale of its own.
            scale: if args.is_of("import") { number("scale").unwrap_or(1.0) } else { 1.0 },
            dpi: number("dpi").unwrap_or(DrawingOptions::default().dpi),
            place: if args.is_of("import") && args.flag("center") { Place::Centered } else { Place::Page },
            fragments: meant.is_some().then_some(&fragments),
            tolerance: self.options.tolerance,
        };
        let drawing = match drawing::read(format, bytes, &options) {
            Ok(drawing) => drawing,
            Err(error) => return self.unreadable(name, &error, at),
        };
        for warning in drawing.warnings {
            let message = format!("`{name}`: {warning}");
            if self.report.is_news("drawing", &message) {
                self.report.push(Diagnostic::warning("drawing", at, message));
            }
        }
        let outlines = drawing.shapes.iter().map(|paths| region(paths, Fill::EvenOdd));
        match outlines.collect::<Result<Vec<_>, _>>() {
            Ok(outlines) => {
                let flats = outlines.into_iter().filter(|outline| !outline.is_empty()).map(Flat::from);
                Some(Flat::combined(BoolOp::Union, flats))
                    .filter(|flat| !flat.is_empty())
                    .map_or(Operand::Empty, Operand::Flat)
            }
            Err(error) => self.unreadable(name, &error, at),
        }
    }

    fn surface(&mut self, args: &Args<'_>) -> Operand {
        let (name, bytes, at) = match self.file(args) {
            Ok(file) => file,
            Err(nothing) => return nothing,
        };
        let shades = if args.flag("invert") { Shades::DarkIsHigh } else { Shades::BrightIsHigh };
        let placement = if args.flag("center") { height::Placement::Centered } else { height::Placement::Corner };
        match HeightField::read(&bytes, shades) {
            Ok(field) => self.polyhedron(&name, field.body(placement), at, false),
            Err(error) => self.unreadable(&name, &error, at),
        }
    }

    fn polyhedron(&mut self, name: &str, mesh: RawMesh, at: SourceRange, in_hull: bool) -> Operand {
        let mesh = match self.options.repair {
            false => mesh,
            true => {
                let (mesh, repairs) = mesh.repaired();
                if repairs != mesh::Repairs::default() {
                    let mesh::Repairs { joined_points, dropped_faces, split_edges, closed_holes } = repairs;
                    let message = format!(
                        "`{name}` was mended: {joined_points} points joined, {dropped_faces} faces dropped, {split_edges} edges \
                         split, {closed_holes} holes closed"
                    );
                    self.report.push(Diagnostic::note("mended", at, message));
                }
                mesh
            }
        };
        let corners = if in_hull { mesh.points.clone() } else { Vec::new() };
        match mesh.into_polyhedron() {
            Ok(polyhedron) => bare(Solid::primitive(polyhedron)),
            Err(_) if in_hull => Operand::Corners(corners),
            Err(SolidError::Unsound(PolyhedronError::Flat)) => {
                let wrong = format!("the mesh in `{name}` encloses no volume");
                self.report.degenerate("mesh-empty", at, wrong, "it is empty", None);
                Operand::Empty
            }
            Err(error) => {
                let message = format!("the mesh in `{name}` is not a solid: {error}");
                let diagnostic =
                    Diagnostic { help: error.help().map(str::to_owned), ..Diagnostic::error("mesh-open", at, message) };
                self.lacking(diagnostic)
            }
        }
    }

    /// The file that a leaf names, and its content; what the leaf is where it cannot be had, and why was said.
    fn file(&mut self, args: &Args<'_>) -> Result<(String, Vec<u8>, SourceRange), Operand> {
        let Some((name, at)) = args.text("file").filter(|(name, _)| !name.is_empty()) else {
            if !args.damaged {
                let message = "this names no `file`, so there is nothing to import";
                let forgives = self.report.forgives();
                let severity = if forgives { Severity::Warning } else { Severity::Error };
                self.report.push(Diagnostic::new(severity, "missing-argument", args.name_at, message));
            }
            return Err(Operand::LeftOut);
        };
        self.assets.read(name).map(|bytes| (name.to_owned(), bytes, at)).map_err(|error| {
            let message = format!("cannot read `{name}`: {error}");
            let help = "names of files are relative to the folder of the file that names them";
            self.absent(Diagnostic::error("missing-file", at, message).with_help(help))
        })
    }

    /// A file that is not there, or is none that can be imported. In a dump that is nothing, as for OpenSCAD, which draws the
    /// rest and says so.
    fn absent(&mut self, diagnostic: Diagnostic) -> Operand {
        if self.options.skip_unsupported || !self.report.forgives() {
            return self.lacking(diagnostic);
        }
        let message = format!("{}; it is left out", diagnostic.message);
        self.report.push(Diagnostic { severity: Severity::Warning, message, ..diagnostic });
        Operand::Empty
    }

    fn unreadable(&mut self, name: &str, error: &dyn std::error::Error, at: SourceRange) -> Operand {
        let mut message = format!("cannot make sense of `{name}`: {error}");
        let mut cause = error.source();
        while let Some(deeper) = cause {
            message += &format!(": {deeper}");
            cause = deeper.source();
        }
        self.lacking(Diagnostic::error("unreadable-file", at, message))
    }

    /// Something that is needed is not there: an error, or left out where that is wanted.
    fn lacking(&mut self, diagnostic: Diagnostic) -> Operand {
        let left_out = self.options.skip_unsupported;
        let severity = if left_out { Severity::Warning } else { diagnostic.severity };
        self.report.push(Diagnostic { severity, ..diagnostic });
        Operand::LeftOut
    }
}

fn bare(solid: Solid) -> Operand {
    Operand::Solid(Made::bare(solid))
}
