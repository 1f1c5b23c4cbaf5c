//! Goes through the tree, children before parents, and combines what they are. The stack is ours, so any depth will do.

use super::Skipped;
use super::args::Args;
use super::asides::{Aside, Asides};
use super::language::{self, Kind, Word};
use super::looks::{Look, Parts};
use super::memory::{Known, Memory};
use super::operand::{Operand, Operands};
use super::operation::Operation;
use super::report::Report;
use super::settings::Settings;
use super::shapes::{self, Shapes};
use super::transforms::{Placement, place_of_map, placement};
use crate::assets::Assets;
use crate::diagnostic::{Diagnostic, Severity};
use crate::syntax::{Ast, Modifiers, NodeId, Siblings};
use crate::{CutColor, Dialect, Ghosts, Highlights, ReadOptions, SourceRange};
use octrace::Affine;

/// A node whose children are being gone through.
pub(super) struct Frame<'a> {
    pub node: Option<NodeId>,
    pub operation: Operation,
    children: Siblings<'a>,
    pub operands: Operands,
    pub look: Look,
    /// Whether the look changes here.
    pub new_look: bool,
    pub placement: Placement,
    /// Where that is written.
    pub placement_at: SourceRange,
    /// From here to the scene.
    pub map: Affine,
    /// Whether solids count here: not outside the node marked `!`, and not below what is left out.
    counts: bool,
    /// Whether colours and materials count here.
    paints: bool,
    /// Whether a hull takes it as it is, for what a surface that bounds no solid still is to a hull.
    pub in_hull: bool,
    /// Where its result goes besides, or instead.
    aside: Aside,
    /// What was there when it was entered, to tell what comes of it.
    known: Option<Known>,
}

/// The state of lowering one tree.
pub(super) struct Walk<'a, 'r> {
    pub(super) ast: &'a Ast,
    pub(super) options: &'a ReadOptions,
    pub(super) assets: &'a dyn Assets,
    /// What the names of the tree mean, in their order.
    words: Vec<Option<&'static Word>>,
    pub(super) report: Report<'r>,
    pub(super) shapes: Shapes,
    memory: Memory,
    pub asides: Asides,
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
    pub fn new(ast: &'a Ast, options: &'a ReadOptions, assets: &'a dyn Assets, report: Report<'r>) -> Self {
        Self {
            ast,
            options,
            assets,
            words: ast.names().map(language::find).collect(),
            report,
            shapes: Shapes::new(options.facets),
            memory: Memory::of(ast),
            asides: Asides::default(),
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
            operation: Operation::Unite,
            children: self.ast.roots(),
            operands: Vec::new(),
            look: Look::default(),
            new_look: false,
            placement: Placement::Moved(Affine::IDENTITY),
            placement_at: SourceRange::default(),
            map: Affine::IDENTITY,
            counts: self.root.is_none(),
            paints: true,
            in_hull: false,
            aside: Aside::No,
            known: None,
        };
        let mut stack = vec![file];
        loop {
            self.depth = self.depth.max(stack.len() - 1);
            let top = stack.last_mut().expect("the frame of the file leaves last");
            if let Some(child) = top.children.next() {
                match self.enter(child, top) {
                    Step::Into(frame) => stack.push(*frame),
                    Step::Done(operand) => top.operands.extend(operand.map(|o| (self.ast.name_at(child), o))),
                }
                continue;
            }
            let frame = stack.pop().expect("it was there just now");
            let node = frame.node;
            let at = node.map_or(SourceRange::default(), |node| self.ast.name_at(node));
            let (aside, known) = (frame.aside, frame.known);
            let operand = self.leave(frame);
            if let (Some(node), Some(known)) = (node, known) {
                self.remember(node, known, &operand);
            }
            let around = stack.last().map_or(Affine::IDENTITY, |parent| parent.map);
            self.asides.take(aside, &operand, &around, self.options.tolerance);
            if node.is_some() && node == self.root {
                self.root_result = operand.clone();
            }
            match stack.last_mut() {
                Some(_) if aside == Aside::Ghost => {}
                Some(parent) => parent.operands.push((at, operand)),
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
            if self.options.ghosts == Ghosts::Hidden || parent.aside == Aside::Ghost {
                return Step::Done(None);
            }
        }
        let is_root = self.root == Some(node);
        let counts = parent.counts || is_root;
        let (mut look, map) = if is_root { (Look::default(), Affine::IDENTITY) } else { (parent.look, parent.map) };
        let aside = if modifiers.contains(Modifiers::BACKGROUND) {
            look = Look::default();
            Aside::Ghost
        } else if modifiers.contains(Modifiers::HIGHLIGHT) && self.options.highlights == Highlights::Drawn {
            Aside::Highlight
        } else {
            Aside::No
        };
        let is_tool = matches!(parent.operation, Operation::Subtract) && !parent.operands.is_empty();
        let is_colorless_tool = is_tool && self.options.cut_color == CutColor::Body;
        let paints = parent.paints && aside != Aside::Ghost && !is_colorless_tool;
        let Some(word) = self.words[self.ast.name_index(node)] else {
            self.unknown(node);
            return Step::Into(Box::new(self.frame(node, Operation::LeaveOut, look, map)));
        };
        let is_tree = counts && self.root.is_none() && paints && !word.kind.is_leaf();
        let remembers = is_tree && self.memory.is_repeated(self.ast, node);
        if remembers && let Some((operand, leaves)) = self.memory.recall(self.ast, node, look) {
            self.leaves += leaves;
            return Step::Done(Some(operand));
        }
        let known = remembers.then(|| Known { look, said: self.report.count(), leaves: self.leaves });
        let in_hull = self.takes_for_hull(parent);
        let args = Args::of(self.ast, node, word, &mut self.report);
        if word.kind.is_leaf() {
            self.refuse_children(node, word);
            let operand = self.leaf(node, word.kind, &args, &map, counts, in_hull);
            if is_root {
                self.root_result = operand.clone().unwrap_or(Operand::Empty);
            }
            let drawn = operand.as_ref().unwrap_or(&Operand::Empty);
            self.asides.take(aside, drawn, &parent.map, self.options.tolerance);
            return Step::Done(operand.filter(|_| aside != Aside::Ghost));
        }
        let operation = Operation::of(word.kind, &args, self.options.facets, &mut self.report);
        let mut frame = Frame { counts, paints, in_hull, aside, known, ..self.frame(node, operation, look, map) };
        match word.kind {
            Kind::Unsupported(needs) => {
                if counts {
                    self.unsupported(node, needs);
                }
                frame.counts = false;
            }
            Kind::Color | Kind::Material if !paints => {}
            Kind::Color => frame.look = look.with_color(&args, &mut self.report),
            Kind::Material => frame.look = look.with_material(&args, &mut self.report),
            _ => {
                frame.placement = placement(word.kind, &args, &mut self.report);
                frame.placement_at = place_of_map(word.kind, &args);
                if let Placement::Moved(own) = frame.placement {
                    frame.map = map * own;
                }
            }
        }
        if counts && matches!(word.kind, Kind::LinearExtrude | Kind::RotateExtrude) && args.names_a_file() {
            let drawing = self.import(&args, false);
            frame.operands.push((args.name_at, drawing));
        }
        frame.new_look = frame.look != look;
        Step::Into(Box::new(frame))
    }

    fn frame(&self, node: NodeId, operation: Operation, look: Look, map: Affine) -> Frame<'a> {
        Frame {
            node: Some(node),
            operation,
            children: self.ast.children(node),
            operands: Vec::new(),
            look,
            new_look: false,
            placement: Placement::Moved(Affine::IDENTITY),
            placement_at: self.ast.name_at(node),
            map,
            counts: false,
            paints: true,
            in_hull: false,
            aside: Aside::No,
            known: None,
        }
    }

