use super::*;

/// The corners of a box, by the bits of their numbers, and its faces counter-clockwise from outside.
fn block(low: [f64; 3], high: [f64; 3]) -> (Vec<Vec3>, Vec<Vec<u32>>) {
    let at = |i: usize, axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
    let points = (0..8).map(|i| Vec3::new(at(i, 0), at(i, 1), at(i, 2))).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (points, faces.map(Vec::from).to_vec())
}

/// A straight prism of height 1 over a polygon, counter-clockwise from above.
fn prism(outline: &[[f64; 2]]) -> Polyhedron {
    let n = outline.len() as u32;
    let points = [0.0, 1.0].iter().flat_map(|&z| outline.iter().map(move |p| Vec3::new(p[0], p[1], z))).collect();
    let mut faces = vec![(0..n).rev().collect::<Vec<u32>>(), (n..2 * n).collect()];
    faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]));
    Polyhedron::new(points, faces).unwrap()
}

/// No edge may be left over: each is walked as often one way as the other.
fn assert_watertight(polyhedron: &Polyhedron) {
    let mut net = std::collections::BTreeMap::new();
    for t in polyhedron.triangles() {
        let [a, b, c] = t.corners;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *net.entry((from.min(to), from.max(to))).or_insert(0) += if from < to { 1 } else { -1 };
        }
    }
    assert!(net.values().all(|&n| n == 0), "{net:?}");
}

#[test]
fn a_block_is_convex_and_has_its_volume() {
    let (points, faces) = block([0.0; 3], [2.0, 3.0, 4.0]);
    let block = Polyhedron::new(points, faces.clone()).unwrap();
    assert_eq!(block.volume(), 24.0);
    assert_eq!(block.faces(), faces);
    assert_eq!(block.triangles().len(), 12);
    assert!(block.is_convex(0.0));
    assert_watertight(&block);
    let top = block.face_plane(1).unwrap();
    assert_eq!((top.normal, top.point.z), (Vec3::Z, 4.0));
}

#[test]
fn faces_that_all_look_inward_are_turned() {
    let (points, mut faces) = block([0.0; 3], [1.0; 3]);
    faces.iter_mut().for_each(|f| f.reverse());
    let block = Polyhedron::new(points, faces).unwrap();
    assert_eq!(block.volume(), 1.0);
    assert!(block.is_convex(0.0));
}

#[test]
fn single_faces_that_look_inward_are_turned() {
    for wrong in [vec![0], vec![1, 4], vec![0, 1, 2, 3, 4], vec![2, 3, 5]] {
        let (points, mut faces) = block([0.0; 3], [1.0; 3]);
        wrong.iter().for_each(|&f: &usize| faces[f].reverse());
        let block = Polyhedron::new(points, faces).unwrap();
        assert_eq!(block.volume(), 1.0, "{wrong:?}");
        assert!(block.is_convex(0.0));
    }
}

#[test]
fn points_repeated_for_every_face_are_merged() {
    let (points, faces) = block([-1.0, -1.0, -0.0], [1.0, 0.0, 1.0]);
    let repeated: Vec<Vec3> = faces.iter().flatten().map(|&i| points[i as usize]).collect();
    let numbered = (0..6).map(|f| (4 * f..4 * f + 4).collect()).collect();
    let block = Polyhedron::new(repeated, numbered).unwrap();
    assert_eq!(block.points().len(), 8);
    assert_eq!(block.volume(), 2.0);
}

#[test]
fn unused_points_go() {
    let (mut points, mut faces) = block([0.0; 3], [1.0; 3]);
    points.push(Vec3::splat(100.0));
    faces.push(vec![8, 8, 0]);
    assert_eq!(Polyhedron::new(points, faces).unwrap().points().len(), 8);
}

#[test]
fn an_open_edge_is_named_in_the_numbers_of_the_input() {
    let (mut points, mut faces) = block([0.0; 3], [1.0; 3]);
    points.insert(0, Vec3::splat(9.0));
    faces.iter_mut().flatten().for_each(|i| *i += 1);
    faces.remove(5);
    let error = Polyhedron::new(points, faces).unwrap_err();
    assert_eq!(error, PolyhedronError::Open { face: 0, from: 4, to: 2, count: 4 });
}

