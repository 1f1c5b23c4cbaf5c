//! The real program on real files, in a folder of its own.

#![allow(dead_code, reason = "not every test file uses everything")]

use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A block with a hole, as OpenSCAD dumps it.
pub const PLATE: &str = "\
difference() {
	cube(size = [40, 30, 5], center = false);
	multmatrix([[1, 0, 0, 20], [0, 1, 0, 15], [0, 0, 1, 0], [0, 0, 0, 1]]) {
		cylinder($fn = 0, $fa = 12, $fs = 2, h = 5, r1 = 6, r2 = 6, center = false);
	}
}
";

/// A folder that vanishes with the value, to run the program in.
pub struct Folder(tempfile::TempDir);

/// What became of one run.
pub struct Run {
    /// Exit code.
    pub code: i32,
    /// Standard output.
    pub stdout: Vec<u8>,
    /// Standard error.
    pub stderr: String,
}

impl Folder {
    /// A folder with these files.
    pub fn with(files: &[(&str, &str)]) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        for (name, text) in files {
            fs::write(folder.path(name), text).unwrap();
        }
        folder
    }

    /// A path in the folder.
    pub fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.0.path().join(name)
    }

    /// The names of all files, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The program, to be run in the folder.
    pub fn command(&self, words: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_octrace"));
        command.current_dir(self.0.path()).args(words).env_remove("CLICOLOR_FORCE").env_remove("COLUMNS");
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    /// Runs the program.
    pub fn run(&self, words: &[&str]) -> Run {
        self.command(words).output().unwrap().into()
    }

    /// Runs the program with this text on standard input.
    pub fn run_with_input(&self, words: &[&str], input: &str) -> Run {
        let mut child = self.command(words).stdin(Stdio::piped()).spawn().unwrap();
        // The program may well end without reading.
        let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
        child.wait_with_output().unwrap().into()
    }
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code().unwrap_or(-1),
            stdout: output.stdout,
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

impl Run {
    /// The run, if it ended with this code.
    #[track_caller]
    pub fn expect(self, code: i32) -> Self {
        assert_eq!(self.code, code, "{}", self.stderr);
        self
    }

    /// Standard output as text.
    pub fn text(&self) -> &str {
        std::str::from_utf8(&self.stdout).unwrap()
    }

    /// Standard output as JSON.
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_slice(&self.stdout).unwrap()
    }
}

/// A decoded PNG picture.
pub struct Picture {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Channels.
    pub color: png::ColorType,
    /// Bits per channel.
    pub depth: png::BitDepth,
    /// Samples, row by row; two bytes each, high byte first, where there are 16 bits.
    pub samples: Vec<u8>,
}

impl Picture {
    /// Decodes a PNG file's content.
    pub fn decode(bytes: &[u8]) -> Self {
        let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().unwrap();
        let mut samples = vec![0; reader.output_buffer_size().unwrap()];
        let frame = reader.next_frame(&mut samples).unwrap();
        Self { size: (frame.width, frame.height), color: frame.color_type, depth: frame.bit_depth, samples }
    }

    /// Reads a PNG file.
    pub fn open(path: &Path) -> Self {
        Self::decode(&fs::read(path).unwrap())
    }

    /// The bytes of one pixel.
    pub fn pixel(&self, x: u32, y: u32) -> &[u8] {
        let bytes = self.samples.len() / (self.size.0 * self.size.1) as usize;
        let start = (y * self.size.0 + x) as usize * bytes;
        &self.samples[start..start + bytes]
    }
}
