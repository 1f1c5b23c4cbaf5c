//! Tiles in the plainest shading: the cosine of the angle between surface and light. What a picture costs beyond shading, and
//! what it would cost if each pixel were told its surface, are measured with it.

use super::crossing::{Rays, crossed_by, point};
use super::dispatch::Task;
use super::lanes::{F64s, Isa, LANES, Mask, Number, Stored, Vector};
use super::layout::{PACKET_PX, PACKETS, corner_of, lane_of};
use super::mesh::face_of;
use super::packet::{Common, Origins, Own, Packet};
use super::torus::from_ring;
use super::{RayTile, TILE_PX, Tiles};
use crate::compile::{Catalog, Use, Word};
use crate::geom::{Affine, Vec3};
use crate::model::CameraRays;
use crate::surface::Surface;
use crate::trace::Scratch;

/// The pixels of a tile, row by row: how bright each is, from 0 to 1; where nothing is, [`BACKGROUND`](Self::BACKGROUND).
#[derive(Clone, Debug, PartialEq)]
#[repr(align(64))]
pub struct Brightness(pub [f32; TILE_PX * TILE_PX]);

impl Default for Brightness {
    fn default() -> Self {
        Self([Self::BACKGROUND; TILE_PX * TILE_PX])
    }
}

impl Brightness {
    /// How bright nothing is.
    pub const BACKGROUND: f32 = 0.25;
}

/// The surface of every pixel of a tile: what one would have to be told in order to have nothing to search for.
#[derive(Clone, Copy, Debug)]
pub struct Told {
    facets: [[u32; LANES]; PACKETS],
    words: [[u32; LANES]; PACKETS],
    met: [u8; PACKETS],
    entering: [u8; PACKETS],
}

impl Tiles<'_> {
    /// Traces a tile, as [`trace`](Self::trace) does, and shades it with light from the direction of the unit vector `light`.
    pub fn brightness(
        &self,
        corner: (u32, u32),
        light: Vec3,
        tile: &mut RayTile,
        scratch: &mut Scratch,
        pixels: &mut Brightness,
    ) {
        let size = (TILE_PX as u32, TILE_PX as u32);
        self.trace(corner, size, (0.5, 0.5), tile, scratch);
        self.backend.run(Shade { tiles: self, light, tile, pixels });
        if !self.tracer.only_plain || !tile.alone.is_empty() {
            self.shade_others(light, tile, pixels);
        }
    }

    /// Shades what lanes cannot.
    fn shade_others(&self, light: Vec3, tile: &RayTile, pixels: &mut Brightness) {
        for (at, pixel) in pixels.0.iter_mut().enumerate() {
            let (x, y) = (at % TILE_PX, at / TILE_PX);
            let (packet, lane) = lane_of(x, y);
            let given_up = tile.packets[packet].given_up >> lane & 1 != 0;
            if given_up || tile.packets[packet].met >> lane & 1 != 0 && self.is_unusual(&tile.packets[packet], lane) {
                let hit = self.hit(tile, (x, y)).map(|(_, hit)| hit);
                let ray = tile.ray(packet, lane);
                *pixel = hit.map_or(Brightness::BACKGROUND, |hit| {
                    let normal = self.tracer.surface_point(&ray, &hit).normal;
                    facing(normal.dot(light), normal.dot(ray.direction)) as f32
                });
            }
        }
    }

    /// Whether lanes cannot shade what a ray met.
    fn is_unusual(&self, packet: &Packet, lane: usize) -> bool {
        let Word::Literal { index, .. } = Word::decode(packet.words[lane]) else { return true };
        match self.tracer.catalog.literal(index).surface {
            Surface::Plane(_) | Surface::Quadric(_) | Surface::Torus(_) | Surface::Placed(_) => false,
            Surface::Mesh(_) => packet.facets[lane] == Packet::UNKNOWN,
        }
    }

    /// The surfaces that the pixels of the tile just traced see.
    pub fn told(tile: &RayTile) -> Told {
        Told {
            facets: std::array::from_fn(|i| tile.packets[i].facets),
            words: std::array::from_fn(|i| tile.packets[i].words),
            met: std::array::from_fn(|i| tile.packets[i].met & !tile.packets[i].given_up),
            entering: std::array::from_fn(|i| tile.packets[i].entering),
        }
    }

    /// The same tile as [`brightness`](Self::brightness), whose surfaces need not be searched for: rays, one crossing each,
    /// normals, shading. No tracer of this kind can be faster than that. (Pixels whose rays were traced by themselves are
    /// left out.)
    pub fn brightness_if_told(
        &self,
        corner: (u32, u32),
        light: Vec3,
        told: &Told,
        tile: &mut RayTile,
        pixels: &mut Brightness,
    ) {
        self.backend.run(ShadeTold { tiles: self, corner, light, told, tile, pixels });
    }
}

