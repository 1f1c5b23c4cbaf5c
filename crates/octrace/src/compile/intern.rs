//! Coincident surfaces become one surface.
//!
//! Faces that coincide in the model must be *the same object* in the program: only then do rays cross them at the same
//! parameter, bit for bit, and only then is coincidence something known instead of something guessed. Two faces that are
//! meant to coincide come out of different matrices and different roundings, so they are compared with a tolerance: at
//! least what rounding may do, at most the import tolerance that the scene asks for. The larger face wins, since its
//! plane is known best; planes within tolerance of an axis are put exactly on it.

use super::face::Face;
use super::facets::Faces;
use super::place::Place;
use crate::exec::{CancelToken, Cancelled};
use crate::geom::{Affine, Bounds, Vec3};
use crate::primitive::SurfaceRef;
use crate::surface::{Plane, Quadric, QuadricKind, Surface, Torus};
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// What joining surfaces did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompileReport {
    /// Largest distance, in scene units, over which surfaces were joined or moved.
    pub tolerance: f64,
    /// How many surfaces were moved by more than rounding explains.
    pub snapped_surfaces: usize,
    /// The farthest that a face was moved, in scene units.
    pub largest_move: f64,
}

impl CompileReport {
    /// Of both together.
    pub(super) fn and(self, o: Self) -> Self {
        Self {
            tolerance: self.tolerance.max(o.tolerance),
            snapped_surfaces: self.snapped_surfaces + o.snapped_surfaces,
            largest_move: self.largest_move.max(o.largest_move),
        }
    }
}

/// So many faces are worth several threads.
const MANY: usize = 1 << 14;

/// Gives every face a surface; coincident ones the same. Returns the references in the order of `faces`.
///
/// # Errors
/// If somebody cancels.
pub(super) fn intern(
    faces: &Faces,
    extent: &Bounds,
    snap: f64,
    surfaces: &mut Vec<Surface>,
    cancel: &CancelToken,
) -> Result<(Vec<SurfaceRef>, CompileReport), Cancelled> {
    // Larger ones first, else as they come: sizes that differ by rounding are the same, and neighbours in the model are
    // neighbours in memory.
    let place = |room: &mut Vec<Vec3>, i: usize| {
        let size = faces.size(i, room) as f32;
        u64::from(!size.to_bits()) << 32 | i as u64
    };
    let mut room = Vec::new();
    let mut order: Vec<u64> = match faces.len() < MANY {
        true => (0..faces.len()).map(|i| place(&mut room, i)).collect(),
        false => (0..faces.len()).into_par_iter().map_init(Vec::new, place).collect(),
    };
    order.sort_unstable();
    // Few faces of a mesh share a plane; memory is asked for once.
    surfaces.reserve(faces.of_meshes());
    let mut interner = Interner::new(extent, snap, surfaces);
    let mut refs = vec![SurfaceRef { surface: 0, flipped: false }; faces.len()];
    for index in order.into_iter().map(|place| place as u32 as usize) {
        cancel.check()?;
        let face = faces.get(index);
        refs[index] = interner.face(&face, face.samples(&mut room));
    }
    Ok((refs, interner.report))
}

struct Interner<'a> {
    surfaces: &'a mut Vec<Surface>,
    /// The newest surface of each bin.
    bins: FxHashMap<u64, u32>,
    /// For every surface the next older one in its bin.
    older: Vec<Option<u32>>,
    center: Vec3,
    radius: f64,
    /// Faces this close are the same, in scene units.
    tolerance: f64,
    /// Moves longer than this count as snapping; shorter ones are what long products of matrices do.
    noteworthy: f64,
    /// Normals of equal planes differ by no more than this, by component.
    normal_tolerance: f64,
    /// Positions of equal surfaces, as far as bins see them, differ by no more than this.
    place_tolerance: f64,
    report: CompileReport,
}

/// Bins are this many tolerances wide, so that most lookups need one bin only.
const BIN_WIDTH: f64 = 16.0;

impl<'a> Interner<'a> {
    fn new(extent: &Bounds, snap: f64, surfaces: &'a mut Vec<Surface>) -> Self {
        let extent = if extent.is_empty() || !extent.is_bounded() {
            Bounds::new(Vec3::splat(-1.0), Vec3::splat(1.0))
        } else {
            *extent
        };
        let farthest = extent.min.max_abs().max(extent.max.max_abs());
        let size = extent.diagonal();
        // A few dozen roundings of coordinates of this size.
        let rounding = 64.0 * f64::EPSILON * farthest;
        let tolerance = rounding.max(snap * size);
        let normal_tolerance = if snap > 0.0 { 1e-5_f64.max(4.0 * snap) } else { 1e-11 };
        let place_tolerance = tolerance + normal_tolerance * size;
        let noteworthy = rounding.max(1e-10 * size);
        let report = CompileReport { tolerance, ..CompileReport::default() };
        let (bins, older, center, radius) = (FxHashMap::default(), Vec::new(), extent.center(), size / 2.0);
        Self { surfaces, bins, older, center, radius, tolerance, noteworthy, normal_tolerance, place_tolerance, report }
    }

