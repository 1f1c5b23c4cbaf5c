//! fidget in the race: its JIT, its raster of depths and normals, one thread, 1024 voxels deep.
//!
//! Reads the listing of a scene (`../race/digest.py`) with two more lines before it: the frame of the camera, and how far
//! the nearest and the farthest thing seen are.

use fidget::context::Tree;
use fidget::jit::JitShape;
use fidget::raster::voxel::{EvalConfig, Image, RenderConfig, RenderSize, render};
use nalgebra::Matrix4;
use octrace_race::{Clock, Command, Outcome, argument, serve, write_floats};

const WIDTH: u32 = 1024;
const HEIGHT: u32 = 768;
const VOXELS_DEEP: u32 = 1024;

fn main() -> Outcome {
    let path = argument()?;
    let whole = Clock::start();
    let text = std::fs::read_to_string(&path)?;
    let mut lines = text.lines();
    let view = View::read(&mut lines)?;
    let tree = solid(&mut lines)?;
    let shape = JitShape::from(tree);
    whole.print(None);

    let config =
        RenderConfig { image_size: RenderSize::new(WIDTH, HEIGHT, VOXELS_DEEP), world_to_model: view.world_to_model() };
    let evaluation = || EvalConfig { threads: None, ..EvalConfig::default() };
    let draw =
        || -> Outcome<Image> { Ok(render(shape.clone().try_into()?, &config, &evaluation()).ok_or("nobody cancels")?) };
    serve(|command| {
        let clock = Clock::start();
        let image = draw()?;
        match command {
            Command::Frame => clock.print(None),
            Command::Shadow => return Err("fidget has no rays".into()),
            Command::Dump(path) => {
                write_floats(&path, view.distances(&image).as_flattened())?;
                clock.print(None);
            }
        }
        Ok(())
    })
}

/// A camera, and what part of space it sees.
struct View {
    eye: [f32; 3],
    /// From the middle of the film, at distance 1, to its upper edge.
    up: [f32; 3],
    /// As far to the right.
    right: [f32; 3],
    ahead: [f32; 3],
    near: f32,
    far: f32,
}

impl View {
    fn read<'a>(lines: &mut impl Iterator<Item = &'a str>) -> Outcome<Self> {
        let frame = numbers(lines.next().ok_or("the frame is missing")?)?;
        let depths = numbers(lines.next().ok_or("the depths are missing")?)?;
        let vector = |i: usize| -> Outcome<[f32; 3]> {
            Ok(frame.get(3 * i..3 * i + 3).ok_or("the frame is four vectors")?.try_into()?)
        };
        let [near, far] = depths[..] else { return Err("depths are two numbers".into()) };
        let aspect = HEIGHT as f32 / WIDTH as f32;
        let (eye, right, up, ahead) = (vector(0)?, vector(1)?.map(|c| c * aspect), vector(2)?, vector(3)?);
        Ok(Self { eye, up, right, ahead, near, far })
    }

    /// Fidget's depth goes from minus to plus this, from far to near.
    const HALF_DEPTH: f32 = VOXELS_DEEP as f32 / HEIGHT as f32;

    /// What turns distance ahead `d` into fidget's depth: `z = a + b / d`.
    fn depth_map(&self) -> (f32, f32) {
        let b = 2.0 * Self::HALF_DEPTH / (1.0 / self.near - 1.0 / self.far);
        (Self::HALF_DEPTH - b / self.near, b)
    }

    /// Perspective the other way round: from fidget's cube to the scene, in homogeneous coordinates.
    fn world_to_model(&self) -> Matrix4<f32> {
        let (a, b) = self.depth_map();
        let row = |i: usize| [b * self.right[i], b * self.up[i], self.eye[i], b * self.ahead[i] - a * self.eye[i]];
        let rows = [row(0), row(1), row(2), [0.0, 0.0, 1.0, -a]];
        Matrix4::from_fn(|i, j| rows[i][j])
    }

    /// Distance from the eye, infinite where nothing is seen; normals are left out, since fidget's are those of its cube.
    fn distances(&self, image: &Image) -> Vec<[f32; 4]> {
        let (a, b) = self.depth_map();
        let length = |x: f32, y: f32| {
            (0..3).map(|i| self.ahead[i] + x * self.right[i] + y * self.up[i]).map(|c| c * c).sum::<f32>().sqrt()
        };
        let pixel = |(index, pixel): (usize, &fidget::raster::voxel::GeometryPixel)| {
            if pixel.depth == 0 {
                return [f32::INFINITY, 0.0, 0.0, 0.0];
            }
            let half = HEIGHT as f32 / 2.0;
            let (x, y) = ((index as u32 % WIDTH) as f32 + 0.5, (index as u32 / WIDTH) as f32 + 0.5);
            let z = (pixel.depth as f32 - 0.5 - VOXELS_DEEP as f32 / 2.0) / half;
            let ahead = b / (z - a);
            [ahead * length((x - WIDTH as f32 / 2.0) / half, (half - y) / half), 0.0, 0.0, 0.0]
        };
        image.iter().enumerate().map(pixel).collect()
    }
}

