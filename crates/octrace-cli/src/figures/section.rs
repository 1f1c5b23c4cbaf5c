//! The outline of a section that is known as stretches of lines.

use super::octree_slice::Map;
use super::sheet::point;

/// The stretches of all rows, from low to high y, those that overlap from row to row joined to areas: a path.
pub fn outline(rows: &[Vec<(f64, f64)>], map: &Map) -> String {
    let height = 1.0 / rows.len() as f64;
    let overlap = |(a, b): (&(f64, f64), &(f64, f64))| a.0 < b.1 && b.0 < a.1;
    let joined = |below: &Vec<(f64, f64)>, above: &Vec<(f64, f64)>| {
        below.len() == above.len() && below.iter().zip(above).all(overlap)
    };
    let (mut data, mut bottom) = (String::new(), 0.0);
    for group in rows.chunk_by(joined) {
        for span in 0..group[0].len() {
            let stretches: Vec<(f64, f64)> = group.iter().map(|row| row[span]).collect();
            let corners = straightened(&corners(&stretches, bottom, height, map));
            let corners: Vec<String> = corners.into_iter().map(point).collect();
            data += &format!("M{}Z", corners.join("L"));
        }
        bottom += group.len() as f64;
    }
    data
}

/// The corners of an area: up its right side, and down its left.
fn corners(stretches: &[(f64, f64)], bottom: f64, height: f64, map: &Map) -> Vec<(f64, f64)> {
    let last = stretches.len() - 1;
    let top = bottom + stretches.len() as f64;
    let side = |row: usize, y: f64, right: bool| {
        let (a, b) = stretches[row];
        map.at(if right { b } else { a }, y * height)
    };
    let middle = |row: usize| bottom + row as f64 + 0.5;
    let mut corners = vec![side(0, bottom, true)];
    corners.extend((0..=last).map(|row| side(row, middle(row), true)));
    corners.extend([side(last, top, true), side(last, top, false)]);
    corners.extend((0..=last).rev().map(|row| side(row, middle(row), false)));
    corners.push(side(0, bottom, false));
    corners
}

/// The corners without those that are hardly off the straight line between others.
fn straightened(corners: &[(f64, f64)]) -> Vec<(f64, f64)> {
    const OFF: f64 = 0.08;
    let mut kept = vec![corners[0]];
    let (mut from, mut to) = (0, 1);
    while to < corners.len() {
        let (a, b) = (corners[from], corners[to]);
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let length = (dx * dx + dy * dy).sqrt();
        let off = |p: &(f64, f64)| ((p.0 - a.0) * dy - (p.1 - a.1) * dx).abs() > OFF * length;
        if to > from + 1 && corners[from + 1..to].iter().any(off) {
            from = to - 1;
            kept.push(corners[from]);
        } else {
            to += 1;
        }
    }
    kept.push(corners[corners.len() - 1]);
    kept
}

#[cfg(test)]
mod tests {
    use super::super::octree_slice::SIDE;
    use super::*;

    #[test]
    fn rows_are_joined_to_areas() {
        let map = Map { left: 0.0, bottom: SIDE };
        let rows = vec![vec![(0.25, 0.5)], vec![(0.25, 0.5)], vec![], vec![(0.0, 0.5), (0.75, 1.0)]];
        let data = outline(&rows, &map);
        assert_eq!(data.matches('M').count(), 3, "{data}");
        assert!(data.starts_with("M280 560L280 280L140 280L140 560Z"), "{data}");
    }
}
