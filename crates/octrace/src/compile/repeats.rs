//! Leaving out what a program says twice: `A ∪ A = A`, `A ∩ A = A`, for operands of any size.
//!
//! Models repeat themselves, and no cell could simplify that away: an edge of the one copy is an edge of the other. The
//! *later* one goes: of equal operands the first in source order is the one that is seen (see `trace::combine`).

use super::{Catalog, Word, node_end};
use std::collections::HashMap;

/// The program without operands that equal an earlier operand of the same operator.
pub fn without_repeats(catalog: &Catalog, words: &[u32]) -> Vec<u32> {
    let reading = Reading::new(catalog, words);
    let mut kept = Vec::with_capacity(words.len());
    // Headers whose length is not known yet, each with the end of its node among `words`.
    let mut open: Vec<(usize, usize)> = Vec::new();
    let mut at = 0;
    while at < words.len() {
        close(&mut open, at, &mut kept);
        if reading.repeated[at] {
            at = node_end(words, at);
            continue;
        }
        match Word::decode(words[at]) {
            Word::Literal { .. } => kept.push(words[at]),
            // Of one operand there is nothing to combine.
            Word::And { .. } | Word::Or { .. } if reading.operands[at] == 1 => {}
            Word::And { .. } | Word::Or { .. } => {
                open.push((kept.len(), node_end(words, at)));
                kept.push(words[at]);
            }
        }
        at += 1;
    }
    close(&mut open, words.len(), &mut kept);
    kept
}

/// Sets the lengths of the operators that end at `at`.
fn close(open: &mut Vec<(usize, usize)>, at: usize, kept: &mut [u32]) {
    while let Some(&(header, _)) = open.last().filter(|&&(_, end)| end <= at) {
        let len = (kept.len() - header - 1) as u32;
        kept[header] = match Word::decode(kept[header]) {
            Word::And { .. } => Word::And { len },
            Word::Or { .. } => Word::Or { len },
            literal @ Word::Literal { .. } => literal,
        }
        .encode();
        open.pop();
    }
}

/// A program, read from its leaves up.
struct Reading<'a> {
    catalog: &'a Catalog,
    words: &'a [u32],
    /// Of every node a number that equal nodes share.
    hashes: Vec<u64>,
    /// Whether a node equals an earlier operand of its operator.
    repeated: Vec<bool>,
    /// How many operands of an operator are left.
    operands: Vec<u32>,
}

impl<'a> Reading<'a> {
    fn new(catalog: &'a Catalog, words: &'a [u32]) -> Self {
        let size = words.len();
        let mut reading =
            Self { catalog, words, hashes: vec![0; size], repeated: vec![false; size], operands: vec![0; size] };
        let mut seen = HashMap::new();
        // Operands come after their operators.
        for at in (0..size).rev() {
            reading.hashes[at] = match Word::decode(words[at]) {
                Word::Literal { .. } => mix(reading.meaning(at)),
                Word::And { .. } | Word::Or { .. } => reading.operator(at, &mut seen),
            };
        }
        reading
    }

    /// What a word says, for comparing: literals of one surface are the same.
    fn meaning(&self, at: usize) -> u64 {
        match Word::decode(self.words[at]) {
            Word::Literal { index, negated } => {
                u64::from(self.catalog.literals[index as usize].surface) << 2 | u64::from(negated)
            }
            Word::And { len } => u64::from(len) << 2 | 2,
            Word::Or { len } => u64::from(len) << 2 | 3,
        }
    }

    /// Marks the operands that repeat others; returns the operator's hash.
    fn operator(&mut self, at: usize, seen: &mut HashMap<u64, usize>) -> u64 {
        /// Up to so many operands are compared with each other.
        const FEW: usize = 16;
        let end = node_end(self.words, at);
        let mut few = [0; FEW];
        let mut count = 0;
        let mut hash = mix(self.meaning(at));
        seen.clear();
        let mut operand = at + 1;
        while operand < end {
            let own = self.hashes[operand];
            hash = mix(hash ^ own);
            let mut first = few[..count.min(FEW)].iter().copied().find(|&other| self.hashes[other] == own);
            if first.is_none() && count >= FEW {
                first = seen.get(&own).copied();
            }
            if first.is_some_and(|first| self.equal(first, operand)) {
                self.repeated[operand] = true;
            } else {
                if count < FEW {
                    few[count] = operand;
                } else {
                    seen.entry(own).or_insert(operand);
                }
                count += 1;
            }
            operand = node_end(self.words, operand);
        }
        self.operands[at] = count as u32;
        hash
    }

    /// Whether two nodes say the same, word for word.
    fn equal(&self, a: usize, b: usize) -> bool {
        let len = node_end(self.words, a) - a;
        len == node_end(self.words, b) - b && (0..len).all(|i| self.meaning(a + i) == self.meaning(b + i))
    }
}

/// Scatters the bits of a number (the finalizer of SplitMix64).
fn mix(mut bits: u64) -> u64 {
    bits = bits.wrapping_add(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ bits >> 31
}

#[cfg(test)]
mod tests {
    use super::super::{Constant, Copies, compile, program_text};
    use super::*;
    use crate::model::Solid;

    fn ball(x: f64) -> Solid {
        Solid::sphere().translate([x, 0.0, 0.0])
    }

    /// The program of the solid without repeats, as text.
    fn left_of(solid: Solid) -> String {
        let compiled = compile(&[solid], 0.0, Copies::Apart);
        let Constant::Words(words) = &compiled.bodies[0].whole else { panic!("a program") };
        let kept = without_repeats(&compiled.catalog, words);
        program_text(&compiled.catalog, &Constant::Words(kept.into()))
    }

    #[test]
    fn the_later_of_equal_operands_goes() {
        assert_eq!(left_of(ball(0.0) + ball(1.0) + ball(0.0)), left_of(ball(0.0) + ball(1.0)));
        assert_eq!(left_of(ball(0.0) & ball(0.0)), left_of(ball(0.0)));
        let lens = |x: f64| ball(x) & ball(x + 1.0);
        assert_eq!(left_of(lens(0.0) + lens(3.0) + lens(0.0)), left_of(lens(0.0) + lens(3.0)));
    }

    #[test]
    fn many_operands_are_compared_too() {
        let row = || (0..50).map(|i| ball(f64::from(i)));
        assert_eq!(left_of(Solid::union(row().chain(row()))), left_of(Solid::union(row())));
    }

    #[test]
    fn an_operator_left_with_one_operand_goes() {
        let text = left_of((ball(0.0) + ball(0.0)) & ball(1.0));
        assert_eq!(text, "and\n  inside s0 (sphere), leaf 0\n  inside s1 (sphere), leaf 2\n");
    }

    #[test]
    fn different_operands_stay() {
        let text = left_of(ball(0.0) - ball(1.0) - ball(2.0));
        assert_eq!(text, left_of(ball(0.0) - (ball(1.0) + ball(2.0))));
        assert_ne!(text, left_of(ball(0.0) - ball(1.0)));
    }
}
