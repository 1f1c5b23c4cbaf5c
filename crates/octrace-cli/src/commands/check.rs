//! `octrace check`: what is wrong with files, and what in them is not supported.

use crate::args::CheckArgs;
use crate::diagnostics::{self, JsonDiagnostic};
use crate::failure::Failure;
use crate::input;
use crate::output::{say_error, write_stdout};
use crate::session::Session;

/// Checks all files, even after one that cannot be read; fails if any has errors.
pub fn run(args: &CheckArgs, session: &Session) -> Result<(), Failure> {
    let mut findings: Vec<JsonDiagnostic> = Vec::new();
    let mut unreadable = None;
    let mut errors = false;
    for file in &args.files {
        let input = match input::open(file, &args.read, session) {
            Ok(input) => input,
            Err(Failure::Interrupted) => return Err(Failure::Interrupted),
            Err(failure) => {
                if let Some(earlier) = unreadable.replace(failure) {
                    say_error(&earlier.to_string());
                }
                continue;
            }
        };
        errors |= input.loaded.is_none();
        if args.json {
            findings.extend(diagnostics::json(&input.source, &input.diagnostics));
        } else {
            input.report(session);
            if input.diagnostics.is_empty() {
                session.remark(&format!("{}: nothing to complain of", input.source.name()));
            }
        }
    }
    if args.json {
        let text = serde_json::to_string_pretty(&findings).expect("findings are plain data");
        write_stdout(format!("{text}\n").as_bytes())?;
    }
    match unreadable {
        Some(failure) => Err(failure),
        None if errors => Err(Failure::Input),
        None => Ok(()),
    }
}
