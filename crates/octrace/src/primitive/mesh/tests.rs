use super::*;
use proptest::prelude::*;

/// A mesh with one surface for each face, and the planes of these.
fn place(polyhedron: &Polyhedron, map: &Affine) -> (Mesh, Vec<FacePlane>) {
    let mut planes = Vec::new();
    let mesh = Mesh::new(polyhedron, map, 1e-9, &mut |face| {
        planes.push(face.plane);
        SurfaceRef { surface: planes.len() as u32 - 1, flipped: false }
    });
    (mesh.unwrap(), planes)
}

fn plane_t(plane: &FacePlane, ray: &Ray) -> f64 {
    -plane.distance(ray.origin) / plane.normal.dot(ray.direction)
}

/// The surface of some of the cells of a lattice of 3x3x3 unit cubes: edges and corners touch in all ways.
fn cubes(filled: u32) -> Option<Polyhedron> {
    let is_filled = |cell: [i32; 3]| cell.iter().all(|c| (0..3).contains(c)) && filled >> number(cell) & 1 == 1;
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for cell in (0..27).map(|i| [i % 3, i / 3 % 3, i / 9]).filter(|&c| is_filled(c)) {
        for axis in 0..3 {
            for side in [0, 1] {
                let mut neighbour = cell;
                neighbour[axis] += 2 * side - 1;
                if is_filled(neighbour) {
                    continue;
                }
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut face: Vec<u32> = Vec::new();
                for (du, dv) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
                    let mut corner = cell;
                    corner[axis] += side;
                    corner[u] += du;
                    corner[v] += dv;
                    face.push(points.len() as u32);
                    points.push(Vec3::from(corner.map(f64::from)));
                }
                if side == 0 {
                    face.reverse();
                }
                faces.push(face);
            }
        }
    }
    Polyhedron::new(points, faces).ok()
}

fn number(cell: [i32; 3]) -> i32 {
    cell[0] + 3 * cell[1] + 9 * cell[2]
}

/// A star-shaped polyhedron: a globe, its corners moved in and out by the given radii.
fn star(radii: &[f64]) -> Polyhedron {
    let spherical = |u: u32, v: u32| {
        let (sv, cv) = crate::geom::sin_cos_deg(f64::from(v) * 30.0);
        let (su, cu) = crate::geom::sin_cos_deg(f64::from(u) * 45.0);
        let radius = if v == 0 || v == 6 { 2.0 } else { radii[(u % 8 + 8 * (v - 1)) as usize % radii.len()] };
        // All of a pole's copies are the same point.
        if v == 0 || v == 6 { Vec3::new(0.0, 0.0, cv) * radius } else { Vec3::new(sv * cu, sv * su, cv) * radius }
    };
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for v in 0..6 {
        for u in 0..8 {
            let first = points.len() as u32;
            points.extend([spherical(u, v), spherical(u, v + 1), spherical(u + 1, v + 1), spherical(u + 1, v)]);
            faces.push((first..first + 4).collect());
        }
    }
    Polyhedron::new(points, faces).unwrap()
}

fn lattice_ray() -> impl Strategy<Value = Ray> {
    let origin = prop::array::uniform3(-4..10_i32).prop_map(|o| o.map(|c| f64::from(c) / 2.0));
    let direction = prop::array::uniform3(-3..=3_i32).prop_filter("a direction", |d| *d != [0, 0, 0]);
    (origin, direction).prop_map(|(o, d)| Ray::new(o, d.map(f64::from)))
}

fn map() -> impl Strategy<Value = Affine> {
    prop::array::uniform9(-2.0..2.0_f64).prop_filter_map("an invertible map", |m| {
        let row = |i: usize| Vec3::new(m[3 * i], m[3 * i + 1], m[3 * i + 2]);
        let map = Affine::linear([row(0), row(1), row(2)]);
        (map.determinant().abs() > 0.1).then_some(map)
    })
}

fn assert_closed(crossings: &[Crossing]) -> Result<(), TestCaseError> {
    let winding: i32 = crossings.iter().map(|c| if c.entering { 1 } else { -1 }).sum();
    prop_assert_eq!(winding, 0, "{:?}", crossings);
    Ok(())
}

