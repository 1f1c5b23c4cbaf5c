//! Building: items are parted where rays are expected to gain most, by the surfaces of the boxes on either side.

use super::{BoxTree, Frame, Node};
use crate::geom::{Bounds, Vec3};

/// More items than this never share a leaf, unless all have the same box.
const LEAF_ITEMS: usize = 4;
/// Ways to part items that are weighed, along an axis.
const BINS: usize = 16;
/// So many levels are parted by cost; below that by number, which makes no more than 32 others.
const LEVELS_BY_COST: usize = BoxTree::MOST_LEVELS - 34;
/// What looking at an item costs, where a box costs 1.
const ITEM_COST: f32 = 2.0;
/// So many items are worth a thread.
const PARALLEL_ITEMS: usize = 1 << 13;

/// Boxes are larger than what is in them by this, at least; single precision is good to half of it.
const GROWTH: f64 = 1.2e-7;
/// And by this part of the largest coordinate: it covers rounding also of rays that start thousands of times as far away.
pub(in crate::primitive) const GROWTH_BY_COORDINATES: f64 = 1.0 / (1_u64 << 36) as f64;

/// Coordinates, and a number that does not matter: four are as quick as one.
type Corner = [f32; 4];

/// A box in the tree's frame, and which item's it is.
#[derive(Clone, Copy)]
struct Item {
    low: Corner,
    high: Corner,
    number: u32,
}

impl Item {
    /// Twice the middle.
    #[inline(always)]
    fn middle(&self, axis: usize) -> f32 {
        self.low[axis] + self.high[axis]
    }

    /// Twice the middle.
    #[inline(always)]
    fn middles(&self) -> Corner {
        std::array::from_fn(|i| self.low[i] + self.high[i])
    }
}

/// A box that grows.
#[derive(Clone, Copy)]
struct Hull {
    low: Corner,
    high: Corner,
}

/// The smaller of each.
#[inline(always)]
fn least(a: Corner, b: Corner) -> Corner {
    std::array::from_fn(|i| if a[i] < b[i] { a[i] } else { b[i] })
}

/// The larger of each.
#[inline(always)]
fn greatest(a: Corner, b: Corner) -> Corner {
    std::array::from_fn(|i| if a[i] > b[i] { a[i] } else { b[i] })
}

/// Without the number that does not matter.
fn point([x, y, z, _]: Corner) -> [f32; 3] {
    [x, y, z]
}

impl Hull {
    const EMPTY: Self = Self { low: [f32::INFINITY; 4], high: [f32::NEG_INFINITY; 4] };

    #[inline(always)]
    fn add(&mut self, low: Corner, high: Corner) {
        self.low = least(self.low, low);
        self.high = greatest(self.high, high);
    }

    /// Half the surface.
    fn area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| (self.high[axis] - self.low[axis]).max(0.0));
        x * y + y * z + z * x
    }
}

impl BoxTree {
    /// The tree over so many items with these boxes, each grown by `slack`; and the items in the order of its leaves. Depends
    /// on the boxes and their order only.
    pub fn build(count: usize, slack: f64, box_of: impl Fn(usize) -> Bounds) -> (Self, Vec<u32>) {
        let bounds = (0..count).fold(Bounds::EMPTY, |all, item| all.union(box_of(item)));
        if count == 0 {
            let frame = Frame { center: Vec3::ZERO, scale: 1.0 };
            return (Self { nodes: Vec::new(), frame, bounds }, Vec::new());
        }
        let farthest = bounds.min.max_abs().max(bounds.max.max_abs());
        let half = bounds.max * 0.5 - bounds.min * 0.5;
        // What is tiny and far away is hardly told apart: no number shall get out of hand.
        let scale = half.max_abs().max(farthest * GROWTH_BY_COORDINATES).max(slack).max(f64::MIN_POSITIVE * 1e30);
        let frame = Frame { center: bounds.min * 0.5 + bounds.max * 0.5, scale };
        let growth = Vec3::splat(GROWTH + slack / scale + GROWTH_BY_COORDINATES * (farthest / scale));
        let single = |p: Vec3| [p.x as f32, p.y as f32, p.z as f32, 0.0];
        let item = |number: usize| {
            let Bounds { min, max } = box_of(number);
            let (low, high) = ((min - frame.center) / scale - growth, (max - frame.center) / scale + growth);
            Item { low: single(low), high: single(high), number: number as u32 }
        };
        let mut items: Vec<Item> = (0..count).map(item).collect();
        let nodes = grow(&mut items, 0, 0);
        (Self { nodes, frame, bounds }, items.iter().map(|item| item.number).collect())
    }
}

