//! Lines and arcs in any order, joined where their ends meet to closed curves.

use super::DrawingOptions;
use crate::curve::{EllipticArc, Paths, Pen, Strokes, bulged};
use crate::files::mesh::{RawMesh, welded};
use octrace::geom::sin_cos_deg;
use octrace::{Vec2, Vec3};

/// Ends no farther apart than this are one point (millimetres), as in OpenSCAD.
const NEAR: f64 = 1.0 / 1024.0;

/// A line or a part of an ellipse.
#[derive(Clone, Copy, Debug)]
pub(super) enum Piece {
    Line(Vec2, Vec2),
    /// With the number of chords that OpenSCAD makes of it.
    Arc(EllipticArc, u32),
    /// A cubic Bézier curve.
    Bezier([Vec2; 4]),
}

/// Chords for a Bézier curve where chords are wanted.
const CHORDS_OF_A_BEZIER: u32 = 8;

impl Piece {
    fn ends(&self) -> (Vec2, Vec2) {
        match self {
            Self::Line(a, b) | Self::Bezier([a, .., b]) => (*a, *b),
            Self::Arc(arc, _) => (arc.at(arc.start_deg), arc.at(arc.end_deg())),
        }
    }

    /// The piece moved by an affine map, given by what it does to points and to differences of points.
    pub fn moved(&self, point: impl Fn(Vec2) -> Vec2, vector: impl Fn(Vec2) -> Vec2) -> Self {
        match *self {
            Self::Line(a, b) => Self::Line(point(a), point(b)),
            Self::Bezier(points) => Self::Bezier(points.map(point)),
            Self::Arc(arc, chords) => {
                let (x, y) = (vector(arc.x), vector(arc.y));
                Self::Arc(EllipticArc { center: point(arc.center), x, y, ..arc }, chords)
            }
        }
    }
}

/// The closed curves that pieces make up, and how many of them had to be closed by a line.
pub(super) fn joined(pieces: &[Piece], options: &DrawingOptions) -> (Paths, usize) {
    let ends: Vec<Vec2> = pieces.iter().map(Piece::ends).flat_map(|(a, b)| [a, b]).collect();
    let reach = |piece: &Piece| match piece {
        Piece::Line(a, b) => [*a, *b, *a, *b],
        Piece::Bezier(points) => *points,
        Piece::Arc(EllipticArc { center, x, y, .. }, _) => {
            let reach = Vec2::new(x.x.abs() + y.x.abs(), x.y.abs() + y.y.abs());
            [*center - reach, *center + reach, *center, *center]
        }
    };
    let corners: Vec<Vec2> = pieces.iter().flat_map(reach).collect();
    let corner = |pick: fn(f64, f64) -> f64| {
        corners.iter().copied().reduce(|p, q| Vec2::new(pick(p.x, q.x), pick(p.y, q.y))).unwrap_or_default()
    };
    let size = (corner(f64::max) - corner(f64::min)).length();
    let numbered = welded(
        RawMesh {
            points: ends.iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect(),
            faces: vec![(0..ends.len() as u32).collect()],
        },
        NEAR,
    );
    let knots = Knots::new(numbered.points.iter().map(|p| Vec2::new(p.x, p.y)).collect(), &numbered.faces[0]);
    let mut pen = Pen::new(Strokes::Arcs { tolerance: options.tolerance.relative * size });
    let open = knots.walk(|walk| {
        for (step, &Step { piece, backwards, from, to }) in walk.iter().enumerate() {
            if step == 0 {
                pen.move_to(from);
            }
            match pieces[piece] {
                Piece::Line(..) => pen.line_to(to),
                Piece::Bezier([_, b, c, _]) => {
                    let [c1, c2] = if backwards { [c, b] } else { [b, c] };
                    match options.fragments {
                        None => pen.cubic_to(c1, c2, to),
                        Some(_) => pen.cubic_as_chords(c1, c2, to, CHORDS_OF_A_BEZIER),
                    }
                }
                Piece::Arc(arc, chords) => draw_arc(arc, chords, backwards, to, options.fragments.is_some(), &mut pen),
            }
        }
    });
    (pen.finish(), open)
}

fn draw_arc(mut arc: EllipticArc, chords: u32, backwards: bool, to: Vec2, as_chords: bool, pen: &mut Pen) {
    if backwards {
        (arc.start_deg, arc.sweep_deg) = (arc.end_deg(), arc.start_deg - arc.end_deg());
    }
    let from = pen.at();
    if as_chords {
        return arc.draw_chords(pen, chords, to);
    }
    let moved = from != arc.at(arc.start_deg) || to != arc.at(arc.end_deg());
    if moved && arc.is_circular() && from != to {
        // Ends that were put together with others lie beside the circle: the one with the same turn goes through them.
        let (sin, cos) = sin_cos_deg((arc.end_deg() - arc.start_deg) / 4.0);
        let bulge = sin / cos * arc.x.cross(arc.y).signum();
        return match bulged(from, to, bulge) {
            Some((center, radius)) => pen.arc_to(to, center, radius, bulge > 0.0),
            None => pen.line_to(to),
        };
    }
    arc.draw(pen, to);
}

