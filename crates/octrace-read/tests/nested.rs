//! Random models of shapes made of shapes (hulls, sums, offsets, extrusions, booleans), all of small integers, so that they
//! touch and coincide: every way to trace them makes the same picture, and what is measured is what points say.

use octrace::exec::Exec;
use octrace::film::{Background, Film, View, render};
use octrace::model::frame_all;
use octrace::query::{MeasureOptions, measure};
use octrace::trace::Scratch;
use octrace::traverse::TraversalKind;
use octrace::{Accel, Projection, Scene, Solid, Tracer, TracerOptions, Vec3};
use octrace_read::{ReadOptions, Source, read_scene};
use proptest::prelude::*;

const SMOOTH: &str = "$fn = 0, $fa = 12, $fs = 2";

fn block(head: &str, children: &[String]) -> String {
    format!("{head} {{\n{}}}\n", children.concat())
}

fn moved(x: i32, y: i32, z: i32, turn: usize, child: &str) -> String {
    let rows = [
        [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        [[0, -1, 0], [1, 0, 0], [0, 0, 1]],
        [[-1, 0, 0], [0, 1, 0], [0, 0, 1]],
        [[1, 0, 0], [0, 0, -1], [0, 1, 0]],
    ][turn];
    let row = |i: usize, at: i32| format!("[{}, {}, {}, {at}]", rows[i][0], rows[i][1], rows[i][2]);
    format!("multmatrix([{}, {}, {}, [0, 0, 0, 1]]) {{\n{child}}}\n", row(0, x), row(1, y), row(2, z))
}

fn facets() -> impl Strategy<Value = String> {
    prop_oneof![3 => Just(0), 1 => Just(4), 1 => Just(6), 1 => Just(5)]
        .prop_map(|n| format!("$fn = {n}, $fa = 12, $fs = 2"))
}

fn flat() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        (1..=4, 1..=4).prop_map(|(x, y)| format!("square(size = [{x}, {y}], center = false);\n")),
        (1..=3, facets()).prop_map(|(r, facets)| format!("circle({facets}, r = {r});\n")),
        (1..=4, 1..=4, 0..=2).prop_map(|(x, y, z)| {
            format!("polygon(points = [[0, 0], [{x}, {z}], [1, {y}]], paths = undef, convexity = 1);\n")
        }),
    ];
    leaf.prop_recursive(2, 6, 3, |inner| {
        let several = prop::collection::vec(inner.clone(), 2..4);
        prop_oneof![
            (several, 0..5_usize).prop_map(|(all, how)| {
                let heads = ["union()", "difference()", "intersection()", "hull()", "minkowski(convexity = 0)"];
                block(heads[how], &all)
            }),
            (inner.clone(), -2..=2, -2..=2, 0..3_usize).prop_map(|(one, x, y, turn)| moved(x, y, 0, turn, &one)),
            (inner, -1..=2, any::<bool>()).prop_map(|(one, by, round)| match round {
                true => format!("offset(r = {by}, {SMOOTH}) {{\n{one}}}\n"),
                false => format!("offset(delta = {by}, chamfer = false, {SMOOTH}) {{\n{one}}}\n"),
            }),
        ]
    })
}

fn straight() -> impl Strategy<Value = String> {
    prop_oneof![
        (1..=4, 1..=4, 1..=4).prop_map(|(x, y, z)| format!("cube(size = [{x}, {y}, {z}], center = false);\n")),
        (flat(), 1..=4, 0..4_usize).prop_map(|(flat, height, how)| {
            let more = ["", "", "scale = [0, 0], ", "scale = [0.5, 0.5], "][how];
            format!("linear_extrude(height = {height}, center = false, convexity = 1, {more}{SMOOTH}) {{\n{flat}}}\n")
        }),
    ]
}

