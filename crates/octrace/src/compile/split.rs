//! Simplifying a program in eight boxes at once [Wyvill-Kunii-Shirai 1986; Comba-Persiano, §3].
//!
//! A surface that misses a box, or has all of it inside, is a constant there; boolean algebra does the rest:
//! `A ∪ 0 = A`, `A ∩ 0 = 0`, `A ∩ 1 = A` and so on. A surface that has already been decided on the way
//! down (one of the latest, lest long lists are searched again and again) counts as a constant for what comes later:
//! `P ∩ (¬P ∪ Q) = P ∩ Q`. Only *later* nodes may profit: the visible one of several surfaces crossed at once is the first
//! in source order (see `trace::combine`), and so it stays the same.
//!
//! Boxes are bits: what is known of a node is a set of boxes in which it is kept, and the rest of the algebra is that of
//! sets. One pass over the program judges every node, a second one writes what is kept of it, for each box to a place of its
//! own. Neither recurses, and both take time in proportion to the length of the program.

use super::{Catalog, Word};
use crate::surface::{OctantSides, Octants};
use std::ops::Range;

/// A word of a program, with the surface of its literal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Entry {
    /// See [`Word`].
    pub word: u32,
    /// Index into [`Catalog::surfaces`]; no matter what for operators.
    pub surface: u32,
}

impl Entry {
    /// The word with its surface.
    pub fn new(catalog: &Catalog, word: u32) -> Self {
        let surface = match Word::decode(word) {
            Word::Literal { index, .. } => catalog.literals[index as usize].surface,
            Word::And { .. } | Word::Or { .. } => 0,
        };
        Self { word, surface }
    }

    /// Whether it is a literal.
    #[inline]
    pub fn is_literal(self) -> bool {
        matches!(Word::decode(self.word), Word::Literal { .. })
    }
}

/// What is left of a program in eight boxes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Split {
    /// The boxes that are all inside.
    pub inside: u8,
    /// The boxes that are all outside.
    pub outside: u8,
    /// Where the programs of the other boxes are.
    pub ranges: [Range<usize>; 8],
}

impl Split {
    /// What a box is, if it is all inside or all outside.
    pub fn constant(&self, octant: usize) -> Option<bool> {
        let is_in = |boxes: u8| boxes >> octant & 1 == 1;
        (is_in(self.inside) || is_in(self.outside)).then(|| is_in(self.inside))
    }
}

/// Splits programs; keeps its scratch memory between calls.
#[derive(Debug, Default)]
pub struct Splitter {
    /// For every entry of a program the boxes in which it is no constant.
    kept: Vec<u8>,
    /// For every operator the boxes in which it has several operands left.
    several: Vec<u8>,
    judged: Vec<Judged>,
    written: Vec<Written>,
    known: Known,
    /// How many times a surface was classified against a box.
    pub classified: u64,
}

/// An operator that is being judged.
#[derive(Debug)]
struct Judged {
    at: usize,
    end: usize,
    is_and: bool,
    /// The boxes in which its value matters, and those in which no operand has decided it so far.
    asked: u8,
    open: u8,
    /// The boxes in which it has an operand left, and more than one.
    one: u8,
    several: u8,
    /// How many surfaces were known before.
    known: usize,
}

/// An operator that is being written.
#[derive(Debug)]
struct Written {
    end: usize,
    is_and: bool,
    /// The boxes in which it is written at all, and those in which it has a header.
    boxes: u8,
    with_header: u8,
    headers: [u32; 8],
    /// The boxes in which operands at this place are below an `And`, and below an `Or`.
    below_and: u8,
    below_or: u8,
}

impl Splitter {
    /// Simplifies the program `stack[program]` in the boxes asked for and puts what is left on top of the stack.
    pub fn split(
        &mut self,
        catalog: &Catalog,
        stack: &mut Vec<Entry>,
        program: Range<usize>,
        octants: &Octants,
        boxes: u8,
    ) -> Split {
        let sides = self.judge(catalog, &stack[program.clone()], octants, boxes);
        let mut split = Split { inside: sides.inside, outside: sides.outside, ..Split::default() };
        if boxes & !(sides.inside | sides.outside) != 0 {
            self.write(stack, program, &mut split.ranges);
        }
        split
    }