/// One piece of a walk.
struct Step {
    piece: usize,
    backwards: bool,
    from: Vec2,
    to: Vec2,
}

/// Which pieces meet where.
struct Knots<'a> {
    places: Vec<Vec2>,
    /// For every piece the knots of its start and end, one after the other.
    ends: &'a [u32],
    /// For every knot the pieces that start or end there, in order.
    pieces: Vec<Vec<u32>>,
}

impl<'a> Knots<'a> {
    fn new(places: Vec<Vec2>, ends: &'a [u32]) -> Self {
        let mut pieces = vec![Vec::new(); places.len()];
        for (end, &knot) in ends.iter().enumerate() {
            pieces[knot as usize].push(end as u32 / 2);
        }
        Self { places, ends, pieces }
    }

    /// Walks along all pieces, each once: first from knots where one piece ends and no other, then in circles. Returns
    /// how many walks did not come back.
    fn walk(&self, mut each: impl FnMut(&[Step])) -> usize {
        let mut used = vec![false; self.ends.len() / 2];
        let mut left: Vec<usize> = self.pieces.iter().map(Vec::len).collect();
        // Pieces of a knot before this one are used.
        let mut next = vec![0; self.places.len()];
        let mut open = 0;
        let loose: Vec<u32> = self.ends.iter().copied().filter(|&knot| left[knot as usize] == 1).collect();
        let mut starts = std::collections::VecDeque::from(loose);
        let all: Vec<u32> = self.ends.iter().copied().step_by(2).collect();
        let mut circles = all.into_iter();
        loop {
            let start = match starts.pop_front() {
                Some(start) if left[start as usize] != 1 => continue,
                Some(start) => start,
                None => match circles.next() {
                    Some(start) if left[start as usize] == 0 => continue,
                    Some(start) => start,
                    None => return open,
                },
            };
            let mut walk = Vec::new();
            let mut at = start;
            while let Some(piece) = self.take(at, &mut used, &mut next) {
                let (a, b) = (self.ends[2 * piece], self.ends[2 * piece + 1]);
                let backwards = a != at;
                let to = if backwards { a } else { b };
                left[a as usize] -= 1;
                left[b as usize] -= 1;
                starts.extend([a, b].into_iter().filter(|&knot| knot != to && left[knot as usize] == 1));
                let [from, to_place] = [at, to].map(|knot| self.places[knot as usize]);
                walk.push(Step { piece, backwards, from, to: to_place });
                at = to;
            }
            open += usize::from(at != start);
            each(&walk);
        }
    }

    fn take(&self, knot: u32, used: &mut [bool], next: &mut [usize]) -> Option<usize> {
        let pieces = &self.pieces[knot as usize];
        let next = &mut next[knot as usize];
        while let Some(&piece) = pieces.get(*next) {
            *next += 1;
            if !std::mem::replace(&mut used[piece as usize], true) {
                return Some(piece as usize);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::signed_area;

    fn lines(points: &[[f64; 4]]) -> Vec<Piece> {
        points.iter().map(|&[a, b, c, d]| Piece::Line(Vec2::new(a, b), Vec2::new(c, d))).collect()
    }

    #[test]
    fn pieces_in_any_order_and_direction_make_closed_curves() {
        let square =
            lines(&[[0.0, 0.0, 1.0, 0.0], [1.0, 1.0, 0.0, 1.0], [1.0, 0.0004, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0]]);
        let (paths, open) = joined(&square, &DrawingOptions::default());
        assert_eq!((paths.len(), open), (1, 0));
        assert!((signed_area(&paths) - 1.0).abs() < 1e-12);
        let (paths, open) = joined(&square[..3], &DrawingOptions::default());
        assert_eq!((paths.len(), open), (1, 1));
        assert!((signed_area(&paths).abs() - 1.0).abs() < 1e-12);
        assert_eq!(joined(&[], &DrawingOptions::default()), (Vec::new(), 0));
    }

    #[test]
    fn curves_that_touch_are_walked_all() {
        // Two triangles with a common corner, and a loose end on it.
        let pieces = lines(&[
            [0.0, 0.0, 1.0, 0.0],
            [1.0, 0.0, 1.0, 1.0],
            [1.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, -1.0, 0.0],
            [-1.0, 0.0, -1.0, -1.0],
            [-1.0, -1.0, 0.0, 0.0],
            [0.0, 0.0, 5.0, -5.0],
        ]);
        let (paths, open) = joined(&pieces, &DrawingOptions::default());
        assert_eq!(open, 1);
        assert!((signed_area(&paths).abs() - 1.0).abs() < 1e-12, "{paths:?}");
    }
}
