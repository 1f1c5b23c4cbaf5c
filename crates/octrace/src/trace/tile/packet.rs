//! Eight rays on their way.

use super::crossing::Rays;
use super::eight::EightRays;
use super::lanes::{F64s, Isa, LANES, Mask, Number, Stored, Vector};
use super::layout::{PACKET_PX, corner_of};
use super::mesh::Toggles;
use super::walk::Scenery;
use crate::compile::Word;
use crate::geom::{Ray, Vec3};
use crate::model::CameraRays;
use crate::trace::Scratch;

/// How rays start: all from one point, or each from its own.
pub(super) trait Origins<I: Isa> {
    type Number: Number<I>;
    /// Where a packet's rays start, seen from `from`; `eye` is the one point.
    fn of(packet: &Packet, eye: Vec3, from: Vec3) -> Vector<Self::Number>;
}

/// From one point.
pub(super) struct Common;

/// Each from its own.
pub(super) struct Own;

impl<I: Isa> Origins<I> for Common {
    type Number = f64;

    #[inline(always)]
    fn of(_packet: &Packet, eye: Vec3, from: Vec3) -> Vector<f64> {
        let eye = eye - from;
        Vector::new(eye.x, eye.y, eye.z)
    }
}

impl<I: Isa> Origins<I> for Own {
    type Number = F64s<I>;

    #[inline(always)]
    fn of(packet: &Packet, _eye: Vec3, from: Vec3) -> Vector<F64s<I>> {
        let [x, y, z] = &packet.origin;
        Vector::<F64s<I>>::new(F64s::load(x), F64s::load(y), F64s::load(z)).minus(from)
    }
}

