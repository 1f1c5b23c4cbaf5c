//! The formula of one contour: each edge's half-plane once, joined by "all of" and "any of".
//!
//! After Peterson, as [Dobkin 1993] tell it. A *chain* is a part of a contour whose end edges go on to infinity; it has a
//! left side. Let `v` be the corner of a chain that is farthest in a direction in which both of its ends fall. Cut there, the
//! two chains go on beyond `v`, above everything else, so they meet nowhere but in `v`. What is to the left of the whole
//! chain is to the left of *both* where it turns left at `v`, and to the left of *any* of the two where it turns right. So
//! a chain becomes a formula by cutting it again and again; a contour is two chains, cut at its first and its last corner from
//! left to right. A chain that only turns left, by no more than half a turn, is all of its edges; one that only turns right,
//! any.
//!
//! Where we go further: edges may be arcs. The half-plane of an arc is that of its chord, with the disc where the arc
//! bulges to the right, without it where it bulges to the left. If an arc rises above all corners, the chain is cut at a corner
//! near by beyond which nothing is met, or else at the arc's highest point. At a corner, chords must turn as the curves do, and
//! neither may lie between the other's curve and chord: arcs are cut for that, and S curves and cusps stitched (`prepare`). That an arc at a chain's end goes on along its chord is said when the chain is cut; so if it is cut
//! once more, the line along which it was to go on stays as an edge of its own (`before`, `behind`).

use super::piece::{Circle, Piece, orientation};
use super::prepare::prepared;
use super::top::Blocks;
use super::turning::{Turning, is_convex};
use crate::geom::Vec2;

/// How operands are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Join {
    /// What is in all of them.
    All,
    /// What is in any of them.
    Any,
}

/// A formula is a sequence of steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    /// Operands follow, up to the `Close` that belongs to it.
    Open(Join),
    /// All operands are there.
    Close,
    /// What is to the left of the line through two points.
    Left(Vec2, Vec2),
    /// What is inside a circle, or outside of it.
    Disc { center: Vec2, radius: f64, inside: bool },
}

/// The formula of what is inside a simple contour, walked counter-clockwise; and whether the contour is convex.
pub(super) fn formula(pieces: &[Piece]) -> (Vec<Step>, bool) {
    let mut steps = Vec::with_capacity(4 * pieces.len());
    if let [Piece { from, to, circle: Some(Circle { center, radius, .. }) }] = *pieces
        && from == to
    {
        steps.push(Step::Disc { center, radius, inside: true });
        return (steps, true);
    }
    if is_convex(pieces) {
        steps.push(Step::Open(Join::All));
        pieces.iter().for_each(|piece| write_piece(piece, &mut steps));
        steps.push(Step::Close);
        return (steps, true);
    }
    let pieces = prepared(pieces);
    let count = pieces.len() / 2;
    let first = extreme_corner(&pieces[..count], |p, q| (p.x, p.y) < (q.x, q.y));
    let last = extreme_corner(&pieces[..count], |p, q| (p.x, p.y) > (q.x, q.y));
    let (low, high) = (first.min(last), first.max(last));
    if low == high {
        return (steps, false);
    }
    let whole = |first: usize, last: usize| Chain {
        first,
        last,
        from: pieces[first].from,
        to: pieces[last].to,
        before: None,
        behind: None,
    };
    let arcs = pieces.iter().filter(|piece| !piece.is_line()).count();
    let blocks = Blocks::new(&pieces);
    let mut writer = Writer { pieces: &pieces, blocks, steps, has_arcs: arcs > 0, cuts_left: 4 * arcs };
    writer.steps.push(Step::Open(Join::All));
    writer.chain(whole(low, high - 1));
    writer.chain(whole(high, low + count - 1));
    writer.steps.push(Step::Close);
    (writer.steps, false)
}

/// A line, or an arc with what is beyond its chord.
fn write_piece(piece: &Piece, steps: &mut Vec<Step>) {
    let left = Step::Left(piece.from, piece.to);
    let Some(Circle { center, radius, ccw }) = piece.circle else {
        steps.push(left);
        return;
    };
    let join = if ccw { Join::Any } else { Join::All };
    steps.extend([Step::Open(join), left, Step::Disc { center, radius, inside: ccw }, Step::Close]);
}

/// The piece that starts in the corner that comes before all others.
fn extreme_corner(pieces: &[Piece], is_before: impl Fn(Vec2, Vec2) -> bool) -> usize {
    (1..pieces.len()).fold(0, |best, i| if is_before(pieces[i].from, pieces[best].from) { i } else { best })
}

/// A part of a contour: pieces in a row, the first and the last perhaps shortened, that goes on to infinity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chain {
    pub first: usize,
    pub last: usize,
    pub from: Vec2,
    pub to: Vec2,
    /// It comes along the line from `from` to here; else along the chord of its first piece.
    pub before: Option<Vec2>,
    /// It goes on along the line from here to `to`; else along the chord of its last piece.
    pub behind: Option<Vec2>,
}

/// Where a chain is cut.
#[derive(Clone, Copy, Debug)]
pub(super) enum Cut {
    Before,
    /// At the end of a piece.
    Corner(usize),
    /// In a piece.
    Arc(usize, Vec2),
    Behind,
}

