//! One pixel's tree of rays as data, to look at [Whitted 1980; Comba-Persiano, §2.3].

use crate::geom::{Hit, Ray};
use crate::model::Rgb;
use crate::trace::SurfacePoint;

/// Where a ray comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// The eye: the root of the tree.
    Camera,
    /// A mirror image.
    Reflected,
    /// Through a transparent surface.
    Refracted,
    /// From a surface towards a light.
    Shadow {
        /// Which of the lights, counted from 0.
        light: usize,
    },
}

/// A ray of the tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TracedRay {
    /// The ray at the end of which this one starts: an index into [`RayTree::rays`].
    pub parent: Option<usize>,
    /// Where it comes from.
    pub kind: RayKind,
    /// The ray.
    pub ray: Ray,
    /// What it meets, if anything: of a shadow ray, what is last in the light's way.
    pub hit: Option<(Hit, SurfacePoint)>,
    /// The light that comes along it; of a shadow ray, the share of its light that does.
    pub light: Rgb,
    /// By what that is multiplied on its way to the eye.
    pub weight: Rgb,
}

impl TracedRay {
    /// What the ray adds to the pixel. That of the rays which start at its end is part of it.
    pub fn contribution(&self) -> Rgb {
        self.light * self.weight
    }
}

/// All rays that were traced for one camera ray, each behind the one that it starts at.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RayTree {
    /// The rays; the first is the camera's.
    pub rays: Vec<TracedRay>,
}

/// Somebody who watches a tree of rays grow, from the root down. Nobody, `()`, costs nothing.
pub(crate) trait Watch {
    /// A ray sets out; what comes along it will be multiplied by `factor`.
    fn sets_out(&mut self, _kind: RayKind, _ray: &Ray, _factor: Rgb) {}
    /// The ray meets something.
    fn meets(&mut self, _hit: &Hit, _point: &SurfacePoint) {}
    /// The ray is done: so much light comes along it.
    fn returns(&mut self, _light: Rgb) {}
}

impl Watch for () {}

/// Writes the tree down.
#[derive(Debug, Default)]
pub(crate) struct Recorder {
    pub tree: RayTree,
    /// The rays that have set out and not returned.
    open: Vec<usize>,
}

impl Watch for Recorder {
    fn sets_out(&mut self, kind: RayKind, ray: &Ray, factor: Rgb) {
        let parent = self.open.last().copied();
        let weight = parent.map_or(factor, |parent| self.tree.rays[parent].weight * factor);
        self.open.push(self.tree.rays.len());
        self.tree.rays.push(TracedRay { parent, kind, ray: *ray, hit: None, light: Rgb::BLACK, weight });
    }

    fn meets(&mut self, hit: &Hit, point: &SurfacePoint) {
        if let Some(&last) = self.open.last() {
            self.tree.rays[last].hit = Some((*hit, *point));
        }
    }

    fn returns(&mut self, light: Rgb) {
        if let Some(last) = self.open.pop() {
            self.tree.rays[last].light = light;
        }
    }
}
