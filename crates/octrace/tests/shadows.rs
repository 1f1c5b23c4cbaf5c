//! Rays that go on from surfaces start off them: far enough not to meet them again, near enough for what is tiny.

use octrace::exec::Exec;
use octrace::film::{Background, View, render};
use octrace::{
    Affine, Camera, Light, Material, Part, PartId, Primitive, Projection, Rgb, Scene, Solid, Tracer, TracerOptions,
    Vec3,
};

/// The brightness of the pixels of a square picture: matte and white, one light.
fn picture(solid: Solid, camera: Camera, light: Vec3, size_px: u32) -> Vec<f32> {
    let scene = Scene {
        parts: vec![Part { material: Material::matte(Rgb::WHITE) }],
        lights: vec![Light::Directional { direction: light, intensity: Rgb::WHITE }],
        ambient: Some(Rgb::BLACK),
        background: Some(Rgb::gray(-1.0)),
        ..Scene::new(solid.part(PartId(0)))
    };
    let exec = Exec::with_threads(1);
    let tracer =
        Tracer::build_bodies(&scene.bodies().solids, &TracerOptions::default(), &exec).expect("nobody cancels");
    let (width_px, height_px) = (size_px, size_px);
    let view = View { camera, width_px, height_px, samples: 1, max_bounces: 0, background: Background::Scene };
    let (film, stats) = render(&scene, &tracer, &view, &exec).expect("nobody cancels");
    assert_eq!(stats.counters.leaks, 0);
    film.pixels().iter().map(|pixel| pixel[0]).collect()
}

#[test]
fn tiny_things_cast_shadows_on_huge_ones() {
    // A pebble of a thousandth on a plate a million times as wide as it is itself, and a million times farther out.
    for (wide, far) in [(1.0, 0.0), (1e3, 0.0), (1e6, 0.0), (1e3, 1e3), (1.0, 1e4)] {
        let at = Vec3::new(far, -far, 0.0);
        let plate = Solid::block().scale([wide, wide, wide]).translate([-0.5 * wide, -0.5 * wide, -wide]);
        let pebble = Solid::sphere().scale([1e-3, 1e-3, 1e-3]).translate([0.0, 0.0, 1e-3]);
        // Looked at from above, two radii beside it: there is its shadow, light being aslant.
        let beside = at + Vec3::new(2e-3, 0.0, 0.0);
        let projection = Projection::Orthographic { height: 1e-4 };
        let camera = Camera { eye: beside + Vec3::Z, at: beside, up: Vec3::Y, projection };
        let seen = picture((plate | pebble).translate(at), camera, Vec3::new(2.0, 0.0, -1.0), 8);
        assert_eq!(seen, vec![0.0; 64], "{wide} {far}: in the pebble's shadow");
    }
}

#[test]
fn nothing_convex_casts_a_shadow_on_itself() {
    let mut state = 7_u64;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let convex = [Solid::sphere(), Solid::cylinder(), Solid::block(), Solid::primitive(Primitive::Cone { top: 0.25 })];
    let mut seen = 0;
    for (round, thin) in (0..48).zip([1.0, 1e-2, 1e-4, 1e-6].into_iter().cycle()) {
        let mut three = || Vec3::new(next(), next(), next());
        let (turn, shear, size) = (three() * 180.0, three(), libm::exp2(three().x * 20.0));
        let out = three() * size * [0.0, 1.0, 1e3, 1e6][round / 4 % 4];
        let sheared =
            Affine::from_rows([[1.0, shear.x, shear.y, 0.0], [0.0, 1.0, shear.z, 0.0], [0.0, 0.0, thin, 0.0]]);
        let map = Affine::translation(out) * Affine::rotation_deg(turn) * Affine::scale(Vec3::splat(size)) * sheared;
        for solid in &convex {
            let toward = three().normalized().unwrap_or(Vec3::X);
            let projection = Projection::Orthographic { height: 4.0 * size };
            let camera = Camera { eye: out - toward * (8.0 * size), at: out, up: Vec3::new(0.1, 0.2, 1.0), projection };
            let lit = picture(solid.clone().transform(map), camera, toward, 32);
            let dark = lit.iter().filter(|&&b| b == 0.0).count();
            assert_eq!(dark, 0, "round {round}, {thin} thin: {solid:?} shades itself, lit from the eye");
            seen += lit.iter().filter(|&&b| b > 0.0).count();
        }
    }
    assert!(seen > 5_000, "{seen} pixels: most solids are seen");
}
