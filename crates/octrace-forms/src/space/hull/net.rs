//! The convex hull of points on corners and round things, which knows on what each point is.

use super::super::convex::triangulated;
use crate::space::round::Extremes;
use octrace::Vec3;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// A convex polyhedron of triangles.
pub(super) struct Net {
    pub points: Vec<Vec3>,
    /// For each point what it is on: round things are counted first, then corners.
    pub owners: Vec<usize>,
    pub triangles: Vec<[u32; 3]>,
}

/// Chains of triangles between two things; each has an edge in common with the next.
pub(super) type Chains = Vec<Vec<usize>>;

impl Net {
    /// The hull of points so close to each other that it is within `deviation` (scene units) of that of the things.
    pub fn new(extremes: &Extremes, deviation: f64) -> Option<Self> {
        // Adding zero makes -0.0 equal to 0.0 to the bit.
        let bits = |p: &Vec3| (*p + Vec3::ZERO).to_array().map(f64::to_bits);
        let mut points = Vec::new();
        let mut owner = HashMap::new();
        for (i, round) in extremes.rounds.iter().enumerate() {
            let first = points.len();
            round.points_on(deviation, &mut points);
            points[first..].iter().for_each(|p| _ = owner.entry(bits(p)).or_insert(i));
        }
        for (i, point) in extremes.points.iter().enumerate() {
            points.push(*point);
            owner.entry(bits(point)).or_insert(extremes.rounds.len() + i);
        }
        let (points, triangles) = triangulated(&points)?;
        let owners = points.iter().map(|p| owner.get(&bits(p)).copied()).collect::<Option<Vec<usize>>>()?;
        Some(Self { points, owners, triangles })
    }

    /// The things that a triangle touches, each once.
    pub fn distinct(&self, triangle: usize) -> [Option<usize>; 3] {
        let owners: BTreeSet<usize> = self.triangles[triangle].iter().map(|&v| self.owners[v as usize]).collect();
        let mut owners = owners.into_iter();
        [(); 3].map(|()| owners.next())
    }

    /// The outward normal of a triangle, of any length.
    pub fn normal(&self, triangle: usize) -> Vec3 {
        let [a, b, c] = self.triangles[triangle].map(|v| self.points[v as usize]);
        (b - a).cross(c - a)
    }

    /// For each two things that edges connect the triangles at these edges, as chains.
    pub fn chains(&self) -> BTreeMap<[usize; 2], Chains> {
        let mut sides: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
        for (i, &[a, b, c]) in self.triangles.iter().enumerate() {
            for (u, v) in [(a, b), (b, c), (c, a)] {
                if self.owners[u as usize] != self.owners[v as usize] {
                    sides.entry([u.min(v), u.max(v)]).or_default().push(i);
                }
            }
        }
        let mut links: BTreeMap<[usize; 2], BTreeMap<usize, Vec<usize>>> = BTreeMap::new();
        for ([u, v], triangles) in &sides {
            let (a, b) = (self.owners[*u as usize], self.owners[*v as usize]);
            if let [s, t] = triangles[..] {
                let links = links.entry([a.min(b), a.max(b)]).or_default();
                links.entry(s).or_default().push(t);
                links.entry(t).or_default().push(s);
            }
        }
        links.into_iter().map(|(pair, links)| (pair, chains(links))).collect()
    }
}

/// Walks along links, of which each node has two at most. Walks that close end with the node that they start with.
fn chains(mut links: BTreeMap<usize, Vec<usize>>) -> Chains {
    let ends: Vec<usize> = links.iter().filter(|(_, next)| next.len() == 1).map(|(&node, _)| node).collect();
    let mut starts = ends.into_iter();
    let mut chains = Vec::new();
    while let Some(start) = starts.next().or_else(|| links.keys().next().copied()) {
        let Some(mut nexts) = links.remove(&start) else { continue };
        let mut chain = vec![start];
        let mut closed = false;
        while let Some(next) = nexts.iter().copied().find(|next| links.contains_key(next)) {
            chain.push(next);
            let following = links.remove(&next).unwrap_or_default();
            closed = chain.len() > 2 && following.contains(&start);
            nexts = following;
        }
        if closed {
            chain.push(start);
        }
        chains.push(chain);
    }
    chains
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chains_are_open_or_closed() {
        let links = [(1, vec![2]), (2, vec![1, 3]), (3, vec![2]), (5, vec![6, 7]), (6, vec![7, 5]), (7, vec![5, 6])];
        assert_eq!(chains(links.into_iter().collect()), [vec![1, 2, 3], vec![5, 6, 7, 5]]);
    }
}
