//! Multi-resolution Bresenham along a line through a quadtree, step by step: the paper's figure 7.

use super::octree_slice::{Map, SECTION_ROWS, SIDE, content_color};
use super::section::outline;
use super::sheet::{Anchor, Ink, Label, MARGIN, Sheet, TOP, WIDTH, palette};
use super::slice::Slice;
use octrace::Tracer;
use octrace::traverse::plane::{Line, Move, Quadtree, Square, Step, walk};
use std::collections::BTreeSet;
use std::ops::ControlFlow;

/// The lattice has two to the power of this units along the root's sides: two in the smallest square.
const SIDE_LOG: u32 = 5;
const LEVELS: u32 = 4;
/// So many steps have room in the table.
const MOST_STEPS: usize = 27;
const ROW: f64 = 19.0;
const TABLE: f64 = MARGIN + SIDE + 30.0;
/// The denominator of the slopes that are tried.
const RUN: i64 = 8;

/// A line and its way through the tree.
struct Walked {
    start: i64,
    rise: i64,
    steps: Vec<Step>,
}

/// Draws the walk.
pub fn draw(slice: &Slice, tracer: &Tracer) -> String {
    let tree = slice.quadtree(SIDE_LOG, LEVELS);
    let walked = telling_line(&tree);
    let note = format!(
        "A line with the slope {}/{RUN} through a quadtree. All numbers are integers: {RUN} times what the paper calls error, s and increment.",
        walked.rise
    );
    let mut sheet = Sheet::new(TOP + SIDE + 72.0, "Multi-resolution Bresenham in the plane", &note);
    let map = Map { left: MARGIN, bottom: TOP + SIDE };
    let unit = 1.0 / tree.root().side as f64;
    let area = |square: Square| (square.corner.map(|place| place as f64 * unit), square.side as f64 * unit);
    for square in tree.leaves() {
        map.fill(&mut sheet, area(square), content_color(&slice.content(square)));
    }
    sheet
        .path(&outline(&slice.section(tracer, SECTION_ROWS), &map), Ink { opacity: 0.22, ..Ink::area(palette::SOLID) });
    for square in tree.leaves() {
        map.outline(&mut sheet, area(square), Ink::line("#9aa6b4", 0.8));
    }
    sheet.rect((MARGIN, TOP), (SIDE, SIDE), 0.0, Ink::line(palette::INK, 1.6));
    let leaves: Vec<&Step> = walked.steps.iter().filter(|step| step.leaf).collect();
    for step in &leaves {
        map.outline(&mut sheet, area(step.square), Ink::line(palette::SOLID, 2.2));
    }
    for step in &leaves {
        error_bar(&mut sheet, &map, step, unit);
    }
    let (end_x, end_y) = walked.end(&tree);
    let (from, to) = (map.at(0.0, walked.start as f64 * unit), map.at(end_x * unit, end_y * unit));
    sheet.arrow(from, to, palette::RED, 2.0);
    for (number, step) in leaves.iter().enumerate() {
        let (a, b) = walked.within(step.square);
        let (x, y) = ((a + b) / 2.0, walked.start as f64 + walked.rise as f64 / RUN as f64 * (a + b) / 2.0);
        let at = map.at(x * unit, y * unit);
        disc(&mut sheet, at, number + 1);
    }
    table(&mut sheet, &walked.steps);
    captions(&mut sheet);
    sheet.finish()
}

impl Walked {
    /// Where the line leaves the root.
    fn end(&self, tree: &Quadtree) -> (f64, f64) {
        let side = tree.root().side as f64;
        let (start, slope) = (self.start as f64, self.rise as f64 / RUN as f64);
        let x = if slope > 0.0 { side.min((side - start) / slope) } else { side };
        (x, start + slope * x)
    }

    /// Between which x the line is in a square.
    fn within(&self, square: Square) -> (f64, f64) {
        let [x, y] = square.corner.map(|place| place as f64);
        let (side, start) = (square.side as f64, self.start as f64);
        let slope = self.rise as f64 / RUN as f64;
        let at = |height: f64, otherwise: f64| if slope > 0.0 { (height - start) / slope } else { otherwise };
        (x.max(at(y, x)), (x + side).min(at(y + side, x + side)))
    }
}

/// Of the lines with simple slopes the one that shows most kinds of steps, and of these the one with most steps that fit.
fn telling_line(tree: &Quadtree) -> Walked {
    let mut best = (0, Walked { start: 0, rise: 0, steps: Vec::new() });
    for rise in 1..RUN {
        for start in 0..tree.root().side {
            let mut steps = Vec::new();
            if let Some(line) = Line::new([0, start], [RUN, rise]) {
                let _ = walk(tree, &line, |step| {
                    steps.push(*step);
                    ControlFlow::<()>::Continue(())
                });
            }
            let kinds: BTreeSet<u8> = steps.iter().map(|step| step.kind as u8).collect();
            let score = 1 + 100 * kinds.len() + steps.len();
            if steps.len() <= MOST_STEPS && score > best.0 {
                best = (score, Walked { start, rise, steps });
            }
        }
    }
    best.1
}

/// The error: the line's height at the square's right side, as far as the square goes.
fn error_bar(sheet: &mut Sheet, map: &Map, step: &Step, unit: f64) {
    let Square { corner, side, .. } = step.square;
    let x = (corner[0] + side) as f64 * unit;
    let bottom = corner[1] as f64 * unit;
    let top = bottom + step.terms.error.min(step.terms.side) as f64 / RUN as f64 * unit;
    let (a, b) = (map.at(x, bottom), map.at(x, top));
    sheet.line((a.0 - 3.0, a.1), (b.0 - 3.0, b.1), Ink::line(palette::INK, 3.0));
}