/// How bright a surface is: the cosine to the light, of the side that is seen.
fn facing(to_light: f64, along_ray: f64) -> f64 {
    let cosine = if along_ray > 0.0 { -to_light } else { to_light };
    if cosine > 0.0 { cosine } else { 0.0 }
}

struct Shade<'a, 'b> {
    tiles: &'b Tiles<'a>,
    light: Vec3,
    tile: &'b RayTile,
    pixels: &'b mut Brightness,
}

impl Task for Shade<'_, '_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { tiles, light, tile, pixels } = self;
        for (number, packet) in tile.packets.iter().enumerate() {
            let Packet { words, facets, met, entering, .. } = packet;
            let seen = Seen { words, facets, met: *met, entering: *entering };
            let value = match tiles.camera.orthographic {
                true => shaded::<I, Own>(&tiles.tracer.catalog, packet, tiles.camera.eye, seen, light, true),
                false => shaded::<I, Common>(&tiles.tracer.catalog, packet, tiles.camera.eye, seen, light, true),
            };
            store(number, value, pixels);
        }
    }
}

struct ShadeTold<'a, 'b> {
    tiles: &'b Tiles<'a>,
    corner: (u32, u32),
    light: Vec3,
    told: &'b Told,
    tile: &'b mut RayTile,
    pixels: &'b mut Brightness,
}

impl Task for ShadeTold<'_, '_> {
    #[inline(always)]
    fn run<I: Isa>(self) {
        let Self { tiles, corner, light, told, tile, pixels } = self;
        let camera: &CameraRays = &tiles.camera;
        let corner = (f64::from(corner.0), f64::from(corner.1));
        // One packet's memory is enough.
        let packet = &mut tile.packets[0];
        for number in 0..PACKETS {
            packet.set_out::<I>(camera, number, corner, (0.5, 0.5), u8::MAX);
            let (met, entering) = (told.met[number], told.entering[number]);
            let seen = Seen { words: &told.words[number], facets: &told.facets[number], met, entering };
            let value = match camera.orthographic {
                true => shaded::<I, Own>(&tiles.tracer.catalog, packet, camera.eye, seen, light, false),
                false => shaded::<I, Common>(&tiles.tracer.catalog, packet, camera.eye, seen, light, false),
            };
            store(number, value, pixels);
        }
    }
}

/// What eight rays see.
#[derive(Clone, Copy)]
struct Seen<'a> {
    words: &'a [u32; LANES],
    facets: &'a [u32; LANES],
    met: u8,
    entering: u8,
}

/// How bright the surfaces are that a packet's rays see; where they are crossed is `known`, or is to be found out.
#[inline(always)]
fn shaded<I: Isa, O: Origins<I>>(
    catalog: &Catalog,
    packet: &Packet,
    eye: Vec3,
    seen: Seen,
    light: Vec3,
    known: bool,
) -> F64s<I> {
    let mut value = F64s::splat(f64::from(Brightness::BACKGROUND));
    let mut left = seen.met;
    while left != 0 {
        // All lanes that see the same literal.
        let word = seen.words[left.trailing_zeros() as usize & (LANES - 1)];
        let same = left & !I::differing(seen.words, word);
        left &= !same;
        let Word::Literal { index, negated } = Word::decode(word) else { continue };
        let Use { surface, offset, .. } = catalog.literal(index);
        if let Surface::Mesh(_) = surface {
            let normal = normals(catalog, seen.facets, same);
            let normal = Vector::<F64s<I>>::load(&normal);
            let d = packet.rays::<I, O>(eye, offset).direction;
            value =
                Mask::from_bits(same).select(facing_lanes(normal.dot(Vector::from_one(light)), normal.dot(d)), value);
            continue;
        }
        let rays: Rays<I, O::Number> = packet.rays::<I, O>(eye, offset);
        let t = match known {
            true => F64s::load(&packet.t),
            false => {
                let crossed = crossed_by::<I, O::Number>(surface, &rays);
                // Into the surface, or out of it.
                let entering = Mask::from_bits(seen.entering) ^ Mask::splat(negated);
                (entering ^ crossed.starts_inside).select(crossed.a, crossed.b)
            }
        };
        value = Mask::from_bits(same).select(cosine(surface, &rays, t, light), value);
    }
    value
}

