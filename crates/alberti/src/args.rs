//! The command line: commands, their flags, and the help text (clap derive).
//!
//! Users read the doc comments of these structs in `--help`, in the manual pages and in `alberti
//! reference`. The first paragraph is the short help; the long help adds the rest.

use super::animate::AnimateArgs;
use super::batch::{BatchArgs, WorkerArgs};
use super::color::ColorChoice;
use super::compare::CompareArgs;
use super::compare_projections::CompareProjectionsArgs;
use super::curve::CurveArgs;
use super::deferred::Deferred;
use super::demo::DemoArgs;
use super::exercise::ExerciseArgs;
use super::explain::ExplainArgs;
use super::explore::ExploreArgs;
use super::format::{DxfArgs, OutputFormat, parse_quality};
use super::load_options::LoadArgs;
use super::manual::{CompletionArgs, ManArgs};
use super::matrix::MatrixArgs;
use super::memory_limit::parse_memory_size;
use super::model_state::ModelStateArgs;
use super::passes::PassArgs;
use super::reference::FullReferenceArgs;
use super::region::RegionArgs;
use super::scene::SceneArgs;
use super::scene_overrides::{SceneOverrideArgs, named_view_parser};
use super::sheet::SheetArgs;
use super::sweep::SweepArgs;
use super::thumbnailer::ThumbnailerArgs;
use camera::NamedView;
use clap::{Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Render, draw, validate and explain 3D models without a GPU, a display or a browser
///
/// Reads glTF, STL, OBJ, PLY and 3MF, detected from the content.
///
/// Output is deterministic: the same bytes on every machine, with any number of threads.
#[derive(Debug, Parser)]
#[command(name = "alberti", version, max_term_width = 100, after_help = HELP_EXAMPLES)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// When to color messages; `auto` colors them on a terminal unless NO_COLOR is set
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub(crate) color: ColorChoice,
    /// Memory limit of the command, such as 2GiB; a command that needs more fails (Linux only)
    /// [default: no overall limit]
    #[arg(long, global = true, value_name = "SIZE", value_parser = parse_memory_size)]
    pub(crate) max_memory: Option<u64>,
}

/// Examples and exit codes at the end of `alberti --help`.
const HELP_EXAMPLES: &str = "\
Examples:
  alberti render model.glb                        a picture in model.png, framed and lit
  alberti render model.glb --view front --size 512x512 -o thumb.png
  alberti render model.glb --azimuth 30 --elevation 20 --style toon
  alberti render model.glb -o model.svg           a line drawing with hidden lines removed
  alberti render scene.ron                        a scene: models, camera, lights, style
  alberti animate model.glb --turntable -o turn.png
  alberti batch models --out-dir thumbs --size 256x256

  alberti sheet model.glb --paper a4              front, top, side and isometric views, to scale
  alberti sheet part.stl --paper a4 --unit mm     a part at its true size, or to scale
  alberti compare-projections model.glb           isometric, cavalier, two-point …, side by side
  alberti sweep model.glb --vary dolly --from 3 --to 12
  alberti curve depth --near 0.1 --far 1000 -o depth.svg

  alberti info model.glb                          the contents of a model
  alberti check model.glb                         validation against the glTF specification
  alberti scene init model.glb                    a scene file to start from

  alberti explain model.glb --point 0,1,0         a point through every stage of the pipeline
  alberti explore model.glb                       the same, live in a browser on this machine
  alberti matrix 1 0 0 0 …                        the transform or projection of a matrix
  alberti matrix --perspective 60,16/9,0.1,100    a matrix built from parameters
  alberti exercise 3 --answer 'A=1; B=0'          a check of your answer to an exercise
  alberti demo wrap-around                        why clipping comes before the perspective divide

  alberti reference camera                        the meaning of a field or a flag

Exit codes:
  0  success
  1  the input is invalid or the work failed; existing output files are left untouched
  2  wrong usage
  3  `batch` only: the run had to stop, for example because the disk is full; run it again
`check` exits with 1 if there are errors, but not for warnings and notes. `render --compare` exits
with 1 if the pictures differ, but still writes all files. `exercise` exits with 1 if the answer is
incorrect. `batch` exits with 1 if jobs failed, and with 128 plus the signal number if a signal
interrupted it.";

