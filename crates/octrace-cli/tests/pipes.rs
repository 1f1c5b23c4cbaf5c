//! Ctrl-C and closed pipes, on the real program.

#![cfg(unix)]

mod common;

use common::{Folder, PLATE, Run};
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::io::{BufRead, BufReader, Read};

#[test]
fn a_closed_pipe_ends_it_quietly() {
    let folder = Folder::with(&[("plate.csg", PLATE)]);
    for words in [
        &["render", "plate.csg", "-o", "-", "--size=64x48"][..],
        &["inspect", "plate.csg", "--tree", "--program"],
        &["measure", "plate.csg", "--tolerance=1e-2"],
        &["check", "--json", "plate.csg"],
    ] {
        let mut child = folder.command(words).spawn().unwrap();
        drop(child.stdout.take());
        let run = Run::from(child.wait_with_output().unwrap());
        assert_eq!((run.code, run.stderr.contains("error")), (0, false), "{words:?}: {}", run.stderr);
    }
}

#[test]
fn nobody_listening_to_messages_is_no_reason_to_fail() {
    let folder = Folder::with(&[("a.csg", "roof();\ncube(1);")]);
    let words = ["render", "a.csg", "--skip-unsupported", "--size=64x48"];
    let mut child = folder.command(&words).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_eq!(folder.names(), ["a.csg", "a.png"]);
}

/// The signal is sent when the program says that it left something out: then it has read the file, and the picture
/// takes hours.
#[test]
fn ctrl_c_while_rendering_leaves_nothing_behind() {
    let folder = Folder::with(&[("a.csg", "roof();\nsphere($fn = 0, $fa = 12, $fs = 2, r = 1);"), ("a.png", "old")]);
    for output in ["a.png", "new.png"] {
        let words = ["render", "a.csg", "--skip-unsupported", "--size=4000x4000", "--samples=1024", "-o", output];
        let mut child = folder.command(&words).spawn().unwrap();
        let mut stderr = BufReader::new(child.stderr.take().unwrap());
        let mut line = String::new();
        while !line.contains("a.csg: ") {
            line.clear();
            assert_ne!(stderr.read_line(&mut line).unwrap(), 0, "it ended early");
        }
        kill(Pid::from_raw(child.id() as i32), Signal::SIGINT).unwrap();
        let mut rest = String::new();
        stderr.read_to_string(&mut rest).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(130), "{rest}");
        assert_eq!(folder.names(), ["a.csg", "a.png"]);
        assert_eq!(std::fs::read(folder.path("a.png")).unwrap(), b"old");
    }
}

/// The signal is sent when the first of two scenes is done; the second, which takes far longer to build, takes minutes.
#[test]
fn ctrl_c_while_studying_leaves_nothing_behind() {
    let endless = ["--scenes=chain-4,balls-100000", "--traversals=samet", "--size=8x6", "--repeat=300"];
    let folder = Folder::with(&[("study.html", "old")]);
    let mut child = folder.command(&[&["study", "--json=study.json"], &endless[..]].concat()).spawn().unwrap();
    let mut stderr = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    while !line.contains("1 of 2: chain-4") {
        line.clear();
        assert_ne!(stderr.read_line(&mut line).unwrap(), 0, "it ended early");
    }
    kill(Pid::from_raw(child.id() as i32), Signal::SIGINT).unwrap();
    let mut rest = String::new();
    stderr.read_to_string(&mut rest).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{rest}");
    assert_eq!(folder.names(), ["study.html"]);
    assert_eq!(std::fs::read(folder.path("study.html")).unwrap(), b"old");
}

/// While it waits for standard input there is nothing to tidy up: it just ends.
#[test]
fn ctrl_c_while_reading() {
    let folder = Folder::with(&[]);
    let mut child = folder.command(&["check", "-"]).stdin(std::process::Stdio::piped()).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    // More than any pipe holds: when it is through, the program is reading.
    std::io::Write::write_all(&mut stdin, &vec![b' '; 4 << 20]).unwrap();
    kill(Pid::from_raw(child.id() as i32), Signal::SIGINT).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
}
