//! The walk: errors, moves, refinement and integration.
//!
//! The paper adds the increment of a horizontal move last, when the square has its final size. Here it is added at once,
//! and refinement takes half of it back: so that after every step the numbers are those of the square that it led to.

use super::quadtree::{Quadtree, Square};
use std::cmp::Ordering;
use std::ops::ControlFlow;

/// A line from a lattice point on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line {
    start: [i64; 2],
    direction: [i64; 2],
}

impl Line {
    /// The largest part of a direction.
    pub const MAX_DIRECTION: i64 = 1 << 30;

    /// The line from `start` along `direction`; `None` where the direction is zero, or a part of it exceeds
    /// [`MAX_DIRECTION`](Self::MAX_DIRECTION).
    pub fn new(start: [i64; 2], direction: [i64; 2]) -> Option<Self> {
        let fits = direction.iter().all(|d| d.unsigned_abs() <= Self::MAX_DIRECTION.unsigned_abs());
        (fits && direction != [0, 0]).then_some(Self { start, direction })
    }
}

/// What was done at a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Move {
    /// The walk begins, with the root.
    Start,
    /// `error < side`: across the right side, `error += increment`.
    Horizontal,
    /// `error > side`: across the top, `error -= side`.
    Vertical,
    /// `error == side`: through the corner, both.
    Diagonal,
    /// To the quarter in which the line is: `side` and `increment` are halved (the paper's *detalhamento*).
    Refine,
    /// To the parent, as far as the neighbour to move to is larger: `side` and `increment` are doubled.
    Integrate,
}

/// The numbers that the walk is made of, each `dx` times what the paper's is: so all of them are integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Terms {
    /// The line's height at the square's right side, above the square's bottom.
    pub error: i64,
    /// The square's side.
    pub side: i64,
    /// By how much the line rises over one side.
    pub increment: i64,
}

/// One step of the walk, and where it has led to. The line visits those squares that are `leaf`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// What was done.
    pub kind: Move,
    /// The square that it led to. *Right* and *top* are meant in the [frame](walk) in which the line ascends.
    pub square: Square,
    /// Whether the square is not divided.
    pub leaf: bool,
    /// The numbers after the step.
    pub terms: Terms,
}

/// Shows `visit` every step of the line's way through the tree, until it breaks off or the line leaves the tree.
///
/// Where the slope is not in `[0, 1]`, axes are mirrored and swapped until it is, and the moves are meant in that frame. A
/// square is half-open there: a line along a side belongs to the square above. A line that starts outside visits nothing.
pub fn walk<B>(tree: &Quadtree, line: &Line, mut visit: impl FnMut(&Step) -> ControlFlow<B>) -> ControlFlow<B> {
    let Some(mut walker) = Walker::new(tree, line) else { return ControlFlow::Continue(()) };
    visit(&walker.step(Move::Start))?;
    let mut entered = Move::Start;
    loop {
        // Into the smallest square that the line is in.
        while let Some(first) = tree.children(walker.node) {
            walker.refine(first, entered);
            visit(&walker.step(Move::Refine))?;
        }
        // On to the neighbour, which is as large or larger.
        let Some((neighbour, levels)) = walker.neighbour(walker.next_move()) else {
            return ControlFlow::Continue(());
        };
        for _ in 0..levels {
            walker.integrate();
            visit(&walker.step(Move::Integrate))?;
        }
        // A corner of the small square need not be one of the large square.
        entered = walker.next_move();
        walker.advance(entered, neighbour);
        visit(&walker.step(entered))?;
    }
}

/// Bits of quarters.
const RIGHT: usize = 1;
const UPPER: usize = 2;

/// How the axes are mirrored, then swapped.
#[derive(Clone, Copy)]
struct Frame {
    /// The bits of the axes that are mirrored.
    mirrored: usize,
    swapped: bool,
}

impl Frame {
    /// A quarter of the tree as one of the frame.
    fn into(self, quarter: usize) -> usize {
        self.swap(quarter ^ self.mirrored)
    }

    /// A quarter of the frame as one of the tree.
    fn out_of(self, quarter: usize) -> usize {
        self.swap(quarter) ^ self.mirrored
    }

    fn swap(self, quarter: usize) -> usize {
        if self.swapped { quarter >> 1 | (quarter & 1) << 1 } else { quarter }
    }
}

struct Walker<'a> {
    tree: &'a Quadtree,
    frame: Frame,
    /// Where the line starts, in the frame.
    start: [i64; 2],
    node: u32,
    /// The node's square, in the frame.
    square: Square,
    terms: Terms,
}

impl<'a> Walker<'a> {
    /// The walk at the root; `None` where the line does not start in it.
    fn new(tree: &'a Quadtree, line: &Line) -> Option<Self> {
        let square = tree.root();
        let (mut start, mut direction, mut mirrored) = (line.start, line.direction, 0);
        for axis in 0..2 {
            if direction[axis] < 0 {
                direction[axis] = -direction[axis];
                start[axis] = square.side.checked_sub(start[axis])?;
                mirrored |= 1 << axis;
            }
        }
        let swapped = direction[1] > direction[0];
        if swapped {
            start.swap(0, 1);
            direction.swap(0, 1);
        }
        let ([a, b], [dx, dy], s) = (start, direction, square.side);
        if !(0..s).contains(&a) || !(0..s).contains(&b) {
            return None;
        }
        let terms = Terms { error: dy * (s - a) + dx * b, side: dx * s, increment: dy * s };
        Some(Self { tree, frame: Frame { mirrored, swapped }, start, node: Quadtree::ROOT, square, terms })
    }

