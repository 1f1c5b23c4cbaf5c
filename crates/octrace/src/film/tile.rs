//! Tiles of a film: the unit of work. Each worker renders one after another, in memory of its own.

use super::RenderStats;
use super::develop::Develop;
use crate::model::CameraRays;
use crate::shade::{EightSeen, Wave, Whitted, Workshop};
use crate::trace::{
    Backend, Counters, EightHits, EightRays, PACKETS as EIGHTS, RayTile, Scratch, TILE_PX, Tiles, Tracer, lane_of,
};

/// The pixels of a tile.
#[derive(Debug)]
pub(super) struct TilePixels<'a> {
    /// The upper left one's place in the film.
    corner: (u32, u32),
    /// Columns and rows.
    size: (u32, u32),
    rows: TileRows<'a>,
}

/// The rows of a tile, each with its pixels; no more than there are.
pub(super) type TileRows<'a> = [&'a mut [[f32; 4]]; TILE_PX];

impl<'a> TilePixels<'a> {
    /// The tiles of a film with rows of so many pixels.
    pub fn of_film(pixels: &'a mut [[f32; 4]], width: usize) -> Vec<Self> {
        let mut tiles = Vec::new();
        for (band, top) in pixels.chunks_mut(width.max(1) * TILE_PX).zip((0..).step_by(TILE_PX)) {
            let first = tiles.len();
            tiles.extend((0..width).step_by(TILE_PX).map(|left| Self {
                corner: (left as u32, top),
                size: ((width - left).min(TILE_PX) as u32, (band.len() / width) as u32),
                rows: Default::default(),
            }));
            for (y, row) in band.chunks_mut(width).enumerate() {
                for (tile, row) in tiles[first..].iter_mut().zip(row.chunks_mut(TILE_PX)) {
                    tile.rows[y] = row;
                }
            }
        }
        tiles
    }
}

/// Camera rays, and what they meet.
pub(super) struct TileCamera<'a> {
    pub tracer: &'a Tracer,
    pub rays: CameraRays,
    pub backend: Backend,
    /// How tiles are traced together, if they can be.
    pub together: Option<Tiles<'a>>,
}

/// The memory of a worker.
#[derive(Debug, Default)]
pub(super) struct Worker {
    scratch: Scratch,
    rays: RayTile,
    wave: Wave,
    sums: Vec<EightSeen>,
}

impl Worker {
    /// Renders a tile.
    pub fn render(&mut self, integrator: &Whitted, camera: &TileCamera, samples: u32, tile: TilePixels) -> RenderStats {
        let Self { scratch, rays, wave, sums } = self;
        let samples = samples.max(1);
        let mut stats = RenderStats::default();
        scratch.counters = Counters::default();
        sums.clear();
        for sample in 0..samples {
            let place = sample_place(sample, samples);
            camera.trace(tile.corner, tile.size, place, (rays, scratch), wave.camera_rays(EIGHTS));
            let mut workshop = Workshop { backend: camera.backend, tile: rays, scratch, counts: &mut stats.rays };
            let seen = wave.light(integrator, &mut workshop);
            if sample == 0 {
                sums.extend_from_slice(seen);
                continue;
            }
            for (sum, seen) in sums.iter_mut().zip(seen) {
                sum.add(seen);
            }
        }
        camera.backend.run(Develop { seen: sums, share: 1.0 / f64::from(samples), rows: tile.rows });
        stats.counters = scratch.counters;
        stats
    }
}

impl TileCamera<'_> {
    /// What the rays through a place of each pixel of a tile meet.
    fn trace(
        &self,
        corner: (u32, u32),
        size: (u32, u32),
        place: (f64, f64),
        (tile, scratch): (&mut RayTile, &mut Scratch),
        (rays, hits): (&mut [EightRays], &mut [EightHits]),
    ) {
        if let Some(tiles) = &self.together {
            tiles.trace(corner, size, place, tile, scratch);
            tiles.eights(tile, rays, hits);
            return;
        }
        for (rays, hits) in rays.iter_mut().zip(&mut *hits) {
            (rays.lanes, hits.met) = (0, 0);
        }
        for (x, y) in (0..size.1).flat_map(|y| (0..size.0).map(move |x| (x, y))) {
            let ray = self.rays.ray(f64::from(corner.0 + x) + place.0, f64::from(corner.1 + y) + place.1);
            let (eight, lane) = lane_of(x as usize, y as usize);
            rays[eight].put(lane, &ray, f64::INFINITY);
            hits[eight].set(lane, self.tracer.first_body_hit(&ray, f64::INFINITY, scratch));
        }
    }
}

/// Where in its pixel a sample lies: the middle for a single one, else a rank-1 lattice by the golden ratio.
fn sample_place(sample: u32, samples: u32) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    if samples == 1 {
        return (0.5, 0.5);
    }
    let i = f64::from(sample);
    ((i + 0.5) / f64::from(samples), (0.5 + i * GOLDEN).fract())
}
