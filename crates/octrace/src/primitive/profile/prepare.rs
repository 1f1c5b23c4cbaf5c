//! Arcs cut so that a contour's formula can be found: see [`chain`](super::chain).

use super::piece::{Circle, Piece};
use crate::geom::Vec2;

/// The contour with corners where arcs reach farthest to the left and to the right, arcs so short that at corners their
/// chords turn as they do, and edges of no length where no arc is short enough for that ([`stitch`]); twice in a row.
pub(super) fn prepared(pieces: &[Piece]) -> Vec<Piece> {
    let mut cut = Vec::with_capacity(2 * pieces.len());
    for piece in pieces {
        let mut rest = *piece;
        // What lies ahead is met first.
        let ahead = if rest.tangent(rest.from).x < 0.0 { -1.0 } else { 1.0 };
        for x in [ahead, -ahead] {
            if let Some(apex) = rest.apex(Vec2::new(x, 0.0)) {
                let [before, behind] = rest.cut(apex);
                cut.push(before);
                rest = behind;
            }
        }
        if rest.sweep().is_some_and(|(angle, _)| angle.abs() > 3.2) {
            let [before, behind] = rest.cut(rest.middle());
            cut.push(before);
            rest = behind;
        }
        cut.push(rest);
    }
    const ROUNDS: usize = 20;
    for _ in 0..ROUNDS {
        let count = cut.len();
        let tight: Vec<bool> = (0..count).map(|i| is_tight(&cut[i], &cut[(i + 1) % count])).collect();
        if !tight.contains(&true) {
            break;
        }
        let is_halved = |i: usize| !cut[i].is_line() && (tight[i] || tight[(i + count - 1) % count]);
        cut = (0..count)
            .flat_map(|i| match is_halved(i) {
                true => cut[i].cut(cut[i].middle()).to_vec(),
                false => vec![cut[i]],
            })
            .collect();
    }
    let count = cut.len();
    let mut whole = Vec::with_capacity(2 * count);
    for (i, piece) in cut.iter().enumerate() {
        whole.push(*piece);
        whole.extend(stitch(piece, &cut[(i + 1) % count]));
    }
    whole.extend_from_within(..);
    whole
}

/// Sines of angles smaller than this are no turn, but rounding in what made the arcs.
const SMOOTH: f64 = 1e-7;

/// The edge of no length between two pieces, if there must be one so that chords turn as the curves do.
///
/// Where two arcs make an S, the chord of one always leads across the other: between them goes their tangent. In a cusp, the
/// curves part by their curvature alone, of which chords know nothing: the cusp is made blunt.
fn stitch(before: &Piece, behind: &Piece) -> Option<Piece> {
    let bend = |piece: &Piece| match piece.circle {
        None => 0.0,
        Some(Circle { radius, ccw: true, .. }) => 1.0 / radius,
        Some(Circle { radius, .. }) => -1.0 / radius,
    };
    let (along, ahead) = (before.tangent(before.to), behind.tangent(behind.from));
    if along.cross(ahead).abs() > SMOOTH * along.length() * ahead.length() {
        return None;
    }
    let (one, other) = (bend(before), bend(behind));
    let direction = match along.dot(ahead) > 0.0 {
        true if one * other < 0.0 => along,
        false if one + other > 0.0 => ahead.left(),
        false if one + other < 0.0 => -ahead.left(),
        _ => return None,
    };
    // So short that it is nowhere, so long that its direction is not rounded away.
    let length = 1e-6 * before.chord().length().min(behind.chord().length());
    let to = behind.from + direction * (length / direction.length());
    Some(Piece { from: behind.from, to, circle: None })
}

/// Whether two pieces leave their common corner so that their chords are not in the order in which they are themselves.
fn is_tight(before: &Piece, behind: &Piece) -> bool {
    if before.is_line() && behind.is_line() {
        return false;
    }
    let sine = |a: Vec2, b: Vec2| a.cross(b) / (a.length() * b.length());
    let (back, ahead) = (-before.tangent(before.to), behind.tangent(behind.from));
    let turn = sine(back, ahead);
    if turn.abs() <= SMOOTH {
        // Those that need it are told apart by an edge of no length.
        return false;
    }
    let (back_chord, chord) = (-before.chord(), behind.chord());
    let sines = [turn, sine(back, chord), sine(back_chord, ahead), sine(back_chord, chord)];
    !(sines.iter().all(|&s| s > 0.0) || sines.iter().all(|&s| s < 0.0))
}
