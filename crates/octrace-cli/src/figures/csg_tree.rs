//! The CSG tree: the paper's figure 1.

use super::icons;
use super::layout::{Block, layout};
use super::sheet::{Anchor, Ink, Label, Sheet, TOP, WIDTH, cut_to, number, palette};
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
        let ends = node.children.iter().map(|&child| {
            let (x, y) = place(child);
            (x, y - if nodes[child].children.is_empty() { 22.0 } else { 18.0 })
        });
        draw_branches(&mut sheet, place(index), &ends.collect::<Vec<_>>(), &node.kind);
    }
    for (index, node) in nodes.iter().enumerate() {
        draw_node(&mut sheet, place(index), node);
    }
    sheet.finish()
}

/// The lines from a node to its operands: down, across once, and down to each.
fn draw_branches(sheet: &mut Sheet, (x, y): (f64, f64), ends: &[(f64, f64)], kind: &Kind) {
    let ([first, others @ ..], Some(last)) = (ends, ends.last()) else { return };
    let bend = y + 48.0;
    let across = |to: f64| format!("M{} {} H{}", number(x), number(bend), number(to));
    let down = |&(x, y): &(f64, f64)| format!("M{} {} V{}", number(x), number(bend), number(y));
    let (to_first, to_others) = (
        format!("{} {}", across(first.0), down(first)),
        format!("{} {}", across(last.0), others.iter().map(down).collect::<Vec<_>>().join(" ")),
    );
    let solid = Ink::line(palette::MUTED, 1.5);
    let cut = Ink { dashes: "5 4", ..Ink::line(palette::RED, 1.5) };
    sheet.path(&to_others, if *kind == Kind::Operator(BoolOp::Difference) { cut } else { solid });
    sheet.path(&to_first, solid);
    sheet.line((x, y), (x, bend), solid);
}

fn draw_node(sheet: &mut Sheet, (x, y): (f64, f64), node: &SketchNode) {
    let caption = |sheet: &mut Sheet, dy: f64, text: &str, color| {
        sheet.label((x, y + dy), Label::new(&cut_to(text, 12.0, BREADTH + GAP), 12.0).colored(color));
    };
    match node.kind {
        Kind::Operator(op) => {
            icons::operator(sheet, (x, y), 18.0, op);
            let name = node.name();
            let label = Label::new(&name, 12.5).colored(icons::operator_color(op));
            sheet.label((x + 24.0, y + 4.5), label.held(Anchor::Start));
        }
        Kind::Primitive(_) => {
            if let Some(primitive) = node.primitive() {
                icons::primitive(sheet, (x, y), &primitive);
            }
            caption(sheet, 36.0, &node.name(), palette::INK);
        }
        Kind::Folded(op, primitives) => {
            icons::operator(sheet, (x, y), 18.0, op);
            caption(sheet, 36.0, &format!("… {primitives} primitives"), palette::MUTED);
        }
        Kind::More(operands, primitives) => {
            caption(sheet, 4.0, &node.name(), palette::INK);
            if primitives > operands {
                caption(sheet, 20.0, &format!("{primitives} primitives"), palette::MUTED);
            }
        }
        Kind::Nothing => {
            caption(sheet, 6.0, "empty", palette::MUTED);
        }
    }
}
