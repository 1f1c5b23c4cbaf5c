//! What a scene holds besides its solid: materials, lights, camera, surroundings; and what else is known of the file.

use octrace::{Camera, Light, Material, Projection, Rgb, Scene, Vec3};
use octrace_read::{Dialect, Folder, Ghosts, Loaded, ReadOptions, Source, read_scene};

fn load_as(name: &str, text: &str, options: &ReadOptions) -> Loaded {
    let checked = read_scene(&Source::new(name, text), options);
    assert_eq!(checked.diagnostics, [], "{text}");
    checked.value.expect("there is a scene")
}

fn scene(text: &str) -> Scene {
    load_as("test.oct", text, &ReadOptions::default()).scene
}

fn material(text: &str) -> Material {
    let scene = scene(text);
    assert_eq!(scene.parts.len(), 1, "{text}");
    scene.parts[0].material
}

fn camera(text: &str) -> Camera {
    scene(&format!("{text} block();")).camera.expect("there is a camera")
}

#[test]
fn colours_are_srgb_in_files_and_linear_in_scenes() {
    let red = Material::plastic(Rgb::new(1.0, 0.0, 0.0));
    for text in ["\"red\"", "\"#f00\"", "\"#ff0000\"", "[1, 0, 0]", "[1, 0, 0, 1]", "c = \"Red\", alpha = 1"] {
        assert_eq!(material(&format!("color({text}) block();")), red, "{text}");
    }
    let gray = material("color([0.5, 0.5, 0.5]) block();");
    assert_eq!(gray.color, Rgb::from_srgb([0.5; 3]));
    assert_eq!(scene("block();").parts, []);
    assert_eq!(scene("color([-1, -1, -1, -1]) block();").parts, [], "OpenSCAD's way to say nothing");
}

#[test]
fn what_is_not_opaque_lets_light_pass() {
    let half = material("color(\"red\", 0.25) block();");
    let opaque = Material::plastic(Rgb::new(1.0, 0.0, 0.0));
    let expected = Material { ka: opaque.ka * 0.25, kd: opaque.kd * 0.25, kt: 0.75, tint: 0.0, ..opaque };
    assert_eq!(half, expected);
    assert_eq!(material("color(alpha = 0.25) block();").color, Material::default().color);
}

#[test]
fn materials_are_presets_with_changes() {
    let white = Rgb::WHITE;
    assert_eq!(material("material(\"glass\") block();"), Material::glass(white));
    assert_eq!(material("color(\"white\") material(\"metal\") block();"), Material::metal(white));
    assert_eq!(material("material(\"metal\") color(\"white\") block();"), Material::metal(white));
    assert_eq!(material("material() block();"), Material::default());
    let changed =
        material("material(\"matte\", \"white\", ka = 0.1, kr = 0.2, kt = 0.3, ior = 1.4, shininess = 7) block();");
    assert_eq!(changed, Material { ka: 0.1, kr: 0.2, kt: 0.3, ior: 1.4, shininess: 7.0, ..Material::matte(white) });
    let inner = material("material(\"mirror\") material(\"matte\", \"white\") block();");
    assert_eq!(inner, Material::matte(white), "the innermost material counts");
}

#[test]
fn equal_materials_are_one_part() {
    let scene = scene("color(\"red\") block(); color([1, 0, 0]) sphere(); color(\"blue\") color(\"red\") block();");
    assert_eq!(scene.parts.len(), 2);
}

#[test]
fn cameras_are_aimed_as_in_openscad() {
    let plain = Camera {
        eye: Vec3::new(10.0, 0.0, 0.0),
        at: Vec3::ZERO,
        up: Vec3::Z,
        projection: Projection::Perspective { fov_deg: 22.5 },
    };
    assert_eq!(camera("camera(eye = [10, 0, 0]);"), plain);
    assert_eq!(camera("camera(from = [10, 0, 0], look_at = [0, 0, 0], up = [0, 0, 1]);"), plain);
    assert_eq!(camera("camera([10, 0, 0, 0, 0, 0]);"), plain);
    // Angles (90, 0, 0) look along +y, (90, 0, 90) along -x.
    assert_eq!(camera("camera([0, 0, 0, 90, 0, 90, 10]);"), plain);
    let from_above = camera("camera([1, 2, 3, 0, 0, 0, 5]);");
    assert_eq!((from_above.eye, from_above.up), (Vec3::new(1.0, 2.0, 8.0), Vec3::Y));
    let orthographic = Camera { projection: Projection::Orthographic { height: 4.0 }, ..plain };
    assert_eq!(camera("camera(eye = [10, 0, 0], projection = \"orthographic\", height = 4);"), orthographic);
    assert_eq!(
        camera("camera(eye = [10, 0, 0], projection = \"ortho\", fov = 90);").projection,
        Projection::Orthographic { height: 20.0 }
    );
}

