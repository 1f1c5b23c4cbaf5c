//! Chords of a result that are parts of the same curve, one after the other.

use super::Origin;
use super::grid::GridPoint;
use super::source::Sources;
use i_overlay::vector::edge::DataVectorEdge;
use octrace::Vec2;

/// A part of a contour on one line or circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) curve: RunCurve,
    /// The edges that its first and its last chord belong to.
    pub(super) sources: [u32; 2],
    /// Where it starts and ends.
    pub(super) ends: [GridPoint; 2],
    /// How far it turns about the centre of its circle; 0 for a line.
    pub(super) turn: f64,
}

/// The curve of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RunCurve {
    /// The line of an edge.
    Line {
        /// The edge.
        source: u32,
    },
    /// A circle.
    Circle {
        /// Which one.
        circle: u32,
        /// Whether it is walked counter-clockwise.
        ccw: bool,
    },
}

impl Run {
    fn of(sources: &Sources, chord: &DataVectorEdge<i64, Origin>) -> Self {
        let source = chord.data.0;
        let (curve, turn) = match sources.edges[source as usize].circle {
            None => (RunCurve::Line { source }, 0.0),
            Some(circle) => {
                let center = sources.circles[circle as usize].center;
                let (a, b): (Vec2, Vec2) = (sources.grid.place(chord.a) - center, sources.grid.place(chord.b) - center);
                let turn = libm::atan2(a.cross(b), a.dot(b));
                (RunCurve::Circle { circle, ccw: turn >= 0.0 }, turn)
            }
        };
        Self { curve, sources: [source; 2], ends: [chord.a, chord.b], turn }
    }

    fn append(&mut self, next: &Self) {
        self.sources[1] = next.sources[1];
        self.ends[1] = next.ends[1];
        self.turn += next.turn;
    }
}

/// The runs of a closed chain of chords: no two neighbours are on the same curve, unless there is only one run.
pub(super) fn runs(sources: &Sources, chords: &[DataVectorEdge<i64, Origin>]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for chord in chords {
        join(&mut runs, Run::of(sources, chord));
    }
    close(&mut runs);
    runs
}

/// Takes out runs, and joins those that become neighbours.
pub(super) fn without(runs: &[Run], dropped: &[bool]) -> Vec<Run> {
    let mut kept = Vec::with_capacity(runs.len());
    for (run, _) in runs.iter().zip(dropped).filter(|(_, dropped)| !**dropped) {
        join(&mut kept, *run);
    }
    close(&mut kept);
    kept
}

fn join(runs: &mut Vec<Run>, next: Run) {
    match runs.last_mut() {
        Some(last) if last.curve == next.curve => last.append(&next),
        _ => runs.push(next),
    }
}

/// Joins the last run and the first, which are neighbours too.
fn close(runs: &mut Vec<Run>) {
    if let [first, .., last] = runs.as_mut_slice()
        && first.curve == last.curve
    {
        last.append(first);
        *first = *last;
        runs.pop();
    }
}
