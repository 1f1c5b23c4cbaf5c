//! Tori: roots lie on the surface, sides are right between them, and cells are classified conservatively.

mod common;

use common::cases;
use octrace::surface::{CellBox, Side, Torus, TorusKind};
use octrace::{Affine, Ray, Vec3};
use proptest::prelude::*;

/// How far a point in the torus' coordinates lies outside the tube, or the inner surface; negative inside. The definition
/// itself.
fn outside_by(kind: TorusKind, minor: f64, p: Vec3) -> f64 {
    let ring = if kind == TorusKind::Outer { 1.0 } else { -1.0 };
    libm::hypot(libm::hypot(p.x, p.y) - ring, p.z) - minor
}

fn kind() -> impl Strategy<Value = TorusKind> {
    prop_oneof![2 => Just(TorusKind::Outer), 1 => Just(TorusKind::Inner)]
}

fn minor() -> impl Strategy<Value = f64> {
    prop_oneof![
        2 => prop_oneof![Just(0.25), Just(0.5), Just(1.0), Just(1.25), Just(2.0)],
        1 => 0.01..2.0,
        1 => Just(1e-4),
        1 => Just(0.999_999),
        1 => Just(1.000_001),
        1 => Just(50.0),
    ]
}

fn unit_cube() -> impl Strategy<Value = Vec3> {
    (-1.0..1.0, -1.0..1.0, -1.0..1.0).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

fn direction() -> impl Strategy<Value = Vec3> {
    let small = || prop_oneof![Just(-1.0), Just(0.0), Just(1.0)];
    let direction = prop_oneof![
        2 => unit_cube(),
        1 => (small(), small(), small()).prop_map(|(x, y, z)| Vec3::new(x, y, z)),
        1 => (unit_cube(), -9..-2).prop_map(|(d, e)| Vec3::new(d.x, d.y, d.z * libm::exp10(f64::from(e)))),
    ];
    direction.prop_filter("a direction", |d| d.length() > 1e-3)
}

/// A line through a point on or near the surface, in many cases tangent to it.
fn line(kind: TorusKind, minor: f64) -> impl Strategy<Value = (Vec3, Vec3)> {
    let angle = || prop_oneof![(0..24).prop_map(|i| f64::from(i) * 15.0), 0.0..360.0];
    let off = prop_oneof![Just(0.0), Just(1e-15), Just(-1e-12), Just(1e-9), Just(-1e-5), -1.0..1.0];
    (angle(), angle(), off, direction(), any::<bool>()).prop_map(move |(around, tube, off, direction, tangent)| {
        let turn = Affine::rotation_deg(Vec3::Z * around);
        let (sin, cos) = octrace::geom::sin_cos_deg(tube);
        let normal = turn.vector(Vec3::new(cos, 0.0, sin));
        let ring = if kind == TorusKind::Outer { 1.0 } else { -1.0 };
        let through = turn.vector(Vec3::X * ring) + normal * (minor * (1.0 + off));
        let along = direction - normal * normal.dot(direction);
        let along = if tangent && along.length() > 1e-3 { along } else { direction };
        (through, along)
    })
}

fn torus_and_line() -> impl Strategy<Value = (TorusKind, f64, Vec3, Vec3)> {
    let back = prop_oneof![Just(0.0), Just(1.0), Just(64.0), Just(1000.0), -64.0..64.0];
    (kind(), minor()).prop_flat_map(move |(kind, minor)| {
        (line(kind, minor), back.clone()).prop_map(move |((through, along), back)| {
            let back = back * (1.0 + minor) / along.length();
            (kind, minor, through - along * back, along)
        })
    })
}

fn placement() -> impl Strategy<Value = Affine> {
    let scale =
        prop_oneof![Just(Vec3::splat(1.0)), (0.2..5.0, 0.2..5.0, -5.0..-0.2).prop_map(|(x, y, z)| Vec3::new(x, y, z))];
    let shear =
        (-1.0..1.0).prop_map(|s| Affine::from_rows([[1.0, s, 0.0, 0.0], [0.0, 1.0, -s, 0.0], [0.0, 0.0, 1.0, 0.0]]));
    (scale, unit_cube(), unit_cube(), shear, any::<bool>()).prop_map(|(scale, turn, shift, shear, plain)| {
        if plain {
            return Affine::IDENTITY;
        }
        Affine::translation(shift * 3.0) * shear * Affine::rotation_deg(turn * 180.0) * Affine::scale(scale)
    })
}

proptest! {
    #![proptest_config(cases(10_000))]

    /// Every root is on the surface, and between roots the line is on the side that they say.
    #[test]
    fn roots_are_on_the_surface_and_complete((kind, minor, origin, along) in torus_and_line(), map in placement()) {
        let to_local = map.inverse().expect("placements are invertible");
        let torus = Torus { kind, minor, to_local };
        let ray = Ray::new(map.point(origin), map.vector(along));
        let crossings = torus.crossings(&ray);
        let params = crossings.params();
        prop_assert!(!crossings.starts_inside() && params.len().is_multiple_of(2));
        prop_assert!(params.is_sorted());

        // Placements stretch and shrink by less than 50 together.
        let plain = if map == Affine::IDENTITY { 1.0 } else { 50.0 };
        let bound = plain * (1e-12 * (1.0 + minor) + 1e-13 * origin.length());
        for &t in params {
            let off = outside_by(kind, minor, to_local.point(ray.at(t)));
            prop_assert!(off.abs() <= bound, "root at {} is off by {:e}, more than {:e}", t, off, bound);
        }
        // Samples all along the torus, and some next to every root.
        let length = along.length();
        let t_near = -origin.dot(along) / (length * length);
        let even = (-40..=40).map(|i| t_near + f64::from(i) / 40.0 * (1.0 + minor) / length);
        let close = params.iter().flat_map(|&t| [-1e-3, -1e-6, 1e-6, 1e-3].map(|d| t + d * minor / length));
        for t in even.chain(close) {
            let inside = params.iter().filter(|&&p| p <= t).count() % 2 == 1;
            let off = outside_by(kind, minor, to_local.point(ray.at(t)));
            if off.abs() > bound {
                prop_assert_eq!(off < 0.0, inside, "at {}, {:e} off, roots {:?}", t, off, params);
            }
        }
    }

    /// A cell said to be outside or inside has no point that is not.
    #[test]
    fn classification_is_conservative(
        (kind, minor, (through, _)) in (kind(), minor()).prop_flat_map(|(kind, minor)| (Just(kind), Just(minor), line(kind, minor))),
        map in placement(), beside in unit_cube(), half in 1e-3..1.0,
        samples in prop::collection::vec(unit_cube(), 20),
    ) {
        let torus = Torus { kind, minor, to_local: map.inverse().expect("placements are invertible") };
        let half = half * minor.min(2.0);
        let cell = CellBox::new(map.point(through) + beside * (2.0 * half), Vec3::splat(half));
        let side = torus.classify(&cell);
        let steps = || [-1.0, -0.5, 0.0, 0.5, 1.0].into_iter();
        let grid = steps().flat_map(|x| steps().flat_map(move |y| steps().map(move |z| Vec3::new(x, y, z))));
        for u in grid.chain(samples) {
            let p = cell.center + u * half;
            let off = outside_by(kind, minor, torus.to_local.point(p));
            prop_assert!(side != Side::Outside || off >= -1e-12, "{:?} is inside by {:e}", p, -off);
            prop_assert!(side != Side::Inside || off <= 1e-12, "{:?} is outside by {:e}", p, off);
        }
    }
}

/// Classification that is too cautious would cost octree cells: of small cells off the surface, next to none may be.
#[test]
fn small_cells_off_the_surface_are_told() {
    let torus = Torus { kind: TorusKind::Outer, minor: 0.5, to_local: Affine::IDENTITY };
    let (half, reach) = (0.02, 2.0);
    let steps = (reach / half) as i32;
    let (mut crossing, mut surface) = (0, 0);
    for x in -steps..steps {
        for z in -steps..steps {
            let center = Vec3::new((f64::from(x) + 0.5) * half, 0.3, (f64::from(z) + 0.5) * half);
            crossing += u32::from(torus.classify(&CellBox::new(center, Vec3::splat(half / 2.0))) == Side::Crossing);
            let corners = (0..8).map(|i| {
                let side = |bit: i32| if i & bit == 0 { -half / 2.0 } else { half / 2.0 };
                outside_by(TorusKind::Outer, 0.5, center + Vec3::new(side(1), side(2), side(4)))
            });
            let signs: Vec<bool> = corners.map(|off| off < 0.0).collect();
            surface += u32::from(signs.iter().any(|&s| s != signs[0]));
        }
    }
    assert!(surface <= crossing && crossing <= surface + surface / 20, "{crossing} cells for {surface}");
}
