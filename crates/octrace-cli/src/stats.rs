//! Times and counts of one picture, for programs.

use octrace::Tracer;
use octrace::octree::OctreeStats;
use octrace::shade::RayCounts;
use serde::Serialize;
use std::time::Instant;

/// Seconds per stage.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Seconds {
    /// From file to scene.
    pub read: f64,
    /// From scene to tracer: program and octree.
    pub build: f64,
    /// From tracer to film.
    pub render: f64,
    /// From film to file.
    pub write: f64,
    /// All of it.
    pub total: f64,
}

/// Measures one stage after the other.
pub struct Stopwatch {
    lap: Instant,
}

impl Stopwatch {
    /// Starts.
    pub fn start() -> Self {
        Self { lap: Instant::now() }
    }

    /// Seconds since the last lap ended.
    pub fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let elapsed = now.duration_since(self.lap);
        self.lap = now;
        elapsed.as_secs_f64()
    }

    /// Seconds since the last lap ended; the lap goes on.
    pub fn elapsed(&self) -> f64 {
        self.lap.elapsed().as_secs_f64()
    }
}

/// Everything there is to count.
#[derive(Debug, Serialize)]
pub struct Stats<'a> {
    /// The file drawn.
    pub file: &'a str,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Camera rays per pixel.
    pub samples: u32,
    /// Threads used.
    pub threads: usize,
    /// `octree` or `none`.
    pub accel: String,
    /// How the octree is walked.
    pub traversal: String,
    /// Time.
    pub seconds: Seconds,
    /// The most memory that the process has had at a time, in bytes, where the system tells.
    pub peak_memory_bytes: Option<u64>,
    /// Rays by kind.
    pub rays: Rays,
    /// Rays of all kinds per second of rendering, in millions.
    pub mrays_per_second: f64,
    /// Octree cells visited.
    pub cells_visited: u64,
    /// Intersections of rays with surfaces computed.
    pub surface_tests: u64,
    /// Rays that the octree had to hand to the canonical tracer; anything but zero is a defect worth reporting.
    pub leaks: u64,
    /// What was drawn.
    pub solid: SolidStats,
    /// The octree, if there is one.
    pub octree: Option<Octree>,
    /// What the import tolerance did.
    pub snap: Snap,
}

/// The most memory that this process has had at a time, in bytes, as far as the system tells.
#[cfg(unix)]
pub fn peak_memory_bytes() -> Option<u64> {
    use nix::sys::resource::{UsageWho, getrusage};
    // Apple's systems count bytes, Linux and the BSDs units of 1,024.
    const UNIT: u64 = if cfg!(target_vendor = "apple") { 1 } else { 1024 };
    let usage = getrusage(UsageWho::RUSAGE_SELF).ok()?;
    u64::try_from(usage.max_rss()).ok().filter(|&peak| peak > 0).map(|peak| peak * UNIT)
}

/// Other systems are not asked.
#[cfg(not(unix))]
pub fn peak_memory_bytes() -> Option<u64> {
    None
}

/// Rays by kind.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Rays {
    /// From the camera.
    pub camera: u64,
    /// To a light.
    pub shadow: u64,
    /// Mirrored.
    pub reflected: u64,
    /// Bent.
    pub refracted: u64,
    /// All of them.
    pub total: u64,
}

impl From<&RayCounts> for Rays {
    fn from(counts: &RayCounts) -> Self {
        let RayCounts { camera, shadow, reflected, refracted } = *counts;
        Self { camera, shadow, reflected, refracted, total: camera + shadow + reflected + refracted }
    }
}

/// What a tracer was built from.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SolidStats {
    /// Leaves of the CSG tree.
    pub primitives: usize,
    /// Different surfaces after compilation.
    pub surfaces: usize,
}

/// How large an octree is.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Octree {
    branches: usize,
    leaves: usize,
    outside: usize,
    inside: usize,
    depth: u32,
    program_words: usize,
    bytes: usize,
}

impl From<&OctreeStats> for Octree {
    fn from(stats: &OctreeStats) -> Self {
        let OctreeStats { branches, leaves, outside, inside, depth, program_words, bytes, .. } = *stats;
        Self { branches, leaves, outside, inside, depth, program_words, bytes }
    }
}

/// What the import tolerance did.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Snap {
    /// Surfaces closer than this were made one, in scene units.
    pub tolerance: f64,
    /// How many were moved by more than rounding explains.
    pub surfaces: usize,
    /// The farthest move, in scene units.
    pub largest_move: f64,
}

impl From<&Tracer> for Snap {
    fn from(tracer: &Tracer) -> Self {
        let report = tracer.compile_report();
        Self { tolerance: report.tolerance, surfaces: report.snapped_surfaces, largest_move: report.largest_move }
    }
}

impl From<&Tracer> for SolidStats {
    fn from(tracer: &Tracer) -> Self {
        let stats = tracer.stats();
        Self { primitives: stats.primitives, surfaces: stats.surfaces }
    }
}
