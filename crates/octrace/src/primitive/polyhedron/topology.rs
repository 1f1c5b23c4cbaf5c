//! Which face meets which: merging points, cleaning faces, checking that the surface is closed, turning faces.

use super::PolyhedronError;
use crate::geom::Vec3;
use rustc_hash::FxHashMap;

/// Distinct points, and which input point each of them was first.
pub(super) struct Points {
    pub coordinates: Vec<Vec3>,
    source: Vec<u32>,
}

impl Points {
    pub fn iter(&self) -> std::slice::Iter<'_, Vec3> {
        self.coordinates.iter()
    }
}

/// A face with at least three corners, no two of them equal in a row, and which input face it was.
pub(super) struct Face {
    pub corners: Vec<u32>,
    source: usize,
}

/// Checks indices and coordinates, merges equal points, drops faces that are too small to matter and points that no
/// face uses. What remains keeps its order.
pub(super) fn clean(points: Vec<Vec3>, faces: Vec<Vec<u32>>) -> Result<(Points, Vec<Face>), PolyhedronError> {
    if let Some(index) = points.iter().position(|p| !p.is_finite()) {
        return Err(PolyhedronError::NotFinite { index });
    }
    // The first of all points with the same coordinates; adding zero makes -0.0 equal to 0.0 to the bit.
    let mut known: FxHashMap<[u64; 3], u32> = FxHashMap::default();
    known.reserve(points.len() / 4);
    let bits = |p: Vec3| (p + Vec3::ZERO).to_array().map(f64::to_bits);
    let first: Vec<u32> = (0_u32..).zip(&points).map(|(i, &p)| *known.entry(bits(p)).or_insert(i)).collect();

    let mut kept = Vec::with_capacity(faces.len());
    for (source, face) in faces.iter().enumerate() {
        if let Some(&index) = face.iter().find(|&&i| i as usize >= points.len()) {
            return Err(PolyhedronError::NoSuchPoint { face: source, index, points: points.len() });
        }
        let corners = without_repeats(face.iter().map(|&i| first[i as usize]));
        if corners.len() >= 3 {
            kept.push(Face { corners, source });
        }
    }

    let mut source: Vec<u32> = kept.iter().flat_map(|f| f.corners.iter().copied()).collect();
    source.sort_unstable();
    source.dedup();
    let mut renumbered = vec![0; points.len()];
    (0_u32..).zip(&source).for_each(|(new, &old)| renumbered[old as usize] = new);
    kept.iter_mut().flat_map(|f| &mut f.corners).for_each(|i| *i = renumbered[*i as usize]);
    let coordinates = source.iter().map(|&i| points[i as usize] + Vec3::ZERO).collect();
    Ok((Points { coordinates, source }, kept))
}

/// The closed walk through these corners without standing still (`a a`) and without going out and back (`a b a`), which
/// bounds the same face.
fn without_repeats(corners: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut walk: Vec<u32> = Vec::new();
    for corner in corners {
        if walk.last() == Some(&corner) {
            continue;
        }
        if walk.len() >= 2 && walk[walk.len() - 2] == corner {
            walk.pop();
            continue;
        }
        walk.push(corner);
    }
    // The same across the seam between the last and the first corner.
    let mut first = 0;
    while walk.len() - first >= 2 {
        let last = walk.len() - 1;
        if walk[last] == walk[first] {
            walk.pop();
        } else if walk.len() - first >= 3 && walk[last] == walk[first + 1] {
            first += 1;
        } else if walk.len() - first >= 3 && walk[last - 1] == walk[first] {
            walk.truncate(last - 1);
        } else {
            break;
        }
    }
    walk.drain(..first);
    walk
}

/// One use of an undirected edge by a face.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct EdgeUse {
    low: u32,
    high: u32,
    face: u32,
    /// Whether the face walks the edge from `low` to `high`.
    forward: bool,
}

impl EdgeUse {
    fn ends(self) -> (u32, u32) {
        if self.forward { (self.low, self.high) } else { (self.high, self.low) }
    }
}

/// The uses of all edges, those of one edge in a row.
struct Edges(Vec<EdgeUse>);

impl Edges {
    /// Those of faces with corners among so many points.
    fn of(faces: &[Face], points: usize) -> Self {
        let edges = || {
            let faces = faces.iter().zip(0_u32..);
            faces.flat_map(|(Face { corners, .. }, face)| {
                let next = corners.iter().cycle().skip(1);
                corners.iter().zip(next).map(move |(&a, &b)| EdgeUse {
                    low: a.min(b),
                    high: a.max(b),
                    face,
                    forward: a < b,
                })
            })
        };
        // Those with the same lower end come to their place first, and are few.
        let mut places = vec![0_u32; points + 1];
        edges().for_each(|edge| places[edge.low as usize + 1] += 1);
        for point in 0..points {
            places[point + 1] += places[point];
        }
        let mut uses = vec![EdgeUse { low: 0, high: 0, face: 0, forward: false }; places[points] as usize];
        for edge in edges() {
            let place = &mut places[edge.low as usize];
            uses[*place as usize] = edge;
            *place += 1;
        }
        uses.chunk_by_mut(|a, b| a.low == b.low).for_each(<[EdgeUse]>::sort_unstable);
        Self(uses)
    }

