//! Every traversal against exact rational arithmetic.

use super::lattice::{for_each_leaf, geometry};
use super::{Traversal, TraversalKind, bresenham, is_parallel, root_interval};
use crate::compile::{Copies, compile};
use crate::exec::Exec;
use crate::geom::{Ray, Vec3};
use crate::model::Solid;
use crate::octree::{BuildOptions, Octree, build};
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};
use proptest::prelude::*;
use std::ops::ControlFlow;

/// Cells that the ray is in for less than this share of its way are not compared.
const SHORT: f64 = 1e-7;

fn exact(v: f64) -> BigRational {
    BigRational::from_float(v).expect("a finite number")
}

/// A line in exact numbers.
struct Line {
    origin: [BigRational; 3],
    direction: [BigRational; 3],
}

/// The middles of the cells that the line is in between two parameters, in order, the short ones left out: by cutting it
/// with every cell of the tree. A line in a plane between cells is in the upper one.
fn reference(octree: &Octree, line: &Line, t_in: &BigRational, t_out: &BigRational) -> Vec<(Vec3, f64)> {
    let shortest = (t_out - t_in) * exact(SHORT);
    let mut found = Vec::new();
    for_each_leaf(octree, octree.depth(), |place, _| {
        let (center, half) = geometry(octree, octree.depth(), place);
        let (mut first, mut last) = (t_in.clone(), t_out.clone());
        for axis in 0..3 {
            let (o, d) = (&line.origin[axis], &line.direction[axis]);
            let (low, high) = (exact(center[axis] - half), exact(center[axis] + half));
            if d.is_zero() {
                let top = high == exact(octree.center[axis] + octree.half) && *o == high;
                if *o < low || (*o >= high && !top) {
                    return;
                }
                continue;
            }
            let (a, b) = ((low - o) / d, (high - o) / d);
            let (a, b) = if a < b { (a, b) } else { (b, a) };
            first = first.max(a);
            last = last.min(b);
        }
        if &last - &first > shortest {
            found.push((first, center, half));
        }
    });
    found.sort_by(|a, b| a.0.cmp(&b.0));
    found.into_iter().map(|(_, center, half)| (center, half)).collect()
}

/// The cells that a traversal shows, the short ones left out; and that their intervals tile the way.
fn walked(octree: &Octree, kind: TraversalKind, ray: &Ray, (t_in, t_out): (f64, f64)) -> Vec<(Vec3, f64)> {
    let mut cells = Vec::new();
    let mut end = t_in;
    let _ = Traversal::new(kind, octree).walk(octree, ray, t_in, t_out, |step| {
        assert_eq!(step.t_in, end, "{kind}: the intervals tile the ray");
        assert!(step.t_out >= step.t_in, "{kind}: time does not run back");
        end = step.t_out;
        if step.t_out - step.t_in > (t_out - t_in) * SHORT {
            cells.push((step.center, step.half));
        }
        ControlFlow::<()>::Continue(())
    });
    assert_eq!(end, t_out, "{kind}: the intervals reach the end");
    cells
}

fn octree_of(solid: &Solid, depth: u32) -> Option<Octree> {
    let compiled = compile(std::slice::from_ref(solid), 0.0, Copies::Apart);
    let options = BuildOptions { leaf_surfaces: 0, depth: Some(depth) };
    let body = &compiled.bodies[0];
    build(&compiled.catalog, body, &body.bounds, &options, BuildOptions::MAX_DEPTH, &Exec::with_threads(1))
        .expect("nobody cancels")
}

fn some_solid() -> impl Strategy<Value = Solid> {
    let ball = (prop::array::uniform3(-3.0..3.0_f64), 0.2..2.5_f64)
        .prop_map(|(at, r)| Solid::sphere().scale([r, r, r]).translate(at));
    prop::collection::vec(ball, 1..4).prop_map(|balls| balls.into_iter().reduce(|a, b| a - b).unwrap_or(Solid::block()))
}

/// A ray between two points given in eighths of the root cube, so that edges, corners and faces are met exactly; or nearly.
fn ray_through(octree: &Octree, from: [i32; 3], to: [i32; 3], nudge: [f64; 3], length: f64) -> Option<Ray> {
    let place = |p: [i32; 3]| octree.center + Vec3::from(p.map(|i| f64::from(i) / 8.0)) * octree.half;
    let origin = place(from);
    let direction = (place(to) - origin + Vec3::from(nudge) * octree.half) * length;
    // Tracers make directions fit before they walk.
    Ray::checked(origin, direction).filter(|_| (1e-30..1e30).contains(&direction.max_abs()))
}

