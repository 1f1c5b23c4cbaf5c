//! `.scad` sources through the `openscad` program: the real one where it is installed, stand-ins for what it may do.

use octrace_read::scad::{ScadError, ScadOutput, evaluate_with};
use octrace_read::{Folder, ReadOptions, Source, read_scene};
use std::path::{Path, PathBuf};

fn folder_with(name: &str, text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let path = folder.path().join(name);
    std::fs::write(&path, text).expect("a file can be written");
    (folder, path)
}

/// Runs the real program; `None`, and a word about it, where it is not installed.
fn evaluate(text: &str, defines: &[&str]) -> Option<Result<ScadOutput, ScadError>> {
    let (_folder, path) = folder_with("model.scad", text);
    let defines: Vec<String> = defines.iter().map(|&d| d.to_owned()).collect();
    match evaluate_with("openscad".as_ref(), &path, &defines) {
        Err(ScadError::NotInstalled { .. }) => {
            eprintln!("SKIPPED: openscad is not installed");
            None
        }
        result => Some(result),
    }
}

#[test]
fn a_program_becomes_a_dump() {
    let text = "n = 2; echo(\"n\", n); for (i = [0 : n]) translate([i, 0, 0]) cube(1); cube(nothing);";
    let Some(result) = evaluate(text, &["n = 4"]) else { return };
    let output = result.expect("it can be evaluated");
    assert_eq!(output.csg_text.matches("cube").count(), 6);
    assert_eq!(output.echoes, ["ECHO: \"n\", 4"]);
    assert!(output.warnings.len() == 1 && output.warnings[0].contains("nothing"), "{:?}", output.warnings);
    let loaded = read_scene(&Source::new("model.csg", output.csg_text), &ReadOptions::default());
    assert_eq!(loaded.value.expect("a scene").leaves, 6);
}

#[test]
fn errors_of_the_program_are_passed_on() {
    for text in ["cube(1", "assert(false, \"too thin\");", "cube(1); assert(1 > 2);"] {
        let Some(result) = evaluate(text, &[]) else { return };
        let Err(ScadError::Rejected { message, path }) = result else { panic!("{text}: {result:?}") };
        assert!(message.contains("ERROR"), "{message}");
        assert!(path.ends_with("model.scad"));
    }
}

/// OpenSCAD calls a font that is not there an error, and goes on.
#[test]
fn what_stops_nothing_is_a_warning() {
    let Some(result) = evaluate("use <gone.ttf>\ncube(1);", &[]) else { return };
    let output = result.expect("it can be evaluated");
    assert!(output.csg_text.contains("cube"), "{}", output.csg_text);
    assert!(output.warnings.iter().any(|line| line.contains("gone.ttf")), "{:?}", output.warnings);
}

#[test]
fn a_file_that_is_not_there_is_an_error() {
    let missing = Path::new("/nonexistent/model.scad");
    match evaluate_with("openscad".as_ref(), missing, &[]) {
        Err(ScadError::NotInstalled { .. }) => eprintln!("SKIPPED: openscad is not installed"),
        Err(ScadError::Rejected { .. }) => {}
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_missing_program_gets_a_hint() {
    let (_folder, path) = folder_with("model.scad", "cube(1);");
    let error = evaluate_with("/nonexistent/openscad".as_ref(), &path, &[]).expect_err("there is no such program");
    assert!(matches!(error, ScadError::NotInstalled { .. }));
    let message = error.to_string();
    assert!(message.contains("/nonexistent/openscad") && message.contains("apt install openscad"), "{message}");
}

#[cfg(unix)]
#[test]
fn a_program_that_misbehaves_is_no_danger() {
    use std::os::unix::fs::PermissionsExt;
    let run = |script: &str| {
        let (_folder, program) = folder_with("openscad", &format!("#!/bin/sh\n{script}\n"));
        let executable = std::fs::Permissions::from_mode(0o755);
        std::fs::set_permissions(&program, executable).expect("a file can be made executable");
        loop {
            let result = evaluate_with(program.as_os_str(), Path::new("-model.scad"), &["a = 1".to_owned()]);
            // A process that another test starts just now may still hold the script open for writing, for a moment.
            let is_busy = |error: &std::io::Error| error.kind() == std::io::ErrorKind::ExecutableFileBusy;
            if !matches!(&result, Err(ScadError::Io { source, .. }) if is_busy(source)) {
                return result;
            }
        }
    };
    assert!(matches!(run("exit 3"), Err(ScadError::Rejected { message, .. }) if message.contains('3')));
    assert!(matches!(run("exit 0"), Err(ScadError::Rejected { .. })), "no dump was written");
    assert!(matches!(run("printf '\\377' > \"$2\""), Err(ScadError::NotText { .. })));
    let output = run("echo \"$3|$4|$5\" > \"$2\"").expect("a dump was written");
    assert_eq!(output.csg_text, "-D|a = 1|./-model.scad\n");
}

/// Every example that comes with OpenSCAD is evaluated and read, with the files that it names.
#[test]
fn the_examples_of_openscad_are_read() {
    let examples = Path::new("/usr/share/openscad/examples");
    let Ok(folders) = std::fs::read_dir(examples) else {
        eprintln!("SKIPPED: no examples at {}", examples.display());
        return;
    };
    let mut read = 0;
    for folder in folders {
        let folder = folder.expect("the folder can be listed").path();
        for entry in std::fs::read_dir(&folder).into_iter().flatten() {
            let path = entry.expect("the folder can be listed").path();
            if path.extension() != Some("scad".as_ref()) {
                continue;
            }
            let output = match evaluate_with("openscad".as_ref(), &path, &[]) {
                Err(ScadError::NotInstalled { .. }) => return eprintln!("SKIPPED: openscad is not installed"),
                result => result.expect("an example is sound"),
            };
            assert_eq!(output.base_dir, folder);
            let source = Source::new("example.csg", output.csg_text).with_assets(Folder(output.base_dir));
            let checked = read_scene(&source, &ReadOptions::default());
            // One of them only prints.
            let is_solid = !path.ends_with("echo.scad");
            assert_eq!(checked.value.is_some(), is_solid, "{}: {:?}", path.display(), checked.diagnostics);
            read += 1;
        }
    }
    assert!(read >= 40, "{read} examples");
}
