//! What a caller may choose about reading.

use crate::Dialect;
use octrace_forms::Tolerance;
use std::fmt;
use std::str::FromStr;

/// What becomes of the facets that `$fn`, `$fa` and `$fs` ask for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Facets {
    /// `$fn` up to 12 is taken to mean a prism, a hexagon, a pyramid; everything else is round.
    #[default]
    Auto,
    /// Everything is round.
    Smooth,
    /// Exactly the facets that OpenSCAD makes. Where a file says nothing about facets, round.
    Written,
}

impl Facets {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Auto, Self::Smooth, Self::Written];
}

impl fmt::Display for Facets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Auto => "auto",
            Self::Smooth => "smooth",
            Self::Written => "written",
        })
    }
}

/// A word that is not the name of a [`Facets`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("facets are `auto`, `smooth` or `written`, not `{0}`")]
pub struct UnknownFacets(pub String);

impl FromStr for Facets {
    type Err = UnknownFacets;
    fn from_str(word: &str) -> Result<Self, Self::Err> {
        let named = |f: &Self| f.to_string() == word;
        Self::ALL.into_iter().find(named).ok_or_else(|| UnknownFacets(word.to_owned()))
    }
}

/// What becomes of subtrees marked `%`, which are no part of the object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ghosts {
    /// They are left out.
    #[default]
    Hidden,
    /// They are drawn translucent.
    Drawn,
}

/// What becomes of subtrees marked `#`, which are part of the object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Highlights {
    /// They look like everything else.
    #[default]
    Plain,
    /// They are drawn, whole, in a translucent red besides.
    Drawn,
}

/// Which colour a face has that a difference cuts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CutColor {
    /// That of the solid that cuts, if it has one; else that of the solid that is cut. As in OpenSCAD's preview.
    #[default]
    Tool,
    /// That of the solid that is cut.
    Body,
}

impl fmt::Display for CutColor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Tool => "tool",
            Self::Body => "body",
        })
    }
}

/// A word that is not the name of a [`CutColor`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cut faces have the colour of the `tool` or of the `body`, not `{0}`")]
pub struct UnknownCutColor(pub String);

impl FromStr for CutColor {
    type Err = UnknownCutColor;
    fn from_str(word: &str) -> Result<Self, Self::Err> {
        let named = |color: &Self| color.to_string() == word;
        [Self::Tool, Self::Body].into_iter().find(named).ok_or_else(|| UnknownCutColor(word.to_owned()))
    }
}

/// How to read a file. The default suits both dumps and scenes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// What becomes of facets.
    pub facets: Facets,
    /// Leave out what cannot be rendered yet, with a warning, instead of refusing the file.
    pub skip_unsupported: bool,
    /// The import tolerance, see [`octrace::Scene::snap`]; by default the one for six digits in dumps, none in scenes.
    pub snap: Option<f64>,
    /// The dialect; by default what the file's name asks for.
    pub dialect: Option<Dialect>,
    /// How far what has no exact form may be from the truth.
    pub tolerance: Tolerance,
    /// What becomes of `%`.
    pub ghosts: Ghosts,
    /// What becomes of `#`.
    pub highlights: Highlights,
    /// Which colour faces have that a difference cuts.
    pub cut_color: CutColor,
    /// Mend meshes that are not closed, as well as can be, instead of refusing them.
    pub repair: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_go_there_and_back() {
        for facets in Facets::ALL {
            assert_eq!(facets.to_string().parse(), Ok(facets));
        }
        let error = "round".parse::<Facets>().unwrap_err();
        assert_eq!(error.to_string(), "facets are `auto`, `smooth` or `written`, not `round`");
    }
}
