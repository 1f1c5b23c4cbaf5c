//! The figures of all kinds of scenes: drawn without a panic, legible, the same every time.

use super::sheet::{WIDTH, text_width};
use super::*;
use octrace::film::Background;
use octrace::model::frame_all;
use octrace::{Projection, Vec3};
use octrace_read::{ReadOptions, Source, read_scene};
use std::path::Path;

fn read(name: &str, text: Vec<u8>) -> Scene {
    let checked = read_scene(&Source::new(name, text), &ReadOptions::default());
    checked.value.unwrap_or_else(|| panic!("{name}: {:?}", checked.diagnostics)).scene
}

fn figures(scene: &Scene) -> Result<[String; 5], Failure> {
    let exec = Exec::with_threads(2);
    let bodies = scene.bodies().solids;
    let options = TracerOptions { snap: scene.snap, ..TracerOptions::default() };
    let tracer = &Tracer::build_bodies(&bodies, &options, &exec)?;
    let perspective = Projection::Perspective { fov_deg: 22.5 };
    let camera = scene.camera.unwrap_or_else(|| frame_all(&tracer.bounds(), None, perspective, (64, 48)));
    let view = View { camera, width_px: 64, height_px: 48, samples: 1, max_bounces: 8, background: Background::Scene };
    let octree = BuildOptions { leaf_surfaces: 2, depth: Some(5) };
    draw(&Subject { scene, bodies: &bodies, tracer, view, pixel: (35, 30), slice_z: None, octree }, &exec)
}

/// The sheet's height.
fn height(figure: &str) -> f64 {
    let text = figure.split_once("height=\"").and_then(|(_, rest)| rest.split_once('"'));
    text.and_then(|(height, _)| height.parse().ok()).expect("an SVG file says how high it is")
}

/// A text in a figure: where it is, and what it says.
struct Words {
    left: f64,
    right: f64,
    base: f64,
    size: f64,
    text: String,
}

fn words(figure: &str) -> Vec<Words> {
    use svg::parser::Event;
    let (mut found, mut open) = (Vec::new(), None);
    for event in svg::read(figure).expect("an SVG file") {
        match event {
            Event::Tag("text", svg::node::element::tag::Type::Start, attributes) => open = Some(attributes),
            Event::Tag("text", _, _) => open = None,
            Event::Text(text) => {
                let Some(attributes) = &open else { continue };
                let text = text.trim();
                let number = |name: &str| attributes[name].parse::<f64>().expect("a number");
                let (x, base, size) = (number("x"), number("y"), number("font-size"));
                // What is sure to be covered; `text_width` is what may be.
                let width = 0.9 * text_width(text, size);
                let anchor = attributes.get("text-anchor").map_or("start", |anchor| &**anchor);
                let left = match anchor {
                    "middle" => x - width / 2.0,
                    "end" => x - width,
                    _ => x,
                };
                found.push(Words { left, right: left + width, base, size, text: text.to_owned() });
            }
            Event::Error(error) => panic!("{error}"),
            _ => {}
        }
    }
    found
}

/// No text leaves the sheet or runs into another one.
fn check_legible(name: &str, figure: &str) {
    let (words, bottom) = (words(figure), height(figure));
    assert!(words.len() > 1, "{name}");
    for (index, a) in words.iter().enumerate() {
        let within = a.left > 0.0 && a.right < WIDTH && a.base > a.size && a.base + 0.2 * a.size < bottom;
        assert!(within, "{name}: {:?} leaves the sheet", a.text);
        for b in &words[index + 1..] {
            let across = a.left < b.right && b.left < a.right;
            let (low, high) = if a.base > b.base { (a, b) } else { (b, a) };
            let along = low.base - 0.7 * low.size < high.base;
            assert!(!(across && along), "{name}: {:?} and {:?} overlap", a.text, b.text);
        }
    }
}

fn check(name: &str, scene: &Scene) {
    let drawn = figures(scene).unwrap_or_else(|failure| panic!("{name}: {failure}"));
    for (file, figure) in FILES.iter().zip(&drawn) {
        check_legible(&format!("{name}: {file}"), figure);
        assert!(!figure.contains("NaN") && !figure.contains("inf\""), "{name}: {file}");
    }
    let again = figures(scene).unwrap_or_else(|failure| panic!("{name}: {failure}"));
    assert!(drawn == again, "{name}: the same figures every time");
}

#[test]
fn every_scene_can_be_drawn() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut drawn = 0;
    for folder in [root.clone(), root.join("coincidence")] {
        for entry in std::fs::read_dir(folder).expect("the scenes are readable") {
            let path = entry.expect("the scenes are readable").path();
            if path.is_file() {
                let name = path.file_name().expect("a file").to_string_lossy();
                let scene = read(&name, std::fs::read(&path).expect("the scenes are readable"));
                if name == "nothing-left.oct" {
                    continue; // Drawn below.
                }
                check(&name, &scene);
                drawn += 1;
            }
        }
    }
    assert!(drawn > 8, "the test reads the scenes");
}

#[test]
fn the_example_can_be_drawn() {
    check("example", &read("example.oct", EXAMPLE.into()));
}

#[test]
fn strange_solids_can_be_drawn() {
    let balls =
        (0..3000).map(|i| Solid::sphere().scale([0.4; 3]).translate([f64::from(i % 50), f64::from(i / 50), 0.0]));
    let nested = (0..20_000).fold(Solid::block(), |solid, i| {
        let hole = Solid::sphere().scale([0.01; 3]).translate([f64::from(i % 100) / 100.0, 0.5, 1.0]);
        if i % 2 == 0 { solid - hole } else { solid | hole }
    });
    let glass = octrace::Part { material: octrace::Material::glass(octrace::Rgb::WHITE) };
    for (name, scene) in [
        ("one", Scene::new(Solid::sphere())),
        ("nothing left", Scene::new(Solid::block() - Solid::block())),
        ("wide", Scene::new(Solid::union(balls))),
        ("deep", Scene::new(nested)),
        ("huge", Scene::new(Solid::sphere().scale([1e25; 3]).translate([1e26, 0.0, 0.0]))),
        ("tiny", Scene::new(Solid::block().scale([1e-20; 3]) - Solid::sphere().scale([1e-21; 3]))),
        (
            "glass",
            Scene { parts: vec![glass], ..Scene::new(Solid::sphere().part(octrace::PartId(0)) - Solid::block()) },
        ),
    ] {
        check(name, &scene);
    }
}

#[test]
fn what_is_nowhere_bounded_has_no_figures() {
    for solid in [Solid::empty(), Solid::half_space(), Solid::half_space() - Solid::half_space().translate(Vec3::Z)] {
        assert!(matches!(figures(&Scene::new(solid)), Err(Failure::NoAnswer(_))));
    }
}
