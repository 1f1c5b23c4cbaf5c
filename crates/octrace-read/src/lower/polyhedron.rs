//! `polyhedron(points, faces)`, and what can be wrong with it.

use super::args::Args;
use super::operand::{Made, Operand};
use super::report::Report;
use crate::SourceRange;
use crate::diagnostic::{Diagnostic, Severity};
use crate::syntax::{Rows, element_range};
use octrace::{Polyhedron, PolyhedronError, Solid, Vec3};
use octrace_forms::files::mesh::{RawMesh, SolidError};

const NOTHING: &str = "the polyhedron is empty";

/// The arguments as written.
struct Written<'a> {
    points: Rows<'a>,
    points_at: SourceRange,
    faces: Rows<'a>,
    faces_at: SourceRange,
}

/// The solid, or `None` where there is none; why was said. To a hull (`in_hull`) a surface that bounds no solid is its
/// corners, as it is to OpenSCAD's.
pub(super) fn operand(args: &Args<'_>, in_hull: bool, repair: bool, report: &mut Report<'_>) -> Option<Operand> {
    let faces_name = if args.get("faces").is_some() { "faces" } else { "triangles" };
    if args.damaged {
        return None;
    }
    let (Some((points, points_at)), Some((faces, faces_at))) = (args.rows("points"), args.rows(faces_name)) else {
        let wrong = "a polyhedron needs `points` and `faces`".to_owned();
        report.degenerate("missing-argument", args.name_at, wrong, NOTHING, None);
        return None;
    };
    let written = Written { points, points_at, faces, faces_at };
    let faces = written.checked_faces(report)?;
    // Faces of fewer than three corners have no area.
    let usable: Vec<(usize, &Vec<u32>)> = faces.iter().enumerate().filter(|(_, face)| face.len() >= 3).collect();
    // OpenSCAD lists the corners of a face clockwise as seen from outside.
    let corners: Vec<Vec<u32>> = usable.iter().map(|(_, face)| face.iter().rev().copied().collect()).collect();
    let points: Vec<Vec3> = points.iter().map(point).collect();
    let error = match Polyhedron::new(points.clone(), corners.clone()) {
        Ok(polyhedron) => return Some(bare(polyhedron)),
        Err(_) if in_hull && report.forgives() => {
            let used = corners.iter().flatten().map(|&corner| points[corner as usize]);
            return Some(Operand::Corners(used.collect()));
        }
        Err(error) => error,
    };
    if usable.is_empty() || matches!(error, PolyhedronError::Flat) {
        let what = if usable.is_empty() { "has no faces" } else { "encloses no volume" };
        report.degenerate("polyhedron-empty", args.name_at, format!("this polyhedron {what}"), "it is empty", None);
        return None;
    }
    let original = |face: usize| usable.get(face).map_or(face, |(original, _)| *original);
    let complaint = written.complaint(&error, original, args.name_at, report.text);
    // OpenSCAD shows what is open all the same.
    let mends = repair || report.forgives();
    let (made, outcome) = match mends.then(|| RawMesh { points, faces: corners }.repaired().0.into_polyhedron()) {
        Some(Ok(polyhedron)) => (Some(bare(polyhedron)), "it was mended"),
        Some(Err(SolidError::Unsound(PolyhedronError::Flat))) => (None, "it encloses nothing"),
        Some(Err(_)) | None => {
            report.push(complaint);
            return None;
        }
    };
    let message = format!("{}; {outcome}", complaint.message);
    report.push(Diagnostic { severity: Severity::Warning, message, ..complaint });
    made
}

fn bare(polyhedron: Polyhedron) -> Operand {
    Operand::Solid(Made::bare(Solid::primitive(polyhedron)))
}

/// A point as written: the last coordinate may be missing.
fn point(p: &[f64]) -> Vec3 {
    Vec3::new(p[0], p[1], p.get(2).copied().unwrap_or(0.0))
}

impl Written<'_> {
    /// The faces, as numbers of points; `None` where a coordinate is not finite. Reports those, and indices of no point,
    /// which OpenSCAD passes over.
    fn checked_faces(&self, report: &mut Report<'_>) -> Option<Vec<Vec<u32>>> {
        let mut sound = true;
        for (i, p) in self.points.iter().enumerate().filter(|(_, p)| p.iter().any(|v| !v.is_finite())) {
            sound = false;
            let wrong = format!("point {i} of this polyhedron has a coordinate that is not finite: {p:?}");
            let at = element_range(report.text, self.points_at, &[i]);
            report.degenerate("polyhedron-point", at, wrong, NOTHING, None);
        }
        let count = self.points.len();
        let is_index = report.index_below(count);
        for (f, face) in self.faces.iter().enumerate() {
            for (k, index) in face.iter().enumerate().filter(|(_, v)| !is_index(**v)) {
                sound &= report.forgives();
                let wrong = format!("face {f} names point {index}, but there are {count} points, numbered from 0");
                let at = element_range(report.text, self.faces_at, &[f, k]);
                report.degenerate("polyhedron-index", at, wrong, "it is passed over", None);
            }
        }
        let usable = |face: &[f64]| face.iter().filter(|v| is_index(**v)).map(|&v| v as u32).collect();
        sound.then(|| self.faces.iter().map(usable).collect())
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
            Some(p) => {
                let [x, y, z] = point(p).to_array();
                format!("point {i} at [{x}, {y}, {z}]")
            }
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
