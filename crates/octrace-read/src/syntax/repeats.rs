//! Subtrees that a text repeats, letter for letter: real dumps do so by the thousand. The second time they are copied, not
//! read.

use super::ast::NodeId;
use rustc_hash::FxHasher;
use std::hash::Hasher;

/// So many letters tell which subtree may be repeated; shorter ones are read as fast.
const LETTERS: usize = 96;
/// How many subtrees are kept in mind, by what they begin with: a power of two.
const KEPT: usize = 1 << 12;
/// So many letters are compared at once.
const STEP: usize = 256;
/// In vain, a text is compared with itself so often at most.
const IN_VAIN: usize = 4;

/// The subtrees of a text, by what they begin with: of those that begin alike one that is repeated, or the last one.
pub(super) struct Repeats<'s> {
    text: &'s [u8],
    kept: Vec<Option<Known>>,
    /// How many letters may still be compared in vain.
    left: usize,
}

/// A subtree, and where its text is.
#[derive(Clone, Copy)]
struct Known {
    node: NodeId,
    start: u32,
    end: u32,
    /// Whether it was found since it was last in another one's way.
    found: bool,
}

/// What a subtree begins with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beginning {
    start: u32,
    slot: u32,
}

impl<'s> Repeats<'s> {
    pub fn of(text: &'s str) -> Self {
        Self { text: text.as_bytes(), kept: vec![None; KEPT], left: IN_VAIN * text.len() }
    }

    /// What begins here; `None` if there is too little.
    pub fn beginning(&self, start: u32) -> Option<Beginning> {
        let letters = self.text.get(start as usize..start as usize + LETTERS)?;
        let mut hasher = FxHasher::default();
        letters.as_chunks::<8>().0.iter().for_each(|&eight| hasher.write_u64(u64::from_le_bytes(eight)));
        Some(Beginning { start, slot: (hasher.finish() % KEPT as u64) as u32 })
    }

    /// Keeps a subtree in mind that ends here.
    pub fn keep(&mut self, node: NodeId, beginning: Beginning, end: u32) {
        if ((end - beginning.start) as usize) < LETTERS {
            return;
        }
        match &mut self.kept[beginning.slot as usize] {
            Some(Known { found, .. }) if *found => *found = false,
            kept => *kept = Some(Known { node, start: beginning.start, end, found: false }),
        }
    }

    /// A subtree whose text is repeated here, and how long that is.
    pub fn find(&mut self, beginning: Beginning) -> Option<(NodeId, u32)> {
        let kept = &mut self.kept[beginning.slot as usize];
        let Known { node, start, end, .. } = (*kept)?;
        let known = &self.text[start as usize..end as usize];
        let here = self.text[beginning.start as usize..].get(..known.len())?;
        let differs = |(a, b): (&[u8], &[u8])| a != b;
        match known.chunks(STEP).zip(here.chunks(STEP)).position(differs) {
            None => {
                *kept = Some(Known { node, start, end, found: true });
                Some((node, end - start))
            }
            Some(steps) => {
                let compared = (steps + 1) * STEP;
                // Rather read on than go over the same text once for every level of a deep tree.
                if self.left < compared {
                    self.kept.fill(None);
                }
                self.left = self.left.saturating_sub(compared);
                None
            }
        }
    }
}