/// What the tree finds is what looking at every triangle finds.
fn assert_complete(mesh: &Mesh, ray: &Ray, crossings: &[Crossing]) -> Result<(), TestCaseError> {
    let line = Line::new(ray, mesh.farthest);
    let crossed = mesh.triangles.iter().filter(|triangle| line.crosses(mesh.corners(triangle)).is_some());
    let mut all: Vec<u32> = crossed.map(|triangle| triangle.number).collect();
    all.sort_unstable();
    let mut found: Vec<u32> = crossings.iter().map(|c| c.triangle).collect();
    found.sort_unstable();
    prop_assert_eq!(found, all);
    Ok(())
}

fn assert_alternating(toggles: &[Crossing]) -> Result<(), TestCaseError> {
    prop_assert!(toggles.iter().enumerate().all(|(i, c)| c.entering == (i % 2 == 0)), "{:?}", toggles);
    prop_assert!(toggles.windows(2).all(|w| w[0].t < w[1].t), "{:?}", toggles);
    prop_assert_eq!(toggles.len() % 2, 0);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    /// Through edges, corners and along faces: every line leaves as often as it enters, at parameters that are exact,
    /// and is inside where the cubes are.
    #[test]
    fn lattice_lines_see_the_cubes(filled in 1_u32..1 << 27, ray in lattice_ray()) {
        let Some(polyhedron) = cubes(filled) else { return Ok(()) };
        let (mesh, planes) = place(&polyhedron, &Affine::IDENTITY);
        let mut out = Vec::new();
        mesh.crossings(&ray, |s| plane_t(&planes[s as usize], &ray), &mut out);
        assert_closed(&out)?;
        assert_complete(&mesh, &ray, &out)?;
        mesh.toggles(&ray, |s| plane_t(&planes[s as usize], &ray), &mut out);
        assert_alternating(&out)?;

        let along_a_wall = (0..3).any(|i| ray.direction[i] == 0.0 && ray.origin[i].fract() == 0.0);
        let is_filled = |p: Vec3| {
            let cell = p.to_array().map(|c| c.floor() as i32);
            cell.iter().all(|c| (0..3).contains(c)) && filled >> number(cell) & 1 == 1
        };
        // Between neighbouring lattice planes, the state is that of the cell.
        let mut times: Vec<f64> = (0..3)
            .filter(|&i| ray.direction[i] != 0.0)
            .flat_map(|i| (-1..=4).map(move |n| (f64::from(n) - ray.origin[i]) / ray.direction[i]))
            .collect();
        times.sort_by(f64::total_cmp);
        for pair in times.windows(2).filter(|w| w[1] - w[0] > 1e-6 && !along_a_wall) {
            let middle = 0.5 * (pair[0] + pair[1]);
            let inside = out.iter().filter(|c| c.t < middle).count() % 2 == 1;
            prop_assert_eq!(inside, is_filled(ray.at(middle)), "t = {}", middle);
            prop_assert_eq!(mesh.contains(ray.at(middle)), inside, "t = {}", middle);
        }
    }

    /// A box that is not touched is inside or outside as a whole.
    #[test]
    fn untouched_boxes_are_uniform(
        filled in 1_u32..1 << 27, center in prop::array::uniform3(-0.5..3.5_f64), half in prop::array::uniform3(0.0..0.7_f64),
        samples in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64), 8),
    ) {
        let Some(polyhedron) = cubes(filled) else { return Ok(()) };
        let (mesh, _) = place(&polyhedron, &Affine::IDENTITY);
        let (center, half) = (Vec3::from(center), Vec3::from(half));
        let touched = mesh.touches_box(center, half);
        let by_scan = mesh.triangles.iter().any(|t| {
            let reach = half + Vec3::splat(2.0 * mesh.slack);
            overlap::triangle_reaches_box(t.corners.map(|i| mesh.points[i as usize]), center, reach)
        });
        prop_assert_eq!(touched, by_scan);
        if !touched {
            let inside = mesh.contains(center);
            for s in samples {
                prop_assert_eq!(mesh.contains(center + half * Vec3::from(s)), inside);
            }
        }
    }

    /// Any map, mirroring or not: closed, complete, and the state between two crossings is what `contains` says.
    #[test]
    fn moved_stars_are_closed(
        radii in prop::collection::vec(0.5..2.0_f64, 40), map in map(),
        from in prop::array::uniform3(-3.0..3.0_f64), vertex in 0..500_usize, aim in any::<bool>(),
    ) {
        let (mesh, planes) = place(&star(&radii), &map);
        // Half of the rays are aimed at a vertex, which then is hit up to rounding.
        let origin = Vec3::from(from);
        let target = if aim { mesh.points[vertex % mesh.points.len()] } else { Vec3::new(from[1], from[2], -from[0]) * 0.3 };
        let Some(ray) = Ray::checked(origin, target - origin) else { return Ok(()) };
        let mut out = Vec::new();
        mesh.crossings(&ray, |s| plane_t(&planes[s as usize], &ray), &mut out);
        assert_closed(&out)?;
        assert_complete(&mesh, &ray, &out)?;
        mesh.toggles(&ray, |s| plane_t(&planes[s as usize], &ray), &mut out);
        assert_alternating(&out)?;
        for pair in out.windows(2).filter(|w| w[1].t - w[0].t > 1e-6) {
            let middle = ray.at(0.5 * (pair[0].t + pair[1].t));
            // A line that grazes a triangle may be as near to it as rounding.
            if !mesh.touches_box(middle, Vec3::splat(1e-9)) {
                prop_assert_eq!(mesh.contains(middle), pair[0].entering);
            }
        }
    }

    /// Planes that do not meet the ray where the triangle is, or at all, do no harm beyond the triangle.
    #[test]
    fn crossings_stay_within_their_triangles(filled in 1_u32..1 << 27, ray in lattice_ray(), wild in prop::sample::select(
        vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e9, -1e9, 0.0])) {
        let Some(polyhedron) = cubes(filled) else { return Ok(()) };
        let (mesh, _) = place(&polyhedron, &Affine::IDENTITY);
        let mut out = Vec::new();
        mesh.crossings(&ray, |_| wild, &mut out);
        assert_closed(&out)?;
        let slack = mesh.slack + 1e-12 * (1.0 + ray.origin.max_abs());
        for crossing in out {
            let triangle = mesh.triangles.iter().find(|triangle| triangle.number == crossing.triangle).unwrap();
            let corners = mesh.corners(triangle);
            let (bounds, p) = (Bounds::around(corners), ray.at(crossing.t));
            for axis in 0..3 {
                prop_assert!(bounds.min[axis] - slack <= p[axis] && p[axis] <= bounds.max[axis] + slack);
            }
        }
    }
}

