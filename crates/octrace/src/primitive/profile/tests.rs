use super::*;

fn line(x: f64, y: f64) -> Edge {
    Edge { from: Vec2::new(x, y), curve: Curve::Line }
}

fn arc(from: [f64; 2], center: [f64; 2], ccw: bool) -> Edge {
    let (from, center) = (Vec2::new(from[0], from[1]), Vec2::new(center[0], center[1]));
    Edge { from, curve: Curve::Arc { center, radius: (from - center).length(), ccw } }
}

fn polygon(corners: &[[f64; 2]]) -> Contour {
    corners.iter().map(|&[x, y]| line(x, y)).collect()
}

fn profile(contours: &[Contour]) -> Profile {
    Profile::new(contours.to_vec()).expect("a sound profile")
}

/// Whether a point is in what the formula says.
fn by_formula(profile: &Profile, p: Vec2) -> bool {
    let holds = |step: &Step| match *step {
        Step::Left(a, b) => (b - a).cross(p - a) > 0.0,
        Step::Disc { center, radius, inside } => ((p - center).length() < radius) == inside,
        Step::Open(_) | Step::Close => unreachable!("operators have operands"),
    };
    let outline = |outline: &Outline| {
        let mut open: Vec<(Join, bool)> = vec![(Join::All, true)];
        let frame = outline.frame.map(|(from, to)| Step::Left(from, to));
        let frame = if outline.is_convex { &frame[..0] } else { &frame[..] };
        for step in frame.iter().chain(&outline.steps) {
            let value = match step {
                Step::Open(join) => {
                    open.push((*join, *join == Join::All));
                    continue;
                }
                Step::Close => open.pop().expect("it was opened").1,
                step => holds(step),
            };
            let (join, all) = open.last_mut().expect("the outermost");
            *all = if *join == Join::All { *all && value } else { *all || value };
        }
        assert_eq!(open.len(), 1, "what is opened is closed");
        open[0].1
    };
    profile.islands().iter().any(|island| outline(&island.outer) && !island.holes.iter().any(&outline))
}

/// Fine polygons in place of contours.
fn fine(contours: &[Contour]) -> Vec<Vec<Vec2>> {
    const PARTS: usize = 360;
    let polygon = |contour: &Contour| {
        let mut points = Vec::new();
        for (edge, next) in contour.iter().zip(contour.iter().cycle().skip(1)) {
            let Curve::Arc { center, radius, ccw } = edge.curve else {
                points.push(edge.from);
                continue;
            };
            let angle = |p: Vec2| libm::atan2(p.y - center.y, p.x - center.x);
            let turn = 2.0 * std::f64::consts::PI;
            let from = if contour.len() == 1 { 0.0 } else { angle(edge.from) };
            let mut sweep = if contour.len() == 1 { 0.0 } else { angle(next.from) - from };
            if ccw && sweep <= 0.0 {
                sweep += turn;
            }
            if !ccw && sweep >= 0.0 {
                sweep -= turn;
            }
            points.extend((0..PARTS).map(|i| {
                let a = from + sweep * i as f64 / PARTS as f64;
                center + Vec2::new(libm::cos(a), libm::sin(a)) * radius
            }));
        }
        points
    };
    contours.iter().map(polygon).collect()
}

/// Whether a point is inside, by the definition: how often a ray to the right crosses fine polygons. `None` for points near
/// them.
fn by_definition(polygons: &[Vec<Vec2>], p: Vec2) -> Option<bool> {
    let mut inside = false;
    for points in polygons {
        for (&a, &b) in points.iter().zip(points.iter().cycle().skip(1)) {
            let along = b - a;
            let s = ((p - a).dot(along) / along.dot(along)).clamp(0.0, 1.0);
            if (a + along * s - p).length() < 4e-4 {
                return None;
            }
            inside ^= (a.y <= p.y) != (b.y <= p.y) && along.cross(p - a) * (b.y - a.y) > 0.0;
        }
    }
    Some(inside)
}

/// Compares formula and definition all over a square, and beyond the profile.
fn check(name: &str, contours: &[Contour]) -> Profile {
    let (profile, polygons) = (profile(contours), fine(contours));
    let (low, high) = profile.bounds();
    let size = high - low;
    let mut seen = [0, 0];
    for i in 0..=60 {
        for j in 0..=60 {
            let at = |i: i32| f64::from(i) / 40.0 - 0.25;
            for nudge in [0.0, 0.003] {
                let p = low + Vec2::new(size.x * (at(i) + nudge), size.y * (at(j) - nudge * 0.7));
                if let Some(expected) = by_definition(&polygons, p) {
                    assert_eq!(by_formula(&profile, p), expected, "{name} at {p:?}");
                    seen[usize::from(expected)] += 1;
                }
            }
        }
    }
    assert!(seen[0] > 0 && seen[1] > 0, "{name}: points inside and outside");
    profile
}

