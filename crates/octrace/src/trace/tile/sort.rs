//! The rays of a stream, sorted into those that meet the cells of an octree in the same order.

use super::dispatch::Task;
use super::eight::EightRays;
use super::lanes::{F64s, Isa, LANES, Vector};
use crate::geom::Bounds;
use crate::trace::prepared::Usual;

/// The rays of a stream, sorted. A ray's number is that of its eight, times the lanes, plus its lane.
#[derive(Debug, Default)]
pub(super) struct Sorted {
    /// By the signs of their directions, a bit for each that is negative.
    pub alike: [Alike; 8],
    /// Those that must be traced by themselves.
    pub alone: Vec<u32>,
}

/// Rays whose directions have the same signs.
#[derive(Debug, Default)]
pub(super) struct Alike {
    /// The better part of eights: their numbers, and the lanes.
    pub together: Vec<(u32, u8)>,
    /// Single rays.
    pub loose: Vec<u32>,
}

/// Of fewer rays of an eight, each is loose.
const TOGETHER: u32 = 4;

/// Sorts rays.
pub(super) struct Sort<'a> {
    /// Which rays can be traced together; `None` if none can.
    pub usual: Option<Usual>,
    /// Rays that do not come here meet nothing.
    pub room: Option<Bounds>,
    pub rays: &'a [EightRays],
    pub sorted: &'a mut Sorted,
}

impl Task for Sort<'_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { usual, room, rays, sorted } = self;
        for (number, eight) in (0_u32..).zip(rays) {
            let usual = match &usual {
                Some(usual) if eight.lanes != 0 => usual_lanes::<I>(usual, eight) & eight.lanes,
                _ => 0,
            };
            let first = number * LANES as u32;
            let mut left = eight.lanes & !usual;
            while left != 0 {
                sorted.alone.push(first + left.trailing_zeros());
                left &= left - 1;
            }
            // Not by a closure: those may be compiled by themselves.
            let [x, y, z] = &eight.direction;
            let signs = [F64s::<I>::load(x).signs(), F64s::<I>::load(y).signs(), F64s::<I>::load(z).signs()];
            let mut left = match &room {
                Some(room) if usual != 0 => usual & coming::<I>(room, eight),
                _ => usual,
            };
            while left != 0 {
                let lane = left.trailing_zeros();
                // All lanes that have the same signs.
                let mut same = left;
                let mut alike = 0;
                for (axis, signs) in signs.iter().enumerate() {
                    let sign = signs >> lane & 1;
                    alike |= usize::from(sign) << axis;
                    same &= if sign != 0 { *signs } else { !signs };
                }
                left &= !same;
                let Alike { together, loose } = &mut sorted.alike[alike];
                if same.count_ones() >= TOGETHER {
                    together.push((number, same));
                    continue;
                }
                while same != 0 {
                    loose.push(first + same.trailing_zeros());
                    same &= same - 1;
                }
            }
        }
    }
}

/// The rays that come through a box.
#[inline(always)]
fn coming<I: Isa>(room: &Bounds, rays: &EightRays) -> u8 {
    let (mut t_in, mut t_out) = (F64s::<I>::zero(), F64s::load(&rays.end));
    for axis in 0..3 {
        let inverse = F64s::splat(1.0) / F64s::<I>::load(&rays.direction[axis]);
        let origin = F64s::load(&rays.origin[axis]);
        let low = (F64s::splat(room.min[axis]) - origin) * inverse;
        let high = (F64s::splat(room.max[axis]) - origin) * inverse;
        let forward = inverse.gt(F64s::zero());
        // A ray in one of the planes has no number there, and no bound.
        t_in = t_in.max(forward.select(low, high));
        t_out = t_out.min(forward.select(high, low));
    }
    t_in.le(t_out).bits()
}

/// As [`Usual::holds`], of rays that have a stretch to be followed along.
#[inline(always)]
fn usual_lanes<I: Isa>(usual: &Usual, rays: &EightRays) -> u8 {
    let (origin, direction) = (Vector::<F64s<I>>::load(&rays.origin), Vector::<F64s<I>>::load(&rays.direction));
    let (least, most) = (F64s::splat(Usual::DIRECTIONS.start), F64s::splat(Usual::DIRECTIONS.end));
    let largest = direction.max_abs();
    let away = (Vector::from_one(usual.center) - origin).max_abs();
    let ahead = F64s::load(&rays.end).gt(F64s::zero());
    (largest.ge(least) & largest.lt(most) & away.le(F64s::splat(usual.far)) & ahead).bits()
}
