//! From the CSG tree to a program: what is evaluated along rays and simplified in cells.

mod assemble;
mod census;
mod clear;
mod copies;
mod draft;
mod face;
mod faces;
mod facets;
mod intern;
mod items;
mod known;
mod lower;
mod place;
mod prototype;
mod reliable;
mod repeats;
mod simplify;
mod split;
mod swept;
mod text;
mod words;

pub use assemble::{Compiled, compile, compile_unless_cancelled};
pub use copies::Copies;
pub(crate) use draft::Op;
pub use intern::CompileReport;
pub use items::{Items, Lattice, LatticeCell};
pub use prototype::{Prototype, Use};
pub use repeats::without_repeats;
pub use simplify::{Simplified, Simplifier};
pub use split::{Boxes, Entry, Split, Splitter};
pub use text::program_text;
pub use words::{Word, nesting, node_end};

use crate::geom::Bounds;
use crate::model::PartId;
use crate::surface::Surface;

/// One use of a surface by a primitive of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Literal {
    /// Index into [`Catalog::surfaces`].
    pub surface: u32,
    /// Index into [`Catalog::leaves`].
    pub leaf: u32,
}

/// One primitive of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leaf {
    /// The part it belongs to, if to any.
    pub part: Option<PartId>,
}

/// What the words of programs refer to.
#[derive(Clone, Debug, Default)]
pub struct Catalog {
    /// Surfaces; those that coincide are one.
    pub surfaces: Vec<Surface>,
    /// Uses of surfaces, in source order.
    pub literals: Vec<Literal>,
    /// Primitives, in source order.
    pub leaves: Vec<Leaf>,
    /// Solids that stand in many places.
    pub prototypes: Vec<Prototype>,
}

/// The program of one body.
#[derive(Clone, Debug)]
pub struct Program {
    /// The whole body; see [`Word`]. Never empty.
    pub whole: Constant,
    /// What is left of the body outside [`bounds`](Self::bounds): half-spaces and what is made of them.
    pub outer: Constant,
    /// A box that holds everything in the body that is bounded.
    pub bounds: Bounds,
}

impl Program {
    /// How many operators lie above its deepest literal.
    pub fn nesting(&self) -> usize {
        match &self.whole {
            Constant::Everywhere(_) => 0,
            Constant::Words(words) => nesting(words),
        }
    }
}

/// A program that may have been simplified away.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Constant {
    /// Inside everywhere, or nowhere.
    Everywhere(bool),
    /// Depends on the place.
    Words(Box<[u32]>),
}
