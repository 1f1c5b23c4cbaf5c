//! What is left of a leaf's program for a tile's rays.
//!
//! Of a cell that is larger than a tile, the tile's rays see a sliver. Each of the eight parts of the tile's beam, cut off
//! at the depths of the cell, lies in a parallelepiped, as do bundles of rays of a stream; surfaces are classified against all eight at once, as cells are
//! ([`Surface::classify`]), and boolean algebra does the rest. No literal takes the place of another, so what is seen where
//! several are crossed at once stays the same.

use super::beam::Beam;
use super::crossing::{point, vector};
use super::lanes::{F64s, Isa, LANES, Vector};
use super::program::{MAX_LEVELS, MAX_WORDS, surface_of};
use crate::compile::{Catalog, Word, node_end};
use crate::geom::{Affine, Vec3};
use crate::surface::{CellBox, Plane, Quadric, QuadricKind, Surface};

/// Eight parts of space, each a parallelepiped: along some rays between two depths, and some way across.
pub(super) struct Parts<I: Isa, A> {
    /// The rays in the middles.
    pub origin: Vector<F64s<I>>,
    pub direction: Vector<F64s<I>>,
    /// Depths of the middles, and half their range.
    pub depth: F64s<I>,
    pub half_depth: F64s<I>,
    /// How far they reach across.
    pub across: A,
    pub margin: f64,
}

/// How far parts reach across.
pub(super) trait Across<I: Isa> {
    /// By how much points differ at most from the middle, times that vector.
    fn reach(&self, along: Vec3) -> F64s<I>;
    /// By how much they differ at most in local coordinates, times that slope.
    fn change(&self, map: &Affine, slope: Vector<F64s<I>>) -> F64s<I>;
}

/// All parts are as wide: half their extents along the film.
pub(super) struct Film {
    pub sides: [Vec3; 2],
}

/// Each part reaches as far along the axes as a box does.
pub(super) struct Boxes<I: Isa> {
    pub half: Vector<F64s<I>>,
}

impl<I: Isa> Across<I> for Film {
    #[inline(always)]
    fn reach(&self, along: Vec3) -> F64s<I> {
        F64s::splat(along.dot(self.sides[0]).abs() + along.dot(self.sides[1]).abs())
    }

    #[inline(always)]
    fn change(&self, map: &Affine, slope: Vector<F64s<I>>) -> F64s<I> {
        let [a, b] = self.sides.map(|side| map.vector(side));
        Vector::<F64s<I>>::from_one(a).dot(slope).abs() + Vector::<F64s<I>>::from_one(b).dot(slope).abs()
    }
}

impl<I: Isa> Across<I> for Boxes<I> {
    #[inline(always)]
    fn reach(&self, along: Vec3) -> F64s<I> {
        Vector::<F64s<I>>::from_one(along.abs()).dot(self.half)
    }

    #[inline(always)]
    fn change(&self, map: &Affine, slope: Vector<F64s<I>>) -> F64s<I> {
        let x = Vector::<F64s<I>>::from_one(map.column(0)).dot(slope).abs();
        let y = Vector::<F64s<I>>::from_one(map.column(1)).dot(slope).abs();
        let z = Vector::<F64s<I>>::from_one(map.column(2)).dot(slope).abs();
        Vector::new(x, y, z).dot(self.half)
    }
}

impl<I: Isa> Parts<I, Film> {
    /// The parts of a beam between the depths, with a margin all around, seen from `from`.
    #[inline(always)]
    pub fn of_beam(beam: &Beam, (near, far): (f64, f64), margin: f64, from: Vec3) -> Self {
        let (origin, direction) = beam.middles();
        let origin = origin.minus::<I>(from);
        let sides = match beam.parallel {
            true => beam.half_part,
            false => beam.half_part.map(|side| side * far),
        };
        let (depth, half_depth) = (F64s::splat(0.5 * (near + far)), F64s::splat(0.5 * (far - near)));
        Self { origin, direction, depth, half_depth, across: Film { sides }, margin }
    }
}

