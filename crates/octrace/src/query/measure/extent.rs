//! The bounding box: how far a solid reaches to each of six sides.
//!
//! A ray along an axis tells exactly how far the solid reaches *there*. So throw nets of rays along the three axes, and for
//! each side climb from the best place that any of them found; then prove that nothing is farther ([`Climb`]). What nets slip
//! past, hair or foil, is looked for once more in the box that the proofs leave, and in its own size.

use super::body::{Body, Chord};
use super::climb::{Climb, Found, Side};
use crate::exec::{Cancelled, Exec};
use crate::geom::{Bounds, Ray, Vec3};
use rayon::prelude::*;

/// What is not closer than this to the truth, relative to the diagonal of the box that is searched, is looked at again.
const RESOLUTION: f64 = 1e-7;
/// However small that box is: relative to the first one.
const FINEST: f64 = 1e-12;
/// Chords shorter than this, relative to the same, may be mere rounding between coincident surfaces.
const SHORTEST_CHORD: f64 = 1e-9;
/// Rays of a net, along each of its edges.
const NET: u32 = 32;
/// How often a smaller box is searched once more.
const ROUNDS: u32 = 4;

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

/// In how fine a box something is looked for.
#[derive(Clone, Copy)]
pub(super) struct Grain {
    /// Heights closer than this are as good as equal.
    pub resolution: f64,
    /// Chords that are not longer may be rounding.
    pub shortest_chord: f64,
}

/// Finds the extent of a body.
pub(super) fn extent(body: &impl Body, exec: &Exec) -> Result<Extent, Cancelled> {
    let first = body.bounds();
    let mut extent = Extent { confirmed: Bounds::EMPTY, possible: first, rays: 0 };
    for _ in 0..ROUNDS {
        let room = extent.possible;
        if room.is_empty() {
            break;
        }
        let resolution = (RESOLUTION * room.diagonal()).max(FINEST * first.diagonal());
        let grain = Grain { resolution, shortest_chord: SHORTEST_CHORD * first.diagonal() };
        let found = search(body, room, grain, exec)?;
        let is_settled = found.error() <= 2.0 * resolution;
        let (before, after) = (room.size(), found.possible.size());
        extent = Extent { rays: extent.rays + found.rays, ..found };
        if is_settled || (0..3).all(|axis| after[axis] > 0.5 * before[axis]) {
            break;
        }
    }
    Ok(extent)
}

/// Finds the extent of what is in a box.
fn search(body: &impl Body, room: Bounds, grain: Grain, exec: &Exec) -> Result<Extent, Cancelled> {
    let nets = (0..3).into_par_iter().map(|axis| Net::throw(body, &room, axis, grain, exec));
    let nets = nets.collect::<Result<Vec<Net>, Cancelled>>()?;
    exec.progress.begin("finding the bounding box", 6);
    let found: Vec<Result<Found, Cancelled>> = Side::ALL
        .into_par_iter()
        .map(|side| {
            let witnesses = nets.iter().filter_map(|net| net.witnesses[side.number()]);
            let highest = witnesses.max_by(|a, b| side.height(*a).total_cmp(&side.height(*b)));
            let found = Climb::new(body, room, side, grain).run(highest, exec);
            exec.progress.advance(1);
            found
        })
        .collect();
    exec.progress.end();
    let rays = nets.iter().map(|net| net.rays).sum();
    let mut extent = Extent { confirmed: Bounds::EMPTY, possible: Bounds::EMPTY, rays };
    for (side, found) in Side::ALL.into_iter().zip(found) {
        let Found { reached, limit, rays } = found?;
        side.set(&mut extent.confirmed, reached);
        side.set(&mut extent.possible, limit);
        extent.rays += rays;
    }
    // Met from some sides only: too little to be a box.
    for bounds in [&mut extent.confirmed, &mut extent.possible] {
        if bounds.is_empty() {
            *bounds = Bounds::EMPTY;
        }
    }
    Ok(extent)
}

/// Rays along an axis, evenly over a box.
struct Net {
    /// For each side, the place in the solid that is farthest to it, of the ends and the middles of chords.
    witnesses: [Option<Vec3>; 6],
    rays: u64,
}

impl Net {
    fn throw(body: &impl Body, room: &Bounds, axis: usize, grain: Grain, exec: &Exec) -> Result<Self, Cancelled> {
        let mut net = Self { witnesses: [None; 6], rays: 0 };
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        let step = room.size() / f64::from(NET);
        let (mut scratch, mut chords) = (Default::default(), Vec::new());
        let mut direction = Vec3::ZERO;
        direction[axis] = 1.0;
        for i in 0..NET {
            exec.cancel.check()?;
            for j in 0..NET {
                let mut origin = room.min;
                origin[axis] = room.center()[axis];
                origin[u] += (f64::from(i) + 0.5) * step[u];
                origin[v] += (f64::from(j) + 0.5) * step[v];
                let ray = Ray { origin, direction };
                body.chords(&ray, &mut scratch, &mut chords);
                net.rays += 1;
                chords.iter().filter(|c| c.end - c.start > grain.shortest_chord).for_each(|c| net.take(&ray, c, axis));
            }
        }
        Ok(net)
    }

    fn take(&mut self, ray: &Ray, chord: &Chord, axis: usize) {
        for side in Side::ALL {
            let t = match side.is_along(axis) {
                Some(true) => chord.end,
                Some(false) => chord.start,
                None => 0.5 * (chord.start + chord.end),
            };
            let place = ray.at(t);
            let witness = &mut self.witnesses[side.number()];
            if witness.is_none_or(|known| side.height(place) > side.height(known)) {
                *witness = Some(place);
            }
        }
    }
}
