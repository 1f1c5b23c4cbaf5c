//! How the race talks with the programs that run in it: commands on standard input, one JSON object a line on standard
//! output. See `../README.md`.

use cpu_time::ProcessTime;
use std::error::Error;
use std::io::BufRead;
use std::path::PathBuf;
use std::time::Instant;

/// What goes wrong ends the program, with a message.
pub type Outcome<T = ()> = Result<T, Box<dyn Error>>;

/// What the race may ask for.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// The camera's rays.
    Frame,
    /// A shadow ray to the first light from every hit that faces it.
    Shadow,
    /// Distance and normal of every pixel, into a file.
    Dump(PathBuf),
}

/// Measures processor time and time on the wall.
pub struct Clock {
    cpu: ProcessTime,
    wall: Instant,
}

impl Clock {
    /// Starts.
    pub fn start() -> Self {
        Self { cpu: ProcessTime::now(), wall: Instant::now() }
    }

    /// Prints what went by, and perhaps how many rays were traced.
    pub fn print(&self, rays: Option<u64>) {
        let rays = rays.map(|rays| format!(", \"rays\": {rays}")).unwrap_or_default();
        let (cpu, wall) = (self.cpu.elapsed().as_secs_f64(), self.wall.elapsed().as_secs_f64());
        println!("{{\"cpu_s\": {cpu:.9}, \"wall_s\": {wall:.9}{rays}}}");
    }
}

/// Obeys commands until there are no more.
pub fn serve(mut obey: impl FnMut(Command) -> Outcome) -> Outcome {
    for line in std::io::stdin().lock().lines() {
        let line = line?;
        let command = match line.split_once(' ') {
            None if line == "frame" => Command::Frame,
            None if line == "shadow" => Command::Shadow,
            Some(("dump", path)) => Command::Dump(path.into()),
            _ => return Err(format!("no command is called {line:?}").into()),
        };
        obey(command)?;
    }
    Ok(())
}

/// The only argument.
pub fn argument() -> Outcome<PathBuf> {
    let mut words = std::env::args_os().skip(1);
    match (words.next(), words.next()) {
        (Some(path), None) => Ok(path.into()),
        _ => Err("name one file".into()),
    }
}

/// Numbers as they are in memory, for the race to read.
pub fn write_floats(path: &std::path::Path, values: &[f32]) -> Outcome {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_ne_bytes()).collect();
    Ok(std::fs::write(path, bytes)?)
}
