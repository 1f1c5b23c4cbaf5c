//! Building programs: n-ary, negation normal form, constants folded, equal operators flattened.

use super::{Constant, Word};

/// A program under construction.
#[derive(Debug)]
pub(super) enum Expr {
    Constant(bool),
    Literal { index: u32, negated: bool },
    Nary(Op, Vec<Expr>),
}

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
}

impl Expr {
    /// Combines operands, in order.
    pub fn combine(op: Op, operands: impl IntoIterator<Item = Expr>) -> Self {
        let mut kept = Vec::new();
        for operand in operands {
            match operand {
                Expr::Constant(value) if value == op.absorbing() => return Expr::Constant(value),
                Expr::Constant(_) => {}
                Expr::Nary(inner, mut children) if inner == op => kept.append(&mut children),
                other => kept.push(other),
            }
        }
        match kept.len() {
            0 => Expr::Constant(!op.absorbing()),
            1 => kept.swap_remove(0),
            _ => Expr::Nary(op, kept),
        }
    }

    /// The program in words, taking the tree apart without recursion.
    pub fn into_words(self) -> Constant {
        if let Expr::Constant(value) = self {
            return Constant::Everywhere(value);
        }
        enum Step {
            Emit(Expr),
            Close { at: usize, op: Op },
        }
        let mut words = Vec::new();
        let mut steps = vec![Step::Emit(self)];
        while let Some(step) = steps.pop() {
            match step {
                Step::Emit(Expr::Literal { index, negated }) => words.push(Word::Literal { index, negated }.encode()),
                Step::Emit(Expr::Nary(op, children)) => {
                    steps.push(Step::Close { at: words.len(), op });
                    words.push(0);
                    steps.extend(children.into_iter().rev().map(Step::Emit));
                }
                Step::Emit(Expr::Constant(_)) => unreachable!("combine folds constants"),
                Step::Close { at, op } => {
                    let len = (words.len() - at - 1) as u32;
                    words[at] = match op {
                        Op::And => Word::And { len },
                        Op::Or => Word::Or { len },
                    }
                    .encode();
                }
            }
        }
        Constant::Words(words.into())
    }
}
