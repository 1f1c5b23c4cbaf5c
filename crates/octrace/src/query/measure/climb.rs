//! How far a solid reaches to one side, up as it were: climb from a place in the solid, then prove that nothing is higher.
//!
//! The proof takes the box that may hold something highest, and cuts it in two, until what was reached is known to be the
//! top; so all that is left is no higher than the box that is cut next. Whatever stays undecided (coincident surfaces leave
//! such phantoms) never counts as reached.

use super::body::{Body, Chord};
use super::extent::Grain;
use crate::exec::{Cancelled, Exec};
use crate::geom::{Bounds, Ray, Vec3, sin_cos_deg};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::rc::Rc;

/// After so many undecided boxes a proof is given up.
const MAX_CELLS: usize = 4096;
/// From undecided boxes the search goes uphill once more, until so many attempts in a row were in vain.
const PATIENCE: usize = 40;
/// As long as nothing of the solid was met, boxes are cut until they are so much smaller than the resolution.
const UNSEEN: f64 = 1e-3;
/// Directions to try before narrowing one down, and by how many golden sections.
const BEARINGS: u32 = 16;
const NARROWINGS: u32 = 14;

/// One of the six sides of a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Side {
    axis: usize,
    sign: f64,
}

impl Side {
    pub const ALL: [Self; 6] = [
        Self::new(0, -1.0),
        Self::new(0, 1.0),
        Self::new(1, -1.0),
        Self::new(1, 1.0),
        Self::new(2, -1.0),
        Self::new(2, 1.0),
    ];

    const fn new(axis: usize, sign: f64) -> Self {
        Self { axis, sign }
    }

    /// Its place among all.
    pub fn number(self) -> usize {
        2 * self.axis + usize::from(self.sign > 0.0)
    }

    /// The direction to it.
    pub fn up(self) -> Vec3 {
        let mut up = Vec3::ZERO;
        up[self.axis] = self.sign;
        up
    }

    /// How far a place is to this side.
    pub fn height(self, place: Vec3) -> f64 {
        self.sign * place[self.axis]
    }

    /// Whether it is at the end of an axis; `None` where it is beside it.
    pub fn is_along(self, axis: usize) -> Option<bool> {
        (axis == self.axis).then_some(self.sign > 0.0)
    }

    /// Puts this side of a box where that height is.
    pub fn set(self, bounds: &mut Bounds, height: f64) {
        match self.sign > 0.0 {
            true => bounds.max[self.axis] = height,
            // Not `-height`, which makes -0.0 of 0.0.
            false => bounds.min[self.axis] = 0.0 - height,
        }
    }

    /// The height of this side of a box.
    fn of(self, bounds: &Bounds) -> f64 {
        self.height(if self.sign > 0.0 { bounds.max } else { bounds.min })
    }
}

/// How far a solid reaches to one side, as a height to that side.
pub(super) struct Found {
    pub reached: f64,
    /// No point is higher.
    pub limit: f64,
    pub rays: u64,
}

/// The search for the highest point, where up is one of the six sides.
pub(super) struct Climb<'a, B: Body> {
    body: &'a B,
    room: Bounds,
    side: Side,
    grain: Grain,
    /// The greatest height so far, and the place across the axis where it was found.
    best: Option<(f64, Vec3)>,
    scratch: B::Scratch,
    chords: Vec<Chord>,
    rays: u64,
}

/// A box that may hold something, and what is known of the solid there.
struct Cell<R> {
    bounds: Bounds,
    /// Where the highest may be, and how high that is.
    place: Vec3,
    top: f64,
    region: Rc<R>,
}

impl<'a, B: Body> Climb<'a, B> {
    pub fn new(body: &'a B, room: Bounds, side: Side, grain: Grain) -> Self {
        Self { body, room, side, grain, best: None, scratch: B::Scratch::default(), chords: Vec::new(), rays: 0 }
    }

    /// Climbs, from a place that is known to be in the solid if there is one, and proves.
    pub fn run(mut self, witness: Option<Vec3>, exec: &Exec) -> Result<Found, Cancelled> {
        if let Some(place) = witness {
            self.follow(place, self.room.size() / 32.0);
        }
        let limit = self.prove(exec)?;
        Ok(Found { reached: self.reached(), limit, rays: self.rays })
    }

