//! The trees of rays of a whole tile, one generation after another: so rays of a kind are traced together.
//!
//! What comes out is what [`Whitted::camera_ray`] makes of each ray by itself, to the bit: the same terms are added in the
//! same order.

use super::whitted::{Branch, Lit, Met, RayCounts, Seen, Standing, Whitted};
use crate::geom::Ray;
use crate::model::Material;
use crate::trace::{Backend, RayTile, RayTo, Scratch, TileHit};

/// The memory of a worker for trees of rays.
#[derive(Debug, Default)]
pub(crate) struct Wave {
    nodes: Vec<Node>,
    /// What the rays of the present generation meet.
    met: Vec<(usize, Met)>,
    rays: Vec<RayTo>,
    hits: Vec<TileHit>,
    lit: Vec<(usize, Lit)>,
}

/// A ray of a tree.
#[derive(Clone, Copy, Debug)]
struct Node {
    ray: Ray,
    hit: TileHit,
    standing: Standing,
    /// What comes along it.
    seen: Seen,
    /// Where it comes from, unless from the camera.
    origin: Option<Origin>,
}

/// Where a ray goes on from.
#[derive(Clone, Copy, Debug)]
struct Origin {
    parent: usize,
    branch: Branch,
    /// The material that it goes through, if it is refracted.
    through: Option<Material>,
}

/// What tracing takes.
pub(crate) struct Workshop<'a> {
    pub tile: &'a mut RayTile,
    pub scratch: &'a mut Scratch,
    pub counts: &'a mut RayCounts,
}

impl Wave {
    /// Light along camera rays that meet what is said; given to `take` in their order.
    pub fn camera_rays(
        &mut self,
        integrator: &Whitted,
        rays: impl Iterator<Item = (Ray, TileHit)>,
        workshop: &mut Workshop,
        mut take: impl FnMut(Seen),
    ) {
        self.nodes.clear();
        for (ray, hit) in rays {
            let standing = integrator.camera_standing(&ray, workshop.scratch);
            self.nodes.push(Node { ray, hit, standing, seen: integrator.nothing(true), origin: None });
        }
        let count = self.nodes.len();
        workshop.counts.camera += count as u64;
        let mut generation = 0;
        while generation < self.nodes.len() {
            let next = self.nodes.len();
            self.light(integrator, generation, workshop);
            self.go_on(integrator, workshop);
            self.trace(integrator, next, workshop);
            generation = next;
        }
        self.gather();
        for node in &self.nodes[..count] {
            take(node.seen);
        }
    }

    /// What surfaces there are where the rays from `first` on end, and the light on them.
    fn light(&mut self, integrator: &Whitted, first: usize, Workshop { tile, scratch, counts }: &mut Workshop) {
        let Self { nodes, met, rays, hits, lit } = self;
        met.clear();
        for (number, node) in nodes.iter_mut().enumerate().skip(first) {
            if let Some((_, hit)) = node.hit {
                let surface = integrator.met(&node.ray, &hit);
                node.seen = Seen { color: integrator.ambient(&surface), alpha: 1.0 };
                met.push((number, surface));
            }
        }
        for light in integrator.lights() {
            lit.clear();
            lit.extend(met.iter().filter_map(|(number, met)| Some((*number, integrator.lit(met, light)?))));
            counts.shadow += lit.len() as u64;
            rays.clear();
            rays.extend(lit.iter().map(|(_, Lit { shadow, reach, .. })| RayTo { ray: *shadow, end: *reach }));
            hits.clear();
            hits.resize(rays.len(), None);
            integrator.tracer().first_hits_into(rays, Backend::best(), tile, scratch, hits);
            for ((number, Lit { shadow, reach, intensity, factor }), hit) in lit.iter().zip(&*hits) {
                let share = integrator.unshadowed(shadow, *reach, *hit, scratch, &mut ());
                nodes[*number].seen.color += *intensity * share * *factor;
            }
        }
    }

    /// The rays that go on from there.
    fn go_on(&mut self, integrator: &Whitted, Workshop { counts, .. }: &mut Workshop) {
        let Self { nodes, met, .. } = self;
        for (parent, surface) in met {
            let Node { ray, hit: Some(hit), standing, .. } = nodes[*parent] else { continue };
            let (refracted, reflected) = integrator.branches(&ray, hit, surface, &standing);
            let mut set_out = |branch: Branch, is_refracted: bool| {
                let standing = standing.of(&branch, is_refracted);
                let through = is_refracted.then_some(surface.material);
                let origin = Some(Origin { parent: *parent, branch, through });
                let seen = integrator.nothing(standing.direct);
                nodes.push(Node { ray: branch.ray, hit: None, standing, seen, origin });
            };
            // They are gathered from the last to the first: what is refracted is added first.
            if let Some(branch) = reflected {
                counts.reflected += 1;
                set_out(branch, false);
            }
            if let Some(branch) = refracted {
                counts.refracted += 1;
                set_out(branch, true);
            }
        }
    }

    /// Traces the rays from `first` on.
    fn trace(&mut self, integrator: &Whitted, first: usize, Workshop { tile, scratch, .. }: &mut Workshop) {
        let Self { nodes, rays, hits, .. } = self;
        let new = &mut nodes[first..];
        rays.clear();
        rays.extend(new.iter().map(|node| RayTo { ray: node.ray, end: f64::INFINITY }));
        hits.clear();
        hits.resize(rays.len(), None);
        integrator.tracer().first_hits_into(rays, Backend::best(), tile, scratch, hits);
        for (node, hit) in new.iter_mut().zip(&*hits) {
            node.hit = *hit;
        }
    }

    /// Brings the light back to where the rays came from.
    fn gather(&mut self) {
        for number in (0..self.nodes.len()).rev() {
            let Node { seen, origin, .. } = self.nodes[number];
            let Some(Origin { parent, branch, through }) = origin else { continue };
            let parent = &mut self.nodes[parent].seen;
            match through {
                Some(material) => parent.refract(seen, &branch, &material),
                None => parent.reflect(seen, &branch),
            }
        }
    }
}
