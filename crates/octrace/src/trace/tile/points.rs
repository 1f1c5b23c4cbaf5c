//! Points and normals where eight rays meet surfaces: what [`Tracer::surface_point`] says of each.

use super::crossing::point;
use super::eight::{EightHits, EightRays};
use super::lanes::{F64s, Isa, LANES, Mask, Stored, Vector};
use crate::geom::Vec3;
use crate::surface::{Quadric, Surface};
use crate::trace::Tracer;

/// Points, and the finished solid's outward unit normals there. Where nothing is met: where rays start, and zero.
#[inline(always)]
pub(crate) fn points<I: Isa>(
    tracer: &Tracer,
    rays: &EightRays,
    hits: &EightHits,
) -> (Vector<F64s<I>>, Vector<F64s<I>>) {
    let (o, d) = (Vector::<F64s<I>>::load(&rays.origin), Vector::<F64s<I>>::load(&rays.direction));
    let t = Mask::from_bits(hits.met).select(F64s::load(&hits.t), F64s::zero());
    let position = o + d * t;
    let mut normal = Vector::from_one(Vec3::ZERO);
    let mut unusual = 0;
    let mut left = hits.met;
    while left != 0 {
        // All lanes that meet the same surface.
        let surface = hits.surfaces[left.trailing_zeros() as usize & (LANES - 1)];
        let same = left & !I::differing(&hits.surfaces, surface);
        left &= !same;
        let (surface, offset) = tracer.catalog.surface(surface);
        let (unit, usual) = match surface {
            Surface::Plane(plane) => match plane.normal.normalized() {
                Some(unit) => (Vector::from_one(unit), u8::MAX),
                None => (normal, 0),
            },
            Surface::Quadric(quadric) => {
                let (unit, usual) = gradient(quadric, o.minus::<I>(offset) + d * t).normalized();
                (unit, usual.bits())
            }
            Surface::Torus(_) | Surface::Mesh(_) | Surface::Placed(_) => (normal, 0),
        };
        unusual |= same & !usual;
        normal = Vector::select(Mask::from_bits(same), unit, normal);
    }
    normal = Vector::select(Mask::from_bits(hits.flipped), -normal, normal);
    if unusual != 0 {
        let mut stored = normal.stored();
        set_normals(tracer, rays, hits, unusual, &mut stored);
        normal = Vector::load(&stored);
    }
    (position, normal)
}

/// As [`Quadric::gradient`].
#[inline(always)]
fn gradient<I: Isa>(quadric: &Quadric, p: Vector<F64s<I>>) -> Vector<F64s<I>> {
    let (s, _) = quadric.kind.coefficients();
    let q = point::<I, F64s<I>>(&quadric.to_local, p);
    let two = F64s::splat(2.0);
    let n = Vector::new(two * q.x, two * q.y, F64s::splat(2.0 * s) * q.z);
    let [x, y, z] = quadric.to_local.rows;
    let (x, y, z) = (Vector::<F64s<I>>::from_one(x), Vector::from_one(y), Vector::from_one(z));
    x * n.x + y * n.y + z * n.z
}

/// Sets the normals of some lanes to what scalar code says.
#[cold]
#[inline(never)]
fn set_normals(tracer: &Tracer, rays: &EightRays, hits: &EightHits, lanes: u8, normal: &mut [Stored; 3]) {
    for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
        let Some((_, hit)) = hits.hit(lane) else { continue };
        let unit = tracer.surface_point(&rays.ray(lane), &hit).normal;
        for axis in 0..3 {
            normal[axis].0[lane] = unit[axis];
        }
    }
}
