//! The syntax tree: what a file says, before any of it is given a meaning.
//!
//! A file may have hundreds of thousands of nodes, millions of numbers and any depth, so the tree lives in a few flat
//! arrays. Nodes are in the order of the file, each knowing where its subtree ends; a vector of numbers is a slice of
//! one array of `f64`, and a vector of such vectors (points, faces, matrices) a slice of rows.

use crate::SourceRange;
use rustc_hash::{FxHashMap, FxHasher};
use std::hash::{Hash, Hasher};

/// A node of the tree: an index in the order of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub(super) u32);

/// OpenSCAD's modifier characters in front of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modifiers(u8);

impl Modifiers {
    /// Each modifier and the character for it.
    pub const ALL: [(Self, u8); 4] =
        [(Self::BACKGROUND, b'%'), (Self::HIGHLIGHT, b'#'), (Self::ROOT, b'!'), (Self::DISABLED, b'*')];
    /// None.
    pub const NONE: Self = Self(0);
    /// `%`: shown by OpenSCAD, but not part of the object.
    pub const BACKGROUND: Self = Self(1);
    /// `#`: shown by OpenSCAD in another colour, and part of the object.
    pub const HIGHLIGHT: Self = Self(2);
    /// `!`: only this subtree counts.
    pub const ROOT: Self = Self(4);
    /// `*`: as if it were not there.
    pub const DISABLED: Self = Self(8);

    /// Whether all of `o` are among these.
    pub fn contains(self, o: Self) -> bool {
        self.0 & o.0 == o.0
    }

    /// These and those.
    pub fn with(self, o: Self) -> Self {
        Self(self.0 | o.0)
    }

    /// The modifier for a character.
    pub fn from_byte(byte: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|(_, b)| *b == byte).map(|(m, _)| m)
    }
}

/// A value as it is stored. [`Ast::view`] shows what is in it.
#[derive(Clone, Copy, Debug)]
pub struct Value(pub(super) Stored);

#[derive(Clone, Copy, Debug)]
pub(super) enum Stored {
    Undef,
    Bool(bool),
    Number(f64),
    Text(Slice),
    Numbers(Slice),
    Rows(Slice),
    List(Slice),
}

/// A part of one of the tree's arrays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slice {
    pub first: u32,
    pub len: u32,
}

impl Slice {
    pub fn of<T>(self, array: &[T]) -> &[T] {
        &array[self.first as usize..(self.first + self.len) as usize]
    }
}

/// What is in a [`Value`].
#[derive(Clone, Copy, Debug)]
pub enum View<'a> {
    /// `undef`.
    Undef,
    /// `true` or `false`.
    Bool(bool),
    /// A number; may be infinite or NaN.
    Number(f64),
    /// A string, with its escapes resolved.
    Text(&'a str),
    /// A vector of nothing but numbers; also the empty vector.
    Numbers(&'a [f64]),
    /// A vector of one or more vectors of numbers.
    Rows(Rows<'a>),
    /// Any other vector.
    List(&'a [Value]),
}

/// A vector of vectors of numbers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rows<'a> {
    rows: &'a [Slice],
    numbers: &'a [f64],
}

impl<'a> Rows<'a> {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Row `i`.
    pub fn get(&self, i: usize) -> Option<&'a [f64]> {
        self.rows.get(i).map(|row| row.of(self.numbers))
    }

    /// One after the other.
    pub fn iter(self) -> impl ExactSizeIterator<Item = &'a [f64]> {
        self.rows.iter().map(move |row| row.of(self.numbers))
    }
}

/// An argument of a node.
#[derive(Clone, Copy, Debug)]
pub struct Arg {
    pub(super) name: Option<u32>,
    /// Where its name is written, or an empty range.
    pub name_at: SourceRange,
    /// What it is.
    pub value: Value,
    /// Where its value is written.
    pub at: SourceRange,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct NodeData {
    pub name: u32,
    pub modifiers: Modifiers,
    pub damaged: bool,
    pub name_at: SourceRange,
    pub at: SourceRange,
    pub args: Slice,
    /// The first node after this one's subtree.
    pub end: u32,
}

/// The syntax tree of a file.
#[derive(Clone, Debug, Default)]
pub struct Ast {
    pub(super) nodes: Vec<NodeData>,
    pub(super) args: Vec<Arg>,
    pub(super) lists: Vec<Value>,
    pub(super) rows: Vec<Slice>,
    pub(super) numbers: Vec<f64>,
    pub(super) texts: String,
    pub(super) names: Names,
    /// Subtrees that were copied, in the order of the copies.
    pub(super) repeats: Vec<Repeat>,
}

/// A subtree that is written once more, letter for letter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Repeat {
    pub original: NodeId,
    pub copy: NodeId,
}

impl Ast {
    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is no node at all.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// All nodes, in the order of the file: each before its children.
    pub fn nodes(&self) -> impl ExactSizeIterator<Item = NodeId> + DoubleEndedIterator + use<> {
        (0..self.nodes.len() as u32).map(NodeId)
    }

