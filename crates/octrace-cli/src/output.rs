//! Where results go: a file that is replaced only when complete, or standard output.
//!
//! Nothing is on the disk until [`Destination::write`], which writes beside the file that is meant and renames at the
//! end. So an error or Ctrl-C before that leaves nothing behind, and readers never see half a file.

use crate::failure::Failure;
use crate::interrupt::Interrupt;
use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// Where a result goes.
#[derive(Clone, Debug, PartialEq)]
pub enum Destination {
    /// Standard output.
    Stdout,
    /// A regular file, existing or not. Symbolic links are resolved, so that the link stays and its target is replaced.
    File(PathBuf),
    /// Something that is there and is no regular file, such as `/dev/null` or a named pipe: written to as it is.
    Special(PathBuf),
}

impl Destination {
    /// Checks that `path` can be written to, without leaving a trace; `-` is standard output.
    pub fn new(path: &Path) -> Result<Self, Failure> {
        if path == Path::new("-") {
            return if io::stdout().is_terminal() {
                Err(Failure::Usage("on a terminal that is of no use: redirect standard output, or name a file".into()))
            } else {
                Ok(Self::Stdout)
            };
        }
        let blocked =
            |why: &str| Err(Failure::File { verb: "write", what: path.display().to_string(), why: why.to_owned() });
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => return Err(Failure::folder("write", path)),
            Ok(found) if !found.is_file() => return Ok(Self::Special(path.to_owned())),
            Ok(found) if found.permissions().readonly() => return blocked("it is write-protected"),
            Ok(_) => {
                let target = fs::canonicalize(path).map_err(|e| Failure::file("write", path, &e))?;
                return Self::in_writable_folder(path, target);
            }
            Err(e) if e.kind() == io::ErrorKind::NotFound => {}
            Err(e) => return Err(Failure::file("write", path, &e)),
        }
        if path.file_name().is_none() || path.as_os_str().to_string_lossy().ends_with(std::path::is_separator) {
            return blocked("it names a folder, not a file");
        }
        if !folder_of(path).is_dir() {
            return blocked(&format!("there is no folder {}", folder_of(path).display()));
        }
        Self::in_writable_folder(path, path.to_owned())
    }

    /// A file that is never linked into the folder shows whether one can be.
    fn in_writable_folder(asked_for: &Path, target: PathBuf) -> Result<Self, Failure> {
        match tempfile::tempfile_in(folder_of(&target)) {
            Ok(_) => Ok(Self::File(target)),
            Err(e) => Err(Failure::file("write", asked_for, &e)),
        }
    }

    /// Writes `bytes`, completely or not at all as far as a regular file is concerned. An interrupt that arrives
    /// meanwhile wins: the file stays as it was.
    pub fn write(&self, bytes: &[u8], interrupt: &Interrupt) -> Result<(), Failure> {
        match self {
            Self::Stdout => write_stdout(bytes),
            Self::Special(path) => fs::OpenOptions::new()
                .write(true)
                .open(path)
                .and_then(|mut file| file.write_all(bytes))
                .map_err(|e| Failure::file("write", path, &e)),
            Self::File(path) => {
                let _held_back = interrupt.hold_back();
                replace(path, bytes, interrupt)
            }
        }
    }
}

/// A folder for several results at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Folder(PathBuf);

impl Folder {
    /// Checks that files can be written into the folder at `path`, or that it can be made, without leaving a trace.
    pub fn new(path: &Path) -> Result<Self, Failure> {
        let existing = if path.exists() { path } else { folder_of(path) };
        if !existing.is_dir() {
            let why = if path.exists() { "it is not a folder" } else { "the folder around it is missing" };
            return Err(Failure::File { verb: "write", what: path.display().to_string(), why: why.into() });
        }
        match tempfile::tempfile_in(existing) {
            Ok(_) => Ok(Self(path.to_owned())),
            Err(e) => Err(Failure::file("write", path, &e)),
        }
    }

    /// Writes the files, each completely or not at all, and none if one of them cannot be written to.
    pub fn write(&self, files: &[(&str, &[u8])], interrupt: &Interrupt) -> Result<(), Failure> {
        if interrupt.happened() {
            return Err(Failure::Interrupted);
        }
        if !self.0.exists() {
            fs::create_dir(&self.0).map_err(|e| Failure::file("write", &self.0, &e))?;
        }
        let destinations: Vec<Destination> =
            files.iter().map(|(name, _)| Destination::new(&self.0.join(name))).collect::<Result<_, Failure>>()?;
        std::iter::zip(destinations, files).try_for_each(|(file, (_, bytes))| file.write(bytes, interrupt))
    }
}

