//! The rays of one pixel: the paper's figure 4, after Whitted.

use super::icons;
use super::layout::{Block, Layout, layout};
use super::sheet::{Anchor, Ink, Label, MARGIN, Sheet, TOP, WIDTH, cut_to, number, palette};
use octrace::model::linear_to_srgb;
use octrace::shade::{RayKind, RayTree, TracedRay};
use octrace::{Material, Rgb, Scene};

/// So many ends of branches are shown at most, and so many rays one behind the other.
const TIPS: usize = 22;
const DEEPEST: usize = 4;
/// The box of a hit.
const BOX: (f64, f64) = (126.0, 38.0);
/// Where the first boxes begin.
const LEFT: f64 = MARGIN + 84.0;
const COLUMN: f64 = (WIDTH - MARGIN - BOX.0 - LEFT) / DEEPEST as f64;

/// The part of the tree that is shown.
struct Shown {
    /// Which rays, parents first.
    rays: Vec<usize>,
    blocks: Vec<Block>,
    /// For each shown ray how many rays start at its end that are not.
    hidden: Vec<usize>,
}

/// Draws the tree; `names` are those of the primitives.
pub fn draw(scene: &Scene, tree: &RayTree, names: &[String], pixel: (u32, u32)) -> String {
    let shown = shown(tree);
    let laid = layout(&shown.blocks, 8.0);
    let height = TOP + laid.breadth + 70.0;
    let title = format!("The tree of rays of pixel {}, {}", pixel.0, pixel.1);
    let note = "Each branch says what share of the pixel's light comes along it; each box shows its colour, and what the ray has met.";
    let mut sheet = Sheet::new(height, &title, note);
    let drawing = Drawing { scene, tree, names, shown: &shown, laid: &laid };
    for index in 0..shown.rays.len() {
        drawing.branch(&mut sheet, index);
    }
    for index in 0..shown.rays.len() {
        drawing.end(&mut sheet, index);
    }
    icons::eye(&mut sheet, (MARGIN + 16.0, TOP + 10.0 + laid.places[0].0));
    let (mut x, y) = (MARGIN, height - 22.0);
    for (color, dashes, words) in [
        (palette::INK, "", "from the eye"),
        (palette::SOLID, "", "reflected"),
        (palette::PURPLE, "", "refracted"),
        (palette::AMBER, "4 3", "towards a light"),
        (palette::MUTED, "4 3", "light in shadow"),
    ] {
        sheet.line((x, y - 4.0), (x + 26.0, y - 4.0), Ink { dashes, ..Ink::line(color, 2.0) });
        sheet.label((x + 32.0, y), Label::new(words, 12.5).held(Anchor::Start));
        x += 150.0;
    }
    sheet.finish()
}

/// Unfolds the rays that matter most to the pixel, until the page is full.
fn shown(tree: &RayTree) -> Shown {
    let mut children = vec![Vec::new(); tree.rays.len()];
    for (index, ray) in tree.rays.iter().enumerate() {
        if let Some(parent) = ray.parent {
            children[parent].push(index);
        }
    }
    let mut shown = Shown { rays: vec![0], blocks: vec![block(&tree.rays[0])], hidden: vec![children[0].len()] };
    let (mut depths, mut tips) = (vec![0], 1);
    let weight = |place: usize, shown: &Shown| tree.rays[shown.rays[place]].weight.max_component();
    loop {
        let fits = |&place: &usize, shown: &Shown| {
            let more = shown.hidden[place];
            more > 0 && depths[place] < DEEPEST && tips + more - 1 <= TIPS
        };
        let candidates = (0..shown.rays.len()).filter(|place| fits(place, &shown));
        let best = candidates.min_by(|&a, &b| weight(b, &shown).total_cmp(&weight(a, &shown)));
        let Some(place) = best else { return shown };
        tips += shown.hidden[place] - 1;
        shown.hidden[place] = 0;
        for &child in &children[shown.rays[place]] {
            let number = shown.rays.len();
            shown.blocks[place].children.push(number);
            shown.rays.push(child);
            shown.blocks.push(block(&tree.rays[child]));
            shown.hidden.push(children[child].len());
            depths.push(depths[place] + 1);
        }
    }
}

