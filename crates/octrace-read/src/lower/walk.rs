//! Goes through the tree, children before parents, and combines what they are. The stack is ours, so any depth will do.

use super::Skipped;
use super::args::Args;
use super::language::{self, Kind, Word};
use super::looks::{Look, Parts};
use super::report::Report;
use super::settings::Settings;
use super::shapes::{self, Shapes};
use super::transforms::{Placement, placement};
use crate::diagnostic::{Diagnostic, Severity};
use crate::syntax::{Ast, Modifiers, NodeId, Siblings};
use crate::{Dialect, ReadOptions, SourceRange};
use octrace::{Affine, BoolOp, PartId, Solid};

/// What a node is to the operation around it.
#[derive(Clone, Debug)]
pub(super) enum Operand {
    /// A solid.
    Solid(Made),
    /// Nothing, and meant to be.
    Empty,
    /// Something that cannot be rendered yet.
    LeftOut,
}

/// A solid, and what is known of its leaves.
#[derive(Clone, Debug)]
pub(super) struct Made {
    pub solid: Solid,
    /// The part of the first leaf that has one.
    first_part: Option<PartId>,
    /// Whether there are leaves that belong to no part yet.
    bare: bool,
}

impl Made {
    fn leaf(solid: Solid) -> Self {
        Self { solid, first_part: None, bare: true }
    }

    /// With its bare leaves put into `part`.
    fn part(self, part: PartId) -> Self {
        let first_part = self.first_part.or(Some(part));
        let solid = if self.bare { self.solid.part(part) } else { self.solid };
        Self { solid, first_part, bare: false }
    }
}

/// A node whose children are being gone through.
struct Frame<'a> {
    node: Option<NodeId>,
    kind: Kind,
    children: Siblings<'a>,
    operands: Vec<Operand>,
    look: Look,
    /// Whether the look changes here.
    new_look: bool,
    placement: Placement,
    /// From here to the scene.
    map: Affine,
    /// Whether solids count here: not outside the node marked `!`, and not below what is left out.
    counts: bool,
}

/// The state of lowering one tree.
pub(super) struct Walk<'a, 'r> {
    ast: &'a Ast,
    /// What the names of the tree mean, in their order.
    words: Vec<Option<&'static Word>>,
    report: Report<'r>,
    shapes: Shapes,
    skip_unsupported: bool,
    root: Option<NodeId>,
    root_result: Operand,
    pub settings: Settings,
    pub parts: Parts,
    pub skipped: Vec<Skipped>,
    pub background: usize,
    pub background_at: Option<SourceRange>,
    pub depth: usize,
    pub leaves: usize,
}

impl<'a, 'r> Walk<'a, 'r> {
    pub fn new(ast: &'a Ast, options: &ReadOptions, report: Report<'r>) -> Self {
        Self {
            ast,
            words: ast.names().map(language::find).collect(),
            report,
            shapes: Shapes::new(options.facets),
            skip_unsupported: options.skip_unsupported,
            root: None,
            root_result: Operand::Empty,
            settings: Settings::default(),
            parts: Parts::default(),
            skipped: Vec::new(),
            background: 0,
            background_at: None,
            depth: 0,
            leaves: 0,
        }
    }

    /// What the whole file is.
    pub fn run(&mut self) -> Operand {
        self.root = self.find_root();
        let file = Frame {
            node: None,
            kind: Kind::Group,
            children: self.ast.roots(),
            operands: Vec::new(),
            look: Look::default(),
            new_look: false,
            placement: Placement::Moved(Affine::IDENTITY),
            map: Affine::IDENTITY,
            counts: self.root.is_none(),
        };
        let mut stack = vec![file];
        loop {
            self.depth = self.depth.max(stack.len() - 1);
            let top = stack.last_mut().expect("the frame of the file leaves last");
            if let Some(child) = top.children.next() {
                match self.enter(child, top) {
                    Step::Into(frame) => stack.push(*frame),
                    Step::Done(operand) => top.operands.extend(operand),
                }
                continue;
            }
            let frame = stack.pop().expect("it was there just now");
            let node = frame.node;
            let operand = self.leave(frame);
            if node.is_some() && node == self.root {
                self.root_result = operand.clone();
            }
            match stack.last_mut() {
                Some(parent) => parent.operands.push(operand),
                None if self.root.is_some() => return std::mem::replace(&mut self.root_result, Operand::Empty),
                None => return operand,
            }
        }
    }

