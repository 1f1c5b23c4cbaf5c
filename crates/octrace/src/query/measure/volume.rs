//! Volume and centroid, by adding up chords.
//!
//! Seen along a direction that no face contains, the length of solid behind each point of the picture is a *continuous*
//! function of the point. It is summed over a square grid of parallel rays; with a spacing `g`, edges leave an error of
//! the order of `g^2.5`, round silhouettes one of `g^2`, and smooth parts much less. The grid is four interleaved ones of
//! twice the spacing: their scatter, and what changed since the grid before, give the error. It is estimated on the safe
//! side, for the whole grid is better than each of its parts. The grid is made finer until the error suffices.

use super::MeasureOptions;
use super::body::{Body, Chord};
use crate::exec::{Cancelled, Exec};
use crate::geom::{Bounds, Ray, Vec3};
use rayon::prelude::*;

/// What integration finds out.
pub(super) struct Integral {
    pub volume: f64,
    pub volume_error: f64,
    pub centroid: Option<Vec3>,
    pub centroid_error: f64,
    pub converged: bool,
    pub rays: u64,
}

/// Points of the first grid along the edge of a square as large as the picture.
const FIRST_GRID: f64 = 96.0;
/// Fewer rays than this in the solid say nothing about its volume.
const FEWEST_HITS: u64 = 2000;

/// Where the grid lies, in its own spacing. Were it symmetric, its parts would be each other's mirror images for a
/// symmetric solid, and agree on the wrong answer.
const OFFSET: [f64; 2] = [0.3176, 0.2281];

/// Integrates over a body that lies within `room`.
pub(super) fn integrate(
    body: &impl Body,
    room: &Bounds,
    options: &MeasureOptions,
    exec: &Exec,
) -> Result<Integral, Cancelled> {
    let picture = Picture::around(room);
    let area = picture.half[0] * picture.half[1] * 4.0;
    let mut result =
        Integral { volume: 0.0, volume_error: 0.0, centroid: None, centroid_error: 0.0, converged: true, rays: 0 };
    if room.is_empty() || area <= 0.0 {
        return Ok(result);
    }
    let mut spacing = area.sqrt() / FIRST_GRID;
    let mut before: Option<Estimate> = None;
    loop {
        let estimate = picture.scan(body, spacing, exec)?;
        result.rays += estimate.rays;
        let volume = estimate.volume();
        let mut error = estimate.scatter();
        if let Some(before) = &before {
            error = error.max(0.5 * (volume - before.volume()).abs());
        }
        let tolerated = options.tolerance * volume;
        result.converged = before.is_some() && estimate.hits >= FEWEST_HITS && error <= tolerated;
        (result.volume, result.volume_error) = (volume, error);
        let centroid = estimate.centroid(&picture);
        (result.centroid, result.centroid_error) = (centroid.map(|c| c.0), centroid.map_or(0.0, |c| c.1));
        if result.converged {
            return Ok(result);
        }
        // The error goes with spacing^2 to spacing^2.5; aim a little lower, and never trust the law too far.
        let aim = if error > 0.0 { libm::pow(0.7 * tolerated / error, 0.45) } else { 0.5 };
        let affordable = options.max_rays.saturating_sub(result.rays) as f64 / estimate.rays as f64;
        if affordable < 1.5 {
            return Ok(result);
        }
        spacing *= aim.clamp(0.2, 0.7).max((1.0 / affordable).sqrt());
        before = Some(estimate);
    }
}

/// The plane of parallel rays, and the rectangle that the room fills in it.
struct Picture {
    /// Right, up and away: orthonormal.
    axes: [Vec3; 3],
    center: Vec3,
    /// Half the rectangle's edges, right and up.
    half: [f64; 2],
}

/// Sums over some rays: chord length, and its first moments along the picture's axes.
type Moments = [f64; 4];

/// The sums of a row: rays with even and odd numbers apart.
#[derive(Clone, Copy, Default)]
struct Row {
    parts: [Moments; 2],
    hits: u64,
}

impl Picture {
    fn around(room: &Bounds) -> Self {
        // Directions as they happen to come from round numbers, multiples of 15 degrees about the axes above all, are at
        // least five degrees away; nor do axis-parallel edges meet the grid at such angles.
        let away = Vec3::new(0.364, 0.8098, 1.0);
        let away = away / away.length();
        let right = Vec3::new(0.619, -0.283, 0.733);
        let right = right - away * right.dot(away);
        let right = right / right.length();
        let up = away.cross(right);
        let reach = |axis: Vec3| axis.abs().dot(room.size()) * 0.5;
        Self { axes: [right, up, away], center: room.center(), half: [reach(right), reach(up)] }
    }