/// The cosine to the light where rays meet a surface, of the side that they see.
#[inline(always)]
fn cosine<I: Isa, N: Number<I>>(surface: &Surface, rays: &Rays<I, N>, t: F64s<I>, light: Vec3) -> F64s<I> {
    let d = rays.direction;
    let one = |v: Vec3| Vector::new(F64s::<I>::splat(v.x), F64s::splat(v.y), F64s::splat(v.z));
    let (to_light, along_ray) = match surface {
        Surface::Plane(plane) => (F64s::splat(plane.normal.dot(light)), one(plane.normal).dot(d)),
        Surface::Quadric(quadric) => {
            let q = point::<I, F64s<I>>(&quadric.to_local, rays.at(t));
            let (s, _) = quadric.kind.coefficients();
            cosines(&quadric.to_local, Vector::new(q.x, q.y, q.z * F64s::splat(s)), d, light)
        }
        Surface::Torus(torus) => {
            let q = point::<I, F64s<I>>(&torus.to_local, rays.at(t));
            cosines(&torus.to_local, from_ring(torus, q), d, light)
        }
        // Scalar code shades those lanes.
        Surface::Mesh(_) | Surface::Placed(_) => (F64s::zero(), F64s::zero()),
    };
    facing_lanes(to_light, along_ray)
}

/// The cosine to the light of the gradient with that slope in local coordinates; and which way it is turned along a ray.
#[inline(always)]
fn cosines<I: Isa>(
    map: &Affine,
    slope: Vector<F64s<I>>,
    direction: Vector<F64s<I>>,
    light: Vec3,
) -> (F64s<I>, F64s<I>) {
    let column = |axis: usize| Vector::<F64s<I>>::from_one(map.column(axis)).dot(slope);
    let gradient = Vector::new(column(0), column(1), column(2));
    let length = gradient.dot(gradient).sqrt();
    (gradient.dot(Vector::from_one(light)) / length, gradient.dot(direction))
}

/// As [`facing`].
#[inline(always)]
fn facing_lanes<I: Isa>(to_light: F64s<I>, along_ray: F64s<I>) -> F64s<I> {
    let cosine = along_ray.gt(F64s::zero()).select(-to_light, to_light);
    cosine.max(F64s::zero())
}

/// The normals of a mesh's faces that some rays see; zero where the face is not known.
#[inline(always)]
fn normals(catalog: &Catalog, facets: &[u32; LANES], lanes: u8) -> [Stored; 3] {
    let mut normals = [Stored([0.0; LANES]); 3];
    for (lane, &facet) in facets.iter().enumerate() {
        let known = lanes >> lane & 1 != 0 && facet != Packet::UNKNOWN;
        if let (true, Some(Surface::Plane(plane))) = (known, face_of(catalog, facet)) {
            for (axis, normals) in normals.iter_mut().enumerate() {
                normals.0[lane] = plane.normal[axis];
            }
        }
    }
    normals
}

/// Puts a packet's pixels to their places.
#[inline(always)]
fn store<I: Isa>(number: usize, value: F64s<I>, pixels: &mut Brightness) {
    let value = value.stored().0.map(|v| v as f32);
    let (left, top) = corner_of(number);
    let at = top * TILE_PX + left;
    pixels.0[at..at + PACKET_PX.0].copy_from_slice(&value[..PACKET_PX.0]);
    pixels.0[at + TILE_PX..at + TILE_PX + PACKET_PX.0].copy_from_slice(&value[PACKET_PX.0..]);
}
