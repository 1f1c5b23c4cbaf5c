//! Pictures: what is seen in them, whether light falls on it, and whether all accelerations make the same.

use crate::answers::name;
use crate::expected::{From, Sight};
use crate::{Exhibit, accelerations, canonical, tracer};
use octrace::exec::Exec;
use octrace::film::{Background, Film, View, render};
use octrace::model::frame_all;
use octrace::query::occupied_bounds;
use octrace::trace::Scratch;
use octrace::{Camera, Light, Material, PartId, Projection, Ray, Rgb, Scene, Tracer, TracerOptions, Vec3};
use std::collections::BTreeMap;

const WIDTH_PX: u32 = 160;
const HEIGHT_PX: u32 = 120;
const SIZE_PX: (u32, u32) = (WIDTH_PX, HEIGHT_PX);

/// From all of these every scene is looked at, whatever it says itself: oblique in perspective, front, top, oblique.
const USUAL: [From; 4] = [
    From::Scene,
    From::Along(Vec3::new(0.0, 1.0, 0.0)),
    From::Along(Vec3::new(0.0, 0.0, -1.0)),
    From::Along(Vec3::new(-3.0, 4.0, -5.0)),
];

fn camera(scene: &Scene, tracer: &Tracer, from: From) -> Camera {
    let orthographic = |height| Projection::Orthographic { height };
    match from {
        From::Scene => scene.camera.unwrap_or_else(|| {
            let perspective = Projection::Perspective { fov_deg: Camera::OPENSCAD_FOV_DEG };
            frame_all(&occupied_bounds(tracer), None, perspective, SIZE_PX)
        }),
        From::Along(direction) => {
            let aim = Camera { eye: Vec3::ZERO, at: direction, up: Vec3::Z, projection: orthographic(1.0) };
            frame_all(&occupied_bounds(tracer), Some(&aim), orthographic(1.0), SIZE_PX)
        }
        From::Point { eye, at, height } => Camera { eye, at, up: Vec3::Z, projection: orthographic(height) },
    }
}

/// Rays through the middle of all pixels, row by row.
fn rays(camera: &Camera) -> impl Iterator<Item = Ray> + use<> {
    let rays = camera.rays(WIDTH_PX, HEIGHT_PX);
    let middle = |i: u32| f64::from(i) + 0.5;
    (0..HEIGHT_PX).flat_map(move |y| (0..WIDTH_PX).map(move |x| rays.ray(middle(x), middle(y))))
}

/// What is seen in a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    part: Option<PartId>,
    normal: Vec3,
}

fn seen(tracer: &Tracer, camera: &Camera) -> Vec<Option<Seen>> {
    let mut scratch = Scratch::default();
    let seen = |ray: Ray| {
        let (_, hit) = tracer.first_body_hit(&ray, f64::INFINITY, &mut scratch)?;
        let point = tracer.surface_point(&ray, &hit);
        Some(Seen { part: point.part, normal: point.normal })
    };
    rays(camera).map(seen).collect()
}

/// What is wrong with colours, and the number of their regions, in the views of which the file says what is seen.
pub fn wrong_regions(exhibit: &Exhibit) -> Vec<String> {
    let tracer = exhibit.tracer(&TracerOptions::default());
    exhibit.expected.sights.iter().filter_map(|sight| wrong_sight(exhibit, &tracer, sight)).collect()
}

fn wrong_sight(exhibit: &Exhibit, tracer: &Tracer, sight: &Sight) -> Option<String> {
    let pixels = seen(tracer, &camera(&exhibit.scene, tracer, sight.from));
    let color = |pixel: &Option<Seen>| pixel.map_or("nothing", |seen| exhibit.color(seen.part)).to_owned();
    let regions: Vec<(String, usize)> = regions(&pixels.iter().map(color).collect::<Vec<_>>())
        .into_iter()
        .fold(BTreeMap::new(), count)
        .into_iter()
        .collect();
    let faces = regions_of_faces(&pixels);
    let same_faces = sight.faces.is_none_or(|expected| expected == faces);
    (regions != sight.regions || !same_faces).then(|| format!("{}: sees {regions:?}; faces {faces}", sight.line))
}

fn regions_of_faces(pixels: &[Option<Seen>]) -> usize {
    regions(pixels).into_iter().filter(Option::is_some).count()
}

fn count(mut counts: BTreeMap<String, usize>, color: String) -> BTreeMap<String, usize> {
    *counts.entry(color).or_default() += 1;
    counts
}

/// The value of each region of equal pixels; neighbours share a side or a corner.
fn regions<T: PartialEq + Clone>(pixels: &[T]) -> Vec<T> {
    let mut reached = vec![false; pixels.len()];
    let mut found = Vec::new();
    for start in 0..pixels.len() {
        if std::mem::replace(&mut reached[start], true) {
            continue;
        }
        found.push(pixels[start].clone());
        let mut pending = vec![start];
        while let Some(at) = pending.pop() {
            for near in neighbours(at) {
                if pixels[near] == pixels[start] && !std::mem::replace(&mut reached[near], true) {
                    pending.push(near);
                }
            }
        }
    }
    found
}