    /// The first node marked `!`. Others are reported.
    fn find_root(&mut self) -> Option<NodeId> {
        let mut first: Option<NodeId> = None;
        let mut hidden_until = None::<NodeId>;
        for node in self.ast.nodes() {
            if hidden_until.is_some_and(|hidden| self.ast.is_within(node, hidden)) {
                continue;
            }
            let modifiers = self.ast.modifiers(node);
            if modifiers.contains(Modifiers::DISABLED) || modifiers.contains(Modifiers::BACKGROUND) {
                hidden_until = Some(node);
            } else if modifiers.contains(Modifiers::ROOT) {
                match first {
                    None => first = Some(node),
                    Some(first) => {
                        let message = "more than one node is marked `!`; only the first one counts";
                        let diagnostic = Diagnostic::warning("several-roots", self.ast.name_at(node), message);
                        self.report.push(diagnostic.with_note(self.ast.name_at(first), "this is the first one"));
                    }
                }
            }
        }
        first
    }

    /// Looks at a node before its children.
    fn enter(&mut self, node: NodeId, parent: &Frame<'a>) -> Step<'a> {
        let modifiers = self.ast.modifiers(node);
        if modifiers.contains(Modifiers::DISABLED) {
            return Step::Done(None);
        }
        if modifiers.contains(Modifiers::BACKGROUND) {
            self.background += 1;
            self.background_at = self.background_at.or(Some(self.ast.name_at(node)));
            return Step::Done(None);
        }
        let is_root = self.root == Some(node);
        let counts = parent.counts || is_root;
        let (look, map) = if is_root { (Look::default(), Affine::IDENTITY) } else { (parent.look, parent.map) };
        let Some(word) = self.words[self.ast.name_index(node)] else {
            self.unknown(node);
            let kind = Kind::Unsupported("");
            return Step::Into(Box::new(self.frame(node, kind, look, map)));
        };
        let args = Args::of(self.ast, node, word, &mut self.report);
        if word.kind.is_leaf() {
            self.refuse_children(node, word);
            let operand = self.leaf(word.kind, &args, &map, counts);
            if is_root {
                self.root_result = operand.clone().unwrap_or(Operand::Empty);
            }
            return Step::Done(operand);
        }
        let mut frame = Frame { counts, ..self.frame(node, word.kind, look, map) };
        match word.kind {
            Kind::Unsupported(needs) => {
                if counts {
                    self.unsupported(node, needs);
                }
                frame.counts = false;
            }
            Kind::Color => frame.look = look.with_color(&args, &mut self.report),
            Kind::Material => frame.look = look.with_material(&args, &mut self.report),
            Kind::Group | Kind::Difference | Kind::Intersection => {}
            transform => {
                frame.placement = placement(transform, &args, &mut self.report);
                if let Placement::Moved(own) = frame.placement {
                    frame.map = map * own;
                }
            }
        }
        frame.new_look = frame.look != look;
        Step::Into(Box::new(frame))
    }

    fn frame(&self, node: NodeId, kind: Kind, look: Look, map: Affine) -> Frame<'a> {
        Frame {
            node: Some(node),
            kind,
            children: self.ast.children(node),
            operands: Vec::new(),
            look,
            new_look: false,
            placement: Placement::Moved(Affine::IDENTITY),
            map,
            counts: false,
        }
    }

    fn leaf(&mut self, kind: Kind, args: &Args<'_>, map: &Affine, counts: bool) -> Option<Operand> {
        if matches!(kind, Kind::Light | Kind::Camera | Kind::Ambient | Kind::Background) {
            self.settings.take(kind, args, map, &mut self.report);
            return None;
        }
        if !counts {
            return Some(Operand::Empty);
        }
        Some(match self.shapes.leaf(kind, args, &mut self.report) {
            Some(solid) if shapes::can_be_placed(&solid, map, args.name_at, &mut self.report) => {
                self.leaves += 1;
                Operand::Solid(Made::leaf(solid))
            }
            _ => Operand::Empty,
        })
    }

    /// Combines what the children of a node are.
    fn leave(&mut self, frame: Frame<'a>) -> Operand {
        let Frame { node, kind, operands, look, new_look, placement, .. } = frame;
        let combined = match kind {
            Kind::Unsupported(_) => return Operand::LeftOut,
            Kind::Difference => self.difference(node, operands, look),
            Kind::Intersection => self.intersection(node, operands),
            _ => combine(BoolOp::Union, operands),
        };
        let Operand::Solid(made) = combined else { return combined };
        let made = match placement {
            Placement::Moved(map) => Made { solid: made.solid.transform(map), ..made },
            Placement::Flattened => return Operand::Empty,
        };
        match node {
            Some(node) if new_look && made.bare => {
                let part = self.parts.of(look.material(), self.ast.name_at(node));
                Operand::Solid(made.part(part))
            }
            _ => Operand::Solid(made),
        }
    }

