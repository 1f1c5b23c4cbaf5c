//! A slice through the octree-CSG with some reduced programs: the paper's figures 5 and 6.

use super::icons::legend;
use super::programs;
use super::section::outline;
use super::sheet::{Ink, Label, MARGIN, Sheet, TOP, WIDTH, palette, value};
use super::slice::{Content, Slice, SliceCell};
use octrace::Tracer;
use std::collections::{BTreeMap, BTreeSet};

/// The side of the drawn root.
pub const SIDE: f64 = 560.0;
/// How finely the section is sampled.
pub const SECTION_ROWS: usize = 1120;
/// So many programs are shown.
const CARDS: usize = 6;
const CARD_LINES: usize = 6;
/// The least room between two of them.
const CARD_GAP: f64 = 8.0;
const CARD_LEFT: f64 = MARGIN + SIDE + 62.0;

/// Draws the slice; `names` are those of the primitives.
pub fn draw(slice: &Slice, tracer: &Tracer, names: &[String]) -> String {
    let note = format!(
        "The octree in the plane z = {}. A cell at the surface keeps what is left of the tree there; the others need none.",
        value(slice.z)
    );
    let mut sheet = Sheet::new(TOP + SIDE + 50.0, "The octree-CSG, cut open", &note);
    let map = Map { left: MARGIN, bottom: TOP + SIDE };
    for cell in &slice.cells {
        map.fill(&mut sheet, cell.area(), content_color(&cell.content));
    }
    let section = slice.section(tracer, SECTION_ROWS);
    sheet.path(&outline(&section, &map), Ink { opacity: 0.5, ..Ink::area(palette::SOLID) });
    for cell in &slice.cells {
        map.outline(&mut sheet, cell.area(), Ink::line("#8593a3", 0.7));
    }
    sheet.rect((MARGIN, TOP), (SIDE, SIDE), 0.0, Ink::line(palette::INK, 1.6));
    cards(&mut sheet, slice, names, &map);

    let y = TOP + SIDE + 28.0;
    let border = |fill| Ink::both(fill, "#8593a3", 1.0);
    let mut x = legend(&mut sheet, (MARGIN, y), border(palette::PAPER), "outside");
    x = legend(&mut sheet, (x, y), border(palette::INSIDE), "inside");
    x = legend(&mut sheet, (x, y), border(palette::LEAF), "leaf: a reduced tree");
    legend(&mut sheet, (x, y), Ink { opacity: 0.5, ..Ink::area(palette::SOLID) }, "the solid's true section");
    sheet.finish()
}

/// The colour of a cell.
pub fn content_color(content: &Content) -> &'static str {
    match content {
        Content::Outside => palette::PAPER,
        Content::Inside => palette::INSIDE,
        Content::Leaf(_) => palette::LEAF,
    }
}

/// Where the root, as a square with sides of 1, is drawn: y goes up.
pub struct Map {
    /// Its left side.
    pub left: f64,
    /// Its bottom.
    pub bottom: f64,
}

impl Map {
    /// A point of the root.
    pub fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.left + x * SIDE, self.bottom - y * SIDE)
    }

    /// A square filled with a colour, unless that is the paper's.
    pub fn fill(&self, sheet: &mut Sheet, area: ([f64; 2], f64), color: &str) {
        if color != palette::PAPER {
            self.outline(sheet, area, Ink::area(color));
        }
    }

    /// A square.
    pub fn outline(&self, sheet: &mut Sheet, ([x, y], side): ([f64; 2], f64), ink: Ink) {
        sheet.rect(self.at(x, y + side), (side * SIDE, side * SIDE), 0.0, ink);
    }
}