/// How many lines and circles the formulas have.
fn leaves(profile: &Profile) -> usize {
    let outlines = profile.islands().iter().flat_map(|island| std::iter::once(&island.outer).chain(&island.holes));
    let steps = outlines.flat_map(|outline| &outline.steps);
    steps.filter(|step| matches!(step, Step::Left(..) | Step::Disc { .. })).count()
}

#[test]
fn arcs_that_go_on_smoothly_are_not_cut_again_and_again() {
    // A rounded corner, a line, a fillet: both ends of that chain go up to the left.
    let step = vec![
        arc([20.0, -2.5], [20.0, -5.0], true),
        line(20.0, -7.5),
        arc([41.0, -7.5], [41.0, -5.0], true),
        line(43.5, -5.0),
        arc([43.5, 0.0], [41.0, 0.0], true),
        line(41.0, 2.5),
        arc([28.0, 2.5], [28.0, 5.0], false),
        arc([26.5, 3.0], [25.0, 1.0], true),
        line(22.5, 1.0),
        arc([22.5, 0.0], [20.0, 0.0], false),
    ];
    // Six arcs with their chords, four lines: 16 leaves, were no arc cut and none of the S curves stitched.
    assert!(leaves(&check("step", &[step])) <= 32);
}

#[test]
fn a_wrong_formula_is_noticed() {
    let half = vec![line(-1.0, 0.0), arc([1.0, 0.0], [0.0, 0.0], true)];
    let pieces = pieces_of(&half);
    let (steps, _) = verify::verified(&pieces);
    assert!(verify::holds(&steps, &pieces));
    // The whole disc, and nothing.
    let chord = Step::Left(Vec2::new(1.0, 0.0), Vec2::new(-1.0, 0.0));
    let disc = Step::Disc { center: Vec2::ZERO, radius: 1.0, inside: true };
    assert!(!verify::holds(&[disc], &pieces) && !verify::holds(&[chord], &pieces));
}

#[test]
fn arcs_of_an_s_may_have_chords_in_one_line() {
    // A bump on a plate, with fillets as large as its rounded corners.
    let bump = [
        line(0.0, 0.0),
        line(30.0, 0.0),
        line(30.0, 5.0),
        arc([21.0, 5.0], [21.0, 10.0], false),
        arc([16.0, 10.0], [11.0, 10.0], true),
        line(11.0, 15.0),
        arc([10.0, 15.0], [10.0, 10.0], true),
        arc([5.0, 10.0], [0.0, 10.0], false),
    ];
    let closed: Contour = bump.iter().copied().chain([line(0.0, 5.0)]).collect();
    check("bump", &[closed]);
}

#[test]
fn every_edge_of_a_polygon_is_there_once() {
    let ell = polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
    assert_eq!(leaves(&check("ell", &[ell])), 6);
    let comb: Contour = (0..10)
        .flat_map(|i| {
            let x = f64::from(i);
            [line(x, 3.0), line(x, 1.0), line(x + 0.5, 1.0), line(x + 0.5, 3.0)]
        })
        .chain([line(10.0, 3.0), line(10.0, 0.0), line(0.0, 0.0)])
        .collect();
    // The teeth's corners at (0, 3) and (0, 0) are joined by one line, of which (0, 1) is a part.
    let comb = check("comb", &[comb]);
    assert_eq!(leaves(&comb), comb.contours()[0].len());
}

#[test]
fn spirals_and_stars_are_what_they_are() {
    let spiral: Vec<[f64; 2]> = {
        let (mut out, mut back) = (Vec::new(), Vec::new());
        for i in 0..48 {
            let (s, c) = crate::geom::sin_cos_deg(f64::from(i) * 30.0);
            let radius = 1.0 + f64::from(i) * 0.25;
            out.push([radius * c, radius * s]);
            back.push([(radius - 0.5) * c, (radius - 0.5) * s]);
        }
        back.reverse();
        [out, back].concat()
    };
    assert_eq!(leaves(&check("spiral", &[polygon(&spiral)])), 96);
    for points in [5, 7, 12] {
        let star: Vec<[f64; 2]> = (0..2 * points)
            .map(|i| {
                let (s, c) = crate::geom::sin_cos_deg(f64::from(i) * 180.0 / f64::from(points));
                let radius = if i % 2 == 0 { 1.0 } else { 0.4 };
                [radius * c, radius * s]
            })
            .collect();
        assert_eq!(leaves(&check("star", &[polygon(&star)])), 2 * points as usize);
    }
}

