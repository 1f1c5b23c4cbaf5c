//! `octrace inspect`: what octrace makes of a file, stage by stage.

mod report;

use crate::args::InspectArgs;
use crate::failure::Failure;
use crate::input;
use crate::output::write_stdout;
use crate::session::Session;
use crate::tree::{self, NodeCounts};
use crate::values::Pixel;
use octrace::{Bounds, Ray, Scene, Tracer};
use octrace_read::{Loaded, Source};
use report::Report;
use std::fmt::Write;

/// Prints a summary, and the parts asked for.
pub fn run(args: &InspectArgs, session: &Session) -> Result<(), Failure> {
    let (width_px, height_px) = args.view.size_px();
    if let Some(Pixel { x, y }) = args.pixel
        && !(x < width_px && y < height_px)
    {
        return Err(Failure::Usage(format!("pixel {x},{y} is outside of the picture, {width_px}x{height_px}")));
    }
    let (source, loaded) = input::load(&args.file, &args.read, session)?;
    let scene = &loaded.scene;
    let tracer = {
        let (exec, _listening) = session.exec(&args.trace);
        Tracer::build_bodies(&scene.bodies().solids, &args.trace.options(scene.snap), &exec)?
    };
    let counts = NodeCounts::of(&scene.solid);
    if args.json {
        let pixel = args.pixel.map(|pixel| (pixel, tracer.explain(&ray_of(pixel, args, scene, &tracer))));
        let report = Report::new((&source, &loaded, &counts), &tracer, args, pixel);
        let text = serde_json::to_string(&report).expect("numbers and names are plain data");
        return write_stdout(format!("{text}\n").as_bytes());
    }
    write_stdout(summary(&source, &loaded, &counts, &tracer).as_bytes())?;
    if args.tree {
        write_stdout(format!("\ntree\n{}", tree::print(&scene.solid)).as_bytes())?;
    }
    if args.program {
        write_stdout(format!("\nprogram\n{}", tracer.program_text()).as_bytes())?;
    }
    if let Some(pixel) = args.pixel {
        let report = tracer.explain(&ray_of(pixel, args, scene, &tracer));
        write_stdout(format!("\npixel {},{}\n{report}", pixel.x, pixel.y).as_bytes())?;
    }
    Ok(())
}

fn summary(source: &Source, loaded: &Loaded, counts: &NodeCounts, tracer: &Tracer) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "{name:<10} {value}");
    };
    line("file", format!("{}, {} bytes", source.name(), source.text().len()));
    let Loaded { scene, node_counts, depth, .. } = loaded;
    let nodes: Vec<String> = node_counts.iter().map(|(name, count)| format!("{name} {count}")).collect();
    line("nodes", format!("depth {depth}; {}", nodes.join(", ")));
    line("tree", counts.to_string());
    line(
        "scene",
        format!(
            "parts {}, lights {}, {}",
            scene.parts.len(),
            scene.lights.len(),
            match scene.camera {
                Some(_) => "a camera",
                None => "no camera",
            }
        ),
    );
    line("bounds", bounds(&tracer.bounds(), tracer.is_unbounded()));
    let stats = tracer.stats();
    line(
        "program",
        format!(
            "bodies {}, primitives {}, different surfaces {}, uses of surfaces {}",
            stats.bodies, stats.primitives, stats.surfaces, stats.literals
        ),
    );
    if stats.copies > 0 {
        let solids = tracer.catalog().prototypes.len();
        line("copies", format!("{} of {solids} solids, which are stored once", stats.copies));
    }
    let report = tracer.compile_report();
    let moved = match report.snapped_surfaces {
        0 => "nothing was moved".to_owned(),
        n => format!("surfaces moved {n}, the farthest by {:.1e}", report.largest_move),
    };
    line("snapping", format!("within {:.1e}; {moved}", report.tolerance));
    match stats.octree {
        None => line("octree", "none".into()),
        Some(octree) => {
            line(
                "octree",
                format!("depth {}, bytes {}, program words {}", octree.depth, octree.bytes, octree.program_words),
            );
            line(
                "cells",
                format!(
                    "branches {}, leaves {}, outside {}, inside {}",
                    octree.branches, octree.leaves, octree.outside, octree.inside
                ),
            );
        }
    }
    text
}

fn bounds(bounds: &Bounds, unbounded: bool) -> String {
    let more = if unbounded { ", and beyond: the solid is unbounded" } else { "" };
    if bounds.is_empty() {
        return format!("nothing bounded{more}");
    }
    let (a, b) = (bounds.min, bounds.max);
    format!("{} {} {} to {} {} {}{more}", a.x, a.y, a.z, b.x, b.y, b.z)
}

/// The ray through the middle of a pixel.
fn ray_of(pixel: Pixel, args: &InspectArgs, scene: &Scene, tracer: &Tracer) -> Ray {
    let (width_px, height_px) = args.view.size_px();
    let camera = args.view.framing().camera_for(tracer, scene.camera, (width_px, height_px));
    camera.rays(width_px, height_px).ray(f64::from(pixel.x) + 0.5, f64::from(pixel.y) + 0.5)
}
