//! The words of the language: every node, its arguments and their types, and what is still to come.

use crate::syntax::{Ast, Value, View};

/// A kind of node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Block,
    Cube,
    Sphere,
    Cylinder,
    HalfSpace,
    Torus,
    Polyhedron,
    /// Unites its children and does nothing else.
    Group,
    Difference,
    Intersection,
    Multmatrix,
    Translate,
    Rotate,
    Scale,
    Mirror,
    Color,
    Material,
    Light,
    Camera,
    Ambient,
    Background,
    /// Known, but not rendered yet; what would be needed.
    Unsupported(&'static str),
}

impl Kind {
    /// Whether it is a leaf: takes no children.
    pub fn is_leaf(self) -> bool {
        use Kind::{Ambient, Background, Block, Camera, Cube, Cylinder, HalfSpace, Light, Polyhedron, Sphere, Torus};
        matches!(
            self,
            Block | Cube | Sphere | Cylinder | HalfSpace | Torus | Polyhedron | Light | Camera | Ambient | Background
        )
    }
}

/// A word of the language.
#[derive(Debug)]
pub(super) struct Word {
    pub name: &'static str,
    pub kind: Kind,
    /// In the order in which unnamed arguments are taken.
    pub params: &'static [Param],
}

/// An argument that a node takes: its name and type.
pub(super) type Param = (&'static str, Type);

/// What a value may be. `undef` always may: it means that the argument is not given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Type {
    Number,
    Flag,
    Text,
    /// So many numbers, from and to.
    Numbers(usize, usize),
    /// A number, or so many, from and to.
    Scale(usize, usize),
    /// A vector of points, each of so many numbers.
    Points(usize),
    /// A vector of vectors of numbers.
    Lists,
    /// Three or four rows of three or four numbers.
    Matrix,
    /// A name, `#rrggbb`, or three or four numbers.
    Color,
    /// A number, or a colour.
    Brightness,
    Any,
}

use Type::{Any, Brightness, Flag, Lists, Matrix, Number, Numbers, Points, Text};

const FN: Param = ("$fn", Number);
const FA: Param = ("$fa", Number);
const FS: Param = ("$fs", Number);
const CENTER: Param = ("center", Flag);
const CONVEXITY: Param = ("convexity", Number);

const fn word(name: &'static str, kind: Kind, params: &'static [Param]) -> Word {
    Word { name, kind, params }
}

const fn later(name: &'static str, needs: &'static str, params: &'static [Param]) -> Word {
    Word { name, kind: Kind::Unsupported(needs), params }
}

const NEEDS_2D: &str = "a flat shape has no volume; it will count once extrusions are rendered";
const NEEDS_EXTRUSION: &str = "needs solids over flat outlines, which octrace does not have yet";
const NEEDS_HULL: &str = "needs convex hulls, which octrace does not have yet";
const NEEDS_MESH: &str = "needs a reader for the file that it names, which octrace does not have yet";