fn block(ray: &TracedRay) -> Block {
    let breadth = if matches!(ray.kind, RayKind::Shadow { .. }) { 20.0 } else { BOX.1 };
    Block { breadth, children: Vec::new() }
}

struct Drawing<'a> {
    scene: &'a Scene,
    tree: &'a RayTree,
    names: &'a [String],
    shown: &'a Shown,
    laid: &'a Layout,
}

impl Drawing<'_> {
    /// The left end and the middle of what a ray ends in.
    fn place(&self, index: usize) -> (f64, f64) {
        let (across, depth) = self.laid.places[index];
        (LEFT + depth as f64 * COLUMN, TOP + 10.0 + across)
    }

    fn ray(&self, index: usize) -> &TracedRay {
        &self.tree.rays[self.shown.rays[index]]
    }

    /// The line to a ray's end, with its share.
    fn branch(&self, sheet: &mut Sheet, index: usize) {
        let (x, y) = self.place(index);
        let ray = self.ray(index);
        let lit = ray.light.max_component() > 0.0;
        let (color, dashes) = match ray.kind {
            RayKind::Camera => (palette::INK, ""),
            RayKind::Reflected => (palette::SOLID, ""),
            RayKind::Refracted => (palette::PURPLE, ""),
            RayKind::Shadow { .. } if lit => (palette::AMBER, "4 3"),
            RayKind::Shadow { .. } => (palette::MUTED, "4 3"),
        };
        let parent = self.shown.blocks.iter().position(|block| block.children.contains(&index));
        let (from_x, from_y) = match parent {
            Some(parent) => (self.place(parent).0 + BOX.0, self.place(parent).1),
            None => (MARGIN + 34.0, y),
        };
        let bend = from_x + 10.0;
        let end = if matches!(ray.kind, RayKind::Shadow { .. }) { x - 2.0 } else { x };
        let data = format!("M{} {} H{} V{} H{}", number(from_x), number(from_y), number(bend), number(y), number(end));
        sheet.path(&data, Ink { dashes, ..Ink::line(color, 1.8) });
        if lit {
            let share = percent(luminance(ray.contribution()) / luminance(self.tree.rays[0].light));
            sheet.label((x - 4.0, y - 5.0), Label::new(&share, 11.0).held(Anchor::End).colored(color));
        }
    }

    /// What the ray has met.
    fn end(&self, sheet: &mut Sheet, index: usize) {
        let (x, y) = self.place(index);
        let ray = self.ray(index);
        let met = ray.hit.map(|(hit, point)| (self.names.get(hit.leaf as usize), self.scene.material(point.part)));
        let name = |name: Option<&String>| name.cloned().unwrap_or_default();
        if let RayKind::Shadow { light } = ray.kind {
            icons::lamp(sheet, (x + 10.0, y), ray.light.max_component() > 0.0);
            let words = match met {
                Some((blocker, _)) if ray.light.max_component() == 0.0 => {
                    format!("light {light} behind {}", name(blocker))
                }
                Some((through, _)) => format!("light {light} through {}", name(through)),
                None => format!("light {light}"),
            };
            let words = cut_to(&words, 11.5, WIDTH - MARGIN - (x + 24.0));
            sheet.label((x + 24.0, y + 4.0), Label::new(&words, 11.5).held(Anchor::Start).colored(palette::MUTED));
            return;
        }
        let (title, note) = match met {
            Some((leaf, material)) => (name(leaf), describe(&material)),
            None => ("background".into(), "nothing is met".into()),
        };
        let top = y - BOX.1 / 2.0;
        sheet.rect((x, top), BOX, 5.0, Ink::both(palette::PANEL, palette::FAINT, 1.2));
        sheet.rect((x + 6.0, top + 6.0), (14.0, 26.0), 3.0, Ink::both(&web_color(ray.light), palette::FAINT, 1.0));
        let room = BOX.0 - 32.0;
        sheet.label((x + 26.0, y - 3.0), Label::new(&cut_to(&title, 12.0, room), 12.0).held(Anchor::Start).bold());
        let note = cut_to(&note, 11.0, room);
        sheet.label((x + 26.0, y + 12.0), Label::new(&note, 11.0).held(Anchor::Start).colored(palette::MUTED));
        if self.shown.hidden[index] > 0 {
            let more = format!("… {} more", self.hidden_below(self.shown.rays[index]));
            let color = palette::MUTED;
            if x + BOX.0 + COLUMN > WIDTH {
                sheet.label(
                    (x + BOX.0 - 4.0, top + BOX.1 + 8.0),
                    Label::new(&more, 10.5).held(Anchor::End).colored(color),
                );
            } else {
                sheet.line((x + BOX.0, y), (x + BOX.0 + 10.0, y), Ink { dashes: "2 3", ..Ink::line(color, 1.5) });
                sheet.label((x + BOX.0 + 14.0, y + 4.0), Label::new(&more, 11.0).held(Anchor::Start).colored(color));
            }
        }
    }

    /// How many rays grow from a ray's end.
    fn hidden_below(&self, ray: usize) -> usize {
        let mut below = vec![false; self.tree.rays.len()];
        below[ray] = true;
        // Parents come first.
        for (index, ray) in self.tree.rays.iter().enumerate() {
            below[index] |= ray.parent.is_some_and(|parent| below[parent]);
        }
        below.iter().filter(|below| **below).count() - 1
    }
}

