//! Strips of planes in place of the surfaces, neither cones nor cylinders, that hulls have between things such as slanted discs.
//!
//! Between two things a plane rolls that touches both; where it touches is a straight line, a ruling. A few rulings come in
//! as a chain; more are found between them, until a strip from one to the next is nowhere farther from the surface than
//! it may be.

use super::support::{Thing, Touch, touch};

/// Strips are halved so often at most.
const DEEPEST: u32 = 10;

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

/// As many rulings between two things as are needed, from one that is in the chain to the next, and no more. `is_seen` says
/// whether a plane has everything behind it.
pub(super) fn rulings(
    things: &[Thing; 2],
    chain: &[Ruling],
    precision: Precision,
    is_seen: impl Fn(&Ruling) -> bool,
) -> Vec<Ruling> {
    let mut fine: Vec<Ruling> = Vec::new();
    for pair in chain.windows(2) {
        let mut pending = vec![(pair[0].clone(), pair[1].clone(), 0)];
        while let Some((start, end, depth)) = pending.pop() {
            // Twice as many as needed, so that most of the surplus can go.
            let middle = (depth < DEEPEST && start.sagitta(&end) > 0.5 * precision.deviation)
                .then(|| touch(things, start.normal + end.normal, precision.noise))
                .flatten()
                .filter(&is_seen);
            match middle {
                Some(middle) => pending.extend([(middle.clone(), end, depth + 1), (start, middle, depth + 1)]),
                None => fine.push(start),
            }
        }
    }
    fine.extend(chain.last().cloned());
    let mut kept: Vec<Ruling> = Vec::new();
    for (i, ruling) in fine.iter().enumerate() {
        let needed = match (kept.last(), fine.get(i + 1)) {
            (Some(last), Some(next)) => last.sagitta(next) > precision.deviation,
            _ => true,
        };
        if needed {
            kept.push(ruling.clone());
        }
    }
    kept
}
