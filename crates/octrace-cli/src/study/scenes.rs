//! What is measured: families of solids that grow, or the user's own.

use octrace::model::{Node, families};
use octrace::{Camera, Scene, Solid};

/// What a family of scenes grows in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// A block minus more and more balls.
    Balls,
    /// More and more copies of one solid.
    Copies,
    /// A deeper and deeper tree.
    Chain,
}

impl Family {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Balls, Self::Copies, Self::Chain];

    /// Name, and what the scenes' names begin with.
    pub fn name(self) -> &'static str {
        match self {
            Self::Balls => "balls",
            Self::Copies => "copies",
            Self::Chain => "chain",
        }
    }
}

/// One scene to measure.
#[derive(Clone, Debug)]
pub struct StudyScene {
    /// A short name, or the file's.
    pub name: String,
    /// What it is, in a few words.
    pub description: String,
    /// The family that it belongs to.
    pub family: Option<Family>,
    /// Whether all settings are tried on it, and not only the default ones.
    pub sweep: bool,
    /// Boolean operations on top of one another.
    pub tree_depth: usize,
    /// What is traced.
    pub bodies: Vec<Solid>,
    /// Import tolerance.
    pub snap: f64,
    /// From where to look, if the file says it.
    pub camera: Option<Camera>,
}

impl StudyScene {
    /// The scene of a file at `path`.
    pub fn from_file(name: &str, path: &str, scene: &Scene) -> Self {
        let depths = scene.bodies().solids.iter().map(boolean_depth).max();
        Self {
            name: name.into(),
            description: path.into(),
            family: None,
            sweep: true,
            tree_depth: depths.unwrap_or(0),
            bodies: scene.bodies().solids,
            snap: scene.snap,
            camera: scene.camera,
        }
    }
}

/// A scene that comes with the program; the solid is made only when its turn has come.
struct BuiltIn {
    name: &'static str,
    family: Option<Family>,
    /// See [`StudyScene::sweep`].
    sweep: bool,
    /// Whether `--quick` has it.
    quick: bool,
    solid: fn() -> Solid,
}

const fn of(family: Family, name: &'static str, sweep: bool, quick: bool, solid: fn() -> Solid) -> BuiltIn {
    BuiltIn { name, family: Some(family), sweep, quick, solid }
}

use Family::{Balls, Chain, Copies};

/// In the order of the report. Balls and copies are as many as make ten times the primitives at each step.
const BUILT_IN: [BuiltIn; 15] = [
    BuiltIn { name: "classic", family: None, sweep: true, quick: true, solid: families::classic },
    of(Balls, "balls-10", false, true, || families::balls(10)),
    of(Balls, "balls-100", false, true, || families::balls(100)),
    of(Balls, "balls-1000", true, true, || families::balls(1_000)),
    of(Balls, "balls-10000", false, false, || families::balls(10_000)),
    of(Balls, "balls-100000", false, false, || families::balls(100_000)),
    of(Copies, "copies-2", false, true, || families::copies(2)),
    of(Copies, "copies-20", false, true, || families::copies(20)),
    of(Copies, "copies-200", true, true, || families::copies(200)),
    of(Copies, "copies-2000", false, false, || families::copies(2_000)),
    of(Copies, "copies-20000", false, false, || families::copies(20_000)),
    of(Chain, "chain-4", false, true, || families::chain(4)),
    of(Chain, "chain-16", false, true, || families::chain(16)),
    of(Chain, "chain-64", true, true, || families::chain(64)),
    of(Chain, "chain-256", false, false, || families::chain(256)),
];

/// The names of all scenes that come with the program.
pub fn built_in_names() -> impl Iterator<Item = &'static str> {
    BUILT_IN.iter().map(|scene| scene.name)
}

/// The scenes for a study of which nothing is said.
pub fn default_names(quick: bool) -> impl Iterator<Item = &'static str> {
    BUILT_IN.iter().filter(move |scene| scene.quick || !quick).map(|scene| scene.name)
}

/// The names of some scenes that come with the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneNames(pub Vec<&'static str>);

/// The names that a word stands for: that of a scene, or of a family.
pub fn select(word: &str) -> Result<SceneNames, String> {
    let is_meant = |scene: &&BuiltIn| scene.name == word || scene.family.is_some_and(|family| family.name() == word);
    let names: Vec<&str> = BUILT_IN.iter().filter(is_meant).map(|scene| scene.name).collect();
    if names.is_empty() {
        let names: Vec<&str> = built_in_names().collect();
        return Err(format!(
            "there is no scene {word:?}, only {}, and the families balls, copies, chain",
            names.join(", ")
        ));
    }
    Ok(SceneNames(names))
}

/// The scene of that name.
pub fn built_in(name: &str) -> Option<StudyScene> {
    let scene = BUILT_IN.iter().find(|scene| scene.name == name)?;
    let solid = (scene.solid)();
    Some(StudyScene {
        name: scene.name.into(),
        description: description(scene),
        family: scene.family,
        sweep: scene.sweep,
        tree_depth: boolean_depth(&solid),
        bodies: vec![solid],
        snap: 0.0,
        camera: None,
    })
}

fn description(scene: &BuiltIn) -> String {
    let count = scene.name.rsplit('-').next().unwrap_or_default();
    match scene.family {
        None => "cube and sphere minus three cylinders".into(),
        Some(Balls) => format!("a block minus {count} balls on a lattice"),
        Some(Copies) => format!("{count} copies of the classic in a square"),
        Some(Chain) => format!("a ball that {count} smaller ones are taken from and added to by turns"),
    }
}

/// How many boolean operations are on top of one another at most. Trees may be deep beyond any stack.
fn boolean_depth(solid: &Solid) -> usize {
    let mut pending = vec![(0, solid)];
    let mut deepest = 0;
    while let Some((depth, solid)) = pending.pop() {
        deepest = deepest.max(depth);
        match solid.node() {
            Node::Empty | Node::Primitive(_) => {}
            Node::Transform(_, child) | Node::Part(_, child) => pending.push((depth, child)),
            Node::Combine(_, children) => pending.extend(children.iter().map(|child| (depth + 1, child))),
        }
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_names_or_families() {
        assert_eq!(select("classic"), Ok(SceneNames(vec!["classic"])));
        assert_eq!(select("chain"), Ok(SceneNames(vec!["chain-4", "chain-16", "chain-64", "chain-256"])));
        assert!(select("teapot").is_err() && select("").is_err());
    }

    #[test]
    fn families_grow_in_what_they_should() {
        assert_eq!(built_in("chain-64").map(|scene| scene.tree_depth), Some(64));
        assert_eq!(built_in("balls-100").map(|scene| scene.tree_depth), Some(1));
        assert_eq!(built_in("classic").map(|scene| scene.tree_depth), Some(2));
        for name in built_in_names().filter(|name| !name.ends_with("000")) {
            assert!(built_in(name).is_some_and(|scene| scene.name == name));
        }
    }
}