    fn difference(&mut self, node: Option<NodeId>, operands: Vec<Operand>, look: Look) -> Operand {
        let wall = match operands.first() {
            // The wall of a hole drilled into red plastic is red.
            Some(Operand::Solid(first)) => first.first_part.filter(|_| look.is_plain()),
            Some(Operand::LeftOut) => {
                self.consequence(node, "the first operand of this difference is left out, and so is all of it");
                return Operand::LeftOut;
            }
            Some(Operand::Empty) | None => return Operand::Empty,
        };
        let paint = |(i, operand)| match (operand, wall) {
            (Operand::Solid(tool), Some(part)) if i > 0 => Operand::Solid(tool.part(part)),
            (operand, _) => operand,
        };
        combine(BoolOp::Difference, operands.into_iter().enumerate().map(paint).collect())
    }

    fn intersection(&mut self, node: Option<NodeId>, operands: Vec<Operand>) -> Operand {
        if operands.is_empty() || operands.iter().any(|o| matches!(o, Operand::Empty)) {
            return Operand::Empty;
        }
        if operands.iter().any(|o| matches!(o, Operand::LeftOut)) {
            self.consequence(node, "an operand of this intersection is left out; it is that of the others");
        }
        combine(BoolOp::Intersection, operands)
    }

    /// Leaving something out changes something else.
    fn consequence(&mut self, node: Option<NodeId>, message: &str) {
        if let (true, Some(node)) = (self.skip_unsupported, node) {
            self.report.push(Diagnostic::warning("left-out-operand", self.ast.name_at(node), message));
        }
    }

    fn unsupported(&mut self, node: NodeId, needs: &str) {
        let name = self.ast.name(node);
        let at = self.ast.name_at(node);
        let (severity, message) = if self.skip_unsupported {
            (Severity::Warning, format!("`{name}` cannot be rendered yet; it is left out"))
        } else {
            (Severity::Error, format!("`{name}` cannot be rendered yet"))
        };
        self.report.push(Diagnostic::new(severity, "unsupported-node", at, message).with_help(needs));
        self.skipped.push(Skipped { name: name.to_owned(), at });
    }

    fn unknown(&mut self, node: NodeId) {
        let (name, at) = (self.ast.name(node), self.ast.name_at(node));
        let near = language::nearest(name, language::WORDS.iter().map(|w| w.name));
        let help = match near {
            Some(near) => format!("did you mean `{near}`?"),
            None => "modules are not evaluated here; a `.scad` file is, by OpenSCAD".to_owned(),
        };
        let leave_out = self.skip_unsupported && self.report.dialect == Dialect::Dump;
        let (severity, tail) = if leave_out { (Severity::Warning, "; it is left out") } else { (Severity::Error, "") };
        let message = format!("there is no node `{name}`{tail}");
        self.report.push(Diagnostic::new(severity, "unknown-node", at, message).with_help(help));
        self.skipped.push(Skipped { name: name.to_owned(), at });
    }

    fn refuse_children(&mut self, node: NodeId, word: &Word) {
        let Some(child) = self.ast.children(node).next() else { return };
        if !self.ast.is_damaged(node) {
            let message = format!("`{}` takes no children; these are ignored", word.name);
            let diagnostic = Diagnostic::warning("unexpected-children", self.ast.name_at(child), message);
            self.report.push(diagnostic.with_help("is a `;` missing in front of this?"));
        }
    }
}

/// How to go on after a look at a node.
enum Step<'a> {
    /// Through its children.
    Into(Box<Frame<'a>>),
    /// With its next sibling; what this one is, if it is an operand at all.
    Done(Option<Operand>),
}

/// Combines the solids among the operands. Without any, it is left out if some operand is.
fn combine(op: BoolOp, operands: Vec<Operand>) -> Operand {
    let left_out = operands.iter().any(|o| matches!(o, Operand::LeftOut));
    let (mut first_part, mut bare) = (None, false);
    let mut solids = Vec::with_capacity(operands.len());
    for operand in operands {
        if let Operand::Solid(made) = operand {
            first_part = first_part.or(made.first_part);
            bare |= made.bare;
            solids.push(made.solid);
        }
    }
    match (solids.is_empty(), left_out) {
        (false, _) => Operand::Solid(Made { solid: Solid::combine(op, solids), first_part, bare }),
        (true, true) => Operand::LeftOut,
        (true, false) => Operand::Empty,
    }
}
