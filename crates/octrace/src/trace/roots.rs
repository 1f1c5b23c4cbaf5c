//! Where one ray crosses the surfaces of one program, and what follows: without lists of spans.
//!
//! As sets of parameters, insides are half-open. So "the first parameter from `t` on at which the program is inside" needs
//! no sorting: for a literal it is looked up, for `Or` it is the least of the children's, for `And` the least fixpoint of
//! asking the children in turn. The answer is one of the roots, bit for bit the one that combining span lists finds.

use super::canonical::{copy_spans, ends};
use crate::compile::{Catalog, Word, node_end};
use crate::geom::{Hit, Ray};
use crate::primitive::Crossing;
use crate::surface::{Sides, Surface, mesh_toggles};
use std::ops::Range;

/// The crossings of one ray with the literals of one program; scratch memory of a worker.
#[derive(Debug, Default)]
pub(crate) struct Roots {
    /// For every word of the program; operators have an empty row.
    rows: Vec<Row>,
    params: Vec<f64>,
    /// Meshes and whole solids that this ray has met already, and where it crosses them: they reach through many cells.
    wholes: Vec<Whole>,
    whole_params: Vec<f64>,
    toggles: Vec<Crossing>,
}

/// A mesh or a whole solid, and where a ray crosses it.
#[derive(Debug)]
struct Whole {
    surface: u32,
    starts_inside: bool,
    params: Range<usize>,
}

#[derive(Clone, Copy, Debug)]
struct Row {
    start: u32,
    len: u32,
    starts_inside: bool,
}

/// How a program's value changes at one parameter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Change {
    pub before: bool,
    pub after: bool,
    /// Where the value changes: the word of the literal that is seen to change it.
    pub word: Option<u32>,
}

impl Roots {
    /// Forgets what is known of the ray before.
    pub fn begin_ray(&mut self) {
        self.wholes.clear();
        self.whole_params.clear();
    }

    /// Takes note of where the ray crosses a mesh: as far as programs will be asked about.
    pub fn know(&mut self, surface: u32, starts_inside: bool, params: impl Iterator<Item = f64>) {
        let start = self.whole_params.len();
        self.whole_params.extend(params);
        self.wholes.push(Whole { surface, starts_inside, params: start..self.whole_params.len() });
    }

    /// Crosses the ray, the same as since [`begin_ray`](Self::begin_ray), with every literal of the program.
    pub fn solve(&mut self, catalog: &Catalog, words: &[u32], ray: &Ray) {
        self.rows.clear();
        self.params.clear();
        for &word in words {
            let start = self.params.len() as u32;
            let mut starts_inside = false;
            if let Word::Literal { index, negated } = Word::decode(word) {
                starts_inside = negated ^ self.cross(catalog, index, ray);
            }
            self.rows.push(Row { start, len: self.params.len() as u32 - start, starts_inside });
        }
    }

    fn cross(&mut self, catalog: &Catalog, literal: u32, ray: &Ray) -> bool {
        let literal = catalog.literal(literal);
        let (surface, ray) = (literal.stored + literal.surface_shift, &literal.ray(ray));
        if !matches!(literal.surface, Surface::Mesh(_) | Surface::Placed(_)) {
            return literal.surface.crossings(&catalog.surfaces, ray, &mut self.params);
        }
        let known = self.wholes.iter().position(|known| known.surface == surface).unwrap_or_else(|| {
            let params = &mut self.whole_params;
            let start = params.len();
            match literal.surface {
                Surface::Placed(placed) => params.extend(ends(copy_spans(catalog, placed, ray)).map(|hit| hit.t)),
                Surface::Mesh(mesh) => {
                    mesh_toggles(mesh, &catalog.surfaces, ray, &mut self.toggles);
                    params.extend(self.toggles.iter().map(|toggle| toggle.t));
                }
                _ => {}
            }
            // What is bounded is met from outside.
            self.wholes.push(Whole { surface, starts_inside: false, params: start..params.len() });
            self.wholes.len() - 1
        });
        let Whole { starts_inside, params, .. } = &self.wholes[known];
        self.params.extend_from_slice(&self.whole_params[params.clone()]);
        *starts_inside
    }