/// The commands, in the order of the help.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a model or scene to PNG, or as a line drawing to SVG, PDF or DXF
    Render(Deferred<RenderArgs>),
    /// Lay out front, top, side and isometric views on a sheet, to scale
    Sheet(Deferred<SheetArgs>),
    /// Print what a model contains: meshes, bounds, cameras, materials, extensions
    Info(Deferred<InfoArgs>),
    /// Validate a scene or a model and print every error with its location and a fix
    Check(Deferred<CheckArgs>),
    /// Identify a 4x4 or 3x3 matrix, or build one from parameters
    Matrix(Deferred<MatrixArgs>),
    /// Trace a point, segment, pixel, vertex or triangle through every stage of the pipeline
    Explain(Deferred<ExplainArgs>),
    /// Explore the viewing pipeline in the browser, in lessons or with your own model
    Explore(ExploreArgs),
    /// Show the book's exercises, check answers and identify mistakes
    Exercise(Deferred<ExerciseArgs>),
    /// Draw a subject in every classical projection, side by side, with formulas and numbers
    CompareProjections(Deferred<CompareProjectionsArgs>),
    /// Draw a series of pictures that vary one camera parameter, side by side
    Sweep(Deferred<SweepArgs>),
    /// Plot depth against distance, with a table
    Curve(CurveArgs),
    /// Show the artifact that appears when a pipeline stage is skipped
    Demo(DemoArgs),
    /// Render a turntable or the model's own animation as an image sequence, APNG or GIF
    Animate(Deferred<AnimateArgs>),
    /// Render many models, with a report and a contact sheet
    Batch(Deferred<BatchArgs>),
    /// Render the jobs of `batch`
    #[command(hide = true)]
    BatchWorker(WorkerArgs),
    /// Render a thumbnail within time and memory limits, or install the thumbnailer
    Thumbnailer(Deferred<ThumbnailerArgs>),
    /// Create, validate, format and look up scene files
    Scene(SceneArgs),
    /// Print a shell completion script
    Completions(Deferred<CompletionArgs>),
    /// Print or write manual pages
    Man(Deferred<ManArgs>),
    /// Look up flags, scene fields, formulas and JSON Schemas
    Reference(Deferred<FullReferenceArgs>),
}

/// Arguments of `alberti render`.
#[derive(Debug, clap::Args)]
pub(crate) struct RenderArgs {
    /// Scenes (.ron) or models (.gltf, .glb, .stl, .obj, .ply, .3mf); `-` is the standard input
    #[arg(required = true, value_name = "INPUT")]
    pub(crate) inputs: Vec<PathBuf>,
    /// Output file (.png, .jpg, .webp, or .svg, .pdf, .dxf for a line drawing); `-` is the standard
    /// output [default: {stem}.png in the current folder, {stem}_{view}.png for several views]
    ///
    /// The name may be a template. Values from the input's name and the flags replace {stem},
    /// {camera}, {view}, {style}, {projection} and {variant}. The picture's index replaces {frame},
    /// counted per input, and {index}, counted over all pictures. Indices start at 0; {index:04}
    /// has four digits. Write {{ and }} for braces.
    #[arg(help_heading = "Output", short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Output format [default: from the file extension; png on the standard output]
    #[arg(help_heading = "Output", long)]
    pub(crate) format: Option<OutputFormat>,
    /// JPEG quality, from 1 to 100 [default: 90]
    #[arg(help_heading = "Output", long, value_name = "N", value_parser = parse_quality)]
    pub(crate) quality: Option<u8>,
    /// Render again whenever the input or a file that it uses changes, until Ctrl+C
    #[arg(help_heading = "Output", long, conflicts_with_all = ["json", "compare"])]
    pub(crate) watch: bool,
    /// Render one picture from each of these directions, such as front,right,top,iso
    #[arg(
        help_heading = "Camera",
        long,
        value_name = "VIEWS",
        value_delimiter = ',',
        value_parser = named_view_parser(),
        conflicts_with_all = ["view", "camera", "azimuth", "elevation", "eye", "extrinsics", "pose"]
    )]
    pub(crate) views: Vec<NamedView>,
    /// Use one scale for all --views, so that lengths can be compared between the pictures of an
    /// input
    ///
    /// The scale is the largest at which every view fits. The projection must be parallel, as with
    /// --projection orthographic.
    #[arg(help_heading = "Camera", long, requires = "views")]
    pub(crate) same_scale: bool,
    #[command(flatten)]
    pub(crate) overrides: SceneOverrideArgs,
    #[command(flatten)]
    pub(crate) region: RegionArgs,
    #[command(flatten)]
    pub(crate) passes: PassArgs,
    #[command(flatten)]
    pub(crate) compare: CompareArgs,
    #[command(flatten)]
    pub(crate) dxf: DxfArgs,
    /// Number of threads; does not change the picture [default: one per core]
    #[arg(help_heading = "Output", long, value_name = "N", value_parser = crate::options::parse_thread_count)]
    pub(crate) threads: Option<u16>,
    /// Print the time of each stage
    #[arg(help_heading = "Output", long)]
    pub(crate) timings: bool,
    /// Compare the line drawing with a z-buffer image and print the fraction that disagrees
    ///
    /// The fraction is the share of the visible lines, by length, that the z-buffer hides. Lines
    /// that cross flat faces, where the z-buffer image shows no edge, are also reported.
    #[arg(help_heading = "Lines", long)]
    pub(crate) verify: bool,
    /// Print a JSON report: size, camera, models, times, warnings, and files with SHA-256 hashes
    #[arg(help_heading = "Output", long)]
    pub(crate) json: bool,
    /// Show the picture in the terminal, with kitty's graphics protocol or half blocks
    #[arg(help_heading = "Output", long, conflicts_with = "json")]
    pub(crate) show: bool,
    #[command(flatten)]
    pub(crate) load_options: LoadArgs,
}

