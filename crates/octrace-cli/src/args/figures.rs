//! Arguments of `octrace figures`.

use super::{ReadArgs, ViewArgs};
use crate::values::{self, Pixel};
use clap::Args;
use octrace::octree::BuildOptions;
use std::path::PathBuf;

pub(super) const EXAMPLES: &str = "\
Examples:
  octrace figures -o figures
  octrace figures bracket.csg -o figures --pixel 512,300 --slice 2.5";

/// Arguments of `octrace figures`.
#[derive(Debug, Args)]
pub struct FiguresArgs {
    /// The file to draw figures of: .csg, .oct, .scad (OpenSCAD must be installed), or - for standard input [default: a
    /// built-in example]
    pub file: Option<PathBuf>,
    /// The folder for the figures; it is made if it is not there
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// The pixel whose rays are drawn, counted from 0 at the upper left [default: the middle one]
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub pixel: Option<Pixel>,
    /// The height of the slice through the octree [default: through its middle]
    #[arg(long, value_name = "Z", value_parser = values::finite, allow_hyphen_values = true)]
    pub slice: Option<f64>,
    /// How often the cells of the octree that is drawn are divided at most
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = values::count(0..=7))]
    pub octree_depth: u32,
    /// How many different surfaces of primitives a cell of it may hold without being divided
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = values::count(1..=64))]
    pub leaf_primitives: u32,
    /// Which picture the pixel belongs to.
    #[command(flatten)]
    pub view: ViewArgs,
    /// How the file is read.
    #[command(flatten)]
    pub read: ReadArgs,
    /// Print nothing but errors
    #[arg(short, long, help_heading = "Messages")]
    pub quiet: bool,
}

impl FiguresArgs {
    /// How the octree that is drawn is built.
    pub fn octree(&self) -> BuildOptions {
        BuildOptions { leaf_surfaces: self.leaf_primitives as usize, depth: Some(self.octree_depth) }
    }
}