#[test]
fn unsound_input_is_refused() {
    let (points, faces) = block([0.0; 3], [1.0; 3]);
    let mut wild = faces.clone();
    wild[3][1] = 8;
    let error = Polyhedron::new(points.clone(), wild).unwrap_err();
    assert_eq!(error, PolyhedronError::NoSuchPoint { face: 3, index: 8, points: 8 });
    let mut infinite = points;
    infinite[2].y = f64::INFINITY;
    assert_eq!(Polyhedron::new(infinite, faces).unwrap_err(), PolyhedronError::NotFinite { index: 2 });
    assert_eq!(Polyhedron::new(vec![], vec![]).unwrap_err(), PolyhedronError::Flat);
}

#[test]
fn flat_things_are_refused() {
    let (points, faces) = block([0.0; 3], [1.0, 1.0, 0.0]);
    assert_eq!(Polyhedron::new(points, faces).unwrap_err(), PolyhedronError::Flat);
    let tilted = [[0.1, 0.2, 0.7], [0.9, 0.3, 0.4], [0.2, 0.8, 0.3]].map(Vec3::from).to_vec();
    assert_eq!(Polyhedron::new(tilted, vec![vec![0, 1, 2], vec![2, 1, 0]]).unwrap_err(), PolyhedronError::Flat);
}

#[test]
fn a_one_sided_surface_is_refused() {
    // The least triangulation of the projective plane, with points in general position: closed, but it has no inside.
    let faces =
        [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1], [1, 2, 4], [2, 3, 5], [3, 4, 1], [4, 5, 2], [5, 1, 3]];
    let points = (0..6).map(f64::from).map(|i| Vec3::new(i, i * i, i * i * i)).collect();
    let error = Polyhedron::new(points, faces.map(Vec::from).to_vec()).unwrap_err();
    assert!(matches!(error, PolyhedronError::Unorientable { .. }), "{error}");
}

#[test]
fn concave_faces_are_covered_exactly() {
    let ell = prism(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
    assert_eq!(ell.volume(), 3.0);
    assert!(!ell.is_convex(0.1));
    assert_watertight(&ell);
    let top: Vec<&Triangle> = ell.triangles().iter().filter(|t| t.face == 1).collect();
    assert_eq!(top.len(), 4);
}

#[test]
fn corners_in_straight_sides_leave_no_cracks() {
    let prism =
        prism(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.5, 2.0], [1.0, 2.0], [0.5, 2.0], [0.0, 2.0]]);
    assert_eq!(prism.volume(), 4.0);
    assert!(prism.is_convex(0.0));
    assert_watertight(&prism);
}

/// A kite, wide at b and d, whose corners there are at height 1.5 and the others at 1. Each half of it has an area of 2; cut
/// from b to d its mean height is 4/3, the other way 7/6. (At height 2 OpenSCAD may look at it from the side.)
#[test]
fn warped_quadrangles_are_cut_between_their_wide_angles() {
    let kite = [[0.0, 0.0, 1.0], [2.0, -1.0, 1.5], [4.0, 0.0, 1.0], [2.0, 1.0, 1.5]];
    let points = kite.map(|[x, y, _]| Vec3::new(x, y, 0.0)).into_iter().chain(kite.map(Vec3::from)).collect::<Vec<_>>();
    for first in 0..4 {
        let mut faces = vec![vec![3, 2, 1, 0], (0..4).map(|i| 4 + (first + i) % 4).collect()];
        faces.extend((0..4).map(|i| vec![i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i]));
        let volume = Polyhedron::new(points.clone(), faces).unwrap().volume();
        assert!((volume - 16.0 / 3.0).abs() < 1e-12, "{volume}");
    }
}

/// Corners on a circle, where both diagonals are Delaunay's: what OpenSCAD 2021.01 makes of a rectangle and of a trapezoid. Their
/// heights are 2 at the ends of its diagonal and 1 else; the other diagonal would give 4/3 of the area.
#[test]
fn ties_between_diagonals_are_decided_as_openscad_decides_them() {
    for (corners, area) in [
        ([[0.0, 0.0, 1.0], [3.0, 0.0, 2.0], [3.0, 2.0, 1.0], [0.0, 2.0, 2.0]], 6.0),
        ([[0.0, 0.0, 1.0], [4.0, 0.0, 2.0], [3.0, 2.0, 1.0], [1.0, 2.0, 2.0]], 6.0),
    ] {
        let floor = corners.map(|[x, y, _]| Vec3::new(x, y, 0.0));
        let points: Vec<Vec3> = floor.into_iter().chain(corners.map(Vec3::from)).collect();
        for first in 0..4 {
            let mut faces = vec![vec![3, 2, 1, 0], (0..4).map(|i| 4 + (first + i) % 4).collect()];
            faces.extend((0..4).map(|i| vec![i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i]));
            let volume = Polyhedron::new(points.clone(), faces).unwrap().volume();
            assert!((volume - area * 5.0 / 3.0).abs() < 1e-12, "{volume}");
        }
    }
}