/// Arguments of `alberti check`.
#[derive(Debug, clap::Args)]
pub(crate) struct CheckArgs {
    /// Scene (.ron) or model (.gltf, .glb, .stl, .obj, .ply, .3mf)
    pub(crate) input: PathBuf,
    /// Print the report as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) load_options: LoadArgs,
}

/// Arguments of `alberti info`.
#[derive(Debug, clap::Args)]
pub(crate) struct InfoArgs {
    /// Model (.gltf, .glb, .stl, .obj, .ply, .3mf)
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) model_state: ModelStateArgs,
    /// Print everything as JSON
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) load_options: LoadArgs,
}

/// The values of `--style`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum StyleArg {
    /// Physically based shading with the file's normals
    Shaded,
    /// Physically based shading with one normal per triangle
    Flat,
    /// Base colors of the materials, without light
    Unlit,
    /// Gouraud shading: lit at the vertices, interpolated between them
    Gouraud,
    /// Matte clay, lit by the scene's lights
    Clay,
    /// Material capture: shading by the view-space normal only
    Matcap,
    /// World-space normals as colors: (n + 1) / 2
    Normals,
    /// Depth: near is bright
    Depth,
    /// Checkerboard of texture coordinates
    Uv,
    /// A distinct color for each mesh primitive
    Ids,
    /// Cel shading: material colors in three steps of light, with outlines
    Toon,
    /// Transparent surfaces, denser at grazing angles
    XRay,
    /// Edges of all triangles
    Wireframe,
    /// Edges of all triangles, fading with distance
    DepthCued,
    /// Line drawing with hidden lines removed
    Lines,
    /// Line drawing with hidden lines dashed
    Dashed,
    /// Only the outline
    Silhouette,
    /// Closed loops around the shape and its holes, as for cutting; with --section, around the cut
    /// faces
    Outline,
    /// Visible, hidden and tangent edges with ISO 128 line types and widths; sections have no
    /// hidden edges
    Technical,
    /// Black lines, with hatching on faces in shade, as in patents
    Patent,
    /// Like technical, but white on blue paper
    Blueprint,
    /// Pencil lines, as if drawn by hand
    Sketch,
}

/// The values of `--overlay`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum OverlayArg {
    /// Axes of world space
    Axes,
    /// Grid on the ground
    Grid,
    /// Horizon line
    Horizon,
    /// Vanishing points of the axes
    VanishingPoints,
    /// Visible edges of the surfaces
    Edges,
}

/// The values of `--projection`, each with default parameters.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ProjectionArg {
    /// Perspective: distant objects are smaller
    Perspective,
    /// Parallel, perpendicular to the picture
    Orthographic,
    /// Principal view, from the front or the direction of --view
    Multiview,
    /// All three axes foreshortened equally
    Isometric,
    /// Two axes at full length, the third at half
    Dimetric,
    /// A different foreshortening factor on each axis
    Trimetric,
    /// Oblique: the front in true shape, depth at full length at 45°
    Cavalier,
    /// Oblique: the front in true shape, depth at half length at 45°
    Cabinet,
    /// Oblique: the ground plan in true shape, heights vertical
    Military,
    /// Perspective with one vanishing point, for the depth axis
    OnePoint,
    /// Perspective with two vanishing points; verticals stay vertical
    TwoPoint,
    /// Perspective with three vanishing points
    ThreePoint,
}