    /// Judges every node; returns what the whole is.
    fn judge(&mut self, catalog: &Catalog, entries: &[Entry], octants: &Octants, boxes: u8) -> OctantSides {
        self.kept.clear();
        self.kept.resize(entries.len(), 0);
        self.several.resize(entries.len().max(self.several.len()), 0);
        self.judged.clear();
        self.known.clear();
        let (mut at, mut asked) = (0, boxes);
        loop {
            let entry = entries[at];
            let negated = match Word::decode(entry.word) {
                Word::Literal { negated, .. } => negated,
                operator @ (Word::And { len } | Word::Or { len }) => {
                    let is_and = matches!(operator, Word::And { .. });
                    let (end, known) = (at + 1 + len as usize, self.known.len());
                    self.judged.push(Judged { at, end, is_and, asked, open: asked, one: 0, several: 0, known });
                    at += 1;
                    continue;
                }
            };
            let mut sides = catalog.surfaces[entry.surface as usize].classify_octants(octants);
            self.classified += 8;
            self.known.decide(entry.surface, &mut sides);
            let (mut truth, mut falsehood) =
                if negated { (sides.outside, sides.inside) } else { (sides.inside, sides.outside) };
            let mut kept = asked & !(truth | falsehood);
            self.kept[at] = kept;
            at += 1;
            if let (Some(above), true) = (self.judged.last(), kept != 0) {
                self.known.learn(entry.surface, negated, above.is_and, kept);
            }
            // What was found of a node goes up, as far as operators end with it.
            loop {
                let Some(above) = self.judged.last_mut() else {
                    return OctantSides { inside: truth & boxes, outside: falsehood & boxes };
                };
                above.open &= !(if above.is_and { falsehood } else { truth });
                above.several |= above.one & kept;
                above.one |= kept;
                if above.open == 0 {
                    at = above.end;
                } else if at < above.end {
                    asked = above.open;
                    break;
                }
                let (decided, undecided) = (above.asked & !above.open, above.open & !above.one);
                kept = above.open & above.one;
                (truth, falsehood) = if above.is_and { (undecided, decided) } else { (decided, undecided) };
                self.kept[above.at] = kept;
                self.several[above.at] = above.several & kept;
                let (known, alone) = (above.known, kept & !above.several);
                self.judged.pop();
                match self.judged.last() {
                    Some(above) if alone != 0 => self.known.go_up(known, above.is_and, alone),
                    _ => self.known.truncate(known),
                }
            }
        }
    }

    /// Writes the nodes that are kept.
    fn write(&mut self, stack: &mut Vec<Entry>, program: Range<usize>, ranges: &mut [Range<usize>; 8]) {
        let bottom = stack.len();
        let mut next = [0_u32; 8];
        let mut total = 0;
        for (range, count) in ranges.iter_mut().zip(counts(&self.kept)) {
            *range = bottom + total..bottom + total;
            total += count as usize;
        }
        for (next, range) in next.iter_mut().zip(ranges.iter()) {
            *next = (range.start - bottom) as u32;
        }
        stack.resize(bottom + total, Entry::default());
        let (below, out) = stack.split_at_mut(bottom);
        let entries = &below[program];

        self.written.clear();
        let mut boxes = self.kept[0];
        let (mut below_and, mut below_or) = (0_u8, 0_u8);
        let mut at = 0;
        loop {
            while let Some(done) = self.written.pop_if(|above| above.end <= at) {
                for octant in ones(done.with_header) {
                    let header = done.headers[octant];
                    let len = next[octant] - header - 1;
                    let word = if done.is_and { Word::And { len } } else { Word::Or { len } };
                    out[header as usize] = Entry { word: word.encode(), surface: 0 };
                }
                (boxes, below_and, below_or) = (done.boxes, done.below_and, done.below_or);
            }
            if at >= entries.len() {
                break;
            }
            let kept = self.kept[at] & boxes;
            if kept == 0 {
                at = node_end_of(entries, at);
                continue;
            }
            let is_and = match Word::decode(entries[at].word) {
                Word::Literal { .. } => {
                    for octant in ones(kept) {
                        out[next[octant] as usize] = entries[at];
                        next[octant] += 1;
                    }
                    at += 1;
                    continue;
                }
                Word::And { .. } => true,
                Word::Or { .. } => false,
            };
            let with_header = self.several[at] & kept & !(if is_and { below_and } else { below_or });
            let headers = next;
            for octant in ones(with_header) {
                next[octant] += 1;
            }
            let end = node_end_of(entries, at);
            self.written.push(Written { end, is_and, boxes, with_header, headers, below_and, below_or });
            boxes = kept;
            if is_and {
                (below_and, below_or) = (below_and | with_header, below_or & !with_header);
            } else {
                (below_and, below_or) = (below_and & !with_header, below_or | with_header);
            }
            at += 1;
        }
        for (range, next) in ranges.iter_mut().zip(next) {
            range.end = bottom + next as usize;
        }
    }
}

