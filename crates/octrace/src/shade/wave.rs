//! The trees of rays of a whole tile, one generation after another: so rays of a kind are traced together.
//!
//! What comes out is what [`Whitted::camera_ray`] makes of each ray by itself, to the bit: the same terms are added in the
//! same order.

use super::whitted::{Branch, LightsWay, Lit, Met, RayCounts, Seen, Standing, Whitted};
use crate::geom::{Ray, Vec3};
use crate::model::Rgb;
use crate::trace::{Backend, RayTile, RayTo, Scratch, TileHit};

/// The memory of a worker for trees of rays.
#[derive(Debug, Default)]
pub(crate) struct Wave {
    nodes: Vec<Node>,
    /// What comes along each ray.
    seen: Vec<Seen>,
    /// Where the rays come from that are not the camera's: of the last nodes.
    origins: Vec<Origin>,
    rays: Vec<RayTo>,
    hits: Vec<TileHit>,
    lit: Vec<(usize, Lit)>,
    ways: Vec<LightsWay>,
}

/// A ray of a tree.
#[derive(Clone, Copy, Debug)]
struct Node {
    ray: Ray,
    hit: TileHit,
    standing: Standing,
}

/// Where a ray goes on from.
#[derive(Clone, Copy, Debug)]
struct Origin {
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
    /// Light along camera rays that meet what is said, in their order.
    pub fn camera_rays(
        &mut self,
        integrator: &Whitted,
        rays: impl Iterator<Item = (Ray, TileHit)>,
        workshop: &mut Workshop,
    ) -> &[Seen] {
        self.nodes.clear();
        self.seen.clear();
        self.origins.clear();
        let mut last: Option<(Vec3, Standing)> = None;
        for (ray, hit) in rays {
            // Most cameras are in one place.
            let standing = match last {
                Some((origin, standing)) if origin == ray.origin => standing,
                _ => integrator.camera_standing(&ray, workshop.scratch),
            };
            last = Some((ray.origin, standing));
            self.nodes.push(Node { ray, hit, standing });
        }
        let count = self.nodes.len();
        workshop.counts.camera += count as u64;
        let mut met = Vec::with_capacity(count);
        let mut generation = 0;
        while generation < self.nodes.len() {
            let next = self.nodes.len();
            self.light(integrator, generation, &mut met, workshop);
            self.go_on(integrator, &met, workshop);
            self.trace(integrator, next, workshop);
            generation = next;
        }
        self.gather();
        &self.seen[..count]
    }

    /// What surfaces there are where the rays from `first` on end, and the light on them.
    fn light<'a>(
        &mut self,
        integrator: &'a Whitted,
        first: usize,
        met: &mut Vec<(usize, Met<'a>)>,
        Workshop { backend, tile, scratch, counts }: &mut Workshop,
    ) {
        let Self { nodes, seen, rays, hits, lit, ways, .. } = self;
        met.clear();
        for (number, node) in nodes.iter().enumerate().skip(first) {
            seen.push(match node.hit {
                Some((_, hit)) => {
                    let surface = integrator.met(&node.ray, &hit);
                    met.push((number, surface));
                    Seen { color: integrator.ambient(&surface), alpha: 1.0 }
                }
                None => integrator.nothing(node.standing.direct),
            });
        }
        for light in integrator.lights() {
            lit.clear();
            lit.extend(met.iter().filter_map(|(number, met)| Some((*number, integrator.lit(met, light)?))));
            counts.shadow += lit.len() as u64;
            ways.clear();
            ways.extend(lit.iter().map(|(_, Lit { shadow, reach, .. })| LightsWay::new(shadow, *reach)));
            loop {
                rays.clear();
                rays.extend(ways.iter().filter_map(|way| way.rest));
                if rays.is_empty() {
                    break;
                }
                hits.clear();
                hits.resize(rays.len(), None);
                integrator.tracer().first_hits_into(rays, *backend, tile, scratch, hits);
                for (way, hit) in ways.iter_mut().filter(|way| way.rest.is_some()).zip(&*hits) {
                    integrator.pass(way, *hit);
                }
            }
            for ((number, Lit { intensity, factor, .. }), way) in lit.iter().zip(&*ways) {
                seen[*number].color += *intensity * way.share * *factor;
            }
        }
    }

    /// The rays that go on from there.
    fn go_on(&mut self, integrator: &Whitted, met: &[(usize, Met)], Workshop { counts, .. }: &mut Workshop) {
        let Self { nodes, origins, .. } = self;
        for (parent, surface) in met.iter().filter(|(_, surface)| surface.goes_on()) {
            let Node { ray, hit: Some(hit), standing } = nodes[*parent] else { continue };
            let (refracted, reflected) = integrator.branches(&ray, hit, surface, &standing);
            let mut set_out = |branch: Branch, through: Option<f64>| {
                let standing = standing.of(&branch, through.is_some());
                origins.push(Origin { parent: *parent, factor: branch.factor, through });
                nodes.push(Node { ray: branch.ray, hit: None, standing });
            };
            // They are gathered from the last to the first: what is refracted is added first.
            if let Some(branch) = reflected {
                counts.reflected += 1;
                set_out(branch, None);
            }
            if let Some(branch) = refracted {
                counts.refracted += 1;
                set_out(branch, Some(surface.material.kt));
            }
        }
    }

    /// Traces the rays from `first` on.
    fn trace(&mut self, integrator: &Whitted, first: usize, Workshop { backend, tile, scratch, .. }: &mut Workshop) {
        let Self { nodes, rays, hits, .. } = self;
        let new = &mut nodes[first..];
        rays.clear();
        rays.extend(new.iter().map(|node| RayTo { ray: node.ray, end: f64::INFINITY }));
        hits.clear();
        hits.resize(rays.len(), None);
        integrator.tracer().first_hits_into(rays, *backend, tile, scratch, hits);
        for (node, hit) in new.iter_mut().zip(&*hits) {
            node.hit = *hit;
        }
    }

    /// Brings the light back to where the rays came from.
    fn gather(&mut self) {
        let cameras = self.nodes.len() - self.origins.len();
        for (place, Origin { parent, factor, through }) in self.origins.iter().enumerate().rev() {
            let seen = self.seen[cameras + place];
            match through {
                Some(share) => self.seen[*parent].refract(seen, *factor, *share),
                None => self.seen[*parent].reflect(seen, *factor),
            }
        }
    }
}
