//! `octrace bench`: how fast this machine traces.

use crate::args::BenchArgs;
use crate::bench::{self, BenchScene, Plan, Row};
use crate::failure::Failure;
use crate::input;
use crate::output::{say_error, write_stdout};
use crate::session::Session;
use octrace_read::Severity;
use std::path::Path;

/// Measures the files, or the scenes that come with the program. Goes on after a file that cannot be measured, and fails
/// in the end.
pub fn run(args: &BenchArgs, session: &Session) -> Result<(), Failure> {
    let plan = plan(args);
    let (mut rows, mut trouble) = (Vec::new(), None);
    for file in &args.files {
        let scene = match from_file(file, args, session) {
            Ok(scene) => scene,
            Err(Failure::Interrupted) => return Err(Failure::Interrupted),
            Err(failure) => {
                say_error(&failure.to_string());
                trouble = Some(Failure::Input);
                continue;
            }
        };
        rows.push(bench::measure(&scene, &plan, session)?);
    }
    for scene in names(args).into_iter().filter_map(bench::built_in) {
        rows.push(bench::measure(&scene, &plan, session)?);
    }
    write_stdout(text(&rows, args).as_bytes())?;
    let leaks: u64 = rows.iter().map(|row| row.leaks).sum();
    if leaks > 0 {
        return Err(Failure::NoAnswer(format!(
            "{leaks} rays met contradicting cells: a defect of octrace, worth reporting"
        )));
    }
    trouble.map_or(Ok(()), Err)
}

fn plan(args: &BenchArgs) -> Plan {
    Plan {
        repeat: args.repeat,
        threads: args.trace.threads(),
        size_px: (args.size.width_px, args.size.height_px),
        read: args.read.options(),
        // Every scene has its own import tolerance.
        tracer: args.trace.options(0.0),
    }
}

fn from_file(file: &Path, args: &BenchArgs, session: &Session) -> Result<BenchScene, Failure> {
    let input = input::open(file, &args.read, session)?;
    let name = input.source.name().to_owned();
    let Some(loaded) = input.loaded else {
        // What is wrong with many files would bury what was measured.
        let errors = input.diagnostics.iter().filter(|found| found.severity == Severity::Error).count();
        let errors = if errors == 1 { "it has 1 error".to_owned() } else { format!("it has {errors} errors") };
        return Err(Failure::NoAnswer(format!("{name} is left out: {errors}, which `octrace check` lists")));
    };
    Ok(BenchScene { name, scene: loaded.scene, source: Some(input.source) })
}

/// The scenes asked for, each once; all where neither scenes nor files are named.
fn names(args: &BenchArgs) -> Vec<&'static str> {
    let mut names: Vec<&str> = Vec::new();
    for name in args.scenes.iter().flat_map(|scenes| scenes.0.iter().copied()) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    if names.is_empty() && args.files.is_empty() { bench::default_names(args.quick) } else { names }
}

fn text(rows: &[Row], args: &BenchArgs) -> String {
    if args.json { serde_json::to_string_pretty(rows).expect("rows are plain data") + "\n" } else { bench::table(rows) }
}
