//! Building programs: n-ary, negation normal form, constants folded. Nested equal operators become one when the words are
//! written: one after another they would cost the square of a long chain.

use super::{Constant, Word};
use std::mem;

/// A program under construction.
#[derive(Debug)]
pub(super) enum Expr {
    Constant(bool),
    Literal { index: u32, negated: bool },
    Nary(Op, Operands),
}

/// Operands of an operator. Chains of operators may be too deep to be dropped by recursion.
#[derive(Debug)]
pub(super) struct Operands(Vec<Expr>);

impl Drop for Operands {
    fn drop(&mut self) {
        let mut dropping = mem::take(&mut self.0);
        while let Some(operand) = dropping.pop() {
            if let Expr::Nary(_, mut inner) = operand {
                dropping.append(&mut inner.0);
            }
        }
    }
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
        let mut kept = Operands(Vec::new());
        for operand in operands {
            match operand {
                Expr::Constant(value) if value == op.absorbing() => return Expr::Constant(value),
                Expr::Constant(_) => {}
                other => kept.0.push(other),
            }
        }
        match kept.0.len() {
            0 => Expr::Constant(!op.absorbing()),
            1 => kept.0.swap_remove(0),
            _ => Expr::Nary(op, kept),
        }
    }

    /// The program in words, taking the tree apart without recursion.
    pub fn into_words(self) -> Constant {
        if let Expr::Constant(value) = self {
            return Constant::Everywhere(value);
        }
        enum Step {
            /// A node, and the operator that it is below.
            Emit(Expr, Option<Op>),
            Close {
                at: usize,
                op: Op,
            },
        }
        let mut words = Vec::new();
        let mut steps = vec![Step::Emit(self, None)];
        while let Some(step) = steps.pop() {
            match step {
                Step::Emit(Expr::Literal { index, negated }, _) => {
                    words.push(Word::Literal { index, negated }.encode())
                }
                Step::Emit(Expr::Nary(op, mut operands), above) => {
                    if above != Some(op) {
                        steps.push(Step::Close { at: words.len(), op });
                        words.push(0);
                    }
                    let operands = mem::take(&mut operands.0).into_iter().rev();
                    steps.extend(operands.map(|operand| Step::Emit(operand, Some(op))));
                }
                Step::Emit(Expr::Constant(_), _) => unreachable!("combine folds constants"),
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