/// The pixels around one, and itself.
fn neighbours(at: usize) -> impl Iterator<Item = usize> {
    let (width, height) = (WIDTH_PX as usize, HEIGHT_PX as usize);
    let around = |i: usize, end: usize| i.saturating_sub(1)..=(i + 1).min(end - 1);
    let (x, y) = (at % width, at / width);
    around(y, height).flat_map(move |y| around(x, width).map(move |x| y * width + x))
}

/// Where a picture, lit from the eye, is not as bright as the surfaces' slopes make it: nothing there casts a shadow on
/// itself.
pub fn wrong_light(exhibit: &Exhibit) -> Vec<String> {
    let mut scene = exhibit.scene.clone();
    for part in &mut scene.parts {
        part.material = Material::matte(part.material.color);
    }
    scene.ambient = Some(Rgb::BLACK);
    let tracer = tracer(&scene, &TracerOptions::default());
    let stated = exhibit.expected.sights.iter().map(|sight| sight.from);
    let views = USUAL.into_iter().filter(|from| !matches!(from, From::Scene)).chain(stated);
    let mut wrong = Vec::new();
    for from in views {
        let camera = camera(&scene, &tracer, from);
        let forward = camera.frame().2;
        scene.lights = vec![Light::Directional { direction: forward, intensity: Rgb::WHITE }];
        let (film, _) = film(&scene, &tracer, camera, 1);
        let pixels = std::iter::zip(film.pixels(), seen(&tracer, &camera));
        let dark =
            pixels.filter(|(pixel, seen)| seen.is_some_and(|seen| !is_lit(&scene, pixel, seen, forward))).count();
        if dark > 0 {
            wrong.push(format!("{from:?}: light falls wrongly on {dark} pixels"));
        }
    }
    wrong
}

/// By Lambert's law, within the film's accuracy.
fn is_lit(scene: &Scene, pixel: &[f32; 4], seen: Seen, forward: Vec3) -> bool {
    let material = scene.material(seen.part);
    let Rgb { r, g, b } = material.color * (material.kd * seen.normal.dot(forward).abs());
    std::iter::zip(pixel, [r, g, b]).all(|(&actual, expected)| (f64::from(actual) - expected).abs() < 1e-5)
}

/// In which views any acceleration differs from the canonical tracer, or cells contradict each other.
pub fn wrong_bits(exhibit: &Exhibit) -> Vec<String> {
    let scene = &exhibit.scene;
    let stated = exhibit.expected.sights.iter().map(|sight| sight.from);
    let views: Vec<From> = USUAL.into_iter().chain(stated).collect();
    let reference = exhibit.tracer(&canonical());
    let picture = |tracer: &Tracer, from: From| film(scene, tracer, camera(scene, tracer, from), 2);
    let expected: Vec<Film> = views.iter().map(|&from| picture(&reference, from).0).collect();
    let mut wrong = Vec::new();
    for options in accelerations().into_iter().take(PICTURED) {
        let tracer = exhibit.tracer(&options);
        for (&from, expected) in std::iter::zip(&views, &expected) {
            let (film, leaks) = picture(&tracer, from);
            let differing = std::iter::zip(film.pixels(), expected.pixels()).filter(|(a, b)| a != b).count();
            if differing > 0 || leaks > 0 {
                wrong.push(format!("{from:?} by {}: {differing} pixels differ, {leaks} leaks", name(&options)));
            }
        }
    }
    wrong
}

/// So many accelerations make pictures: that with tiles in cells of three sizes, and one that goes ray by ray.
const PICTURED: usize = 4;

/// A picture, and how often cells contradicted each other.
fn film(scene: &Scene, tracer: &Tracer, camera: Camera, samples: u32) -> (Film, u64) {
    let (width_px, height_px) = SIZE_PX;
    let view = View { camera, width_px, height_px, samples, max_bounces: 3, background: Background::Scene };
    let (film, stats) = render(scene, tracer, &view, &Exec::with_threads(2)).expect("nobody cancels");
    (film, stats.counters.leaks)
}

#[test]
fn regions_hang_together_by_sides_and_corners() {
    let mut pixels = vec![0; (WIDTH_PX * HEIGHT_PX) as usize];
    let mut paint = |x: u32, y: u32, color: u8| pixels[(y * WIDTH_PX + x) as usize] = color;
    paint(4, 4, 1);
    paint(5, 5, 1);
    // The end of a row and the start of the next are no neighbours.
    paint(WIDTH_PX - 1, 8, 2);
    paint(0, 9, 2);
    let mut found = regions(&pixels);
    found.sort();
    assert_eq!(found, [0, 1, 2, 2]);
}
