//! The tree of rays of one pixel, as data, says what the picture says.

use octrace::exec::Exec;
use octrace::film::{Background, View, ray_tree, render};
use octrace::shade::{RayKind, TracedRay};
use octrace::{Camera, Light, Material, Part, PartId, Projection, Rgb, Scene, Solid, Tracer, TracerOptions, Vec3};

fn scene() -> (Scene, View) {
    let part = |material| Part { material };
    let parts = vec![
        part(Material::glass(Rgb::new(0.9, 1.0, 0.8))),
        part(Material::metal(Rgb::new(0.7, 0.5, 0.2))),
        part(Material::matte(Rgb::new(0.3, 0.4, 0.9))),
    ];
    let solid = Solid::union([
        Solid::sphere().part(PartId(0)),
        Solid::block().translate([-0.5, 2.0, -1.0]).part(PartId(1)),
        Solid::half_space().scale([1.0, 1.0, -1.0]).translate([0.0, 0.0, -1.0]).part(PartId(2)),
    ]);
    let lights = vec![
        Light::Point { position: Vec3::new(5.0, -6.0, 8.0), intensity: Rgb::gray(0.7) },
        Light::Point { position: Vec3::new(-7.0, 1.0, 5.0), intensity: Rgb::new(0.3, 0.2, 0.4) },
    ];
    let black = Some(Rgb::BLACK);
    let scene = Scene { parts, lights, ambient: black, ..Scene::new(solid) };
    let camera = Camera {
        eye: Vec3::new(0.3, -7.0, 1.0),
        at: Vec3::new(0.1, 0.0, 0.1),
        up: Vec3::Z,
        projection: Projection::Perspective { fov_deg: 25.0 },
    };
    let view = View { camera, width_px: 8, height_px: 6, samples: 1, max_bounces: 5, background: Background::Scene };
    (scene, view)
}

#[test]
fn what_rays_bring_adds_up_to_the_pixel() {
    let (scene, view) = scene();
    let exec = Exec::with_threads(1);
    let tracer =
        Tracer::build_bodies(&scene.bodies().solids, &TracerOptions::default(), &exec).expect("nobody cancels");
    let (film, stats) = render(&scene, &tracer, &view, &exec).expect("nobody cancels");
    let (mut counted, mut branched) = ([0; 4], 0);
    for (y, x) in (0..view.height_px).flat_map(|y| (0..view.width_px).map(move |x| (y, x))) {
        let rays = ray_tree(&scene, &tracer, &view, (x, y)).rays;
        let Rgb { r, g, b } = rays[0].light;
        assert_eq!(film.pixels()[(y * view.width_px + x) as usize][..3], [r, g, b].map(|v| v as f32));
        for (index, ray) in rays.iter().enumerate() {
            counted[match ray.kind {
                RayKind::Camera => 0,
                RayKind::Shadow { .. } => 1,
                RayKind::Reflected => 2,
                RayKind::Refracted => 3,
            }] += 1;
            assert_eq!(ray.parent.is_none(), index == 0);
            assert!(ray.parent.is_none_or(|parent| parent < index && rays[parent].hit.is_some()));
            let is_shadow = matches!(ray.kind, RayKind::Shadow { .. });
            if is_shadow || ray.hit.is_none() {
                continue;
            }
            // There is no ambient light, so all that comes along a ray came along those at its end.
            let children: Vec<&TracedRay> = rays.iter().filter(|child| child.parent == Some(index)).collect();
            branched += usize::from(children.len() > 2);
            let sum = children.iter().fold(Rgb::BLACK, |sum, child| sum + child.contribution());
            let whole = ray.contribution();
            let off = Rgb::new(sum.r - whole.r, sum.g - whole.g, sum.b - whole.b);
            assert!(off.r.abs().max(off.g.abs()).max(off.b.abs()) < 1e-14, "{ray:?}");
        }
    }
    let rays = stats.rays;
    assert_eq!(counted, [rays.camera, rays.shadow, rays.reflected, rays.refracted]);
    assert!(branched > 5, "the scene has real trees");
}
