//! Roth's span lists, combined from the leaves of the tree to its root: the paper's figure 3.

use super::Failure;
use super::icons;
use super::sheet::{Anchor, Ink, Label, MARGIN, Sheet, TOP, WIDTH, cut_to, number, palette, value};
use super::sketch::{Kind, SketchNode, sketch};
use octrace::exec::Exec;
use octrace::{Accel, Ray, Scene, Span, Spans, Tracer, TracerOptions};

/// So many nodes of the tree without operands are shown.
const TIPS: usize = 10;
const ROW: f64 = 30.0;
/// The bars are between these.
const LEFT: f64 = 280.0;
const RIGHT: f64 = WIDTH - MARGIN - 8.0;

/// A node of the tree with its spans.
struct Row<'a> {
    node: &'a SketchNode,
    depth: usize,
    spans: Spans,
    /// The rows of its operands.
    operands: Vec<usize>,
}

/// Draws the spans of one ray.
pub fn draw(scene: &Scene, ray: &Ray, exec: &Exec) -> Result<String, Failure> {
    let nodes = sketch(&scene.solid, TIPS);
    let rows = rows(&nodes, scene, ray, exec)?;
    let axis = Axis::of(&rows);
    let height = TOP + ROW * rows.len() as f64 + 106.0;
    let note = "Where one ray is inside of each node of the tree. Operators combine the bars of their operands; the last row is the solid.";
    let mut sheet = Sheet::new(height, "Span lists", note);
    let y_of = |row: usize| TOP + 18.0 + ROW * row as f64;
    let end = y_of(rows.len() - 1);

    let result = &rows[rows.len() - 1];
    sheet.rect((MARGIN - 8.0, end - 15.0), (WIDTH - 2.0 * MARGIN + 16.0, ROW), 4.0, Ink::area(palette::PANEL));
    let ends = result.spans.iter().flat_map(|span| [span.enter, span.exit]).flatten();
    for hit in ends.clone().filter(|hit| axis.shows(hit.t)) {
        let x = axis.x(hit.t);
        sheet.line((x, TOP), (x, end), Ink { dashes: "2 4", ..Ink::line(palette::MUTED, 1.0) });
    }
    for (index, row) in rows.iter().enumerate() {
        let x = |depth: usize| MARGIN + 10.0 + 22.0 * depth as f64;
        // The tree: operands stand above what they are combined to.
        for &operand in &row.operands {
            let (trunk, y) = (x(row.depth), y_of(operand));
            let line = Ink::line(palette::FAINT, 1.4);
            sheet.path(
                &format!("M{} {} V{} H{}", number(trunk), number(y_of(index)), number(y), number(x(row.depth + 1))),
                line,
            );
        }
    }
    for (index, row) in rows.iter().enumerate() {
        draw_row(&mut sheet, (MARGIN + 10.0 + 22.0 * row.depth as f64, y_of(index)), row, &axis);
    }
    axis.draw(&mut sheet, end + 30.0);
    let words = match ends.clone().find(|hit| hit.t > 0.0) {
        Some(hit) => {
            sheet.circle((axis.x(hit.t), end), 5.5, Ink::both(palette::PAPER, palette::RED, 2.4));
            format!("The first end after the eye is the visible point: t = {}.", value(hit.t))
        }
        None => "The ray meets nothing.".to_owned(),
    };
    sheet.label((MARGIN, end + 74.0), Label::new(&words, 13.0).held(Anchor::Start));
    Ok(sheet.finish())
}

/// The rows from top to bottom: every node behind its operands.
fn rows<'a>(nodes: &'a [SketchNode], scene: &Scene, ray: &Ray, exec: &Exec) -> Result<Vec<Row<'a>>, Failure> {
    let options = TracerOptions { accel: Accel::None, snap: scene.snap, ..TracerOptions::default() };
    // Nodes before their operands, the last operand first; then the other way round.
    let (mut order, mut pending) = (Vec::new(), vec![(0, 0)]);
    while let Some((node, depth)) = pending.pop() {
        order.push((node, depth));
        pending.extend(nodes[node].children.iter().map(|&child| (child, depth + 1)));
    }
    order.reverse();
    let mut row_of = vec![0; nodes.len()];
    let mut rows = Vec::new();
    for (index, depth) in order {
        let node = &nodes[index];
        let spans = Tracer::build(&node.solid, &options, exec)?.spans(ray);
        row_of[index] = rows.len();
        rows.push(Row { node, depth, spans, operands: node.children.iter().map(|&child| row_of[child]).collect() });
    }
    Ok(rows)
}

fn draw_row(sheet: &mut Sheet, (x, y): (f64, f64), row: &Row, axis: &Axis) {
    let color = match row.node.kind {
        Kind::Operator(op) | Kind::Folded(op, _) => {
            icons::operator(sheet, (x, y), 10.0, op);
            icons::operator_color(op)
        }
        _ => {
            sheet.circle((x, y), 4.0, Ink::area(palette::SOLID));
            palette::SOLID
        }
    };
    let name = cut_to(&row.node.name(), 12.5, LEFT - 22.0 - x);
    sheet.label((x + 16.0, y + 4.5), Label::new(&name, 12.5).held(Anchor::Start).colored(palette::INK));
    sheet.line((LEFT, y), (RIGHT, y), Ink::line(palette::FAINT, 1.0));
    for span in &row.spans {
        draw_bar(sheet, y, span, color, axis);
    }
}

