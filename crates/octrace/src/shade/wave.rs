//! The trees of rays of a whole tile, one generation after another, eight rays at once.
//!
//! What comes out is what [`Whitted::camera_ray`] makes of each ray by itself, to the bit: the same terms are added in the
//! same order.

use super::branch::{EightBranches, GoOn};
use super::light::{EightSeen, RayCounts};
use super::meet::{EightMet, Meet};
use super::optics::{Branch, Standing};
use super::shadows::Shadows;
use super::whitted::Whitted;
use crate::geom::Vec3;
use crate::model::Rgb;
use crate::trace::lanes::{LANES, Stored};
use crate::trace::{Backend, EightHits, EightRays, RayTile, Scratch};

/// The memory of a worker for trees of rays. A ray's number is that of its eight, times the lanes, plus its lane.
#[derive(Debug, Default)]
pub(crate) struct Wave {
    /// The rays, one generation behind the other, and what they meet.
    rays: Vec<EightRays>,
    hits: Vec<EightHits>,
    /// What comes along them.
    seen: Vec<EightSeen>,
    /// Those that come from the camera, if through glass.
    direct: Vec<u8>,
    /// Where each ray stands in its tree; unknown where no surface lets light go on.
    standings: Vec<Standing>,
    /// Where the rays come from that are not the camera's.
    origins: Vec<Origin>,
    /// What the present generation meets.
    met: Vec<EightMet>,
    shadows: Shadows,
    branches: Vec<EightBranches>,
}

/// Where a ray goes on from.
#[derive(Clone, Copy, Debug)]
struct Origin {
    ray: usize,
    parent: usize,
    factor: Rgb,
    /// If it is refracted, what share of the light goes through.
    through: Option<f64>,
}

/// What tracing takes.
pub(crate) struct Workshop<'a> {
    pub backend: Backend,
    pub tile: &'a mut RayTile,
    pub scratch: &'a mut Scratch,
    pub counts: &'a mut RayCounts,
}

impl Wave {
    /// Where to put so many eights of camera rays and what they meet.
    pub fn camera_rays(&mut self, eights: usize) -> (&mut [EightRays], &mut [EightHits]) {
        self.rays.resize(eights, EightRays::NONE);
        self.hits.resize(eights, EightHits::default());
        (&mut self.rays, &mut self.hits)
    }

    /// Light along the camera rays that were put here, in their order.
    pub fn light(&mut self, integrator: &Whitted, workshop: &mut Workshop) -> &[EightSeen] {
        let count = self.rays.len();
        self.seen.clear();
        self.direct.clear();
        self.direct.resize(count, u8::MAX);
        self.origins.clear();
        self.standings.clear();
        if integrator.materials().go_on {
            self.stand(integrator, workshop.scratch);
        }
        workshop.counts.camera += self.rays.iter().map(|eight| u64::from(eight.lanes.count_ones())).sum::<u64>();
        let (mut generation, mut bounce) = (0, 0);
        while generation < self.rays.len() {
            let next = self.rays.len();
            self.light_up(integrator, generation, workshop);
            if integrator.materials().go_on {
                self.go_on(integrator, generation, bounce, workshop);
                self.trace(integrator, next, workshop);
            }
            (generation, bounce) = (next, bounce + 1);
        }
        self.gather();
        &self.seen[..count]
    }

    /// Finds out how the camera rays stand.
    fn stand(&mut self, integrator: &Whitted, scratch: &mut Scratch) {
        let mut last: Option<(Vec3, Standing)> = None;
        for eight in &self.rays {
            // Most cameras are in one place.
            if let Some((origin, standing)) = last
                && eight.origin == origin.to_array().map(|v| Stored([v; LANES]))
            {
                self.standings.resize(self.standings.len() + LANES, standing);
                continue;
            }
            for lane in 0..LANES {
                let origin = eight.ray(lane).origin;
                last = match last {
                    Some((known, _)) if known == origin || eight.lanes >> lane & 1 == 0 => last,
                    _ => Some((origin, integrator.camera_standing(origin, scratch))),
                };
                self.standings.extend(last.map(|(_, standing)| standing));
            }
        }
    }