fn numbers(words: &str) -> Outcome<Vec<f32>> {
    words.split_whitespace().map(|word| Ok(word.parse()?)).collect()
}

/// The solid whose listing comes next: negative inside. Trees of the race are three operators deep.
fn solid<'a>(lines: &mut impl Iterator<Item = &'a str>) -> Outcome<Tree> {
    let line = lines.next().ok_or("the listing ends too early")?;
    let (word, rest) = line.split_once(' ').ok_or("a line has a word and numbers")?;
    if matches!(word, "camera" | "light" | "background" | "material") {
        return solid(lines);
    }
    if matches!(word, "union" | "intersection" | "difference") {
        let children = (0..rest.parse::<usize>()?).map(|_| solid(lines)).collect::<Outcome<Vec<_>>>()?;
        return combined(word, children).ok_or_else(|| "an operator has no operands".into());
    }
    let (x, y, z) = Tree::axes();
    let values = numbers(rest)?;
    let slab = |axis: &Tree, low: f32, high: f32| (Tree::constant(low) - axis.clone()).max(axis.clone() - high);
    let square = |axis: &Tree, center: f32| (axis.clone() - center).square();
    Ok(match (word, &values[..]) {
        ("sphere", &[cx, cy, cz, r]) => square(&x, cx) + square(&y, cy) + square(&z, cz) - r * r,
        ("box", &[x0, y0, z0, x1, y1, z1]) => slab(&x, x0, x1).max(slab(&y, y0, y1)).max(slab(&z, z0, z1)),
        ("cylinder", &[x0, y0, z0, x1, y1, z1, r]) => {
            let round = |a: (&Tree, f32), b: (&Tree, f32)| square(a.0, a.1) + square(b.0, b.1) - r * r;
            if x0 != x1 {
                round((&y, y0), (&z, z0)).max(slab(&x, x0, x1))
            } else if y0 != y1 {
                round((&x, x0), (&z, z0)).max(slab(&y, y0, y1))
            } else {
                round((&x, x0), (&y, y0)).max(slab(&z, z0, z1))
            }
        }
        ("below", &[height]) => z - height,
        _ => return Err(format!("no solid is {line:?}").into()),
    })
}

fn combined(op: &str, mut children: Vec<Tree>) -> Option<Tree> {
    match op {
        "difference" => {
            let holes = children.split_off(1.min(children.len()));
            let whole = children.pop()?;
            Some(match balanced(holes, &|a, b| a.min(b)) {
                Some(holes) => whole.max(-holes),
                None => whole,
            })
        }
        "union" => balanced(children, &|a, b| a.min(b)),
        _ => balanced(children, &|a, b| a.max(b)),
    }
}

/// All of them joined two by two.
fn balanced(mut trees: Vec<Tree>, join: &dyn Fn(Tree, Tree) -> Tree) -> Option<Tree> {
    while trees.len() > 1 {
        let mut pairs = trees.into_iter();
        let mut joined = Vec::new();
        while let Some(first) = pairs.next() {
            joined.push(match pairs.next() {
                Some(second) => join(first, second),
                None => first,
            });
        }
        trees = joined;
    }
    trees.pop()
}
