use super::*;
use octrace::model::Node;
use octrace::{Affine, Primitive};

#[test]
fn words_are_names_or_families() {
    assert_eq!(select("classic"), Ok(SceneNames(vec!["classic"])));
    assert_eq!(select("menger"), Ok(SceneNames(vec!["menger-3", "menger-4"])));
    assert!(select("teapot").is_err() && select("").is_err());
    assert_eq!(default_names(false).len(), BUILT_IN.len());
    assert!(!default_names(true).contains(&"grid-100000"));
}

/// The race against other programs has a generator of its own (`bench/race`); what the two make is the same.
#[test]
fn the_race_is_run_on_the_same_scenes() {
    let digests = include_str!("../../../../../bench/race/digests.txt");
    assert_eq!(digests.lines().count(), 11);
    for line in digests.lines() {
        let (name, expected) = line.split_once(' ').expect("a name and a digest");
        let scene = built_in(name).unwrap_or_else(|| panic!("there is no scene {name}")).scene;
        let listing = listing(&scene);
        assert_eq!(digest(&listing), expected, "{name}:\n{}", listing.lines().take(40).collect::<Vec<_>>().join("\n"));
    }
}

/// FNV-1a, 64 bits, in hexadecimal.
fn digest(text: &str) -> String {
    let hash = text
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    format!("{hash:016x}")
}

/// The scene in words, as `bench/race/race/digest.py` writes it.
fn listing(scene: &Scene) -> String {
    let mut lines = Vec::new();
    let camera = scene.camera.expect("every scene names its camera");
    let Projection::Perspective { fov_deg } = camera.projection else { panic!("all cameras are perspective") };
    lines.push(words("camera", &[&camera.eye.to_array()[..], &camera.at.to_array(), &[fov_deg]].concat()));
    for light in &scene.lights {
        let Light::Point { position, intensity } = light else { panic!("all lights are lamps") };
        lines.push(words("light", &[&position.to_array()[..], &[intensity.r]].concat()));
    }
    let sky = scene.background.expect("every scene has a sky");
    lines.push(words("background", &[sky.r, sky.g, sky.b]));
    let mut pending = vec![(&scene.solid, Affine::IDENTITY)];
    while let Some((solid, map)) = pending.pop() {
        match solid.node() {
            Node::Empty => lines.push("empty".into()),
            Node::Transform(inner, child) => pending.push((child, map * *inner)),
            Node::Part(part, child) => {
                lines.push(of_material(&scene.material(Some(*part))));
                pending.push((child, map));
            }
            Node::Combine(op, children) => {
                lines.push(format!("{} {}", format!("{op:?}").to_lowercase(), children.len()));
                pending.extend(children.iter().rev().map(|child| (child, map)));
            }
            Node::Primitive(primitive) => lines.push(of_primitive(primitive, &map)),
        }
    }
    lines.join("\n") + "\n"
}

fn of_material(m: &Material) -> String {
    words("material", &[m.color.r, m.color.g, m.color.b, m.ka, m.kd, m.ks, m.shininess, m.kr, m.kt, m.ior])
}

fn of_primitive(primitive: &Primitive, map: &Affine) -> String {
    let radius = map.vector(Vec3::X).length();
    let ends = |a: Vec3, b: Vec3| {
        let (a, b) = (map.point(a).to_array(), map.point(b).to_array());
        let by_axis = |of: fn(f64, f64) -> f64| [0, 1, 2].map(|axis| of(a[axis], b[axis]));
        [by_axis(f64::min), by_axis(f64::max)].concat()
    };
    match primitive {
        Primitive::Block => words("box", &ends(Vec3::ZERO, Vec3::splat(1.0))),
        Primitive::Sphere => words("sphere", &[&map.translation.to_array()[..], &[radius]].concat()),
        Primitive::Cylinder => words("cylinder", &[ends(Vec3::ZERO, Vec3::Z), vec![radius]].concat()),
        Primitive::HalfSpace => words("below", &[map.translation.z]),
        other => panic!("no scene has {other:?}"),
    }
}

/// Nine decimals: what differs by rounding is the same. There is no -0.
fn words(name: &str, values: &[f64]) -> String {
    let number = |value: &f64| {
        let text = format!("{value:.9}");
        if text == "-0.000000000" { text[1..].to_owned() } else { text }
    };
    [name.to_owned()].into_iter().chain(values.iter().map(number)).collect::<Vec<_>>().join(" ")
}