    fn iter(&self) -> impl Iterator<Item = &[EdgeUse]> {
        self.0.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high))
    }

    /// Edges used more often in one direction than in the other.
    fn unbalanced(&self) -> impl Iterator<Item = &[EdgeUse]> {
        self.iter().filter(|uses| 2 * uses.iter().filter(|u| u.forward).count() != uses.len())
    }
}

/// Makes sure that the surface is closed, and turns faces where that is needed for it.
pub(super) fn orient(points: &Points, faces: &mut [Face]) -> Result<(), PolyhedronError> {
    let edges = Edges::of(faces, points.coordinates.len());
    if edges.unbalanced().next().is_none() {
        return Ok(());
    }
    let open: Vec<&[EdgeUse]> = edges.iter().filter(|uses| uses.len() % 2 == 1).collect();
    if let Some(uses) = open.first() {
        let (face, from, to) = describe(uses, points, faces);
        return Err(PolyhedronError::Open { face, from, to, count: open.len() });
    }
    turn_to_agree(&edges, points, faces);
    let edges = Edges::of(faces, points.coordinates.len());
    let torn: Vec<&[EdgeUse]> = edges.unbalanced().collect();
    if let Some(uses) = torn.first() {
        let (face, from, to) = describe(uses, points, faces);
        return Err(PolyhedronError::Unorientable { face, from, to, count: torn.len() });
    }
    Ok(())
}

/// Face, first and second point of an unbalanced edge, in the input's numbers, as used in the prevailing direction.
fn describe(uses: &[EdgeUse], points: &Points, faces: &[Face]) -> (usize, u32, u32) {
    let prevailing = 2 * uses.iter().filter(|u| u.forward).count() > uses.len();
    let chosen = uses.iter().find(|u| u.forward == prevailing).unwrap_or(&uses[0]);
    let (from, to) = chosen.ends();
    (faces[chosen.face as usize].source, points.source[from as usize], points.source[to as usize])
}

/// Turns faces so that any two that share an edge with nobody else use it in opposite directions, as far as that can
/// be, and each connected shell so that it encloses a positive volume.
fn turn_to_agree(edges: &Edges, points: &Points, faces: &mut [Face]) {
    let mut neighbours: Vec<Vec<(u32, bool)>> = vec![Vec::new(); faces.len()];
    for uses in edges.iter() {
        if let [a, b] = uses {
            let disagree = a.forward == b.forward;
            neighbours[a.face as usize].push((b.face, disagree));
            neighbours[b.face as usize].push((a.face, disagree));
        }
    }
    let mut turned: Vec<Option<bool>> = vec![None; faces.len()];
    let mut shell = Vec::new();
    for seed in 0..faces.len() {
        if turned[seed].is_some() {
            continue;
        }
        turned[seed] = Some(false);
        shell.clear();
        shell.push(seed as u32);
        let mut next = 0;
        while let Some(&face) = shell.get(next) {
            next += 1;
            for &(neighbour, disagree) in &neighbours[face as usize] {
                if turned[neighbour as usize].is_none() {
                    turned[neighbour as usize] = turned[face as usize].map(|t| t != disagree);
                    shell.push(neighbour);
                }
            }
        }
        let origin = points.coordinates[faces[seed].corners[0] as usize];
        let mut volume = 0.0;
        for &face in &shell {
            if turned[face as usize] == Some(true) {
                faces[face as usize].corners.reverse();
            }
            volume += fan_volume(&points.coordinates, &faces[face as usize].corners, origin);
        }
        if volume < 0.0 {
            for &face in &shell {
                faces[face as usize].corners.reverse();
            }
        }
    }
}

/// Six times the signed volume between the point `origin` and a face.
fn fan_volume(points: &[Vec3], face: &[u32], origin: Vec3) -> f64 {
    let corner = |i: u32| points[i as usize] - origin;
    let first = corner(face[0]);
    face[1..].windows(2).map(|w| first.dot(corner(w[0]).cross(corner(w[1])))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walks_lose_repeats_and_spikes() {
        let check = |corners: &[u32], expected: &[u32]| {
            assert_eq!(without_repeats(corners.iter().copied()), expected, "{corners:?}");
        };
        check(&[0, 1, 2], &[0, 1, 2]);
        check(&[0, 0, 1, 1, 2, 0], &[0, 1, 2]);
        check(&[0, 1, 2, 1, 3], &[0, 1, 3]);
        check(&[0, 1, 2, 3, 2, 1, 4], &[0, 1, 4]);
        check(&[1, 0, 2, 3, 0], &[0, 2, 3]);
        check(&[0, 2, 3, 0, 1], &[0, 2, 3]);
        check(&[0, 1], &[0, 1]);
        check(&[0, 1, 0], &[0]);
        check(&[5, 5, 5], &[5]);
        check(&[], &[]);
    }
}
