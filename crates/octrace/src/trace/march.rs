//! Marching along a ray through the cells of an octree, and through what lies outside it.

use super::Scratch;
use super::body::Body;
use super::roots::hit_of;
use crate::compile::{Catalog, Constant, Program, Word};
use crate::geom::{Hit, Ray};
use crate::octree::{Cell, Octree};
use crate::surface::Placed;
use crate::traverse::{Step, Traversal, interval, root_interval};
use std::ops::ControlFlow;

/// Why a march ended before its end.
pub(crate) enum Stop<B> {
    /// The visitor has what it wants.
    Done(B),
    /// The cells contradict each other: something changed where nothing is crossed. Never seen in tests; the ray is
    /// traced canonically then, and counted.
    Leak,
}

/// What of the copies of solids a march has been through.
#[derive(Clone, Copy)]
enum Passed {
    /// Parts, cell by cell.
    Parts,
    /// All of the latest, given by its word.
    Copy(Option<u32>),
}

/// In programs of up to so many words, changes are looked for one after another: mostly the first is all that is wanted.
/// In longer ones that may begin anew for every crossing, at every operator.
const SHORT: usize = 32;

/// One ray on its way: whether it is inside is known from the first cell on and changes at crossings only.
pub(crate) struct March<'a> {
    catalog: &'a Catalog,
    prototypes: &'a [Body],
    scratch: &'a mut Scratch,
    /// The ray in the scene.
    ray: &'a Ray,
    /// The ray where the march is: in a copy of a solid, in the solid's own coordinates.
    ray_here: Ray,
    /// What is added to the numbers of literals where the march is.
    literal_shift: u32,
    passed: Passed,
    /// Where the march ends.
    end: f64,
    inside: Option<bool>,
}

impl<'a> March<'a> {
    pub fn new(catalog: &'a Catalog, prototypes: &'a [Body], ray: &'a Ray, scratch: &'a mut Scratch) -> Self {
        scratch.roots.begin_ray();
        Self {
            catalog,
            prototypes,
            scratch,
            ray,
            ray_here: *ray,
            literal_shift: 0,
            passed: Passed::Parts,
            end: f64::INFINITY,
            inside: None,
        }
    }

