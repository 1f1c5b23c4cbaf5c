//! Hulls of which parts only have an exact form: of slanted discs, of balls and discs side by side, of different rings.
//!
//! Some of the things together are of a kind whose hull is known exactly, see [`kinds`](super::kinds); each by itself is.
//! First the hull of points on all things is made. Facets whose corners are all on things of one kind are forgotten: the
//! exact hull of these things stands for them. The others show between which things planes roll, and where; there are
//! strips, see [`strips`](super::strips).
//!
//! So the hull is the union of exact hulls and of the convex polyhedron of the points where strips and facets touch. Each of
//! these lies in the hull; and what is between the polyhedron and the surface of the hull is above points of one kind.

use super::super::convex::convex;
use super::exact;
use super::kinds::{Kind, kinds};
use super::net::Net;
use super::strips::{Precision, Ruling, rulings};
use super::support::{Thing, touch};
use crate::Tolerance;
use crate::space::round::Extremes;
use octrace::{Solid, Vec3};
use std::collections::BTreeSet;

/// Lengths below this share of the size are rounding.
const NOISE: f64 = 1e-12;

/// How far strips may be off, as a share of the tolerance: volumes are off by several times as much.
pub(in crate::space) const STRIPS: f64 = 0.25;

/// The hull; `None` where it has no volume.
pub(super) fn hull(extremes: &Extremes, tolerance: Tolerance) -> Option<Solid> {
    let size = extremes.size();
    let mut things: Vec<Thing> = extremes.rounds.iter().copied().map(Thing::Round).collect();
    things.extend(extremes.points.iter().copied().map(Thing::Corner));
    let net = Net::new(extremes, tolerance.relative * size)?;
    let kinds = kinds(&extremes.rounds);
    let mut patches = Patches {
        precision: Precision { deviation: STRIPS * tolerance.relative * size, noise: NOISE * size },
        kind_of: net.triangles.iter().map(|t| kind_of(&kinds, &things, t.map(|v| net.owners[v as usize]))).collect(),
        things,
        net,
        touched: Vec::new(),
    };
    patches.add_seams();
    patches.add_facets();
    patches.add_strips(&kinds);
    let mut parts: Vec<Solid> = convex(&patches.touched).map(Solid::primitive).into_iter().collect();
    parts.extend(patches.exact_hulls(&kinds));
    Some(Solid::union(parts))
}

/// Whether all of the things are of that kind.
fn holds(kind: &Kind, things: &[Thing], mut which: impl Iterator<Item = usize>) -> bool {
    which.all(|i| match things[i] {
        Thing::Corner(_) => kind.takes_corners,
        Thing::Round(_) => kind.members.contains(&i),
    })
}

/// The first kind of which these things are. Corners alone are of none.
fn kind_of(kinds: &[Kind], things: &[Thing], which: [usize; 3]) -> Option<usize> {
    let round = which.iter().any(|&i| matches!(things[i], Thing::Round(_)));
    kinds.iter().position(|kind| round && holds(kind, things, which.into_iter()))
}

/// What the facets of a net are good for.
struct Patches {
    precision: Precision,
    things: Vec<Thing>,
    net: Net,
    /// The kind of which all corners of a triangle are.
    kind_of: Vec<Option<usize>>,
    /// The points where strips and facets touch.
    touched: Vec<Vec3>,
}

impl Patches {
    /// Corners at which kinds meet without a strip between them.
    fn add_seams(&mut self) {
        let mut seen: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); self.net.points.len()];
        for (triangle, kind) in self.net.triangles.iter().zip(&self.kind_of) {
            triangle.iter().for_each(|&v| seen[v as usize].extend(*kind));
        }
        let seams = seen.iter().zip(&self.net.points).filter(|(kinds, _)| kinds.len() > 1);
        self.touched.extend(seams.map(|(_, point)| *point));
    }

    /// Flat facets, between three things or among corners.
    fn add_facets(&mut self) {
        for triangle in self.loose() {
            match self.net.distinct(triangle) {
                [_, Some(_), None] => {}
                [Some(a), Some(b), Some(c)] => {
                    let things = [a, b, c].map(|i| self.things[i]);
                    match touch(&things, self.net.normal(triangle), self.precision.noise) {
                        Some(facet) => self.touched.extend(facet.points),
                        None => self.add_as_it_is(triangle),
                    }
                }
                _ => self.add_as_it_is(triangle),
            }
        }
    }

    /// Strips between two things that are not of one kind.
    fn add_strips(&mut self, kinds: &[Kind]) {
        for ([a, b], chains) in self.net.chains() {
            if kinds.iter().any(|kind| holds(kind, &self.things, [a, b].into_iter())) {
                continue;
            }
            let things = [self.things[a], self.things[b]];
            for chain in chains {
                let mut found: Vec<Ruling> = Vec::new();
                for triangle in chain {
                    match touch(&things, self.net.normal(triangle), self.precision.noise) {
                        Some(ruling) => found.push(ruling),
                        None => self.add_as_it_is(triangle),
                    }
                }
                let strips = rulings(&things, &found, self.precision);
                self.touched.extend(strips.iter().flat_map(|ruling| ruling.points));
            }
        }
    }

    /// The triangles that are of no kind.
    fn loose(&self) -> Vec<usize> {
        (0..self.kind_of.len()).filter(|&triangle| self.kind_of[triangle].is_none()).collect()
    }

    fn add_as_it_is(&mut self, triangle: usize) {
        self.touched.extend(self.net.triangles[triangle].map(|v| self.net.points[v as usize]));
    }

    /// The hulls of what is of one kind, as far as it is seen.
    fn exact_hulls(&self, kinds: &[Kind]) -> Vec<Solid> {
        let mut members: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); kinds.len()];
        for (triangle, kind) in self.net.triangles.iter().zip(&self.kind_of) {
            let owners = triangle.map(|v| self.net.owners[v as usize]);
            if let Some(kind) = kind {
                members[*kind].extend(owners);
            }
            // What is too small to have a facet of its own.
            for owner in owners {
                if let Some(kind) = kind_of(kinds, &self.things, [owner; 3]) {
                    members[kind].insert(owner);
                }
            }
        }
        let hull = |members: &BTreeSet<usize>| {
            let mut some = Extremes::default();
            for &member in members {
                match self.things[member] {
                    Thing::Corner(point) => some.points.push(point),
                    Thing::Round(round) => some.rounds.push(round),
                }
            }
            exact(&some, self.precision.deviation)
        };
        members.iter().filter(|members| !members.is_empty()).filter_map(hull).collect()
    }
}