    /// The axes across the one to climb along.
    fn across(&self) -> [usize; 2] {
        [(self.side.axis + 1) % 3, (self.side.axis + 2) % 3]
    }

    /// The best height so far.
    fn reached(&self) -> f64 {
        self.best.map_or(f64::NEG_INFINITY, |b| b.0)
    }

    /// Traces a ray upwards through this place, and says how high the solid is there.
    fn try_at(&mut self, place: Vec3) -> Option<f64> {
        let mut origin = place;
        origin[self.side.axis] = self.room.center()[self.side.axis];
        self.body.chords(&Ray { origin, direction: self.side.up() }, &mut self.scratch, &mut self.chords);
        self.rays += 1;
        let solid = self.chords.iter().rfind(|c| c.end - c.start > self.grain.shortest_chord)?;
        let height = self.side.height(origin) + solid.end;
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
        while step.max_abs() > 0.1 * self.grain.resolution {
            let (found, next) = self.highest_around(place, step);
            let gain = found - height;
            if gain > 0.0 {
                (height, place) = (found, next);
            }
            // Creeping along counts as standing still.
            step = step * if gain > self.grain.resolution { 1.5 } else { 0.4 };
        }
        self.reached() > before + self.grain.resolution
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
        let mut undecided: BinaryHeap<Cell<B::Region>> = self.cell(self.room, &self.body.whole()).into_iter().collect();
        let (mut cells, mut in_vain) = (0, 0);
        while let Some(cell) = undecided.pop() {
            exec.cancel.check()?;
            cells += 1;
            let size = cell.bounds.size();
            // There may be many hills, each a little higher than the one before.
            if in_vain < PATIENCE && cell.top > self.proven() {
                let (found, known) = (self.follow(cell.place, size * 0.25), self.reached());
                let found = found || (self.follow(cell.bounds.center(), size * 0.25) && self.reached() > known);
                in_vain = if found { 0 } else { in_vain + 1 };
            } else {
                self.try_at(cell.place);
                self.try_at(cell.bounds.center());
            }
            // All others are lower.
            if cell.top <= self.proven() {
                break;
            }
            let smallest = if self.best.is_none() { UNSEEN } else { 1.0 } * self.grain.resolution;
            if cells > MAX_CELLS || size.max_abs() <= smallest {
                return Ok(cell.top);
            }
            let halves = self.above_reached(cell.bounds).halves();
            undecided.extend(halves.into_iter().filter_map(|half| self.cell(half, &cell.region)));
        }
        Ok(self.proven())
    }

    /// What counts as proven if nothing is higher.
    fn proven(&self) -> f64 {
        self.reached() + self.grain.resolution
    }

    /// What is known of a box; `None` where nothing is in it.
    fn cell(&self, mut bounds: Bounds, around: &B::Region) -> Option<Cell<B::Region>> {
        if bounds.is_empty() {
            return None;
        }
        let region = self.body.narrow(around, &bounds)?;
        let place = self.body.ceiling(&region, &bounds, self.side.up())?;
        let top = self.side.height(place).min(self.side.of(&bounds));
        self.side.set(&mut bounds, top);
        if self.best.is_none() {
            // As long as nothing was met, the middle of a box that is as tight as can be is where to look.
            let mut tight = bounds;
            for side in Side::ALL {
                let end = side.height(self.body.ceiling(&region, &bounds, side.up())?);
                side.set(&mut tight, end.min(side.of(&bounds)));
            }
            // Rounding may turn what is thin inside out.
            bounds = if tight.is_empty() { bounds } else { tight };
        }
        Some(Cell { bounds, place, top, region: Rc::new(region) })
    }

    /// The part of a box that is higher than what was reached.
    fn above_reached(&self, mut bounds: Bounds) -> Bounds {
        let down = Side { sign: -self.side.sign, ..self.side };
        let floor = down.of(&bounds).min(-self.proven());
        down.set(&mut bounds, floor);
        bounds
    }
}

impl<R> Ord for Cell<R> {
    /// The higher the greater; of equally high ones the smaller, so that one of them is soon decided.
    fn cmp(&self, other: &Self) -> Ordering {
        let size = |cell: &Self| cell.bounds.size().max_abs();
        self.top.total_cmp(&other.top).then_with(|| size(other).total_cmp(&size(self)))
    }
}

impl<R> PartialOrd for Cell<R> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<R> PartialEq for Cell<R> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<R> Eq for Cell<R> {}
