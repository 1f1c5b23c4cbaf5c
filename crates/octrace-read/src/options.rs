//! What a caller may choose about reading.

use crate::Dialect;
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
