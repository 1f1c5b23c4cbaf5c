//! From a file's name to a scene, with everything there is to say about it.

use crate::args::ReadArgs;
use crate::diagnostics;
use crate::failure::Failure;
use crate::session::Session;
use octrace_read::scad::{self, ScadError};
use octrace_read::{Diagnostic, Folder, Loaded, Source, read_scene};
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// A file that was read, whatever became of it.
pub struct Input {
    /// Its text.
    pub source: Source,
    /// What there is to say about it.
    pub diagnostics: Vec<Diagnostic>,
    /// What it describes, unless it has errors.
    pub loaded: Option<Loaded>,
    /// The OpenSCAD program that the text is the dump of, if it is one.
    program: Option<PathBuf>,
}

impl Input {
    /// Says what there is to say about it, to people.
    pub fn report(&self, session: &Session) {
        diagnostics::print(&self.source, &self.diagnostics, session.show);
        if let (Some(program), false) = (&self.program, self.diagnostics.is_empty()) {
            let name = program.display();
            session.remark(&format!("note: these lines are of the dump that `openscad -o dump.csg {name}` writes"));
        }
    }
}

/// Whether a file's name says that it describes a solid.
pub fn is_model(file: &Path) -> bool {
    file.extension().is_some() && language(file).is_ok()
}

/// Which language a file is in, going by its name.
enum Language {
    /// OpenSCAD's dumps and our own scenes, which are one grammar.
    Tree,
    /// OpenSCAD's programs.
    Scad,
    /// What `import` takes: meshes and drawings.
    Part,
}

/// A tree that imports the file.
fn import(file: &Path) -> Result<Source, Failure> {
    // Whether it can be read is said better here than there.
    let content = bytes(file)?;
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let text = format!("import(file = {name:?});");
    drop(content);
    Ok(Source::new(format!("{} (import)", file.display()), text).with_assets(Folder::of(file)))
}

/// Reads and checks a file; `-` is standard input.
pub fn open(file: &Path, args: &ReadArgs, session: &Session) -> Result<Input, Failure> {
    let language = language(file)?;
    let source = match language {
        Language::Tree if !args.define.is_empty() => {
            let name = file.display();
            return Err(Failure::Usage(format!("-D is for .scad files: {name} has no variables left to set")));
        }
        Language::Tree => {
            // Whoever types the input knows what is waited for.
            let _busy = (file != Path::new("-")).then(|| session.busy("reading"));
            Source::new(shown_name(file), bytes(file)?).with_assets(Folder::of(file))
        }
        Language::Scad => evaluate(file, args, session)?,
        Language::Part => import(file)?,
    };
    let program = matches!(language, Language::Scad).then(|| file.to_owned());
    let _busy = session.busy("reading");
    let checked = read_scene(&source, &args.options());
    Ok(Input { source, diagnostics: checked.diagnostics, loaded: checked.value, program })
}

/// Reads a file, says what there is to say about it, and goes on only if it has no errors.
pub fn load(file: &Path, args: &ReadArgs, session: &Session) -> Result<(Source, Loaded), Failure> {
    let input = open(file, args, session)?;
    input.report(session);
    let loaded = input.loaded.ok_or(Failure::Input)?;
    Ok((input.source, loaded))
}

/// Has OpenSCAD turn a program into a dump, passing on what it says meanwhile.
fn evaluate(file: &Path, args: &ReadArgs, session: &Session) -> Result<Source, Failure> {
    // A missing file is our message to give, not OpenSCAD's.
    if let Err(e) = fs::File::open(file) {
        return Err(Failure::file("read", file, &e));
    }
    let evaluated = {
        // Ctrl-C ends OpenSCAD too; the temporary files that it works with are still to be removed.
        let _held_back = session.interrupt.hold_back();
        let _busy = session.busy("OpenSCAD is at work");
        scad::evaluate(file, &args.define)
    };
    if session.interrupt.happened() {
        return Err(Failure::Interrupted);
    }
    let output = evaluated.map_err(|error| match &error {
        ScadError::Rejected { .. } => Failure::NoAnswer(error.to_string()),
        ScadError::Io { source, .. } => {
            Failure::File { verb: "read", what: shown_name(file), why: format!("{error}: {source}") }
        }
        _ => Failure::File { verb: "read", what: shown_name(file), why: error.to_string() },
    })?;
    for line in output.echoes.iter().chain(&output.warnings) {
        session.remark(&diagnostics::printable_text(line));
    }
    let source = Source::new(format!("{} (dump)", file.display()), output.csg_text);
    Ok(source.with_assets(Folder(output.base_dir)))
}

fn language(file: &Path) -> Result<Language, Failure> {
    let extension = file.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    match extension.as_deref() {
        None | Some("csg" | "oct") => Ok(Language::Tree),
        Some("scad") => Ok(Language::Scad),
        Some("stl" | "off" | "obj" | "amf" | "3mf" | "svg" | "dxf") => Ok(Language::Part),
        Some(other) => Err(Failure::NoAnswer(format!(
            "{}: .{other} files are not supported, only .csg, .oct, .scad, meshes (.stl .off .obj .amf .3mf) and drawings (.svg .dxf); to \
             read it as .csg all the same, pass - \
             and feed it through standard input",
            file.display()
        ))),
    }
}

/// The name that messages use.
fn shown_name(file: &Path) -> String {
    if file == Path::new("-") { "<stdin>".into() } else { file.display().to_string() }
}

fn bytes(file: &Path) -> Result<Vec<u8>, Failure> {
    if file == Path::new("-") {
        let mut bytes = Vec::new();
        return match io::stdin().lock().read_to_end(&mut bytes) {
            Ok(_) => Ok(bytes),
            Err(e) => Err(Failure::file("read", Path::new("standard input"), &e)),
        };
    }
    match fs::read(file) {
        Ok(bytes) => Ok(bytes),
        Err(_) if file.is_dir() => Err(Failure::folder("read", file)),
        Err(e) => Err(Failure::file("read", file, &e)),
    }
}
