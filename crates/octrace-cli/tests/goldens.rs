//! Small pictures of the scenes, compared exactly; and the law that how a picture is made changes none of its bits.
//!
//! A missing golden fails. A mismatch leaves the actual picture and the differences in the target folder. After looking at
//! them, `OCTRACE_BLESS=1` accepts what is there.

mod pictures;

use octrace::film::Film;
use octrace::model::frame_all;
use octrace::octree::BuildOptions;
use octrace::query::occupied_bounds;
use octrace::traverse::TraversalKind;
use octrace::{Accel, Camera, Projection, Scene, Tracer, TracerOptions, Vec3};
use octrace_read::{ReadOptions, Source, read_scene};
use std::fs;
use std::path::{Path, PathBuf};

const SIZE_PX: (u32, u32) = (160, 120);

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn scene(file: &str) -> Scene {
    let path = root().join("scenes").join(file);
    let bytes = fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let checked = read_scene(&Source::new(file, bytes), &ReadOptions::default());
    checked.value.unwrap_or_else(|| panic!("{file}: {:?}", checked.diagnostics)).scene
}

/// From where to look.
#[derive(Clone, Copy)]
enum From {
    /// The scene's own camera, or the default view.
    Scene,
    /// An orthographic view along a direction, of everything.
    Along([f64; 3]),
    /// An orthographic view from a point to a point: for looking exactly along a face.
    Points([f64; 3], [f64; 3], f64),
}

fn camera(scene: &Scene, tracer: &Tracer, from: From) -> Camera {
    let orthographic = |height| Projection::Orthographic { height };
    let towards = |eye: [f64; 3], at: [f64; 3], height| Camera {
        eye: eye.into(),
        at: at.into(),
        up: Vec3::Z,
        projection: orthographic(height),
    };
    match from {
        From::Scene => pictures::default_camera(scene, tracer, SIZE_PX),
        From::Along(direction) => {
            let aim = towards([0.0; 3], direction, 1.0);
            frame_all(&occupied_bounds(tracer), Some(&aim), orthographic(1.0), SIZE_PX)
        }
        From::Points(eye, at, height) => towards(eye, at, height),
    }
}

fn film(scene: &Scene, from: From, options: &TracerOptions, threads: usize) -> Film {
    pictures::film(scene, SIZE_PX, options, threads, |tracer| camera(scene, tracer, from))
}

fn check(name: &str, file: &str, from: From) {
    let scene = scene(file);
    let canonical = TracerOptions { accel: Accel::None, ..TracerOptions::default() };
    let expected = film(&scene, from, &canonical, 2);
    for (leaf_surfaces, depth, threads) in [(6, None, 1), (6, None, 2), (1, Some(7), 2), (3, Some(2), 2)] {
        let octree = BuildOptions { leaf_surfaces, depth };
        let options = TracerOptions { octree, ..TracerOptions::default() };
        let accelerated = film(&scene, from, &options, threads);
        let differing = pictures::differing(&accelerated, &expected);
        assert_eq!(differing, 0, "{name}: p {leaf_surfaces}, depth {depth:?}, {threads} threads: pixels differ");
    }
    for traversal in TraversalKind::ALL {
        let options = TracerOptions { traversal, ..TracerOptions::default() };
        let accelerated = film(&scene, from, &options, 2);
        assert_eq!(pictures::differing(&accelerated, &expected), 0, "{name}: {traversal}: pixels differ");
    }
    compare(name, &expected);
}

