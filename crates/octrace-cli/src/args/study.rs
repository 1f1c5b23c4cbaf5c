//! Arguments of `octrace study`.

use super::{ReadArgs, names};
use crate::study::{self, Depth, SceneNames};
use crate::values::{self, Size};
use clap::Args;
use octrace::traverse::TraversalKind;
use std::path::PathBuf;

pub(super) const EXAMPLES: &str = "\
Examples:
  octrace study
  octrace study --quick --scenes classic,chain --json study.json
  octrace study bracket.csg --out bracket.html
  octrace study bracket.csg --traversals bresenham,samet --leaf-primitives 4,6,8 --octree-depth auto,7";

/// Arguments of `octrace study`.
#[derive(Debug, Args)]
pub struct StudyArgs {
    /// The files to study: .csg, .oct, .scad (OpenSCAD must be installed), or - for standard input
    /// [default: scenes that come with the program]
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Where the report goes, one HTML page; - for standard output
    #[arg(short, long, value_name = "FILE", default_value = "study.html")]
    pub out: PathBuf,
    /// Where all figures go, as JSON; - for standard output
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// What is tried, and how often.
    #[command(flatten)]
    pub trials: TrialArgs,
    /// How files are read.
    #[command(flatten)]
    pub read: ReadArgs,
    /// Print nothing but errors
    #[arg(short, long, help_heading = "Messages")]
    pub quiet: bool,
}

/// What a study tries, and how often. Lists are separated by commas.
#[derive(Debug, Args)]
#[command(next_help_heading = "What is tried")]
pub struct TrialArgs {
    /// Less of everything: done in half a minute
    #[arg(long)]
    pub quick: bool,
    /// Scenes that come with the program, by name, or by family: balls, copies, chain
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = study::select)]
    pub scenes: Vec<SceneNames>,
    /// How rays walk the octree [default: every way]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = names::<TraversalKind>(TraversalKind::ALL.map(TraversalKind::name)))]
    pub traversals: Vec<TraversalKind>,
    /// How many different surfaces a cell may hold without being divided [default: for files and one scene of each family,
    /// values from 1 to 24; else render's default]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = values::count(1..=64))]
    pub leaf_primitives: Vec<u32>,
    /// How often cells are divided at most; `auto` leaves it to the expected cost of rays [default: for files and one
    /// scene of each family, auto and depths about that; else auto]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub octree_depth: Vec<Depth>,
    /// Rounds of timing, in each of which everything has its turn [default: 5, or 3 with --quick]
    #[arg(long, value_name = "N", value_parser = values::count(1..=1000))]
    pub repeat: Option<u32>,
    /// Width and height of the pictures in pixels, one ray each [default: 256x192, or 96x72 with --quick]
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = study_size)]
    pub size: Option<Size>,
}

impl TrialArgs {
    /// What is to be tried.
    pub fn plan(&self) -> study::Plan {
        let usual = if self.quick {
            (3, Size { width_px: 96, height_px: 72 })
        } else {
            (5, Size { width_px: 256, height_px: 192 })
        };
        let size = self.size.unwrap_or(usual.1);
        let some = |list: &[u32]| (!list.is_empty()).then(|| list.iter().map(|&n| n as usize).collect());
        study::Plan {
            size_px: (size.width_px, size.height_px),
            repeat: self.repeat.unwrap_or(usual.0),
            traversals: if self.traversals.is_empty() { TraversalKind::ALL.to_vec() } else { self.traversals.clone() },
            leaf_primitives: some(&self.leaf_primitives),
            depths: (!self.octree_depth.is_empty()).then(|| self.octree_depth.clone()),
            quick: self.quick,
        }
    }
}

/// A study keeps every ray and every hit of a picture.
fn study_size(text: &str) -> Result<Size, String> {
    const MOST_PIXELS: u32 = 1 << 22;
    let size: Size = text.parse()?;
    if size.width_px.saturating_mul(size.height_px) > MOST_PIXELS {
        return Err(format!("for a study {MOST_PIXELS} pixels (2048x2048) are the most, and far fewer do"));
    }
    Ok(size)
}
