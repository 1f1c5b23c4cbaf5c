//! The bounding box: how far a solid reaches to each of six sides.
//!
//! A ray along an axis tells exactly how far the solid reaches *there*. So for each side, climb: throw a net of rays,
//! follow the best one uphill. Then prove: cells above what was reached are shown to be empty, or cut in two. Cells that
//! stay undecided (coincident surfaces leave such phantoms) never count as reached, however many there are.

use super::body::{Body, Chord};
use crate::exec::{Cancelled, Exec};
use crate::geom::{Bounds, Ray, Vec3, sin_cos_deg};
use rayon::prelude::*;
use std::collections::VecDeque;
use std::rc::Rc;

/// What is not closer than this to the truth, relative to the diagonal of the first box, is looked at again.
const RESOLUTION: f64 = 1e-7;
/// Chords shorter than this, relative to the same, may be mere rounding between coincident surfaces.
const SHORTEST_CHORD: f64 = 1e-9;
/// Rays of the first net, along each of its edges.
const NET: u32 = 32;
/// After so many undecided cells a proof is given up.
const MAX_CELLS: usize = 4096;
/// From undecided cells the search goes uphill once more, until so many attempts in a row were in vain.
const PATIENCE: usize = 40;
/// Directions to try before narrowing one down, and by how many golden sections.
const BEARINGS: u32 = 16;
const NARROWINGS: u32 = 14;

/// How far a solid reaches.
pub(super) struct Extent {
    /// The box as far as rays have met the solid; empty where they have not.
    pub confirmed: Bounds,
    /// The box out of which the solid certainly does not reach, up to the resolution.
    pub possible: Bounds,
    /// Rays traced.
    pub rays: u64,
}

impl Extent {
    /// How far the solid may reach out of the confirmed box; zero if both boxes are empty.
    pub fn error(&self) -> f64 {
        match (self.confirmed.is_empty(), self.possible.is_empty()) {
            (true, _) => self.possible.size().max_abs(),
            _ => (self.confirmed.min - self.possible.min).max(self.possible.max - self.confirmed.max).max_abs(),
        }
    }
}

/// Finds the extent of a body.
pub(super) fn extent(body: &impl Body, exec: &Exec) -> Result<Extent, Cancelled> {
    let room = body.bounds();
    if room.is_empty() {
        return Ok(Extent { confirmed: Bounds::EMPTY, possible: Bounds::EMPTY, rays: 0 });
    }
    let sides = [(0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0), (2, -1.0), (2, 1.0)];
    exec.progress.begin("finding the bounding box", 6);
    let found: Vec<Result<Found, Cancelled>> = sides
        .into_par_iter()
        .map(|(axis, sign)| {
            let found = Climb::new(body, room, axis, sign).run(exec);
            exec.progress.advance(1);
            found
        })
        .collect();
    exec.progress.end();
    let mut extent = Extent { confirmed: Bounds::EMPTY, possible: Bounds::EMPTY, rays: 0 };
    for ((axis, sign), found) in sides.into_iter().zip(found) {
        let Found { reached, limit, rays } = found?;
        let end = |b: &mut Bounds, height: f64| match sign < 0.0 {
            // Not `-height`, which makes -0.0 of 0.0.
            true => b.min[axis] = 0.0 - height,
            false => b.max[axis] = height,
        };
        end(&mut extent.confirmed, reached);
        end(&mut extent.possible, limit);
        extent.rays += rays;
    }
    // Met from some sides only: too little to be a box.
    if extent.confirmed.is_empty() {
        extent.confirmed = Bounds::EMPTY;
    }
    Ok(extent)
}

/// How far the solid reaches to one side, as a height to that side.
struct Found {
    reached: f64,
    /// No point is higher.
    limit: f64,
    rays: u64,
}

/// The search for the highest point, where up is one of the six sides.
struct Climb<'a, B: Body> {
    body: &'a B,
    room: Bounds,
    axis: usize,
    sign: f64,
    /// Heights closer than this are as good as equal.
    resolution: f64,
    shortest_chord: f64,
    /// The greatest height so far, and the place across the axis where it was found.
    best: Option<(f64, Vec3)>,
    scratch: B::Scratch,
    chords: Vec<Chord>,
    rays: u64,
}

impl<'a, B: Body> Climb<'a, B> {
    fn new(body: &'a B, room: Bounds, axis: usize, sign: f64) -> Self {
        let size = room.diagonal();
        Self {
            body,
            room,
            axis,
            sign,
            resolution: RESOLUTION * size,
            shortest_chord: SHORTEST_CHORD * size,
            best: None,
            scratch: B::Scratch::default(),
            chords: Vec::new(),
            rays: 0,
        }
    }

    fn run(mut self, exec: &Exec) -> Result<Found, Cancelled> {
        let [u, v] = self.across();
        let step = self.room.size() / f64::from(NET);
        for i in 0..NET {
            exec.cancel.check()?;
            for j in 0..NET {
                let mut place = self.room.min;
                place[u] += (f64::from(i) + 0.5) * step[u];
                place[v] += (f64::from(j) + 0.5) * step[v];
                self.try_at(place);
            }
        }
        if let Some((_, place)) = self.best {
            self.follow(place, step);
        }
        let limit = self.prove(exec)?;
        Ok(Found { reached: self.reached(), limit, rays: self.rays })
    }