#[test]
fn rounded_things_are_short() {
    let rounded = vec![
        line(1.0, 0.0),
        arc([3.0, 0.0], [3.0, 1.0], true),
        line(4.0, 1.0),
        arc([4.0, 2.0], [3.0, 2.0], true),
        line(3.0, 3.0),
        arc([1.0, 3.0], [1.0, 2.0], true),
        line(0.0, 2.0),
        arc([0.0, 1.0], [1.0, 1.0], true),
    ];
    assert_eq!(leaves(&check("rounded rectangle", std::slice::from_ref(&rounded))), 12);
    let stadium =
        vec![line(0.0, 0.0), arc([2.0, 0.0], [2.0, 1.0], true), line(2.0, 2.0), arc([0.0, 2.0], [0.0, 1.0], true)];
    assert_eq!(leaves(&check("stadium", &[stadium])), 6);
    let circle = vec![arc([1.0, 0.0], [0.0, 0.0], true)];
    assert_eq!(leaves(&check("circle", &[circle])), 1);
    let reversed: Contour = {
        let mut pieces = pieces_of(&rounded);
        reverse(&mut pieces);
        contour_of(&pieces)
    };
    assert_eq!(leaves(&check("clockwise", &[reversed])), 12);
}

#[test]
fn arcs_bulge_either_way() {
    let half = vec![line(-1.0, 0.0), arc([1.0, 0.0], [0.0, 0.0], true)];
    check("half disc", &[half]);
    let most = vec![arc([0.0, -1.0], [0.0, 0.0], true), line(-1.0, 0.0)];
    check("most of a disc", &[most]);
    let crescent = vec![arc([0.0, -1.0], [0.0, 0.0], true), arc([0.0, 1.0], [-1.0, 0.0], false)];
    check("crescent", &[crescent]);
    let lens = vec![arc([0.0, -1.0], [-1.0, 0.0], true), arc([0.0, 1.0], [1.0, 0.0], true)];
    check("lens", &[lens]);
    let bite = vec![
        line(0.0, 0.0),
        line(1.0, 0.0),
        arc([1.0, 0.0], [2.0, 0.0], false),
        line(3.0, 0.0),
        line(4.0, 0.0),
        line(4.0, 3.0),
        arc([3.0, 3.0], [2.0, 3.0], false),
        line(1.0, 3.0),
        line(0.0, 3.0),
    ];
    check("bitten", &[bite]);
    let wave = vec![
        line(0.0, -3.0),
        line(8.0, -3.0),
        arc([8.0, 0.0], [7.0, 0.0], true),
        arc([6.0, 0.0], [5.0, 0.0], false),
        arc([4.0, 0.0], [3.0, 0.0], true),
        arc([2.0, 0.0], [1.0, 0.0], false),
        line(0.0, 0.0),
    ];
    check("wave", &[wave]);
    // Two arcs around each other, from one corner on.
    let horn =
        vec![arc([0.0, 0.0], [0.0, 2.0], true), line(0.0, 4.0), line(0.0, 3.0), arc([0.0, 3.0], [0.0, 1.5], false)];
    check("horn", &[horn]);
    let thin =
        vec![arc([0.0, 0.0], [5.0, 0.0], false), line(10.0, 0.0), arc([9.0, 0.0], [5.0, 0.0], true), line(1.0, 0.0)];
    check("arch", &[thin]);
    let keyhole = vec![arc([1.0, -2.0], [0.0, 0.0], true), line(-1.0, -2.0), line(-1.0, -6.0), line(1.0, -6.0)];
    check("keyhole", &[keyhole]);
}

