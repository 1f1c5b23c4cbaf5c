//! Where eight rays cross a torus: what [`Torus`] does for one ray, operation for operation.

use super::crossing::{Rays, point, vector};
use super::lanes::{F64s, Isa, Mask, Number, Vector};
use super::roots::{Bracket, Function, bracketed_root, cubic_roots};
use crate::num::Precision;
use crate::surface::Torus;

/// Where eight lines cross a torus. They all come from outside.
pub(super) struct Crossings<I: Isa> {
    /// Ascending, behind the last one infinite.
    pub t: [F64s<I>; 4],
    /// Up to here, and here included, none is missing.
    pub until: F64s<I>,
}

/// Lines in the torus' coordinates.
struct Lines<I: Isa> {
    near: Vector<F64s<I>>,
    along: Vector<F64s<I>>,
    minor: F64s<I>,
    ring: F64s<I>,
}

impl<I: Isa> Function<I> for Lines<I> {
    #[inline(always)]
    fn at(&self, s: F64s<I>) -> (F64s<I>, F64s<I>) {
        let p = self.near + self.along * s;
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        let from_ring = rho - self.ring;
        let value = from_ring * from_ring + p.z * p.z - self.minor * self.minor;
        let outwards = p.x * self.along.x + p.y * self.along.y;
        let slope = from_ring * outwards + p.z * self.along.z * rho;
        (value, -value * rho / (F64s::splat(2.0) * slope))
    }
}

impl<I: Isa> Lines<I> {
    /// The stretches in the ball and in the slab around the torus; and the lines that miss them.
    #[inline(always)]
    fn range(&self, torus: &Torus) -> (F64s<I>, F64s<I>, Mask<I>) {
        let (minor, ring) = (torus.minor, torus.kind.ring());
        let outer = ring + minor;
        let farthest = if ring < 0.0 { outer * (minor + 1.0) } else { outer * outer };
        let near_z = self.near.z;
        let reach = F64s::zero().max(F64s::splat(farthest) - self.near.dot(self.near)).sqrt();
        let flat = self.along.z.le(F64s::zero()) & self.along.z.ge(F64s::zero());
        let low = (F64s::splat(-minor) - near_z) / self.along.z;
        let high = (F64s::splat(minor) - near_z) / self.along.z;
        let lo = flat.select(-reach, (-reach).max(low.min(high)));
        let hi = flat.select(reach, reach.min(low.max(high)));
        let missed = !lo.lt(hi) | flat & near_z.abs().ge(F64s::splat(minor));
        (lo, hi, missed | Mask::splat(outer <= 0.0))
    }
}

impl<I: Isa> Crossings<I> {
    #[inline(always)]
    fn nowhere() -> Self {
        Self { t: [F64s::infinity(); 4], until: F64s::infinity() }
    }

    /// Adds a crossing of some lines.
    #[inline(always)]
    fn push(&mut self, lanes: Mask<I>, t: F64s<I>) {
        let t = t + F64s::zero();
        let mut free = lanes;
        for place in &mut self.t {
            let here = free & !place.is_finite();
            *place = here.select(t, *place);
            free = free & !here;
        }
    }
}

/// As [`Torus::crossings`], of those lanes; and which of them scalar code must look at. With `only_first` a line is left
/// alone from its first crossing ahead of its start on.
#[inline(always)]
pub(super) fn torus<I: Isa, N: Number<I>>(
    torus: &Torus,
    rays: &Rays<I, N>,
    lanes: Mask<I>,
    only_first: bool,
) -> (Crossings<I>, Mask<I>) {
    let (origin, direction) = (point(&torus.to_local, rays.origin), vector(&torus.to_local, rays.direction));
    let origin = origin.map(Number::lanes);
    let length = direction.dot(direction).sqrt();
    let t_near = -origin.dot(direction) / (length * length);
    let near = origin + direction * t_near;
    let (minor, ring) = (torus.minor, torus.kind.ring());
    let along = direction / length;
    let lines = Lines { near, along, minor: F64s::splat(minor), ring: F64s::splat(ring) };
    let (lo, hi, missed) = lines.range(torus);
    let k = near.dot(near) + F64s::splat((1.0 - minor) * (1.0 + minor));
    let usual = k.is_finite() & along.dot(along).is_finite() & lo.is_finite() & hi.is_finite();
    let mut crossings = Crossings::nowhere();
    let met = lanes & usual & !missed;
    if !met.any() {
        return (crossings, lanes & !usual);
    }
    let two = F64s::splat(2.0);
    let a = along.x * along.x + along.y * along.y;
    let b = near.x * along.x + near.y * along.y;
    let size = 1.0 + minor;
    let turning = Precision { tolerance: 1e-10 * size, noise: 0.0 };
    let [first, second, third] = cubic_roots((k - two * a, F64s::splat(-2.0) * b), met, (lo, hi), turning);

    let rounding = 2.0 * minor * (4.0 * f64::EPSILON);
    let touch = F64s::splat(rounding) * (F64s::splat(size) + origin.max_abs());
    let precision = Precision { tolerance: f64::EPSILON / 16.0 * size, noise: rounding * size };
    let (mut from, mut value_from, mut inside) = (lo, lines.at(lo).0, Mask::splat(false));
    let mut wanted = met;
    for (i, (s, there)) in [first, second, third, (hi, met)].into_iter().enumerate() {
        let is_end = i == 3;
        let there = there & wanted;
        if !there.any() {
            continue;
        }
        let value = lines.at(s).0;
        let (counts, now_inside) = match is_end {
            true => (there, Mask::splat(false)),
            false => (there & !value.abs().le(touch), value.lt(F64s::zero())),
        };
        let crosses = counts & (now_inside ^ inside);
        if crosses.any() {
            let start = match is_end {
                true => from + (s - from) * (value_from / (value_from - value)).sqrt(),
                false => s - (s - from) * (value / (value - value_from)).sqrt(),
            };
            let bracket = Bracket { lanes: crosses, lo: from, hi: s, start, rising: inside };
            let t = t_near + bracketed_root(&lines, bracket, precision) / length;
            crossings.push(crosses, t);
            inside = inside ^ crosses;
            if only_first {
                // What follows is behind the bracket's end.
                let enough = crosses & t.ge(F64s::zero()) & t.lt(t_near + s / length);
                crossings.until = enough.select(t, crossings.until);
                wanted = wanted & !enough;
            }
        }
        (from, value_from) = (counts.select(s, from), counts.select(value, value_from));
    }
    (crossings, lanes & !usual)
}

