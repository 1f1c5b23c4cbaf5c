//! Parts of an octree under construction.

use super::{CellWord, Kind};
use crate::compile::node_end;
use std::collections::HashMap;

/// A part of the tree with tables of its own.
pub(super) struct Subtree {
    pub root: CellWord,
    pub branches: Vec<[CellWord; 8]>,
    pub programs: Vec<u32>,
    /// Offsets of the programs so far; equal ones are stored once.
    interned: HashMap<Box<[u32]>, u32>,
    /// Levels below the root of the whole tree.
    pub depth: u32,
    /// How often a surface was classified.
    pub classified: u64,
}

impl Subtree {
    /// A subtree of one cell, all inside or all outside.
    pub fn constant(inside: bool) -> Self {
        Self {
            root: if inside { CellWord::INSIDE } else { CellWord::OUTSIDE },
            branches: Vec::new(),
            programs: Vec::new(),
            interned: HashMap::new(),
            depth: 0,
            classified: 0,
        }
    }

    /// A subtree of one leaf.
    pub fn leaf(words: &[u32], level: u32) -> Self {
        let mut tree = Self::constant(false);
        tree.root = tree.intern(words);
        tree.depth = level;
        tree
    }

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
    pub fn intern(&mut self, program: &[u32]) -> CellWord {
        if let Some(&offset) = self.interned.get(program) {
            return CellWord::leaf(offset);
        }
        let offset = self.programs.len() as u32;
        self.programs.extend_from_slice(program);
        self.interned.insert(program.into(), offset);
        CellWord::leaf(offset)
    }

    /// Takes over another subtree's tables; returns its root as seen from here.
    pub fn adopt(&mut self, other: Subtree) -> CellWord {
        let first_branch = self.branches.len() as u32;
        let mut moved: HashMap<u32, CellWord> = HashMap::new();
        let mut relocate = |tree: &mut Self, word: CellWord| match word.kind() {
            Kind::Branch(index) => CellWord::branch(first_branch + index),
            Kind::Leaf(offset) => *moved.entry(offset).or_insert_with(|| {
                let start = offset as usize;
                tree.intern(&other.programs[start..node_end(&other.programs, start)])
            }),
            Kind::Outside | Kind::Inside => word,
        };
        for branch in &other.branches {
            let branch = branch.map(|word| relocate(self, word));
            self.branches.push(branch);
        }
        self.depth = self.depth.max(other.depth);
        self.classified += other.classified;
        relocate(self, other.root)
    }
}
