//! Parts of an octree under construction.

use super::{CellWord, Kind};
use crate::compile::Entry;
use hashbrown::HashTable;
use rustc_hash::FxHasher;
use std::hash::Hasher;

/// A part of the tree with tables of its own.
#[derive(Default)]
pub(super) struct Subtree {
    pub branches: Vec<[CellWord; 8]>,
    pub programs: Vec<u32>,
    /// Offsets of the programs so far; equal ones are stored once.
    interned: HashTable<u32>,
    /// Levels below the root of the whole tree.
    pub depth: u32,
}

impl Subtree {
    /// The word for the branch just finished: if all its children are empty, or all full, it is what they are, and goes.
    pub fn join(&mut self, index: usize) -> CellWord {
        let children = self.branches[index];
        let uniform = children[0] == CellWord::OUTSIDE || children[0] == CellWord::INSIDE;
        if uniform && index + 1 == self.branches.len() && children.iter().all(|&child| child == children[0]) {
            self.branches.pop();
            return children[0];
        }
        CellWord::branch(index as u32)
    }

    /// The word for a leaf with that program.
    pub fn leaf(&mut self, program: &[Entry], level: u32) -> CellWord {
        self.depth = self.depth.max(level);
        let offset = self.programs.len();
        self.programs.extend(program.iter().map(|entry| entry.word));
        let (known, new) = self.programs.split_at(offset);
        // A program's own words tell where it ends: none is the beginning of another.
        let equal = |&other: &u32| known[other as usize..].starts_with(new);
        if let Some(&other) = self.interned.find(hash(new), equal) {
            self.programs.truncate(offset);
            return CellWord::leaf(other);
        }
        let len = new.len();
        let programs = &self.programs;
        let rehash = |&other: &u32| {
            let start = other as usize;
            hash(&programs[start..crate::compile::node_end(programs, start)])
        };
        self.interned.insert_unique(hash(&programs[offset..offset + len]), offset as u32, rehash);
        CellWord::leaf(offset as u32)
    }

    /// Takes over another subtree's tables; returns its root, given as seen from there, as seen from here.
    pub fn adopt(&mut self, other: Subtree, root: CellWord) -> CellWord {
        let (first_branch, first_word) = (self.branches.len() as u32, self.programs.len() as u32);
        let moved = |word: CellWord| match word.kind() {
            Kind::Branch(index) => CellWord::branch(first_branch + index),
            Kind::Leaf(offset) => CellWord::leaf(first_word + offset),
            Kind::Outside | Kind::Inside => word,
        };
        self.branches.extend(other.branches.iter().map(|branch| branch.map(moved)));
        self.programs.extend_from_slice(&other.programs);
        self.depth = self.depth.max(other.depth);
        moved(root)
    }
}

fn hash(words: &[u32]) -> u64 {
    let mut hasher = FxHasher::default();
    for &word in words {
        hasher.write_u32(word);
    }
    hasher.finish()
}