fn node_end_of(entries: &[Entry], at: usize) -> usize {
    match Word::decode(entries[at].word) {
        Word::Literal { .. } => at + 1,
        Word::And { len } | Word::Or { len } => at + 1 + len as usize,
    }
}

/// The places of the ones among eight bits.
#[inline(always)]
fn ones(mut bits: u8) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = bits.trailing_zeros() as usize;
        bits &= bits.wrapping_sub(1);
        (place < 8).then_some(place)
    })
}

/// How many of the sets have each of the eight bits.
fn counts(sets: &[u8]) -> [u64; 8] {
    let mut counts = [0; 8];
    for some in sets.chunks(255) {
        // A byte for each bit.
        let bytes = some.iter().fold(0_u64, |bytes, &set| bytes + spread(set));
        for (count, byte) in counts.iter_mut().zip(bytes.to_le_bytes()) {
            *count += u64::from(byte);
        }
    }
    counts
}

/// Eight bytes, each of them a bit of `bits`, the lowest first.
#[inline(always)]
fn spread(bits: u8) -> u64 {
    let each = u64::from(bits).wrapping_mul(0x0101_0101_0101_0101) & 0x8040_2010_0804_0201;
    (each + 0x7f7f_7f7f_7f7f_7f7f) >> 7 & 0x0101_0101_0101_0101
}

/// Literals that operators above and before have kept: on which side of their surfaces whatever comes later is.
#[derive(Debug, Default)]
struct Known {
    surfaces: Vec<u32>,
    literals: Vec<KnownLiteral>,
}

#[derive(Clone, Copy, Debug)]
struct KnownLiteral {
    negated: bool,
    /// On which side of its surface its later siblings are.
    inside: bool,
    /// The boxes in which it is kept.
    boxes: u8,
}

impl Known {
    /// So many of the latest are looked at.
    const LATEST: usize = 64;

    fn clear(&mut self) {
        self.truncate(0);
    }

    fn len(&self) -> usize {
        self.surfaces.len()
    }

    fn truncate(&mut self, len: usize) {
        self.surfaces.truncate(len);
        self.literals.truncate(len);
    }

    /// An operand of an operator is kept in some boxes: true for its later siblings in an `And`, false in an `Or`.
    fn learn(&mut self, surface: u32, negated: bool, is_and: bool, boxes: u8) {
        self.surfaces.push(surface);
        self.literals.push(KnownLiteral { negated, inside: is_and != negated, boxes });
    }

    /// An operator ends whose literals are known from `start` on. In the boxes in which it has but one operand left, a
    /// literal takes its place in the operator above.
    fn go_up(&mut self, start: usize, is_and: bool, alone: u8) {
        let mut end = start;
        for i in start..self.len() {
            let KnownLiteral { negated, boxes, .. } = self.literals[i];
            if boxes & alone != 0 {
                self.surfaces[end] = self.surfaces[i];
                self.literals[end] = KnownLiteral { negated, inside: is_and != negated, boxes: boxes & alone };
                end += 1;
            }
        }
        self.truncate(end);
    }

    /// Puts the boxes that cross a surface on the side that is known, if it is.
    #[inline(always)]
    fn decide(&self, surface: u32, sides: &mut OctantSides) {
        let start = self.len().saturating_sub(Self::LATEST);
        let latest = &self.surfaces[start..];
        if !latest.iter().fold(false, |found, &known| found | (known == surface)) {
            return;
        }
        let crossed = !(sides.inside | sides.outside);
        for (&known, literal) in latest.iter().zip(&self.literals[start..]) {
            if known == surface {
                *(if literal.inside { &mut sides.inside } else { &mut sides.outside }) |= crossed & literal.boxes;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_counted_each_for_itself() {
        let sets: Vec<u8> = (0..1000).map(|i| [0b1000_0001, 0b0000_0010, 0xff][i % 3]).collect();
        assert_eq!(counts(&sets), [667, 666, 333, 333, 333, 333, 333, 667]);
        assert_eq!(ones(0b1000_0110).collect::<Vec<_>>(), [1, 2, 7]);
    }
}
