//! SVG, scalable vector graphics: shapes, paths, groups and what is used again.
//!
//! As OpenSCAD 2021.01 reads it: fills are even-odd whatever is said, also of what has none; what has open ends is the
//! stroke of a pen. Beyond that, `use` is followed.

use super::stroke::{Cap, Join, Part, covered};
use super::svg_page::{Map, Page};
use super::svg_path::{self, Subpath};
use super::{Drawing, DrawingError, DrawingOptions, DrawingWarning, MOST_PIECES};
use crate::curve::{Paths, Pen, Strokes, extent};
use octrace::{Curve, Vec2};
use roxmltree::{Document, Node, ParsingOptions};
use std::collections::BTreeMap;
use svgtypes::{Length, LengthUnit, PointsParser};

/// What is used may use something else, so deep.
const DEEPEST: usize = 16;

/// Chords for the round ends and corners of strokes where chords are wanted. OpenSCAD has them as fine as its numbers are.
const CHORDS_OF_A_DISC: u32 = 360;

/// Paths whose ends are farther apart than this are open.
const OPEN: f64 = 0.1;

pub(super) fn read(bytes: &[u8], options: &DrawingOptions) -> Result<Drawing, DrawingError> {
    let text = std::str::from_utf8(bytes).map_err(|e| {
        let line = 1 + bytes[..e.valid_up_to()].iter().filter(|&&b| b == b'\n').count() as u32;
        DrawingError::Line { line, problem: "the text is not UTF-8".to_string() }
    })?;
    // Inkscape and Illustrator write document types, with short entities.
    let document = Document::parse_with_options(text, ParsingOptions { allow_dtd: true, ..ParsingOptions::default() })?;
    let root = document.root_element();
    let page = Page::of(root, options);
    let by_id = document.descendants().filter_map(|node| Some((node.attribute("id")?, node))).collect();
    let mut reader = Reader { options, by_id, shapes: Vec::new(), passed_over: BTreeMap::new(), count: 0 };
    let scale = Map::new(Vec2::new(page.scale.x, 0.0), Vec2::new(0.0, -page.scale.y), Vec2::ZERO);
    reader.elements(root, scale)?;

    let corners = reader.shapes.iter().filter_map(|shape| extent(shape));
    let all =
        corners.reduce(|(a, b), (c, d)| (Vec2::new(a.x.min(c.x), a.y.min(c.y)), Vec2::new(b.x.max(d.x), b.y.max(d.y))));
    let shift = all.map_or(Vec2::ZERO, |all| page.shift(all, options.place));
    reader.shapes.iter_mut().flatten().flatten().for_each(|edge| {
        edge.from = edge.from + shift;
        if let Curve::Arc { center, .. } = &mut edge.curve {
            *center = *center + shift;
        }
    });
    let mut warnings: Vec<DrawingWarning> =
        reader.passed_over.into_iter().map(|(kind, count)| DrawingWarning::PassedOver { kind, count }).collect();
    if let Some(layer) = options.layer.filter(|_| reader.shapes.is_empty()) {
        warnings.push(DrawingWarning::NoLayer(layer.to_string()));
    }
    Ok(Drawing { shapes: reader.shapes, warnings })
}

struct Reader<'a, 'i> {
    options: &'a DrawingOptions<'a>,
    by_id: BTreeMap<&'a str, Node<'a, 'i>>,
    shapes: Vec<Paths>,
    passed_over: BTreeMap<String, usize>,
    count: usize,
}

impl<'a, 'i> Reader<'a, 'i> {
    /// Draws everything below an element.
    fn elements(&mut self, root: Node<'a, 'i>, map: Map) -> Result<(), DrawingError> {
        // An element, the map outside it, how deep in uses it is, and whether it is on the layer.
        let mut pending = vec![(root, map, 0, self.options.layer.is_none())];
        while let Some((node, outside, depth, is_on_layer)) = pending.pop() {
            let is_on_layer = is_on_layer || self.options.layer.is_some_and(|layer| is_named(node, layer));
            // The outermost element's transform does not count.
            let transform = node.attribute("transform").filter(|_| node != root || depth > 0);
            let map = transform.map_or(outside, |text| outside.after(&Map::of_transform(text)));
            match node.tag_name().name() {
                "svg" | "g" | "a" | "switch" | "symbol" => {
                    let children = node.children().filter(|child| child.is_element() && !is_hidden(*child));
                    let first = pending.len();
                    pending.extend(children.map(|child| (child, map, depth, is_on_layer)));
                    pending[first..].reverse();
                }
                "use" => {
                    let attribute = node.attributes().find(|a| a.name() == "href");
                    let used = attribute.and_then(|a| self.by_id.get(a.value().strip_prefix('#')?));
                    self.count += 1;
                    if let Some(&used) = used.filter(|_| depth < DEEPEST) {
                        let at = Vec2::new(number(node, "x"), number(node, "y"));
                        pending.push((used, map.after(&Map::translate(at)), depth + 1, is_on_layer));
                    }
                }
                kind @ ("text" | "image" | "foreignObject") => {
                    *self.passed_over.entry(kind.to_string()).or_default() += 1;
                }
                _ if is_on_layer => self.shape(node, &map),
                _ => {}
            }
            if self.count > MOST_PIECES {
                return Err(DrawingError::TooLarge(MOST_PIECES));
            }
        }
        Ok(())
    }

