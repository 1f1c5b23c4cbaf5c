//! Every term of Whitted's model, by scenes of which the answer is known: one pixel, looked at straight from above unless
//! the test says otherwise.

use octrace::exec::Exec;
use octrace::film::{Background, RenderStats, View, render};
use octrace::{Camera, Light, Material, Part, PartId, Projection, Rgb, Scene, Solid, Tracer, TracerOptions, Vec3};

const RED: Rgb = Rgb::new(1.0, 0.0, 0.0);
const ORANGE: Rgb = Rgb::new(0.9, 0.5, 0.1);
const WHITE_LIGHT: Rgb = Rgb::gray(0.8);

/// A material without any coefficient.
const INERT: Material =
    Material { color: ORANGE, ka: 0.0, kd: 0.0, ks: 0.0, shininess: 1.0, kr: 0.0, kt: 0.0, ior: 1.0, tint: 1.0 };

/// Shines by ambient light alone, which is 1 in these scenes.
const RED_GLOW: Material = Material { color: RED, ka: 1.0, ..INERT };

/// What of a scene these tests choose.
struct Setup {
    solids: Vec<(Solid, Material)>,
    lights: Vec<Light>,
    background: Rgb,
    eye: Vec3,
    at: Vec3,
    max_bounces: u32,
}

impl Default for Setup {
    fn default() -> Self {
        // Without any light there would be default ones.
        let dark = Light::Directional { direction: -Vec3::Z, intensity: Rgb::BLACK };
        Self {
            solids: Vec::new(),
            lights: vec![dark],
            background: Rgb::BLACK,
            eye: Vec3::Z * 10.0,
            at: Vec3::ZERO,
            max_bounces: 8,
        }
    }
}

impl Setup {
    /// What the ray from the eye sees, and what it took.
    fn trace(self) -> (Rgb, RenderStats) {
        let parts = self.solids.iter().map(|&(_, material)| Part { material }).collect();
        let solids = self.solids.into_iter().zip(0..).map(|((solid, _), part)| solid.part(PartId(part)));
        let scene = Scene {
            parts,
            lights: self.lights,
            ambient: Some(Rgb::WHITE),
            background: Some(self.background),
            ..Scene::new(Solid::union(solids))
        };
        let exec = Exec::with_threads(1);
        let tracer = Tracer::build_bodies(&scene.bodies().solids, &TracerOptions::default(), &exec);
        let projection = Projection::Orthographic { height: 1e-9 };
        let view = View {
            camera: Camera { eye: self.eye, at: self.at, up: Vec3::Y, projection },
            width_px: 1,
            height_px: 1,
            samples: 1,
            max_bounces: self.max_bounces,
            background: Background::Scene,
        };
        let (film, stats) = render(&scene, &tracer.expect("nobody cancels"), &view, &exec).expect("nobody cancels");
        let [r, g, b, _] = film.pixels()[0].map(f64::from);
        (Rgb::new(r, g, b), stats)
    }

    #[track_caller]
    fn check(self, expected: Rgb) {
        let (seen, _) = self.trace();
        let off = [seen.r - expected.r, seen.g - expected.g, seen.b - expected.b];
        assert!(off.iter().all(|d| d.abs() < 1e-6), "{seen:?} instead of {expected:?}");
    }
}

/// Everything with z <= 0.
fn floor() -> Solid {
    Solid::half_space().scale([1.0, 1.0, -1.0])
}

/// A box from corner to corner.
fn slab(low: [f64; 3], high: [f64; 3]) -> Solid {
    Solid::block().scale(Vec3::from(high) - Vec3::from(low)).translate(low)
}

/// The floor under one light of 0.8, sixty degrees from the vertical; the direction's length shall not matter.
fn lit(material: Material) -> Setup {
    let direction = Vec3::new(3.0_f64.sqrt(), 0.0, -1.0) * 7.0;
    let lights = vec![Light::Directional { direction, intensity: WHITE_LIGHT }];
    Setup { solids: vec![(floor(), material)], lights, ..Setup::default() }
}

#[test]
fn ambient_light_takes_the_body_colour() {
    lit(Material { ka: 0.25, ..INERT }).check(ORANGE * 0.25);
}

#[test]
fn diffuse_light_goes_with_the_cosine() {
    lit(Material { kd: 0.5, ..INERT }).check(ORANGE * (0.5 * 0.8 * 0.5));
}

#[test]
fn highlights_take_the_lights_colour_and_go_with_a_power_of_the_cosine() {
    // The mirrored light leaves sixty degrees from the way to the eye.
    lit(Material { ks: 0.5, shininess: 1.0, ..INERT }).check(Rgb::gray(0.5 * 0.8 * 0.5));
    lit(Material { ks: 0.5, shininess: 3.0, ..INERT }).check(Rgb::gray(0.5 * 0.8 * 0.125));
}

