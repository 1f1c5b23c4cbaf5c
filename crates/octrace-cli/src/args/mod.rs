//! The arguments of every command: what clap makes of the command line. Single values are checked here (by the parsers
//! in `values`), so that the commands meet nothing but plain, sound data.

mod bench;
mod figures;
mod study;

pub use bench::BenchArgs;
pub use figures::FiguresArgs;
pub use study::StudyArgs;

use crate::framing::{Framing, ProjectionKind};
use crate::input;
use crate::picture::BitDepth;
use crate::values::{self, Pixel, Size, Viewpoint};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::error::{ContextKind, ContextValue};
use clap::{Args, Parser, Subcommand, ValueEnum};
use octrace::film::Background;
use octrace::octree::BuildOptions;
use octrace::trace::{Accel, TracerOptions};
use octrace::traverse::TraversalKind;
use octrace_read::{CutColor, Facets, Ghosts, Highlights, ReadOptions, Tolerance};
use std::fmt::Debug;
use std::path::{Path, PathBuf};
use std::str::FromStr;

const EXIT_CODES: &str = "\
Exit codes:
    0  done (warnings are no failure)
    1  the input has errors, uses what is not supported, or has no answer
    2  the arguments are wrong
    3  a file cannot be read or written, or OpenSCAD is missing
  130  interrupted by Ctrl-C";

const RENDER_EXAMPLES: &str = "\
Examples:
  octrace render bracket.csg
  octrace render bracket.scad -D width=20 -o bracket.png --size 1920x1080 --samples 16
  octrace render bracket.csg -o - --transparent --bit-depth 16 | display
  octrace render bracket.csg --camera=0,0,10,55,0,25,140 --projection ortho --viewall
  openscad -o - --export-format csg bracket.scad | octrace render - -o bracket.png";