fn disc(sheet: &mut Sheet, (x, y): (f64, f64), number: usize) {
    sheet.circle((x, y), 9.0, Ink::both(palette::PAPER, palette::RED, 1.6));
    sheet.label((x, y + 4.0), Label::new(&number.to_string(), 11.0).bold());
}

fn move_color(kind: Move) -> &'static str {
    match kind {
        Move::Start => palette::MUTED,
        Move::Horizontal => palette::AMBER,
        Move::Vertical => palette::GREEN,
        Move::Diagonal => palette::RED,
        Move::Refine => palette::PURPLE,
        Move::Integrate => palette::SOLID,
    }
}

fn move_name(kind: Move) -> &'static str {
    match kind {
        Move::Start => "start",
        Move::Horizontal => "horizontal",
        Move::Vertical => "vertical",
        Move::Diagonal => "diagonal",
        Move::Refine => "refine",
        Move::Integrate => "integrate",
    }
}

/// Every step with its numbers; those that lead to a square that the line visits bear its number.
fn table(sheet: &mut Sheet, steps: &[Step]) {
    let columns = [TABLE + 10.0, TABLE + 28.0, TABLE + 172.0, TABLE + 224.0, TABLE + 274.0, TABLE + 322.0];
    let heads = ["", "step", "corner", "error", "s", "incr."];
    let anchor = |column: usize| if column < 2 { Anchor::Start } else { Anchor::End };
    for (column, head) in heads.iter().enumerate() {
        let label = Label::new(head, 12.0).held(anchor(column)).bold().colored(palette::MUTED);
        sheet.label((columns[column], TOP + 12.0), label);
    }
    let mut visited = 0;
    for (index, step) in steps.iter().enumerate() {
        let y = TOP + 22.0 + ROW * (index as f64 + 0.5);
        if index % 2 == 0 {
            sheet.rect(
                (TABLE - 6.0, y - ROW / 2.0),
                (WIDTH - MARGIN - TABLE + 12.0, ROW),
                0.0,
                Ink::area(palette::PANEL),
            );
        }
        if step.leaf {
            visited += 1;
            sheet.circle((columns[0], y), 8.0, Ink::both(palette::PAPER, palette::RED, 1.4));
            sheet.label((columns[0], y + 3.8), Label::new(&visited.to_string(), 10.5).bold());
        }
        let color = move_color(step.kind);
        sheet.label(
            (columns[1], y + 4.0),
            Label::new(move_name(step.kind), 12.5).held(Anchor::Start).colored(color).bold(),
        );
        let [x, z] = step.square.corner;
        let numbers = [
            format!("({x}, {z})"),
            step.terms.error.to_string(),
            step.terms.side.to_string(),
            step.terms.increment.to_string(),
        ];
        for (column, text) in (2..).zip(&numbers) {
            sheet.label((columns[column], y + 4.0), Label::new(text, 12.0).held(Anchor::End));
        }
        let relation = match step.terms.error.cmp(&step.terms.side) {
            std::cmp::Ordering::Less => "<",
            std::cmp::Ordering::Equal => "=",
            std::cmp::Ordering::Greater => ">",
        };
        if step.leaf {
            sheet.label((columns[3] + 12.0, y + 4.0), Label::new(relation, 12.0).colored(palette::RED).bold());
        }
    }
    let y = TOP + 22.0 + ROW * (steps.len() as f64 + 0.5) + 4.0;
    sheet.label((columns[1], y), Label::new("… and out of the tree", 12.0).held(Anchor::Start).colored(palette::MUTED));
}

fn captions(sheet: &mut Sheet) {
    let y = TOP + SIDE + 26.0;
    sheet.line((MARGIN + 4.0, y - 12.0), (MARGIN + 4.0, y + 2.0), Ink::line(palette::INK, 3.0));
    let words = "error: the line's height at the right side of the square, above its bottom (cut off at the top)";
    sheet.label((MARGIN + 16.0, y), Label::new(words, 12.5).held(Anchor::Start));
    let y = y + 22.0;
    let mut x = MARGIN;
    for (kind, words) in [
        (Move::Horizontal, "error < s: to the right"),
        (Move::Vertical, "error > s: up"),
        (Move::Diagonal, "error = s: through the corner"),
        (Move::Refine, "refine: s and increment halved"),
        (Move::Integrate, "integrate: doubled"),
    ] {
        sheet.circle((x + 5.0, y - 4.0), 5.0, Ink::area(move_color(kind)));
        sheet.label((x + 15.0, y), Label::new(words, 12.5).held(Anchor::Start));
        x += 15.0 + super::sheet::text_width(words, 12.5) + 16.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_shows_everything_is_found() {
        let tree =
            Quadtree::new(SIDE_LOG, |square| square.level < LEVELS && (square.level < 2 || square.corner[0] < 12));
        let Walked { steps, .. } = telling_line(&tree);
        let kinds: BTreeSet<u8> = steps.iter().map(|step| step.kind as u8).collect();
        assert!(kinds.len() == 6 && steps.len() <= MOST_STEPS, "{steps:?}");
    }

    #[test]
    fn a_tree_that_is_one_square_has_one_step() {
        assert_eq!(telling_line(&Quadtree::new(SIDE_LOG, |_| false)).steps.len(), 1);
    }
}