#[test]
fn warped_faces_become_triangles() {
    let (mut points, faces) = block([0.0; 3], [1.0; 3]);
    points[7].z = 1.1;
    let warped = Polyhedron::new(points, faces).unwrap();
    assert_eq!(warped.faces().len(), 7, "the top; two sides remain planar");
    assert_eq!(warped.triangles().len(), 12);
    assert_watertight(&warped);
    let (mut points, faces) = block([0.0; 3], [1.0; 3]);
    points[7].z = 1.00001;
    assert_eq!(Polyhedron::new(points, faces).unwrap().faces().len(), 6, "within six digits");
}

#[test]
fn degenerate_faces_stay_only_where_they_close_the_surface() {
    // The bottom has an extra corner (8) in a side; a face without area (0, 1, 8) makes up for it.
    let (mut points, mut faces) = block([0.0; 3], [2.0, 1.0, 1.0]);
    points.push(Vec3::new(1.0, 0.0, 0.0));
    faces[0] = vec![0, 2, 3, 1, 8];
    faces.push(vec![0, 8, 1]);
    faces.push(vec![3, 3, 5, 5]);
    let block = Polyhedron::new(points, faces).unwrap();
    assert_eq!(block.faces().len(), 7);
    assert_eq!(block.face_plane(6), None);
    assert!(block.is_convex(0.0));
    assert_watertight(&block);
}

#[test]
fn two_shells_are_not_convex() {
    let (mut points, mut faces) = block([0.0; 3], [1.0; 3]);
    let (more, other) = block([3.0, 0.0, 0.0], [4.0, 1.0, 1.0]);
    points.extend(more);
    faces.extend(other.into_iter().map(|f| f.into_iter().map(|i| i + 8).collect()));
    let pair = Polyhedron::new(points, faces).unwrap();
    assert_eq!(pair.volume(), 2.0);
    assert!(!pair.is_convex(1e-3));
}

#[test]
fn a_fine_saddle_is_not_convex_though_each_edge_nearly_is() {
    // A drum with a waist: 400 rings, so that neighbouring faces are nearly coplanar everywhere.
    let (rings, sides) = (400_u32, 8_u32);
    let mut points = Vec::new();
    for ring in 0..=rings {
        let z = f64::from(ring) / f64::from(rings) - 0.5;
        for side in 0..sides {
            let (s, c) = crate::geom::sin_cos_deg(f64::from(side) * 45.0);
            points.push(Vec3::new(c, s, 0.0) * (1.0 + 0.5 * z * z) + Vec3::new(0.0, 0.0, z));
        }
    }
    let mut faces = vec![(0..sides).rev().collect::<Vec<u32>>(), (rings * sides..(rings + 1) * sides).collect()];
    for ring in 0..rings {
        let at = |r: u32, side: u32| (ring + r) * sides + side % sides;
        faces.extend((0..sides).map(|s| vec![at(0, s), at(0, s + 1), at(1, s + 1), at(1, s)]));
    }
    let drum = Polyhedron::new(points, faces).unwrap();
    assert!(!drum.is_convex(1e-4));
    assert!(drum.is_convex(0.5));
}

/// A prism of height 1 over a regular polygon.
fn column(sides: u32) -> Polyhedron {
    let corner = |i: u32| {
        let (sin, cos) = crate::geom::sin_cos_deg(360.0 * f64::from(i) / f64::from(sides));
        [cos, sin]
    };
    prism(&(0..sides).map(corner).collect::<Vec<_>>())
}

#[test]
fn columns_of_many_sides_are_round() {
    assert!([3, 40, 62, 64].iter().all(|&sides| !column(sides).is_round()));
    assert!([66, 200, 1200].iter().all(|&sides| column(sides).is_round()));
    assert!(column(200).is_convex(1e-12));
}
