//! The corner that is farthest in a direction.

use super::nesting::bounds;
use super::piece::{Piece, ROUNDING, higher};
use crate::geom::Vec2;
use std::ops::Range;

/// The farthest of the points seen so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Top {
    up: Vec2,
    /// The point.
    pub at: Vec2,
    /// How far it is, to rounding.
    pub height: f64,
}

impl Top {
    pub fn new(up: Vec2, at: Vec2) -> Self {
        Self { up, at, height: up.dot(at) }
    }

    /// Takes a point if it is farther, or as far and more to the right; right in any case.
    pub fn rise(&mut self, to: Vec2) -> bool {
        let new = Self::new(self.up, to);
        let slack = ROUNDING * (self.up.x * to.x).abs().max((self.up.y * to.y).abs()).max(self.height.abs());
        let is_higher = if (new.height - self.height).abs() > slack {
            new.height > self.height
        } else {
            let side = higher(self.up, to, self.at);
            side > 0.0 || (side == 0.0 && higher(-self.up.left(), to, self.at) > 0.0)
        };
        if is_higher {
            *self = new;
        }
        is_higher
    }
}

/// Boxes around pieces that follow each other, and around such boxes, so as not to look at all of them.
#[derive(Debug)]
pub(super) struct Blocks {
    /// Around [`SIZE`](Self::SIZE) pieces each; around [`FANOUT`](Self::FANOUT) of those; and so on, to the last.
    levels: Vec<Vec<(Vec2, Vec2)>>,
}

impl Blocks {
    const SIZE: usize = 32;
    const FANOUT: usize = 8;

    pub fn new(pieces: &[Piece]) -> Self {
        let mut levels: Vec<Vec<(Vec2, Vec2)>> = vec![pieces.chunks(Self::SIZE).map(bounds).collect()];
        while let Some(below) = levels.last().filter(|below| below.len() > 1) {
            let around = |boxes: &[(Vec2, Vec2)]| {
                let join = |a: (Vec2, Vec2), b: &(Vec2, Vec2)| (low(a.0, b.0), high(a.1, b.1));
                boxes.iter().fold(boxes[0], join)
            };
            levels.push(below.chunks(Self::FANOUT).map(around).collect());
        }
        Self { levels }
    }

    /// The first piece from `i` on that is not in a block all of which is lower.
    pub fn next_up(&self, mut i: usize, top: &Top) -> usize {
        'skip: while i.is_multiple_of(Self::SIZE) {
            let mut level = 0;
            while i.is_multiple_of(Self::width(level + 1)) && level + 1 < self.levels.len() {
                level += 1;
            }
            // The largest block that starts here and is lower.
            for level in (0..=level).rev() {
                let Some(block) = self.levels[level].get(i / Self::width(level)) else { break 'skip };
                if !may_rise(block, top) {
                    i += Self::width(level);
                    continue 'skip;
                }
            }
            break;
        }
        i
    }

    /// How many pieces a block has.
    fn width(level: usize) -> usize {
        Self::SIZE * Self::FANOUT.pow(level as u32)
    }

    /// A piece among `range` whose end is about as far in direction `up` as that of any: to begin with.
    pub fn promising(&self, pieces: &[Piece], range: Range<usize>, up: Vec2) -> Option<usize> {
        let mut best: Option<(f64, usize)> = None;
        let mut blocks = vec![(f64::INFINITY, self.levels.len() - 1, 0)];
        while let Some((reach, level, number)) = blocks.pop() {
            if best.is_some_and(|(height, _)| reach <= height) {
                continue;
            }
            let within = |level: usize, number: usize| {
                let start = number * Self::width(level);
                start.max(range.start)..(start + Self::width(level)).min(range.end)
            };
            if level == 0 {
                for i in within(0, number) {
                    let height = up.dot(pieces[i].to);
                    if best.is_none_or(|(known, _)| height > known) {
                        best = Some((height, i));
                    }
                }
                continue;
            }
            let below = &self.levels[level - 1];
            let (first, end) = (number * Self::FANOUT, ((number + 1) * Self::FANOUT).min(below.len()));
            let from = blocks.len();
            let inner = (first..end).filter(|&inner| !within(level - 1, inner).is_empty());
            blocks.extend(inner.map(|inner| (reach_of(&below[inner], up), level - 1, inner)));
            // The farthest comes first.
            blocks[from..].sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        }
        best.map(|(_, i)| i)
    }
}

fn low(a: Vec2, b: Vec2) -> Vec2 {
    Vec2::new(a.x.min(b.x), a.y.min(b.y))
}

fn high(a: Vec2, b: Vec2) -> Vec2 {
    Vec2::new(a.x.max(b.x), a.y.max(b.y))
}

/// How far a box reaches.
fn reach_of((low, high): &(Vec2, Vec2), up: Vec2) -> f64 {
    up.dot(Vec2::new(if up.x > 0.0 { high.x } else { low.x }, if up.y > 0.0 { high.y } else { low.y }))
}

/// Whether something in a box may be farther, up to rounding.
fn may_rise((low, high): &(Vec2, Vec2), top: &Top) -> bool {
    let x = if top.up.x > 0.0 { high.x } else { low.x } * top.up.x;
    let y = if top.up.y > 0.0 { high.y } else { low.y } * top.up.y;
    x + y + ROUNDING * (x.abs() + y.abs() + top.height.abs()) >= top.height
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spiral of lines, outwards.
    fn spiral(count: usize) -> Vec<Piece> {
        let corner = |i: usize| {
            let (s, c) = crate::geom::sin_cos_deg(7.0 * i as f64);
            Vec2::new(c, s) * (1.0 + 0.01 * i as f64)
        };
        (0..count).map(|i| Piece { from: corner(i), to: corner(i + 1), circle: None }).collect()
    }

    #[test]
    fn blocks_pass_over_nothing_that_is_farther() {
        let pieces = spiral(3000);
        let blocks = Blocks::new(&pieces);
        assert_eq!(blocks.levels.len(), 4, "94, 12, 2 and 1");
        for angle in 0..90 {
            let (s, c) = crate::geom::sin_cos_deg(4.0 * f64::from(angle) + 0.3);
            let up = Vec2::new(c, s);
            for range in [0..3000, 40..41, 100..2222, 777..1555] {
                let all = range.clone().max_by(|&i, &j| up.dot(pieces[i].to).total_cmp(&up.dot(pieces[j].to)));
                assert_eq!(blocks.promising(&pieces, range.clone(), up), all);
                let (mut top, mut seen) = (Top::new(up, pieces[range.start].to), Vec::new());
                let mut i = range.start;
                while i < range.end {
                    seen.push(i);
                    top.rise(pieces[i].to);
                    i = blocks.next_up(i + 1, &top);
                }
                assert_eq!(top.at, pieces[all.expect("there are some")].to);
                assert!(seen.windows(2).all(|pair| pair[0] < pair[1]));
            }
        }
    }
}