fn model() -> impl Strategy<Value = String> {
    // Of round things sums are meshes, which take their time.
    let sum = (straight(), 1..=2, any::<bool>()).prop_map(|(one, r, round)| {
        let tool = match round {
            true => format!("sphere({SMOOTH}, r = {r});\n"),
            false => format!("cube(size = [{r}, 1, 1], center = true);\n"),
        };
        block("minkowski(convexity = 0)", &[one, tool])
    });
    let leaf = prop_oneof![
        4 => straight(),
        1 => sum,
        2 => (1..=3, facets()).prop_map(|(r, facets)| format!("sphere({facets}, r = {r});\n")),
        2 => (1..=4, 0..=3, 1..=3, facets()).prop_map(|(h, r1, r2, facets)| {
            format!("cylinder({facets}, h = {h}, r1 = {r1}, r2 = {r2}, center = false);\n")
        }),
        2 => (flat(), 0..3_i32).prop_map(|(flat, out)| {
            let half = "square(size = [20, 40], center = false);\n".to_owned();
            let right = block("intersection()", &[moved(out, 0, 0, 0, &flat), moved(0, -20, 0, 0, &half)]);
            format!("rotate_extrude(angle = 360, convexity = 2, {SMOOTH}) {{\n{right}}}\n")
        }),
    ];
    leaf.prop_recursive(3, 8, 3, |inner| {
        let several = prop::collection::vec(inner.clone(), 2..4);
        prop_oneof![
            3 => (several, 0..4_usize).prop_map(|(all, how)| {
                block(["union()", "difference()", "intersection()", "hull()"][how], &all)
            }),
            2 => (inner, -2..=2, -2..=2, -2..=2, 0..4_usize).prop_map(|(one, x, y, z, turn)| moved(x, y, z, turn, &one)),
        ]
    })
}

/// So many cases, unless `PROPTEST_CASES` asks for another number.
fn cases(usual: u32) -> ProptestConfig {
    match std::env::var_os("PROPTEST_CASES") {
        Some(_) => ProptestConfig { failure_persistence: None, ..ProptestConfig::default() },
        None => ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(usual) },
    }
}

fn scene_of(text: &str) -> Option<Scene> {
    Some(read_scene(&Source::new("model.csg", text.as_bytes()), &ReadOptions::default()).value?.scene)
}

fn tracer(solids: &[Solid], snap: f64, accel: Accel, traversal: TraversalKind) -> Tracer {
    let options = TracerOptions { accel, traversal, snap, ..TracerOptions::default() };
    Tracer::build_bodies(solids, &options, &Exec::with_threads(1)).expect("nobody cancels")
}

fn picture(scene: &Scene, tracer: &Tracer, direction: usize) -> Film {
    let towards = [Vec3::new(-1.0, -2.0, -1.5), Vec3::Z, Vec3::new(0.0, 1.0, 0.0)][direction];
    let mut camera = frame_all(&tracer.bounds(), None, Projection::Perspective { fov_deg: 22.5 }, (64, 48));
    let far = (camera.at - camera.eye).length() / towards.length();
    (camera.eye, camera.up) = (camera.at - towards * far, if direction == 1 { Vec3::Y } else { Vec3::Z });
    let view = View { camera, width_px: 64, height_px: 48, samples: 1, max_bounces: 1, background: Background::Scene };
    render(scene, tracer, &view, &Exec::with_threads(1)).expect("nobody cancels").0
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn every_way_to_trace_makes_the_same_picture(text in model(), direction in 0..3_usize) {
        let Some(scene) = scene_of(&text) else { return Err(TestCaseError::reject("not read")) };
        let bodies = scene.bodies().solids;
        let plain = tracer(&bodies, scene.snap, Accel::None, TraversalKind::default());
        if plain.bounds().is_empty() {
            return Ok(());
        }
        let expected = picture(&scene, &plain, direction);
        for kind in [TraversalKind::default(), TraversalKind::Glassner] {
            let fast = tracer(&bodies, scene.snap, Accel::Octree, kind);
            prop_assert!(picture(&scene, &fast, direction) == expected, "{} of\n{}", kind, text);
        }
    }

    #[test]
    fn volumes_are_what_points_say(text in model(), seed in any::<u64>()) {
        let Some(scene) = scene_of(&text) else { return Err(TestCaseError::reject("not read")) };
        let tracer = tracer(std::slice::from_ref(&scene.solid), scene.snap, Accel::Octree, TraversalKind::default());
        let options = MeasureOptions { tolerance: 3e-3, ..MeasureOptions::default() };
        let measures = measure(&tracer, &options, &Exec::with_threads(1)).expect("a bounded solid");
        let (bounds, size) = (tracer.bounds(), tracer.bounds().size());
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        const POINTS: u32 = 4000;
        let mut inside = 0;
        for _ in 0..POINTS {
            let p = bounds.min + Vec3::new(size.x * random(), size.y * random(), size.z * random());
            inside += u32::from(tracer.body_contains(0, p, &mut Scratch::default()));
        }
        let all = if bounds.is_empty() { 0.0 } else { size.x * size.y * size.z };
        let share = f64::from(inside) / f64::from(POINTS);
        // Six standard deviations, and what one point counts.
        let off = 6.0 * (share * (1.0 - share) / f64::from(POINTS)).sqrt() + 6.0 / f64::from(POINTS);
        let (found, expected) = (measures.volume, share * all);
        prop_assert!((found - expected).abs() <= off * all + measures.volume_error, "{found} {expected}\n{text}");
    }
}
