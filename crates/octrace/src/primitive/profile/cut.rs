//! Where to cut a chain: at the corner that is farthest in a direction in which both of its ends fall, see
//! [`chain`](super::chain).

use super::chain::{Chain, Cut, Writer};
use super::clear::{CLEAR, misses, rays_miss};
use super::piece::{ROUNDING, higher};
use super::top::Top;
use crate::geom::Vec2;

impl Writer<'_> {
    /// Where to cut a chain of more than one edge.
    pub fn find_cut(&mut self, chain: &Chain) -> Cut {
        let (first, last) = (self.piece(chain, chain.first), self.piece(chain, chain.last));
        let come = chain.before.map_or(first.chord(), |head| head - chain.from);
        let go = chain.behind.map_or(last.chord(), |tail| chain.to - tail);
        let (come, go) = (come * (1.0 / come.length()), go * (1.0 / go.length()));
        // Up, both ends fall.
        let up = come - go;
        let length = up.length();
        if length > 1e-7 {
            let cut = self.highest(chain, up * (1.0 / length)).0;
            return self.free_corner(chain, cut).unwrap_or(cut);
        }
        // The ends are parallel: what is above both, or below both, will do. Else everything is between them.
        let ends = [
            if chain.before.is_some() { chain.from } else { first.to },
            if chain.behind.is_some() { chain.to } else { last.from },
        ];
        for up in [go.left(), -go.left()] {
            let (cut, highest) = self.highest(chain, up);
            if ends.iter().all(|&end| higher(up, highest, end) > 0.0) {
                return cut;
            }
        }
        if chain.before.is_some() {
            Cut::Before
        } else if chain.first < chain.last {
            Cut::Corner(chain.first)
        } else {
            Cut::Behind
        }
    }

    /// In place of a cut in an arc: a corner at one of the arc's ends, or next to it, beyond which neither of the two parts
    /// meets the other. Where an arc goes on smoothly, what is left of it would be cut again and again.
    fn free_corner(&self, chain: &Chain, cut: Cut) -> Option<Cut> {
        let Cut::Arc(arc, _) = cut else { return None };
        let corners = chain.first.max(arc.saturating_sub(2))..chain.last.min(arc + 2);
        corners.into_iter().find(|&i| self.is_free(chain, i)).map(Cut::Corner)
    }

    /// Whether a chain may be cut at the end of its piece `i`: what goes on beyond meets no other part of the chain.
    fn is_free(&self, chain: &Chain, i: usize) -> bool {
        let (before, behind) = (self.piece(chain, i), self.piece(chain, i + 1));
        let (at, ahead, back) = (before.to, before.chord(), -behind.chord());
        let turn = |a: Vec2, b: Vec2| a.cross(b) / (a.length() * b.length());
        let (tangents, chords) =
            (turn(before.tangent(at), behind.tangent(behind.from)), turn(before.chord(), behind.chord()));
        if chords.abs() < CLEAR || tangents * chords < -CLEAR * CLEAR {
            return false;
        }
        let start = chain.before.map_or_else(|| -self.piece(chain, chain.first).chord(), |head| chain.from - head);
        let end = chain.behind.map_or_else(|| self.piece(chain, chain.last).chord(), |tail| chain.to - tail);
        [ahead, back].into_iter().all(|ray| {
            let is_clear = |k: usize| {
                let piece = self.piece(chain, k);
                // The two at the corner touch it there, and turn away.
                k == i && ray == ahead || k == i + 1 && ray == back || misses(at, ray, &piece)
            };
            (chain.first..=chain.last).all(is_clear)
                && rays_miss(at, ray, chain.from, start)
                && rays_miss(at, ray, chain.to, end)
        })
    }

    /// The place of a chain of more than one edge that is farthest in direction `up`; of several corners, the one farthest
    /// to the right.
    fn highest(&mut self, chain: &Chain, up: Vec2) -> (Cut, Vec2) {
        let mut top: Option<(Cut, Top)> = None;
        let mut offer = |cut: Cut, at: Vec2| match &mut top {
            Some((best, top)) => {
                if top.rise(at) {
                    *best = cut;
                }
            }
            None => top = Some((cut, Top::new(up, at))),
        };
        if chain.before.is_some() {
            offer(Cut::Before, chain.from);
        }
        if chain.behind.is_some() {
            offer(Cut::Behind, chain.to);
        }
        if chain.first < chain.last {
            offer(Cut::Corner(chain.first), self.pieces[chain.first].to);
        }
        let Some((mut cut, mut top)) = top else { return (Cut::Corner(chain.first), chain.to) };
        // Not from left to right alone: on a spiral, corners would rise all the way.
        if let Some(i) = self.blocks.promising(self.pieces, chain.first..chain.last, up)
            && top.rise(self.pieces[i].to)
        {
            cut = Cut::Corner(i);
        }
        let mut i = self.blocks.next_up(chain.first, &top);
        while i < chain.last {
            if top.rise(self.pieces[i].to) {
                cut = Cut::Corner(i);
            }
            i = self.blocks.next_up(i + 1, &top);
        }
        // Arcs may rise above corners.
        let (at, height) = (top.at, top.height);
        let mut above: Option<(Cut, Vec2, f64)> = None;
        let mut i = chain.first;
        while i <= chain.last && self.has_arcs {
            let (number, piece) = (i, self.piece(chain, i));
            i = self.blocks.next_up(i + 1, &top);
            let (Some(apex), Some(circle)) = (piece.apex(up), piece.circle) else { continue };
            let slack = ROUNDING * (circle.radius + apex.length() + at.length());
            let apex_height = up.dot(apex);
            if apex_height > above.map_or(height + slack, |(_, _, known)| known) {
                above = Some((Cut::Arc(number, apex), apex, apex_height));
            }
        }
        match above {
            Some((cut, at, _)) if self.cuts_left > 0 => {
                self.cuts_left -= 1;
                (cut, at)
            }
            _ => (cut, at),
        }
    }
}