#[test]
fn a_gear_of_arcs_is_what_it_is() {
    let teeth = 11;
    let gear: Contour = (0..teeth)
        .flat_map(|i| {
            let point = |step: f64, radius: f64| {
                let (s, c) = crate::geom::sin_cos_deg((f64::from(i) * 4.0 + step) * 90.0 / f64::from(teeth));
                [radius * c, radius * s]
            };
            let (root, tip) = (2.0, 2.6);
            [
                arc(point(0.0, root), [0.0, 0.0], true),
                line(point(1.0, root)[0], point(1.0, root)[1]),
                arc(point(1.3, tip), [0.0, 0.0], true),
                line(point(2.7, tip)[0], point(2.7, tip)[1]),
                arc(point(3.0, root), [0.0, 0.0], true),
            ]
        })
        .collect();
    check("gear", &[gear, vec![arc([1.0, 0.0], [0.0, 0.0], true)]]);
}

#[test]
fn contours_in_contours_are_holes_and_islands() {
    let square = |low: f64, high: f64| polygon(&[[low, low], [high, low], [high, high], [low, high]]);
    let nested = check("nested", &[square(2.0, 8.0), square(0.0, 10.0), square(4.0, 6.0)]);
    assert_eq!(nested.islands().len(), 2);
    check("a hole that touches the side", &[square(0.0, 10.0), polygon(&[[0.0, 2.0], [4.0, 2.0], [0.0, 6.0]])]);
    check("islands that touch", &[square(0.0, 2.0), square(2.0, 4.0), polygon(&[[0.0, 2.0], [2.0, 2.0], [2.0, 5.0]])]);
    let bow = polygon(&[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0]]);
    assert_eq!(check("a corner met twice", &[bow]).islands().len(), 2);
    let touching = polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]]);
    check("a corner on another edge", &[touching]);
    let ring = vec![arc([2.0, 0.0], [0.0, 0.0], true)];
    check("circles that touch from inside", &[ring, vec![arc([2.0, 0.0], [1.0, 0.0], false)]]);
}

#[test]
fn what_goes_on_straight_is_joined() {
    let dotted = polygon(&[
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 2.0],
        [2.0, 3.0],
        [2.0, 2.0],
        [0.0, 2.0],
        [0.0, 1.0],
    ]);
    assert_eq!(profile(&[dotted]).contours(), [polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])]);
    let error = |contours: Vec<Contour>| Profile::new(contours).expect_err("no profile");
    assert_eq!(error(vec![]), ProfileError::Flat);
    assert_eq!(error(vec![polygon(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]])]), ProfileError::Flat);
    assert_eq!(
        error(vec![polygon(&[[0.0, 0.0], [1.0, f64::NAN], [3.0, 0.0]])]),
        ProfileError::NotFinite { contour: 0 }
    );
    let off = vec![line(0.0, 0.0), arc([2.0, 0.0], [1.0, 0.0], true), line(0.5, 0.5)];
    assert_eq!(error(vec![off]), ProfileError::NotRound { contour: 0, at: Vec2::new(2.0, 0.0) });
}

#[test]
fn crossings_are_found() {
    let error = |contours: Vec<Contour>| Profile::new(contours).expect_err("no profile");
    let bow = polygon(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
    assert_eq!(error(vec![bow]), ProfileError::Crossing { contour: 0, other: 0, at: Vec2::new(1.0, 1.0) });
    // A corner on an edge that it passes, corners in which contours cross.
    let through = polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 0.0], [1.0, -2.0], [0.0, -2.0]]);
    assert_eq!(error(vec![through]), ProfileError::Crossing { contour: 0, other: 0, at: Vec2::new(2.0, 0.0) });
    let lozenge = polygon(&[[0.0, -2.0], [1.0, 0.0], [0.0, 2.0], [-1.0, 0.0]]);
    let across = polygon(&[[-1.0, 0.0], [0.0, -1.0], [1.0, 0.0], [3.0, 3.0], [-3.0, 3.0]]);
    assert!(matches!(error(vec![lozenge.clone(), across]), ProfileError::Crossing { contour: 0, other: 1, .. }));
    let inside = polygon(&[[-1.0, 0.0], [0.0, -1.0], [1.0, 0.0], [0.0, 1.0]]);
    assert!(Profile::new(vec![lozenge, inside]).is_ok(), "corners may touch");
    let circle = |x: f64| vec![arc([x + 1.0, 0.0], [x, 0.0], true)];
    assert!(matches!(error(vec![circle(0.0), circle(1.0)]), ProfileError::Crossing { contour: 0, other: 1, .. }));
    assert!(Profile::new(vec![circle(0.0), circle(2.0)]).is_ok(), "they touch");
    let square = polygon(&[[0.0, -0.5], [9.0, -0.5], [9.0, 0.5], [0.0, 0.5]]);
    assert!(matches!(error(vec![circle(0.0), square]), ProfileError::Crossing { .. }));
    let half = vec![line(-1.0, 0.0), line(-0.5, 0.03), line(0.0, 0.2), arc([1.0, 0.0], [0.0, -5.0], true)];
    assert!(matches!(error(vec![half]), ProfileError::Crossing { .. }));
}

