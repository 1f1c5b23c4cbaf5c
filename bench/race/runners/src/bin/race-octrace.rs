//! octrace in the race: reads a scene, builds, traces on one thread.

use octrace::exec::Exec;
use octrace::model::CameraRays;
use octrace::trace::{Backend, Brightness, RayTile, RayTo, Scratch, TILE_PX, Tiles};
use octrace::{Hit, Light, Ray, Tracer, TracerOptions, Vec3};
use octrace_race::{Clock, Command, Outcome, argument, serve, write_floats};
use octrace_read::{ReadOptions, Source, read_scene};

const WIDTH: usize = 1024;
const HEIGHT: usize = 768;

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
    let tiles = tracer.tiles(&rays, (WIDTH as u32, HEIGHT as u32), Backend::best());
    let tiles = tiles.ok_or("this scene is not traced in tiles")?;
    let (film, shaded) = (vec![[0.0; 4]; WIDTH * HEIGHT], vec![0.0; WIDTH * HEIGHT]);
    let sun = (*light - camera.at).normalized().unwrap_or(Vec3::Z);
    let mut runner = Runner { tracer: &tracer, tiles, rays, light: *light, sun, film, shaded };
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
                write_floats(&path, runner.film.as_flattened())?;
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
    light: Vec3,
    /// Where light comes from, to the camera's target.
    sun: Vec3,
    /// Distance, infinite where nothing is met, and unit normal.
    film: Vec<[f32; 4]>,
    /// Lambert's cosine.
    shaded: Vec<f32>,
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
        for (left, top) in corners() {
            let size = (TILE_PX as u32, TILE_PX as u32);
            self.tiles.trace((left as u32, top as u32), size, (0.5, 0.5), &mut tile, &mut scratch);
            for (x, y) in pixels() {
                let ray = self.rays.ray((left + x) as f64 + 0.5, (top + y) as f64 + 0.5);
                let hit = self.tiles.hit(&tile, (x, y)).map(|(_, hit)| hit);
                self.film[(top + y) * WIDTH + left + x] = stored(self.tracer, &ray, hit);
            }
        }
    }

    /// From every hit that faces the light a ray to it; returns how many.
    fn cast_shadows(&self) -> u64 {
        let (mut tile, mut scratch) = (RayTile::default(), Scratch::default());
        let (mut traced, mut lit) = (0, 0);
        let mut shadows: Vec<RayTo> = Vec::new();
        let mut met = Vec::new();
        for (left, top) in corners() {
            shadows.clear();
            shadows.extend(pixels().filter_map(|(x, y)| self.to_light(left + x, top + y)));
            met.clear();
            met.resize(shadows.len(), false);
            self.tracer.blocked_into(&shadows, Backend::best(), &mut tile, &mut scratch, &mut met);
            traced += shadows.len();
            lit += met.iter().filter(|blocked| !**blocked).count();
        }
        std::hint::black_box(lit);
        traced as u64
    }

    /// The ray from what a pixel shows to the light, if that is on the outer side.
    fn to_light(&self, x: usize, y: usize) -> Option<RayTo> {
        let [t, nx, ny, nz] = self.film[y * WIDTH + x];
        if t.is_infinite() {
            return None;
        }
        let ray = self.rays.ray(x as f64 + 0.5, y as f64 + 0.5);
        let normal = Vec3::new(nx.into(), ny.into(), nz.into());
        let origin = ray.at(f64::from(t)) + normal * (1e-4 * f64::from(t));
        let direction = self.light - origin;
        (normal.dot(direction) > 0.0).then_some(RayTo { ray: Ray { origin, direction }, end: 1.0 })
    }
}

/// The upper left corners of all tiles.
fn corners() -> impl Iterator<Item = (usize, usize)> {
    (0..HEIGHT).step_by(TILE_PX).flat_map(|top| (0..WIDTH).step_by(TILE_PX).map(move |left| (left, top)))
}

/// The pixels of a tile.
fn pixels() -> impl Iterator<Item = (usize, usize)> {
    (0..TILE_PX).flat_map(|y| (0..TILE_PX).map(move |x| (x, y)))
}

fn stored(tracer: &Tracer, ray: &Ray, hit: Option<Hit>) -> [f32; 4] {
    let Some(hit) = hit else { return [f32::INFINITY, 0.0, 0.0, 0.0] };
    let normal = tracer.surface_point(ray, &hit).normal;
    [hit.t, normal.x, normal.y, normal.z].map(|v| v as f32)
}