impl<I: Isa, A: Across<I>> Parts<I, A> {
    /// In which parts a plane's inside is everywhere, and in which it is nowhere.
    #[inline(always)]
    fn plane(&self, plane: &Plane) -> (u8, u8) {
        let normal = Vector::<F64s<I>>::from_one(plane.normal);
        let slope = normal.dot(self.direction);
        let height = normal.dot(self.origin) - F64s::splat(plane.offset) + slope * self.depth;
        let margin = plane.normal.abs().dot(Vec3::splat(self.margin));
        let reach = slope.abs() * self.half_depth + self.across.reach(plane.normal) + F64s::splat(margin);
        (height.le(-reach).bits(), height.ge(reach).bits())
    }

    /// The same for a quadric; see [`Quadric::classify`].
    #[inline(always)]
    fn quadric(&self, quadric: &Quadric) -> (u8, u8) {
        let map = &quadric.to_local;
        let (s, c0) = quadric.kind.coefficients();
        let along = vector(map, self.direction);
        let origin = point(map, self.origin);
        let at = |o: F64s<I>, d: F64s<I>| o + d * self.depth;
        let q = Vector::new(at(origin.x, along.x), at(origin.y, along.y), at(origin.z, along.z));
        let along = along.map(|v| v * self.half_depth);
        // What the margin, and what rounding, may come to in local coordinates.
        let margin = Vec3::from(map.rows.map(|row| row.abs().dot(Vec3::splat(self.margin))));
        let extra = margin + margin * CellBox::ROUNDING_IN_MARGINS;
        let reach = Vector::new(
            along.x.abs() + self.across.reach(map.rows[0]) + F64s::splat(extra.x),
            along.y.abs() + self.across.reach(map.rows[1]) + F64s::splat(extra.y),
            along.z.abs() + self.across.reach(map.rows[2]) + F64s::splat(extra.z),
        );
        // The mean value form: the parts are thin, and where they are long they are cut.
        let (s_lanes, c0, two) = (F64s::splat(s), F64s::splat(c0), F64s::splat(2.0));
        let value = q.x * q.x + q.y * q.y + s_lanes * (q.z * q.z) + c0;
        let slope = Vector::new(two * q.x, two * q.y, two * s_lanes * q.z);
        let linear = slope.dot(along).abs()
            + self.across.change(map, slope)
            + slope.x.abs() * F64s::splat(extra.x)
            + slope.y.abs() * F64s::splat(extra.y)
            + slope.z.abs() * F64s::splat(extra.z);
        let (flat, up) = (reach.x * reach.x + reach.y * reach.y, reach.z * reach.z);
        let (bulge_low, bulge_high) = match quadric.kind {
            QuadricKind::Sphere => (F64s::zero(), flat + up),
            QuadricKind::Cylinder => (F64s::zero(), flat),
            QuadricKind::Cone => (-up, flat),
        };
        let zero = F64s::zero();
        let outside = (value - linear + bulge_low).ge(zero).bits();
        let inside = (value + linear + bulge_high).le(zero).bits();
        (inside & !outside, outside)
    }
}

/// What a program is in eight parts of space: for each of its nodes a bit for each part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    /// Where the node is true.
    always: [u8; MAX_WORDS],
    /// Where it is false.
    never: [u8; MAX_WORDS],
}

impl Known {
    pub fn nothing() -> Self {
        Self { always: [0; MAX_WORDS], never: [0; MAX_WORDS] }
    }

