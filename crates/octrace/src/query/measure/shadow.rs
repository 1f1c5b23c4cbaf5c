//! The picture plane of parallel rays, and the part of it in which the solid can appear.

use super::body::Body;
use crate::exec::{Cancelled, Exec};
use crate::geom::{Bounds, Ray, Vec3};
use std::collections::VecDeque;
use std::rc::Rc;

/// A plane of parallel rays, and a rectangle in it around what a box fills.
pub(super) struct Picture {
    /// Right, up and away: orthonormal.
    pub axes: [Vec3; 3],
    pub center: Vec3,
    /// Half the rectangle's edges, right and up.
    pub half: [f64; 2],
}

impl Picture {
    pub fn around(room: &Bounds) -> Self {
        // Directions as they happen to come from round numbers, multiples of 15 degrees about the axes above all, are at
        // least five degrees away; nor do axis-parallel edges meet the grid at such angles.
        let away = Vec3::new(0.364, 0.8098, 1.0);
        let away = away / away.length();
        let right = Vec3::new(0.619, -0.283, 0.733);
        let right = right - away * right.dot(away);
        let right = right / right.length();
        let axes = [right, away.cross(right), away];
        Self { axes, center: room.center(), half: [0, 1].map(|i| axes[i].abs().dot(room.size()) * 0.5) }
    }

    /// The ray through a point of the picture.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        Ray { origin: self.center + self.axes[0] * x + self.axes[1] * y, direction: self.axes[2] }
    }
}

/// About so many boxes make up the shadow.
const BOXES: usize = 4096;
/// Tiles along each edge of the picture.
const TILES: usize = 512;

/// Tiles of the picture outside of which no ray meets the solid.
pub(super) struct Shadow {
    low: [f64; 2],
    tile: [f64; 2],
    /// Row by row, whether the tile is in the shadow.
    dark: Vec<bool>,
}

impl Shadow {
    /// The shadow of the part of a body in `room`: of boxes that cover it, cut until there are many, the empty ones left
    /// out.
    pub fn of(body: &impl Body, room: &Bounds, picture: &Picture, exec: &Exec) -> Result<Self, Cancelled> {
        let tile = picture.half.map(|half| 2.0 * half / TILES as f64);
        let low = picture.half.map(|half| -half);
        let mut shadow = Self { low, tile, dark: vec![false; TILES * TILES] };
        if room.is_empty() {
            return Ok(shadow);
        }
        let mut boxes = VecDeque::from([(*room, Rc::new(body.whole()))]);
        while let Some((cell, around)) = boxes.pop_front() {
            exec.cancel.check()?;
            let Some(region) = body.narrow(&around, &cell) else { continue };
            if boxes.len() < BOXES && cell.size().max_abs() > tile[0].min(tile[1]) {
                let region = Rc::new(region);
                boxes.extend(cell.halves().map(|half| (half, Rc::clone(&region))));
            } else {
                shadow.darken(&cell, picture);
            }
        }
        Ok(shadow)
    }

    /// Marks the tiles that a box covers.
    fn darken(&mut self, cell: &Bounds, picture: &Picture) {
        let [right, up, away] = picture.axes;
        let offset = cell.center() - picture.center;
        // A little more than the box, for the rounding of rays.
        let half = cell.size() * 0.5 + Vec3::splat(1e-9 * (self.tile[0] + self.tile[1]));
        let (x, y) = (right.dot(offset), up.dot(offset));
        let (reach_x, reach_y) = (right.abs().dot(half), up.abs().dot(half));
        let tiles = |center: f64, reach: f64, axis: usize| {
            let at = |p: f64| ((p - self.low[axis]) / self.tile[axis]).floor().clamp(0.0, TILES as f64 - 1.0) as usize;
            at(center - reach)..=at(center + reach)
        };
        // The shadow of a box is a hexagon, whose other sides are those of the box's edges.
        let sides = [Vec3::X, Vec3::Y, Vec3::Z].map(|edge| {
            let across = away.cross(edge);
            (right.dot(across), up.dot(across), across.abs().dot(half))
        });
        for row in tiles(y, reach_y, 1) {
            for column in tiles(x, reach_x, 0) {
                let dx = self.low[0] + (column as f64 + 0.5) * self.tile[0] - x;
                let dy = self.low[1] + (row as f64 + 0.5) * self.tile[1] - y;
                let covers = |&(a, b, reach): &(f64, f64, f64)| {
                    let tile = 0.5 * (a.abs() * self.tile[0] + b.abs() * self.tile[1]);
                    (a * dx + b * dy).abs() <= reach + tile
                };
                self.dark[row * TILES + column] |= sides.iter().all(covers);
            }
        }
    }

    /// The area in the picture.
    pub fn area(&self) -> f64 {
        self.dark.iter().filter(|&&dark| dark).count() as f64 * self.tile[0] * self.tile[1]
    }

    /// The stretches `from..to` of the line at this height that are in the shadow, from left to right.
    pub fn stretches(&self, y: f64) -> impl Iterator<Item = (f64, f64)> {
        let row = ((y - self.low[1]) / self.tile[1]).floor().clamp(0.0, TILES as f64 - 1.0) as usize;
        let mut place = 0;
        self.dark[row * TILES..(row + 1) * TILES].chunk_by(|a, b| a == b).filter_map(move |tiles| {
            let first = place;
            place += tiles.len();
            let at = |tile: usize| self.low[0] + tile as f64 * self.tile[0];
            tiles[0].then(|| (at(first), at(place)))
        })
    }
}