    /// The outermost nodes.
    pub fn roots(&self) -> Siblings<'_> {
        Siblings { ast: self, next: 0, end: self.nodes.len() as u32 }
    }

    /// The children of a node.
    pub fn children(&self, node: NodeId) -> Siblings<'_> {
        Siblings { ast: self, next: node.0 + 1, end: self.data(node).end }
    }

    /// Whether `inner` is `outer` or below it.
    pub fn is_within(&self, inner: NodeId, outer: NodeId) -> bool {
        outer.0 <= inner.0 && inner.0 < self.data(outer).end
    }

    /// How many nodes a subtree has, its topmost included.
    pub fn subtree_len(&self, node: NodeId) -> usize {
        (self.data(node).end - node.0) as usize
    }

    /// The names of nodes and arguments, each once.
    pub(crate) fn names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.names.list.iter().map(|name| &**name)
    }

    /// Which of the [`names`](Self::names) the node's is.
    pub(crate) fn name_index(&self, node: NodeId) -> usize {
        self.data(node).name as usize
    }

    /// What the node is called.
    pub fn name(&self, node: NodeId) -> &str {
        self.names.get(self.data(node).name)
    }

    /// Where its name is written.
    pub fn name_at(&self, node: NodeId) -> SourceRange {
        self.data(node).name_at
    }

    /// Where the whole node is written, children included.
    pub fn at(&self, node: NodeId) -> SourceRange {
        self.data(node).at
    }

    /// What stands in front of it.
    pub fn modifiers(&self, node: NodeId) -> Modifiers {
        self.data(node).modifiers
    }

    /// Whether a syntax error was found in its arguments, so that some may be missing here.
    pub fn is_damaged(&self, node: NodeId) -> bool {
        self.data(node).damaged
    }

    /// Its arguments, in the order of the file.
    pub fn args(&self, node: NodeId) -> &[Arg] {
        self.data(node).args.of(&self.args)
    }

    /// What an argument is called, if it is named.
    pub fn arg_name(&self, arg: &Arg) -> Option<&str> {
        arg.name.map(|name| self.names.get(name))
    }

    /// What is in a value.
    pub fn view(&self, value: Value) -> View<'_> {
        match value.0 {
            Stored::Undef => View::Undef,
            Stored::Bool(b) => View::Bool(b),
            Stored::Number(v) => View::Number(v),
            Stored::Text(s) => View::Text(&self.texts[s.first as usize..(s.first + s.len) as usize]),
            Stored::Numbers(s) => View::Numbers(s.of(&self.numbers)),
            Stored::Rows(s) => View::Rows(Rows { rows: s.of(&self.rows), numbers: &self.numbers }),
            Stored::List(s) => View::List(s.of(&self.lists)),
        }
    }

    /// The node's place in the order of the file, from 0.
    pub(crate) fn index(&self, node: NodeId) -> usize {
        node.0 as usize
    }

    /// All nodes, each after its children; of subtrees that are written once more, letter for letter, only the topmost.
    pub(crate) fn bottom_up(&self) -> BottomUp<'_> {
        BottomUp { ast: self, next: 0, open: Vec::new(), repeats: self.repeats.iter() }
    }

    /// A hash of what the subtree says, wherever it is written, given those of the children.
    pub(crate) fn subtree_hash(&self, node: NodeId, hash_of: impl Fn(NodeId) -> u64) -> u64 {
        let mut hasher = FxHasher::default();
        let data = self.data(node);
        (data.name, data.modifiers.0, data.args.len).hash(&mut hasher);
        for arg in self.args(node) {
            arg.name.hash(&mut hasher);
            self.hash_value(arg.value, &mut hasher);
        }
        for child in self.children(node) {
            hash_of(child).hash(&mut hasher);
        }
        hasher.finish()
    }

    fn hash_value(&self, value: Value, hasher: &mut FxHasher) {
        let mut pending = vec![value];
        while let Some(value) = pending.pop() {
            let numbers = |numbers: &[f64], hasher: &mut FxHasher| {
                numbers.len().hash(hasher);
                numbers.iter().for_each(|number| number.to_bits().hash(hasher));
            };
            match self.view(value) {
                View::Undef => 0_u8.hash(hasher),
                View::Bool(b) => b.hash(hasher),
                View::Number(v) => v.to_bits().hash(hasher),
                View::Text(text) => text.hash(hasher),
                View::Numbers(list) => numbers(list, hasher),
                View::Rows(rows) => rows.iter().for_each(|row| numbers(row, hasher)),
                View::List(items) => {
                    items.len().hash(hasher);
                    pending.extend(items);
                }
            }
        }
    }

    /// The subtree that this one is a copy of, or itself.
    fn original(&self, node: NodeId) -> NodeId {
        let repeat = self.repeats.binary_search_by_key(&node, |repeat| repeat.copy);
        repeat.map_or(node, |i| self.repeats[i].original)
    }

    /// Whether two subtrees say the same.
    pub(crate) fn same_subtree(&self, a: NodeId, b: NodeId) -> bool {
        let [a, b] = [a, b].map(|node| self.original(node));
        if a == b {
            return true;
        }
        let len = self.subtree_len(a) as u32;
        let same_length = len == self.subtree_len(b) as u32;
        same_length && (0..len).all(|i| self.same_node(NodeId(a.0 + i), self, NodeId(b.0 + i), (a.0, b.0)))
    }

    fn data(&self, node: NodeId) -> &NodeData {
        &self.nodes[node.0 as usize]
    }

    /// Whether both say the same, wherever it is written. Numbers are compared by their bits, so NaN equals itself and
    /// -0 is not 0.
    pub fn same_tree(&self, o: &Self) -> bool {
        self.len() == o.len() && self.nodes().zip(o.nodes()).all(|(a, b)| self.same_node(a, o, b, (0, 0)))
    }

    /// Whether two nodes say the same, below the `tops` of their subtrees: without what their children say.
    fn same_node(&self, a: NodeId, o: &Self, b: NodeId, tops: (u32, u32)) -> bool {
        let (x, y) = (self.data(a), o.data(b));
        self.name(a) == o.name(b)
            && x.modifiers == y.modifiers
            && x.end - tops.0 == y.end - tops.1
            && x.args.len == y.args.len
            && self
                .args(a)
                .iter()
                .zip(o.args(b))
                .all(|(p, q)| self.arg_name(p) == o.arg_name(q) && self.same_value(p.value, o, q.value))
    }

    fn same_value(&self, a: Value, o: &Self, b: Value) -> bool {
        let bits = |x: &[f64], y: &[f64]| x.len() == y.len() && x.iter().zip(y).all(|(p, q)| same_number(*p, *q));
        let mut pending = vec![(a, b)];
        while let Some((a, b)) = pending.pop() {
            let same = match (self.view(a), o.view(b)) {
                (View::Undef, View::Undef) => true,
                (View::Bool(x), View::Bool(y)) => x == y,
                (View::Number(x), View::Number(y)) => same_number(x, y),
                (View::Text(x), View::Text(y)) => x == y,
                (View::Numbers(x), View::Numbers(y)) => bits(x, y),
                (View::Rows(x), View::Rows(y)) => x.len() == y.len() && x.iter().zip(y.iter()).all(|(x, y)| bits(x, y)),
                (View::List(x), View::List(y)) => {
                    pending.extend(x.iter().copied().zip(y.iter().copied()));
                    x.len() == y.len()
                }
                _ => false,
            };
            if !same {
                return false;
            }
        }
        true
    }
}

