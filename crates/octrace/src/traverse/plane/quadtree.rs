//! The quadtree: a square cut into quarters, these again, and so on.

/// A square of the tree, in units of the lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Square {
    /// How many times the root was quartered; 0 is the root.
    pub level: u32,
    /// The corner with the smallest coordinates.
    pub corner: [i64; 2],
    /// The length of its sides, a power of two.
    pub side: i64,
}

/// A quadtree with parents, as finding neighbours by common ancestors needs them [Samet 1982].
///
/// The four children of a square are neighbours in memory: quarter `q` is on the right where bit 0 of `q` is set, and above
/// where bit 1 is. So a node's index tells which quarter it is.
#[derive(Clone, Debug)]
pub struct Quadtree {
    side_log: u32,
    /// For each node the first of its four children; 0, which is nobody's child, where it has none.
    first_children: Vec<u32>,
    /// For each four children their parent.
    parents: Vec<u32>,
}

impl Quadtree {
    /// The root's index.
    pub(super) const ROOT: u32 = 0;
    /// The largest root that [`walk`](super::walk()) can handle has sides of two to the power of this.
    pub const MAX_SIDE_LOG: u32 = 30;

    /// The tree over a square of `2^side_log` units, in which those squares are quartered for which `divides` says so.
    /// Squares of one unit are never asked about.
    ///
    /// # Panics
    /// If `side_log` exceeds [`MAX_SIDE_LOG`](Self::MAX_SIDE_LOG).
    pub fn new(side_log: u32, mut divides: impl FnMut(Square) -> bool) -> Self {
        assert!(side_log <= Self::MAX_SIDE_LOG, "errors need 64 bits");
        let mut tree = Self { side_log, first_children: vec![0], parents: Vec::new() };
        let mut pending = vec![(Self::ROOT, tree.root())];
        while let Some((node, square)) = pending.pop() {
            if square.side == 1 || !divides(square) {
                continue;
            }
            let first = tree.first_children.len() as u32;
            tree.first_children[node as usize] = first;
            tree.first_children.extend([0; 4]);
            tree.parents.push(node);
            pending.extend((0..4).map(|quarter| (first + quarter as u32, square.quarter(quarter))));
        }
        tree
    }

    /// The square that is cut up.
    pub fn root(&self) -> Square {
        Square { level: 0, corner: [0, 0], side: 1 << self.side_log }
    }

    /// The squares that are not divided.
    pub fn leaves(&self) -> Vec<Square> {
        let (mut leaves, mut pending) = (Vec::new(), vec![(Self::ROOT, self.root())]);
        while let Some((node, square)) = pending.pop() {
            match self.children(node) {
                None => leaves.push(square),
                Some(first) => pending.extend((0..4).map(|q| (first + q as u32, square.quarter(q)))),
            }
        }
        leaves
    }

    /// The first of a node's four children, if it has any.
    pub(super) fn children(&self, node: u32) -> Option<u32> {
        Some(self.first_children[node as usize]).filter(|&first| first != 0)
    }

    /// The parent, and which quarter of it the node is; `None` at the root.
    pub(super) fn above(&self, node: u32) -> Option<(u32, usize)> {
        let place = node.checked_sub(1)? as usize;
        Some((self.parents[place / 4], place % 4))
    }
}

impl Square {
    fn quarter(self, quarter: usize) -> Self {
        let side = self.side / 2;
        let corner = [0, 1].map(|axis| self.corner[axis] + side * (quarter >> axis & 1) as i64);
        Self { level: self.level + 1, corner, side }
    }
}
