//! How much work a boolean operation will be, found out before it is begun.

use super::source::Chord;
use crate::plane::PlaneError;

/// More crossings than this are too many: memory and time grow with them.
const MOST_CROSSINGS: f64 = 1e6;
/// More edges than this are too many.
const MOST_CHORDS: usize = 20_000_000;
/// With fewer chords there cannot be too many crossings.
const FEW: usize = 1400;
/// Pairs that are looked at to estimate the number of crossings: with too many, some hundreds of these cross.
const SAMPLES: u32 = 200_000;

/// Estimates the number of crossings from pairs chosen evenly.
pub(super) fn check(chords: &[Chord]) -> Result<(), PlaneError> {
    let count = chords.len();
    if count < FEW {
        return Ok(());
    }
    let too_complex = Err(PlaneError::TooComplex { edges: count });
    if count > MOST_CHORDS {
        return too_complex;
    }
    // A multiplicative generator: the same pairs on every machine.
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (((state >> 33) * count as u64) >> 31) as usize
    };
    let crossing = (0..SAMPLES).filter(|_| cross(&chords[draw()], &chords[draw()])).count();
    let pairs = count as f64 * count as f64 * 0.5;
    if crossing as f64 / f64::from(SAMPLES) * pairs > MOST_CROSSINGS { too_complex } else { Ok(()) }
}

fn cross(a: &Chord, b: &Chord) -> bool {
    let side = |c: &Chord, x: i64, y: i64| {
        let (ux, uy) = (c.to.x - c.from.x, c.to.y - c.from.y);
        i128::from(ux) * i128::from(y - c.from.y) > i128::from(uy) * i128::from(x - c.from.x)
    };
    side(a, b.from.x, b.from.y) != side(a, b.to.x, b.to.y) && side(b, a.from.x, a.from.y) != side(b, a.to.x, a.to.y)
}
