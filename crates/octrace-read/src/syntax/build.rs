//! Builds an [`Ast`] from the order of a file: open a node, give it arguments, fill it, close it.

use super::ast::{Arg, Ast, Modifiers, NodeData, NodeId, Repeat, Slice, Stored, Value};
use crate::SourceRange;

/// Builds an [`Ast`]. The parser drives it; so may anyone who wants to write a file.
///
/// ```
/// use octrace_read::syntax::{AstBuilder, Modifiers, print};
/// let mut b = AstBuilder::new();
/// b.open_node("union", Modifiers::NONE);
/// b.open_node("cube", Modifiers::NONE);
/// b.open_vector();
/// [1.0, 2.0, 3.0].map(|v| b.number(v));
/// b.close_vector();
/// b.finish_arg(Some("size"));
/// assert_eq!(print(&b.finish()), "union() {\n\tcube(size = [1, 2, 3]);\n}\n");
/// ```
#[derive(Debug, Default)]
pub struct AstBuilder {
    ast: Ast,
    open: Vec<NodeId>,
    vectors: Vec<Vector>,
    /// Items of the open vectors of kind `List`, innermost last.
    items: Vec<Value>,
    /// A complete value that no argument has taken yet.
    complete: Option<Value>,
}

/// A vector whose closing bracket is still to come.
#[derive(Clone, Copy, Debug)]
struct Vector {
    kind: VectorKind,
    first: u32,
    len: u32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum VectorKind {
    /// So far all are numbers, or there is none; they are at the end of the tree's numbers.
    Numbers,
    /// So far all are vectors of numbers; they are at the end of the tree's rows.
    Rows,
    /// Anything; at the end of `items`.
    List,
}

impl AstBuilder {
    /// Starts with an empty tree.
    pub fn new() -> Self {
        Self::default()
    }

    /// Starts a node, as a child of the innermost open one.
    pub fn open_node(&mut self, name: &str, modifiers: Modifiers) -> NodeId {
        let none = SourceRange::default();
        self.open_node_at(name, modifiers, none, none)
    }

    pub(super) fn open_node_at(
        &mut self,
        name: &str,
        modifiers: Modifiers,
        name_at: SourceRange,
        at: SourceRange,
    ) -> NodeId {
        let id = NodeId(self.ast.nodes.len() as u32);
        let name = self.ast.names.intern(name);
        let args = Slice { first: self.ast.args.len() as u32, len: 0 };
        self.ast.nodes.push(NodeData { name, modifiers, damaged: false, name_at, at, args, end: id.0 + 1 });
        self.open.push(id);
        id
    }

    /// Ends the innermost open node. Does nothing where none is open.
    pub fn close_node(&mut self) {
        if let Some(id) = self.open.pop() {
            let end = self.ast.nodes.len() as u32;
            self.ast.nodes[id.0 as usize].end = end;
        }
    }

    /// Adds a copy of a closed subtree, which is written once more from `start` on.
    pub(super) fn repeat(&mut self, original: NodeId, start: u32) {
        let Ast { nodes, args, repeats, .. } = &mut self.ast;
        let copy = NodeId(nodes.len() as u32);
        let NodeData { at, args: Slice { first: first_arg, .. }, end, .. } = nodes[original.0 as usize];
        let shift = start - at.start;
        let moved = |at: SourceRange| SourceRange::new(at.start + shift, at.end + shift);
        nodes.extend_from_within(original.0 as usize..end as usize);
        // The arguments of a subtree are side by side.
        let arg_shift = args.len() as u32 - first_arg;
        let mut last_arg = first_arg;
        for node in &mut nodes[copy.0 as usize..] {
            last_arg += node.args.len;
            (node.name_at, node.at) = (moved(node.name_at), moved(node.at));
            node.args.first += arg_shift;
            node.end += copy.0 - original.0;
        }
        args.extend_from_within(first_arg as usize..last_arg as usize);
        for arg in &mut args[(first_arg + arg_shift) as usize..] {
            (arg.name_at, arg.at) = (moved(arg.name_at), moved(arg.at));
        }
        repeats.push(Repeat { original, copy });
    }

    /// Says where a node ends in the file.
    pub(super) fn end_at(&mut self, node: NodeId, end: u32) {
        self.ast.nodes[node.0 as usize].at.end = end;
    }

    /// Says that something is wrong with a node's arguments.
    pub(super) fn mark_damaged(&mut self, node: NodeId) {
        self.ast.nodes[node.0 as usize].damaged = true;
    }