/// What remains to be written.
enum Task {
    Chain(Chain),
    Step(Step),
}

pub(super) struct Writer<'a> {
    pub pieces: &'a [Piece],
    pub blocks: Blocks,
    steps: Vec<Step>,
    pub has_arcs: bool,
    /// How many more arcs may be cut: a contour that crosses itself shall come to an end too.
    pub cuts_left: usize,
}

impl Writer<'_> {
    fn chain(&mut self, chain: Chain) {
        let mut tasks = vec![Task::Chain(chain)];
        while let Some(task) = tasks.pop() {
            let chain = match task {
                Task::Step(step) => {
                    self.steps.push(step);
                    continue;
                }
                Task::Chain(chain) => chain,
            };
            if let Some(join) = self.one_way(&chain) {
                self.steps.push(Step::Open(join));
                self.write_all(&chain);
                self.steps.push(Step::Close);
                continue;
            }
            let cut = self.find_cut(&chain);
            let (join, one, other) = self.cut(&chain, cut);
            self.steps.push(Step::Open(join));
            tasks.extend([Task::Step(Step::Close), other, one]);
        }
    }

    /// Piece `i` of a chain.
    pub fn piece(&self, chain: &Chain, i: usize) -> Piece {
        let mut piece = self.pieces[i];
        if i == chain.first {
            piece.from = chain.from;
        }
        if i == chain.last {
            piece.to = chain.to;
        }
        piece
    }

    fn write_all(&mut self, chain: &Chain) {
        if let Some(head) = chain.before {
            self.steps.push(Step::Left(chain.from, head));
        }
        for i in chain.first..=chain.last {
            write_piece(&self.piece(chain, i), &mut self.steps);
        }
        if let Some(tail) = chain.behind {
            self.steps.push(Step::Left(tail, chain.to));
        }
    }

    /// How the pieces are to be joined, if the chain turns one way only.
    fn one_way(&self, chain: &Chain) -> Option<Join> {
        const HALF_TURN: f64 = std::f64::consts::PI + 1e-9;
        if chain.first == chain.last && chain.before.is_none() && chain.behind.is_none() {
            return Some(Join::All);
        }
        let mut turning = Turning::none();
        let first = self.piece(chain, chain.first);
        if let Some(head) = chain.before {
            turning.corner(head - chain.from, first.tangent(first.from), None);
        }
        let mut last = first;
        turning.along(&first);
        for i in chain.first + 1..=chain.last {
            let piece = self.piece(chain, i);
            turning.between(&last, &piece);
            turning.along(&piece);
            // While it turns one way only, the angle grows.
            if turning.is_both() || turning.angle.abs() > HALF_TURN {
                return None;
            }
            last = piece;
        }
        if let Some(tail) = chain.behind {
            turning.corner(last.tangent(last.to), chain.to - tail, None);
        }
        match turning.angle.abs() <= HALF_TURN {
            true if turning.to_the_left => Some(Join::All),
            true if turning.to_the_right => Some(Join::Any),
            _ => None,
        }
    }

    /// Cuts a chain: how the two parts are joined, and what they are.
    fn cut(&self, chain: &Chain, cut: Cut) -> (Join, Task, Task) {
        let (first, last) = (self.piece(chain, chain.first), self.piece(chain, chain.last));
        let join = |side: f64| if side < 0.0 { Join::Any } else { Join::All };
        match (cut, chain.before, chain.behind) {
            (Cut::Before, Some(head), _) => {
                let side = orientation(head, first.to, chain.from);
                let line = Task::Step(Step::Left(chain.from, head));
                (join(side), line, Task::Chain(Chain { before: None, ..*chain }))
            }
            (Cut::Behind, _, Some(tail)) => {
                let side = orientation(last.from, tail, chain.to);
                let line = Task::Step(Step::Left(tail, chain.to));
                (join(side), Task::Chain(Chain { behind: None, ..*chain }), line)
            }
            (Cut::Arc(i, at), ..) => {
                let piece = self.piece(chain, i);
                let side = orientation(piece.from, at, piece.to);
                let mut one = Chain { last: i, to: at, behind: None, ..*chain };
                let mut other = Chain { first: i, from: at, before: None, ..*chain };
                if i == chain.first && chain.before.is_none() {
                    one.before = Some(piece.to);
                }
                if i == chain.last && chain.behind.is_none() {
                    other.behind = Some(piece.from);
                }
                (join(side), Task::Chain(one), Task::Chain(other))
            }
            (Cut::Corner(i), ..) => self.cut_at_corner(chain, i),
            (Cut::Before, None, _) | (Cut::Behind, _, None) => self.cut_at_corner(chain, chain.first),
        }
    }

    fn cut_at_corner(&self, chain: &Chain, i: usize) -> (Join, Task, Task) {
        // There is a corner: chains of one edge are not cut.
        let i = i.min(chain.last.saturating_sub(1));
        let (before, behind) = (self.piece(chain, i), self.piece(chain, i + 1));
        let at = before.to;
        let side = orientation(before.from, at, behind.to);
        let join = if side < 0.0 { Join::Any } else { Join::All };
        let one = Chain { last: i, to: at, behind: None, ..*chain };
        let other = Chain { first: i + 1, from: behind.from, before: None, ..*chain };
        (join, Task::Chain(one), Task::Chain(other))
    }
}
