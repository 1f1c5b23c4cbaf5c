//! Arguments of `octrace bench`.

use super::{ReadArgs, TraceArgs};
use crate::bench::{self, SceneNames};
use crate::values::{self, Size};
use clap::Args;
use std::path::PathBuf;

pub(super) const EXAMPLES: &str = "\
Examples:
  octrace bench
  octrace bench --scenes classic,swiss,grid-1000 --repeat 11
  octrace bench --threads 1 --json > bench.json
  octrace bench bracket.csg
  octrace bench --repeat 1 --json parts/*.csg";

/// Arguments of `octrace bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// The files to measure: .csg, .oct, .scad (OpenSCAD must be installed), or - for standard input
    /// [default: scenes that come with the program]
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Scenes that come with the program, by name, or by family: menger, swiss, grid
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = bench::select)]
    pub scenes: Vec<SceneNames>,
    /// Leave out the scenes of more than 10,000 primitives
    #[arg(long)]
    pub quick: bool,
    /// Rounds of timing, in each of which everything has its turn
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = values::count(1..=1000))]
    pub repeat: u32,
    /// Width and height of the pictures in pixels
    #[arg(long, value_name = "WxH", default_value = "1024x768", allow_hyphen_values = true)]
    pub size: Size,
    /// Print a JSON list of objects on standard output, one for each scene, instead of a table
    #[arg(long)]
    pub json: bool,
    /// How files are read.
    #[command(flatten)]
    pub read: ReadArgs,
    /// How rays are traced.
    #[command(flatten)]
    pub trace: TraceArgs,
    /// Print nothing but errors and the result
    #[arg(short, long, help_heading = "Messages")]
    pub quiet: bool,
}