/// The pixels of the lanes.
const LANE_X: Stored = Stored([0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0]);
const LANE_Y: Stored = Stored([0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
const _: () = assert!(PACKET_PX.0 == 4 && PACKET_PX.1 == 2);

/// Eight rays, and what they met.
#[derive(Clone, Copy, Debug, Default)]
#[repr(align(64))]
pub(super) struct Packet {
    pub direction: [Stored; 3],
    /// One over the direction.
    pub inverse: [Stored; 3],
    pub origin: [Stored; 3],
    /// By how much the parameter grows with the depth in the picture.
    pub per_depth: Stored,
    /// Where rays met something; infinite where not.
    pub t: Stored,
    /// The literals that they met.
    pub words: [u32; LANES],
    /// Of a mesh that they met, the face: its surface as the mesh refers to it, if that is known.
    pub facets: [u32; LANES],
    /// The bodies that they met.
    pub bodies: [u32; LANES],
    /// Rays that are followed at all.
    pub wanted: u8,
    /// Rays that have met nothing of the present body so far.
    pub open: u8,
    /// Open rays that wait while others are in a copy of a solid.
    pub aside: u8,
    /// Rays that have met something, and which of them enter it.
    pub met: u8,
    pub entering: u8,
    /// Rays that started where others get to by crossing the present body's surface.
    pub started_there: u8,
    /// Rays that scalar code must trace.
    pub given_up: u8,
}

impl Packet {
    /// The face is not known.
    pub const UNKNOWN: u32 = u32::MAX;

    /// The camera's rays through a point of each pixel; those not `wanted` are ignored.
    #[inline(always)]
    pub fn set_out<I: Isa>(
        &mut self,
        camera: &CameraRays,
        number: usize,
        tile: (f64, f64),
        place: (f64, f64),
        wanted: u8,
    ) {
        let (column, row) = corner_of(number);
        let x = F64s::<I>::splat(tile.0 + column as f64) + F64s::load(&LANE_X) + F64s::splat(place.0);
        let y = F64s::<I>::splat(tile.1 + row as f64) + F64s::load(&LANE_Y) + F64s::splat(place.1);
        // As CameraRays::ray.
        let (x, y) = (x - F64s::splat(camera.center.0), y - F64s::splat(camera.center.1));
        let one = |v: Vec3| Vector::<F64s<I>>::new(F64s::splat(v.x), F64s::splat(v.y), F64s::splat(v.z));
        let (right, down) = (one(camera.right), one(camera.down));
        let offset = Vector::new(right.x * x + down.x * y, right.y * x + down.y * y, right.z * x + down.z * y);
        let (eye, forward) = (one(camera.eye), one(camera.forward));
        let plus = |a: Vector<F64s<I>>| Vector::new(a.x + offset.x, a.y + offset.y, a.z + offset.z);
        let (origin, direction, per_depth) = match camera.orthographic {
            true => (plus(eye), forward, F64s::splat(1.0)),
            false => {
                let direction = plus(forward);
                let length = direction.dot(direction).sqrt();
                (eye, Vector::new(direction.x / length, direction.y / length, direction.z / length), length)
            }
        };
        let one = F64s::splat(1.0);
        let store = |v: Vector<F64s<I>>| [v.x.stored(), v.y.stored(), v.z.stored()];
        self.direction = store(direction);
        self.inverse = store(Vector::new(one / direction.x, one / direction.y, one / direction.z));
        if camera.orthographic {
            self.origin = store(origin);
        }
        self.per_depth = per_depth.stored();
        self.t = F64s::<I>::infinity().stored();
        self.wanted = wanted;
        self.met = 0;
        self.given_up = 0;
    }

    /// Its rays, seen from `from`; `eye` is where they start if they start at one point.
    #[inline(always)]
    pub fn rays<I: Isa, O: Origins<I>>(&self, eye: Vec3, from: Vec3) -> Rays<I, O::Number> {
        let [x, y, z] = &self.direction;
        Rays { origin: O::of(self, eye, from), direction: Vector::new(F64s::load(x), F64s::load(y), F64s::load(z)) }
    }

    /// Takes some of these rays.
    #[inline(always)]
    pub fn follow<I: Isa>(&mut self, rays: &EightRays, lanes: u8) {
        self.origin = Vector::<F64s<I>>::load(&rays.origin).stored();
        self.direction = Vector::<F64s<I>>::load(&rays.direction).stored();
        self.t = F64s::<I>::load(&rays.end).stored();
        (self.wanted, self.met, self.given_up) = (lanes, 0, 0);
    }

    /// Takes one of these rays.
    pub fn follow_one(&mut self, lane: usize, rays: &EightRays, from: usize) {
        for axis in 0..3 {
            self.origin[axis].0[lane] = rays.origin[axis].0[from];
            self.direction[axis].0[lane] = rays.direction[axis].0[from];
        }
        self.t.0[lane] = rays.end.0[from];
    }

    /// Has no rays.
    pub fn forget(&mut self) {
        (self.wanted, self.met, self.given_up) = (0, 0, 0);
    }

    /// Makes rays that it took ready to be followed up to and including their ends.
    #[inline(always)]
    pub fn prepare<I: Isa>(&mut self) {
        let one = F64s::<I>::splat(1.0);
        let [x, y, z] = &self.direction;
        self.inverse = [(one / F64s::load(x)).stored(), (one / F64s::load(y)).stored(), (one / F64s::load(z)).stored()];
        self.per_depth = one.stored();
        self.t = F64s::<I>::load(&self.t).next_up().stored();
    }

    /// Rays meet something, unless they have met something before.
    #[inline(always)]
    pub fn meet<I: Isa>(&mut self, rays: Mask<I>, t: F64s<I>, words: [u32; LANES], scenery: &Scenery) {
        let before = F64s::load(&self.t);
        let first = rays & t.lt(before);
        self.t = first.select(t, before).stored();
        // Not a closure: those may be compiled by themselves.
        let mut words = words;
        for word in &mut words {
            *word = word.wrapping_add(scenery.literal_shift);
        }
        self.words = first.select_words(words, self.words);
        self.bodies = first.select_words([scenery.body; LANES], self.bodies);
        self.note(first.bits(), scenery.wanted);
        // What is crossed at the very start is none of a ray's business; scalar code knows better what comes then.
        let at_start = rays & t.le(F64s::zero());
        if at_start.any() {
            self.give_up(at_start.bits());
        }
        self.open &= !rays.bits();
    }

    /// Notes for some rays that they have met something, which they enter or leave.
    #[inline(always)]
    fn note(&mut self, rays: u8, entering: bool) {
        self.met |= rays;
        self.entering = if entering { self.entering | rays } else { self.entering & !rays };
    }

    /// Open rays are already where they want to get to: they start there, or something is wrong.
    #[inline(always)]
    pub fn leak<I: Isa>(&mut self, rays: Mask<I>, t: F64s<I>) {
        let at_start = (rays & t.le(F64s::zero())).bits() & self.open;
        self.started_there |= at_start;
        self.open &= !at_start;
        self.give_up(rays.bits());
    }

    /// Leaves open rays to scalar code.
    #[inline(always)]
    pub fn give_up(&mut self, rays: u8) {
        self.given_up |= rays & self.open;
        self.open &= !rays;
    }

    /// A stretch with a program that lanes cannot evaluate. Of `meshes` it is known how the rays come into them.
    pub fn one_by_one(
        &mut self,
        scenery: &Scenery,
        words: &[u32],
        rays: u8,
        (origin, t_in, t_out): (&Vector<Stored>, &Stored, &Stored),
        meshes: &[Toggles],
        scratch: &mut Scratch,
    ) {
        for lane in (0..LANES).filter(|lane| rays >> lane & 1 != 0) {
            let at = |v: &Stored| v.0[lane];
            let [x, y, z] = &self.direction;
            let ray = Ray {
                origin: Vec3::new(at(&origin.x), at(&origin.y), at(&origin.z)),
                direction: Vec3::new(at(x), at(y), at(z)),
            };
            let (bit, roots) = (1 << lane, &mut scratch.roots);
            if at(t_in) <= 0.0 {
                // On which side it starts is for the march to find out.
                self.give_up(bit);
                continue;
            }
            roots.begin_ray();
            for toggles in meshes {
                toggles.tell(scenery.literal_shift, lane, at(t_out), roots);
            }
            roots.solve(scenery.catalog, words, &ray);
            scratch.counters.surface_tests += words.len() as u64;
            let t = roots.next(words, at(t_in), scenery.wanted);
            if t > at(t_out) || t == f64::INFINITY {
                continue;
            }
            let change = roots.change(words, t);
            match change.word {
                Some(word) if change.after == scenery.wanted => {
                    if t < self.t.0[lane] {
                        (self.t.0[lane], self.words[lane], self.bodies[lane]) =
                            (t, Word::shifted(word, scenery.literal_shift), scenery.body);
                        self.facets[lane] = Self::UNKNOWN;
                        self.note(bit, scenery.wanted);
                    }
                    self.open &= !bit;
                }
                _ => self.give_up(bit),
            }
        }
    }
}