/// The nodes over some items, which are put in order; the first of them is number `first`.
fn grow(items: &mut [Item], first: usize, level: usize) -> Vec<Node> {
    if items.len() < PARALLEL_ITEMS {
        let mut nodes = Vec::with_capacity(items.len());
        grow_into(items, first, level, &mut nodes);
        return nodes;
    }
    let hull = hull_of(items);
    let Some((axis, middle)) = part(items, &hull, level) else {
        return vec![Node::leaf(point(hull.low), point(hull.high), first as u32, items.len() as u32)];
    };
    let (low, high) = items.split_at_mut(middle);
    let (low, high) = rayon::join(|| grow(low, first, level + 1), || grow(high, first + middle, level + 1));
    let mut nodes = Vec::with_capacity(1 + low.len() + high.len());
    nodes.push(Node { link: 1 + low.len() as u32, ..Node::branch(point(hull.low), point(hull.high), axis) });
    nodes.extend(low);
    nodes.extend(high);
    nodes
}

/// As [`grow`], behind other nodes. No deeper than [`BoxTree::MOST_LEVELS`].
fn grow_into(items: &mut [Item], first: usize, level: usize, nodes: &mut Vec<Node>) {
    let hull = hull_of(items);
    let Some((axis, middle)) = part(items, &hull, level) else {
        nodes.push(Node::leaf(point(hull.low), point(hull.high), first as u32, items.len() as u32));
        return;
    };
    let number = nodes.len();
    nodes.push(Node::branch(point(hull.low), point(hull.high), axis));
    let (low, high) = items.split_at_mut(middle);
    grow_into(low, first, level + 1, nodes);
    nodes[number].link = (nodes.len() - number) as u32;
    grow_into(high, first + middle, level + 1, nodes);
}

fn hull_of(items: &[Item]) -> Hull {
    let mut hull = Hull::EMPTY;
    items.iter().for_each(|item| hull.add(item.low, item.high));
    hull
}

/// Parts items: the axis, and how many come first. `None` where they are to share a leaf.
fn part(items: &mut [Item], hull: &Hull, level: usize) -> Option<(usize, usize)> {
    if items.len() <= 1 {
        return None;
    }
    let mut middles = Hull::EMPTY;
    items.iter().for_each(|item| middles.add(item.middles(), item.middles()));
    let Hull { low, high } = middles;
    let axis = Vec3::from([0, 1, 2].map(|axis| f64::from(high[axis] - low[axis]))).largest_axis();
    let extent = high[axis] - low[axis];
    if level < LEVELS_BY_COST && extent > 0.0 && items.len() > 2 {
        let bins = BINS as f32 / extent;
        let bin_of = |item: &Item| (((item.middle(axis) - low[axis]) * bins) as usize).min(BINS - 1);
        if let Some((bin, cost)) = cheapest(items, bin_of) {
            if items.len() <= LEAF_ITEMS && ITEM_COST * items.len() as f32 * hull.area() <= cost + hull.area() {
                return None;
            }
            return Some((axis, partition(items, |item| bin_of(item) <= bin)));
        }
    }
    if items.len() <= LEAF_ITEMS {
        return None;
    }
    let middle = items.len() / 2;
    let key = |item: &Item| (item.middle(axis), item.number);
    items.select_nth_unstable_by(middle, |a, b| {
        let ((a, i), (b, j)) = (key(a), key(b));
        a.total_cmp(&b).then(i.cmp(&j))
    });
    Some((axis, middle))
}

/// After which bin to part items, and what that costs, times the surface of the whole; `None` where all are in one.
fn cheapest(items: &[Item], bin_of: impl Fn(&Item) -> usize) -> Option<(usize, f32)> {
    let mut bins = [(Hull::EMPTY, 0_u32); BINS];
    for item in items {
        let (hull, count) = &mut bins[bin_of(item)];
        hull.add(item.low, item.high);
        *count += 1;
    }
    let mut behind = [0.0; BINS];
    let (mut hull, mut count) = (Hull::EMPTY, 0);
    for bin in (1..BINS).rev() {
        hull.add(bins[bin].0.low, bins[bin].0.high);
        count += bins[bin].1;
        behind[bin - 1] = if count == 0 { f32::INFINITY } else { ITEM_COST * count as f32 * hull.area() };
    }
    let (mut hull, mut count) = (Hull::EMPTY, 0);
    let mut best: Option<(usize, f32)> = None;
    for bin in 0..BINS - 1 {
        hull.add(bins[bin].0.low, bins[bin].0.high);
        count += bins[bin].1;
        let cost = ITEM_COST * count as f32 * hull.area() + behind[bin];
        if count > 0 && cost < best.map_or(f32::INFINITY, |(_, cost)| cost) {
            best = Some((bin, cost));
        }
    }
    best
}

/// Puts those first for which it holds; says how many.
fn partition(items: &mut [Item], is_first: impl Fn(&Item) -> bool) -> usize {
    let mut count = 0;
    for i in 0..items.len() {
        if is_first(&items[i]) {
            items.swap(count, i);
            count += 1;
        }
    }
    count
}