/// From the points of the ring's circle that count to points in the torus' own coordinates: as
/// [`Torus::local_gradient`](Torus), but half as long.
#[inline(always)]
pub(super) fn from_ring<I: Isa>(torus: &Torus, q: Vector<F64s<I>>) -> Vector<F64s<I>> {
    let rho = (q.x * q.x + q.y * q.y).sqrt();
    let outwards = (rho - F64s::splat(torus.kind.ring())) / rho;
    let outwards = rho.gt(F64s::zero()).select(outwards, F64s::zero());
    Vector::new(q.x * outwards, q.y * outwards, q.z)
}

#[cfg(test)]
mod tests {
    use super::super::dispatch::{Backend, Task};
    use super::super::lanes::{LANES, Stored};
    use super::*;
    use crate::geom::{Affine, Ray, Vec3};
    use crate::surface::TorusKind;

    /// Says where eight rays cross a torus, up to where none is missing, and which are unusual.
    struct Cross<'a>(&'a Torus, &'a [[Stored; 3]; 2], bool, &'a mut ([Stored; 4], Stored, u8));

    impl Task for Cross<'_> {
        #[inline(always)]
        fn run<I: Isa>(self) {
            let Self(surface, [origin, direction], only_first, result) = self;
            let rays = Rays::<I, F64s<I>> { origin: Vector::load(origin), direction: Vector::load(direction) };
            let (found, unusual) = torus(surface, &rays, Mask::splat(true), only_first);
            *result = (found.t.map(F64s::stored), found.until.stored(), unusual.bits());
        }
    }

    /// Small integers and their neighbours: in the ring's plane, along the axis, through the hole, touching.
    fn some_rays() -> Vec<Ray> {
        let mut state = 1_u64;
        let mut next = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let whole = ((state >> 33) % 9) as f64 / 2.0 - 2.0;
            if state >> 60 & 3 == 0 { whole + (state >> 40 & 0xFFFF) as f64 * 1e-5 } else { whole }
        };
        let mut three = move || Vec3::new(next(), next(), next());
        let rays = std::iter::from_fn(|| Some((three(), three())));
        rays.filter_map(|(origin, direction)| Ray::checked(origin, direction)).take(8_000).collect()
    }

    #[test]
    fn eight_rays_cross_where_one_does() {
        let turned = Affine::rotation_deg(Vec3::new(10.0, 20.0, 30.0)) * Affine::scale(Vec3::new(1.0, 1.5, 0.75));
        let rings = [0.01, 0.5, 1.0, 1.25].map(|minor| (TorusKind::Outer, minor));
        let lemons = [1.0, 1.25, 3.0].map(|minor| (TorusKind::Inner, minor));
        let rays = some_rays();
        let mut most = [0; 5];
        for (kind, minor) in rings.into_iter().chain(lemons) {
            for (to_local, rays) in
                [Affine::IDENTITY, turned].iter().flat_map(|map| rays.chunks_exact(LANES).map(move |rays| (map, rays)))
            {
                let surface = Torus { kind, minor, to_local: *to_local };
                let stored = |of: fn(&Ray) -> Vec3| {
                    [0, 1, 2].map(|axis| Stored(std::array::from_fn(|lane| of(&rays[lane])[axis])))
                };
                let eight = [stored(|ray| ray.origin), stored(|ray| ray.direction)];
                for (backend, only_first) in Backend::ALL.into_iter().flat_map(|b| [(b, false), (b, true)]) {
                    let mut found = Default::default();
                    backend.run(Cross(&surface, &eight, only_first, &mut found));
                    let (t, until, unusual) = found;
                    assert_eq!(unusual, 0);
                    for (lane, ray) in rays.iter().enumerate() {
                        let expected = surface.crossings(ray);
                        assert!(!expected.starts_inside());
                        most[expected.params().len()] += 1;
                        let bits = |params: &[f64]| {
                            let known = params.iter().filter(|t| t.is_finite() && **t <= until.0[lane]);
                            known.map(|t| t.to_bits()).collect::<Vec<_>>()
                        };
                        let expected = bits(expected.params());
                        let found = bits(&t.map(|t| t.0[lane]));
                        assert_eq!(found, expected, "{surface:?}, {ray:?}, {backend:?}, only the first {only_first}");
                    }
                }
            }
        }
        assert!(most.iter().step_by(2).all(|&count| count > 1000), "{most:?}");
    }
}