#[test]
fn arcs_that_pass_through_corners_cross() {
    let crosses = |contours: Vec<Contour>| matches!(Profile::new(contours), Err(ProfileError::Crossing { .. }));
    let circle = |x: f64, y: f64, radius: f64| vec![arc([x + radius, y], [x, y], true)];
    // Two corners on the circle, and on the two corners of half a disc: in by one, out by the other.
    let through = polygon(&[[0.6, 0.8], [0.0, 0.0], [0.6, -0.8], [3.0, 0.0]]);
    assert!(crosses(vec![circle(0.0, 0.0, 1.0), through]));
    let half = vec![arc([1.0, 0.0], [0.0, 0.0], true), line(-1.0, 0.0)];
    assert!(crosses(vec![half.clone(), polygon(&[[1.0, 0.0], [0.0, 0.5], [-1.0, 0.0], [0.0, -2.0]])]));
    // Both edges lead out of the circle, or into it.
    let square = polygon(&[[1.0, 0.0], [5.0, 0.0], [5.0, 4.0], [1.0, 4.0]]);
    assert!(!crosses(vec![circle(0.0, 0.0, 1.0), square]));
    assert!(!crosses(vec![circle(0.0, 0.0, 5.0), polygon(&[[5.0, 0.0], [0.0, 1.0], [0.0, -1.0]])]));
    assert!(!crosses(vec![half.clone(), polygon(&[[1.0, 0.0], [3.0, -3.0], [3.0, 3.0]])]));
    // A wedge between the tangent and the arc touches; so does the same arc again, from the other side.
    assert!(!crosses(vec![half.clone(), polygon(&[[1.0, 0.0], [3.0, 0.0], [1.0, 3.0]])]));
    let beside = vec![arc([-1.0, 0.0], [0.0, 0.0], false), line(1.0, 0.0), line(1.0, 2.0), line(-1.0, 2.0)];
    assert!(!crosses(vec![half, beside]));
}

/// Walks around the origin, so that it never crosses itself, but for arcs.
fn around_the_origin(radii: &[u8], bulges: &[i8]) -> Contour {
    let count = radii.len();
    let corner = |i: usize| {
        let (s, c) = crate::geom::sin_cos_deg(360.0 * (i % count) as f64 / count as f64);
        Vec2::new(c, s) * f64::from(radii[i % count])
    };
    let edge = |i: usize| {
        let (from, to) = (corner(i), corner(i + 1));
        let half = (to - from) * 0.5;
        match bulges[i] {
            0 => Edge { from, curve: Curve::Line },
            bulge => {
                // The farther the center, the flatter the arc.
                let center = from + half + half.left() * (4.0 / f64::from(bulge) - f64::from(bulge.signum()));
                Edge { from, curve: Curve::Arc { center, radius: (from - center).length(), ccw: bulge > 0 } }
            }
        }
    };
    (0..count).map(edge).collect()
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(300))]

    /// Corners as they come, arcs that bulge either way, many of them as much as they can without crossing.
    #[test]
    fn formulas_say_what_contours_say(
        radii in proptest::collection::vec(1_u8..6, 3..14),
        bulges in proptest::collection::vec(-4_i8..5, 14),
        arcs in proptest::prelude::any::<bool>(),
    ) {
        let bulges = if arcs { bulges } else { vec![0; 14] };
        let contour = around_the_origin(&radii, &bulges);
        let Ok(profile) = Profile::new(vec![contour.clone()]) else {
            proptest::prop_assert!(arcs, "polygons around the origin do not cross themselves");
            return Ok(());
        };
        let polygons = fine(&[contour]);
        for i in 0..20 {
            for j in 0..20 {
                let p = Vec2::new(f64::from(i) * 0.71 - 7.1, f64::from(j) * 0.71 - 7.03);
                if let Some(expected) = by_definition(&polygons, p) {
                    proptest::prop_assert_eq!(by_formula(&profile, p), expected, "{:?}", p);
                }
            }
        }
    }
}
