//! Subtrees that a file repeats, word for word: each becomes a solid once. Real dumps repeat them by the thousand. So are
//! single nodes that read a file or set a text.

use super::language::{self, Kind};
use super::looks::Look;
use super::operand::Operand;
use crate::syntax::{Ast, Modifiers, NodeId, Step};
use rustc_hash::FxHashMap;

/// What repeated subtrees became.
pub(super) struct Memory {
    /// By node: a hash of its subtree; 0 for those that occur once, or mean something else elsewhere.
    hashes: Vec<u64>,
    known: FxHashMap<u64, Vec<Remembered>>,
}

struct Remembered {
    node: NodeId,
    look: Look,
    operand: Operand,
    leaves: usize,
}

/// What there was when a node was entered, to tell what came of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    /// The look around it.
    pub look: Look,
    /// How many diagnostics there were.
    pub said: usize,
    /// How many leaves.
    pub leaves: usize,
}

impl Memory {
    /// With nothing remembered yet, for this tree.
    pub fn of(ast: &Ast) -> Self {
        let words: Vec<_> = ast.names().map(language::find).collect();
        let kind = |node| words[ast.name_index(node)].map(|word| word.kind);
        let is_setting =
            |node| matches!(kind(node), Some(Kind::Light | Kind::Camera | Kind::Ambient | Kind::Background));
        let is_short =
            |node| ast.subtree_len(node) < 2 && !matches!(kind(node), Some(Kind::Import | Kind::Surface | Kind::Text));
        // What the subtrees say, and which of them may be remembered by that.
        let (mut said, mut hashes) = (vec![0; ast.len()], vec![0; ast.len()]);
        for step in ast.bottom_up() {
            match step {
                Step::Node(node) => {
                    let i = ast.index(node);
                    said[i] = ast.subtree_hash(node, |child| said[ast.index(child)]);
                    let is_pure = |child| hashes[ast.index(child)] != IMPURE;
                    let is_marked = ast.modifiers(node) != Modifiers::NONE;
                    hashes[i] = if is_marked || is_setting(node) || !ast.children(node).all(is_pure) {
                        IMPURE
                    } else if is_short(node) {
                        LEAF
                    } else {
                        said[i].max(LEAF + 1)
                    };
                }
                Step::Copy { of, top } => {
                    let (from, to, len) = (ast.index(of), ast.index(top), ast.subtree_len(of));
                    said.copy_within(from..from + len, to);
                    hashes.copy_within(from..from + len, to);
                }
            }
        }
        let mut times: FxHashMap<u64, u32> = FxHashMap::default();
        for &hash in hashes.iter().filter(|&&hash| hash > LEAF) {
            *times.entry(hash).or_default() += 1;
        }
        for hash in &mut hashes {
            if times.get(hash).is_none_or(|&times| times < 2) {
                *hash = 0;
            }
        }
        Self { hashes, known: FxHashMap::default() }
    }

    /// Whether the node's subtree occurs elsewhere too.
    pub fn is_repeated(&self, ast: &Ast, node: NodeId) -> bool {
        self.hashes[ast.index(node)] != 0
    }

    /// What an equal subtree with the same look around it became, and how many leaves it has.
    pub fn recall(&self, ast: &Ast, node: NodeId, look: Look) -> Option<(Operand, usize)> {
        let known = self.known.get(&self.hashes[ast.index(node)])?;
        let same = known.iter().find(|known| known.look == look && ast.same_subtree(known.node, node))?;
        Some((same.operand.clone(), same.leaves))
    }

    /// Remembers what a subtree became.
    pub fn remember(&mut self, ast: &Ast, node: NodeId, look: Look, operand: Operand, leaves: usize) {
        let remembered = Remembered { node, look, operand, leaves };
        self.known.entry(self.hashes[ast.index(node)]).or_default().push(remembered);
    }
}

/// Stands for a hash while they are sorted out: of a subtree that means something else elsewhere.
const IMPURE: u64 = 0;
/// Likewise, of a single node that is made as fast as it is found again; files and texts are not.
const LEAF: u64 = 1;