    /// What surfaces there are where the rays from `first` on end, and the light on them.
    fn light_up(&mut self, integrator: &Whitted, first: usize, workshop: &mut Workshop) {
        let Self { rays, hits, seen, direct, standings, met, shadows, .. } = self;
        met.resize(rays.len() - first, EightMet::default());
        seen.resize(rays.len(), EightSeen::default());
        let (rays, hits, direct, seen) = (&rays[first..], &hits[first..], &direct[first..], &mut seen[first..]);
        let standings = standings.get(first * LANES..).unwrap_or_default();
        workshop.backend.run(Meet { integrator, rays, hits, direct, standings, met, seen });
        for light in integrator.lights() {
            shadows.add_light(integrator, light, met, seen, workshop);
        }
    }

    /// The rays that go on from where those from `first` on end, which were reflected and refracted `bounce` times.
    fn go_on(&mut self, integrator: &Whitted, first: usize, bounce: u32, workshop: &mut Workshop) {
        let Self { rays, hits, met, standings, branches, .. } = self;
        branches.clear();
        if bounce < integrator.max_bounces() {
            let (rays, hits, standings) = (&rays[first..], &hits[first..], &standings[first * LANES..]);
            workshop.backend.run(GoOn { integrator, rays, hits, met, standings, branches });
        }
        let end = self.rays.len();
        let branches = std::mem::take(&mut self.branches);
        let mut next = Next { wave: self, count: end * LANES };
        // They are gathered from the last to the first: what is refracted is added first.
        for eight in &branches {
            let parent = (first + eight.from) * LANES;
            for lane in (0..LANES).filter(|lane| eight.reflected.lanes >> lane & 1 != 0) {
                let media = next.wave.standings[parent + lane].media;
                next.set_out(parent + lane, &eight.reflected(lane, media), None);
                workshop.counts.reflected += 1;
            }
        }
        for eight in &branches {
            let parent = (first + eight.from) * LANES;
            for lane in (0..LANES).filter(|lane| eight.refracted.lanes >> lane & 1 != 0) {
                let material = integrator.materials().numbered(next.wave.met[eight.from].materials.numbers[lane]);
                next.set_out(parent + lane, &eight.refracted(lane), Some(material.kt));
                workshop.counts.refracted += 1;
            }
        }
        self.branches = branches;
        if let Some(last) = self.rays[end..].last_mut() {
            last.fill_up();
        }
        let padded = self.rays.len() * LANES;
        if let Some(&last) = self.standings.last() {
            self.standings.resize(padded, last);
        }
    }

    /// Traces the rays from `first` on.
    fn trace(&mut self, integrator: &Whitted, first: usize, workshop: &mut Workshop) {
        let Workshop { backend, tile, scratch, .. } = workshop;
        self.hits.resize(self.rays.len(), EightHits::default());
        let (tracer, rays, hits) = (integrator.tracer(), &self.rays[first..], &mut self.hits[first..]);
        tracer.eight_hits(0..tracer.bodies(), rays, *backend, tile, scratch, hits);
    }

    /// Brings the light back to where the rays came from.
    fn gather(&mut self) {
        for Origin { ray, parent, factor, through } in self.origins.iter().rev() {
            let seen = self.seen[ray / LANES].lane(ray % LANES);
            let at = &mut self.seen[parent / LANES];
            let mut sum = at.lane(parent % LANES);
            match through {
                Some(share) => sum.refract(seen, *factor, *share),
                None => sum.reflect(seen, *factor),
            }
            at.put(parent % LANES, sum);
        }
    }
}

/// The next generation as it grows.
struct Next<'a> {
    wave: &'a mut Wave,
    /// How many rays there are, with those of all generations before.
    count: usize,
}

impl Next<'_> {
    /// A ray sets out from the end of another; if it is refracted, so that a share of its light goes `through`.
    fn set_out(&mut self, parent: usize, branch: &Branch, through: Option<f64>) {
        let Wave { rays, direct, standings, origins, .. } = &mut *self.wave;
        let (eight, lane) = (self.count / LANES, self.count % LANES);
        if lane == 0 {
            rays.push(EightRays::NONE);
            direct.push(0);
        }
        let standing = standings[parent].of(branch, through.is_some());
        rays[eight].put(lane, &branch.ray, f64::INFINITY);
        direct[eight] |= u8::from(standing.direct) << lane;
        standings.push(standing);
        origins.push(Origin { ray: self.count, parent, factor: branch.factor, through });
        self.count += 1;
    }
}
