//! What is tried on a scene: traversals, times *p*, times depth.

use super::scenes::StudyScene;
use octrace::octree::BuildOptions;
use octrace::trace::TracerOptions;
use octrace::traverse::TraversalKind;
use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// An octree depth asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// As the expected cost of rays has it.
    Auto,
    /// At most so many levels below the root.
    Levels(u32),
}

impl Depth {
    /// As the octree's builder has it.
    pub fn levels(self) -> Option<u32> {
        match self {
            Self::Auto => None,
            Self::Levels(levels) => Some(levels),
        }
    }
}

impl fmt::Display for Depth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Levels(levels) => write!(f, "{levels}"),
        }
    }
}

impl FromStr for Depth {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.trim() {
            "auto" => Ok(Self::Auto),
            number => match number.parse() {
                Ok(levels) if levels <= BuildOptions::MAX_DEPTH => Ok(Self::Levels(levels)),
                _ => Err(format!("write auto or a whole number from 0 to {}", BuildOptions::MAX_DEPTH)),
            },
        }
    }
}

/// One way to trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Config {
    /// How the octree is walked.
    pub traversal: TraversalKind,
    /// The paper's *p*, in surfaces.
    pub leaf_primitives: usize,
    /// How deep the octree may be.
    pub depth: Depth,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            traversal: TraversalKind::default(),
            leaf_primitives: BuildOptions::default().leaf_surfaces,
            depth: BuildOptions::default().depth.map_or(Depth::Auto, Depth::Levels),
        }
    }
}

impl Config {
    /// As the tracer has it.
    pub fn options(&self, snap: f64) -> TracerOptions {
        TracerOptions {
            traversal: self.traversal,
            octree: BuildOptions { leaf_surfaces: self.leaf_primitives, depth: self.depth.levels() },
            snap,
            ..TracerOptions::default()
        }
    }
}

/// What was asked for.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Picture, in pixels.
    pub size_px: (u32, u32),
    /// Rounds of timing.
    pub repeat: u32,
    /// Which traversals.
    pub traversals: Vec<TraversalKind>,
    /// Values of *p*, if the user chose any; else [`Self::usual_leaf_primitives`], where a scene is swept.
    pub leaf_primitives: Option<Vec<usize>>,
    /// Depths, if the user chose any; else some about what the tracer chooses, where a scene is swept.
    pub depths: Option<Vec<Depth>>,
    /// Less of everything.
    pub quick: bool,
}

impl Plan {
    /// Values of *p* from the least to more than is good, the default one among them.
    fn usual_leaf_primitives(&self) -> Vec<usize> {
        let mut values = if self.quick { vec![3, 6, 12] } else { vec![1, 3, 6, 12, 24] };
        values.push(Config::default().leaf_primitives);
        values.sort_unstable();
        values.dedup();
        values
    }

    /// What the tracer chooses, and depths about the one at which the smallest cells are a few times as small as they
    /// would be if they shared the surfaces evenly.
    fn usual_depths(&self, surfaces: usize) -> Vec<Depth> {
        let middle = (surfaces.max(1) as f64).log2() / 3.0 + 3.0;
        let middle = middle.ceil() as u32;
        let about = if self.quick { 1 } else { 2 };
        let levels = middle - about..=(middle + about).min(BuildOptions::MAX_DEPTH);
        std::iter::once(Depth::Auto).chain(levels.map(Depth::Levels)).collect()
    }

    /// Whether more than the default settings are tried on a scene, so that there is something to choose.
    pub fn chooses(&self, scene: &StudyScene) -> bool {
        scene.sweep || self.leaf_primitives.is_some() || self.depths.is_some()
    }

    /// How many rays the canonical tracer is given where each meets so many surfaces. It takes some 50 to 100
    /// nanoseconds for each.
    pub fn canonical_rays(&self, surfaces: usize) -> usize {
        let (tests, least) = if self.quick { (300_000, 8) } else { (3_000_000, 24) };
        (tests / surfaces.max(1)).max(least)
    }