    /// Finds out about a program of at most [`MAX_WORDS`] words.
    #[inline(always)]
    pub fn learn<I: Isa, A: Across<I>>(&mut self, catalog: &Catalog, words: &[u32], parts: &Parts<I, A>) {
        // Children come behind their operators.
        for at in (0..words.len().min(MAX_WORDS)).rev() {
            let (always, never) = match Word::decode(words[at]) {
                Word::Literal { negated, .. } => {
                    let (inside, outside) = match surface_of(catalog, words[at]) {
                        Some(Surface::Plane(plane)) => parts.plane(plane),
                        Some(Surface::Quadric(quadric)) => parts.quadric(quadric),
                        Some(Surface::Torus(_) | Surface::Mesh(_) | Surface::Placed(_)) | None => (0, 0),
                    };
                    if negated { (outside, inside) } else { (inside, outside) }
                }
                operator => {
                    let is_and = matches!(operator, Word::And { .. });
                    let (mut all, mut any) = (u8::MAX, 0);
                    let mut child = at + 1;
                    while child < node_end(words, at) {
                        let (agreeing, absorbing) = match is_and {
                            true => (self.always[child], self.never[child]),
                            false => (self.never[child], self.always[child]),
                        };
                        (all, any) = (all & agreeing, any | absorbing);
                        child = node_end(words, child);
                    }
                    if is_and { (all, any) } else { (any, all) }
                }
            };
            (self.always[at], self.never[at]) = (always, never);
        }
    }

    /// Where the whole program is true, and where it is false.
    #[inline(always)]
    pub fn decided(&self) -> (u8, u8) {
        (self.always[0], self.never[0])
    }

    /// Those of `among` where all of the program is as in the lowest of them.
    #[inline(always)]
    pub fn alike(&self, words: &[u32], among: u8) -> u8 {
        let first = among & among.wrapping_neg();
        let same = |bits: u8| if bits & first == 0 { !bits } else { bits };
        let mut alike = among;
        for at in 0..words.len() {
            alike &= same(self.always[at]) & same(self.never[at]);
        }
        alike
    }

    /// Those of `among` where more than one literal matters.
    #[inline(always)]
    pub fn crowded(&self, words: &[u32], among: u8) -> u8 {
        let (mut one, mut more) = (0, 0);
        for (at, &word) in words.iter().enumerate() {
            if matches!(Word::decode(word), Word::Literal { .. }) {
                let matters = !(self.always[at] | self.never[at]);
                more |= one & matters;
                one |= matters;
            }
        }
        more & among
    }

    /// What is left of the program in some parts.
    pub fn pruned(&self, words: &[u32], parts: u8) -> Pruned {
        let mut left = Pruned::NOTHING;
        let mut at = 0;
        // Operators that are open: their header's place, how many children they have so far, and their end.
        let mut open: [(usize, usize, usize); MAX_LEVELS] = [(0, 0, usize::MAX); MAX_LEVELS];
        let mut levels = 0;
        loop {
            while levels > 0 && at >= open[levels - 1].2 {
                levels -= 1;
                let (header, children, _) = open[levels];
                left.close(header, children);
            }
            if at >= words.len() {
                return left;
            }
            if self.always[at] & parts == parts || self.never[at] & parts == parts {
                at = node_end(words, at);
                continue;
            }
            if levels > 0 {
                open[levels - 1].1 += 1;
            }
            if !matches!(Word::decode(words[at]), Word::Literal { .. }) {
                open[levels] = (left.len, 0, node_end(words, at));
                levels += 1;
            }
            left.words[left.len] = words[at];
            left.len += 1;
            at += 1;
        }
    }
}

/// A pruned program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pruned {
    words: [u32; MAX_WORDS],
    len: usize,
}

impl Pruned {
    pub const NOTHING: Self = Self { words: [0; MAX_WORDS], len: 0 };

    /// The program as it is.
    pub fn new(words: &[u32]) -> Self {
        let mut pruned = Self { len: words.len(), ..Self::NOTHING };
        pruned.words[..words.len()].copy_from_slice(words);
        pruned
    }

    pub fn words(&self) -> &[u32] {
        &self.words[..self.len]
    }

    /// All children of the operator at `header` are there: so many.
    fn close(&mut self, header: usize, children: usize) {
        if children == 1 {
            self.words.copy_within(header + 1..self.len, header);
            self.len -= 1;
            return;
        }
        let len = (self.len - header - 1) as u32;
        self.words[header] = match Word::decode(self.words[header]) {
            Word::And { .. } => Word::And { len },
            _ => Word::Or { len },
        }
        .encode();
    }
}

const _: () = assert!(LANES == u8::BITS as usize);