    /// The surface of a face with those samples.
    fn face(&mut self, face: &Face, samples: &[Vec3]) -> SurfaceRef {
        match face {
            Face::Plane { plane, corners } => self.plane(plane, corners),
            Face::Unbounded { plane } => self.plane(plane, &self.corners_of(plane)),
            Face::Quadric { kind, map, to_local, .. } => self.quadric(*kind, map, *to_local, samples),
            Face::Torus { kind, minor, map, to_local } => {
                let place = Place { kind: 4 + *kind as u8, at: (map.translation - self.center).to_array(), extra: 0.0 };
                self.curved(Surface::Torus(Torus { kind: *kind, minor: *minor, to_local: *to_local }), place, samples)
            }
        }
    }

    fn plane(&mut self, plane: &Plane, corners: &[Vec3; 4]) -> SurfaceRef {
        let plane = self.on_axis(plane, corners);
        // One of the components of a unit normal exceeds one half; the first that does gives the sign.
        let sign_of = |n: Vec3| n.to_array().into_iter().find(|c| c.abs() > 0.5).unwrap_or(n.x) < 0.0;
        let flipped = sign_of(plane.normal);
        let ambiguous = plane.normal.to_array().iter().any(|c| (c.abs() - 0.5).abs() < 1e-3);
        let oriented = |flip: bool| match flip {
            false => plane,
            true => Plane { normal: -plane.normal, offset: -plane.offset },
        };
        for flip in [flipped, !flipped].into_iter().take(if ambiguous { 2 } else { 1 }) {
            let candidate = oriented(flip);
            let place = self.plane_place(&candidate);
            if let Some(surface) = self.find(&Surface::Plane(candidate), place, Some(corners)) {
                return SurfaceRef { surface, flipped: flip };
            }
        }
        let stored = oriented(flipped);
        let surface = self.insert(Surface::Plane(stored), self.plane_place(&stored));
        SurfaceRef { surface, flipped }
    }

    /// Four points of the plane around the scene.
    fn corners_of(&self, plane: &Plane) -> [Vec3; 4] {
        let n = plane.normal;
        let middle = self.center - n * (n.dot(self.center) - plane.offset);
        let side = if n.x.abs() < 0.5 { Vec3::X } else { Vec3::Y };
        let u = n.cross(side).normalized().unwrap_or(side) * self.radius;
        let v = n.cross(u);
        let exact = n.to_array().iter().position(|c| c.abs() == 1.0);
        [middle + u, middle + v, middle - u, middle - v].map(|mut corner| {
            if let Some(axis) = exact {
                // Rounding shall not move it off its place on the axis.
                corner[axis] = n[axis] * plane.offset;
            }
            corner
        })
    }

