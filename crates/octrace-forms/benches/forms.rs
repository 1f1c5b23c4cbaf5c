//! What do outlines, sweeps, hulls and meshes cost to make? `cargo bench -p octrace-forms`; rates are of edges, children or
//! triangles.

use divan::Bencher;
use divan::counter::ItemsCount;
use octrace::geom::sin_cos_deg;
use octrace::{Affine, BoolOp, Polyhedron, Profile, Solid, Vec2, Vec3};
use octrace_forms::Tolerance;
use octrace_forms::files::mesh::{MeshFormat, read};
use octrace_forms::plane::{Affine2, Offset, Outline, combine};
use octrace_forms::space::{hull, minkowski};
use std::fmt::Write;

fn main() {
    divan::main();
}

/// A cog with so many teeth, all corners sharp.
fn cog(teeth: usize) -> Outline {
    let step = 360.0 / teeth as f64;
    let corner = |tooth: usize, part: f64, radius: f64| {
        let (sin, cos) = sin_cos_deg((tooth as f64 + part) * step);
        Vec2::new(cos * radius, sin * radius)
    };
    let tooth = |i| [corner(i, 0.0, 9.0), corner(i, 0.25, 10.0), corner(i, 0.5, 10.0), corner(i, 0.75, 9.0)];
    Outline::polygon(&[(0..teeth).flat_map(tooth).collect()]).expect("a polygon")
}

/// Circles in a row, each of which crosses the next.
fn row(count: usize) -> Vec<Outline> {
    let circle = Outline::circle(1.0);
    let by = |i: usize| Affine2::of_space(&Affine::translation(Vec3::new(i as f64 * 1.5, 0.0, 0.0)));
    let at = |i: usize| circle.moved(&by(i), Tolerance::default());
    (0..count).map(at).collect()
}

#[divan::bench(args = [10, 100, 1_000], max_time = 2)]
fn union_of_circles(bencher: Bencher, count: usize) {
    let circles = row(count);
    let circles: Vec<&Outline> = circles.iter().collect();
    bencher.counter(ItemsCount::new(count)).bench_local(|| combine(BoolOp::Union, &circles).expect("circles"));
}

/// Rounds all corners outwards.
#[divan::bench(args = [10, 100, 1_000], max_time = 2)]
fn offset_of_cogs(bencher: Bencher, teeth: usize) {
    let cog = cog(teeth);
    let round = Offset::Round { r: 0.01, facets: None };
    bencher.counter(ItemsCount::new(4 * teeth)).bench_local(|| cog.offset(round).expect("a cog"));
}

/// An outline becomes a formula over surfaces.
#[divan::bench(args = [10, 100, 1_000], max_time = 2)]
fn profiles_of_cogs(bencher: Bencher, teeth: usize) {
    let cog = cog(teeth).offset(Offset::Round { r: 0.01, facets: None }).expect("a cog");
    let edges: usize = cog.contours.iter().map(Vec::len).sum();
    bencher.counter(ItemsCount::new(edges)).bench_local(|| Profile::new(cog.contours.clone()).expect("it is sound"));
}

/// Balls on a screw line.
#[divan::bench(args = [4, 32, 256], max_time = 2)]
fn hulls_of_balls(bencher: Bencher, count: usize) {
    let ball = |i: usize| {
        let (sin, cos) = sin_cos_deg(i as f64 * 37.0);
        Solid::sphere().scale([1.0 + 0.3 * cos; 3]).translate([10.0 * cos, 10.0 * sin, i as f64 * 0.2])
    };
    let balls: Vec<Solid> = (0..count).map(ball).collect();
    bencher.counter(ItemsCount::new(count)).bench_local(|| hull(&balls, Tolerance::default()).expect("balls"));
}

/// A prism with so many sides, its edges rounded.
#[divan::bench(args = [4, 64], max_time = 2)]
fn rounded_prisms(bencher: Bencher, sides: usize) {
    let corner = |i: usize| {
        let (sin, cos) = sin_cos_deg(i as f64 * 360.0 / sides as f64);
        Vec2::new(10.0 * cos, 10.0 * sin)
    };
    let base = Outline::polygon(&[(0..sides).map(corner).collect()]).expect("a polygon");
    let prism = Solid::prism(Profile::new(base.contours).expect("it is sound"));
    let solids = [prism, Solid::sphere()];
    bencher.counter(ItemsCount::new(sides)).bench_local(|| minkowski(&solids, Tolerance::default()).expect("convex"));
}

/// A closed surface of twice as many triangles as squares, as the text of an STL file.
fn bumps(squares: usize) -> String {
    let point = |u: usize, v: usize| {
        let ((sin_u, cos_u), (sin_v, cos_v)) = (turn(u, squares), turn(v, squares));
        let radius = 3.0 + cos_v;
        format!("vertex {} {} {}\n", radius * cos_u, radius * sin_u, sin_v)
    };
    let mut text = String::from("solid ring\n");
    for (u, v) in (0..squares).flat_map(|u| (0..squares).map(move |v| (u, v))) {
        let (p, q) = ((u + 1) % squares, (v + 1) % squares);
        for corners in [[(u, v), (p, v), (p, q)], [(u, v), (p, q), (u, q)]] {
            let corners = corners.map(|(u, v)| point(u, v)).concat();
            write!(text, "facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n").expect("strings take all");
        }
    }
    text + "endsolid ring\n"
}

fn turn(step: usize, steps: usize) -> (f64, f64) {
    sin_cos_deg(step as f64 * 360.0 / steps as f64)
}

/// From the text of an STL file to a solid that is known to be closed.
#[divan::bench(args = [30, 300], max_time = 4)]
fn solids_from_stl(bencher: Bencher, squares: usize) {
    let text = bumps(squares);
    let solid = || -> Polyhedron {
        read(MeshFormat::Stl, text.as_bytes()).expect("an STL file").into_polyhedron().expect("it is closed")
    };
    bencher.counter(ItemsCount::new(2 * squares * squares)).bench_local(solid);
}
