//! The `octrace` command: arguments in, one of the commands run, an exit code out.

mod args;
mod bench;
mod commands;
mod diagnostics;
mod failure;
mod figures;
mod framing;
mod input;
mod interrupt;
mod output;
mod picture;
mod progress;
mod rounding;
mod session;
mod statistics;
mod stats;
mod study;
mod tree;
mod values;

use std::process::ExitCode;
use std::thread;

/// Files may nest deeper than the main thread's stack allows. This is address space: only what is used becomes memory.
const STACK_BYTES: usize = 256 << 20;

/// What Rust's runtime answers after a panic.
const PANICKED: u8 = 101;

fn main() -> ExitCode {
    let arguments = args::Arguments::from_command_line();
    let work = move || commands::run(&arguments.command);
    match thread::Builder::new().name("octrace".into()).stack_size(STACK_BYTES).spawn(work) {
        Ok(worker) => worker.join().unwrap_or(PANICKED).into(),
        Err(error) => {
            output::say_error(&format!("cannot start a thread: {error}"));
            ExitCode::FAILURE
        }
    }
}
