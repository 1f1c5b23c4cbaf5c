//! Programs for people to read.

use super::{Catalog, Constant, Word};
use crate::surface::{Placed, Surface};
use std::fmt::Write;

/// Nodes deeper than this are not indented any further, but numbered: else the text of a deep program would grow as the
/// square of its depth.
const MOST_INDENTED: usize = 40;

/// The program, a node a line, indented by depth.
pub fn program_text(catalog: &Catalog, program: &Constant) -> String {
    let words = match program {
        Constant::Everywhere(true) => return "everywhere\n".into(),
        Constant::Everywhere(false) => return "nothing\n".into(),
        Constant::Words(words) => words,
    };
    let mut text = String::new();
    let mut open: Vec<usize> = Vec::new();
    for (at, &word) in words.iter().enumerate() {
        while open.last().is_some_and(|&end| end <= at) {
            open.pop();
        }
        let depth = open.len();
        let indent = 2 * depth.min(MOST_INDENTED);
        let number = if depth > MOST_INDENTED { format!("{depth}: ") } else { String::new() };
        let line = match Word::decode(word) {
            Word::And { len } => {
                open.push(at + 1 + len as usize);
                "and".to_string()
            }
            Word::Or { len } => {
                open.push(at + 1 + len as usize);
                "or".to_string()
            }
            Word::Literal { index, negated } => {
                let literal = catalog.literal(index);
                let sign = if negated { "outside" } else { "inside" };
                let surface = surface_text(literal.surface);
                format!("{sign} s{} ({surface}), leaf {}", literal.stored + literal.surface_shift, literal.leaf)
            }
        };
        let _ = writeln!(text, "{:indent$}{number}{line}", "");
    }
    text
}

fn surface_text(surface: &Surface) -> String {
    match surface {
        Surface::Plane(p) => {
            format!("plane {:.6} {:.6} {:.6} < {:.6}", p.normal.x, p.normal.y, p.normal.z, p.offset)
        }
        Surface::Mesh(m) => format!("mesh of {} triangles", m.triangle_count()),
        Surface::Quadric(q) => format!("{:?}", q.kind).to_lowercase(),
        Surface::Placed(p) => {
            let Placed { prototype, offset, .. } = p;
            format!("solid {prototype} at {:.6} {:.6} {:.6}", offset.x, offset.y, offset.z)
        }
        Surface::Torus(t) => format!("torus of minor radius {:.6}", t.minor),
    }
}