    /// A number: the value, or an item of the open vector.
    pub fn number(&mut self, v: f64) {
        match self.vectors.last_mut() {
            Some(vector) if vector.kind == VectorKind::Numbers => {
                vector.len += 1;
                self.ast.numbers.push(v);
            }
            _ => self.add(Value(Stored::Number(v))),
        }
    }

    /// `undef`.
    pub fn undef(&mut self) {
        self.add(Value(Stored::Undef));
    }

    /// `true` or `false`.
    pub fn bool(&mut self, b: bool) {
        self.add(Value(Stored::Bool(b)));
    }

    /// A string.
    pub fn text(&mut self, text: &str) {
        let slice = Slice { first: self.ast.texts.len() as u32, len: text.len() as u32 };
        self.ast.texts.push_str(text);
        self.add(Value(Stored::Text(slice)));
    }

    /// Starts a vector.
    pub fn open_vector(&mut self) {
        if self.vectors.last().is_some_and(|outer| outer.kind == VectorKind::Numbers && outer.len > 0) {
            self.turn_into_list();
        }
        self.vectors.push(Vector { kind: VectorKind::Numbers, first: self.ast.numbers.len() as u32, len: 0 });
    }

    /// Ends the innermost open vector. Does nothing where none is open.
    pub fn close_vector(&mut self) {
        let Some(Vector { kind, first, len }) = self.vectors.pop() else { return };
        let slice = Slice { first, len };
        let stored = match kind {
            VectorKind::Numbers => Stored::Numbers(slice),
            VectorKind::Rows => Stored::Rows(slice),
            VectorKind::List => {
                let first_in_tree = self.ast.lists.len() as u32;
                self.ast.lists.extend(self.items.drain(first as usize..));
                Stored::List(Slice { first: first_in_tree, len })
            }
        };
        self.add(Value(stored));
    }

    /// How many vectors are open.
    pub fn open_vectors(&self) -> usize {
        self.vectors.len()
    }

    /// Gives the complete value to the innermost open node; closes vectors that are still open. Does nothing where there
    /// is no value, no node, or the node has children already.
    pub fn finish_arg(&mut self, name: Option<&str>) {
        let none = SourceRange::default();
        self.finish_arg_at(name, none, none);
    }

    pub(super) fn finish_arg_at(&mut self, name: Option<&str>, name_at: SourceRange, at: SourceRange) {
        while self.open_vectors() > 0 {
            self.close_vector();
        }
        let (Some(value), Some(node)) = (self.complete.take(), self.open.last()) else { return };
        let args = self.ast.nodes[node.0 as usize].args;
        if args.first as usize + args.len as usize != self.ast.args.len() {
            return;
        }
        let name = name.map(|name| self.ast.names.intern(name));
        self.ast.args.push(Arg { name, name_at, value, at });
        self.ast.nodes[node.0 as usize].args.len += 1;
    }

    /// Forgets a value that is not complete or that no argument took.
    pub(super) fn discard_value(&mut self) {
        self.vectors.clear();
        self.items.clear();
        self.complete = None;
    }

    /// The tree; nodes that are still open end here.
    pub fn finish(mut self) -> Ast {
        while !self.open.is_empty() {
            self.close_node();
        }
        self.ast
    }

    /// Adds a value to the open vector, or completes the value.
    fn add(&mut self, value: Value) {
        let Some(vector) = self.vectors.last_mut() else {
            self.complete = Some(value);
            return;
        };
        if let Stored::Numbers(row) = value.0 {
            if vector.kind == VectorKind::Numbers && vector.len == 0 {
                *vector = Vector { kind: VectorKind::Rows, first: self.ast.rows.len() as u32, len: 0 };
            }
            if vector.kind == VectorKind::Rows {
                vector.len += 1;
                self.ast.rows.push(row);
                return;
            }
        }
        self.turn_into_list();
        if let Some(vector) = self.vectors.last_mut() {
            vector.len += 1;
            self.items.push(value);
        }
    }

    /// Makes the innermost open vector one that holds anything.
    fn turn_into_list(&mut self) {
        let Some(vector) = self.vectors.last_mut() else { return };
        let (from, to) = (vector.first as usize, (vector.first + vector.len) as usize);
        let first = self.items.len() as u32;
        match vector.kind {
            VectorKind::List => return,
            VectorKind::Numbers => {
                self.items.extend(self.ast.numbers.drain(from..to).map(|v| Value(Stored::Number(v))));
            }
            VectorKind::Rows => {
                self.items.extend(self.ast.rows[from..to].iter().map(|&row| Value(Stored::Numbers(row))));
            }
        }
        *vector = Vector { kind: VectorKind::List, first, ..*vector };
    }
}
