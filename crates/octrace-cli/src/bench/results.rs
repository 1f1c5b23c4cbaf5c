//! What was measured: plain data, written as it is with `--json`.

use crate::statistics::Spread;
use crate::stats::Rays;
use serde::Serialize;

/// One scene. Times are medians, of processor time where one thread works; `spread` says how far they go apart.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The scene's name, or the file's.
    pub scene: String,
    /// Leaves of the CSG tree.
    pub primitives: usize,
    /// Different surfaces.
    pub surfaces: usize,
    /// The octree's size.
    pub bytes: usize,
    /// The file's size; null for scenes that come with the program.
    pub file_bytes: Option<usize>,
    /// Seconds from text to scene; null for scenes that come with the program.
    pub parse_s: Option<f64>,
    /// Seconds from scene to program.
    pub compile_s: f64,
    /// Seconds from scene to tracer: program and octree.
    pub build_s: f64,
    /// Camera rays in millions a second: generated, traced; normal, Lambert's cosine, stored. One thread.
    pub mrays_per_s: f64,
    /// The same where each pixel is told which surface it shows: what the machine can do at best. Null where that cannot
    /// be measured.
    pub limit_mrays_per_s: Option<f64>,
    /// The limit over the rate, of the same round; null without a limit.
    pub ratio_to_limit: Option<f64>,
    /// Threads of the measurement with several.
    pub threads: usize,
    /// How much faster these threads are than one, on the wall's clock; null where there is but one.
    pub speedup: Option<f64>,
    /// Camera and shadow rays in millions a second, when the first light casts shadows. One thread.
    pub shadowed_mrays_per_s: f64,
    /// Seconds for the frame that `render` makes with one sample: all lights, shadows, reflections, refractions. One thread.
    pub frame_s: f64,
    /// Rays of that frame.
    pub frame_rays: Rays,
    /// Rays handed to the canonical tracer; other than 0 is a defect.
    pub leaks: u64,
    /// Medians, least and greatest.
    pub spread: Spreads,
}

/// From where to where the rounds' values go.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Spreads {
    /// See [`Row::parse_s`].
    pub parse_s: Option<Spread>,
    /// See [`Row::compile_s`].
    pub compile_s: Spread,
    /// See [`Row::build_s`].
    pub build_s: Spread,
    /// See [`Row::mrays_per_s`].
    pub mrays_per_s: Spread,
    /// See [`Row::limit_mrays_per_s`].
    pub limit_mrays_per_s: Option<Spread>,
    /// See [`Row::ratio_to_limit`].
    pub ratio_to_limit: Option<Spread>,
    /// See [`Row::speedup`].
    pub speedup: Option<Spread>,
    /// See [`Row::shadowed_mrays_per_s`].
    pub shadowed_mrays_per_s: Spread,
    /// See [`Row::frame_s`].
    pub frame_s: Spread,
}

impl Row {
    /// Seconds from the file's text to the frame, for files.
    pub fn first_picture_s(&self) -> f64 {
        self.parse_s.unwrap_or(0.0) + self.build_s + self.frame_s
    }
}