    /// The crossings with the literal at a place of the program.
    pub fn sides(&self, at: usize) -> Sides<'_> {
        let row = self.rows[at];
        let start = row.start as usize;
        Sides { starts_inside: row.starts_inside, params: &self.params[start..start + row.len as usize] }
    }

    /// The first parameter `>= t` from which on the program is inside (`wanted`) or outside; infinite where there is none.
    pub fn next(&self, words: &[u32], t: f64, wanted: bool) -> f64 {
        self.next_at(words, 0, t, wanted)
    }

    fn next_at(&self, words: &[u32], at: usize, t: f64, wanted: bool) -> f64 {
        let (len, is_and) = match Word::decode(words[at]) {
            Word::Literal { .. } => return self.sides(at).next(t, wanted),
            Word::And { len } => (len as usize, true),
            Word::Or { len } => (len as usize, false),
        };
        let end = at + 1 + len;
        if is_and != wanted {
            // One child is enough.
            let mut least = f64::INFINITY;
            let mut child = at + 1;
            while child < end && least > t {
                least = least.min(self.next_at(words, child, t, wanted));
                child = node_end(words, child);
            }
            return least;
        }
        // All children must agree.
        let mut t = t;
        loop {
            let start = t;
            let mut child = at + 1;
            while child < end {
                t = self.next_at(words, child, t, wanted);
                if t == f64::INFINITY {
                    return t;
                }
                child = node_end(words, child);
            }
            if t == start {
                return t;
            }
        }
    }

    /// The program's value from `t` on.
    pub fn inside_after(&self, words: &[u32], t: f64) -> bool {
        self.change(words, t).after
    }

    /// How the program's value changes at `t`, and which literal is seen to change it: from the root down, the first child
    /// in source order that changes as its parent does (compare [`combine`](super::combine::combine)).
    pub fn change(&self, words: &[u32], t: f64) -> Change {
        self.change_at(words, 0, t)
    }

    fn change_at(&self, words: &[u32], at: usize, t: f64) -> Change {
        let (len, is_and) = match Word::decode(words[at]) {
            Word::Literal { .. } => {
                let sides = self.sides(at);
                return Change { before: sides.before(t), after: sides.after(t), word: Some(words[at]) };
            }
            Word::And { len } => (len as usize, true),
            Word::Or { len } => (len as usize, false),
        };
        let end = at + 1 + len;
        let mut sum = Change { before: is_and, after: is_and, word: None };
        // The first child that starts being inside, and the first that ceases to be.
        let (mut first_in, mut first_out) = (None, None);
        let mut child = at + 1;
        while child < end {
            let change = self.change_at(words, child, t);
            if is_and {
                sum.before &= change.before;
                sum.after &= change.after;
            } else {
                sum.before |= change.before;
                sum.after |= change.after;
            }
            match (change.before, change.after) {
                (false, true) => first_in = first_in.or(change.word),
                (true, false) => first_out = first_out.or(change.word),
                _ => {}
            }
            child = node_end(words, child);
        }
        sum.word = match (sum.before, sum.after) {
            (false, true) => first_in,
            (true, false) => first_out,
            _ => None,
        };
        sum
    }
}

/// The hit for a change at `t` that the literal `word` is seen to make.
pub(crate) fn hit_of(catalog: &Catalog, word: u32, ray: &Ray, t: f64, entering: bool) -> Hit {
    let Word::Literal { index, negated } = Word::decode(word) else {
        unreachable!("only literals are seen to change a program");
    };
    let literal = catalog.literal(index);
    if let Surface::Placed(placed) = literal.surface {
        let seen = ends(copy_spans(catalog, placed, ray)).find(|hit| hit.t == t && hit.entering == entering);
        return seen.expect("what the program meets is what its copy meets");
    }
    let (surface, turned) =
        literal.surface.facet_at(literal.stored, &catalog.surfaces, &literal.ray(ray), t, entering != negated);
    let surface = surface + literal.surface_shift;
    Hit { t, leaf: literal.leaf, surface, entering, flipped: negated != turned }
}