#[test]
fn lights_and_cameras_move_with_the_nodes_around_them() {
    let scene = scene(
        "translate([0, 0, 1]) rotate([0, 0, 90]) { light(position = [1, 0, 0], color = \"blue\", intensity = 2);
         light(direction = [1, 0, 0]); camera(eye = [5, 0, 0]); } ambient(0.25); background(\"blue\"); block();",
    );
    let blue = Rgb::new(0.0, 0.0, 1.0);
    assert_eq!(
        scene.lights,
        [
            Light::Point { position: Vec3::new(0.0, 1.0, 1.0), intensity: blue * 2.0 },
            Light::Directional { direction: Vec3::Y, intensity: Rgb::WHITE },
        ]
    );
    let camera = scene.camera.expect("there is a camera");
    assert_eq!((camera.eye, camera.at), (Vec3::new(0.0, 5.0, 1.0), Vec3::Z));
    assert_eq!(scene.ambient, Some(Rgb::gray(0.25)));
    assert_eq!(scene.background, Some(blue));
}

#[test]
fn the_tolerance_is_that_of_the_dialect() {
    let text = "cube();";
    let snap = |name, options: &ReadOptions| load_as(name, text, options).scene.snap;
    let default = ReadOptions::default();
    assert_eq!(snap("a.csg", &default), Scene::SNAP_SIX_DIGITS);
    assert_eq!(snap("a.oct", &default), 0.0);
    assert_eq!(snap("a.csg", &ReadOptions { dialect: Some(Dialect::Scene), ..default.clone() }), 0.0);
    assert_eq!(snap("a.csg", &ReadOptions { snap: Some(0.5), ..default }), 0.5);
}

#[test]
fn what_is_known_of_the_file() {
    let text = "union() { color(\"red\") { cube(1); cube(2); } sphere(); }";
    let loaded = load_as("a.oct", text, &ReadOptions::default());
    let counts: Vec<(&str, usize)> = loaded.node_counts.iter().map(|(name, count)| (name.as_str(), *count)).collect();
    assert_eq!(counts, [("color", 1), ("cube", 2), ("sphere", 1), ("union", 1)]);
    assert_eq!((loaded.leaves, loaded.depth, loaded.background), (3, 2, 0));
    let source = Source::new("a.oct", text);
    assert_eq!(loaded.part_places.iter().map(|at| source.slice(*at)).collect::<Vec<_>>(), ["color"]);
}

#[test]
fn equal_primitives_are_one() {
    let scene = scene("cube(1); cube(2); sphere($fn = 6); sphere(r = 4, $fn = 6);");
    let octrace::model::Node::Combine(_, children) = scene.solid.node() else { panic!("a union") };
    let leaf = |i: usize| match children[i].node() {
        octrace::model::Node::Transform(_, child) => child.id(),
        _ => children[i].id(),
    };
    assert_eq!(leaf(0), leaf(1));
    assert_eq!(leaf(2), leaf(3));
}

#[test]
fn an_empty_mesh_is_nothing_and_that_is_said() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("empty.stl"), "solid\nendsolid\n").expect("a file can be written");
    let source = Source::new("test.csg", "cube(1); import(file = \"empty.stl\");");
    let checked = read_scene(&source.with_assets(Folder(folder.path().to_owned())), &ReadOptions::default());
    assert_eq!(checked.diagnostics.iter().map(|d| d.code).collect::<Vec<_>>(), ["empty-file"]);
    assert_eq!(checked.value.expect("there is a scene").leaves, 1);
}

#[test]
fn what_is_flat_and_in_the_background_is_a_plate() {
    let options = ReadOptions { ghosts: Ghosts::Drawn, ..ReadOptions::default() };
    let scene = load_as("test.csg", "cube(1); %translate([5, 0, 0]) { square(2); }", &options).scene;
    let bounds = octrace_forms::space::bounds(&scene.solid);
    assert_eq!((bounds.min.to_array(), bounds.max.to_array()), ([0.0, 0.0, -0.5], [7.0, 2.0, 1.0]));
    assert_eq!(scene.parts.len(), 1);
}