    /// Whether a hull takes a child of this node as it is.
    fn takes_for_hull(&self, parent: &Frame<'a>) -> bool {
        let is_only = || parent.node.is_some_and(|node| self.ast.children(node).nth(1).is_none());
        match parent.operation {
            Operation::Hull => true,
            Operation::Unite => parent.in_hull && is_only(),
            _ => false,
        }
    }

    fn leaf(
        &mut self,
        node: NodeId,
        kind: Kind,
        args: &Args<'_>,
        map: &Affine,
        counts: bool,
        in_hull: bool,
    ) -> Option<Operand> {
        if matches!(kind, Kind::Light | Kind::Camera | Kind::Ambient | Kind::Background) {
            self.settings.take(kind, args, map, &mut self.report);
            return None;
        }
        if !counts {
            return Some(Operand::Empty);
        }
        let operand = self.shape_once(node, kind, args, in_hull);
        // A map that flattens is complained about where it is.
        if let Operand::Solid(made) = &operand
            && map.inverse().is_some()
            && !shapes::can_be_placed(&made.solid, map, args.name_at, &mut self.report)
        {
            return Some(Operand::Empty);
        }
        self.leaves += usize::from(operand.dimension().is_some());
        Some(operand)
    }

    /// What a leaf is. What is long in the making, and repeated, is made once; looks and places do not matter to it.
    fn shape_once(&mut self, node: NodeId, kind: Kind, args: &Args<'_>, in_hull: bool) -> Operand {
        let repeats = self.memory.is_repeated(self.ast, node);
        if repeats && let Some((operand, _)) = self.memory.recall(self.ast, node, Look::default()) {
            return operand;
        }
        let known = Known { look: Look::default(), said: self.report.count(), leaves: self.leaves };
        let operand = self.shape(kind, args, in_hull);
        if repeats {
            self.remember(node, known, &operand);
        }
        operand
    }

    /// Keeps in mind what a node became, if there was nothing to say about it.
    fn remember(&mut self, node: NodeId, known: Known, operand: &Operand) {
        if self.report.count() == known.said && !matches!(operand, Operand::Corners(_)) {
            self.memory.remember(self.ast, node, known.look, operand.clone(), self.leaves - known.leaves);
        }
    }

    fn unsupported(&mut self, node: NodeId, needs: &str) {
        let name = self.ast.name(node);
        let at = self.ast.name_at(node);
        let (severity, message) = if self.options.skip_unsupported {
            (Severity::Warning, format!("`{name}` cannot be rendered; it is left out"))
        } else {
            (Severity::Error, format!("`{name}` cannot be rendered"))
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
        let leave_out = self.options.skip_unsupported && self.report.dialect == Dialect::Dump;
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
