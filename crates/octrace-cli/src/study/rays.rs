//! The rays of a picture, and what is done with them in one go.

use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::stats::Stopwatch;
use octrace::trace::{Counters, Scratch};
use octrace::{Camera, Hit, Ray, Tracer};
use std::hint::black_box;

/// One ray through the middle of each pixel, row by row.
pub fn of_picture(camera: &Camera, (width_px, height_px): (u32, u32)) -> Vec<Ray> {
    let rays = camera.rays(width_px, height_px);
    let row = |y: u32| (0..width_px).map(move |x| rays.ray(f64::from(x) + 0.5, f64::from(y) + 0.5));
    (0..height_px).flat_map(row).collect()
}

/// About `count` of `total` things, spread over them by the golden ratio, ascending; all if that many are wanted.
pub fn spread(count: usize, total: usize) -> Vec<usize> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    if count >= total {
        return (0..total).collect();
    }
    let mut chosen: Vec<usize> = (0..count).map(|i| ((i as f64 * GOLDEN).fract() * total as f64) as usize).collect();
    chosen.sort_unstable();
    chosen.dedup();
    chosen
}

/// The first hit of each ray, and what was counted.
pub fn trace<'a>(
    tracer: &Tracer,
    rays: impl Iterator<Item = &'a Ray>,
    interrupt: &Interrupt,
) -> Result<(Vec<Option<Hit>>, Counters), Failure> {
    let mut scratch = Scratch::default();
    let hits = rays.map(|ray| first_hit(tracer, ray, &mut scratch, interrupt)).collect::<Result<_, Failure>>()?;
    Ok((hits, scratch.counters))
}

/// How long finding the first hits of the rays takes, in seconds.
pub fn time<'a>(tracer: &Tracer, rays: impl Iterator<Item = &'a Ray>, interrupt: &Interrupt) -> Result<f64, Failure> {
    let mut scratch = Scratch::default();
    let watch = Stopwatch::start();
    for ray in rays {
        black_box(first_hit(tracer, ray, &mut scratch, interrupt)?);
    }
    Ok(watch.elapsed())
}

fn first_hit(tracer: &Tracer, ray: &Ray, scratch: &mut Scratch, interrupt: &Interrupt) -> Result<Option<Hit>, Failure> {
    if interrupt.happened() {
        return Err(Failure::Interrupted);
    }
    Ok(tracer.first_hit_within(ray, f64::INFINITY, scratch))
}

/// How many rays have different results, to the bit.
pub fn differing<'a>(a: impl Iterator<Item = &'a Option<Hit>>, b: impl Iterator<Item = &'a Option<Hit>>) -> u64 {
    let bits = |hit: &Option<Hit>| hit.map(|hit| (hit.t.to_bits(), hit.leaf, hit.surface, hit.entering, hit.flipped));
    std::iter::zip(a, b).filter(|(a, b)| bits(a) != bits(b)).count() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_are_spread_over_all() {
        assert_eq!(spread(7, 5), [0, 1, 2, 3, 4]);
        let few = spread(24, 49_152);
        assert_eq!(few.len(), 24);
        assert!(few.windows(2).all(|pair| pair[1] - pair[0] < 49_152 / 8), "{few:?}");
    }

    #[test]
    fn the_last_bit_counts() {
        let hit = |t: f64| Some(Hit { t, leaf: 0, surface: 0, entering: true, flipped: false });
        let next = f64::from_bits(1.0_f64.to_bits() + 1);
        let (a, b) = ([hit(1.0), None, hit(0.0)], [hit(next), None, hit(-0.0)]);
        assert_eq!(differing(a.iter(), b.iter()), 2);
        assert_eq!(differing(a.iter(), a.iter()), 0);
        assert_eq!(differing([hit(1.0)].iter(), [None].iter()), 1);
    }
}