    /// Where the line leaves the square.
    fn next_move(&self) -> Move {
        match self.terms.error.cmp(&self.terms.side) {
            Ordering::Less => Move::Horizontal,
            Ordering::Greater => Move::Vertical,
            Ordering::Equal => Move::Diagonal,
        }
    }

    /// The neighbour to move to, as large as the square or larger, and by how many levels larger; `None` beyond the root
    /// [Samet 1982].
    ///
    /// Going to a neighbour is adding one to binary numbers, the bits of which are the quarters on the way down from the
    /// root: from a low quarter to the high one beside it; from a high quarter to a low one, and one is carried to the
    /// level above. In a diagonal move both axes are carried, each as far as it goes.
    fn neighbour(&self, kind: Move) -> Option<(u32, usize)> {
        let mut carry = match kind {
            Move::Vertical => UPPER,
            Move::Diagonal => RIGHT | UPPER,
            _ => RIGHT,
        };
        let (mut node, mut way, mut levels) = (self.node, [0; Quadtree::MAX_SIDE_LOG as usize], 0);
        while carry != 0 {
            let (parent, quarter) = self.tree.above(node)?;
            let quarter = self.frame.into(quarter);
            way[levels] = quarter ^ carry;
            levels += 1;
            carry &= quarter;
            node = parent;
        }
        // Down again, mirrored.
        while let (Some(first), 1..) = (self.tree.children(node), levels) {
            levels -= 1;
            node = first + self.frame.out_of(way[levels]) as u32;
        }
        Some((node, levels))
    }

    fn advance(&mut self, kind: Move, neighbour: u32) {
        let Terms { error, side, increment } = &mut self.terms;
        if kind != Move::Vertical {
            *error += *increment;
            self.square.corner[0] += self.square.side;
        }
        if kind != Move::Horizontal {
            *error -= *side;
            self.square.corner[1] += self.square.side;
        }
        self.node = neighbour;
    }

    /// The square becomes its parent.
    fn integrate(&mut self) {
        let Some((parent, quarter)) = self.tree.above(self.node) else { return };
        let (quarter, side) = (self.frame.into(quarter), self.square.side);
        let terms = &mut self.terms;
        // The bottom goes down by one side. (The paper has this one only: before a horizontal move the other never happens.)
        if quarter & UPPER != 0 {
            terms.error += terms.side;
            self.square.corner[1] -= side;
        }
        // The right side goes away by one side.
        if quarter & RIGHT == 0 {
            terms.error += terms.increment;
        } else {
            self.square.corner[0] -= side;
        }
        terms.side *= 2;
        terms.increment *= 2;
        self.square = Square { level: self.square.level - 1, side: 2 * side, ..self.square };
        self.node = parent;
    }

    /// The square becomes that of its quarters, the first of which is `first`, which the line is in: first, coming by the
    /// move `entered`, or at the start.
    fn refine(&mut self, first: u32, entered: Move) {
        let side = self.square.side / 2;
        let terms = &mut self.terms;
        terms.side /= 2;
        terms.increment /= 2;
        let Terms { error, increment, .. } = *terms;
        let (right, upper) = match entered {
            // By the left side, at the height that the line has one whole side before the right one.
            Move::Horizontal => (false, error - 2 * increment >= terms.side),
            // By the bottom, right of the middle if in the middle the line is not above the bottom yet.
            Move::Vertical => (error - increment <= 0, false),
            Move::Diagonal => (false, false),
            _ => (self.start[0] >= self.square.corner[0] + side, self.start[1] >= self.square.corner[1] + side),
        };
        // The right side comes nearer.
        if right {
            self.square.corner[0] += side;
        } else {
            terms.error -= terms.increment;
        }
        // The bottom comes up.
        if upper {
            terms.error -= terms.side;
            self.square.corner[1] += side;
        }
        self.square = Square { level: self.square.level + 1, side, ..self.square };
        let quarter = (if right { RIGHT } else { 0 }) | (if upper { UPPER } else { 0 });
        self.node = first + self.frame.out_of(quarter) as u32;
    }

    /// The step that led here.
    fn step(&self, kind: Move) -> Step {
        let Square { level, mut corner, side } = self.square;
        if self.frame.swapped {
            corner.swap(0, 1);
        }
        for (axis, place) in corner.iter_mut().enumerate() {
            if self.frame.mirrored >> axis & 1 == 1 {
                *place = self.tree.root().side - *place - side;
            }
        }
        let leaf = self.tree.children(self.node).is_none();
        Step { kind, square: Square { level, corner, side }, leaf, terms: self.terms }
    }
}