    /// Traces the grid with this spacing.
    fn scan(&self, body: &impl Body, spacing: f64, exec: &Exec) -> Result<Estimate, Cancelled> {
        // Points at (i + OFFSET) * spacing, for -count <= i < count, with a margin for the offset.
        let count = self.half.map(|half| (half / spacing).ceil().max(1.0) as i64 + 1);
        let rows: Vec<i64> = (-count[1]..count[1]).collect();
        exec.progress.begin("measuring", rows.len() as u64);
        let sums: Vec<Option<Row>> = rows
            .par_iter()
            .map_init(Default::default, |(scratch, chords), &row| {
                let sum =
                    (!exec.cancel.is_cancelled()).then(|| self.scan_row(body, spacing, count[0], row, scratch, chords));
                exec.progress.advance(1);
                sum
            })
            .collect();
        exec.progress.end();
        let rays = rows.len() as u64 * 2 * count[0] as u64;
        let mut estimate = Estimate { parts: [[0.0; 4]; 4], hits: 0, rays };
        let weight = 4.0 * spacing * spacing;
        for (&row, sum) in rows.iter().zip(sums) {
            let sum = sum.ok_or(Cancelled)?;
            estimate.hits += sum.hits;
            for (i, moments) in sum.parts.iter().enumerate() {
                let part = &mut estimate.parts[2 * (row & 1) as usize + i];
                part.iter_mut().zip(moments).for_each(|(total, m)| *total += weight * m);
            }
        }
        Ok(estimate)
    }

    fn scan_row<B: Body>(
        &self,
        body: &B,
        spacing: f64,
        count: i64,
        row: i64,
        scratch: &mut B::Scratch,
        chords: &mut Vec<Chord>,
    ) -> Row {
        let [right, up, away] = self.axes;
        let y = (row as f64 + OFFSET[1]) * spacing;
        let mut sum = Row::default();
        for column in -count..count {
            let x = (column as f64 + OFFSET[0]) * spacing;
            let origin = self.center + right * x + up * y;
            body.chords(&Ray { origin, direction: away }, scratch, chords);
            if chords.is_empty() {
                continue;
            }
            sum.hits += 1;
            let (mut length, mut depth) = (0.0, 0.0);
            for &Chord { start, end } in chords.iter() {
                length += end - start;
                depth += (end - start) * (end + start) * 0.5;
            }
            let moments = [length, length * x, length * y, depth];
            let part = &mut sum.parts[(column & 1) as usize];
            part.iter_mut().zip(moments).for_each(|(total, m)| *total += m);
        }
        sum
    }
}

/// What the four parts of a grid say: volume and moments each.
struct Estimate {
    parts: [Moments; 4],
    hits: u64,
    rays: u64,
}

impl Estimate {
    fn volume(&self) -> f64 {
        self.parts.iter().map(|p| p[0]).sum::<f64>() / 4.0
    }

    /// Two standard deviations of the mean of the parts' volumes, as if the parts were independent.
    fn scatter(&self) -> f64 {
        deviation(self.parts.map(|p| p[0]))
    }

    /// The centroid and its error by the parts' scatter, or `None` without a volume.
    fn centroid(&self, picture: &Picture) -> Option<(Vec3, f64)> {
        let volume = self.volume();
        if volume <= 0.0 {
            return None;
        }
        let moment = |axis: usize| self.parts.iter().map(|p| p[axis + 1]).sum::<f64>() / 4.0 / volume;
        let offsets = [moment(0), moment(1), moment(2)];
        let centroid = (0..3).fold(picture.center, |c, axis| c + picture.axes[axis] * offsets[axis]);
        // A part's centroid moves with its moment and its volume: compare the moments about the common centroid.
        let errors = [0, 1, 2].map(|axis| deviation(self.parts.map(|p| p[axis + 1] - offsets[axis] * p[0])) / volume);
        Some((centroid, Vec3::from(errors).length()))
    }
}

/// Two standard deviations of the mean of four numbers, which is one of a single number.
fn deviation(numbers: [f64; 4]) -> f64 {
    let mean = numbers.iter().sum::<f64>() / 4.0;
    (numbers.iter().map(|n| (n - mean) * (n - mean)).sum::<f64>() / 3.0).sqrt()
}
