//! The grammar of OpenSCAD's `.csg` dumps, which is also that of our own `.oct` scenes: text to [`Ast`] and back.
//!
//! ```text
//! file  := item*
//! item  := node | ";"
//! node  := mod* name "(" args ")" ( ";" | "{" item* "}" | node )
//! mod   := "%" | "#" | "!" | "*"
//! args  := [ arg { "," arg } [ "," ] ]
//! arg   := [ name "=" ] value
//! value := number | "true" | "false" | "undef" | string | "[" [ value { "," value } [ "," ] ] "]"
//! ```
//!
//! Nothing here knows what a cube is. Nothing recurses either: any depth of nodes and vectors is only a longer array.

mod ast;
mod build;
mod cursor;
mod locate;
mod parse;
mod print;
mod repeats;
mod value;

pub(crate) use ast::Step;
pub use ast::{Arg, Ast, Modifiers, NodeId, Rows, Siblings, Value, View};
pub use build::AstBuilder;
pub use locate::element_range;
pub use parse::parse;
pub(crate) use parse::parse_into;
pub use print::print;