    /// The axes across the one to climb along.
    fn across(&self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    /// The best height so far.
    fn reached(&self) -> f64 {
        self.best.map_or(f64::NEG_INFINITY, |b| b.0)
    }

    /// Traces a ray upwards through this place, and says how high the solid is there.
    fn try_at(&mut self, place: Vec3) -> Option<f64> {
        let mut origin = place;
        origin[self.axis] = self.room.center()[self.axis];
        let mut direction = Vec3::ZERO;
        direction[self.axis] = self.sign;
        self.body.chords(&Ray { origin, direction }, &mut self.scratch, &mut self.chords);
        self.rays += 1;
        let solid = self.chords.iter().rfind(|c| c.end - c.start > self.shortest_chord)?;
        let height = self.sign * origin[self.axis] + solid.end;
        if height > self.reached() {
            self.best = Some((height, place));
        }
        Some(height)
    }

    /// Goes uphill from a place, by steps to the highest point of an ellipse around it: longer steps while that leads up,
    /// shorter ones where it does not. Says whether that beat the greatest height so far.
    fn follow(&mut self, mut place: Vec3, mut step: Vec3) -> bool {
        let before = self.reached();
        let Some(mut height) = self.try_at(place) else { return false };
        while step.max_abs() > 0.1 * self.resolution {
            let (found, next) = self.highest_around(place, step);
            let gain = found - height;
            if gain > 0.0 {
                (height, place) = (found, next);
            }
            // Creeping along counts as standing still.
            step = step * if gain > self.resolution { 1.5 } else { 0.4 };
        }
        self.reached() > before + self.resolution
    }

    /// The highest point of an ellipse around a place, and how high it is. It is narrowed down to a small fraction of a
    /// degree: the way up along the edge of a cliff may be that narrow.
    fn highest_around(&mut self, center: Vec3, half_axes: Vec3) -> (f64, Vec3) {
        let [u, v] = self.across();
        let mut height_at = |angle_deg: f64| {
            let (s, c) = sin_cos_deg(angle_deg);
            let mut place = center;
            place[u] += half_axes[u] * c;
            place[v] += half_axes[v] * s;
            (self.try_at(place).unwrap_or(f64::NEG_INFINITY), place)
        };
        let higher = |a: (f64, Vec3), b: (f64, Vec3)| if b.0 > a.0 { b } else { a };
        let pitch_deg = 360.0 / f64::from(BEARINGS);
        let mut best = height_at(0.0);
        let mut bearing_deg = 0.0;
        for i in 1..BEARINGS {
            let candidate = height_at(f64::from(i) * pitch_deg);
            if candidate.0 > best.0 {
                (best, bearing_deg) = (candidate, f64::from(i) * pitch_deg);
            }
        }
        if best.0 == f64::NEG_INFINITY {
            return best;
        }
        // Golden section; a cliff within the bracket is no obstacle.
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        let (mut low, mut high) = (bearing_deg - pitch_deg, bearing_deg + pitch_deg);
        let inner = |low: f64, high: f64| (high - golden * (high - low), low + golden * (high - low));
        let (mut left, mut right) = inner(low, high);
        let (mut at_left, mut at_right) = (height_at(left), height_at(right));
        for _ in 0..NARROWINGS {
            best = higher(higher(best, at_left), at_right);
            if at_left.0 > at_right.0 {
                high = right;
                (right, at_right) = (left, at_left);
                left = inner(low, high).0;
                at_left = height_at(left);
            } else {
                low = left;
                (left, at_left) = (right, at_right);
                right = inner(low, high).1;
                at_right = height_at(right);
            }
        }
        higher(higher(best, at_left), at_right)
    }

    /// Shows that nothing is higher than what was reached, by more than the resolution, or finds it. Answers with a
    /// height that certainly is not exceeded.
    fn prove(&mut self, exec: &Exec) -> Result<f64, Cancelled> {
        let mut limit = f64::NEG_INFINITY;
        let mut undecided = VecDeque::from([(self.room, Rc::new(self.body.whole()))]);
        let (mut cells, mut in_vain) = (0, 0);
        while let Some((cell, around)) = undecided.pop_front() {
            let cell = self.above_reached(cell);
            if cell.is_empty() {
                continue;
            }
            let Some(region) = self.body.narrow(&around, &cell) else { continue };
            exec.cancel.check()?;
            cells += 1;
            let size = cell.size();
            if cells > MAX_CELLS || size.max_abs() <= self.resolution {
                limit = limit.max(self.top(&cell));
                continue;
            }
            // There may be many hills, each a little higher than the one before.
            if in_vain < PATIENCE {
                in_vain = if self.follow(cell.center(), size * 0.25) { 0 } else { in_vain + 1 };
            } else {
                self.try_at(cell.center());
            }
            let region = Rc::new(region);
            undecided.extend(cell.halves().map(|half| (half, Rc::clone(&region))));
        }
        Ok(limit.max(self.reached() + self.resolution))
    }

    /// The part of a cell that is higher than what was reached.
    fn above_reached(&self, mut cell: Bounds) -> Bounds {
        let floor = self.reached() + self.resolution;
        if self.sign > 0.0 {
            cell.min[self.axis] = cell.min[self.axis].max(floor);
        } else {
            cell.max[self.axis] = cell.max[self.axis].min(-floor);
        }
        cell
    }

    /// The height of a cell's upper side.
    fn top(&self, cell: &Bounds) -> f64 {
        if self.sign > 0.0 { cell.max[self.axis] } else { -cell.min[self.axis] }
    }
}