/// Some programs beside the slice, each with a line to its cell.
fn cards(sheet: &mut Sheet, slice: &Slice, names: &[String], map: &Map) {
    let mut chosen = chosen(slice);
    chosen.sort_by(|a, b| middle(b)[1].total_cmp(&middle(a)[1]));
    let texts: Vec<Vec<programs::Row>> = chosen
        .iter()
        .map(|cell| match &cell.content {
            Content::Leaf(words) => programs::rows(slice.catalog, words, names, CARD_LINES),
            _ => Vec::new(),
        })
        .collect();
    let heights: Vec<f64> = texts.iter().map(|rows| card_height(rows.len())).collect();
    let spare = (SIDE - heights.iter().sum::<f64>()).max(0.0);
    let gap = (spare / (heights.len() as f64 - 1.0).max(1.0)).min(40.0);
    let mut top = TOP + (spare - gap * (heights.len() as f64 - 1.0)).max(0.0) / 2.0;
    for (number, ((cell, rows), height)) in chosen.iter().zip(&texts).zip(&heights).enumerate() {
        let letter = char::from(b'a' + number as u8).to_string();
        let [x, y] = middle(cell);
        let (at, card) = (map.at(x, y), (CARD_LEFT, top + height / 2.0));
        map.outline(sheet, cell.area(), Ink::line(palette::RED, 2.0));
        let half = cell.area().1 * SIDE / 2.0;
        // Level to the side of the slice, then to the card.
        let (edge, ink) = ((MARGIN + SIDE + 10.0, at.1), Ink::line(palette::RED, 1.1));
        sheet.line((at.0 + half, at.1), edge, ink);
        sheet.line(edge, card, ink);
        sheet.rect(
            (CARD_LEFT, top),
            (WIDTH - MARGIN - CARD_LEFT, *height),
            5.0,
            Ink::both(palette::PANEL, palette::FAINT, 1.2),
        );
        sheet.circle(card, 10.0, Ink::area(palette::RED));
        sheet.label((card.0, card.1 + 4.5), Label::new(&letter, 13.0).colored(palette::PAPER).bold());
        let left = CARD_LEFT + 22.0;
        programs::draw(sheet, (left, top + 16.0), WIDTH - MARGIN - 8.0 - left, rows);
        top += height + gap;
    }
}

/// The height of a card for a text of so many lines, of which not all may be shown.
fn card_height(lines: usize) -> f64 {
    programs::LINE * lines.min(CARD_LINES) as f64 + 14.0
}

fn middle(cell: &SliceCell) -> [f64; 2] {
    let (corner, side) = cell.area();
    corner.map(|place| place + side / 2.0)
}

/// Cells with different programs, not too close to each other, that show as many primitives as possible.
fn chosen<'a>(slice: &'a Slice<'_>) -> Vec<&'a SliceCell> {
    let mut cells_of: BTreeMap<&[u32], Vec<&SliceCell>> = BTreeMap::new();
    for cell in &slice.cells {
        if let Content::Leaf(words) = &cell.content {
            cells_of.entry(words).or_default().push(cell);
        }
    }
    // Programs that a card does not hold say little: only where there are no others.
    if cells_of.keys().any(|words| words.len() <= CARD_LINES) {
        cells_of.retain(|words, _| words.len() <= CARD_LINES);
    }
    for cells in cells_of.values_mut() {
        // Large cells are easy to see, those on the right need the shortest lines.
        cells.sort_by(|a, b| a.level.cmp(&b.level).then(middle(b)[0].total_cmp(&middle(a)[0])));
    }
    let far = |cell: &SliceCell, other: &SliceCell| {
        let ([x, y], [u, v]) = (middle(cell), middle(other));
        // Lines of cells at one height would run into each other.
        (x - u) * (x - u) + (y - v) * (y - v) > 0.14 * 0.14 && (y - v).abs() > 0.02
    };
    let (mut chosen, mut shown): (Vec<&SliceCell>, BTreeSet<u32>) = (Vec::new(), BTreeSet::new());
    let mut room = SIDE;
    while chosen.len() < CARDS {
        let new = |words: &[u32]| programs::primitives(slice.catalog, words).difference(&shown).count();
        let fits =
            |cells: &[&'a SliceCell]| cells.iter().copied().find(|cell| chosen.iter().all(|other| far(cell, other)));
        let short = cells_of.iter().filter(|(words, _)| card_height(words.len()) + CARD_GAP <= room);
        let candidates = short.filter_map(|(words, cells)| Some((*words, fits(cells)?)));
        let Some((words, cell)) = candidates.max_by_key(|(words, _)| (new(words), words.len())) else { break };
        shown.extend(programs::primitives(slice.catalog, words));
        chosen.push(cell);
        room -= card_height(words.len()) + CARD_GAP;
        cells_of.remove(words);
    }
    chosen
}
