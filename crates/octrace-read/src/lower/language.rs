//! The words of the language: every node, its arguments and their types, and what is still to come.

use super::types::Type;
use super::types::Type::{Any, Brightness, Corners, Flag, Lists, Matrix, Number, Numbers, Points, Text};

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
    Square,
    Circle,
    Polygon,
    Text,
    Import,
    Surface,
    /// Unites its children and does nothing else.
    Group,
    Difference,
    Intersection,
    LinearExtrude,
    RotateExtrude,
    Offset,
    Fill,
    Hull,
    Minkowski,
    Resize,
    Projection,
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
        use Kind::{Ambient, Background, Camera, Light};
        use Kind::{Block, Circle, Cube, Cylinder, HalfSpace, Import, Polygon, Polyhedron, Sphere, Square, Surface};
        let is_solid = matches!(self, Block | Cube | Sphere | Cylinder | HalfSpace | Self::Torus | Polyhedron);
        let is_setting = matches!(self, Light | Camera | Ambient | Background);
        is_solid || is_setting || matches!(self, Square | Circle | Polygon | Self::Text | Import | Surface)
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
    word("polyhedron", Kind::Polyhedron, &[("points", Corners), ("faces", Lists), CONVEXITY, ("triangles", Lists)]),
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
    word("square", Kind::Square, &[("size", Type::Scale(2, 2)), CENTER]),
    word("circle", Kind::Circle, &[("r", Number), ("d", Number), FN, FA, FS]),
    word("polygon", Kind::Polygon, &[("points", Points), ("paths", Lists), CONVEXITY, FN, FA, FS]),
    word(
        "text",
        Kind::Text,
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
    word("offset", Kind::Offset, &[("r", Number), ("delta", Number), ("chamfer", Flag), FN, FA, FS]),
    word("fill", Kind::Fill, &[]),
    word("projection", Kind::Projection, &[("cut", Flag), CONVEXITY]),
    word(
        "linear_extrude",
        Kind::LinearExtrude,
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
            ("file", Text),
            ("layer", Any),
            ("origin", Numbers(2, 2)),
            ("timestamp", Number),
        ],
    ),
    word(
        "rotate_extrude",
        Kind::RotateExtrude,
        &[
            ("angle", Number),
            ("start", Number),
            CONVEXITY,
            FN,
            FA,
            FS,
            ("file", Text),
            ("layer", Any),
            ("origin", Numbers(2, 2)),
            ("scale", Number),
            ("timestamp", Number),
        ],
    ),
    later(
        "roof",
        "roofs over flat shapes are not made here, nor by releases of OpenSCAD",
        &[("method", Text), CONVEXITY, FN, FA, FS],
    ),
    word("hull", Kind::Hull, &[]),
    word("minkowski", Kind::Minkowski, &[CONVEXITY]),
    word("resize", Kind::Resize, &[("newsize", Numbers(1, 3)), ("auto", Any), CONVEXITY]),
    word(
        "import",
        Kind::Import,
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
    word("surface", Kind::Surface, &[("file", Text), CENTER, CONVEXITY, ("invert", Flag), ("timestamp", Number)]),
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
