//! Multi-resolution Bresenham in the plane, as the paper gives it [Comba-Persiano, §4.2]: Bresenham's line on the squares of
//! a quadtree, in integers.
//!
//! Nothing in space is traced with it: `traverse::bresenham` does that. This is the form of the algorithm to understand it
//! by, and to draw. The tree lies on a lattice; a [`Line`] starts at a lattice point and has an integer direction. With the
//! slope `dy/dx` in `[0, 1]` and the line at `(a, b)` relative to the corner of a square with side `s`, the paper keeps
//!
//! ```text
//! error     = slope * (s - a) + b     the line's height at the square's right side, above the square's bottom
//! increment = slope * s               what one side adds to it
//! ```
//!
//! Here these, and `s` itself, are kept `dx` times as large, so that all of them are integers: see [`Terms`]. Comparing
//! error and side tells where the line leaves; all updates are additions, doublings and halvings ([`Move`]).
//!
//! ```
//! use octrace::traverse::plane::{Line, Move, Quadtree, walk};
//! use std::ops::ControlFlow;
//!
//! // A square of 8 by 8 units; its lower right quarter is divided once more.
//! let tree = Quadtree::new(3, |square| square.level == 0 || (square.level == 1 && square.corner == [4, 0]));
//! let line = Line::new([0, 1], [4, 1]).expect("a direction");
//! let mut moves = Vec::new();
//! let _ = walk(&tree, &line, |step| {
//!     moves.push(step.kind);
//!     ControlFlow::<()>::Continue(())
//! });
//! use Move::*;
//! assert_eq!(moves, [Start, Refine, Horizontal, Refine, Horizontal]);
//! ```

mod quadtree;
#[cfg(test)]
mod tests;
mod walk;

pub use quadtree::{Quadtree, Square};
pub use walk::{Line, Move, Step, Terms, walk};
