//! Boolean operations on outlines of lines and arcs.
//!
//! Arcs become fine chords, the library i_overlay combines the polygons on a grid, and what comes out is put back onto the
//! curves that it came from: every chord remembers its edge, chords of one circle become one arc again, and corners move to
//! where the two curves meet. So arcs keep the numbers of their circles, corners that stay are not moved by a bit, and new
//! corners are right to rounding. The polygons decide how things hang together: features thinner than
//! [`Grid::STEPS`](grid::Grid::STEPS) says may be lost, and so may what pokes out of a circle by less than the chords are
//! away from it (2e-5 of the size).

mod carrier;
mod crossings;
mod grid;
mod recover;
mod runs;
mod source;

use super::{Outline, PlaneError};
use i_overlay::core::edge_data::{EdgeDataMerge, OverlayEdgeData};
use i_overlay::core::edge_overlay::{EdgeOverlay, InputEdge};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::ShapeType;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::segm::boolean::ShapeCountBoolean;
use octrace::{BoolOp, Contour};
pub(super) use recover::without_straight_corners;
use source::Sources;

/// What closed curves surround.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fill {
    /// What an odd number of them surround.
    EvenOdd,
    /// What they go around at all, counting one way plus and the other way minus.
    NonZero,
    /// What they go around counter-clockwise more often than clockwise.
    Positive,
    /// What they go around clockwise more often than counter-clockwise.
    Negative,
}

impl From<Fill> for FillRule {
    fn from(fill: Fill) -> Self {
        match fill {
            Fill::EvenOdd => Self::EvenOdd,
            Fill::NonZero => Self::NonZero,
            Fill::Positive => Self::Positive,
            Fill::Negative => Self::Negative,
        }
    }
}

/// The edge that a chord belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Origin(u32);

impl OverlayEdgeData for Origin {
    type Store = ();

    /// Of edges that coincide, the first counts, of those that do not cancel out.
    fn merge(both: EdgeDataMerge<ShapeCountBoolean, Self>, _: &mut ()) -> Self {
        let none = |count: ShapeCountBoolean| count.subj == 0 && count.clip == 0;
        match (none(both.lhs_count), none(both.rhs_count)) {
            (true, false) => both.rhs_data,
            (false, true) => both.lhs_data,
            _ if both.lhs_data.0 <= both.rhs_data.0 => both.lhs_data,
            _ => both.rhs_data,
        }
    }
}

/// The region that closed curves surround. They may cross, touch and repeat; an arc's corners must lie on its circle.
///
/// # Errors
/// If a number is not finite, or the curves cross each other too often: see [`PlaneError`].
pub fn region(contours: &[Contour], fill: Fill) -> Result<Outline, PlaneError> {
    evaluate(contours, &[], fill, OverlayRule::Subject)
}

/// Outlines combined, in this order; empty for none.
///
/// # Errors
/// As for [`region`].
pub fn combine(op: BoolOp, outlines: &[&Outline]) -> Result<Outline, PlaneError> {
    let Some((&first, rest)) = outlines.split_first() else { return Ok(Outline::EMPTY) };
    match op {
        BoolOp::Union => {
            let mut filled = outlines.iter().filter(|outline| !outline.is_empty());
            match (filled.next(), filled.next()) {
                (None, _) => Ok(Outline::EMPTY),
                (Some(only), None) => Ok((*only).clone()),
                _ => evaluate(together(outlines), &[], Fill::NonZero, OverlayRule::Subject),
            }
        }
        BoolOp::Difference if first.is_empty() || rest.iter().all(|next| next.is_empty()) => Ok(first.clone()),
        BoolOp::Difference => evaluate(&first.contours, together(rest), Fill::NonZero, OverlayRule::Difference),
        BoolOp::Intersection => rest.iter().try_fold(first.clone(), |so_far, next| {
            if so_far.is_empty() || next.is_empty() {
                return Ok(Outline::EMPTY);
            }
            evaluate(&so_far.contours, &next.contours, Fill::NonZero, OverlayRule::Intersect)
        }),
    }
}

/// What is in exactly one of two outlines.
///
/// # Errors
/// As for [`region`].
pub fn exclusive(a: &Outline, b: &Outline) -> Result<Outline, PlaneError> {
    evaluate(&a.contours, &b.contours, Fill::NonZero, OverlayRule::Xor)
}

fn together<'a>(outlines: &'a [&'a Outline]) -> impl IntoIterator<Item = &'a Contour> {
    outlines.iter().flat_map(|outline| &outline.contours)
}

fn evaluate<'a>(
    subject: impl IntoIterator<Item = &'a Contour>,
    clip: impl IntoIterator<Item = &'a Contour>,
    fill: Fill,
    rule: OverlayRule,
) -> Result<Outline, PlaneError> {
    let subject = subject.into_iter().map(|contour| (ShapeType::Subject, contour));
    let clip = clip.into_iter().map(|contour| (ShapeType::Clip, contour));
    let Some(sources) = Sources::new(subject.chain(clip))? else { return Ok(Outline::EMPTY) };
    let chords = sources.chords();
    crossings::check(&chords)?;
    let mut overlay = EdgeOverlay::<i64, Origin>::new(chords.len());
    for chord in &chords {
        let edge = InputEdge { a: chord.from, b: chord.to, data: Origin(chord.source) };
        overlay.add_edge(edge, chord.role);
    }
    let shapes = overlay.build_vector_shapes(rule, fill.into());
    Ok(recover::outline(&sources, &shapes))
}

#[cfg(test)]
mod tests;
