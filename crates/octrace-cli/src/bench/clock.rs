//! What work costs: seconds of processor time, which do not count what other programs do meanwhile, and seconds on the wall.

use crate::stats::Stopwatch;
use cpu_time::ProcessTime;

/// What some work took.
#[derive(Clone, Copy, Debug)]
pub struct Took {
    /// Seconds that went by.
    pub wall_s: f64,
    /// Seconds that all threads of this process worked; those that went by where the system does not tell.
    pub cpu_s: f64,
}

/// Does the work, and says what it took.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, Took) {
    let (wall, cpu) = (Stopwatch::start(), ProcessTime::try_now());
    let result = work();
    let wall_s = wall.elapsed();
    let cpu_s = cpu.and_then(|start| start.try_elapsed()).map_or(wall_s, |time| time.as_secs_f64());
    (result, Took { wall_s, cpu_s })
}