/// Writes data to standard output, at once.
pub fn write_stdout(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    stdout.write_all(bytes).and_then(|()| stdout.flush()).map_err(|e| Failure::stdout(&e))
}

/// Says something on standard error. When nobody listens there is nobody to tell.
pub fn say(text: &str) {
    let mut stderr = anstream::stderr().lock();
    let _ = writeln!(stderr, "{text}");
}

/// Empties the line that the cursor is in, if standard error is a terminal.
pub fn clear_line() {
    let mut stderr = io::stderr().lock();
    if stderr.is_terminal() {
        let _ = write!(stderr, "\r\x1b[K");
    }
}

/// Says that something went wrong, as clap does for wrong arguments.
pub fn say_error(text: &str) {
    let style = anstyle::AnsiColor::Red.on_default().bold();
    say(&format!("{style}error:{style:#} {text}"));
}

fn replace(path: &Path, bytes: &[u8], interrupt: &Interrupt) -> Result<(), Failure> {
    let failed = |e: &io::Error| Failure::file("write", path, e);
    let mut builder = tempfile::Builder::new();
    builder.prefix(".octrace-").suffix(".part");
    // The file that is replaced keeps its mode; a new one gets what the umask leaves.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let fresh = fs::Permissions::from_mode(0o666);
        builder.permissions(fs::metadata(path).map_or(fresh, |found| found.permissions()));
    }
    let mut part = builder.tempfile_in(folder_of(path)).map_err(|e| failed(&e))?;
    part.write_all(bytes).map_err(|e| failed(&e))?;
    if interrupt.happened() {
        return Err(Failure::Interrupted);
    }
    part.persist(path).map_err(|e| failed(&e.error))?;
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files_in(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn asking_leaves_no_trace_and_writing_leaves_one_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let destination = Destination::new(&path).unwrap();
        assert!(files_in(folder.path()).is_empty());
        destination.write(b"one", &Interrupt::never()).unwrap();
        destination.write(b"two", &Interrupt::never()).unwrap();
        assert_eq!(files_in(folder.path()), ["a.png"]);
        assert_eq!(fs::read(&path).unwrap(), b"two");
    }

    #[test]
    fn an_interrupt_keeps_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        fs::write(&path, "old").unwrap();
        let interrupt = Interrupt::never();
        interrupt.token().cancel();
        let result = Destination::new(&path).unwrap().write(b"new", &interrupt);
        assert!(matches!(result, Err(Failure::Interrupted)));
        assert_eq!(files_in(folder.path()), ["a.png"]);
        assert_eq!(fs::read(&path).unwrap(), b"old");
    }

    #[test]
    fn what_cannot_be_written_is_said_before_the_work() {
        let folder = tempfile::tempdir().unwrap();
        let refusal = |path: &Path| Destination::new(path).unwrap_err().to_string();
        assert!(refusal(folder.path()).ends_with("it is a folder"));
        assert!(refusal(&folder.path().join("none/a.png")).contains("there is no folder"));
        assert!(refusal(&folder.path().join("new/")).contains("names a folder"));
    }

    #[test]
    fn a_folder_is_made_when_there_is_something_to_write() {
        let around = tempfile::tempdir().unwrap();
        let path = around.path().join("new");
        let folder = Folder::new(&path).unwrap();
        assert!(files_in(around.path()).is_empty());
        folder.write(&[("a.svg", b"a"), ("b.svg", b"b")], &Interrupt::never()).unwrap();
        assert_eq!(files_in(&path), ["a.svg", "b.svg"]);
        fs::create_dir(path.join("c.svg")).unwrap();
        assert!(folder.write(&[("a.svg", b"new"), ("c.svg", b"c")], &Interrupt::never()).is_err());
        assert_eq!(fs::read(path.join("a.svg")).unwrap(), b"a", "all or nothing");
        let refusal = |path: &Path| Folder::new(path).unwrap_err().to_string();
        assert!(refusal(&path.join("a.svg")).contains("it is not a folder"));
        assert!(refusal(&path.join("no/new")).contains("is missing"));
    }

    #[cfg(unix)]
    #[test]
    fn links_and_modes_survive() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (real, link) = (folder.path().join("real.png"), folder.path().join("link.png"));
        fs::write(&real, "old").unwrap();
        fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        Destination::new(&link).unwrap().write(b"new", &Interrupt::never()).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&real).unwrap(), b"new");
        assert_eq!(fs::metadata(&real).unwrap().permissions().mode() & 0o777, 0o640);
        assert_eq!(Destination::new(Path::new("/dev/null")).unwrap(), Destination::Special("/dev/null".into()));
    }
}