    /// Draws an element, if it is a shape.
    fn shape(&mut self, node: Node, map: &Map) {
        let n = |name| number(node, name);
        let at = |x, y| Vec2::new(n(x), n(y));
        let (mut filled, mut stroked) = (Vec::new(), Vec::new());
        match node.tag_name().name() {
            "circle" => filled.push(Subpath::ellipse(at("cx", "cy"), n("r"), n("r"), 40)),
            "ellipse" => filled.push(Subpath::ellipse(at("cx", "cy"), n("rx"), n("ry"), 40)),
            "rect" => filled.push(svg_path::rectangle(at("x", "y"), n("width"), n("height"), n("rx"), n("ry"))),
            "polygon" => filled.push(Subpath::polygon(points(node))),
            "polyline" => stroked.push(Subpath::polygon(points(node))),
            "line" => stroked.push(Subpath::polygon([at("x1", "y1"), at("x2", "y2")])),
            "path" => {
                let (paths, is_closed) = svg_path::parse(node.attribute("d").unwrap_or_default());
                let last = paths.len().saturating_sub(1);
                for (i, path) in paths.into_iter().enumerate() {
                    let is_open = (path.end() - path.start).length() > OPEN;
                    // The last part of a path that was closed somewhere counts as closed.
                    if is_open && !(is_closed && i == last) { stroked.push(path) } else { filled.push(path) }
                }
            }
            _ => return,
        }
        let corners = filled.iter().chain(&stroked).flat_map(Subpath::points).map(|p| map.point(p));
        let size = box_diagonal(corners);
        if !size.is_finite() {
            return;
        }
        let as_chords = self.options.fragments.is_some();
        let strokes = match as_chords {
            true => Strokes::Chords(20),
            false => Strokes::Arcs { tolerance: self.options.tolerance.relative * size },
        };
        let draw = |subpaths: &[Subpath]| {
            let mut pen = Pen::new(strokes);
            subpaths.iter().for_each(|subpath| subpath.draw(map, as_chords, &mut pen));
            pen.finish()
        };
        let mut shapes = vec![draw(&filled)];
        let (width, cap, join) = pen_of(node);
        for part in stroked.iter().flat_map(|path| covered(&path.chords(), width, cap, join)) {
            let subpath = match part {
                Part::Polygon(corners) => Subpath::polygon(corners),
                Part::Disc(center, radius) => Subpath::ellipse(center, radius, radius, CHORDS_OF_A_DISC),
            };
            shapes.push(draw(&[subpath]));
        }
        shapes.retain(|shape| !shape.is_empty());
        self.count += shapes.iter().flatten().map(Vec::len).sum::<usize>();
        self.shapes.append(&mut shapes);
    }
}

/// Whether an element is drawn only where something refers to it.
fn is_hidden(node: Node) -> bool {
    ["defs", "symbol", "clipPath", "mask", "marker", "pattern"].contains(&node.tag_name().name())
}

/// Whether an element is called that: by its identifier, or by its label as Inkscape has it.
fn is_named(node: Node, name: &str) -> bool {
    node.attributes().any(|a| (a.name() == "id" || a.name() == "label") && a.value() == name)
}

/// A number or length in user units; zero where there is none.
fn number(node: Node, name: &str) -> f64 {
    let length = node.attribute(name).and_then(|text| text.trim().parse::<Length>().ok());
    let Some(Length { number, unit }) = length.filter(|length| length.number.is_finite()) else { return 0.0 };
    // What CSS says: an inch has 96 units.
    match unit {
        LengthUnit::None | LengthUnit::Px => number,
        LengthUnit::In => number * 96.0,
        LengthUnit::Cm => number * 96.0 / 2.54,
        LengthUnit::Mm => number * 96.0 / 25.4,
        LengthUnit::Pt => number * 96.0 / 72.0,
        LengthUnit::Pc => number * 16.0,
        LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => 0.0,
    }
}

fn points<'a>(node: Node<'a, '_>) -> impl Iterator<Item = Vec2> + use<'a> {
    PointsParser::from(node.attribute("points").unwrap_or_default()).map(|(x, y)| Vec2::new(x, y))
}

/// Width, ends and corners of an element's stroke: by its attributes or its style.
fn pen_of(node: Node) -> (f64, Cap, Join) {
    let style = |name: &str| {
        let properties = node.attribute("style").unwrap_or_default().split(';');
        let mut pairs = properties.filter_map(|property| property.split_once(':'));
        pairs.find(|(key, _)| key.trim() == name).map(|(_, value)| value.trim())
    };
    let value = |name: &str| node.attribute(name).or_else(|| style(name)).unwrap_or_default();
    let width = value("stroke-width").parse::<f64>().unwrap_or(0.0);
    let cap = match value("stroke-linecap") {
        "butt" => Cap::Butt,
        "round" => Cap::Round,
        _ => Cap::Square,
    };
    let join = match value("stroke-linejoin") {
        "round" => Join::Round,
        "bevel" => Join::Cut,
        _ => Join::Pointed,
    };
    (if width.is_finite() && width >= 0.01 { width } else { 1.0 }, cap, join)
}

fn box_diagonal(points: impl Iterator<Item = Vec2>) -> f64 {
    let corners = points.fold(None, |corners: Option<(Vec2, Vec2)>, p| {
        let (low, high) = corners.unwrap_or((p, p));
        Some((Vec2::new(low.x.min(p.x), low.y.min(p.y)), Vec2::new(high.x.max(p.x), high.y.max(p.y))))
    });
    corners.map_or(0.0, |(low, high)| (high - low).length())
}
