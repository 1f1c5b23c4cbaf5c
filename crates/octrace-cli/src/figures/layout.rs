//! Where the nodes of a small tree go: parents in the middle above their children, nothing overlapping.

/// A node of the tree to lay out.
#[derive(Clone, Debug, Default)]
pub struct Block {
    /// How much room it needs across.
    pub breadth: f64,
    /// Indices of its children, in order.
    pub children: Vec<usize>,
}

/// The tree laid out.
#[derive(Clone, Debug)]
pub struct Layout {
    /// For each node its middle across, and its depth below the root.
    pub places: Vec<(f64, usize)>,
    /// How much room everything needs across.
    pub breadth: f64,
    /// The depth of the deepest node.
    pub depth: usize,
}

/// Lays out the tree under node 0; children come behind their parents in `blocks`.
pub fn layout(blocks: &[Block], gap: f64) -> Layout {
    let mut needed: Vec<f64> = blocks.iter().map(|block| block.breadth).collect();
    let rows = |needed: &[f64], children: &[usize]| {
        let sum: f64 = children.iter().map(|&child| needed[child]).sum();
        sum + gap * children.len().saturating_sub(1) as f64
    };
    for (index, block) in blocks.iter().enumerate().rev() {
        needed[index] = needed[index].max(rows(&needed, &block.children));
    }
    let mut left = vec![0.0; blocks.len()];
    let mut places = vec![(0.0, 0); blocks.len()];
    for (index, block) in blocks.iter().enumerate() {
        let mut next = left[index] + (needed[index] - rows(&needed, &block.children)) / 2.0;
        for &child in &block.children {
            left[child] = next;
            next += needed[child] + gap;
            places[child].1 = places[index].1 + 1;
        }
    }
    for (index, block) in blocks.iter().enumerate().rev() {
        places[index].0 = match (block.children.first(), block.children.last()) {
            (Some(&first), Some(&last)) => (places[first].0 + places[last].0) / 2.0,
            _ => left[index] + needed[index] / 2.0,
        };
    }
    let depth = places.iter().map(|place| place.1).max().unwrap_or(0);
    Layout { places, breadth: needed.first().copied().unwrap_or(0.0), depth }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parents_are_in_the_middle_and_nothing_overlaps() {
        let block = |children: &[usize]| Block { breadth: 10.0, children: children.to_vec() };
        let laid = layout(&[block(&[1, 2]), block(&[3, 4]), block(&[]), block(&[]), block(&[])], 2.0);
        assert_eq!(laid.places.iter().map(|p| p.1).collect::<Vec<_>>(), [0, 1, 1, 2, 2]);
        assert_eq!((laid.breadth, laid.depth), (34.0, 2));
        assert_eq!(laid.places.iter().map(|p| p.0).collect::<Vec<_>>(), [20.0, 11.0, 29.0, 5.0, 17.0]);
    }
}
