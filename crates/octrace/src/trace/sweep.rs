//! Changes of a long or nested program along a ray, by sweeping: the crossings of its literals are sorted once, and each
//! passes up the tree as far as it changes anything. That takes about as long as the sorting, whatever the program, where
//! asking for one change after another ([`super::roots`]) may begin anew each time.

use super::roots::Roots;
use crate::compile::Word;

/// A program on its way along one stretch of a ray; scratch memory of a worker.
#[derive(Debug, Default)]
pub(crate) struct Sweep {
    /// For every word of the program.
    nodes: Vec<Node>,
    /// Operators that are open while the words are read: each with the word behind it.
    open: Vec<(u32, usize)>,
    /// The crossings in the stretch, ascending.
    events: Vec<Event>,
    /// How many of them are behind.
    passed: usize,
    /// Nodes that changed at the present parameter, and what they were before.
    changed: Vec<(u32, bool)>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    parent: u32,
    /// So many children are inside; a literal counts itself.
    inside: u32,
    /// With so many it is inside.
    needed: u32,
    /// Whether it is among the changed.
    noted: bool,
}

impl Node {
    fn is_inside(&self) -> bool {
        self.inside >= self.needed
    }
}

#[derive(Clone, Copy, Debug)]
struct Event {
    t: f64,
    /// The literal's place in the program.
    at: u32,
}

/// The parent of the program's first word.
const NONE: u32 = u32::MAX;

impl Sweep {
    /// Begins just before `t_in`, with the crossings up to `t_out` to pass. `roots` are those of the program's literals.
    pub fn begin(&mut self, words: &[u32], roots: &Roots, t_in: f64, t_out: f64) {
        self.nodes.clear();
        self.open.clear();
        self.events.clear();
        self.passed = 0;
        for (at, &word) in words.iter().enumerate() {
            while self.open.last().is_some_and(|&(_, end)| end <= at) {
                self.open.pop();
            }
            let parent = self.open.last().map_or(NONE, |&(parent, _)| parent);
            let mut node = Node { parent, inside: 0, needed: 1, noted: false };
            match Word::decode(word) {
                Word::Literal { .. } => {
                    let sides = roots.sides(at);
                    node.inside = u32::from(sides.before(t_in));
                    let in_stretch = sides.params.iter().filter(|&&t| t_in <= t && t <= t_out);
                    self.events.extend(in_stretch.map(|&t| Event { t, at: at as u32 }));
                }
                Word::And { len } => {
                    node.needed = 0;
                    self.open.push((at as u32, at + 1 + len as usize));
                }
                Word::Or { len } => self.open.push((at as u32, at + 1 + len as usize)),
            }
            self.nodes.push(node);
        }
        // Children come after their parents.
        for at in (1..words.len()).rev() {
            let Node { parent, .. } = self.nodes[at];
            let inside = u32::from(self.nodes[at].is_inside());
            let all_needed = matches!(Word::decode(words[parent as usize]), Word::And { .. });
            let parent = &mut self.nodes[parent as usize];
            parent.inside += inside;
            parent.needed += u32::from(all_needed);
        }
        self.events.sort_unstable_by(|a, b| a.t.total_cmp(&b.t));
    }

    /// Whether the program is inside just behind the crossings that were passed.
    pub fn is_inside(&self) -> bool {
        self.nodes[0].is_inside()
    }

    /// The parameter of the next crossing of any literal in the stretch.
    pub fn next_t(&self) -> Option<f64> {
        self.events.get(self.passed).map(|event| event.t)
    }

    /// Passes all crossings at the next parameter. Where that changes the program: the place of the literal that is seen to
    /// change it, from the root down the first child that changes as its parent does.
    pub fn pass(&mut self) -> Option<usize> {
        let t = self.next_t()?;
        let before = self.is_inside();
        while let Some(&Event { at, .. }) = self.events.get(self.passed).filter(|event| event.t == t) {
            self.passed += 1;
            self.toggle(at);
        }
        let after = self.is_inside();
        let mut seen = NONE;
        if before != after {
            // In the order of the program a node's descendants follow it, and then its next sibling: so the first that
            // fits below the last one that did is the first child that fits.
            self.changed.sort_unstable();
            for &(at, was_inside) in &self.changed {
                let node = self.nodes[at as usize];
                if node.parent == seen && was_inside == before && node.is_inside() == after {
                    seen = at;
                }
            }
        }
        for (at, _) in self.changed.drain(..) {
            self.nodes[at as usize].noted = false;
        }
        (before != after).then_some(seen as usize)
    }

    /// Turns a literal over, and what depends on it.
    fn toggle(&mut self, literal: u32) {
        let mut at = literal;
        let mut rises = !self.nodes[at as usize].is_inside();
        while at != NONE {
            let node = &mut self.nodes[at as usize];
            let was_inside = node.is_inside();
            if rises {
                node.inside += 1;
            } else {
                node.inside -= 1;
            }
            if node.is_inside() == was_inside {
                return;
            }
            if !node.noted {
                node.noted = true;
                self.changed.push((at, was_inside));
            }
            rises = !was_inside;
            at = node.parent;
        }
    }
}
