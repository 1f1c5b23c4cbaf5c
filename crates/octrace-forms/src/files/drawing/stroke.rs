//! What a pen of some width covers that is drawn along a line: OpenSCAD takes lines with open ends in SVG files for that.

use octrace::Vec2;

/// How a stroke ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cap {
    Butt,
    Round,
    Square,
}

/// What a stroke is like outside its corners. Pointed corners are pointed up to a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Join {
    Pointed,
    Round,
    /// Cut square, half a width away from the corner, as OpenSCAD has `bevel`.
    Cut,
}

/// A part of what is covered; the whole is the union.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Part {
    Polygon(Vec<Vec2>),
    Disc(Vec2, f64),
}

/// Corners sharper than those where the point is this many half widths away are cut off there.
const MITER_LIMIT: f64 = 2.0;

/// What a pen of that width covers along the points.
pub(super) fn covered(points: &[Vec2], width: f64, cap: Cap, join: Join) -> Vec<Part> {
    let half = width / 2.0;
    let mut line: Vec<Vec2> = Vec::with_capacity(points.len());
    for &p in points {
        if line.last() != Some(&p) {
            line.push(p);
        }
    }
    let mut parts = Vec::new();
    let last = line.len().saturating_sub(1);
    let ways: Vec<Vec2> = line.windows(2).map(|w| (w[1] - w[0]) * (half / (w[1] - w[0]).length())).collect();
    for (i, &way) in ways.iter().enumerate() {
        let (mut a, mut b) = (line[i], line[i + 1]);
        if cap == Cap::Square {
            a = if i == 0 { a - way } else { a };
            b = if i + 1 == last { b + way } else { b };
        }
        let side = way.left();
        parts.push(Part::Polygon(vec![a - side, b - side, b + side, a + side]));
    }
    for (i, pair) in ways.windows(2).enumerate() {
        parts.extend(corner(line[i + 1], pair[0], pair[1], half, join));
    }
    if cap == Cap::Round && last > 0 {
        parts.extend([line[0], line[last]].map(|end| Part::Disc(end, half)));
    }
    parts
}

/// What is missing outside a corner at `p` where the line turns from `before` to `after`, both of length `half`.
fn corner(p: Vec2, before: Vec2, after: Vec2, half: f64, join: Join) -> Option<Part> {
    let turn = before.cross(after);
    if turn == 0.0 {
        return None;
    }
    if join == Join::Round {
        return Some(Part::Disc(p, half));
    }
    // The outer side is on the right where the line turns left.
    let outwards = |way: Vec2| if turn > 0.0 { -way.left() } else { way.left() };
    let (a, b) = (outwards(before), outwards(after));
    let across = a + b;
    // The miter's point is at `across * 2 * half^2 / |across|^2`.
    let reach = 2.0 * half * half / across.dot(across);
    let corners = if join == Join::Pointed && reach * across.length() <= MITER_LIMIT * half {
        vec![p, p + a, p + across * reach, p + b]
    } else {
        // Cut square, half a width away from the corner.
        let out = before - after;
        let out = out * (half / out.length());
        let slope = |end: Vec2, way: Vec2| {
            let t = (half - end.dot(out) / half) * half / way.dot(out);
            end + way * t
        };
        vec![p, p + a, p + slope(a, before), p + slope(b, after), p + b]
    };
    Some(Part::Polygon(corners))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners_of(parts: &[Part]) -> Vec<Vec2> {
        let polygons = parts.iter().filter_map(|part| if let Part::Polygon(p) = part { Some(p) } else { None });
        polygons.flatten().copied().collect()
    }

    #[test]
    fn right_angles_are_pointed_and_ends_are_as_asked_for() {
        let line = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]].map(|[x, y]| Vec2::new(x, y));
        let square = corners_of(&covered(&line, 2.0, Cap::Square, Join::Pointed));
        assert!(square.contains(&Vec2::new(-1.0, 1.0)) && square.contains(&Vec2::new(9.0, 11.0)));
        assert!(square.iter().any(|p| (*p - Vec2::new(11.0, -1.0)).length() < 1e-12));
        let round = covered(&line, 2.0, Cap::Round, Join::Pointed);
        assert_eq!(round.iter().filter(|part| matches!(part, Part::Disc(..))).count(), 2);
        assert!(!corners_of(&covered(&line, 2.0, Cap::Butt, Join::Pointed)).contains(&Vec2::new(-1.0, 1.0)));
        assert_eq!(covered(&line[..1], 2.0, Cap::Round, Join::Pointed), []);
    }

    #[test]
    fn sharp_corners_are_cut_half_a_width_away() {
        let line = [[0.0, 0.0], [10.0, 0.0], [0.0, 1.0]].map(|[x, y]| Vec2::new(x, y));
        let corners = corners_of(&covered(&line, 2.0, Cap::Butt, Join::Pointed));
        let farthest = corners.iter().map(|p| p.x).fold(0.0, f64::max);
        assert!((10.9..11.2).contains(&farthest), "{farthest}");
    }

    #[test]
    fn corners_are_joined_as_asked_for() {
        let line = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]].map(|[x, y]| Vec2::new(x, y));
        let round = covered(&line, 2.0, Cap::Butt, Join::Round);
        assert_eq!(round.last(), Some(&Part::Disc(line[1], 1.0)));
        // The cut is at right angles to the diagonal, 1 away from the corner: 1 - (sqrt 2 - 1) of each leg is cut off.
        let cut = corners_of(&covered(&line, 2.0, Cap::Butt, Join::Cut));
        let end = Vec2::new(10.0 + 2f64.sqrt() - 1.0, -1.0);
        assert!(cut.iter().any(|p| (*p - end).length() < 1e-12), "{cut:?}");
    }
}
