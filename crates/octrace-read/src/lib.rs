//! Readers: files in, [`octrace::Scene`]s out.
mod diagnostic;
mod options;
mod source;
pub mod syntax;

pub use diagnostic::{Checked, Diagnostic, Severity};
pub use options::{Facets, ParseFacetsError, ReadOptions};
pub use source::{Dialect, Source, SourceRange};
