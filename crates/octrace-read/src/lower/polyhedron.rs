//! `polyhedron(points, faces)`, and what can be wrong with it.

use super::args::Args;
use super::report::Report;
use crate::SourceRange;
use crate::diagnostic::{Diagnostic, Severity};
use crate::syntax::{Rows, element_range};
use octrace::{Polyhedron, PolyhedronError, Solid, Vec3};
use octrace_forms::files::mesh::RawMesh;

/// The arguments as written.
struct Written<'a> {
    points: Rows<'a>,
    points_at: SourceRange,
    faces: Rows<'a>,
    faces_at: SourceRange,
}

/// The solid, or `None` where there is none; why was said.
pub(super) fn solid(args: &Args<'_>, repair: bool, report: &mut Report<'_>) -> Option<Solid> {
    let faces_name = if args.get("faces").is_some() { "faces" } else { "triangles" };
    let (Some((points, points_at)), Some((faces, faces_at))) = (args.rows("points"), args.rows(faces_name)) else {
        if !args.damaged {
            let message = "a polyhedron needs `points` and `faces`";
            report.push(Diagnostic::error("missing-argument", args.name_at, message));
        }
        return None;
    };
    let written = Written { points, points_at, faces, faces_at };
    if !written.is_sound(report) {
        return None;
    }
    // Faces of fewer than three corners have no area.
    let usable: Vec<(usize, &[f64])> = faces.iter().enumerate().filter(|(_, face)| face.len() >= 3).collect();
    if usable.is_empty() {
        let wrong = "this polyhedron has no faces".to_owned();
        report.degenerate("polyhedron-empty", args.name_at, wrong, "it is empty", None);
        return None;
    }
    // OpenSCAD lists the corners of a face clockwise as seen from outside.
    let corners: Vec<Vec<u32>> =
        usable.iter().map(|(_, face)| face.iter().rev().map(|&v| v as u32).collect()).collect();
    let points: Vec<Vec3> = points.iter().map(|p| Vec3::new(p[0], p[1], p[2])).collect();
    match Polyhedron::new(points.clone(), corners.clone()) {
        Ok(polyhedron) => Some(Solid::primitive(polyhedron)),
        Err(PolyhedronError::Flat) => {
            let wrong = "this polyhedron encloses no volume".to_owned();
            report.degenerate("polyhedron-empty", args.name_at, wrong, "it is empty", None);
            None
        }
        Err(error) => {
            let original = |face: usize| usable.get(face).map_or(face, |(original, _)| *original);
            let complaint = written.complaint(&error, original, args.name_at, report.text);
            // OpenSCAD shows what is open all the same.
            let mended = if repair || report.forgives() { mended(points, corners) } else { None };
            report.push(match mended {
                Some(_) => Diagnostic {
                    severity: Severity::Warning,
                    message: format!("{}; it was mended", complaint.message),
                    ..complaint
                },
                None => complaint,
            });
            mended.map(Solid::primitive)
        }
    }
}

/// The solid that comes of closing the surface as well as can be.
fn mended(points: Vec<Vec3>, faces: Vec<Vec<u32>>) -> Option<Polyhedron> {
    RawMesh { points, faces }.repaired().0.into_polyhedron().ok()
}

impl Written<'_> {
    /// Whether all coordinates are finite and all indices those of points; reports those that are not.
    fn is_sound(&self, report: &mut Report<'_>) -> bool {
        let mut sound = true;
        for (i, p) in self.points.iter().enumerate().filter(|(_, p)| p.iter().any(|v| !v.is_finite())) {
            sound = false;
            let message = format!("point {i} of this polyhedron has a coordinate that is not finite: {p:?}");
            let at = element_range(report.text, self.points_at, &[i]);
            report.push(Diagnostic::error("polyhedron-point", at, message));
        }
        let count = self.points.len();
        let is_index = |v: f64| 0.0 <= v && v < count as f64 && v.fract() == 0.0;
        for (f, face) in self.faces.iter().enumerate() {
            for (k, index) in face.iter().enumerate().filter(|(_, v)| !is_index(**v)) {
                sound = false;
                let message = format!("face {f} names point {index}, but there are {count} points, numbered from 0");
                let at = element_range(report.text, self.faces_at, &[f, k]);
                report.push(Diagnostic::error("polyhedron-index", at, message));
            }
        }
        sound
    }

    /// What is wrong with the surface. `original` tells a face's number in the file.
    fn complaint(
        &self,
        error: &PolyhedronError,
        original: impl Fn(usize) -> usize,
        at: SourceRange,
        text: &str,
    ) -> Diagnostic {
        let corner = |i: u32| match self.points.get(i as usize) {
            Some([x, y, z]) => format!("point {i} at [{x}, {y}, {z}]"),
            _ => format!("point {i}"),
        };
        let place = |face: usize| element_range(text, self.faces_at, &[face]);
        match error {
            // From `to` to `from`: the faces were turned about.
            PolyhedronError::Open { face, from, to, count } => {
                let face = original(*face);
                let edges = if *count == 1 { "an edge borders".to_owned() } else { format!("{count} edges border") };
                let edge = format!("from {} to {}", corner(*to), corner(*from));
                let message = format!("this polyhedron is open: {edges} only one face");
                Diagnostic::error("polyhedron-open", at, message)
                    .with_note(place(face), format!("no other face continues face {face} across its edge {edge}"))
                    .with_help("add the missing faces; corners go clockwise as seen from outside")
            }
            PolyhedronError::Unorientable { face, from, to, .. } => {
                let face = original(*face);
                let edge = format!("from {} to {}", corner(*to), corner(*from));
                let message = "this polyhedron has no inside: its faces cannot be turned to agree";
                Diagnostic::error("polyhedron-unorientable", at, message)
                    .with_note(place(face), format!("face {face} does not fit its neighbours at its edge {edge}"))
            }
            other => Diagnostic::error("polyhedron-unsound", at, format!("this polyhedron is not sound: {other}")),
        }
    }
}