/// Every word there is.
pub(super) const WORDS: &[Word] = &[
    word("block", Kind::Block, &[]),
    word("cube", Kind::Cube, &[("size", Type::Scale(3, 3)), CENTER]),
    word("sphere", Kind::Sphere, &[("r", Number), ("d", Number), ("style", Text), FN, FA, FS]),
    word(
        "cylinder",
        Kind::Cylinder,
        &[
            ("h", Number),
            ("r1", Number),
            ("r2", Number),
            CENTER,
            ("r", Number),
            ("d", Number),
            ("d1", Number),
            ("d2", Number),
            FN,
            FA,
            FS,
        ],
    ),
    word("halfspace", Kind::HalfSpace, &[]),
    word("torus", Kind::Torus, &[("major", Number), ("minor", Number)]),
    word("polyhedron", Kind::Polyhedron, &[("points", Points(3)), ("faces", Lists), CONVEXITY, ("triangles", Lists)]),
    word("union", Kind::Group, &[]),
    word("group", Kind::Group, &[]),
    word("render", Kind::Group, &[CONVEXITY]),
    word("difference", Kind::Difference, &[]),
    word("intersection", Kind::Intersection, &[]),
    word("multmatrix", Kind::Multmatrix, &[("m", Matrix)]),
    word("translate", Kind::Translate, &[("v", Numbers(1, 3))]),
    word("rotate", Kind::Rotate, &[("a", Type::Scale(1, 3)), ("v", Numbers(2, 3))]),
    word("scale", Kind::Scale, &[("v", Type::Scale(1, 3))]),
    word("mirror", Kind::Mirror, &[("v", Numbers(1, 3))]),
    word("color", Kind::Color, &[("c", Type::Color), ("alpha", Number)]),
    word(
        "material",
        Kind::Material,
        &[
            ("preset", Text),
            ("color", Type::Color),
            ("ka", Number),
            ("kd", Number),
            ("ks", Number),
            ("shininess", Number),
            ("kr", Number),
            ("kt", Number),
            ("ior", Number),
            ("tint", Number),
        ],
    ),
    word(
        "light",
        Kind::Light,
        &[("position", Numbers(3, 3)), ("direction", Numbers(3, 3)), ("color", Type::Color), ("intensity", Number)],
    ),
    word(
        "camera",
        Kind::Camera,
        &[
            ("view", Numbers(6, 7)),
            ("eye", Numbers(3, 3)),
            ("at", Numbers(3, 3)),
            ("up", Numbers(3, 3)),
            ("fov", Number),
            ("projection", Text),
            ("height", Number),
            ("from", Numbers(3, 3)),
            ("look_at", Numbers(3, 3)),
        ],
    ),
    word("ambient", Kind::Ambient, &[("color", Brightness), ("intensity", Number)]),
    word("background", Kind::Background, &[("color", Brightness)]),
    later("square", NEEDS_2D, &[("size", Type::Scale(2, 2)), CENTER]),
    later("circle", NEEDS_2D, &[("r", Number), ("d", Number), FN, FA, FS]),
    later("polygon", NEEDS_2D, &[("points", Points(2)), ("paths", Lists), CONVEXITY, FN, FA, FS]),
    later(
        "text",
        NEEDS_2D,
        &[
            ("text", Text),
            ("size", Number),
            ("font", Text),
            ("halign", Text),
            ("valign", Text),
            ("spacing", Number),
            ("direction", Text),
            ("language", Text),
            ("script", Text),
            FN,
            FA,
            FS,
        ],
    ),
    later("offset", NEEDS_2D, &[("r", Number), ("delta", Number), ("chamfer", Flag), FN, FA, FS]),
    later("fill", NEEDS_2D, &[]),
    later("projection", NEEDS_2D, &[("cut", Flag), CONVEXITY]),
    later(
        "linear_extrude",
        NEEDS_EXTRUSION,
        &[
            ("height", Number),
            ("v", Numbers(3, 3)),
            CENTER,
            CONVEXITY,
            ("twist", Number),
            ("slices", Number),
            ("segments", Number),
            ("scale", Type::Scale(2, 2)),
            FN,
            FA,
            FS,
        ],
    ),
    later("rotate_extrude", NEEDS_EXTRUSION, &[("angle", Number), ("start", Number), CONVEXITY, FN, FA, FS]),
    later("roof", NEEDS_EXTRUSION, &[("method", Text), CONVEXITY, FN, FA, FS]),
    later("hull", NEEDS_HULL, &[]),
    later("minkowski", "needs Minkowski sums, which octrace does not have yet", &[CONVEXITY]),
    later(
        "resize",
        "needs the exact extent of its children, which octrace does not know when reading",
        &[("newsize", Numbers(1, 3)), ("auto", Any), CONVEXITY],
    ),
    later(
        "import",
        NEEDS_MESH,
        &[
            ("file", Text),
            ("convexity", Number),
            ("layer", Any),
            ("id", Any),
            ("origin", Numbers(2, 2)),
            ("scale", Type::Scale(2, 3)),
            CENTER,
            ("dpi", Number),
            ("timestamp", Number),
            FN,
            FA,
            FS,
        ],
    ),
    later("surface", NEEDS_MESH, &[("file", Text), CENTER, CONVEXITY, ("invert", Flag), ("timestamp", Number)]),
];

/// The word with this name.
pub(super) fn find(name: &str) -> Option<&'static Word> {
    WORDS.iter().find(|w| w.name == name)
}

/// Of some words, the one that a misspelt one was probably meant to be.
pub(super) fn nearest<'w>(name: &str, words: impl Iterator<Item = &'w str>) -> Option<&'w str> {
    let distance = |w: &str| strsim::osa_distance(&name.to_ascii_lowercase(), w);
    let near = words.map(|w| (distance(w), w)).min_by_key(|(d, _)| *d);
    near.filter(|(d, w)| *d <= w.len().max(name.len()) / 3).map(|(_, w)| w)
}