fn tiny() -> impl Strategy<Value = f64> {
    prop_oneof![6 => Just(0.0), 1 => Just(5e-324), 1 => Just(-1e-300), 1 => Just(1e-12), 2 => -0.3..0.3_f64]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 120, ..ProptestConfig::default() })]

    #[test]
    fn every_traversal_visits_the_cells_that_exact_arithmetic_finds(
        solid in some_solid(), depth in 1u32..5,
        from in prop::array::uniform3(-12i32..=12), to in prop::array::uniform3(-8i32..=8),
        nudge in prop::array::uniform3(tiny()), starts_inside in any::<bool>(),
        // As short and as long as directions get.
        length in prop_oneof![4 => Just(1.0), 1 => Just(1e-28), 1 => Just(1e28)],
    ) {
        let Some(octree) = octree_of(&solid, depth) else { return Ok(()) };
        let Some(ray) = ray_through(&octree, from, to, nudge, length) else { return Ok(()) };
        let Some((t_in, t_out)) = root_interval(&octree, &ray) else { return Ok(()) };
        let t_in = if starts_inside { t_in.max(0.0) } else { t_in };
        // What only touches an edge of the root is in it for a rounding, if at all: no number tells in which cells.
        if t_out - t_in <= 1e-12 * t_in.abs().max(t_out.abs()) {
            return Ok(());
        }
        let d = |axis: usize| if is_parallel(ray.direction[axis]) { 0.0 } else { ray.direction[axis] };
        let line = Line {
            origin: ray.origin.to_array().map(exact),
            direction: [0, 1, 2].map(|axis| exact(d(axis))),
        };
        let expected = reference(&octree, &line, &exact(t_in), &exact(t_out));
        // Glassner's walk asks for the cell of a point: what moves a ray by less than any rounding does not move that.
        let is_nothing = |c: f64| !is_parallel(c) && c.abs() < 1e-100 * ray.direction.max_abs();
        let moves_by_nothing = ray.direction.to_array().into_iter().any(is_nothing);
        for kind in TraversalKind::ALL {
            if kind != TraversalKind::Bresenham && !(kind == TraversalKind::Glassner && moves_by_nothing) {
                prop_assert_eq!(walked(&octree, kind, &ray, (t_in, t_out)), expected.clone(), "{}", kind);
            }
        }
        // In integers: the same for the ray's line on the lattice.
        let lattice = bresenham::lattice_line(&octree, &ray, t_in);
        let (origin, direction) = (lattice.origin, lattice.direction);
        // Rounding may put the line of a ray that grazes the root beside it: then there is nothing to compare.
        let beside = |t: f64| {
            (0..3).any(|axis| {
                let off = &origin[axis] + &direction[axis] * exact(t) - exact(octree.center[axis]);
                off.to_f64().is_none_or(|off| off.abs() > octree.half * (1.0 - 1e-8))
            })
        };
        if beside(t_in + (t_out - t_in) * 1e-3) || beside(t_out - (t_out - t_in) * 1e-3) {
            return Ok(());
        }
        let expected = reference(&octree, &Line { origin, direction }, &exact(t_in), &exact(t_out));
        prop_assert_eq!(walked(&octree, TraversalKind::Bresenham, &ray, (t_in, t_out)), expected);
    }
}

/// The lattice line stays within four lattice units of the ray, all the way: the margin covers it.
#[test]
fn the_lattice_line_stays_close_to_the_ray() {
    let octree = octree_of(&Solid::sphere(), 4).expect("a ball is bounded");
    let unit = 2.0 * octree.half / f64::from(1_u32 << 31);
    assert!(octree.margin() > 4.0 * unit);
    for i in 0..1000 {
        let turn = f64::from(i);
        let direction = Vec3::new(libm::sin(turn), libm::cos(3.0 * turn), libm::sin(0.1 * turn) * 1e-6);
        let ray = Ray::new(octree.center - direction * 3.0, direction);
        let Some((t_in, t_out)) = root_interval(&octree, &ray) else { continue };
        let lattice = bresenham::lattice_line(&octree, &ray, t_in);
        for t in [t_in, 0.5 * (t_in + t_out), t_out] {
            for axis in 0..3 {
                let on_lattice = &lattice.origin[axis] + &lattice.direction[axis] * exact(t);
                let off = on_lattice.to_f64().expect("a moderate number") - ray.at(t)[axis];
                assert!(off.abs() <= 4.0 * unit, "off by {} units", off / unit);
            }
        }
    }
}
