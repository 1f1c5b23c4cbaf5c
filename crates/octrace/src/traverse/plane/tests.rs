//! The walk in the plane against exact rational arithmetic, on random trees and lines.

use super::{Line, Move, Quadtree, Square, Step, walk};
use num_rational::Ratio;
use proptest::prelude::*;
use std::ops::ControlFlow;

type Exact = Ratio<i128>;

/// The squares in which the line has a positive length, in order: by cutting it with every leaf.
fn reference(tree: &Quadtree, start: [i64; 2], direction: [i64; 2]) -> Vec<Square> {
    let mut found = Vec::new();
    for square in tree.leaves() {
        let (mut first, mut last) = (Exact::from(0), None::<Exact>);
        let mut misses = false;
        for axis in 0..2 {
            let (low, high) = (square.corner[axis], square.corner[axis] + square.side);
            let (o, d) = (start[axis], direction[axis]);
            if d == 0 {
                misses |= !(low..high).contains(&o);
                continue;
            }
            let at = |place: i64| Exact::new(i128::from(place - o), i128::from(d));
            let (a, b) = (at(low).min(at(high)), at(low).max(at(high)));
            first = first.max(a);
            last = Some(last.map_or(b, |last| last.min(b)));
        }
        if !misses && last.is_some_and(|last| first < last) {
            found.push((first, square));
        }
    }
    found.sort_by_key(|&(first, _)| first);
    found.into_iter().map(|(_, square)| square).collect()
}

fn steps(tree: &Quadtree, start: [i64; 2], direction: [i64; 2]) -> Vec<Step> {
    let line = Line::new(start, direction).expect("a direction");
    let mut steps = Vec::new();
    let _ = walk(tree, &line, |step| {
        steps.push(*step);
        ControlFlow::<()>::Continue(())
    });
    steps
}

fn visited(steps: &[Step]) -> Vec<Square> {
    steps.iter().filter(|step| step.leaf).map(|step| step.square).collect()
}

/// A tree that is divided at random, the same for the same seed.
fn random_tree(side_log: u32, depth: u32, seed: u64, density: u64) -> Quadtree {
    Quadtree::new(side_log, |Square { level, corner, .. }| {
        let mut hash = seed ^ (corner[0] as u64) << 40 ^ (corner[1] as u64) << 8 ^ u64::from(level);
        for _ in 0..2 {
            hash = (hash ^ hash >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        }
        level < depth && (level == 0 || hash >> 40 & 7 < density)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, ..ProptestConfig::default() })]

    /// Points and directions are coarse, so that lines along sides and through corners are frequent.
    #[test]
    fn the_walk_visits_what_exact_arithmetic_finds(
        seed in any::<u64>(), density in 3u64..8, depth in 0u32..6,
        start in prop::array::uniform2(0i64..=32), direction in prop::array::uniform2(-9i64..=9),
        fine in 0u32..3,
    ) {
        prop_assume!(direction != [0, 0]);
        let tree = random_tree(5 + fine, depth, seed, density);
        let start = start.map(|place| place << fine);
        let steps = steps(&tree, start, direction);
        prop_assert_eq!(visited(&steps), reference(&tree, start, direction));

        // At every step the terms are what they are defined to be, in the frame where the line ascends.
        let root = tree.root().side;
        let [mut d, mut o] = [direction, start];
        for axis in 0..2 {
            if d[axis] < 0 {
                (d[axis], o[axis]) = (-d[axis], root - o[axis]);
            }
        }
        for Step { square, terms, .. } in steps {
            let mut corner = square.corner;
            for axis in 0..2 {
                if direction[axis] < 0 {
                    corner[axis] = root - corner[axis] - square.side;
                }
            }
            let (x, y) = if d[1] > d[0] { (1, 0) } else { (0, 1) };
            let (a, b) = (o[x] - corner[x], o[y] - corner[y]);
            prop_assert_eq!(terms.error, d[y] * (square.side - a) + d[x] * b);
            prop_assert_eq!((terms.side, terms.increment), (d[x] * square.side, d[y] * square.side));
        }
    }

    /// The largest numbers allowed do not overflow.
    #[test]
    fn large_numbers_are_walked_exactly(
        seed in any::<u64>(), start in prop::array::uniform2(0i64..=1 << 30),
        direction in prop::array::uniform2(-Line::MAX_DIRECTION..=Line::MAX_DIRECTION),
    ) {
        prop_assume!(direction != [0, 0]);
        let tree = random_tree(Quadtree::MAX_SIDE_LOG, 7, seed, 5);
        prop_assert_eq!(visited(&steps(&tree, start, direction)), reference(&tree, start, direction));
    }
}

#[test]
fn a_corner_of_a_small_square_may_lie_in_the_side_of_a_large_one() {
    // The left half is divided twice, the right half once: the line goes through (4, 2), in the middle of a left side.
    let tree = Quadtree::new(3, |square| square.level == 0 || (square.level == 1 && square.corner[0] == 0));
    let steps = steps(&tree, [2, 0], [1, 1]);
    let kinds: Vec<Move> = steps.iter().map(|step| step.kind).collect();
    use Move::{Horizontal, Integrate, Refine, Start, Vertical};
    assert_eq!(kinds, [Start, Refine, Refine, Integrate, Horizontal, Vertical], "no diagonal move: {steps:?}");
    assert_eq!(visited(&steps).iter().map(|square| square.corner).collect::<Vec<_>>(), [[2, 0], [4, 0], [4, 4]]);
}

#[test]
fn lines_that_only_touch_the_tree_visit_nothing() {
    let tree = random_tree(3, 2, 1, 7);
    let far = [i64::MIN, i64::MAX];
    let starts = [[8, 3], [3, 8], [0, 8], [-1, 3], far];
    for (start, direction) in starts.into_iter().zip([[1, 0], [1, 0], [3, 1], [1, 0], [-7, 9]]) {
        assert_eq!(steps(&tree, start, direction), []);
    }
    assert_eq!(visited(&steps(&tree, [0, 0], [1, 0])), reference(&tree, [0, 0], [1, 0]), "along the bottom");
    assert!(Line::new([0, 0], [0, 0]).is_none() && Line::new([0, 0], [1 << 31, 0]).is_none());
}