impl Type {
    /// What it may be, in words.
    pub fn expected(self) -> String {
        let times = |n: usize| ["", "a number", "two numbers", "three numbers"].get(n).copied().unwrap_or("numbers");
        match self {
            Self::Number => "a number".to_owned(),
            Self::Flag => "`true` or `false`".to_owned(),
            Self::Text => "a text in quotes".to_owned(),
            Self::Numbers(from, to) if from == to => format!("a vector of {}", times(from)),
            Self::Numbers(from, to) => format!("a vector of {from} to {to} numbers"),
            Self::Scale(from, to) if from == to => format!("a number or a vector of {}", times(from)),
            Self::Scale(from, to) => format!("a number or a vector of {from} to {to} numbers"),
            Self::Points(n) => format!("a vector of points of {}", times(n)),
            Self::Lists => "a vector of vectors of numbers".to_owned(),
            Self::Matrix => "a vector of three or four rows of four numbers".to_owned(),
            Self::Color => "a colour: a name, \"#rrggbb\" or [r, g, b]".to_owned(),
            Self::Brightness => "a number, or a colour: a name, \"#rrggbb\" or [r, g, b]".to_owned(),
            Self::Any => "anything".to_owned(),
        }
    }

    /// Whether a value is one of these; if not, the way to the first element that is wrong.
    pub fn check(self, ast: &Ast, value: Value) -> Result<(), Vec<usize>> {
        let all = |ok: bool| if ok { Ok(()) } else { Err(Vec::new()) };
        let view = ast.view(value);
        match (self, view) {
            (_, View::Undef) | (Self::Any, _) => Ok(()),
            (Self::Number, _) => all(matches!(view, View::Number(_))),
            (Self::Flag, _) => all(matches!(view, View::Bool(_) | View::Number(_))),
            (Self::Text, _) => all(matches!(view, View::Text(_))),
            (Self::Numbers(from, to) | Self::Scale(from, to), View::Numbers(n)) => all((from..=to).contains(&n.len())),
            (Self::Scale(..) | Self::Brightness, View::Number(_)) => Ok(()),
            (Self::Color | Self::Brightness, View::Numbers(n)) => all((3..=4).contains(&n.len())),
            (Self::Color | Self::Brightness, View::Text(_)) => Ok(()),
            (Self::Points(_) | Self::Lists, View::Numbers([])) => Ok(()),
            (Self::Points(n), View::Rows(rows)) => first_bad(rows.iter(), |row| row.len() == n),
            (Self::Lists, View::Rows(_)) => Ok(()),
            (Self::Matrix, View::Rows(rows)) if (3..=4).contains(&rows.len()) => {
                first_bad(rows.iter(), |row| (3..=4).contains(&row.len()))
            }
            (Self::Points(_) | Self::Lists | Self::Matrix, View::List(items)) => self.check_items(ast, items),
            _ => Err(Vec::new()),
        }
    }

    fn check_items(self, ast: &Ast, items: &[Value]) -> Result<(), Vec<usize>> {
        let length = |row: &[f64]| match self {
            Self::Points(n) => row.len() == n,
            _ => true,
        };
        let row = items.iter().position(|&item| !matches!(ast.view(item), View::Numbers(row) if length(row)));
        let Some(row) = row else { return Err(Vec::new()) };
        match ast.view(items[row]) {
            View::List(inner) => {
                let not_a_number = |&item: &Value| !matches!(ast.view(item), View::Number(_));
                Err(inner.iter().position(not_a_number).map_or_else(|| vec![row], |column| vec![row, column]))
            }
            _ => Err(vec![row]),
        }
    }
}

fn first_bad<'r>(rows: impl Iterator<Item = &'r [f64]>, good: impl Fn(&[f64]) -> bool) -> Result<(), Vec<usize>> {
    rows.enumerate().find(|(_, row)| !good(row)).map_or(Ok(()), |(i, _)| Err(vec![i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique() {
        for (i, w) in WORDS.iter().enumerate() {
            assert!(WORDS[..i].iter().all(|v| v.name != w.name), "{}", w.name);
        }
    }

    #[test]
    fn misspellings_are_understood_and_other_words_are_not() {
        let names = || WORDS.iter().map(|w| w.name);
        assert_eq!(nearest("sphear", names()), Some("sphere"));
        assert_eq!(nearest("Cube", names()), Some("cube"));
        assert_eq!(nearest("half_space", names()), Some("halfspace"));
        assert_eq!(nearest("colour", names()), Some("color"));
        assert_eq!(nearest("teapot", names()), None);
    }
}
