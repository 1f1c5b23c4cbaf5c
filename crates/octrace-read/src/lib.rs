//! Files in, scenes out: reads OpenSCAD's `.csg` dumps, our own `.oct` scenes and, through the `openscad` program,
//! `.scad` sources.
//!
//! What comes in is a [`Source`]: a name and a text. What goes out is a [`Checked`] value: a [`Loaded`] scene, or not,
//! and a list of [`Diagnostic`]s with their places. Readers print nothing and know nothing of terminals.
//!
//! ```
//! use octrace_read::{ReadOptions, Source, read_scene};
//! let source = Source::new("plate.oct", "difference() { cube([40, 30, 5]); sphere(r = -2); }");
//! let checked = read_scene(&source, &ReadOptions::default());
//! let wrong = &checked.diagnostics[0];
//! assert_eq!(wrong.message, "sphere radius must be greater than zero");
//! assert_eq!(source.line_col(wrong.at.start), (1, 46));
//! ```
//!
//! [`syntax`] turns text into a tree and back; lowering gives the tree its meaning; [`scad`] runs OpenSCAD.

mod assets;
mod diagnostic;
mod lower;
mod options;
pub mod scad;
mod source;
pub mod syntax;

pub use assets::{Assets, Folder, NoAssets};
pub use diagnostic::{Checked, Diagnostic, Severity};
pub use lower::{Loaded, Skipped};
pub use octrace_forms::Tolerance;
pub use options::{CutColor, Facets, Ghosts, Highlights, ReadOptions, UnknownCutColor, UnknownFacets};
pub use source::{Dialect, Source, SourceRange};

use diagnostic::{Collector, has_errors};

/// Reads a `.csg` dump or an `.oct` scene. There is a scene if and only if no diagnostic is an error.
///
/// A few hundred bytes of memory are needed for each node, and 8 for each number of a polyhedron, beside the text.
pub fn read_scene(source: &Source, options: &ReadOptions) -> Checked<Loaded> {
    let mut out = Collector::default();
    let ast = syntax::parse_into(source, &mut out);
    let loaded = lower::lower(&ast, source, options, &mut out);
    let diagnostics = out.finish();
    let value = (!has_errors(&diagnostics)).then_some(loaded);
    Checked { value, diagnostics }
}