    /// Shows `on_hit` the crossings after `start` up to `end`, in order, until it breaks off.
    pub fn along<B>(
        &mut self,
        program: &Program,
        accelerator: Option<(&Octree, &Traversal)>,
        (start, end): (f64, f64),
        mut on_hit: impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<Stop<B>> {
        self.end = end;
        self.passed = match accelerator {
            Some((octree, _)) if !octree.has_mixed_leaves => Passed::Copy(None),
            _ => Passed::Parts,
        };
        let interval = accelerator.and_then(|(octree, walk)| Some((octree, walk, root_interval(octree, self.ray)?)));
        let Some((octree, traversal, (root_in, root_out))) = interval else {
            return self.constant(&program.outer, start, end, &mut on_hit);
        };
        let (t_in, t_out) = (root_in.max(start), root_out.min(end));
        if t_in > t_out {
            // The root lies behind the start, or beyond the end.
            return self.constant(&program.outer, start, end, &mut on_hit);
        }
        if start < root_in {
            self.constant(&program.outer, start, t_in, &mut on_hit)?;
        }
        traversal.walk(octree, self.ray, t_in, t_out, |Step { cell, t_in, t_out, .. }| {
            self.scratch.counters.cells += 1;
            match cell {
                Cell::Outside => self.settled(false),
                Cell::Inside => self.settled(true),
                Cell::Leaf(words) => self.leaf(words, t_in, t_out, &mut on_hit),
            }
        })?;
        if root_out < end { self.constant(&program.outer, t_out, end, &mut on_hit) } else { ControlFlow::Continue(()) }
    }

    fn constant<B>(
        &mut self,
        program: &Constant,
        t_in: f64,
        t_out: f64,
        on_hit: &mut impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<Stop<B>> {
        match program {
            Constant::Everywhere(inside) => self.settled(*inside),
            Constant::Words(words) => self.words(words, t_in, t_out, on_hit),
        }
    }

    /// A stretch with the program of a cell.
    fn leaf<B>(
        &mut self,
        words: &[u32],
        t_in: f64,
        t_out: f64,
        on_hit: &mut impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<Stop<B>> {
        if let ([word], false) = (words, self.prototypes.is_empty())
            && let Some(placed) = self.catalog.placed_by(*word)
            && let Some(cells) = self.prototypes[placed.prototype as usize].octree_and_traversal()
        {
            return self.copy(*word, placed, cells, (t_in, t_out), on_hit);
        }
        self.words(words, t_in, t_out, on_hit)
    }

    /// A stretch with nothing but one copy of a solid: the march goes on in the solid's own octree. In a copy's box there is
    /// nothing else, so it goes through all of the copy at once, where the ray comes to that box.
    fn copy<B>(
        &mut self,
        word: u32,
        placed: &Placed,
        (octree, traversal): (&Octree, &Traversal),
        (t_in, mut t_out): (f64, f64),
        on_hit: &mut impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<Stop<B>> {
        if let Passed::Copy(passed) = &mut self.passed {
            match interval(&placed.bounds, self.ray) {
                _ if *passed == Some(word) => return ControlFlow::Continue(()),
                Some((from, to)) if from <= t_out && t_in <= to => {
                    *passed = Some(word);
                    t_out = self.end;
                }
                _ => return self.settled(false),
            }
        }
        let ray = placed.ray(self.ray);
        let stretch = root_interval(octree, &ray).map(|(root_in, root_out)| (root_in.max(t_in), root_out.min(t_out)));
        let Some((from, to)) = stretch.filter(|(from, to)| from <= to) else { return self.settled(false) };
        if t_in < from {
            self.settled(false)?;
        }
        self.scratch.roots.begin_ray();
        self.ray_here = ray;
        self.literal_shift = self.catalog.prototype(placed).literal_shift(placed.copy);
        traversal.walk(octree, &ray, from, to, |Step { cell, t_in, t_out, .. }| {
            self.scratch.counters.cells += 1;
            match cell {
                Cell::Outside => self.settled(false),
                Cell::Inside => self.settled(true),
                Cell::Leaf(words) => self.words(words, t_in, t_out, on_hit),
            }
        })?;
        self.scratch.roots.begin_ray();
        (self.ray_here, self.literal_shift) = (*self.ray, 0);
        if to < t_out { self.settled(false) } else { ControlFlow::Continue(()) }
    }

    /// A stretch that is all inside or all outside.
    fn settled<B>(&mut self, inside: bool) -> ControlFlow<Stop<B>> {
        match *self.inside.get_or_insert(inside) == inside {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(Stop::Leak),
        }
    }

    /// A stretch with a program. Crossings exactly at either end count; one at the end of a stretch is not found again at
    /// the start of the next, since the ray is on its other side then.
    fn words<B>(
        &mut self,
        words: &[u32],
        t_in: f64,
        t_out: f64,
        on_hit: &mut impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<Stop<B>> {
        self.scratch.roots.solve(self.catalog, words, &self.ray_here);
        self.scratch.counters.surface_tests += words.len() as u64;
        match words.len() <= SHORT {
            true => self.step(words, t_in, t_out, on_hit),
            false => self.sweep(words, t_in, t_out, on_hit),
        }
    }

    /// [`words`](Self::words), from change to change of the program.
    fn step<B>(
        &mut self,
        words: &[u32],
        t_in: f64,
        t_out: f64,
        on_hit: &mut impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<Stop<B>> {
        let mut inside = match self.inside {
            Some(inside) => inside,
            None => self.scratch.roots.inside_after(words, t_in),
        };
        self.inside = Some(inside);
        let mut from = t_in;
        loop {
            let t = self.scratch.roots.next(words, from, !inside);
            if t > t_out || t == f64::INFINITY {
                return ControlFlow::Continue(());
            }
            let change = self.scratch.roots.change(words, t);
            let (Some(word), true) = (change.word, change.after != inside) else {
                return ControlFlow::Break(Stop::Leak);
            };
            inside = change.after;
            self.cross(word, t, inside, on_hit)?;
            from = t;
        }
    }

    /// [`words`](Self::words), from crossing to crossing of its literals.
    fn sweep<B>(
        &mut self,
        words: &[u32],
        t_in: f64,
        t_out: f64,
        on_hit: &mut impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<Stop<B>> {
        let Scratch { roots, sweep, .. } = &mut *self.scratch;
        sweep.begin(words, roots, t_in, t_out);
        let seen_at_start = if sweep.next_t() == Some(t_in) { sweep.pass() } else { None };
        let mut inside = sweep.is_inside();
        if *self.inside.get_or_insert(inside) != inside {
            let Some(at) = seen_at_start else {
                return ControlFlow::Break(Stop::Leak);
            };
            self.cross(words[at], t_in, inside, on_hit)?;
        }
        while let Some(t) = self.scratch.sweep.next_t() {
            if let Some(at) = self.scratch.sweep.pass() {
                inside = !inside;
                self.cross(words[at], t, inside, on_hit)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Shows `on_hit` that the literal `word` is crossed, so that the ray is `inside` from `t` on.
    fn cross<B>(
        &mut self,
        word: u32,
        t: f64,
        inside: bool,
        on_hit: &mut impl FnMut(Hit) -> ControlFlow<B>,
    ) -> ControlFlow<Stop<B>> {
        self.inside = Some(inside);
        match on_hit(hit_of(self.catalog, Word::shifted(word, self.literal_shift), self.ray, t, inside)) {
            ControlFlow::Break(done) => ControlFlow::Break(Stop::Done(done)),
            ControlFlow::Continue(()) => ControlFlow::Continue(()),
        }
    }
}
