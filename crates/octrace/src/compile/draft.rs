//! Writing programs while the tree is walked: n-ary, negation normal form, constants folded. Operators that turn out to have
//! one operand, and those that their own kind is above, go in the end: one after another they would cost the square of a
//! long chain.

use super::{Constant, Word, node_end};

/// An operator of programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Op {
    /// Inside where all operands are.
    And,
    /// Inside where any operand is.
    Or,
}

impl Op {
    /// The other operator where a complement is pushed through this one (De Morgan).
    pub(super) fn under(self, negated: bool) -> Self {
        match (self, negated) {
            (op, false) => op,
            (Op::And, true) => Op::Or,
            (Op::Or, true) => Op::And,
        }
    }

    /// The operand that decides the result alone: false for `And`, true for `Or`.
    fn absorbing(self) -> bool {
        self == Op::Or
    }

    fn word(self, len: usize) -> u32 {
        let len = len as u32;
        match self {
            Op::And => Word::And { len },
            Op::Or => Word::Or { len },
        }
        .encode()
    }
}

/// A program under construction: nodes in prefix order.
#[derive(Debug, Default)]
pub(super) struct Draft {
    words: Vec<u32>,
}

/// What came of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Value {
    /// Nothing was written.
    Constant(bool),
    /// It is what was written last.
    Written,
}

/// An operator whose operands are being written.
#[derive(Debug)]
pub(super) struct Opened {
    at: usize,
    op: Op,
    has_operands: bool,
    is_absorbed: bool,
}

impl Opened {
    /// The operand just written.
    pub fn add(&mut self, operand: Value) {
        match operand {
            Value::Written => self.has_operands = true,
            Value::Constant(value) => self.is_absorbed |= value == self.op.absorbing(),
        }
    }
}

impl Draft {
    /// Writes a literal.
    pub fn literal(&mut self, index: u32, negated: bool) -> Value {
        self.words.push(Word::Literal { index, negated }.encode());
        Value::Written
    }

    /// Begins an operator; its operands are to be written next, and added to it.
    pub fn open(&mut self, op: Op) -> Opened {
        let at = self.words.len();
        self.words.push(0);
        Opened { at, op, has_operands: false, is_absorbed: false }
    }

    /// Ends an operator.
    pub fn close(&mut self, opened: Opened) -> Value {
        let Opened { at, op, has_operands, is_absorbed } = opened;
        if is_absorbed || !has_operands {
            return self.close_as(opened, op.absorbing() == is_absorbed);
        }
        self.words[at] = op.word(self.words.len() - at - 1);
        Value::Written
    }

    /// Ends an operator that is known to be constant.
    pub fn close_as(&mut self, opened: Opened, value: bool) -> Value {
        self.words.truncate(opened.at);
        Value::Constant(value)
    }

    /// The program, without operators that combine nothing or that their own kind is above.
    pub fn finish(&mut self, value: Value) -> Constant {
        let value = match value {
            Value::Constant(value) => Constant::Everywhere(value),
            Value::Written => Constant::Words(flattened(&self.words).into()),
        };
        self.words.clear();
        value
    }
}

fn flattened(words: &[u32]) -> Vec<u32> {
    let mut flat = Vec::with_capacity(words.len());
    // Operators written and not ended: their place, and where they end among `words`.
    let mut open: Vec<(Op, usize, usize)> = Vec::new();
    let end_operators = |flat: &mut Vec<u32>, open: &mut Vec<(Op, usize, usize)>, at: usize| {
        while let Some((op, header, _)) = open.pop_if(|&mut (_, _, end)| end <= at) {
            flat[header] = op.word(flat.len() - header - 1);
        }
    };
    for (at, &word) in words.iter().enumerate() {
        end_operators(&mut flat, &mut open, at);
        let op = match Word::decode(word) {
            Word::Literal { .. } => {
                flat.push(word);
                continue;
            }
            Word::And { .. } => Op::And,
            Word::Or { .. } => Op::Or,
        };
        let end = node_end(words, at);
        let is_below_its_kind = open.last().is_some_and(|&(above, ..)| above == op);
        if node_end(words, at + 1) < end && !is_below_its_kind {
            open.push((op, flat.len(), end));
            flat.push(0);
        }
    }
    end_operators(&mut flat, &mut open, words.len());
    flat
}