fn describe(material: &Material) -> String {
    match (material.kr > 0.0, material.is_transparent()) {
        (_, true) => format!("kr {} kt {}", number(material.kr), number(material.kt)),
        (true, false) => format!("kr {} kd {}", number(material.kr), number(material.kd)),
        (false, false) => format!("kd {} ks {}", number(material.kd), number(material.ks)),
    }
}

fn luminance(color: Rgb) -> f64 {
    0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b
}

fn percent(share: f64) -> String {
    let percent = share * 100.0;
    match percent {
        p if p >= 9.95 => format!("{p:.0} %"),
        p if p >= 0.05 => format!("{p:.1} %"),
        _ => "0 %".into(),
    }
}

fn web_color(color: Rgb) -> String {
    let [r, g, b] = [color.r, color.g, color.b].map(|v| (linear_to_srgb(v) * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use octrace::{Ray, Vec3};

    #[test]
    fn a_page_holds_what_matters_most() {
        let ray = |parent: Option<usize>, weight| TracedRay {
            parent,
            kind: RayKind::Reflected,
            ray: Ray::new(Vec3::ZERO, Vec3::X),
            hit: None,
            light: Rgb::WHITE,
            weight: Rgb::gray(weight),
        };
        // A binary tree with 8 levels; the right child always weighs less.
        let mut rays = vec![ray(None, 1.0)];
        for index in 0..127 {
            let weight = rays[index].weight.r;
            rays.push(ray(Some(index), weight * 0.6));
            rays.push(ray(Some(index), weight * 0.3));
        }
        let tree = RayTree { rays };
        let shown = shown(&tree);
        let tips = shown.blocks.iter().filter(|block| block.children.is_empty()).count();
        assert!(tips <= TIPS && shown.rays.contains(&15) && !shown.rays.contains(&31), "{:?}", shown.rays);
    }

    #[test]
    fn shares_are_short() {
        assert_eq!([1.0, 0.0991, 0.0001, f64::NAN].map(percent), ["100 %", "9.9 %", "0 %", "0 %"]);
    }
}
