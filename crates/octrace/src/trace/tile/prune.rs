//! What is left of a leaf's program for a tile's rays.
//!
//! Of a cell that is larger than a tile, the tile's rays see a sliver. Each of the eight parts of the tile's beam, cut off
//! at the depths of the cell, lies in a parallelepiped; surfaces are classified against all eight at once, as cells are
//! ([`Surface::classify`]), and boolean algebra does the rest. No literal takes the place of another, so what is seen where
//! several are crossed at once stays the same.

use super::beam::Beam;
use super::crossing::{point, vector};
use super::lanes::{F64s, Isa, LANES, Vector};
use super::program::{MAX_LEVELS, MAX_WORDS, surface_of};
use crate::compile::{Catalog, Word, node_end};
use crate::geom::Vec3;
use crate::surface::{CellBox, Plane, Quadric, QuadricKind, Surface};

/// The eight parts of a beam between two depths, each in a parallelepiped.
pub(super) struct Parts<I: Isa> {
    origin: Vector<F64s<I>>,
    direction: Vector<F64s<I>>,
    /// Depths of the middles, and half their range.
    depth: f64,
    half_depth: f64,
    /// Half the extents along the film.
    sides: [Vec3; 2],
    margin: f64,
}

impl<I: Isa> Parts<I> {
    /// The parts between the depths, with a margin all around, seen from `from`.
    #[inline(always)]
    pub fn new(beam: &Beam, (near, far): (f64, f64), margin: f64, from: Vec3) -> Self {
        let (origin, direction) = beam.middles();
        let origin = origin.minus::<I>(from);
        let sides = match beam.parallel {
            true => beam.half_part,
            false => beam.half_part.map(|side| side * far),
        };
        Self { origin, direction, depth: 0.5 * (near + far), half_depth: 0.5 * (far - near), sides, margin }
    }

    /// Whether they are so much deeper than wide that it pays to cut them.
    #[inline(always)]
    pub fn is_deep(&self) -> bool {
        self.half_depth > 4.0 * self.sides[0].max_abs()
    }

    /// In which parts a plane's inside is everywhere, and in which it is nowhere.
    #[inline(always)]
    fn plane(&self, plane: &Plane) -> (u8, u8) {
        let normal = Vector::<F64s<I>>::from_one(plane.normal);
        let slope = normal.dot(self.direction);
        let height = normal.dot(self.origin) - F64s::splat(plane.offset) + slope * F64s::splat(self.depth);
        let across = self.sides[0].dot(plane.normal).abs() + self.sides[1].dot(plane.normal).abs();
        let margin = plane.normal.abs().dot(Vec3::splat(self.margin));
        let reach = slope.abs() * F64s::splat(self.half_depth) + F64s::splat(across + margin);
        (height.le(-reach).bits(), height.ge(reach).bits())
    }

    /// The same for a quadric; see [`Quadric::classify`].
    #[inline(always)]
    fn quadric(&self, quadric: &Quadric) -> (u8, u8) {
        let map = &quadric.to_local;
        let (s, c0) = quadric.kind.coefficients();
        let along = vector(map, self.direction);
        let origin = point(map, self.origin);
        let (depth, half_depth) = (F64s::splat(self.depth), F64s::splat(self.half_depth));
        let at = |o: F64s<I>, d: F64s<I>| o + d * depth;
        let q = Vector::new(at(origin.x, along.x), at(origin.y, along.y), at(origin.z, along.z));
        let along = along.map(|v| v * half_depth);
        let sides = self.sides.map(|side| map.vector(side));
        // What the margin, and what rounding, may come to in local coordinates.
        let margin = Vec3::from(map.rows.map(|row| row.abs().dot(Vec3::splat(self.margin))));
        let rounding = margin * CellBox::ROUNDING_IN_MARGINS;
        let fixed = sides[0].abs() + sides[1].abs() + margin + rounding;
        let reach = Vector::new(
            along.x.abs() + F64s::splat(fixed.x),
            along.y.abs() + F64s::splat(fixed.y),
            along.z.abs() + F64s::splat(fixed.z),
        );
        // The mean value form: the parts are thin, and where they are long they are cut.
        let (s_lanes, c0, two) = (F64s::splat(s), F64s::splat(c0), F64s::splat(2.0));
        let value = q.x * q.x + q.y * q.y + s_lanes * (q.z * q.z) + c0;
        let slope = Vector::new(two * q.x, two * q.y, two * s_lanes * q.z);
        let along_slope =
            |v: Vec3| (slope.x * F64s::splat(v.x) + slope.y * F64s::splat(v.y) + slope.z * F64s::splat(v.z)).abs();
        let extra = margin + rounding;
        let linear = (slope.x * along.x + slope.y * along.y + slope.z * along.z).abs()
            + along_slope(sides[0])
            + along_slope(sides[1])
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
    pub fn learn<I: Isa>(&mut self, catalog: &Catalog, words: &[u32], parts: &Parts<I>) {
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
