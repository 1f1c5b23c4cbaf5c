//! One file per command.

mod bench;
mod check;
mod figures;
mod inspect;
mod measure;
mod render;
mod study;

use crate::args::{BenchArgs, CheckArgs, Command, FiguresArgs, InspectArgs, MeasureArgs, RenderArgs, StudyArgs};
use crate::diagnostics::Show;
use crate::failure::Failure;
use crate::output::say_error;
use crate::session::Session;

/// Runs a command; the answer is the process's exit code.
pub fn run(command: &Command) -> u8 {
    let (Command::Render(RenderArgs { quiet, .. })
    | Command::Check(CheckArgs { quiet, .. })
    | Command::Measure(MeasureArgs { quiet, .. })
    | Command::Inspect(InspectArgs { quiet, .. })
    | Command::Figures(FiguresArgs { quiet, .. })
    | Command::Study(StudyArgs { quiet, .. })
    | Command::Bench(BenchArgs { quiet, .. })) = command;
    let session = Session::start(if *quiet { Show::Errors } else { Show::All });
    let result = match command {
        Command::Render(args) => render::run(args, &session),
        Command::Check(args) => check::run(args, &session),
        Command::Measure(args) => measure::run(args, &session),
        Command::Inspect(args) => inspect::run(args, &session),
        Command::Figures(args) => figures::run(args, &session),
        Command::Study(args) => study::run(args, &session),
        Command::Bench(args) => bench::run(args, &session),
    };
    let Err(failure) = result else { return 0 };
    match failure {
        Failure::Interrupted => session.interrupt.announce(),
        _ if failure.wants_message() => say_error(&failure.to_string()),
        _ => {}
    }
    failure.exit_code()
}
