//! octrace in the race: reads a scene, builds, traces on one thread.

use octrace::exec::Exec;
use octrace::model::CameraRays;
use octrace::trace::{Backend, Scratch, TILE_PX, Tiles};
use octrace::{Bounds, Hit, Light, Ray, Tracer, TracerOptions, Vec3};
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
    let tiles = tracer.tiles(&Bounds::around([camera.eye]), Backend::best());
    let tiles = tiles.ok_or("this scene is not traced in tiles")?;
    let mut runner = Runner { tracer: &tracer, tiles, rays, light: *light, film: vec![[0.0; 4]; WIDTH * HEIGHT] };
    serve(|command| {
        match command {
            Command::Frame => {
                let clock = Clock::start();
                runner.draw();
                clock.print(None);
            }
            Command::Shadow => {
                runner.draw();
                let clock = Clock::start();
                let rays = runner.shade();
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
    /// Distance, infinite where nothing is met, and unit normal.
    film: Vec<[f32; 4]>,
}

impl Runner<'_> {
    /// Traces the camera's rays, and stores distances and normals.
    fn draw(&mut self) {
        let mut scratch = Scratch::default();
        for top in (0..HEIGHT).step_by(TILE_PX) {
            for left in (0..WIDTH).step_by(TILE_PX) {
                let ray = |x: f64, y: f64| self.rays.ray(left as f64 + x, top as f64 + y);
                let hits = self.tiles.hits(ray, (0.5, 0.5), (TILE_PX, TILE_PX), &mut scratch);
                for (y, row) in hits.iter().enumerate() {
                    for (x, hit) in row.iter().enumerate() {
                        let ray = ray(x as f64 + 0.5, y as f64 + 0.5);
                        self.film[(top + y) * WIDTH + left + x] = stored(self.tracer, &ray, hit.map(|(_, hit)| hit));
                    }
                }
            }
        }
    }

    /// From every hit that faces the light a ray to it; returns how many.
    fn shade(&self) -> u64 {
        let mut scratch = Scratch::default();
        let (mut traced, mut lit) = (0, 0_u64);
        for (index, &[t, nx, ny, nz]) in self.film.iter().enumerate() {
            if t.is_infinite() {
                continue;
            }
            let ray = self.rays.ray((index % WIDTH) as f64 + 0.5, (index / WIDTH) as f64 + 0.5);
            let normal = Vec3::new(nx.into(), ny.into(), nz.into());
            let origin = ray.at(f64::from(t)) + normal * (1e-4 * f64::from(t));
            let direction = self.light - origin;
            if normal.dot(direction) > 0.0 {
                traced += 1;
                let shadow = Ray { origin, direction };
                lit += u64::from(self.tracer.first_hit_within(&shadow, 1.0, &mut scratch).is_none());
            }
        }
        std::hint::black_box(lit);
        traced
    }
}

fn stored(tracer: &Tracer, ray: &Ray, hit: Option<Hit>) -> [f32; 4] {
    let Some(hit) = hit else { return [f32::INFINITY, 0.0, 0.0, 0.0] };
    let normal = tracer.surface_point(ray, &hit).normal;
    [hit.t, normal.x, normal.y, normal.z].map(|v| v as f32)
}