#[test]
fn a_line_through_opposite_corners_of_a_cube_enters_and_leaves_once() {
    let (mesh, planes) = place(&cubes(1).unwrap(), &Affine::IDENTITY);
    let ray = Ray::new([-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]);
    let mut out = Vec::new();
    mesh.toggles(&ray, |s| plane_t(&planes[s as usize], &ray), &mut out);
    assert_eq!(out.iter().map(|c| c.t).collect::<Vec<_>>(), [1.0, 2.0]);
}

#[test]
fn mirrored_solids_are_not_inside_out() {
    let mirror = Affine::scale(Vec3::new(-1.0, 1.0, 1.0));
    let (mesh, planes) = place(&cubes(1).unwrap(), &mirror);
    assert!(mesh.contains(Vec3::new(-0.5, 0.5, 0.5)));
    assert!(!mesh.contains(Vec3::new(0.5, 0.5, 0.5)));
    assert!(planes.iter().all(|p| p.distance(Vec3::new(-0.5, 0.5, 0.5)) < 0.0), "normals look outward");
}

#[test]
fn faces_without_area_take_their_surface_from_a_neighbour() {
    let mut points: Vec<Vec3> =
        (0..8).map(|i| Vec3::new(f64::from(i & 1) * 2.0, f64::from(i >> 1 & 1), f64::from(i >> 2))).collect();
    points.push(Vec3::new(1.0, 0.0, 0.0));
    let faces = [
        vec![0, 8, 1],
        vec![0, 2, 3, 1, 8],
        vec![4, 5, 7, 6],
        vec![0, 1, 5, 4],
        vec![2, 6, 7, 3],
        vec![0, 4, 6, 2],
        vec![1, 3, 7, 5],
    ];
    let polyhedron = Polyhedron::new(points, faces.to_vec()).unwrap();
    let (mesh, planes) = place(&polyhedron, &Affine::IDENTITY);
    assert_eq!(planes.len(), 6);
    let adopted = mesh.surface(0).surface as usize;
    assert!([0, 2].contains(&adopted), "one of the two faces at that edge, not {adopted}");
}

