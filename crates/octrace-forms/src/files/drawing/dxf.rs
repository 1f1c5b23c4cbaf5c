//! DXF, AutoCAD's exchange format, as text: pairs of lines, a code and a value.
//!
//! What OpenSCAD reads is read as it reads it: layers, blocks and where they are inserted, an origin and a scale. Beyond
//! that there are old-style polylines and splines, and polylines may have arcs. The base point of blocks is passed over, as there.

use super::join::{Piece, joined};
use super::spline::Spline;
use super::{Drawing, DrawingError, DrawingOptions, DrawingWarning, MOST_PIECES};
use crate::curve::{EllipticArc, bulged};
use octrace::Vec2;
use octrace::geom::sin_cos_deg;
use std::collections::BTreeMap;

pub(super) fn read(bytes: &[u8], options: &DrawingOptions) -> Result<Drawing, DrawingError> {
    let text = String::from_utf8_lossy(bytes);
    let mut reader = Reader::new(options);
    let mut lines = (1_u32..).zip(text.lines());
    let mut entity = Entity::default();
    while let (Some((line, code)), Some((_, value))) = (lines.next(), lines.next()) {
        let Ok(code) = code.trim().parse::<i32>() else {
            // Blank lines at the end do no harm.
            if code.trim().is_empty() && lines.clone().all(|(_, rest)| rest.trim().is_empty()) {
                break;
            }
            let problem = format!("`{}` is no group code", code.chars().take(40).collect::<String>());
            return Err(DrawingError::Line { line, problem });
        };
        let value = value.trim();
        if code == 0 {
            reader.entity(&std::mem::replace(&mut entity, Entity { kind: value.to_string(), ..Entity::default() }))?;
        } else {
            entity.take(code, value, line)?;
        }
    }
    reader.entity(&entity)?;
    Ok(reader.finish())
}

/// Flags of old-style polylines that are meshes.
const POLYGON_MESH: i32 = 16;
const POLYFACE_MESH: i32 = 64;

/// The values of an entity that matter, by their codes.
#[derive(Default)]
struct Entity {
    kind: String,
    layer: String,
    name: String,
    flags: i32,
    /// First and second points; polylines have many first ones.
    points: Vec<(Vec2, f64)>,
    second: Vec2,
    /// Codes 40, 41 and 42; 50 and 51.
    numbers: [Option<f64>; 3],
    /// All of codes 40 and 41: a spline's knots and weights.
    lists: [Vec<f64>; 2],
    /// A spline's degree.
    degree: usize,
    angles: [f64; 2],
}

