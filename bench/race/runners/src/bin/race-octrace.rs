//! octrace in the race: reads a scene, builds, traces on one thread.

use octrace::exec::Exec;
use octrace::model::CameraRays;
use octrace::trace::{Backend, Brightness, EightRays, LANES, RayTile, Scratch, Stored, TILE_PX, Tiles};
use octrace::{Light, Ray, Tracer, TracerOptions, Vec3};
use octrace_race::{Clock, Command, Outcome, argument, serve, write_floats};
use octrace_read::{ReadOptions, Source, read_scene};

const WIDTH: usize = 1024;
const HEIGHT: usize = 768;
/// Pixels along x and along y whose rays are traced as one.
const BLOCK: (usize, usize) = (4, 2);
/// Blocks in a tile.
const BLOCKS: usize = TILE_PX * TILE_PX / LANES;

fn main() -> Outcome {
    let path = argument()?;
    let whole = Clock::start();
    let source = Source::new(path.display().to_string(), std::fs::read(&path)?);
    let checked = read_scene(&source, &ReadOptions::default());
    let scene = checked.value.ok_or("the scene has errors")?.scene;
    let options = TracerOptions { snap: scene.snap, ..TracerOptions::default() };
    let tracer = Tracer::build(&scene.solid, &options, &Exec::with_threads(1))?;
    whole.print(None);

    let camera = scene.camera.ok_or("the scene has no camera")?;
    let Some(Light::Point { position: light, .. }) = scene.lights.first() else {
        return Err("the first light is to be a lamp".into());
    };
    let rays = camera.rays(WIDTH as u32, HEIGHT as u32);
    let view = View::of(&rays);
    let tiles = tracer.tiles(&rays, (WIDTH as u32, HEIGHT as u32), Backend::best());
    let tiles = tiles.ok_or("this scene is not traced in tiles")?;
    let (film, shaded) = (vec![EightPixels::NONE; WIDTH * HEIGHT / LANES], vec![0.0; WIDTH * HEIGHT]);
    let sun = (*light - camera.at).normalized().unwrap_or(Vec3::Z);
    let mut runner =
        Runner { tracer: &tracer, tiles, rays, view, light: *light, sun, film, shaded, shadows: Vec::new() };
    serve(|command| {
        match command {
            Command::Frame => {
                let clock = Clock::start();
                runner.shade();
                clock.print(None);
            }
            Command::Shadow => {
                runner.draw();
                let clock = Clock::start();
                let rays = runner.cast_shadows();
                clock.print(Some(rays));
            }
            Command::Dump(path) => {
                let clock = Clock::start();
                runner.draw();
                write_floats(&path, runner.dump().as_flattened())?;
                clock.print(None);
            }
        }
        Ok(())
    })
}

struct Runner<'a> {
    tracer: &'a Tracer,
    tiles: Tiles<'a>,
    rays: CameraRays,
    view: View,
    light: Vec3,
    /// Where light comes from, to the camera's target.
    sun: Vec3,
    film: Vec<EightPixels>,
    /// Lambert's cosine.
    shaded: Vec<f32>,
    shadows: Vec<EightRays>,
}

/// What a block of [`BLOCK`] pixels shows, row by row.
#[derive(Clone, Copy)]
struct EightPixels {
    /// Distance, infinite where nothing is met.
    t: [f32; LANES],
    /// The unit normal.
    normal: [[f32; LANES]; 3],
}

impl Runner<'_> {
    /// Traces the camera's rays, and stores Lambert's cosine: hit and normal, and a product more.
    fn shade(&mut self) {
        let (mut tile, mut scratch) = (RayTile::default(), Scratch::default());
        let mut pixels = Brightness::default();
        for (left, top) in corners() {
            self.tiles.brightness((left as u32, top as u32), self.sun, &mut tile, &mut scratch, &mut pixels);
            for (y, row) in pixels.0.chunks(TILE_PX).enumerate() {
                let start = (top + y) * WIDTH + left;
                self.shaded[start..start + TILE_PX].copy_from_slice(row);
            }
        }
    }

    /// Traces the camera's rays, and stores distances and normals.
    fn draw(&mut self) {
        let (mut tile, mut scratch) = (RayTile::default(), Scratch::default());
        let mut film = self.film.iter_mut();
        for (left, top) in corners() {
            let size = (TILE_PX as u32, TILE_PX as u32);
            self.tiles.trace((left as u32, top as u32), size, (0.5, 0.5), &mut tile, &mut scratch);
            for (block, pixels) in blocks().zip(&mut film) {
                for (lane, (x, y)) in pixels_of(block).enumerate() {
                    let ray = self.rays.ray((left + x) as f64 + 0.5, (top + y) as f64 + 0.5);
                    let hit = self.tiles.hit(&tile, (x, y)).map(|(_, hit)| hit);
                    pixels.set(lane, hit.map(|hit| (hit.t, self.tracer.surface_point(&ray, &hit).normal)));
                }
            }
        }
    }

    /// From every hit that faces the light a ray to it; returns how many.
    fn cast_shadows(&mut self) -> u64 {
        let (mut tile, mut scratch) = (RayTile::default(), Scratch::default());
        let (mut traced, mut lit) = (0, 0);
        let mut met = [0; BLOCKS];
        for ((left, top), pixels) in corners().zip(self.film.chunks(BLOCKS)) {
            self.shadows.clear();
            let blocks = blocks().map(|(x, y)| (left + x, top + y)).zip(pixels);
            self.shadows.extend(blocks.map(|(corner, pixels)| self.view.to_light(corner, pixels, self.light)));
            self.tracer.eights_blocked_into(&self.shadows, Backend::best(), &mut tile, &mut scratch, &mut met);
            for (rays, met) in self.shadows.iter().zip(met) {
                traced += rays.lanes.count_ones();
                lit += (rays.lanes & !met).count_ones();
            }
        }
        std::hint::black_box(lit);
        u64::from(traced)
    }

    /// Distances and normals, row by row.
    fn dump(&self) -> Vec<[f32; 4]> {
        let mut rows = vec![[0.0; 4]; WIDTH * HEIGHT];
        let places = corners().flat_map(|corner| blocks().map(move |block| (corner, block)));
        for (((left, top), block), pixels) in places.zip(&self.film) {
            for (lane, (x, y)) in pixels_of(block).enumerate() {
                let [nx, ny, nz] = pixels.normal.map(|n| n[lane]);
                rows[(top + y) * WIDTH + left + x] = [pixels.t[lane], nx, ny, nz];
            }
        }
        rows
    }
}

