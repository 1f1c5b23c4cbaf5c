//! What `octrace inspect --json` says. `docs/command-line.md` explains the keys.

use crate::args::InspectArgs;
use crate::stats::{Octree, Snap};
use crate::tree::{self, NodeCounts};
use crate::values::Pixel;
use octrace::trace::RayReport;
use octrace::{Bounds, Hit, Tracer, Vec3};
use octrace_read::{Loaded, Source};
use serde::Serialize;
use std::collections::BTreeMap;

/// All of it, for programs. What was not asked for, or is not there, is null.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    file: &'a str,
    file_bytes: usize,
    nodes: Nodes<'a>,
    solid: &'a NodeCounts,
    scene: SceneStats,
    bounds: Option<[f64; 6]>,
    unbounded: bool,
    program: ProgramStats,
    snap: Snap,
    octree: Option<Octree>,
    tree_text: Option<String>,
    program_text: Option<String>,
    pixel: Option<PixelReport>,
}

/// The nodes of the file.
#[derive(Debug, Serialize)]
struct Nodes<'a> {
    depth: usize,
    counts: BTreeMap<&'a str, usize>,
}

#[derive(Debug, Serialize)]
struct SceneStats {
    parts: usize,
    lights: usize,
    camera: bool,
}

/// What the solid was compiled to.
#[derive(Debug, Serialize)]
struct ProgramStats {
    bodies: usize,
    primitives: usize,
    surfaces: usize,
    uses_of_surfaces: usize,
    copies: usize,
    copied_solids: usize,
}

/// One ray.
#[derive(Debug, Serialize)]
struct PixelReport {
    x: u32,
    y: u32,
    origin: [f64; 3],
    direction: [f64; 3],
    cells: Vec<Cell>,
    spans: Vec<Span>,
    hit: Option<Met>,
}

#[derive(Debug, Serialize)]
struct Cell {
    body: usize,
    t_in: f64,
    t_out: f64,
    bounds: [f64; 6],
    program: String,
}

/// An end is null where the ray's line has none.
#[derive(Debug, Serialize)]
struct Span {
    enter: Option<End>,
    exit: Option<End>,
}

#[derive(Debug, Serialize)]
struct End {
    t: f64,
    surface: u32,
    leaf: u32,
}

#[derive(Debug, Serialize)]
struct Met {
    #[serde(flatten)]
    end: End,
    point: [f64; 3],
    normal: [f64; 3],
}

impl<'a> Report<'a> {
    /// Of a file and what was made of it; `pixel` is the one that was asked for, with its ray.
    pub fn new(
        (source, loaded, solid): (&'a Source, &'a Loaded, &'a NodeCounts),
        tracer: &Tracer,
        args: &InspectArgs,
        pixel: Option<(Pixel, RayReport)>,
    ) -> Self {
        let Loaded { scene, node_counts, depth, .. } = loaded;
        let stats = tracer.stats();
        let bounds = tracer.bounds();
        Self {
            file: source.name(),
            file_bytes: source.text().len(),
            nodes: Nodes {
                depth: *depth,
                counts: node_counts.iter().map(|(name, &count)| (name.as_str(), count)).collect(),
            },
            solid,
            scene: SceneStats { parts: scene.parts.len(), lights: scene.lights.len(), camera: scene.camera.is_some() },
            bounds: (!bounds.is_empty()).then(|| corners(&bounds)),
            unbounded: tracer.is_unbounded(),
            program: ProgramStats {
                bodies: stats.bodies,
                primitives: stats.primitives,
                surfaces: stats.surfaces,
                uses_of_surfaces: stats.literals,
                copies: stats.copies,
                copied_solids: tracer.catalog().prototypes.len(),
            },
            snap: Snap::from(tracer),
            octree: stats.octree.as_ref().map(Octree::from),
            tree_text: args.tree.then(|| tree::print(&scene.solid)),
            program_text: args.program.then(|| tracer.program_text()),
            pixel: pixel.map(|(pixel, report)| PixelReport::new(pixel, report)),
        }
    }
}

impl PixelReport {
    fn new(Pixel { x, y }: Pixel, report: RayReport) -> Self {
        let RayReport { ray, cells, spans, hit } = report;
        let cells = cells.into_iter().map(|cell| Cell {
            body: cell.body,
            t_in: cell.t_in,
            t_out: cell.t_out,
            bounds: corners(&cell.bounds),
            program: cell.program,
        });
        let span = |span: octrace::Span| Span { enter: span.enter.map(End::from), exit: span.exit.map(End::from) };
        Self {
            x,
            y,
            origin: numbers(ray.origin),
            direction: numbers(ray.direction),
            cells: cells.collect(),
            spans: spans.into_iter().map(span).collect(),
            hit: hit.map(|(hit, at)| Met { end: hit.into(), point: numbers(at.position), normal: numbers(at.normal) }),
        }
    }
}

impl From<Hit> for End {
    fn from(hit: Hit) -> Self {
        Self { t: hit.t, surface: hit.surface, leaf: hit.leaf }
    }
}

fn corners(bounds: &Bounds) -> [f64; 6] {
    let ([x0, y0, z0], [x1, y1, z1]) = (numbers(bounds.min), numbers(bounds.max));
    [x0, y0, z0, x1, y1, z1]
}

/// Adding zero turns -0 into 0, which is all that a reader of numbers expects.
fn numbers(v: Vec3) -> [f64; 3] {
    (v + Vec3::ZERO).to_array()
}
