//! What is measured: the scenes of the race against other programs (`bench/race`), or the user's files.

use octrace::model::families;
use octrace::{Camera, Light, Material, Part, PartId, Projection, Rgb, Scene, Solid, Vec3};
use octrace_read::Source;

mod whitted;

/// One scene to measure.
#[derive(Debug)]
pub struct BenchScene {
    /// A short name, or the file's.
    pub name: String,
    /// What is seen.
    pub scene: Scene,
    /// The file's text.
    pub source: Option<Source>,
}

/// A scene that comes with the program; made only when its turn has come.
struct BuiltIn {
    name: &'static str,
    family: Option<&'static str>,
    /// Whether `--quick` has it.
    quick: bool,
    scene: fn() -> Scene,
}

const fn alone(name: &'static str, scene: fn() -> Scene) -> BuiltIn {
    BuiltIn { name, family: None, quick: true, scene }
}

const fn of(family: &'static str, name: &'static str, quick: bool, scene: fn() -> Scene) -> BuiltIn {
    BuiltIn { name, family: Some(family), quick, scene }
}

/// In the order of the table.
const BUILT_IN: [BuiltIn; 13] = [
    alone("classic", classic),
    alone("plate", plate),
    of("menger", "menger-3", true, || menger(3)),
    of("menger", "menger-4", true, || menger(4)),
    of("swiss", "swiss-100", true, || swiss(100)),
    of("swiss", "swiss-1000", true, || swiss(1_000)),
    of("swiss", "swiss-10000", false, || swiss(10_000)),
    of("swiss", "swiss-100000", false, || swiss(100_000)),
    of("grid", "grid-100", true, || grid([5, 5, 4])),
    of("grid", "grid-1000", true, || grid([10, 10, 10])),
    of("grid", "grid-10000", false, || grid([25, 20, 20])),
    of("grid", "grid-100000", false, || grid([50, 50, 40])),
    alone("whitted", whitted::whitted),
];

/// The names of the scenes that are measured if nothing is said.
pub fn default_names(quick: bool) -> Vec<&'static str> {
    BUILT_IN.iter().filter(|scene| scene.quick || !quick).map(|scene| scene.name).collect()
}

/// The names of some scenes that come with the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneNames(pub Vec<&'static str>);

/// The names that a word stands for: that of a scene, or of a family.
pub fn select(word: &str) -> Result<SceneNames, String> {
    let is_meant = |scene: &&BuiltIn| scene.name == word || scene.family == Some(word);
    let names: Vec<&str> = BUILT_IN.iter().filter(is_meant).map(|scene| scene.name).collect();
    if names.is_empty() {
        let all = default_names(false).join(", ");
        return Err(format!("there is no scene {word:?}, only {all}, and the families menger, swiss, grid"));
    }
    Ok(SceneNames(names))
}

/// The scene of that name.
pub fn built_in(name: &str) -> Option<BenchScene> {
    let scene = BUILT_IN.iter().find(|scene| scene.name == name)?;
    Some(BenchScene { name: name.into(), scene: (scene.scene)(), source: None })
}

const RED: PartId = PartId(0);
const GREY: PartId = PartId(1);

/// What light does to a surface, but for the colour; the usual one here is dull with a soft highlight.
const USUAL: Material =
    Material { color: Rgb::WHITE, ka: 0.15, kd: 0.75, ks: 0.3, shininess: 40.0, kr: 0.0, kt: 0.0, ior: 1.0, tint: 0.0 };

fn part(material: Material, color: [f64; 3]) -> Part {
    let [r, g, b] = color;
    Part { material: Material { color: Rgb::new(r, g, b), ..material } }
}

/// A scene of red and grey parts, under a pale sky.
fn scene(solid: Solid, camera: Camera, lights: impl IntoIterator<Item = ([f64; 3], f64)>) -> Scene {
    Scene {
        parts: vec![part(USUAL, [0.8, 0.25, 0.2]), part(USUAL, [0.7; 3])],
        lights: lights.into_iter().map(|(at, intensity)| light(at, intensity)).collect(),
        camera: Some(camera),
        ambient: Some(Rgb::WHITE),
        background: Some(Rgb::new(0.55, 0.65, 0.8)),
        ..Scene::new(solid)
    }
}

fn light(at: [f64; 3], intensity: f64) -> Light {
    Light::Point { position: at.into(), intensity: Rgb::gray(intensity) }
}

/// A camera with this angle of view from the left to the right edge of a picture of 4 by 3.
fn camera(eye: [f64; 3], at: [f64; 3], across_deg: f64) -> Camera {
    let half = libm::atan(libm::tan((across_deg / 2.0).to_radians()) * 3.0 / 4.0);
    let projection = Projection::Perspective { fov_deg: 2.0 * half.to_degrees() };
    Camera { eye: eye.into(), at: at.into(), up: Vec3::Z, projection }
}

/// What is below a height.
fn floor(z: f64) -> Solid {
    Solid::half_space().scale([1.0, 1.0, -1.0]).translate([0.0, 0.0, z])
}

const NEAR_LIGHTS: [([f64; 3], f64); 2] = [([6.0, -8.0, 10.0], 0.7), ([-8.0, -5.0, 6.0], 0.35)];

fn classic() -> Scene {
    let solid = Solid::union([families::classic().part(RED), floor(-1.0).part(GREY)]);
    scene(solid, camera([3.2, -4.8, 3.4], [0.0, 0.0, -0.1], 36.0), NEAR_LIGHTS)
}

fn plate() -> Scene {
    let lights = [([40.0, -50.0, 60.0], 0.7), ([-50.0, -30.0, 40.0], 0.35)];
    scene(families::plate(20).part(RED), camera([18.0, -30.0, 26.0], [0.0, -1.0, 0.0], 50.0), lights)
}

fn menger(levels: u32) -> Scene {
    of_a_block(families::menger(levels))
}

fn swiss(n: u32) -> Scene {
    of_a_block(families::swiss(n))
}

/// What is left of a block about the origin, 2 wide.
fn of_a_block(solid: Solid) -> Scene {
    scene(solid.part(RED), camera([2.6, -3.8, 2.8], [0.0, 0.0, -0.1], 36.0), NEAR_LIGHTS)
}

fn grid(counts: [u32; 3]) -> Scene {
    let d = 3.0 * f64::from(counts.into_iter().max().unwrap_or(1));
    let lights = [([2.0 * d, -2.6 * d, 3.2 * d], 0.7), ([-2.6 * d, -1.6 * d, 2.0 * d], 0.35)];
    let camera = camera([d, -1.5 * d, 1.05 * d], [0.0, 0.0, -0.06 * d], 44.0);
    scene(families::grid(counts).part(RED), camera, lights)
}

#[cfg(test)]
mod tests;