impl EightPixels {
    const NONE: Self = Self { t: [f32::INFINITY; LANES], normal: [[0.0; LANES]; 3] };

    fn set(&mut self, lane: usize, met: Option<(f64, Vec3)>) {
        let (t, normal) = met.unwrap_or((f64::INFINITY, Vec3::ZERO));
        self.t[lane] = t as f32;
        for axis in 0..3 {
            self.normal[axis][lane] = normal[axis] as f32;
        }
    }
}

/// What makes the camera's rays anew, eight at once.
struct View {
    eye: Vec3,
    forward: Vec3,
    /// From a pixel to the next in its row, and in its column, a unit ahead.
    right: Vec3,
    down: Vec3,
}

impl View {
    fn of(rays: &CameraRays) -> Self {
        let middle = (WIDTH as f64 / 2.0, HEIGHT as f64 / 2.0);
        let Ray { origin: eye, direction: forward } = rays.ray(middle.0, middle.1);
        let ahead = |x: f64, y: f64| {
            let direction = rays.ray(middle.0 + x, middle.1 + y).direction;
            direction / direction.dot(forward) - forward
        };
        Self { eye, forward, right: ahead(1.0, 0.0), down: ahead(0.0, 1.0) }
    }

    /// The rays from what the pixels of a block show to the light, where that is on the outer side.
    fn to_light(&self, (left, top): (usize, usize), pixels: &EightPixels, light: Vec3) -> EightRays {
        let mut rays = EightRays { end: Stored([1.0; LANES]), ..EightRays::NONE };
        let x: [f64; LANES] = std::array::from_fn(|lane| (left + lane % BLOCK.0) as f64 + (0.5 - WIDTH as f64 / 2.0));
        let y: [f64; LANES] = std::array::from_fn(|lane| (top + lane / BLOCK.0) as f64 + (0.5 - HEIGHT as f64 / 2.0));
        let t = pixels.t.map(|t| if t < f32::INFINITY { f64::from(t) } else { 0.0 });
        let (mut direction, mut squared, mut facing) = ([[0.0; LANES]; 3], [0.0; LANES], [0.0; LANES]);
        let [eye, forward, right, down, light] = [self.eye, self.forward, self.right, self.down, light].map(axes);
        for axis in 0..3 {
            for lane in 0..LANES {
                let along = forward[axis] + x[lane] * right[axis] + y[lane] * down[axis];
                direction[axis][lane] = along;
                squared[lane] += along * along;
            }
        }
        for axis in 0..3 {
            for lane in 0..LANES {
                let normal = f64::from(pixels.normal[axis][lane]);
                let along = t[lane] / squared[lane].sqrt() * direction[axis][lane];
                let origin = eye[axis] + along + 1e-4 * t[lane] * normal;
                rays.origin[axis].0[lane] = origin;
                rays.direction[axis].0[lane] = light[axis] - origin;
                facing[lane] += normal * (light[axis] - origin);
            }
        }
        rays.lanes = (0..LANES).fold(0, |lanes, lane| lanes | u8::from(facing[lane] > 0.0) << lane);
        rays
    }
}

fn axes(v: Vec3) -> [f64; 3] {
    [v.x, v.y, v.z]
}

/// The upper left corners of all tiles.
fn corners() -> impl Iterator<Item = (usize, usize)> {
    (0..HEIGHT).step_by(TILE_PX).flat_map(|top| (0..WIDTH).step_by(TILE_PX).map(move |left| (left, top)))
}

/// Where in a tile its blocks are, four neighbours at a time.
fn blocks() -> impl Iterator<Item = (usize, usize)> {
    let (columns, rows) = (TILE_PX / BLOCK.0 / 2, TILE_PX / BLOCK.1 / 2);
    (0..columns * rows * 4).map(move |i| {
        let (column, row) = (i / 4 % columns * 2 + i % 2, i / 4 / columns * 2 + i / 2 % 2);
        (column * BLOCK.0, row * BLOCK.1)
    })
}

/// The pixels of a block.
fn pixels_of((left, top): (usize, usize)) -> impl Iterator<Item = (usize, usize)> {
    (0..BLOCK.1).flat_map(move |y| (0..BLOCK.0).map(move |x| (left + x, top + y)))
}