#[test]
fn lights_add_up_and_those_behind_the_surface_do_not_count() {
    let mut setup = lit(Material { kd: 0.5, ..INERT });
    setup.lights.push(Light::Point { position: Vec3::Z * 3.0, intensity: WHITE_LIGHT });
    setup.lights.push(Light::Point { position: -Vec3::Z, intensity: WHITE_LIGHT });
    setup.check(ORANGE * (0.5 * 0.8 * 1.5));
}

#[test]
fn what_stands_between_casts_a_shadow_and_what_stands_behind_does_not() {
    let ball = || (Solid::sphere().translate([-3.0, 0.0, 3.0]), INERT);
    for (position, share) in [([-5.0, 0.0, 5.0], 0.0), ([-1.0, 0.0, 1.0], 0.5_f64.sqrt())] {
        let lights = vec![Light::Point { position: position.into(), intensity: Rgb::WHITE }];
        let solids = vec![(floor(), Material { kd: 1.0, ..INERT }), ball()];
        Setup { solids, lights, ..Setup::default() }.check(ORANGE * share);
    }
}

#[test]
fn glass_filters_light_at_both_of_its_surfaces() {
    let glass = Material { color: ORANGE, kt: 0.7, ior: 1.5, ..INERT };
    let pane = slab([-9.0, -1.0, 2.0], [-0.5, 1.0, 2.5]);
    let mut setup = lit(Material { kd: 1.0, color: Rgb::WHITE, ..INERT });
    setup.solids.push((pane, glass));
    setup.check(ORANGE * ORANGE * (0.7 * 0.7 * 0.8 * 0.5));
}

#[test]
fn mirrors_show_what_is_before_them_unless_bounces_are_used_up() {
    let blue = Rgb::new(0.1, 0.2, 0.8);
    for (max_bounces, share) in [(1, 0.75), (0, 0.0)] {
        let solids = vec![(floor(), Material { kr: 0.75, ..INERT })];
        Setup { solids, background: blue, max_bounces, ..Setup::default() }.check(blue * share);
    }
}

#[test]
fn between_mirrors_light_ends_with_the_bounces_or_with_its_share() {
    let between = |kr, max_bounces| {
        let mirror = Material { kr, ..INERT };
        let solids = vec![(floor(), mirror), (Solid::half_space().translate([0.0, 0.0, 20.0]), mirror)];
        Setup { solids, max_bounces, ..Setup::default() }.trace().1.rays.reflected
    };
    assert_eq!(between(1.0, 17), 17);
    // A thousandth is seen, a ten-thousandth is not.
    assert_eq!(between(0.1, 17), 3);
}

/// A pane shifts what is seen through it: at 45 degrees a ray leaves a pane of thickness 1 at tan(asin(sin 45 / 1.5)).
#[test]
fn a_pane_of_glass_shifts_what_is_behind_it() {
    let glass = Material { color: Rgb::WHITE, kt: 0.9, ior: 1.5, ..INERT };
    let shift = 0.5345224838248488;
    for (x, share) in [(shift + 1.0, 0.81), (2.0, 0.0)] {
        let target = slab([x - 0.05, -1.0, -2.1], [x + 0.05, 1.0, -2.0]);
        let pane = slab([-9.0, -9.0, -1.0], [9.0, 9.0, 0.0]);
        let solids = vec![(pane, glass), (target, RED_GLOW)];
        Setup { solids, eye: Vec3::new(-3.0, 0.0, 3.0), ..Setup::default() }.check(RED * share);
    }
}

/// From inside glass: straight up light leaves it; beyond the critical angle of 41.8 degrees all of it is mirrored.
#[test]
fn beyond_the_critical_angle_all_light_is_reflected() {
    let glass = Material { color: Rgb::WHITE, kr: 0.1, kt: 0.9, ior: 1.5, ..INERT };
    let blue = Rgb::new(0.0, 0.0, 1.0);
    for (eye, expected) in [([0.0, 0.0, -5.0], RED * 0.9 + blue * 0.1), ([-5.0, 0.0, -5.0], blue)] {
        let ceiling = slab([-99.0, -99.0, 5.0], [99.0, 99.0, 6.0]);
        let solids = vec![(floor(), glass), (ceiling, RED_GLOW)];
        Setup { solids, background: blue, eye: eye.into(), ..Setup::default() }.check(expected);
    }
}

/// A ball lens of radius 1, made by intersection, brings rays near its axis together 1.5 from its middle.
#[test]
fn a_lens_made_by_intersection_has_its_focus_where_it_should() {
    let glass = Material { color: Rgb::WHITE, kt: 1.0, ior: 1.5, ..INERT };
    let lens = Solid::sphere() & slab([-2.0; 3], [2.0; 3]);
    let target = slab([-1e-3, -1e-3, -1.6], [1e-3, 1e-3, -1.5]);
    for offset in [-0.02, 0.01, 0.02] {
        let solids = vec![(lens.clone(), glass), (target.clone(), RED_GLOW)];
        let (eye, at) = (Vec3::new(offset, 0.0, 10.0), Vec3::new(offset, 0.0, 0.0));
        Setup { solids, eye, at, ..Setup::default() }.check(RED);
    }
}
