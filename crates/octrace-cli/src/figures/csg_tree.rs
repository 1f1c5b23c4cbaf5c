//! The CSG tree: the paper's figure 1.

use super::icons;
use super::layout::{Block, layout};
use super::sheet::{Anchor, Ink, Label, Sheet, TOP, WIDTH, cut_to, palette};
use super::sketch::{Kind, SketchNode, sketch};
use octrace::{BoolOp, Solid};

/// So many nodes fit side by side.
const TIPS: usize = 9;
const BREADTH: f64 = 94.0;
const GAP: f64 = 8.0;
const LEVEL: f64 = 98.0;

/// Draws the tree of a solid.
pub fn draw(solid: &Solid) -> String {
    let nodes = sketch(solid, TIPS);
    let blocks: Vec<Block> =
        nodes.iter().map(|node| Block { breadth: BREADTH, children: node.children.clone() }).collect();
    let laid = layout(&blocks, GAP);
    let left = (WIDTH - laid.breadth) / 2.0;
    let first = TOP + 34.0;
    let place = |index: usize| {
        let (across, depth) = laid.places[index];
        (left + across, first + depth as f64 * LEVEL)
    };
    let height = first + laid.depth as f64 * LEVEL + 66.0;
    let note = "Primitives, each in its place, joined by operators. What a dashed line leads to is taken away.";
    let mut sheet = Sheet::new(height, "The CSG tree", note);
    for (index, node) in nodes.iter().enumerate() {
        for (operand, &child) in node.children.iter().enumerate() {
            let cut = node.kind == Kind::Operator(BoolOp::Difference) && operand > 0;
            let (color, dashes) = if cut { (palette::RED, "5 4") } else { (palette::MUTED, "") };
            sheet.line(place(index), place(child), Ink { dashes, ..Ink::line(color, 1.5) });
        }
    }
    for (index, node) in nodes.iter().enumerate() {
        // An operator's name is on the side from which no line comes.
        let parent = nodes.iter().position(|parent| parent.children.contains(&index));
        let name_on = match parent {
            Some(parent) if place(parent).0 > place(index).0 => Anchor::End,
            _ => Anchor::Start,
        };
        draw_node(&mut sheet, place(index), node, name_on);
    }
    sheet.finish()
}

fn draw_node(sheet: &mut Sheet, (x, y): (f64, f64), node: &SketchNode, name_on: Anchor) {
    let caption = |sheet: &mut Sheet, dy: f64, text: &str, color| {
        sheet.label((x, y + dy), Label::new(&cut_to(text, 12.5, BREADTH), 12.5).colored(color));
    };
    // What is behind a node shall not shine through.
    let clear = |sheet: &mut Sheet, half: f64| {
        sheet.rect((x - half, y - half), (2.0 * half, 2.0 * half + 22.0), 6.0, Ink::area(palette::PAPER));
    };
    match node.kind {
        Kind::Operator(op) => {
            icons::operator(sheet, (x, y), 18.0, op);
            let name = node.name();
            let label = Label::new(&name, 12.5).colored(icons::operator_color(op));
            let beside = if name_on == Anchor::Start { x + 25.0 } else { x - 25.0 };
            sheet.label((beside, y - 8.0), label.held(name_on));
        }
        Kind::Primitive(_) => {
            clear(sheet, 22.0);
            if let Some(primitive) = node.primitive() {
                icons::primitive(sheet, (x, y), &primitive);
            }
            caption(sheet, 36.0, &node.name(), palette::INK);
        }
        Kind::Folded(op, primitives) => {
            icons::operator(sheet, (x, y), 18.0, op);
            caption(sheet, 36.0, &format!("… of {primitives}"), palette::MUTED);
        }
        Kind::More(_, primitives) => {
            clear(sheet, 20.0);
            caption(sheet, 4.0, &node.name(), palette::INK);
            caption(sheet, 20.0, &format!("({primitives} primitives)"), palette::MUTED);
        }
        Kind::Nothing => {
            clear(sheet, 16.0);
            caption(sheet, 6.0, "empty", palette::MUTED);
        }
    }
}
