//! Strips of planes in place of the surfaces, neither cones nor cylinders, that hulls have between things such as slanted discs.
//!
//! Between two things a plane rolls that touches both; where it touches is a straight line, a ruling. A few rulings come in
//! as a chain; from them as many are found as it takes for strips to be nowhere farther from the surface than they may be.

use super::support::{Thing, Touch, touch};

/// So many strips are between two things at most.
const MOST: u32 = 4096;

/// A ruling, with the normal of the plane that touches there.
pub(super) type Ruling = Touch<2>;

/// How exact strips are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Precision {
    /// How far strips may be off (scene units).
    pub deviation: f64,
    /// Lengths below this are rounding.
    pub noise: f64,
}

impl Ruling {
    /// How far the surface is from the strip between two rulings, about: as a circle that turns by as much.
    pub fn sagitta(&self, other: &Self) -> f64 {
        let chord = |side: usize| (other.points[side] - self.points[side]).length();
        chord(0).max(chord(1)) * (other.normal - self.normal).length() / 8.0
    }
}

/// As many rulings between two things as are needed, from the first of the chain to the last, evenly: strips between them
/// are as far off as they may be.
pub(super) fn rulings(things: &[Thing; 2], chain: &[Ruling], precision: Precision) -> Vec<Ruling> {
    let (Some(first), Some(last)) = (chain.first(), chain.last()) else { return Vec::new() };
    // How many strips there have to be up to each of the chain, for a circle's sagitta goes with the square of its angle.
    let mut strips = vec![0.0];
    for pair in chain.windows(2) {
        let more = (pair[0].sagitta(&pair[1]) / precision.deviation).sqrt();
        strips.push(strips[strips.len() - 1] + more);
    }
    let total = strips[strips.len() - 1];
    let count = (total.ceil() as u32).clamp(1, MOST);
    let between = |i: u32| {
        let at = total * f64::from(i) / f64::from(count);
        let next = strips.partition_point(|&strip| strip <= at).clamp(1, chain.len() - 1);
        let share = (at - strips[next - 1]) / (strips[next] - strips[next - 1]);
        let (start, end) = (&chain[next - 1], &chain[next]);
        let near = start.normal * (1.0 - share) + end.normal * share;
        touch(things, near, precision.noise).unwrap_or_else(|| start.clone())
    };
    let inner = if chain.len() > 1 { 1..count } else { 0..0 };
    std::iter::once(first.clone()).chain(inner.map(between)).chain([last.clone()]).collect()
}