fn draw_bar(sheet: &mut Sheet, y: f64, span: &Span, color: &str, axis: &Axis) {
    let (a, b) = (axis.x(span.enter_t()), axis.x(span.exit_t()));
    if b <= LEFT || a >= RIGHT {
        return;
    }
    sheet.rect((a, y - 7.0), ((b - a).max(1.0), 14.0), 1.5, Ink { opacity: 0.85, ..Ink::area(color) });
    // Beyond the figure it goes on.
    if span.exit_t() > axis.to {
        sheet.arrow((RIGHT - 4.0, y), (RIGHT + 9.0, y), color, 2.0);
    }
    if span.enter_t() < axis.from {
        sheet.arrow((LEFT + 4.0, y), (LEFT - 9.0, y), color, 2.0);
    }
}

/// The parameters that are shown.
struct Axis {
    from: f64,
    to: f64,
}

impl Axis {
    /// All ends of the spans of what is bounded along the ray, and a little more.
    fn of(rows: &[Row]) -> Self {
        let ends = |bounded: bool| {
            let spans = rows.iter().flat_map(|row| &row.spans);
            let spans = spans.filter(move |span| !bounded || (span.enter.is_some() && span.exit.is_some()));
            spans.flat_map(|span| [span.enter, span.exit]).flatten().map(|hit| hit.t)
        };
        let range = |ends: &mut dyn Iterator<Item = f64>| {
            ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), t| (low.min(t), high.max(t)))
        };
        let (low, high) = match range(&mut ends(true)) {
            (low, high) if low < high => (low, high),
            _ => range(&mut ends(false)),
        };
        match (low < high, low.is_finite()) {
            (true, _) => Self { from: low - 0.08 * (high - low), to: high + 0.08 * (high - low) },
            (false, true) => Self { from: low - 1.0, to: low + 1.0 },
            (false, false) => Self { from: 0.0, to: 1.0 },
        }
    }

    fn shows(&self, t: f64) -> bool {
        self.from <= t && t <= self.to
    }

    /// Where a parameter is drawn, at the ends of the figure at the farthest.
    fn x(&self, t: f64) -> f64 {
        LEFT + (RIGHT - LEFT) * ((t - self.from) / (self.to - self.from)).clamp(0.0, 1.0)
    }

    fn draw(&self, sheet: &mut Sheet, y: f64) {
        sheet.arrow((LEFT, y), (RIGHT + 9.0, y), palette::INK, 1.2);
        sheet.label((RIGHT + 4.0, y - 8.0), Label::new("t", 13.0));
        let step = nice_step((self.to - self.from) / 6.0);
        // Beyond this, numbers are too large to be told apart.
        let count = ((self.to - self.from) / step) as usize;
        let first = (self.from / step).ceil();
        for tick in 0..=count.min(20) {
            let t = (first + tick as f64) * step;
            let x = self.x(t);
            if t > self.to || x > RIGHT - 14.0 {
                break;
            }
            sheet.line((x, y), (x, y + 5.0), Ink::line(palette::INK, 1.2));
            sheet.label((x, y + 18.0), Label::new(&tick_text(t, step), 11.5).colored(palette::MUTED));
        }
    }
}

/// A round number not far from `rough`: 1, 2 or 5 times a power of ten.
fn nice_step(rough: f64) -> f64 {
    let mut power = 1.0;
    while power * 10.0 <= rough && power < 1e30 {
        power *= 10.0;
    }
    while power > rough && power > 1e-30 {
        power /= 10.0;
    }
    [5.0, 2.0, 1.0].map(|digit| digit * power).into_iter().find(|&step| step <= rough).unwrap_or(power)
}

fn tick_text(t: f64, step: f64) -> String {
    let decimals = [1.0, 0.1, 0.01, 0.001].iter().position(|&unit| step >= unit * 0.999).unwrap_or(4);
    if t.abs() >= 1e6 || decimals == 4 { format!("{t:.1e}") } else { format!("{t:.decimals$}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::Solid;

    #[test]
    fn the_last_row_is_the_solid() {
        let holes =
            (0..40).map(|i| Solid::cylinder().scale([0.01, 0.01, 1.0]).translate([f64::from(i) / 40.0, 0.5, 0.0]));
        let scene = Scene::new(Solid::difference([Solid::block(), Solid::union(holes)]));
        let ray = Ray::new([-3.0, 0.501, 0.5], [1.0, 0.0, 0.0]);
        let exec = Exec::with_threads(1);
        let nodes = sketch(&scene.solid, TIPS);
        let rows = rows(&nodes, &scene, &ray, &exec).unwrap_or_else(|_| panic!("nobody cancels"));
        let whole = Tracer::build(&scene.solid, &TracerOptions::default(), &exec).expect("nobody cancels").spans(&ray);
        let ends = |spans: &Spans| spans.iter().map(|span| (span.enter_t(), span.exit_t())).collect::<Vec<_>>();
        assert_eq!(ends(&rows[rows.len() - 1].spans), ends(&whole));
        assert!(whole.len() > 30);
        // What is left out of the tree is in the row that stands for it.
        let more = rows.iter().find(|row| matches!(row.node.kind, Kind::More(..))).expect("forty holes do not fit");
        assert_eq!(more.spans.len(), 36);
    }

    #[test]
    fn steps_are_round() {
        assert_eq!([0.7, 3.0, 40.0, 0.013].map(nice_step), [0.5, 2.0, 20.0, 0.01]);
        assert_eq!(
            (tick_text(2.5, 0.5), tick_text(1e7, 1e6), tick_text(4.0, 2.0)),
            ("2.5".into(), "1.0e7".into(), "4".into())
        );
    }
}
