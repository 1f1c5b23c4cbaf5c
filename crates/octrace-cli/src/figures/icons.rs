//! Small pictures of primitives and operators.

use super::sheet::{Anchor, Ink, Label, Sheet, number, palette, point};
use super::sketch::operator_sign;
use octrace::{BoolOp, Primitive};

/// The colour of an operator.
pub fn operator_color(op: BoolOp) -> &'static str {
    match op {
        BoolOp::Union => palette::GREEN,
        BoolOp::Intersection => palette::PURPLE,
        BoolOp::Difference => palette::RED,
    }
}

/// An operator: its sign in a disc.
pub fn operator(sheet: &mut Sheet, (x, y): (f64, f64), radius: f64, op: BoolOp) {
    sheet.circle((x, y), radius, Ink::both(palette::PAPER, operator_color(op), 2.0));
    let size = radius * 1.3;
    let label = Label::new(operator_sign(op), size).colored(operator_color(op)).bold();
    sheet.label((x, y + size * 0.36), label);
}

/// A primitive, about 36 pixels wide and high.
pub fn primitive(sheet: &mut Sheet, (x, y): (f64, f64), primitive: &Primitive) {
    let line = Ink::line(palette::SOLID, 1.4);
    let body = Ink::both(palette::INSIDE, palette::SOLID, 1.4);
    let at = |dx: f64, dy: f64| point((x + dx, y + dy));
    match primitive {
        Primitive::Block => {
            let (front, top, side) = (
                format!("M{} L{} L{} L{} Z", at(-15.0, -6.0), at(7.0, -6.0), at(7.0, 15.0), at(-15.0, 15.0)),
                format!("M{} L{} L{} L{} Z", at(-15.0, -6.0), at(-6.0, -15.0), at(16.0, -15.0), at(7.0, -6.0)),
                format!("M{} L{} L{} L{} Z", at(7.0, -6.0), at(16.0, -15.0), at(16.0, 6.0), at(7.0, 15.0)),
            );
            for face in [front, top, side] {
                sheet.path(&face, body);
            }
        }
        Primitive::Sphere => {
            sheet.circle((x, y), 16.0, body);
            sheet.path(&format!("M{} A16 5 0 0 0 {}", at(-16.0, 0.0), at(16.0, 0.0)), line);
        }
        Primitive::Cylinder => frustum(sheet, (x, y), 12.0, 12.0),
        Primitive::Cone { top } => frustum(sheet, (x, y), 14.0, (14.0 * top.min(0.7)).max(0.01)),
        Primitive::HalfSpace => {
            sheet.rect((x - 17.0, y), (34.0, 13.0), 0.0, Ink::area(palette::INSIDE));
            sheet.line((x - 17.0, y), (x + 17.0, y), Ink::line(palette::SOLID, 2.0));
            sheet.arrow((x, y), (x, y - 13.0), palette::SOLID, 1.2);
        }
        Primitive::Torus { .. } => {
            sheet.path(&format!("M{} a17 9 0 1 0 34 0 a17 9 0 1 0 -34 0", at(-17.0, 0.0)), body);
            let hole = Ink::both(palette::PAPER, palette::SOLID, 1.4);
            sheet.path(&format!("M{} a8 3.4 0 1 0 16 0 a8 3.4 0 1 0 -16 0", at(-8.0, 0.0)), hole);
        }
        Primitive::Prism { .. } => {
            let side = format!("M{} v9 h11 v7 h19 v-9 h-19 v-7 Z", at(-15.0, 0.0));
            let face = format!("M{} h11 v10 h19 v7 h-30 Z", at(-15.0, -10.0));
            sheet.path(&side, body);
            sheet.path(&face, body);
        }
        Primitive::Revolution(_) => {
            let side = "c14 9 -4 12 4 26 h16 c8 -14 -10 -17 4 -26";
            sheet.path(&format!("M{} {side} Z", at(-12.0, -13.0)), body);
            sheet.path(&format!("M{} a12 3.6 0 1 0 24 0 a12 3.6 0 1 0 -24 0", at(-12.0, -13.0)), body);
        }
        Primitive::Polyhedron(_) => {
            let rim = [(0.0, -17.0), (15.0, -7.0), (12.0, 11.0), (-3.0, 16.0), (-15.0, 5.0), (-11.0, -10.0)];
            let corners: Vec<String> = rim.iter().map(|&(dx, dy)| at(dx, dy)).collect();
            sheet.path(&format!("M{} Z", corners.join(" L")), body);
            let inner =
                format!("M{0} L{1} L{2} M{1} L{3}", at(-11.0, -10.0), at(3.0, 0.0), at(15.0, -7.0), at(-3.0, 16.0));
            sheet.path(&inner, line);
        }
    }
}

fn frustum(sheet: &mut Sheet, (x, y): (f64, f64), low: f64, high: f64) {
    let body = Ink::both(palette::INSIDE, palette::SOLID, 1.4);
    let (top, bottom) = (y - 12.0, y + 12.0);
    let radii = |r: f64| format!("{} {}", number(r), number(r / 3.0));
    let data = format!(
        "M{} L{} A{} 0 0 0 {} L{} A{} 0 0 0 {} Z",
        point((x - high, top)),
        point((x - low, bottom)),
        radii(low),
        point((x + low, bottom)),
        point((x + high, top)),
        radii(high),
        point((x - high, top)),
    );
    sheet.path(&data, body);
    let rim = format!("M{} A{} 0 0 0 {}", point((x - high, top)), radii(high), point((x + high, top)));
    sheet.path(&rim, Ink::line(palette::SOLID, 1.4));
}

/// A lamp, lit or in the shadow.
pub fn lamp(sheet: &mut Sheet, (x, y): (f64, f64), lit: bool) {
    let color = if lit { palette::AMBER } else { palette::MUTED };
    let fill = if lit { "#ffd467" } else { palette::PAPER };
    for (dx, dy) in [(0.0, 1.0), (1.0, 0.0), (0.71, 0.71), (0.71, -0.71)] {
        let (a, b) = ((x - 9.0 * dx, y - 9.0 * dy), (x + 9.0 * dx, y + 9.0 * dy));
        sheet.line(a, b, Ink::line(color, 1.2));
    }
    sheet.circle((x, y), 5.0, Ink::both(fill, color, 1.4));
}

/// An eye.
pub fn eye(sheet: &mut Sheet, (x, y): (f64, f64)) {
    let (left, right) = (point((x - 14.0, y)), point((x + 14.0, y)));
    let lids = format!("M{left} Q{} {right} Q{} {left} Z", point((x, y - 15.0)), point((x, y + 15.0)));
    sheet.path(&lids, Ink::both(palette::PAPER, palette::INK, 1.6));
    sheet.circle((x, y), 4.6, Ink::area(palette::INK));
}

/// An entry of a legend: a square of colour and what it stands for. Returns where the next one may begin.
pub fn legend(sheet: &mut Sheet, (x, y): (f64, f64), ink: Ink, words: &str) -> f64 {
    sheet.rect((x, y - 11.0), (14.0, 14.0), 2.0, ink);
    sheet.label((x + 20.0, y), Label::new(words, 12.5).held(Anchor::Start));
    x + 20.0 + super::sheet::text_width(words, 12.5) + 14.0
}