const CHECK_EXAMPLES: &str = "\
Examples:
  octrace check bracket.csg
  octrace check --json parts/*.csg > findings.json";

const MEASURE_EXAMPLES: &str = "\
Examples:
  octrace measure bracket.csg
  octrace measure bracket.csg --json --facets written --tolerance 1e-5";

const INSPECT_EXAMPLES: &str = "\
Examples:
  octrace inspect bracket.csg
  octrace inspect bracket.csg --tree --program
  octrace inspect bracket.csg --size 640x480 --pixel 320,240
  octrace inspect bracket.csg --json";

/// Exact ray tracing of CSG solids, straight from the CSG tree, with no meshing.
#[derive(Debug, Parser)]
#[command(name = "octrace", version, after_help = EXIT_CODES, max_term_width = 100)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

impl Arguments {
    /// The process's arguments; where they are wrong, says so and ends the process.
    pub fn from_command_line() -> Self {
        Self::try_parse().unwrap_or_else(|error| with_tip(error).exit())
    }
}

/// Whoever only names a file most likely wants to see it.
fn with_tip(mut error: clap::Error) -> clap::Error {
    if let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand)
        && input::is_model(Path::new(word))
    {
        let tip = format!("a command comes first: octrace render {word}");
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    error
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a picture of a solid
    #[command(after_help = RENDER_EXAMPLES)]
    Render(RenderArgs),
    /// Say what is wrong with files, and what in them is not supported
    #[command(after_help = CHECK_EXAMPLES)]
    Check(CheckArgs),
    /// Find a solid's volume, centre of mass and extent
    #[command(after_help = MEASURE_EXAMPLES)]
    Measure(MeasureArgs),
    /// Show what octrace makes of a file: tree, program, octree, one pixel
    #[command(after_help = INSPECT_EXAMPLES)]
    Inspect(InspectArgs),
    /// Draw how a solid is traced: tree, spans, rays, octree, as SVG files
    #[command(after_help = figures::EXAMPLES)]
    Figures(FiguresArgs),
    /// Measure the ways to walk an octree side by side, and find the settings that suit a model
    #[command(after_help = study::EXAMPLES)]
    Study(StudyArgs),
    /// Measure how fast this machine traces, next to what it could do at best
    #[command(after_help = bench::EXAMPLES)]
    Bench(BenchArgs),
}

/// How files are read.
#[derive(Debug, Args)]
#[command(next_help_heading = "Reading")]
pub struct ReadArgs {
    /// How round things with few facets are meant: `auto` keeps $fn from 3 to 12 as prisms and makes everything else
    /// round, `smooth` makes everything round, `written` makes exactly the facets that OpenSCAD would
    #[arg(long, value_name = "HOW", default_value = "auto", value_parser = names::<Facets>(["auto", "smooth", "written"]))]
    pub facets: Facets,
    /// Make surfaces coincide that differ by less than this, relative to the model's size; 0 switches it off
    /// [default: 2e-6 for .csg and .scad, which makes up for the six digits of dumps; 0 for .oct]
    #[arg(long, value_name = "RATIO", value_parser = values::relative_or_zero, allow_hyphen_values = true)]
    pub snap: Option<f64>,
    /// How far what has no exact form may be from the truth, relative to its own size: twisted extrusions, ellipses that
    /// are offset, and the like. `measure` takes it for the volume too
    #[arg(long, value_name = "RATIO", default_value = "1e-4", value_parser = values::relative_above_zero, allow_hyphen_values = true)]
    pub tolerance: f64,
    /// Draw what `%` marks too, translucent
    #[arg(long)]
    pub show_background: bool,
    /// Draw what `#` marks in a translucent red besides
    #[arg(long)]
    pub highlight: bool,
    /// Which colour a cut face has: that of the solid that cuts, where it has one, or that of the body that is cut
    #[arg(long, value_name = "WHOSE", default_value = "tool", value_parser = names::<CutColor>(["tool", "body"]))]
    pub cut_color: CutColor,
    /// Mend imported meshes that are not closed, as well as can be, instead of refusing them
    #[arg(long)]
    pub repair: bool,
    /// Leave out what is not supported, saying what, instead of failing
    #[arg(long)]
    pub skip_unsupported: bool,
    /// Set a variable, as OpenSCAD's -D does; for .scad files
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = values::definition)]
    pub define: Vec<String>,
}

/// How rays are traced. None of this changes a single bit of any result.
#[derive(Debug, Args)]
#[command(next_help_heading = "Tracing (changes the time taken, never the result)")]
pub struct TraceArgs {
    /// What rays are sped up with; `none` is the canonical tracer that the others are checked against
    #[arg(long, value_name = "WHAT", default_value = "octree", value_parser = names::<Accel>(["none", "octree"]))]
    pub accel: Accel,
    /// How rays walk the octree
    #[arg(long, value_name = "NAME", default_value_t, value_parser = names::<TraversalKind>(TraversalKind::ALL.map(TraversalKind::name)))]
    pub traversal: TraversalKind,
    /// How often the octree's cells are divided at most [default: as long as it makes rays faster]
    #[arg(long, value_name = "N", value_parser = values::count(0..=20))]
    pub octree_depth: Option<u32>,
    /// How many different surfaces of primitives (a block has six, a ball one) a cell may hold without being divided
    #[arg(long, value_name = "N", default_value_t = BuildOptions::default().leaf_surfaces as u32, value_parser = values::count(1..=64))]
    pub leaf_primitives: u32,
    /// How many threads to use [default: all]
    #[arg(long, value_name = "N", value_parser = values::count(1..=1024))]
    pub threads: Option<u32>,
}

/// Where the picture is taken from.
#[derive(Debug, Args)]
#[command(next_help_heading = "View")]
pub struct ViewArgs {
    /// Width and height in pixels; also OpenSCAD's `--imgsize W,H`
    #[arg(long, alias = "imgsize", value_name = "WxH", default_value = "1024x768", allow_hyphen_values = true)]
    pub size: Size,
    /// Six numbers, `eye_x,y,z,center_x,y,z`, or seven, `translate_x,y,z,rot_x,y,z,distance`, as in OpenSCAD
    /// [default: the file's camera, or a view of everything]
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    pub camera: Option<Viewpoint>,
    /// Move the camera as far away as OpenSCAD does to see everything
    #[arg(long)]
    pub viewall: bool,
    /// Look at the middle of everything
    #[arg(long)]
    pub autocenter: bool,
    /// `perspective` (also `p`) or `ortho` (also `o`) [default: the camera's, or perspective]
    #[arg(long, value_name = "KIND", hide_possible_values = true)]
    pub projection: Option<ProjectionKind>,
}

/// Arguments of `octrace render`.
#[derive(Debug, Args)]
pub struct RenderArgs {
    /// The file to draw: .csg, .oct, .scad (OpenSCAD must be installed), or - for standard input
    pub file: PathBuf,
    /// Where the PNG picture goes; - for standard output [default: FILE's name with .png, in the current folder]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// How space becomes a picture.
    #[command(flatten)]
    pub view: ViewArgs,
    /// Quality, background and format.
    #[command(flatten)]
    pub look: LookArgs,
    /// How files are read.
    #[command(flatten)]
    pub read: ReadArgs,
    /// How rays are traced.
    #[command(flatten)]
    pub trace: TraceArgs,
    /// Print times and counts when done: on standard output, or on standard error if the picture goes there
    #[arg(long, value_name = "FORMAT", help_heading = "Messages")]
    pub stats: Option<StatsFormat>,
    /// Print nothing but errors
    #[arg(short, long, help_heading = "Messages")]
    pub quiet: bool,
}

/// Quality, background and format of a picture.
#[derive(Debug, Args)]
#[command(next_help_heading = "Picture")]
pub struct LookArgs {
    /// Rays through each pixel, against jagged edges
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = values::count(1..=65_536))]
    pub samples: u32,
    /// How often light is followed through reflections and refractions
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = values::count(0..=64))]
    pub max_bounces: u32,
    /// A name, #rrggbb, three numbers from 0 to 1 as in 1,0.5,0, or `transparent` [default: the file's, or light grey]
    #[arg(long, value_name = "COLOR", value_parser = background)]
    pub background: Option<Background>,
    /// The same as --background transparent
    #[arg(long, conflicts_with = "background")]
    pub transparent: bool,
    /// Bits per channel of the PNG file: 8 or 16
    #[arg(long, value_name = "N", default_value = "8", value_parser = bit_depth)]
    pub bit_depth: BitDepth,
}

/// Arguments of `octrace check`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// The files to check; - for standard input
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Print all findings as one JSON array on standard output
    #[arg(long)]
    pub json: bool,
    /// How files are read.
    #[command(flatten)]
    pub read: ReadArgs,
    /// Print nothing but errors
    #[arg(short, long, help_heading = "Messages")]
    pub quiet: bool,
}

/// Arguments of `octrace measure`.
#[derive(Debug, Args)]
pub struct MeasureArgs {
    /// The file to measure: .csg, .oct, .scad (OpenSCAD must be installed), or - for standard input
    pub file: PathBuf,
    /// Print one JSON object on standard output
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

/// Arguments of `octrace inspect`.
#[derive(Debug, Args)]
pub struct InspectArgs {
    /// The file to look into: .csg, .oct, .scad (OpenSCAD must be installed), or - for standard input
    pub file: PathBuf,
    /// Print one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// Print the whole CSG tree as it was read
    #[arg(long)]
    pub tree: bool,
    /// Print the program that the tree was compiled to
    #[arg(long)]
    pub program: bool,
    /// Explain one pixel, counted from 0 at the upper left: cells visited, spans, hit
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    pub pixel: Option<Pixel>,
    /// Which picture the pixel belongs to.
    #[command(flatten)]
    pub view: ViewArgs,
    /// How files are read.
    #[command(flatten)]
    pub read: ReadArgs,
    /// How rays are traced.
    #[command(flatten)]
    pub trace: TraceArgs,
    /// Print nothing but errors and what was asked for
    #[arg(short, long, help_heading = "Messages")]
    pub quiet: bool,
}

/// How statistics are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StatsFormat {
    /// One JSON object on one line
    Json,
}

impl ViewArgs {
    /// What is said about the camera.
    pub fn framing(&self) -> Framing {
        Framing {
            viewpoint: self.camera,
            view_all: self.viewall,
            auto_center: self.autocenter,
            projection: self.projection,
        }
    }

    /// The picture's size in pixels.
    pub fn size_px(&self) -> (u32, u32) {
        (self.size.width_px, self.size.height_px)
    }
}

impl ReadArgs {
    /// The reader's options.
    pub fn options(&self) -> ReadOptions {
        ReadOptions {
            facets: self.facets,
            skip_unsupported: self.skip_unsupported,
            snap: self.snap,
            tolerance: Tolerance { relative: self.tolerance },
            ghosts: if self.show_background { Ghosts::Drawn } else { Ghosts::Hidden },
            highlights: if self.highlight { Highlights::Drawn } else { Highlights::Plain },
            cut_color: self.cut_color,
            repair: self.repair,
            dialect: None,
        }
    }
}

impl TraceArgs {
    /// The core's options, for a scene with the import tolerance `snap`.
    pub fn options(&self, snap: f64) -> TracerOptions {
        TracerOptions {
            accel: self.accel,
            traversal: self.traversal,
            octree: BuildOptions {
                leaf_surfaces: self.leaf_primitives as usize,
                depth: self.octree_depth.or(BuildOptions::default().depth),
            },
            snap,
            ..TracerOptions::default()
        }
    }

    /// How many threads are meant.
    pub fn threads(&self) -> usize {
        match self.threads {
            Some(threads) => threads as usize,
            None => std::thread::available_parallelism().map_or(1, Into::into),
        }
    }
}

impl LookArgs {
    /// The background asked for.
    pub fn background(&self) -> Background {
        if self.transparent { Background::Transparent } else { self.background.unwrap_or(Background::Scene) }
    }
}

fn background(text: &str) -> Result<Background, String> {
    match text {
        "transparent" => Ok(Background::Transparent),
        _ => values::color(text).map(Background::Color),
    }
}

fn bit_depth(text: &str) -> Result<BitDepth, String> {
    match text {
        "8" => Ok(BitDepth::Eight),
        "16" => Ok(BitDepth::Sixteen),
        _ => Err("write 8 or 16".into()),
    }
}

/// One of `names`, which `T` can parse; `--help` lists them.
fn names<T>(names: impl IntoIterator<Item = &'static str>) -> impl TypedValueParser<Value = T>
where
    T: FromStr<Err: Debug> + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(names).map(|name| name.parse().expect("every listed name is one of T's"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_definition_is_consistent() {
        Arguments::command().debug_assert();
    }

    fn render(words: &[&str]) -> Result<RenderArgs, String> {
        let arguments = Arguments::try_parse_from(["octrace", "render", "a.csg"].iter().chain(words));
        match arguments.map_err(|e| e.to_string())?.command {
            Command::Render(args) => Ok(args),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn openscad_spellings_are_understood() {
        let args = render(&["--imgsize=640,480", "--camera=-1,2,3,4,5,6", "--projection", "o", "-D", "a=1"]).unwrap();
        assert_eq!(args.view.size_px(), (640, 480));
        assert_eq!(args.view.projection, Some(ProjectionKind::Orthographic));
        assert!(render(&["--camera", "-1,2,3,4,5,6"]).unwrap().view.camera.is_some());
    }

    #[test]
    fn contradictions_and_nonsense_are_refused() {
        for words in [
            &["--transparent", "--background", "red"][..],
            &["--size", "0x0"],
            &["--bit-depth", "12"],
            &["--threads", "0"],
            &["--samples", "0"],
            &["--snap", "-1"],
            &["--accel", "magic"],
        ] {
            assert!(render(words).is_err(), "{words:?}");
        }
    }

    #[test]
    fn a_file_in_place_of_a_command_gets_a_tip() {
        let message = |word| with_tip(Arguments::try_parse_from(["octrace", word]).unwrap_err()).to_string();
        assert!(message("part.csg").contains("octrace render part.csg"), "{}", message("part.csg"));
        assert!(!message("part").contains("octrace render"), "{}", message("part"));
    }

    #[test]
    fn transparent_is_a_background() {
        assert_eq!(render(&["--transparent"]).unwrap().look.background(), Background::Transparent);
        assert_eq!(render(&["--background", "transparent"]).unwrap().look.background(), Background::Transparent);
        assert_eq!(render(&[]).unwrap().look.background(), Background::Scene);
    }
}
