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

use super::known::Known;
use super::{Catalog, Items, LatticeCell, Word};
use crate::surface::{OctantSides, Octants};
use std::ops::Range;

/// A word of a program, with the surface of its literal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Entry {
    /// See [`Word`].
    pub word: u32,
    /// See [`Catalog::surface`]; no matter what for operators.
    pub surface: u32,
}

impl Entry {
    /// The word with its surface.
    pub fn new(catalog: &Catalog, word: u32) -> Self {
        let surface = match Word::decode(word) {
            Word::Literal { index, .. } => catalog.surface_number(index),
            Word::And { .. } | Word::Or { .. } => 0,
        };
        Self { word, surface }
    }

    /// An entry for a whole operand of a program: see [`Items`].
    pub(super) fn item(node: usize, outside: bool) -> Self {
        Self { word: Word::Literal { index: node as u32, negated: outside }.encode(), surface: Self::ITEM }
    }

    /// In place of a surface.
    const ITEM: u32 = u32::MAX;

    /// Whether it stands for a whole operand.
    #[inline]
    pub fn is_item(self) -> bool {
        self.surface == Self::ITEM
    }

    /// Where the operand starts for which an item stands.
    pub(super) fn node(self) -> usize {
        match Word::decode(self.word) {
            Word::Literal { index, .. } => index as usize,
            Word::And { .. } | Word::Or { .. } => 0,
        }
    }

    /// Whether it is a literal or an item.
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
    /// How many words they have, those in items included.
    pub words: [usize; 8],
    /// The boxes whose programs have items.
    pub with_items: u8,
}

/// Eight boxes, as surfaces and as items see them.
#[derive(Clone, Copy, Debug)]
pub struct Boxes<'a> {
    /// The boxes.
    pub octants: Octants,
    /// The items of the program, and the cell on their lattice whose octants the boxes are; none where the program has none.
    pub items: Option<(&'a Items, LatticeCell)>,
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
        boxes: &Boxes,
        asked: u8,
    ) -> Split {
        let sides = self.judge(catalog, &stack[program.clone()], boxes, asked);
        let mut split = Split { inside: sides.inside, outside: sides.outside, ..Split::default() };
        if asked & !(sides.inside | sides.outside) != 0 {
            self.write(stack, program, boxes, &mut split);
        }
        split
    }

    /// Judges every node; returns what the whole is.
    fn judge(&mut self, catalog: &Catalog, entries: &[Entry], boxes: &Boxes, all: u8) -> OctantSides {
        self.kept.clear();
        self.kept.resize(entries.len(), 0);
        self.several.resize(entries.len().max(self.several.len()), 0);
        self.judged.clear();
        self.known.clear();
        let (mut at, mut asked) = (0, all);
        let classified = u64::from(all.count_ones());
        let first = boxes.octants.cell(0);
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
            let sides = match &boxes.items {
                Some((items, cell)) if entry.is_item() => OctantSides { inside: 0, outside: items.missed(entry, cell) },
                _ => {
                    self.classified += classified;
                    let mut sides = match catalog.surfaces.get(entry.surface as usize) {
                        Some(surface) if all == 1 => OctantSides::all(surface.classify(&first)),
                        Some(surface) => surface.classify_octants(&boxes.octants),
                        None => {
                            let (surface, offset) = catalog.surface(entry.surface);
                            surface.classify_octants(&boxes.octants.seen_from(offset))
                        }
                    };
                    self.known.decide(entry.surface, &mut sides);
                    sides
                }
            };
            let (mut truth, mut falsehood) =
                if negated { (sides.outside, sides.inside) } else { (sides.inside, sides.outside) };
            let mut kept = asked & !(truth | falsehood);
            self.kept[at] = kept;
            at += 1;
            if let (Some(above), true) = (self.judged.last(), kept != 0 && !entry.is_item()) {
                self.known.learn(entry.surface, negated, above.is_and, kept);
            }
            // What was found of a node goes up, as far as operators end with it.
            loop {
                let Some(above) = self.judged.last_mut() else {
                    return OctantSides { inside: truth & all, outside: falsehood & all };
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
    fn write(&mut self, stack: &mut Vec<Entry>, program: Range<usize>, boxes: &Boxes, split: &mut Split) {
        let ranges = &mut split.ranges;
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
        let mut here = self.kept[0];
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
                (here, below_and, below_or) = (done.boxes, done.below_and, done.below_or);
            }
            if at >= entries.len() {
                break;
            }
            let kept = self.kept[at] & here;
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
                    if let (Some((items, _)), true) = (&boxes.items, entries[at].is_item()) {
                        split.with_items |= kept;
                        let more = items.words_of(entries[at]) - 1;
                        ones(kept).for_each(|octant| split.words[octant] += more);
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
            self.written.push(Written { end, is_and, boxes: here, with_header, headers, below_and, below_or });
            here = kept;
            if is_and {
                (below_and, below_or) = (below_and | with_header, below_or & !with_header);
            } else {
                (below_and, below_or) = (below_and & !with_header, below_or | with_header);
            }
            at += 1;
        }
        for (octant, range) in ranges.iter_mut().enumerate() {
            range.end = bottom + next[octant] as usize;
            split.words[octant] += range.len();
        }
    }
}

pub(super) fn node_end_of(entries: &[Entry], at: usize) -> usize {
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
