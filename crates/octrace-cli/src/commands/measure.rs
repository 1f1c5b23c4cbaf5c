//! `octrace measure`: volume, centre of mass, extent.

use crate::args::MeasureArgs;
use crate::failure::Failure;
use crate::input;
use crate::output::write_stdout;
use crate::rounding::{error_of, rounded};
use crate::session::Session;
use octrace::query::{MeasureError, MeasureOptions, Measures, measure};
use octrace::{Tracer, Vec3};
use octrace_read::Loaded;
use serde::Serialize;

/// The result, for programs. What an empty solid does not have is null.
#[derive(Debug, Serialize)]
struct Report<'a> {
    file: &'a str,
    facets: String,
    tolerance: f64,
    volume: f64,
    volume_error: f64,
    centroid: Option<[f64; 3]>,
    centroid_error: Option<f64>,
    bbox: Option<[f64; 6]>,
    bbox_error: Option<f64>,
    converged: bool,
    rays: u64,
}

/// Measures one file.
pub fn run(args: &MeasureArgs, session: &Session) -> Result<(), Failure> {
    let (source, Loaded { scene, .. }) = input::load(&args.file, &args.read, session)?;
    let measured = {
        let (exec, _listening) = session.exec(&args.trace);
        let tracer = Tracer::build(&scene.solid, &args.trace.options(scene.snap), &exec)?;
        session.remark_on_snapping(&tracer);
        measure(&tracer, &MeasureOptions { tolerance: args.read.tolerance, ..MeasureOptions::default() }, &exec)
    };
    let measures = measured.map_err(|error| match error {
        MeasureError::Cancelled => Failure::Interrupted,
        other => Failure::NoAnswer(format!("{}: {other}", source.name())),
    })?;
    if !measures.converged {
        session.remark(&format!(
            "warning: the tolerance was not reached in {} rays; the volume's error is given with it",
            measures.rays
        ));
    }
    let report = report(&source, args, &measures);
    let text = if args.json {
        serde_json::to_string(&report).expect("numbers and names are plain data") + "\n"
    } else {
        table(&report)
    };
    write_stdout(text.as_bytes())
}

fn report<'a>(source: &'a octrace_read::Source, args: &MeasureArgs, measures: &Measures) -> Report<'a> {
    // Adding zero turns -0 into 0, which is all that a reader of numbers expects.
    let (low, high) = (measures.bbox.min + Vec3::ZERO, measures.bbox.max + Vec3::ZERO);
    let anything = !measures.bbox.is_empty();
    Report {
        file: source.name(),
        facets: args.read.facets.to_string(),
        tolerance: args.read.tolerance,
        volume: measures.volume,
        volume_error: measures.volume_error,
        centroid: measures.centroid.map(Vec3::to_array),
        centroid_error: measures.centroid.map(|_| measures.centroid_error),
        bbox: anything.then_some([low.x, low.y, low.z, high.x, high.y, high.z]),
        bbox_error: anything.then_some(measures.bbox_error),
        converged: measures.converged,
        rays: measures.rays,
    }
}

/// For people: no digits without a meaning.
fn table(report: &Report) -> String {
    let mut text = String::new();
    let mut line = |name: &str, values: &[f64], error: f64, tail: &str| {
        let values: Vec<String> = values.iter().map(|&value| rounded(value, error)).collect();
        text += &format!("{name:<10}{}{tail}\n", values.join(" "));
    };
    let plus_minus = |error: f64| format!(" ± {}", error_of(error));
    line("volume", &[report.volume], report.volume_error, &plus_minus(report.volume_error));
    if let (Some(centroid), Some(error)) = (report.centroid, report.centroid_error) {
        line("centroid", &centroid, error, &plus_minus(error));
    }
    match (report.bbox, report.bbox_error) {
        (Some([x0, y0, z0, x1, y1, z1]), Some(error)) => {
            line("from", &[x0, y0, z0], error, &plus_minus(error));
            line("to", &[x1, y1, z1], error, "");
            line("size", &[x1 - x0, y1 - y0, z1 - z0], 2.0 * error, "");
        }
        _ => text += "the solid is empty\n",
    }
    text
}
