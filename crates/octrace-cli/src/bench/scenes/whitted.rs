//! Mirrors, glass, a lens and cut solids on a floor, under three lights.

use super::{USUAL, camera, floor, light, part};
use octrace::{Material, PartId, Rgb, Scene, Solid, Vec3};

/// The scene.
pub(super) fn whitted() -> Scene {
    let mirror = Material { ka: 0.02, kd: 0.1, ks: 0.6, shininess: 120.0, kr: 0.8, ..USUAL };
    // The share of diffuse light that a clear surface keeps, as POV-Ray has it: what does not pass.
    let glass = Material { ka: 0.0, kd: 0.02 * 0.12, ks: 0.7, shininess: 200.0, kr: 0.1, kt: 0.88, ior: 1.5, ..USUAL };
    let parts = vec![
        part(Material { ks: 0.0, ..USUAL }, [0.75, 0.7, 0.55]),
        part(mirror, [0.9, 0.9, 0.95]),
        part(glass, [0.95, 1.0, 0.97]),
        part(Material { kr: 0.1, ..USUAL }, [0.8, 0.2, 0.15]),
        part(Material { kr: 0.25, ..USUAL }, [0.2, 0.35, 0.8]),
    ];
    let [on_floor, of_mirror, of_glass, red, blue] = [0, 1, 2, 3, 4].map(PartId);
    let solids = [
        floor(0.0).part(on_floor),
        ball([-1.7, 1.6, 1.3], 1.3).part(of_mirror),
        ball([0.5, -1.0, 1.0], 1.0).part(of_glass),
        (ball([2.1, -3.3, 0.9], 1.4) & ball([2.1, -1.1, 0.9], 1.4)).part(of_glass),
        bowl().part(of_mirror),
        drilled().part(red),
        ring().part(blue),
    ];
    Scene {
        parts,
        lights: vec![light([5.0, -7.0, 9.0], 0.5), light([-7.0, -5.0, 7.0], 0.35), light([1.0, 3.0, 10.0], 0.3)],
        camera: Some(camera([0.8, -9.2, 3.6], [0.0, 0.2, 0.9], 42.0)),
        ambient: Some(Rgb::WHITE),
        background: Some(Rgb::new(0.55, 0.65, 0.8)),
        ..Scene::new(Solid::union(solids))
    }
}

/// A block with a hollow in its front, drilled through.
fn bowl() -> Solid {
    let block = block([1.1, 0.6, 0.0], [3.1, 2.6, 2.0]);
    Solid::difference([block, ball([2.1, 0.6, 1.2], 0.8), bar_along_y([2.1, 0.0, 1.0], 4.0, 0.35)])
}

/// Block and ball, drilled along all axes.
fn drilled() -> Solid {
    let rounded = block([-3.1, -2.1, 0.0], [-1.5, -0.5, 1.6]) & ball([-2.3, -1.3, 0.8], 1.05);
    let along_x = Solid::cylinder().scale([0.45, 0.45, 4.0]).rotate([0.0, 90.0, 0.0]).translate([-4.0, -1.3, 0.8]);
    let along_z = Solid::cylinder().scale([0.45, 0.45, 4.0]).translate([-2.3, -1.3, -1.0]);
    Solid::difference([rounded, along_x, bar_along_y([-2.3, -4.0, 0.8], 6.0, 0.45), along_z])
}

/// A thick tube that stands at the back.
fn ring() -> Solid {
    bar_along_y([-0.2, 3.4, 1.3], 0.6, 1.3) - bar_along_y([-0.2, 3.0, 1.3], 1.5, 0.9)
}

fn ball(center: [f64; 3], radius: f64) -> Solid {
    Solid::sphere().scale([radius; 3]).translate(center)
}

fn block(min: [f64; 3], max: [f64; 3]) -> Solid {
    let (min, max) = (Vec3::from(min), Vec3::from(max));
    Solid::block().scale(max - min).translate(min)
}

/// A cylinder from the middle of its front face backwards.
fn bar_along_y(front: [f64; 3], length: f64, radius: f64) -> Solid {
    Solid::cylinder().scale([radius, radius, length]).rotate([-90.0, 0.0, 0.0]).translate(front)
}
