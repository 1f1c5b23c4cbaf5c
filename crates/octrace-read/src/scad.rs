//! `.scad` sources, evaluated by the `openscad` program.

use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The environment variable that names the program, where it is not `openscad` on the search path.
pub const PROGRAM_VARIABLE: &str = "OPENSCAD";

/// What OpenSCAD made of a source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScadOutput {
    /// The dump, to be read as a `.csg` file.
    pub csg_text: String,
    /// The folder that file names in the dump are relative to.
    pub base_dir: PathBuf,
    /// What OpenSCAD warned of, line by line as it wrote it.
    pub warnings: Vec<String>,
    /// What the source printed with `echo`, line by line as OpenSCAD wrote it.
    pub echoes: Vec<String>,
}

/// Why a source could not be evaluated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ScadError {
    /// There is no such program.
    #[error(
        "`{program}` is needed to evaluate .scad files, but it is not installed\n\
         install it (Debian, Ubuntu: `apt install openscad`; macOS: `brew install openscad`; others: \
         https://openscad.org/downloads), or set {PROGRAM_VARIABLE} to where it is"
    )]
    NotInstalled {
        /// What was looked for.
        program: String,
    },
    /// The program, or a temporary file for its output, could not be used.
    #[error("cannot run `{program}`")]
    Io {
        /// What was to run.
        program: String,
        /// Why not.
        #[source]
        source: io::Error,
    },
    /// OpenSCAD found errors in the source.
    #[error("OpenSCAD cannot evaluate `{}`:\n{message}", path.display())]
    Rejected {
        /// The source.
        path: PathBuf,
        /// What OpenSCAD said.
        message: String,
    },
    /// What OpenSCAD wrote is not text.
    #[error("`{program}` wrote a dump that is not UTF-8")]
    NotText {
        /// What ran.
        program: String,
    },
}

/// Has OpenSCAD evaluate the source at `path`, with `defines` (such as `n = 3`) passed on as `-D`.
///
/// # Errors
/// If OpenSCAD is not installed, does not run, or finds an error in the source: see [`ScadError`].
pub fn evaluate(path: &Path, defines: &[String]) -> Result<ScadOutput, ScadError> {
    let program = std::env::var_os(PROGRAM_VARIABLE).filter(|p| !p.is_empty()).unwrap_or_else(|| "openscad".into());
    evaluate_with(&program, path, defines)
}

/// The same, with a program of the caller's choice.
///
/// # Errors
/// As for [`evaluate`].
pub fn evaluate_with(program: &OsStr, path: &Path, defines: &[String]) -> Result<ScadOutput, ScadError> {
    let shown = || program.to_string_lossy().into_owned();
    let io_error = |source| ScadError::Io { program: shown(), source };
    // The folder goes, with all that is in it, when this function ends in whatever way.
    let folder = tempfile::tempdir().map_err(io_error)?;
    let csg_path = folder.path().join("out.csg");
    let output = Command::new(program)
        .arg("-o")
        .arg(&csg_path)
        .args(defines.iter().flat_map(|define| ["-D", define]))
        .arg(as_file_argument(path))
        .stdin(Stdio::null())
        .output()
        .map_err(|source| match source.kind() {
            io::ErrorKind::NotFound => ScadError::NotInstalled { program: shown() },
            _ => io_error(source),
        })?;
    let said = String::from_utf8_lossy(&output.stderr);
    let starting_with = |prefix: &str| -> Vec<String> {
        said.lines().filter(|line| line.starts_with(prefix)).map(str::to_owned).collect()
    };
    // OpenSCAD 2021.01 reports a failed assertion, writes what it has, and exits with success. A font or a file that it
    // cannot find stops nothing.
    let is_harmless = |line: &&str| line.starts_with("ERROR: Can't ");
    let failed = !output.status.success() || said.lines().any(|line| line.starts_with("ERROR:") && !is_harmless(&line));
    let rejected = |message: String| ScadError::Rejected { path: path.to_owned(), message };
    if failed {
        let message = said.trim();
        return Err(rejected(if message.is_empty() {
            format!("it ended with {}", output.status)
        } else {
            message.to_owned()
        }));
    }
    let csg = match std::fs::read(&csg_path) {
        Ok(csg) => csg,
        Err(source) if source.kind() == io::ErrorKind::NotFound => return Err(rejected(said.trim().to_owned())),
        Err(source) => return Err(io_error(source)),
    };
    Ok(ScadOutput {
        csg_text: String::from_utf8(csg).map_err(|_| ScadError::NotText { program: shown() })?,
        base_dir: path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_owned(),
        warnings: said
            .lines()
            .filter(|line| ["WARNING:", "DEPRECATED:", "TRACE:", "ERROR:"].iter().any(|p| line.starts_with(p)))
            .map(str::to_owned)
            .collect(),
        echoes: starting_with("ECHO:"),
    })
}

/// A path that a program cannot take for an option.
fn as_file_argument(path: &Path) -> PathBuf {
    match path.to_string_lossy().starts_with('-') {
        true => Path::new(".").join(path),
        false => path.to_owned(),
    }
}
