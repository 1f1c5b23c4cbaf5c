//! A slice through the octree and the solid, as data.

use super::Failure;
use octrace::compile::Catalog;
use octrace::octree::Cell;
use octrace::traverse::plane::{Quadtree, Square};
use octrace::{Bounds, Ray, Tracer, Vec3};

/// What a square of the slice is.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Nothing of the solid.
    Outside,
    /// All solid.
    Inside,
    /// What is left of the program there.
    Leaf(Vec<u32>),
}

/// An octree cell where the slice cuts it.
#[derive(Clone, Debug)]
pub struct SliceCell {
    /// How many times the root was divided.
    pub level: u32,
    /// Which cell of its level, along x and y.
    pub index: [u32; 2],
    /// What it is.
    pub content: Content,
}

/// The octree in the plane `z = height`.
#[derive(Debug)]
pub struct Slice<'a> {
    /// The height of the plane.
    pub z: f64,
    /// The root cube.
    pub root: Bounds,
    /// The cells, as the octree has them.
    pub cells: Vec<SliceCell>,
    /// What the cells' programs refer to.
    pub catalog: &'a Catalog,
}

impl<'a> Slice<'a> {
    /// The slice of a tracer with one body at `z`, or through the middle.
    pub fn new(tracer: &'a Tracer, z: Option<f64>) -> Result<Self, Failure> {
        let Some(root) = tracer.octree_bounds(0) else {
            return Err(Failure::NoAnswer("there is no octree to draw: nothing in the solid is bounded".into()));
        };
        let z = z.unwrap_or_else(|| root.center().z);
        if !(root.min.z <= z && z < root.max.z) {
            let (low, high) = (root.min.z, root.max.z);
            return Err(Failure::Usage(format!(
                "a slice at z = {z} misses the octree, which reaches from {low} to {high}"
            )));
        }
        let mut cells = Vec::new();
        let cut = |bounds: &Bounds| bounds.min.z <= z && z < bounds.max.z;
        tracer.visit_octree(0, cut, |found| {
            let content = match found.cell {
                Cell::Outside => Content::Outside,
                Cell::Inside => Content::Inside,
                Cell::Leaf(words) => Content::Leaf(words.to_vec()),
            };
            cells.push(SliceCell { level: found.level, index: [found.index[0], found.index[1]], content });
        });
        Ok(Self { z, root, cells, catalog: tracer.catalog() })
    }

    /// The solid's true section: for each of `rows` lines along x, from low to high y, the stretches that are inside, as
    /// shares of the root's width.
    pub fn section(&self, tracer: &Tracer, rows: usize) -> Vec<Vec<(f64, f64)>> {
        let (low, size) = (self.root.min, self.root.size().x);
        let line = |row: usize| {
            let y = low.y + size * (row as f64 + 0.5) / rows as f64;
            let ray = Ray::checked(Vec3::new(low.x, y, self.z), Vec3::X * size)?;
            let inside = |t: f64| t.clamp(0.0, 1.0);
            let spans = tracer.spans(&ray).into_iter().map(|span| (inside(span.enter_t()), inside(span.exit_t())));
            Some(spans.filter(|(a, b)| a < b).collect())
        };
        (0..rows).map(|row| line(row).unwrap_or_default()).collect()
    }

    /// The slice as a quadtree on a lattice of `2^side_log` units, of `most_levels` at most: a square is divided where its
    /// quarters differ.
    pub fn quadtree(&self, side_log: u32, most_levels: u32) -> Quadtree {
        Quadtree::new(side_log, |square| {
            if square.level >= most_levels {
                return false;
            }
            let inside: Vec<&SliceCell> = self.cells.iter().filter(|cell| cell.lies_in(square)).collect();
            let same =
                |cell: &&SliceCell| cell.content == inside[0].content && !matches!(cell.content, Content::Leaf(_));
            inside.len() > 1 && !inside.iter().all(same)
        })
    }

    /// What a square of that quadtree is: a leaf where it holds different cells.
    pub fn content(&self, square: Square) -> Content {
        let mut contents = self.cells.iter().filter(|cell| cell.lies_in(square) || cell.covers(square));
        let Some(first) = contents.next() else { return Content::Outside };
        match contents.all(|cell| cell.content == first.content) {
            true => first.content.clone(),
            false => Content::Leaf(Vec::new()),
        }
    }
}

impl SliceCell {
    /// The corner with the smallest coordinates, and the side, of a root with sides of 1.
    pub fn area(&self) -> ([f64; 2], f64) {
        let side = 1.0 / f64::from(1_u32 << self.level);
        (self.index.map(|place| f64::from(place) * side), side)
    }

    /// Which cell of a square's level that is, along x and y.
    fn place_of(square: Square) -> [u32; 2] {
        square.corner.map(|corner| (corner / square.side) as u32)
    }

    fn lies_in(&self, square: Square) -> bool {
        self.level >= square.level
            && self.index.map(|place| place >> (self.level - square.level)) == Self::place_of(square)
    }

    fn covers(&self, square: Square) -> bool {
        self.level < square.level
            && Self::place_of(square).map(|place| place >> (square.level - self.level)) == self.index
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::exec::Exec;
    use octrace::octree::BuildOptions;
    use octrace::{Solid, TracerOptions};

    #[test]
    fn cells_and_squares_tile_the_slice() {
        let options =
            TracerOptions { octree: BuildOptions { depth: Some(5), leaf_surfaces: 1 }, ..TracerOptions::default() };
        let solid = Solid::block() - Solid::sphere().scale([0.4, 0.5, 0.6]);
        let tracer = Tracer::build(&solid, &options, &Exec::with_threads(1)).expect("nobody cancels");
        let slice = Slice::new(&tracer, Some(0.3)).unwrap_or_else(|e| panic!("{e}"));
        let area: f64 = slice.cells.iter().map(|cell| cell.area().1 * cell.area().1).sum();
        assert!((area - 1.0).abs() < 1e-12);
        let tree = slice.quadtree(6, 4);
        let leaves = tree.leaves();
        assert_eq!(leaves.iter().map(|square| square.side * square.side).sum::<i64>(), 64 * 64);
        assert!(leaves.iter().all(|square| square.level <= 4) && leaves.len() > 20);
        let kinds = |wanted: &Content| leaves.iter().filter(|square| slice.content(**square) == *wanted).count();
        assert!(kinds(&Content::Outside) > 0 && kinds(&Content::Inside) > 0);
        assert!(Slice::new(&tracer, Some(7.0)).is_err());
    }
}
