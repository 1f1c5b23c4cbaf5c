//! How a tracer is built.

use crate::compile::Copies;
use crate::octree::BuildOptions;
use crate::traverse::TraversalKind;
use std::fmt;
use std::str::FromStr;

/// Whether rays are accelerated. It never changes an answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Accel {
    /// Not at all: the canonical tracer [Comba-Persiano, §2.2].
    None,
    /// By the octree-CSG [Comba-Persiano, §3].
    #[default]
    Octree,
}

/// A name that is no acceleration's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no acceleration is called `{0}`")]
pub struct UnknownAccel(String);

impl FromStr for Accel {
    type Err = UnknownAccel;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        match name {
            "none" => Ok(Self::None),
            "octree" => Ok(Self::Octree),
            other => Err(UnknownAccel(other.into())),
        }
    }
}

impl fmt::Display for Accel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::None => "none",
            Self::Octree => "octree",
        })
    }
}

/// How a tracer is built. Of these only [`snap`](Self::snap) changes what is traced, and [`copies`](Self::copies), by
/// rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TracerOptions {
    /// Whether and how rays are accelerated.
    pub accel: Accel,
    /// How the octree is walked.
    pub traversal: TraversalKind,
    /// When to stop cutting cells.
    pub octree: BuildOptions,
    /// Import tolerance, relative to the size of everything bounded; see [`Scene::snap`](crate::model::Scene::snap).
    pub snap: f64,
    /// Whether equal solids are stored once.
    pub copies: Copies,
}
