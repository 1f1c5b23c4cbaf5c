//! What must hold for any bytes at all. The fuzz targets call these with what they make up, and `crates/octrace-cli/tests/
//! fuzz.rs` with every file of the test suites, so that they run without a fuzzer too.

use octrace::exec::Exec;
use octrace::octree::BuildOptions;
use octrace::trace::Scratch;
use octrace::{Accel, Bounds, Ray, Scene, Tracer, TracerOptions, Vec3};
use octrace_forms::files::drawing::{self, DrawingFormat, DrawingOptions};
use octrace_forms::files::height::{HeightField, Placement, Shades};
use octrace_forms::files::mesh::{self, MeshFormat, RawMesh};
use octrace_read::{Diagnostic, Dialect, Facets, ReadOptions, Severity, Source, read_scene, syntax};

/// Reading ends, places are places of the text, and what was read without an error reads the same after printing.
pub fn parse(bytes: &[u8]) {
    let source = Source::new("any.oct", bytes);
    let parsed = syntax::parse(&source);
    check_places(&source, &parsed.diagnostics);
    let errors = parsed.diagnostics.iter().any(|d| d.severity == Severity::Error);
    if let (Some(ast), false) = (parsed.value, errors) {
        let printed = syntax::print(&ast);
        let again = syntax::parse(&Source::new("printed.oct", printed.as_str()));
        assert!(again.diagnostics.is_empty(), "{:?} in\n{printed}", again.diagnostics);
        assert!(again.value.is_some_and(|again| ast.same_tree(&again)), "{printed}");
    }
}

/// There is a scene or an error, never both nor neither; and the octree is not to be seen in what its rays meet.
pub fn trace(bytes: &[u8]) {
    for (dialect, facets) in [(Dialect::Scene, Facets::Auto), (Dialect::Dump, Facets::Written)] {
        let options = ReadOptions { facets, dialect: Some(dialect), skip_unsupported: true, ..ReadOptions::default() };
        let source = Source::new("any.oct", bytes);
        let checked = read_scene(&source, &options);
        check_places(&source, &checked.diagnostics);
        let errors = checked.diagnostics.iter().any(|d| d.severity == Severity::Error);
        assert_eq!(checked.value.is_none(), errors);
        if let Some(loaded) = checked.value
            && loaded.leaves <= MOST_LEAVES
        {
            trace_both(&loaded.scene);
        }
    }
}

/// As a file of any format, bytes are an error or a thing that hangs together; and what closes a mesh makes a solid of it.
pub fn files(bytes: &[u8]) {
    for format in [MeshFormat::Stl, MeshFormat::Off, MeshFormat::Obj, MeshFormat::Amf, MeshFormat::ThreeMf] {
        let Ok(mesh) = mesh::read(format, bytes) else { continue };
        check_mesh(&mesh);
        let (repaired, _) = mesh.clone().repaired();
        check_mesh(&repaired);
        if let Ok(polyhedron) = mesh.into_polyhedron() {
            assert!(polyhedron.volume() >= 0.0, "{format:?}: the inside is out");
        }
        // An error says what is still wrong; that it comes back at all is the law.
        let _ = repaired.into_polyhedron();
    }
    for format in [DrawingFormat::Dxf, DrawingFormat::Svg] {
        let Ok(drawing) = drawing::read(format, bytes, &DrawingOptions::default()) else { continue };
        for edge in drawing.shapes.iter().flatten().flatten() {
            assert!(edge.from.x.is_finite() && edge.from.y.is_finite(), "{format:?}: {edge:?}");
        }
    }
    if let Ok(field) = HeightField::read(bytes, Shades::default()) {
        check_mesh(&field.body(Placement::Corner));
    }
}

fn check_mesh(mesh: &RawMesh) {
    assert!(mesh.points.iter().all(|point| point.is_finite()), "a corner is nowhere");
    assert!(mesh.faces.iter().flatten().all(|&corner| (corner as usize) < mesh.points.len()), "a corner is missing");
}

/// Larger scenes take too long to learn from.
const MOST_LEAVES: usize = 200;

fn check_places(source: &Source, diagnostics: &[Diagnostic]) {
    for diagnostic in diagnostics {
        for at in std::iter::once(diagnostic.at).chain(diagnostic.notes.iter().map(|(at, _)| *at)) {
            assert!(at.start <= at.end && at.end as usize <= source.text().len().max(1), "{diagnostic:?}");
        }
    }
}

fn trace_both(scene: &Scene) {
    let solids = scene.bodies().solids;
    let build = |accel| {
        let octree = BuildOptions { leaf_surfaces: 2, depth: Some(4) };
        let options = TracerOptions { accel, octree, snap: scene.snap, ..TracerOptions::default() };
        Tracer::build_bodies(&solids, &options, &Exec::with_threads(1)).expect("nobody cancels")
    };
    let (canonical, octree) = (build(Accel::None), build(Accel::Octree));
    let (mut slow, mut fast) = (Scratch::default(), Scratch::default());
    for ray in rays(&canonical.bounds()) {
        for body in 0..solids.len() {
            let spans = canonical.body_spans(body, &ray, &mut slow);
            assert_eq!(octree.body_spans(body, &ray, &mut fast), spans, "{ray:?}");
            assert!(spans.iter().all(|span| span.enter_t() < span.exit_t()), "{spans:?}");
            assert!(spans.windows(2).all(|pair| pair[0].exit_t() < pair[1].enter_t()), "{spans:?}");
        }
        let hit = canonical.first_body_hit(&ray, f64::INFINITY, &mut slow);
        assert_eq!(octree.first_body_hit(&ray, f64::INFINITY, &mut fast), hit, "{ray:?}");
        if let Some((_, hit)) = hit {
            assert!(hit.t > 0.0 && hit.t.is_finite(), "{hit:?}");
            let normal = canonical.surface_point(&ray, &hit).normal;
            assert!((normal.length() - 1.0).abs() < 1e-9, "{normal:?}");
        }
    }
    assert_eq!(fast.counters.leaks, 0, "cells contradict each other");
}

/// From the corners, the middles of the sides and far away, through places inside: many of them along faces and edges.
fn rays(bounds: &Bounds) -> Vec<Ray> {
    let bounds = match bounds.is_empty() {
        true => Bounds::new(Vec3::splat(-1.0), Vec3::splat(1.0)),
        false => *bounds,
    };
    let place = |x: f64, y: f64, z: f64| bounds.min + bounds.size() * Vec3::new(x, y, z);
    let mut rays = Vec::new();
    for target in [place(0.5, 0.5, 0.5), place(0.0, 0.0, 0.0), place(0.31, 0.62, 0.47)] {
        for from in [-3.0, 0.0, 0.5, 1.0, 40.0] {
            for origin in [place(from, 0.5, 0.5), place(0.31, from, 0.47), place(from, 1.0 - from, from)] {
                rays.extend(Ray::checked(origin, target - origin));
            }
        }
    }
    rays
}