/// The triangle that stands for a toggle is found again from its place alone.
#[test]
fn toggles_are_found_again_by_their_parameter() {
    let radii: Vec<f64> = (0..40).map(|i| 1.0 + 0.1 * f64::from(i * 7 % 10)).collect();
    let map = Affine::linear([Vec3::new(1.0, 0.2, 0.0), Vec3::new(0.0, -1.5, 0.3), Vec3::new(0.1, 0.0, 0.7)]);
    let (cubes, star) = (cubes(0x2a5_71e3).unwrap(), star(&radii));
    let mut found = 0;
    for (polyhedron, map) in [(&cubes, Affine::IDENTITY), (&star, map)] {
        let (mesh, planes) = place(polyhedron, &map);
        let mut out = Vec::new();
        for i in 0..2000 {
            let f = |k: i32| f64::from((i * k) % 41 - 20) / 8.0;
            let Some(ray) = Ray::checked([f(3), f(7), f(11)].into(), [f(13), f(17), f(19)].into()) else { continue };
            let surface_t = |s: u32| plane_t(&planes[s as usize], &ray);
            mesh.toggles(&ray, surface_t, &mut out);
            for toggle in &out {
                assert_eq!(mesh.triangle_at(&ray, surface_t, toggle.t, toggle.entering), Some(toggle.triangle));
                found += 1;
            }
        }
    }
    assert!(found > 1000, "{found}");
}

/// A globe of so many rings, each twice as many segments long; corners are repeated for every face.
fn globe(rings: u32) -> Polyhedron {
    let point = |u: u32, v: u32| {
        let (sv, cv) = crate::geom::sin_cos_deg(f64::from(v) * 180.0 / f64::from(rings));
        let (su, cu) = crate::geom::sin_cos_deg(f64::from(u % (2 * rings)) * 180.0 / f64::from(rings));
        if v == 0 || v == rings { Vec3::Z * cv } else { Vec3::new(sv * cu, sv * su, cv) }
    };
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for (u, v) in (0..2 * rings).flat_map(|u| (0..rings).map(move |v| (u, v))) {
        let first = points.len() as u32;
        points.extend([point(u, v), point(u, v + 1), point(u + 1, v + 1), point(u + 1, v)]);
        faces.push((first..first + 4).collect());
    }
    Polyhedron::new(points, faces).unwrap()
}

/// How much a line looks at tells without a clock how long it takes: a few boxes for each level of the tree, a few triangles.
#[test]
fn lines_look_at_little_of_a_mesh() {
    let (mesh, _) = place(&globe(70), &Affine::IDENTITY);
    assert_eq!(mesh.triangle_count(), 2 * 70 * (2 * 70 - 2));
    let (mut boxes, mut triangles, mut lines) = (0, 0, 0);
    for (y, z) in (0..40).flat_map(|y| (0..40).map(move |z| (f64::from(y), f64::from(z)))) {
        let ray = Ray::new([-3.0, y / 20.0 - 0.97, z / 20.0 - 0.97], [1.0, 0.013, 0.021]);
        let line = Line::new(&ray, mesh.farthest);
        let enter = |bounds: &Bounds| {
            boxes += 1;
            line.may_touch(bounds)
        };
        let _ = mesh.tree.visit::<()>(enter, |_| {
            triangles += 1;
            ControlFlow::Continue(())
        });
        lines += 1;
    }
    let (boxes, triangles) = (f64::from(boxes) / f64::from(lines), f64::from(triangles) / f64::from(lines));
    assert!(boxes < 90.0 && triangles < 16.0, "{boxes} boxes and {triangles} triangles");
}