    /// The plane put exactly on an axis where that moves no corner by more than the tolerance.
    fn on_axis(&mut self, plane: &Plane, corners: &[Vec3; 4]) -> Plane {
        let n = plane.normal;
        let axis = if n.x.abs() > 0.9 {
            0
        } else if n.y.abs() > 0.9 {
            1
        } else {
            2
        };
        let mut exact = Vec3::ZERO;
        exact[axis] = n[axis].signum();
        if (n - exact).max_abs() > self.normal_tolerance {
            return *plane;
        }
        let (low, high) = corners
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| (low.min(c[axis]), high.max(c[axis])));
        let moved = (high - low) / 2.0;
        if moved > self.tolerance {
            return *plane;
        }
        self.note_move(moved);
        let height = if low == high { low } else { low + moved };
        Plane { normal: exact, offset: exact[axis] * height }
    }

    fn quadric(&mut self, kind: QuadricKind, map: &Affine, to_local: Affine, samples: &[Vec3]) -> SurfaceRef {
        let anchor = match kind {
            QuadricKind::Sphere | QuadricKind::Cone => map.translation,
            QuadricKind::Cylinder => {
                // The point of the axis that is nearest to the middle of the scene.
                let axis = map.column(2).normalized().unwrap_or(Vec3::Z);
                map.translation + axis * axis.dot(self.center - map.translation)
            }
        };
        let place = Place { kind: 1 + kind as u8, at: (anchor - self.center).to_array(), extra: 0.0 };
        self.curved(Surface::Quadric(Quadric { kind, to_local }), place, samples)
    }

    /// A surface whose inside needs no choosing.
    fn curved(&mut self, surface: Surface, place: Place, samples: &[Vec3]) -> SurfaceRef {
        // Where all samples of a face are as good as one point, they tell nothing: only the very same surface is another's.
        let samples = (thickness(&surface) > FEWEST_TOLERANCES * self.tolerance).then_some(samples);
        let surface = self.find(&surface, place, samples).unwrap_or_else(|| self.insert(surface, place));
        SurfaceRef { surface, flipped: false }
    }

    fn plane_place(&self, plane: &Plane) -> Place {
        // Normals are scaled so that their tolerance equals that of places.
        let scaled = plane.normal * (self.place_tolerance / self.normal_tolerance);
        Place { kind: 0, at: scaled.to_array(), extra: plane.offset - plane.normal.dot(self.center) }
    }

    /// A surface within tolerance of all the samples, if there is one near that place: the oldest. Or the very same one:
    /// what was squeezed a lot may itself be off its samples.
    fn find(&mut self, wanted: &Surface, place: Place, samples: Option<&[Vec3]>) -> Option<u32> {
        let matching = |surface: u32| {
            let surface = &self.surfaces[surface as usize];
            if surface.same_numbers(wanted) {
                return Some(0.0);
            }
            let mut farthest = 0.0_f64;
            for &p in samples? {
                farthest = farthest.max(surface.distance(p));
                if farthest > self.tolerance {
                    return None;
                }
            }
            Some(farthest)
        };
        let mut best: Option<(u32, f64)> = None;
        place.for_each_bin(self.bin_width(), self.place_tolerance, |bin| {
            let mut next = self.bins.get(&bin).copied();
            while let Some(surface) = next {
                if best.is_none_or(|(best, _)| surface < best)
                    && let Some(moved) = matching(surface)
                {
                    best = Some((surface, moved));
                }
                next = self.older[surface as usize];
            }
        });
        let (surface, moved) = best?;
        self.note_move(moved);
        Some(surface)
    }

    fn insert(&mut self, surface: Surface, place: Place) -> u32 {
        let id = self.surfaces.len() as u32;
        self.surfaces.push(surface);
        self.older.resize(id as usize, None);
        self.older.push(self.bins.insert(place.own_bin(self.bin_width()), id));
        id
    }

    fn bin_width(&self) -> f64 {
        self.place_tolerance * BIN_WIDTH
    }

    fn note_move(&mut self, moved: f64) {
        if moved > self.noteworthy {
            self.report.snapped_surfaces += 1;
        }
        self.report.largest_move = self.report.largest_move.max(moved);
    }
}

/// What a curved surface surrounds is thicker than so many tolerances, if its samples are to tell it from others.
const FEWEST_TOLERANCES: f64 = 4.0;

