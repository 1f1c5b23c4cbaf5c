//! Things whose hull together is known exactly.

use super::frame;
use crate::space::round::{Extremes, Round};
use std::collections::BTreeSet;

/// Round things of one kind, by their numbers.
#[derive(Clone, Debug)]
pub(super) struct Kind {
    pub members: BTreeSet<usize>,
    /// Whether corners may be among them.
    pub takes_corners: bool,
}

/// Whether things have an exact hull together.
type Form = fn(&Extremes) -> bool;

/// Ways to have one, each with whether corners may be among the things.
const FORMS: [(Form, bool); 4] = [
    (|things| frame::balls(things).is_some(), true),
    (|things| frame::discs(things).is_some(), true),
    (|things| frame::rounded(things).is_some(), false),
    (|things| frame::turned(things).is_some(), false),
];

/// The kinds that there are, the largest first. A thing may be of several.
pub(super) fn kinds(rounds: &[Round]) -> Vec<Kind> {
    let have = |form: Form, which: &[usize]| {
        form(&Extremes { points: Vec::new(), rounds: which.iter().map(|&i| rounds[i]).collect() })
    };
    let mut kinds: Vec<Kind> = Vec::new();
    for (form, takes_corners) in FORMS {
        let mut known = BTreeSet::new();
        for seed in 0..rounds.len() {
            if known.contains(&seed) || !have(form, &[seed]) {
                continue;
            }
            let members = (0..rounds.len()).filter(|&i| i == seed || have(form, &[seed, i]));
            let kind = Kind { members: members.collect(), takes_corners };
            known.extend(kind.members.iter().copied());
            kinds.push(kind);
        }
    }
    kinds.sort_by_key(|kind| std::cmp::Reverse(kind.members.len()));
    kinds
}
