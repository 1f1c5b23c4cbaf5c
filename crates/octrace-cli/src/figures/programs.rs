//! Reduced programs, the few words that are left of the CSG tree in a cell, as small trees of text.

use super::icons;
use super::sheet::{Anchor, Ink, Label, Sheet, cut_to, number, palette, value};
use octrace::BoolOp;
use octrace::compile::{Catalog, Word, node_end};
use octrace::surface::{Plane, Surface};
use std::collections::BTreeSet;

/// A line of the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// How many operators it is under.
    pub depth: usize,
    /// What it says.
    pub what: What,
}

/// What a line says.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// An operator over the lines below that are one deeper.
    Operator(BoolOp),
    /// A surface, and on which side of it.
    Surface(String),
    /// So many words are not shown.
    More(usize),
}

/// Deeper nodes are not shown.
const DEEPEST: usize = 3;
/// The height of a line.
pub const LINE: f64 = 18.0;
const SIZE: f64 = 12.0;

/// A program in at most `most` lines; `names` are those of the primitives.
pub fn rows(catalog: &Catalog, words: &[u32], names: &[String], most: usize) -> Vec<Row> {
    let (mut rows, mut open, mut at) = (Vec::new(), Vec::new(), 0);
    while at < words.len() {
        while open.last().is_some_and(|&end| end <= at) {
            open.pop();
        }
        let depth = open.len();
        if depth > DEEPEST || (rows.len() + 1 == most && node_end(words, at) < words.len()) {
            rows.push(Row { depth: depth.min(DEEPEST), what: What::More(words.len() - at) });
            return rows;
        }
        let what = match Word::decode(words[at]) {
            Word::And { len } => {
                open.push(at + 1 + len as usize);
                What::Operator(BoolOp::Intersection)
            }
            Word::Or { len } => {
                open.push(at + 1 + len as usize);
                What::Operator(BoolOp::Union)
            }
            Word::Literal { index, negated } => What::Surface(literal(catalog, index, negated, names)),
        };
        rows.push(Row { depth, what });
        at += 1;
    }
    rows
}

/// The numbers of the primitives that a program mentions.
pub fn primitives(catalog: &Catalog, words: &[u32]) -> BTreeSet<u32> {
    let leaf = |&word: &u32| match Word::decode(word) {
        Word::Literal { index, .. } => Some(catalog.literal(index).leaf),
        Word::And { .. } | Word::Or { .. } => None,
    };
    words.iter().filter_map(leaf).collect()
}

fn literal(catalog: &Catalog, index: u32, negated: bool, names: &[String]) -> String {
    let literal = catalog.literal(index);
    let primitive = names.get(literal.leaf as usize).map_or("", String::as_str);
    match literal.surface {
        Surface::Plane(plane) => format!("{primitive}: {}", half_space(plane, negated)),
        _ if negated => format!("outside {primitive}"),
        _ => format!("inside {primitive}"),
    }
}

/// A half-space as an inequality, such as `x < 1`.
fn half_space(plane: &Plane, negated: bool) -> String {
    if let Some(axis) = (0..3).find(|&axis| plane.normal[axis].abs() == 1.0) {
        let below = (plane.normal[axis] > 0.0) != negated;
        let place = plane.offset * plane.normal[axis];
        return format!("{} {} {}", AXES[axis], if below { "<" } else { ">" }, value(place));
    }
    let mut sum = String::new();
    for (axis, name) in AXES.iter().enumerate() {
        let factor = number(plane.normal[axis].abs());
        if factor == "0" {
            continue;
        }
        sum += match (plane.normal[axis] < 0.0, sum.is_empty()) {
            (true, true) => "-",
            (true, false) => " - ",
            (false, true) => "",
            (false, false) => " + ",
        };
        sum += if factor == "1" { "" } else { &factor };
        sum += name;
    }
    format!("{sum} {} {}", if negated { ">" } else { "<" }, value(plane.offset))
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// Draws the lines; `(x, y)` is the left end of the first one's middle.
pub fn draw(sheet: &mut Sheet, (x, y): (f64, f64), width: f64, rows: &[Row]) {
    let left = |depth: usize| x + 22.0 * depth as f64;
    for (index, row) in rows.iter().enumerate() {
        let middle = y + LINE * index as f64;
        // Back to the operator above.
        if let Some(above) = rows[..index].iter().rposition(|other| other.depth + 1 == row.depth) {
            let trunk = left(row.depth - 1) + 8.0;
            let top = y + LINE * above as f64 + 8.0;
            let line = Ink::line(palette::FAINT, 1.4);
            let (trunk, end) = (number(trunk), number(left(row.depth) - 3.0));
            sheet.path(&format!("M{trunk} {} V{} H{end}", number(top), number(middle)), line);
        }
        let at = (left(row.depth), middle + 4.0);
        let room = width - (at.0 - x);
        match &row.what {
            What::Operator(op) => icons::operator(sheet, (at.0 + 8.0, middle), 8.0, *op),
            What::Surface(text) => {
                sheet.label(at, Label::new(&cut_to(text, SIZE, room), SIZE).held(Anchor::Start));
            }
            What::More(words) => {
                let text = format!("… {words} more");
                sheet.label(at, Label::new(&text, SIZE).held(Anchor::Start).colored(palette::MUTED));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::compile::{Constant, Copies, compile};
    use octrace::{Solid, Vec3};

    #[test]
    fn surfaces_are_named_and_long_programs_cut() {
        let solid = Solid::block() - Solid::sphere();
        let compiled = compile(std::slice::from_ref(&solid), 0.0, Copies::Apart);
        let Constant::Words(words) = &compiled.bodies[0].whole else { panic!("a solid with surfaces") };
        let names = ["block 0", "sphere 1"].map(String::from);
        let text = |row: &Row| match &row.what {
            What::Surface(text) => text.clone(),
            other => format!("{other:?}"),
        };
        let all: Vec<String> = rows(&compiled.catalog, words, &names, 99).iter().map(text).collect();
        assert_eq!(all.len(), 8);
        assert_eq!(all[0], "Operator(Intersection)");
        assert!(all.contains(&"block 0: x < 1".into()) && all.contains(&"block 0: z > 0".into()), "{all:?}");
        assert_eq!(all[7], "outside sphere 1");
        let cut = rows(&compiled.catalog, words, &names, 4);
        assert_eq!((cut.len(), &cut[3].what), (4, &What::More(5)));
    }
    #[test]
    fn slanted_planes_are_inequalities() {
        let plane = |normal: [f64; 3], offset| Plane { normal: Vec3::from(normal), offset };
        assert_eq!(half_space(&plane([0.6, 0.0, -0.8], 1.5), false), "0.6x - 0.8z < 1.5");
        assert_eq!(half_space(&plane([-0.6, 0.8, 0.0], 1.5), true), "-0.6x + 0.8y > 1.5");
        assert_eq!(half_space(&plane([1.0 - 1e-9, 1e-5, 0.0], 2.0), false), "x < 2");
    }
}
