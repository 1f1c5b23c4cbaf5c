//! The octree-CSG: space cut into cells, each with what is left of the program there
//! [Wyvill-Kunii-Shirai 1986; Comba-Persiano, §3].

mod build;
mod subtree;
mod worker;

pub use build::{BuildOptions, build};

use crate::compile::node_end;
use crate::geom::{Bounds, Vec3};
use crate::surface::CellBox;

/// What a cell is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell<'a> {
    /// No point of the solid is in it.
    Outside,
    /// All of it is in the solid.
    Inside,
    /// Small or simple enough: what is left of the program in it. The paper's *full* node.
    Leaf(&'a [u32]),
}

/// A reference to a cell: two bits of kind, thirty of index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub(crate) struct CellWord(u32);

/// A [`CellWord`], decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Outside,
    Inside,
    /// Offset of the leaf's program.
    Leaf(u32),
    /// Index of the branch: the paper's *mixed* node.
    Branch(u32),
}

impl CellWord {
    pub(crate) const OUTSIDE: Self = Self(0);
    pub(crate) const INSIDE: Self = Self(1 << 30);

    pub(crate) fn leaf(program: u32) -> Self {
        debug_assert!(program < 1 << 30);
        Self(2 << 30 | program)
    }

    pub(crate) fn branch(index: u32) -> Self {
        debug_assert!(index < 1 << 30);
        Self(3 << 30 | index)
    }

    /// What it is in memory.
    pub(crate) fn bits(self) -> u32 {
        self.0
    }

    #[inline]
    pub(crate) fn kind(self) -> Kind {
        let index = self.0 & ((1 << 30) - 1);
        match self.0 >> 30 {
            0 => Kind::Outside,
            1 => Kind::Inside,
            2 => Kind::Leaf(index),
            _ => Kind::Branch(index),
        }
    }
}

/// An octree over a cube. A branch has children of different kinds: eight empty or eight full ones are joined. Child `i` of a branch is on the high side in x, y, z where bit 0, 1, 2 of `i` is set.
///
/// Programs of leaves hold a little beyond their cells, by [`margin`](Self::margin): that covers every rounding in the
/// position of a hit.
#[derive(Clone, Debug)]
pub struct Octree {
    pub(crate) center: Vec3,
    pub(crate) half: f64,
    pub(crate) margin: f64,
    pub(crate) root: CellWord,
    pub(crate) branches: Vec<[CellWord; 8]>,
    pub(crate) programs: Vec<u32>,
    /// Whether some leaf holds a whole solid ([`Surface::Placed`](crate::surface::Surface)) and something else.
    pub(crate) has_mixed_leaves: bool,
    depth: u32,
    surfaces_classified: u64,
}

/// How large an octree is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OctreeStats {
    /// Cells with eight children.
    pub branches: usize,
    /// Cells with a program.
    pub leaves: usize,
    /// Cells without a point of the solid.
    pub outside: usize,
    /// Cells that are all solid.
    pub inside: usize,
    /// Levels below the root.
    pub depth: u32,
    /// Words in the leaves' programs, equal ones counted once.
    pub program_words: usize,
    /// Memory, in bytes.
    pub bytes: usize,
    /// How often a surface was classified against a cell while building.
    pub surfaces_classified: u64,
}

impl OctreeStats {
    /// Both together; the depth is the greater one.
    pub fn and(self, o: Self) -> Self {
        Self {
            branches: self.branches + o.branches,
            leaves: self.leaves + o.leaves,
            outside: self.outside + o.outside,
            inside: self.inside + o.inside,
            depth: self.depth.max(o.depth),
            program_words: self.program_words + o.program_words,
            bytes: self.bytes + o.bytes,
            surfaces_classified: self.surfaces_classified + o.surfaces_classified,
        }
    }
}

impl Octree {
    /// The cube that is cut up.
    pub fn bounds(&self) -> Bounds {
        let half = Vec3::splat(self.half);
        Bounds::new(self.center - half, self.center + half)
    }

    /// Levels below the root.
    pub fn depth(&self) -> u32 {
        self.depth
    }

    /// By how much the programs of cells hold beyond them, in scene units.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// The program that starts at that offset.
    pub(crate) fn program(&self, offset: u32) -> &[u32] {
        let start = offset as usize;
        &self.programs[start..node_end(&self.programs, start)]
    }

    /// The middle of child `octant` of a cell.
    #[inline]
    pub(crate) fn child_center(center: Vec3, child_half: f64, octant: usize) -> Vec3 {
        let side = |bit: usize| if octant & bit == 0 { -child_half } else { child_half };
        center + Vec3::new(side(1), side(2), side(4))
    }

    /// The box of a cell, grown by the margin.
    pub(crate) fn grown(&self, center: Vec3, half: f64) -> CellBox {
        CellBox::with_margin(center, Vec3::splat(half), self.margin)
    }

    /// Counts its cells.
    pub fn stats(&self) -> OctreeStats {
        let mut stats = OctreeStats {
            branches: self.branches.len(),
            depth: self.depth,
            program_words: self.programs.len(),
            bytes: size_of_val(&self.branches[..]) + size_of_val(&self.programs[..]),
            surfaces_classified: self.surfaces_classified,
            ..OctreeStats::default()
        };
        for cell in self.branches.iter().flatten().chain([&self.root]) {
            match cell.kind() {
                Kind::Outside => stats.outside += 1,
                Kind::Inside => stats.inside += 1,
                Kind::Leaf(_) => stats.leaves += 1,
                Kind::Branch(_) => {}
            }
        }
        stats
    }
}
