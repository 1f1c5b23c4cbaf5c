//! What octrace makes of fixed scenes, and how much work they are: programs, octrees, counts. Tests count, they do not
//! time: where one of these numbers grows, something has become slower.

use octrace::exec::Exec;
use octrace::film::{Background, Film, RenderStats, View, render};
use octrace::model::frame_all;
use octrace::octree::BuildOptions;
use octrace::trace::TracerStats;
use octrace::traverse::TraversalKind;
use octrace::{Material, Part, PartId, Projection, Rgb, Scene, Solid, Tracer, TracerOptions};
use std::fmt::Write;

/// What came of a scene.
#[derive(Debug, PartialEq)]
struct Outcome {
    program: String,
    tracer: TracerStats,
    picture: RenderStats,
    film: Film,
}

fn outcome(scene: &Scene, traversal: TraversalKind, threads: usize) -> Outcome {
    let exec = Exec::with_threads(threads);
    let octree = BuildOptions { leaf_surfaces: 2, depth: Some(5) };
    let options = TracerOptions { octree, traversal, ..TracerOptions::default() };
    let tracer = Tracer::build_bodies(&scene.bodies().solids, &options, &exec).expect("nobody cancels");
    let perspective = Projection::Perspective { fov_deg: 22.5 };
    let view = View {
        camera: frame_all(&tracer.bounds(), None, perspective, (64, 48)),
        width_px: 64,
        height_px: 48,
        samples: 1,
        max_bounces: 4,
        background: Background::Scene,
    };
    let (film, picture) = render(scene, &tracer, &view, &exec).expect("nobody cancels");
    Outcome { program: tracer.program_text(), tracer: tracer.stats(), picture, film }
}

/// The program, the octree, and what a picture of 64 by 48 pixels takes; the same for any number of threads.
fn report(scene: &Scene) -> String {
    let outcome_by = |traversal| {
        let one = outcome(scene, traversal, 1);
        assert!(one == outcome(scene, traversal, 3), "threads are visible");
        one
    };
    let Outcome { program, tracer, picture, .. } = outcome_by(TraversalKind::default());
    let mut text = format!("{program}\n{tracer:#?}\n\n{picture:#?}\n\ncells visited\n");
    for traversal in TraversalKind::ALL {
        writeln!(text, "  {traversal}: {}", outcome_by(traversal).picture.counters.cells).expect("strings take all");
    }
    text
}

#[track_caller]
fn check(name: &str, scene: &Scene) {
    insta::with_settings!({ omit_expression => true }, { insta::assert_snapshot!(name, report(scene)) });
}

/// A block with a hole that ends in both faces.
fn drilled() -> Solid {
    Solid::block() - Solid::cylinder().scale([0.25, 0.25, 1.0]).translate([0.5, 0.5, 0.0])
}

/// Cube and sphere minus three cylinders.
fn classic() -> Solid {
    let bar = || Solid::cylinder().translate([0.0, 0.0, -0.5]).scale([0.6, 0.6, 3.0]);
    let cube = Solid::block().translate([-0.5; 3]).scale([2.0; 3]);
    let rounded = cube & Solid::sphere().scale([1.35; 3]);
    Solid::difference([rounded, bar(), bar().rotate([90.0, 0.0, 0.0]), bar().rotate([0.0, 90.0, 0.0])])
}

#[test]
fn a_drilled_block() {
    check("drilled_block", &Scene::new(drilled()));
}

#[test]
fn the_classic() {
    check("classic", &Scene::new(classic()));
}

/// Neighbours share walls: of 4 x 4 blocks only the outer faces, and the planes in between, are left.
#[test]
fn blocks_side_by_side() {
    let at = |i: i32| Solid::block().translate([f64::from(i % 4), f64::from(i / 4), 0.0]);
    check("blocks_side_by_side", &Scene::new(Solid::union((0..16).map(at))));
}

/// Copies that are stored once: the numbers are those of one solid, and of where it stands.
#[test]
fn copies_of_the_classic() {
    let at = |i: i32| [f64::from(i % 6) * 3.0, f64::from(i / 6) * 3.0, 0.25];
    check("copies", &Scene::new(Solid::union((0..36).map(|i| classic().translate(at(i))))));
}

/// Two bodies, and something unbounded.
#[test]
fn glass_on_a_floor() {
    let part = |material| Part { material };
    let floor = Solid::half_space().scale([1.0, 1.0, -1.0]).part(PartId(0));
    let parts = vec![part(Material::matte(Rgb::gray(0.5))), part(Material::glass(Rgb::WHITE))];
    check("glass_on_a_floor", &Scene { parts, ..Scene::new(floor + drilled().part(PartId(1))) });
}

#[test]
fn nothing_is_left_of_a_solid_minus_itself() {
    check("nothing_left", &Scene::new(classic() - classic()));
}
