//! What a tree means: checks every node's arguments and makes a [`octrace::Scene`].

mod args;
mod asides;
mod facets;
mod flats;
mod imports;
mod language;
mod looks;
mod memory;
mod operand;
mod operation;
mod perform;
mod polyhedron;
mod report;
mod settings;
mod shapes;
mod transforms;
mod types;
mod walk;

use crate::diagnostic::{Collector, Diagnostic};
use crate::syntax::Ast;
use crate::{Dialect, Ghosts, ReadOptions, Source, SourceRange};
use octrace::{Scene, Solid};
use operand::Operand;
use std::collections::BTreeMap;
use walk::Walk;

/// A scene, and what there is to tell about the file that it came from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// How many nodes of each name the file has.
    pub node_counts: BTreeMap<String, usize>,
    /// How deep its nodes are nested.
    pub depth: usize,
    /// How many primitives the solid has.
    pub leaves: usize,
    /// Where each of the scene's parts was first asked for.
    pub part_places: Vec<SourceRange>,
    /// What was left out because it cannot be rendered yet.
    pub skipped: Vec<Skipped>,
    /// How many subtrees were dropped because of OpenSCAD's `%`: they are not part of the object.
    pub background: usize,
}

/// A node that was left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// What it is called.
    pub name: String,
    /// Where it is written, without its children.
    pub at: SourceRange,
}

/// Gives a tree its meaning. The value is only of use where no error was reported.
pub(crate) fn lower(ast: &Ast, source: &Source, options: &ReadOptions, out: &mut Collector) -> Loaded {
    let dialect = options.dialect.unwrap_or_else(|| source.dialect());
    let syntax_is_sound = !out.has_errors();
    let mut walk = Walk::new(ast, options, source.assets(), report::Report::new(source.text(), dialect, out));
    let result = walk.run();
    let Walk { settings, mut parts, skipped, background, background_at, depth, leaves, asides, .. } = walk;
    let first_at = ast.roots().next().map_or(SourceRange::default(), |node| ast.name_at(node));
    if let (Some(at), Ghosts::Hidden) = (background_at, options.ghosts) {
        let things = if background == 1 { "a subtree".to_owned() } else { format!("{background} subtrees") };
        let message = format!("`%` marks {things} as not part of the object: left out");
        out.push(Diagnostic::note("background-modifier", at, message));
    }
    let mut solids: Vec<Solid> = match result {
        Operand::Solid(made) => vec![made.solid],
        Operand::Flat(flat) => {
            let message = "this is flat; it becomes a plate of height 1, as in OpenSCAD's preview";
            out.push(Diagnostic::note("flat-file", first_at, message));
            let plate = perform::plate(&flat, options.tolerance);
            plate.map_err(|error| out.push(perform::failed(&error, first_at))).into_iter().collect()
        }
        Operand::Corners(_) | Operand::Empty | Operand::LeftOut => Vec::new(),
    };
    for (solid, material) in asides.finish() {
        solids.push(solid.part(parts.of(material, first_at)));
    }
    if solids.is_empty() && syntax_is_sound && !out.has_errors() {
        out.push(empty_scene(ast, !skipped.is_empty()));
    }
    let solid = Solid::union(solids);
    let default_snap = match dialect {
        Dialect::Dump => Scene::SNAP_SIX_DIGITS,
        Dialect::Scene => 0.0,
    };
    let mut counts = vec![0; ast.names().len()];
    for node in ast.nodes() {
        counts[ast.name_index(node)] += 1;
    }
    let node_counts = ast.names().zip(counts).filter(|&(_, count)| count > 0);
    Loaded {
        scene: Scene {
            solid,
            parts: parts.list,
            lights: settings.lights,
            camera: settings.camera,
            ambient: settings.ambient,
            background: settings.background,
            snap: options.snap.unwrap_or(default_snap),
        },
        node_counts: node_counts.map(|(name, count)| (name.to_owned(), count)).collect(),
        depth,
        leaves,
        part_places: parts.places,
        skipped,
        background,
    }
}

/// There is nothing to draw, and nothing else is wrong.
fn empty_scene(ast: &Ast, left_out: bool) -> Diagnostic {
    let at = ast.roots().next().map_or(SourceRange::default(), |node| ast.name_at(node));
    let (message, help) = if ast.is_empty() {
        ("there is nothing to draw: the file is empty", "a scene has at least one solid, such as `cube();`")
    } else if left_out {
        ("there is nothing to draw: everything in the file was left out", "see the warnings for what was left out")
    } else {
        (
            "there is nothing to draw: the solids of this file are empty",
            "is this a library, or does it subtract everything?",
        )
    };
    Diagnostic::error("empty-scene", at, message).with_help(help)
}
