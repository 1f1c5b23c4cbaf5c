//! `octrace study`: the ways to walk an octree, measured side by side, in one page.

use crate::args::StudyArgs;
use crate::failure::Failure;
use crate::input;
use crate::output::Destination;
use crate::session::Session;
use crate::stats::Stopwatch;
use crate::study::{self, Checked, Context, Machine, Plan, SceneReport, Settings, Study, StudyScene};
use octrace_read::Loaded;
use std::path::Path;

/// Studies the files, or the scenes that come with the program.
pub fn run(args: &StudyArgs, session: &Session) -> Result<(), Failure> {
    let out = destination(&args.out, args)?;
    let json = args.json.as_deref().map(|path| destination(path, args)).transpose()?;
    if json.as_ref() == Some(&out) {
        return Err(Failure::Usage("the page and the figures would replace each other: name two places".into()));
    }
    let watch = Stopwatch::start();
    let plan = args.trials.plan();
    let files = args.files.iter().map(|file| from_file(file, args, session)).collect::<Result<Vec<_>, Failure>>()?;
    let built_in = names(args);
    let total = files.len() + built_in.len();
    let scenes = files.into_iter().chain(built_in.into_iter().filter_map(study::built_in));

    let context = Context::new(session);
    let (mut reports, mut memory) = (Vec::new(), Vec::new());
    for (i, scene) in scenes.enumerate() {
        let report = study::study_scene(&scene, &plan, &context)?;
        session.remark(&format!("{} of {total}: {}", i + 1, summary(&report)));
        reports.push(report);
        if plan.chooses(&scene) {
            memory.extend(study::weigh(&scene, &plan, &context)?);
        }
    }
    let checked = reports.iter().fold(Checked::default(), |all, report| all.and(report.checked));
    let study = Study {
        octrace: env!("CARGO_PKG_VERSION"),
        command: command_line(),
        date: study::now(),
        seconds: watch.elapsed(),
        machine: Machine::this(),
        settings: settings(&plan),
        checked,
        scenes: reports,
        memory,
    };
    if let Some(json) = json {
        let text = serde_json::to_string(&study).expect("a study is plain data");
        json.write(format!("{text}\n").as_bytes(), &session.interrupt)?;
    }
    out.write(study::page(&study).as_bytes(), &session.interrupt)?;
    if out != Destination::Stdout {
        session.remark(&format!("{}: the report", args.out.display()));
    }
    verdict(&checked)
}

/// A place to write to that is none of the files read.
fn destination(path: &Path, args: &StudyArgs) -> Result<Destination, Failure> {
    let same = |a: &Path, b: &Path| matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if args.files.iter().any(|file| same(file, path)) {
        return Err(Failure::Usage(format!("the report would replace the file that it is of, {}", path.display())));
    }
    Destination::new(path)
}

/// The scene of a file, under the file's name: without its folder, unless another file in another folder has the same.
fn from_file(file: &Path, args: &StudyArgs, session: &Session) -> Result<StudyScene, Failure> {
    let (source, Loaded { scene, .. }) = input::load(file, &args.read, session)?;
    let is_unique = args.files.iter().filter(|other| other.file_name() == file.file_name()).count() == 1;
    let short = file.file_name().filter(|_| is_unique && file != Path::new("-"));
    let name = short.map_or(source.name().into(), |name| name.to_string_lossy().into_owned());
    Ok(StudyScene::from_file(&name, source.name(), &scene))
}

/// The scenes asked for, each once; the usual ones where neither scenes nor files are named.
fn names(args: &StudyArgs) -> Vec<&'static str> {
    let mut names: Vec<&str> = args.trials.scenes.iter().flat_map(|scenes| scenes.0.iter().copied()).collect();
    let mut seen = Vec::new();
    names.retain(|name| {
        !seen.contains(name) && {
            seen.push(*name);
            true
        }
    });
    if names.is_empty() && args.files.is_empty() {
        names = study::default_names(args.trials.quick).collect();
    }
    names
}

fn settings(plan: &Plan) -> Settings {
    let (width, height) = plan.size_px;
    Settings { width, height, repeat: plan.repeat, threads: Context::THREADS }
}

/// The command as it was given, but for the program's folder.
fn command_line() -> String {
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    std::iter::once("octrace".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}

fn summary(report: &SceneReport) -> String {
    let usual = report.runs.iter().find_map(|run| run.figures.as_ref().filter(|_| run.is_default));
    let Some(usual) = usual else { return report.name.clone() };
    let mut text = format!(
        "{}: {:.0} ns a ray by default, {:.1} times as fast as without octree",
        report.name, usual.ns_per_ray.median, usual.speedup_over_canonical.median
    );
    match &report.advice {
        Some(advice) if advice.is_worth_it => {
            text += &format!("; {:.2} times as fast again with {}", advice.speedup.median, advice.options);
        }
        Some(_) => text += "; no other settings are clearly better",
        None => {}
    }
    text
}

/// A difference from the canonical tracer is the worst that can be found.
fn verdict(checked: &Checked) -> Result<(), Failure> {
    match checked {
        Checked { differing: 0, leaks: 0, .. } => Ok(()),
        Checked { differing, leaks, .. } => Err(Failure::NoAnswer(format!(
            "{differing} hits differ from the canonical ones, and {leaks} rays met contradicting cells: a defect of \
             octrace, worth reporting; the report says where"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_difference_is_a_failure() {
        assert!(verdict(&Checked::default()).is_ok());
        for checked in [Checked { differing: 1, ..Checked::default() }, Checked { leaks: 1, ..Checked::default() }] {
            assert_eq!(verdict(&checked).unwrap_err().exit_code(), 1);
        }
    }
}
