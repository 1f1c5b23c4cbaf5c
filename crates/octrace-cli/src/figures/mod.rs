//! The paper's figures, drawn for any scene. One file per figure; [`sheet`] is what they are drawn on.
//!
//! Figures are finished texts: nothing is written here. The same scene and options give the same bytes.

mod csg_tree;
mod icons;
mod layout;
mod names;
mod octree_slice;
mod programs;
mod quadtree_walk;
mod ray_tree;
mod section;
mod sheet;
mod sketch;
mod slice;
mod spans;

use crate::failure::Failure;
use octrace::compile::Copies;
use octrace::exec::Exec;
use octrace::film::{self, View};
use octrace::octree::BuildOptions;
use octrace::{Scene, Solid, Tracer, TracerOptions};
use slice::Slice;

/// The scene that is drawn where no other is named: the paper's kind of solid, with something to mirror and refract it.
pub const EXAMPLE: &str = include_str!("example.oct");

/// Which pixel of the example's picture is looked at, from its upper left in shares of its size: glass before the solid.
pub const EXAMPLE_PIXEL: (f64, f64) = (0.547, 0.599);
/// The height of the slice through the example: not in the middle, where the drillings leave hardly anything.
pub const EXAMPLE_SLICE_Z: f64 = -0.75;

/// The files that figures are written to.
pub const FILES: [&str; 5] = ["csg-tree.svg", "spans.svg", "ray-tree.svg", "octree-slice.svg", "quadtree-walk.svg"];

/// What to draw.
pub struct Subject<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its bodies.
    pub bodies: &'a [Solid],
    /// The tracer of the bodies.
    pub tracer: &'a Tracer,
    /// The picture of which one pixel is looked at.
    pub view: View,
    /// That pixel.
    pub pixel: (u32, u32),
    /// The height of the slice; through the middle if not said.
    pub slice_z: Option<f64>,
    /// How the drawn octree is built.
    pub octree: BuildOptions,
}

/// Draws all figures, in the order of [`FILES`].
pub fn draw(subject: &Subject, exec: &Exec) -> Result<[String; 5], Failure> {
    let Subject { scene, view, pixel: (x, y), .. } = *subject;
    // The octree is that of the paper, of one solid, whatever it is made of.
    let options =
        TracerOptions { octree: subject.octree, snap: scene.snap, copies: Copies::Apart, ..TracerOptions::default() };
    let whole = Tracer::build(&scene.solid, &options, exec)?;
    let slice = Slice::new(&whole, subject.slice_z)?;
    let ray = view.camera.rays(view.width_px, view.height_px).ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
    let rays = film::ray_tree(scene, subject.tracer, &view, (x, y));
    Ok([
        csg_tree::draw(&scene.solid),
        spans::draw(scene, &ray, exec)?,
        ray_tree::draw(scene, &rays, &names::of_bodies(scene, subject.bodies), (x, y)),
        octree_slice::draw(&slice, &whole, &names::of_solid(&scene.solid)),
        quadtree_walk::draw(&slice, &whole),
    ])
}

#[cfg(test)]
mod tests;