/// How thick what a curved surface surrounds is at least where it is thinnest, roughly: half of it, or of its tube.
fn thickness(surface: &Surface) -> f64 {
    let steepest = |rows: &[Vec3]| rows.iter().map(|row| row.length()).fold(0.0, f64::max);
    match surface {
        Surface::Quadric(Quadric { kind: QuadricKind::Cylinder, to_local }) => 1.0 / steepest(&to_local.rows[..2]),
        Surface::Quadric(Quadric { to_local, .. }) => 1.0 / steepest(&to_local.rows),
        Surface::Torus(torus) => torus.minor / steepest(&torus.to_local.rows),
        Surface::Plane(_) | Surface::Mesh(_) | Surface::Placed(_) => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::TorusKind;

    fn square(z: f64, tilt: f64, size: f64) -> Face {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(x, y)| Vec3::new(x * size, y * size, z + tilt * x * size));
        let normal = Vec3::new(-tilt, 0.0, 1.0).normalized().unwrap();
        Face::Plane { plane: Plane { normal, offset: normal.dot(corners[0]) }, corners }
    }

    fn listed(faces: &[Face]) -> Faces {
        let mut all = Faces::default();
        faces.iter().for_each(|face| all.push(face.clone()));
        all
    }

    fn interned(faces: &[Face], snap: f64) -> (Vec<SurfaceRef>, CompileReport) {
        let extent = Bounds::new(Vec3::splat(-10.0), Vec3::splat(10.0));
        intern(&listed(faces), &extent, snap, &mut Vec::new(), &CancelToken::new()).expect("nobody cancels")
    }

    #[test]
    fn planes_that_differ_by_rounding_are_one() {
        let (refs, report) = interned(&[square(0.3, 0.0, 1.0), square(0.1 + 0.2, 0.0, 2.0)], 0.0);
        assert_eq!(refs[0], refs[1]);
        assert_eq!(report.snapped_surfaces, 0);
    }

    #[test]
    fn opposite_faces_share_a_surface() {
        let Face::Plane { plane, corners } = square(2.0, 0.25, 1.0) else { unreachable!() };
        let back = Face::Plane { plane: Plane { normal: -plane.normal, offset: -plane.offset }, corners };
        let (refs, _) = interned(&[square(2.0, 0.25, 1.0), back], 0.0);
        assert_eq!(refs[0].surface, refs[1].surface);
        assert_ne!(refs[0].flipped, refs[1].flipped);
    }

    #[test]
    fn import_tolerance_joins_what_six_digits_tore_apart() {
        let faces = [square(1.0, 0.0, 9.0), square(1.000_01, 0.0, 1.0), square(1.001, 0.0, 1.0)];
        let (exact, _) = interned(&faces, 0.0);
        assert_ne!(exact[0], exact[1]);
        let (snapped, report) = interned(&faces, 2e-6);
        assert_eq!(snapped[0], snapped[1]);
        assert_ne!(snapped[0], snapped[2]);
        assert_eq!(report.snapped_surfaces, 1);
        assert!((report.largest_move - 1e-5).abs() < 1e-12);
    }

    #[test]
    fn the_same_face_twice_is_one_surface_however_far_off_its_corners() {
        let Face::Plane { plane, corners } = square(2.0, 0.25, 1.0) else { unreachable!() };
        let off = Face::Plane { plane: Plane { offset: plane.offset + 1e-6, ..plane }, corners };
        let (refs, _) = interned(&[off.clone(), off], 0.0);
        assert_eq!(refs[0], refs[1]);
    }

    #[test]
    fn a_tilted_face_is_judged_where_it_is() {
        // The large one rises by 9e-4 over its width and stays; the small one rises by 1e-5 and joins the flat one.
        let flat = square(0.0, 0.0, 10.0);
        let (refs, _) = interned(&[flat, square(0.0, 1e-4, 9.0), square(0.0, 1e-6, 8.0)], 2e-6);
        assert_ne!(refs[0], refs[1]);
        assert_eq!(refs[0], refs[2]);
    }

    #[test]
    fn an_endless_plane_on_an_axis_stays_where_it_is() {
        let plane = Plane { normal: -Vec3::Z, offset: 0.1 };
        let extent = Bounds::new(Vec3::new(-1.0 / 3.0, -0.7, -0.3), Vec3::new(0.1, 1.0 / 7.0, 2.9));
        let mut surfaces = Vec::new();
        let faces = listed(&[Face::Unbounded { plane }]);
        let _ = intern(&faces, &extent, 0.0, &mut surfaces, &CancelToken::new());
        let [Surface::Plane(stored)] = surfaces[..] else { unreachable!("one plane") };
        assert_eq!(stored, Plane { normal: Vec3::Z, offset: -0.1 });
    }

    #[test]
    fn cones_smaller_than_rounding_are_not_taken_for_others() {
        // Two cones with one apex that stand across each other, both thinner than the tolerance.
        let cone = |turn: f64| {
            let map = Affine::scale(Vec3::splat(1e-16)) * Affine::rotation_deg(Vec3::new(turn, 0.0, 0.0));
            Face::Quadric { kind: QuadricKind::Cone, map, to_local: map.inverse().unwrap(), heights: (1.0, 0.5) }
        };
        let (refs, _) = interned(&[cone(0.0), cone(90.0), cone(0.0)], 0.0);
        assert_ne!(refs[0], refs[1]);
        assert_eq!(refs[0], refs[2]);
    }

    #[test]
    fn tori_that_look_the_same_are_one() {
        let torus = |minor: f64, map: Affine| Face::Torus {
            kind: TorusKind::Outer,
            minor,
            map,
            to_local: map.inverse().unwrap(),
        };
        let at = |turn: f64, size: f64| {
            Affine::translation(Vec3::new(0.1, 0.2, 0.3))
                * Affine::rotation_deg(Vec3::new(30.0, 0.0, 0.0))
                * Affine::rotation_deg(Vec3::new(0.0, 0.0, turn))
                * Affine::scale(Vec3::splat(size))
        };
        let turned_over = at(0.0, 2.0) * Affine::rotation_deg(Vec3::new(180.0, 0.0, 0.0));
        for minor in [0.25, 1.5] {
            let (refs, _) = interned(
                &[
                    torus(minor, at(0.0, 2.0)),
                    torus(minor, at(17.0, 2.0)),
                    torus(minor, turned_over),
                    torus(minor * 1.001, at(0.0, 2.0)),
                    torus(minor, at(0.0, 2.001)),
                ],
                0.0,
            );
            assert_eq!(refs[0], refs[1]);
            assert_eq!(refs[0], refs[2]);
            assert!((refs[0] != refs[3]) && (refs[0] != refs[4]) && (refs[3] != refs[4]));
        }
    }
}