impl Entity {
    fn take(&mut self, code: i32, value: &str, line: u32) -> Result<(), DrawingError> {
        match code {
            2 => self.name = value.to_string(),
            8 => self.layer = value.to_string(),
            70 => self.flags = value.parse().unwrap_or(0),
            71 => self.degree = value.parse().unwrap_or(0),
            10 | 20 | 11 | 21 | 40..=42 | 50 | 51 => {
                let number = value.parse::<f64>().ok().filter(|number| number.is_finite());
                let problem = || format!("`{}` is no finite number", value.chars().take(40).collect::<String>());
                let number = number.ok_or_else(|| DrawingError::Line { line: line + 1, problem: problem() })?;
                match code {
                    10 => self.points.push((Vec2::new(number, 0.0), 0.0)),
                    20 => self.points.last_mut().into_iter().for_each(|(point, _)| point.y = number),
                    11 => self.second.x = number,
                    21 => self.second.y = number,
                    50 | 51 => self.angles[(code - 50) as usize] = number,
                    _ => self.numbers[(code - 40) as usize] = Some(number),
                }
                if let 40 | 41 = code {
                    self.lists[(code - 40) as usize].push(number);
                }
                // How much the side from a polyline's corner bulges.
                if code == 42 {
                    self.points.last_mut().into_iter().for_each(|(_, bulge)| *bulge = number);
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn first(&self) -> Vec2 {
        self.points.first().map_or(Vec2::ZERO, |&(point, _)| point)
    }
}

struct Reader<'a> {
    options: &'a DrawingOptions<'a>,
    section: String,
    /// The block that is being read.
    block: Option<String>,
    blocks: BTreeMap<String, Vec<Piece>>,
    pieces: Vec<Piece>,
    /// An old-style polyline that is being read: its flags, corners and bulges.
    polyline: Option<(i32, Vec<(Vec2, f64)>)>,
    passed_over: BTreeMap<String, usize>,
    found_layer: bool,
    count: usize,
}

impl<'a> Reader<'a> {
    fn new(options: &'a DrawingOptions<'a>) -> Self {
        Self {
            options,
            section: String::new(),
            block: None,
            blocks: BTreeMap::new(),
            pieces: Vec::new(),
            polyline: None,
            passed_over: BTreeMap::new(),
            found_layer: false,
            count: 0,
        }
    }

    /// A number of a length, or a point: blocks are scaled where they are inserted.
    fn scale(&self) -> f64 {
        if self.block.is_some() { 1.0 } else { self.options.scale }
    }

    fn point(&self, p: Vec2) -> Vec2 {
        if self.block.is_some() { p } else { (p - self.options.origin) * self.options.scale }
    }

    fn chords(&self, radius: f64, sweep_deg: f64) -> u32 {
        let full = self.options.fragments.map_or(1, |fragments| fragments(radius)).clamp(3, 1 << 16);
        ((f64::from(full) * sweep_deg.abs() / 360.0).ceil() as u32).max(1)
    }

    fn entity(&mut self, entity: &Entity) -> Result<(), DrawingError> {
        let kind = entity.kind.as_str();
        match kind {
            "SECTION" => self.section = entity.name.clone(),
            "ENDSEC" => self.section.clear(),
            "BLOCK" => self.block = Some(entity.name.clone()),
            "ENDBLK" => self.block = None,
            _ => {}
        }
        let is_drawn = (self.section == "ENTITIES" && self.block.is_none()) || self.block.is_some();
        if !is_drawn || ["SECTION", "ENDSEC", "BLOCK", "ENDBLK", "EOF", ""].contains(&kind) {
            return Ok(());
        }
        let layer = self.options.layer.filter(|_| self.block.is_none());
        if layer.is_some_and(|layer| layer != entity.layer) && !["VERTEX", "SEQEND"].contains(&kind) {
            return Ok(());
        }
        self.found_layer |= layer == Some(entity.layer.as_str());
        let pieces = match kind {
            "LINE" => vec![Piece::Line(self.point(entity.first()), self.point(entity.second))],
            "CIRCLE" => vec![self.circle(entity, 0.0, 360.0)],
            "ARC" => {
                let [start, end] = entity.angles;
                let sweep = (end - start).rem_euclid(360.0);
                vec![self.circle(entity, start, if sweep == 0.0 && end != start { 360.0 } else { sweep })]
            }
            "ELLIPSE" => vec![self.ellipse(entity)],
            "SPLINE" => self.spline(entity),
            "LWPOLYLINE" => self.polyline(&entity.points, entity.flags & 1 != 0),
            "POLYLINE" => {
                self.polyline = Some((entity.flags, Vec::new()));
                Vec::new()
            }
            "VERTEX" => {
                // What steers a smoothed polyline is not on it.
                const CONTROL_POINT: i32 = 16;
                if let Some((_, corners)) = &mut self.polyline
                    && entity.flags & CONTROL_POINT == 0
                {
                    corners.extend(entity.points.first());
                }
                Vec::new()
            }
            "SEQEND" => match self.polyline.take() {
                // A net of faces in space, whose corners are in no such order.
                Some((flags, _)) if flags & (POLYGON_MESH | POLYFACE_MESH) != 0 => {
                    *self.passed_over.entry("POLYLINE (mesh)".to_string()).or_default() += 1;
                    Vec::new()
                }
                Some((flags, corners)) => self.polyline(&corners, flags & 1 != 0),
                None => Vec::new(),
            },
            "INSERT" => self.insert(entity)?,
            _ => {
                *self.passed_over.entry(kind.to_string()).or_default() += 1;
                Vec::new()
            }
        };
        self.count += pieces.len();
        if self.count > MOST_PIECES {
            return Err(DrawingError::TooLarge(MOST_PIECES));
        }
        match &self.block {
            Some(block) => self.blocks.entry(block.clone()).or_default().extend(pieces),
            None => self.pieces.extend(pieces),
        }
        Ok(())
    }

    fn circle(&self, entity: &Entity, start_deg: f64, sweep_deg: f64) -> Piece {
        let radius = entity.numbers[0].unwrap_or(0.0) * self.scale();
        let center = self.point(entity.first());
        let (x, y) = (Vec2::new(radius, 0.0), Vec2::new(0.0, radius));
        Piece::Arc(EllipticArc { center, x, y, start_deg, sweep_deg }, self.chords(radius, sweep_deg))
    }

    fn ellipse(&self, entity: &Entity) -> Piece {
        let [ratio, start, end] = entity.numbers;
        let x = entity.second * self.scale();
        let y = x.left() * ratio.unwrap_or(1.0);
        let [start_deg, end_deg] = [start.unwrap_or(0.0), end.unwrap_or(std::f64::consts::TAU)].map(f64::to_degrees);
        let sweep = (end_deg - start_deg).rem_euclid(360.0);
        // A full turn may be off by rounding.
        let sweep_deg = if sweep < 1e-6 { 360.0 } else { sweep };
        let arc = EllipticArc { center: self.point(entity.first()), x, y, start_deg, sweep_deg };
        Piece::Arc(arc, self.chords(x.length(), sweep_deg))
    }

    fn spline(&mut self, entity: &Entity) -> Vec<Piece> {
        let points: Vec<Vec2> = entity.points.iter().map(|&(p, _)| self.point(p)).collect();
        let [knots, weights] = &entity.lists;
        let curves = Spline { degree: entity.degree, knots, points: &points, weights }.beziers();
        if curves.is_none() {
            *self.passed_over.entry(entity.kind.clone()).or_default() += 1;
        }
        curves.into_iter().flatten().map(Piece::Bezier).collect()
    }

    /// Lines and arcs from corner to corner. OpenSCAD has lines only, so chords are asked for in vain.
    fn polyline(&self, corners: &[(Vec2, f64)], is_closed: bool) -> Vec<Piece> {
        let sides = if is_closed { corners.len() } else { corners.len().saturating_sub(1) };
        let side = |i: usize| {
            let (from, bulge) = corners[i];
            let (a, b) = (self.point(from), self.point(corners[(i + 1) % corners.len()].0));
            let bulge = if self.options.fragments.is_some() { 0.0 } else { bulge };
            match bulged(a, b, bulge) {
                None => Piece::Line(a, b),
                Some((center, _)) => {
                    let x = a - center;
                    let sweep_deg = 4.0 * libm::atan(bulge).to_degrees();
                    Piece::Arc(EllipticArc { center, x, y: x.left(), start_deg: 0.0, sweep_deg }, 1)
                }
            }
        };
        (0..sides).map(side).collect()
    }

    /// What the block has so far, moved.
    fn insert(&self, entity: &Entity) -> Result<Vec<Piece>, DrawingError> {
        let block = self.blocks.get(&entity.name).map(Vec::as_slice).unwrap_or_default();
        if block.len() > MOST_PIECES - self.count {
            return Err(DrawingError::TooLarge(MOST_PIECES));
        }
        let [_, x, y] = entity.numbers;
        let (x, y) = (x.unwrap_or(1.0), y.unwrap_or(1.0));
        let (sin, cos) = sin_cos_deg(entity.angles[0]);
        let (scale, to) = (self.scale(), self.point(entity.first()));
        let vector = |v: Vec2| {
            let v = Vec2::new(v.x * x, v.y * y);
            Vec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y) * scale
        };
        Ok(block.iter().map(|piece| piece.moved(|p| vector(p) + to, vector)).collect())
    }

    fn finish(self) -> Drawing {
        let (paths, open) = joined(&self.pieces, self.options);
        let mut warnings: Vec<DrawingWarning> =
            self.passed_over.into_iter().map(|(kind, count)| DrawingWarning::PassedOver { kind, count }).collect();
        if open > 0 {
            warnings.push(DrawingWarning::Open { count: open });
        }
        if let Some(layer) = self.options.layer.filter(|_| !self.found_layer) {
            warnings.push(DrawingWarning::NoLayer(layer.to_string()));
        }
        Drawing { shapes: vec![paths], warnings }
    }
}
