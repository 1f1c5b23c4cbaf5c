//! Points and normals where eight rays meet surfaces: what [`Tracer::surface_point`] says of each.

use super::crossing::point;
use super::eight::{EightHits, EightRays};
use super::lanes::{F64s, Isa, LANES, Mask, Stored, Vector};
use super::torus::from_ring;
use crate::geom::{Affine, Vec3};
use crate::surface::{Quadric, Surface};
use crate::trace::Tracer;

/// Where eight rays meet surfaces.
pub(crate) struct EightPoints<I: Isa> {
    /// Where nothing is met: where rays start.
    pub position: Vector<F64s<I>>,
    /// The finished solid's outward unit normal; zero where nothing is met.
    pub normal: Vector<F64s<I>>,
    /// See [`SurfacePoint::rounding`](crate::trace::SurfacePoint).
    pub rounding: F64s<I>,
}

/// Points, normals and roundings.
#[inline(always)]
pub(crate) fn points<I: Isa>(tracer: &Tracer, rays: &EightRays, hits: &EightHits) -> EightPoints<I> {
    let (o, d) = (Vector::<F64s<I>>::load(&rays.origin), Vector::<F64s<I>>::load(&rays.direction));
    let t = Mask::from_bits(hits.met).select(F64s::load(&hits.t), F64s::zero());
    let position = o + d * t;
    let reach = abs::<I>(o) + abs::<I>(d * t);
    let mut normal = Vector::from_one(Vec3::ZERO);
    let mut rounding = F64s::zero();
    let (mut unusual, mut facets) = (0, 0);
    let (mut normals, mut offsets) = ([Stored([1.0; LANES]); 3], Stored([0.0; LANES]));
    let mut left = hits.met;
    while left != 0 {
        // All lanes that meet the same surface.
        let surface = hits.surfaces[left.trailing_zeros() as usize & (LANES - 1)];
        let same = left & !I::differing(&hits.surfaces, surface);
        left &= !same;
        let (surface, offset) = tracer.catalog.surface(surface);
        let (unit, off, usual) = match surface {
            Surface::Plane(plane) if same & (same - 1) == 0 => {
                // As in meshes: what each lane meets by itself is looked at for all of them together.
                let lane = same.trailing_zeros() as usize & (LANES - 1);
                for (axis, normals) in normals.iter_mut().enumerate() {
                    normals.0[lane] = plane.normal[axis];
                }
                offsets.0[lane] = plane.offset.abs();
                facets |= same;
                continue;
            }
            Surface::Plane(plane) => match plane.normal.normalized() {
                Some(unit) => {
                    let off = Vector::from_one(plane.normal.abs()).dot(reach) + F64s::splat(plane.offset.abs());
                    (Vector::from_one(unit), off, u8::MAX)
                }
                None => (normal, rounding, 0),
            },
            Surface::Quadric(quadric) => {
                let (gradient, off) = gradient::<I>(quadric, o.minus::<I>(offset) + d * t, reach);
                let (unit, usual) = gradient.normalized();
                (unit, off / gradient.dot(gradient).sqrt(), usual.bits())
            }
            Surface::Torus(torus) => {
                let q = point::<I, F64s<I>>(&torus.to_local, o.minus::<I>(offset) + d * t);
                let n = from_ring(torus, q).map(|v| v * F64s::splat(2.0));
                let off = abs::<I>(n)
                    .dot(reach_of(&torus.to_local, reach) + Vector::from_one(Vec3::splat(1.0 + torus.minor)));
                let gradient = transposed_vector(&torus.to_local, n);
                let (unit, usual) = gradient.normalized();
                (unit, off / gradient.dot(gradient).sqrt(), usual.bits())
            }
            Surface::Mesh(_) | Surface::Placed(_) => (normal, rounding, 0),
        };
        unusual |= same & !usual;
        let same = Mask::from_bits(same);
        normal = Vector::select(same, unit, normal);
        rounding = same.select(off, rounding);
    }
    if facets != 0 {
        let raw = Vector::<F64s<I>>::load(&normals);
        let (unit, usual) = raw.normalized();
        unusual |= facets & !usual.bits();
        let facets = Mask::from_bits(facets);
        normal = Vector::select(facets, unit, normal);
        rounding = facets.select(abs::<I>(raw).dot(reach) + F64s::load(&offsets), rounding);
    }
    normal = Vector::select(Mask::from_bits(hits.flipped), -normal, normal);
    if unusual != 0 {
        let (mut normals, mut roundings) = (normal.stored(), rounding.stored());
        set_unusual(tracer, rays, hits, unusual, &mut normals, &mut roundings);
        (normal, rounding) = (Vector::load(&normals), F64s::load(&roundings));
    }
    EightPoints { position, normal, rounding }
}

#[inline(always)]
fn abs<I: Isa>(v: Vector<F64s<I>>) -> Vector<F64s<I>> {
    Vector::new(v.x.abs(), v.y.abs(), v.z.abs())
}

/// As [`Quadric::gradient`], and what roundings make of the equation: as [`Surface::rounding`] but for the division.
#[inline(always)]
fn gradient<I: Isa>(quadric: &Quadric, p: Vector<F64s<I>>, reach: Vector<F64s<I>>) -> (Vector<F64s<I>>, F64s<I>) {
    let (s, c0) = quadric.kind.coefficients();
    let q = point::<I, F64s<I>>(&quadric.to_local, p);
    let two = F64s::splat(2.0);
    let n = Vector::new(two * q.x, two * q.y, F64s::splat(2.0 * s) * q.z);
    let off = abs::<I>(n).dot(reach_of(&quadric.to_local, reach)) + F64s::splat(c0.abs());
    (transposed_vector(&quadric.to_local, n), off)
}

/// The sum of the magnitudes of what coordinates are computed from, behind a map.
#[inline(always)]
fn reach_of<I: Isa>(map: &Affine, reach: Vector<F64s<I>>) -> Vector<F64s<I>> {
    let row = |i: usize| Vector::<F64s<I>>::from_one(map.rows[i].abs()).dot(reach);
    Vector::new(row(0), row(1), row(2)) + Vector::from_one(map.translation.abs())
}

/// As [`Affine::transposed_vector`].
#[inline(always)]
fn transposed_vector<I: Isa>(map: &Affine, n: Vector<F64s<I>>) -> Vector<F64s<I>> {
    let row = |i: usize| Vector::<F64s<I>>::from_one(map.rows[i]);
    row(0) * n.x + row(1) * n.y + row(2) * n.z
}

/// Sets the normals and roundings of some lanes to what scalar code says.
#[cold]
#[inline(never)]
fn set_unusual(
    tracer: &Tracer,
    rays: &EightRays,
    hits: &EightHits,
    lanes: u8,
    normal: &mut [Stored; 3],
    rounding: &mut Stored,
) {
    for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
        let Some((_, hit)) = hits.hit(lane) else { continue };
        let point = tracer.surface_point(&rays.ray(lane), &hit);
        for (axis, normal) in normal.iter_mut().enumerate() {
            normal.0[lane] = point.normal[axis];
        }
        rounding.0[lane] = point.rounding;
    }
}