fn compare(name: &str, film: &Film) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/golden/{name}.png"));
    let actual: Vec<u8> = film.to_rgba8().chunks(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    if std::env::var_os("OCTRACE_BLESS").is_some() {
        write_png(&path, &actual);
        return;
    }
    let leave = |suffix: &str, pixels: &[u8]| {
        let left = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.{suffix}.png"));
        write_png(&left, pixels);
        left.display().to_string()
    };
    if !path.exists() {
        panic!("{name}: there is no golden; the picture is {}", leave("actual", &actual));
    }
    let golden = read_png(&path);
    let worst = std::iter::zip(&actual, &golden).map(|(a, b)| a.abs_diff(*b)).collect::<Vec<u8>>();
    let differing = worst.chunks(3).filter(|p| *p != [0, 0, 0]).count();
    if actual.len() != golden.len() || differing > 0 {
        let places: Vec<(usize, usize)> = (0..worst.len() / 3)
            .filter(|i| worst[3 * i..3 * i + 3] != [0, 0, 0])
            .map(|i| (i % SIZE_PX.0 as usize, i / SIZE_PX.0 as usize))
            .take(5)
            .collect();
        let amplified: Vec<u8> = worst.iter().map(|&d| if d > 0 { 128 + d / 2 } else { 0 }).collect();
        panic!(
            "{name}: {differing} pixels differ, by {} at most; first at {places:?}\n  actual: {}\n  differences: {}",
            worst.iter().max().unwrap_or(&0),
            leave("actual", &actual),
            leave("differences", &amplified),
        );
    }
}

fn write_png(path: &Path, rgb: &[u8]) {
    let file = fs::File::create(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut encoder = png::Encoder::new(file, SIZE_PX.0, SIZE_PX.1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().expect("a valid header");
    writer.write_image_data(rgb).expect("the picture fits its header");
}

fn read_png(path: &Path) -> Vec<u8> {
    let file = fs::File::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a small picture")];
    let info = reader.next_frame(&mut pixels).expect("a whole PNG");
    pixels.truncate(info.buffer_size());
    pixels
}

macro_rules! goldens {
    ($($name:ident: $file:literal, $from:expr;)*) => {
        $(#[test]
        fn $name() {
            check(stringify!($name), $file, $from);
        })*

        /// Every scene is drawn by a test.
        #[test]
        fn every_scene_has_a_golden() {
            let drawn = [$($file),*];
            let scenes = root().join("scenes");
            for folder in [scenes.clone(), scenes.join("coincidence")] {
                for entry in fs::read_dir(folder).expect("the scenes are readable") {
                    let path = entry.expect("the scenes are readable").path();
                    let name = path.strip_prefix(&scenes).expect("it is in there").to_string_lossy().replace('\\', "/");
                    assert!(path.is_dir() || drawn.contains(&name.as_str()), "{name} is in no golden");
                }
            }
        }

        /// No golden is left over from a test that is gone.
        #[test]
        fn every_golden_has_its_test() {
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
            for entry in fs::read_dir(folder).expect("the goldens are readable") {
                let name = entry.expect("the goldens are readable").file_name();
                let known = [$(concat!(stringify!($name), ".png")),*];
                assert!(known.iter().any(|k| **k == *name), "{} belongs to no test", name.display());
            }
        }
    };
}

goldens! {
    bearing_block: "bearing-block.oct", From::Scene;
    classic: "classic.oct", From::Scene;
    die: "die.oct", From::Scene;
    forms: "forms.oct", From::Scene;
    inlay: "inlay.oct", From::Scene;
    lens: "lens.oct", From::Scene;
    shapes: "shapes.oct", From::Scene;
    shared_face: "coincidence/shared-face.oct", From::Scene;
    shared_face_along: "coincidence/shared-face.oct", From::Points([9.0, -9.0, 2.0], [1.5, 2.5, 2.0], 4.0);
    flush_hole: "coincidence/flush-hole.oct", From::Scene;
    flush_hole_face_on: "coincidence/flush-hole.oct", From::Along([0.0, 0.0, -1.0]);
    flush_hole_from_below: "coincidence/flush-hole.oct", From::Along([0.1, 0.3, 1.0]);
    flush_hole_grazing: "coincidence/flush-hole.oct", From::Along([0.2, 1.0, -0.0005]);
    nothing_left: "coincidence/nothing-left.oct", From::Along([0.3, 1.0, -0.4]);
    shared_wall: "coincidence/shared-wall.oct", From::Scene;
    shared_wall_along: "coincidence/shared-wall.oct", From::Points([2.0, -9.0, 0.5], [2.0, 0.0, 0.5], 3.0);
    tangent: "coincidence/tangent.oct", From::Scene;
    tangent_grazing: "coincidence/tangent.oct", From::Points([0.0, -20.0, 0.02], [0.0, 0.0, 0.01], 0.5);
}