fn same_number(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// Nodes side by side, in the order of the file.
#[derive(Clone, Debug)]
pub struct Siblings<'a> {
    ast: &'a Ast,
    next: u32,
    end: u32,
}

impl Iterator for Siblings<'_> {
    type Item = NodeId;
    fn next(&mut self) -> Option<NodeId> {
        (self.next < self.end).then(|| {
            let node = NodeId(self.next);
            self.next = self.ast.data(node).end;
            node
        })
    }
}

/// A step through all nodes, children first.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    /// A node whose children are behind.
    Node(NodeId),
    /// A subtree that says what another one says, which is behind. It has as many nodes.
    Copy {
        /// The other one.
        of: NodeId,
        /// This one.
        top: NodeId,
    },
}

/// See [`Ast::bottom_up`].
#[derive(Clone, Debug)]
pub(crate) struct BottomUp<'a> {
    ast: &'a Ast,
    next: u32,
    open: Vec<NodeId>,
    repeats: std::slice::Iter<'a, Repeat>,
}

impl Iterator for BottomUp<'_> {
    type Item = Step;
    fn next(&mut self) -> Option<Step> {
        loop {
            if self.open.last().is_some_and(|&node| self.ast.data(node).end == self.next) {
                return self.open.pop().map(Step::Node);
            }
            let node = NodeId(self.next);
            if self.next as usize == self.ast.len() {
                return None;
            }
            if let Some(&Repeat { original, copy }) = self.repeats.as_slice().first()
                && copy == node
            {
                self.repeats.next();
                self.next = self.ast.data(node).end;
                return Some(Step::Copy { of: original, top: copy });
            }
            self.open.push(node);
            self.next += 1;
        }
    }
}

/// Names of nodes and arguments, each stored once.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    list: Vec<Box<str>>,
    index: FxHashMap<Box<str>, u32>,
}

impl Names {
    pub fn intern(&mut self, name: &str) -> u32 {
        if let Some(&id) = self.index.get(name) {
            return id;
        }
        let id = self.list.len() as u32;
        self.list.push(name.into());
        self.index.insert(name.into(), id);
        id
    }

    pub fn get(&self, id: u32) -> &str {
        &self.list[id as usize]
    }
}
