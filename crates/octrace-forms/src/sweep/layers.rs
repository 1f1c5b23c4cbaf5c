//! Polyhedra between layers: the same polygons again and again, each time somewhere else.

use octrace::{Polyhedron, PolyhedronError, Solid, Vec2, Vec3};

/// Polygons that bound a region, each with the region to its left, and a cover of the region by convex faces.
pub(super) struct Section {
    /// The corners of all polygons, one polygon after the other.
    pub corners: Vec<Vec2>,
    /// Where each polygon ends in `corners`.
    ends: Vec<u32>,
    /// Which of the polygons are holes.
    holes: Vec<bool>,
    /// Faces that cover the region: indices into `corners`, counter-clockwise.
    cover: Vec<Vec<u32>>,
}

/// What is at the two ends of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ends {
    /// The section.
    Capped,
    /// Nothing: the last layer is the first one.
    Joined,
}

/// How the sides between two layers are cut in triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sides {
    /// Along the shorter diagonal; where both are as long, along this one. For holes the other one.
    Cut(Diagonal),
    /// The same, but along the longer diagonal between the last two layers: the upper one has no width.
    CutToLine(Diagonal),
    /// They are flat and stay whole.
    Whole,
}

/// A diagonal of a side, seen from outside with the first layer below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Diagonal {
    /// From lower left to upper right.
    Rising,
    /// From upper left to lower right.
    Falling,
}

impl Diagonal {
    fn other(self) -> Self {
        match self {
            Self::Rising => Self::Falling,
            Self::Falling => Self::Rising,
        }
    }

    /// The shorter one of a side with these corners; `or` where they are the same length, to what OpenSCAD calls the same.
    fn shorter([a, b, c, d]: [Vec3; 4], or: Self) -> Self {
        const SAME: f64 = 1e-5;
        let flat = |from: Vec3, to: Vec3| Vec2::new(to.x - from.x, to.y - from.y).length();
        let (rising, falling) = (flat(a, c), flat(b, d));
        if 2.0 * (rising - falling).abs() <= SAME * (rising + falling) {
            or
        } else if rising < falling {
            Self::Rising
        } else {
            Self::Falling
        }
    }
}

impl Section {
    /// The section with these outlines: an outer polygon comes counter-clockwise, a hole clockwise.
    pub fn new(polygons: &[Vec<Vec2>]) -> Self {
        let mut ends = Vec::with_capacity(polygons.len());
        let mut corners = Vec::new();
        for polygon in polygons {
            corners.extend_from_slice(polygon);
            ends.push(corners.len() as u32);
        }
        let holes = polygons.iter().map(|polygon| signed_area(polygon) < 0.0).collect();
        let mut section = Self { corners, ends, holes, cover: Vec::new() };
        section.cover = section.with_skipped_corners(section.triangulated(polygons));
        section
    }

    fn triangulated(&self, polygons: &[Vec<Vec2>]) -> Vec<[u32; 3]> {
        let first_of = |polygon: usize| if polygon == 0 { 0 } else { self.ends[polygon - 1] };
        let areas: Vec<f64> = polygons.iter().map(|polygon| signed_area(polygon)).collect();
        let mut triangles = Vec::new();
        let mut earcut = earcut::Earcut::new();
        for outer in (0..polygons.len()).filter(|&i| areas[i] > 0.0) {
            let holes = (0..polygons.len()).filter(|&i| areas[i] < 0.0 && self.is_hole_of(polygons, &areas, i, outer));
            let (mut points, mut numbers, mut starts) = (Vec::new(), Vec::new(), Vec::<u32>::new());
            for polygon in std::iter::once(outer).chain(holes) {
                if polygon != outer {
                    starts.push(points.len() as u32);
                }
                points.extend(polygons[polygon].iter().map(|p| [p.x, p.y]));
                numbers.extend((0..polygons[polygon].len() as u32).map(|k| first_of(polygon) + k));
            }
            let mut cut = Vec::new();
            earcut.earcut(points.iter().copied(), &starts, &mut cut);
            triangles.extend(cut.chunks_exact(3).map(|t: &[u32]| {
                let [a, b, c] = [t[0], t[1], t[2]].map(|k| numbers[k as usize]);
                let corner = |k: u32| self.corners[k as usize];
                if (corner(b) - corner(a)).cross(corner(c) - corner(a)) < 0.0 { [a, c, b] } else { [a, b, c] }
            }));
        }
        triangles
    }