    /// When building took longer than this, deeper octrees are not tried.
    pub fn longest_build_s(&self) -> f64 {
        if self.quick { 0.5 } else { 2.0 }
    }

    /// Depths of octrees whose memory is weighed.
    pub fn weighed_depths(&self) -> RangeInclusive<u32> {
        if self.quick { 3..=6 } else { 3..=10 }
    }

    /// All ways to trace a scene. The default settings come first, whatever was asked for: all others are compared with
    /// them. Shallower trees come before deeper ones. The program names surfaces so often as `surfaces` says.
    pub fn configs(&self, scene: &StudyScene, surfaces: usize) -> Vec<Config> {
        let usual = Config::default();
        let leaf_primitives = self
            .leaf_primitives
            .clone()
            .unwrap_or_else(|| if scene.sweep { self.usual_leaf_primitives() } else { vec![usual.leaf_primitives] });
        let depths = self
            .depths
            .clone()
            .unwrap_or_else(|| if scene.sweep { self.usual_depths(surfaces) } else { vec![usual.depth] });
        // Of settings that lead to the same octree the first ones are measured: those should be the usual ones.
        let is_asked = leaf_primitives.contains(&usual.leaf_primitives) && depths.contains(&usual.depth);
        let usual_elsewhere =
            self.traversals.iter().filter(|_| is_asked).map(|&traversal| Config { traversal, ..usual });
        let all = self.traversals.iter().flat_map(|&traversal| {
            let with_p = move |&leaf_primitives| Config { traversal, leaf_primitives, ..usual };
            let with_depth = |config| depths.iter().map(move |&depth| Config { depth, ..config });
            leaf_primitives.iter().map(with_p).flat_map(with_depth)
        });
        let mut configs: Vec<Config> = Vec::new();
        for config in std::iter::once(usual).chain(usual_elsewhere).chain(all) {
            if !configs.contains(&config) {
                configs.push(config);
            }
        }
        configs
    }
}

#[cfg(test)]
mod tests {
    use super::super::scenes::built_in;
    use super::*;

    fn plan() -> Plan {
        Plan {
            size_px: (8, 6),
            repeat: 1,
            traversals: vec![TraversalKind::Samet],
            leaf_primitives: None,
            depths: None,
            quick: true,
        }
    }

    #[test]
    fn the_default_is_always_there_and_first() {
        let scene = built_in("classic").unwrap();
        let configs =
            Plan { leaf_primitives: Some(vec![2]), depths: Some(vec![Depth::Levels(3)]), ..plan() }.configs(&scene, 16);
        let asked = Config { traversal: TraversalKind::Samet, leaf_primitives: 2, depth: Depth::Levels(3) };
        assert_eq!(configs, [Config::default(), asked]);
    }

    #[test]
    fn only_swept_scenes_are_tried_with_everything() {
        assert_eq!(plan().configs(&built_in("classic").unwrap(), 16).len(), 1 + 3 * 4);
        assert_eq!(plan().configs(&built_in("chain-4").unwrap(), 5).len(), 2);
    }

    #[test]
    fn depths_follow_the_number_of_surfaces() {
        let levels = |surfaces| plan().usual_depths(surfaces).iter().filter_map(|d| d.levels()).collect::<Vec<_>>();
        assert_eq!((levels(0), levels(16), levels(4096)), (vec![2, 3, 4], vec![4, 5, 6], vec![6, 7, 8]));
    }

    #[test]
    fn depths_are_numbers_or_auto() {
        assert_eq!((" auto".parse(), "7".parse()), (Ok(Depth::Auto), Ok(Depth::Levels(7))));
        assert!("21".parse::<Depth>().is_err() && "-1".parse::<Depth>().is_err() && "".parse::<Depth>().is_err());
    }
}
