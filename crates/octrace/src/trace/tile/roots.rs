//! Real roots in brackets, eight at once: what [`crate::num`] does for one, operation for operation.

use super::lanes::{F64s, Isa, Mask};
use crate::num::{MOST_STEPS, Precision};

/// A function of one number.
pub(super) trait Function<I: Isa> {
    /// Its values, and Newton's steps from there.
    fn at(&self, x: F64s<I>) -> (F64s<I>, F64s<I>);
}

/// Where functions are searched for roots.
#[derive(Clone, Copy)]
pub(super) struct Bracket<I: Isa> {
    /// The lanes that matter.
    pub lanes: Mask<I>,
    pub lo: F64s<I>,
    pub hi: F64s<I>,
    /// Where the search starts, if that is inside.
    pub start: F64s<I>,
    /// Where functions are negative before their roots.
    pub rising: Mask<I>,
}

/// As [`bracketed_root`](crate::num::bracketed_root); in lanes that do not matter, anything.
#[inline(always)]
pub(super) fn bracketed_root<I: Isa>(f: &impl Function<I>, bracket: Bracket<I>, precision: Precision) -> F64s<I> {
    let Bracket { lanes: mut left, mut lo, mut hi, start, rising } = bracket;
    let half = F64s::splat(0.5);
    let (tolerance, noise) = (F64s::splat(precision.tolerance), F64s::splat(precision.noise));
    let mut last_step = hi - lo;
    let mut x = (lo.lt(start) & start.lt(hi)).select(start, lo + last_step * half);
    for _ in 0..MOST_STEPS {
        let (value, newton) = f.at(x);
        let above = value.lt(F64s::zero()) ^ rising;
        (lo, hi) = (above.select(lo, x), above.select(x, hi));
        let next = x + newton;
        let zero = value.abs().le(F64s::zero());
        let close = (newton.abs().le(tolerance) | value.abs().le(noise)) & lo.le(next) & next.le(hi);
        let stays = lo.lt(next) & next.lt(hi) & newton.abs().le(last_step * half);
        let next = (stays | close).select(next, lo + (hi - lo) * half);
        last_step = (next - x).abs();
        left = left & !zero;
        x = left.select(next, x);
        left = left & !(close | last_step.le(tolerance));
        if !left.any() {
            break;
        }
    }
    x
}

/// `x³ + p x + q`.
struct Cubic<I: Isa> {
    p: F64s<I>,
    q: F64s<I>,
}

impl<I: Isa> Cubic<I> {
    #[inline(always)]
    fn value(&self, x: F64s<I>) -> F64s<I> {
        (x * x + self.p) * x + self.q
    }
}

impl<I: Isa> Function<I> for Cubic<I> {
    #[inline(always)]
    fn at(&self, x: F64s<I>) -> (F64s<I>, F64s<I>) {
        let value = self.value(x);
        (value, -value / (F64s::splat(3.0) * (x * x) + self.p))
    }
}

/// As [`cubic_roots`](crate::num::cubic_roots): three roots, and in which lanes they are there.
#[inline(always)]
pub(super) fn cubic_roots<I: Isa>(
    (p, q): (F64s<I>, F64s<I>),
    lanes: Mask<I>,
    (lo, hi): (F64s<I>, F64s<I>),
    precision: Precision,
) -> [(F64s<I>, Mask<I>); 3] {
    let f = Cubic { p, q };
    let turns = p.lt(F64s::zero());
    let turn = (p / F64s::splat(-3.0)).sqrt();
    let parts = [
        (lanes, lo, turns.select(hi.min(-turn), hi)),
        (lanes & turns, lo.max(-turn), hi.min(turn)),
        (lanes & turns, lo.max(turn), hi),
    ];
    let mut roots = [(F64s::zero(), Mask::splat(false)); 3];
    for (root, (lanes, lo, hi)) in roots.iter_mut().zip(parts) {
        let rising = f.value(lo).lt(F64s::zero());
        let lanes = lanes & lo.lt(hi) & (rising ^ f.value(hi).lt(F64s::zero()));
        if lanes.any() {
            let bracket = Bracket { lanes, lo, hi, start: lo, rising };
            *root = (bracketed_root(&f, bracket, precision), lanes);
        }
    }
    roots
}