    /// The triangles as faces, with the corners that triangulation skips because they are on a straight line between their
    /// neighbours. The sides of the sweep have them, and the cover must fit the sides.
    fn with_skipped_corners(&self, triangles: Vec<[u32; 3]>) -> Vec<Vec<u32>> {
        let mut used = vec![false; self.corners.len()];
        for &corner in triangles.iter().flatten() {
            used[corner as usize] = true;
        }
        let mut next: Vec<u32> = (1..=self.corners.len() as u32).collect();
        let mut first = 0;
        for &end in &self.ends {
            next[end as usize - 1] = first;
            first = end;
        }
        let face = |triangle: [u32; 3]| {
            let mut face = Vec::with_capacity(3);
            for i in 0..3 {
                let (from, to) = (triangle[i], triangle[(i + 1) % 3]);
                face.push(from);
                let kept = face.len();
                let mut corner = next[from as usize];
                while !used[corner as usize] {
                    face.push(corner);
                    corner = next[corner as usize];
                }
                if corner != to {
                    face.truncate(kept);
                }
            }
            face
        };
        triangles.into_iter().map(face).collect()
    }

    /// Whether `outer` is the smallest outer polygon around the hole.
    fn is_hole_of(&self, polygons: &[Vec<Vec2>], areas: &[f64], hole: usize, outer: usize) -> bool {
        let around = |candidate: &usize| areas[*candidate] > 0.0 && surrounds(&polygons[*candidate], &polygons[hole]);
        (0..polygons.len()).filter(around).min_by(|&a, &b| areas[a].total_cmp(&areas[b])) == Some(outer)
    }

    /// The solid between layers; `place` says where a corner is in a layer. The first layer is at the lower end: seen
    /// against the way of the sweep, the section is as drawn.
    ///
    /// # Errors
    /// If the layers do not bound a solid: see [`PolyhedronError`].
    pub fn sweep(
        &self,
        layers: usize,
        ends: Ends,
        sides: Sides,
        place: impl Fn(usize, Vec2) -> Vec3,
    ) -> Result<Solid, PolyhedronError> {
        let count = self.corners.len() as u32;
        let mut points = Vec::with_capacity(layers * self.corners.len());
        for layer in 0..layers {
            // Adding zero turns -0 into 0: equal points are one.
            points.extend(self.corners.iter().map(|&corner| place(layer, corner) + Vec3::ZERO));
        }
        let mut faces: Vec<Vec<u32>> = Vec::new();
        let bands = if ends == Ends::Joined { layers } else { layers - 1 };
        for band in 0..bands {
            let (low, high) = (band as u32 * count, ((band + 1) % layers) as u32 * count);
            let mut first = 0;
            for (&end, &is_hole) in self.ends.iter().zip(&self.holes) {
                for k in first..end {
                    let next = if k + 1 == end { first } else { k + 1 };
                    let side = [low + k, low + next, high + next, high + k];
                    let (Sides::Cut(or) | Sides::CutToLine(or)) = sides else {
                        faces.push(side.to_vec());
                        continue;
                    };
                    let [a, b, c, d] = side;
                    let or = if is_hole { or.other() } else { or };
                    let shorter = Diagonal::shorter(side.map(|i| points[i as usize]), or);
                    let is_last = matches!(sides, Sides::CutToLine(_)) && band + 1 == bands;
                    match if is_last { shorter.other() } else { shorter } {
                        Diagonal::Rising => faces.extend([vec![a, b, c], vec![a, c, d]]),
                        Diagonal::Falling => faces.extend([vec![a, b, d], vec![b, c, d]]),
                    }
                }
                first = end;
            }
        }
        if ends == Ends::Capped {
            let top = (layers - 1) as u32 * count;
            faces.extend(self.cover.iter().map(|face| face.iter().rev().copied().collect()));
            faces.extend(self.cover.iter().map(|face| face.iter().map(|k| top + k).collect()));
        }
        Polyhedron::new(points, faces).map(Solid::primitive)
    }
}

/// Twice the area, negative for a clockwise polygon.
fn signed_area(polygon: &[Vec2]) -> f64 {
    (0..polygon.len()).map(|i| polygon[i].cross(polygon[(i + 1) % polygon.len()])).sum()
}

/// Whether a polygon that crosses no edge of `outer` lies in it.
fn surrounds(outer: &[Vec2], inner: &[Vec2]) -> bool {
    // Corners may lie on the other's boundary; the middle of some edge does not.
    let votes = (0..inner.len()).map(|i| {
        let probe = (inner[i] + inner[(i + 1) % inner.len()]) * 0.5;
        let crossings = (0..outer.len()).filter(|&k| {
            let (a, b) = (outer[k], outer[(k + 1) % outer.len()]);
            (a.y > probe.y) != (b.y > probe.y) && ((b - a).cross(probe - a) > 0.0) == (b.y > a.y)
        });
        if crossings.count() % 2 == 1 { 1 } else { -1 }
    });
    votes.sum::<i64>() > 0
}
