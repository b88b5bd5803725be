//! Flags and arguments.

use super::animate::AnimateArgs;
use super::batch::BatchArgs;
use super::color::ColorChoice;
use super::compare::CompareArgs;
use super::compare_projections::CompareProjectionsArgs;
use super::curve::CurveArgs;
use super::demo::DemoArgs;
use super::explain::ExplainArgs;
use super::format::OutputFormat;
use super::load_options::LoadArgs;
use super::manual::{CompletionArgs, ManArgs};
use super::matrix::MatrixArgs;
use super::model_state::ModelStateArgs;
use super::passes::PassArgs;
use super::reference::ReferenceArgs;
use super::region::RegionArgs;
use super::scene::SceneArgs;
use super::scene_overrides::{SceneOverrideArgs, named_view};
use super::sheet::SheetArgs;
use super::sweep::SweepArgs;
use camera::NamedView;
use clap::{Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Pictures of glTF models, without a GPU, a display or a browser.
///
/// The same input gives the same bytes on every machine, whatever the number of threads.
#[derive(Debug, Parser)]
#[command(name = "alberti", version, max_term_width = 100, after_help = EXAMPLES)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Colours in messages; with `auto` on a terminal, unless the variable NO_COLOR says no
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub(crate) color: ColorChoice,
}

const EXAMPLES: &str = "\
Examples:
  alberti render model.glb                        a picture in model.png, framed and lit
  alberti render model.glb --view front --size 512x512 -o thumb.png
  alberti render scene.ron                        a scene: models, camera, lights, style
  alberti render model.glb -o model.svg           a line drawing, hidden lines removed
  alberti sheet model.glb --paper a4              front, top, side and isometric view to scale
  alberti info model.glb                          what is in the file
  alberti check model.glb                         what is wrong with the file
  alberti matrix 1 0 0 0 …                        what sixteen numbers are
  alberti explain model.glb --point 0,1,0         where a point goes, stage by stage
  alberti compare-projections model.glb           isometric, cavalier, two-point …, side by side
  alberti sweep model.glb --vary dolly --from 3 --to 12
  alberti curve depth --near 0.1 --far 1000 -o depth.svg
  alberti demo tear                               why clipping comes before the divide
  alberti animate model.glb --turntable -o turn.png
  alberti batch models --out thumbs --size 256x256
  alberti scene init model.glb                    a scene file to begin with
  alberti reference camera                        what a field or a flag means

Exit codes: 0 done, 1 the input or the work failed (no output file is touched), 2 wrong usage.
`check` ends with 1 if there are errors, and with 0 if there are only warnings and notes; `render --compare` ends with 1 if the
pictures differ, and all files are written.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene file or a bare model to a PNG, or as a line drawing to an SVG or a PDF
    Render(RenderArgs),
    /// Draw the views of a scene or a model on paper, to scale: front, top, side and isometric
    Sheet(SheetArgs),
    /// Tell what is in a model: meshes, bounds, cameras, materials, extensions
    Info(InfoArgs),
    /// Tell everything that is wrong with a scene or a model, with its place and a remedy
    Check(CheckArgs),
    /// Tell what a 4x4 matrix is: which map, which projection, in whose convention, or which known misprint
    Matrix(MatrixArgs),
    /// Follow a point, a segment, a vertex or a triangle of a scene through every stage
    Explain(ExplainArgs),
    /// Draw a subject in every projection of the textbooks, side by side, with formulas and numbers
    CompareProjections(CompareProjectionsArgs),
    /// Vary one parameter of camera or lens, and draw the pictures side by side
    Sweep(SweepArgs),
    /// Draw a curve of the pipeline, with its table: depth against distance
    Curve(CurveArgs),
    /// Show what goes wrong where a stage is left out
    Demo(DemoArgs),
    /// Make a film: a turntable, or the model's own animation
    Animate(AnimateArgs),
    /// Make pictures of many models: thumbnails, a report, a contact sheet
    Batch(BatchArgs),
    /// Begin, check and lay out scene files, and tell what they may say
    Scene(SceneArgs),
    /// Write the completions of a shell to the standard output
    Completions(CompletionArgs),
    /// Write the manual page of the program or of a command
    Man(ManArgs),
    /// Tell what every flag and every field of scene files means
    Reference(ReferenceArgs),
}

#[derive(Debug, clap::Args)]
pub(crate) struct RenderArgs {
    /// Scenes (.ron) or models (.gltf, .glb); `-` reads one from the standard input
    #[arg(required = true, value_name = "INPUT")]
    pub(crate) inputs: Vec<PathBuf>,
    /// Where the picture goes: .png, or a line drawing as .svg or .pdf; `-` is the standard output. In the name {stem}, {camera},
    /// {view}, {style}, {projection} and {variant} stand for the input's name and what the flags say, {frame} for the number of
    /// the picture among those of its input and {index} among all, both from 0; {index:04} has four digits, {{ and }} are braces
    /// [default: {stem}.png in the current folder, {stem}_{view}.png for several views]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// What is written [default: by the end of the output's name; png to the standard output]
    #[arg(long)]
    pub(crate) format: Option<OutputFormat>,
    /// A picture from each of these sides, such as front,right,top,iso
    #[arg(long, value_name = "VIEWS", value_delimiter = ',', value_parser = named_view(), conflicts_with_all = ["view", "camera"])]
    pub(crate) views: Vec<NamedView>,
    #[command(flatten)]
    pub(crate) overrides: SceneOverrideArgs,
    #[command(flatten)]
    pub(crate) region: RegionArgs,
    #[command(flatten)]
    pub(crate) passes: PassArgs,
    #[command(flatten)]
    pub(crate) compare: CompareArgs,
    /// Threads to use; the picture does not depend on it [default: as many as there are cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
    /// Tell how long each stage took
    #[arg(long)]
    pub(crate) timings: bool,
    /// Compare the line drawing with a z-buffer image, and tell how much of what is drawn as visible that hides
    #[arg(long)]
    pub(crate) verify: bool,
    /// Tell what was rendered, for programs: size, camera, models, times, warnings, files with their SHA-256
    #[arg(long)]
    pub(crate) json: bool,
    /// Show the picture in the terminal: by kitty's graphics where it has them, else in half blocks
    #[arg(long, conflicts_with = "json")]
    pub(crate) show: bool,
    #[command(flatten)]
    pub(crate) load_options: LoadArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct CheckArgs {
    /// A scene (.ron) or a model (.gltf, .glb)
    pub(crate) input: PathBuf,
    /// The report for programs
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) load_options: LoadArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct InfoArgs {
    /// A model (.gltf, .glb)
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) model_state: ModelStateArgs,
    /// Everything there is to know, for programs
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) load_options: LoadArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum StyleArg {
    /// Lit, with the smooth normals of the file
    Shaded,
    /// Lit, each triangle with one normal
    Flat,
    /// Lit at the corners of triangles and blended over them
    Gouraud,
    /// Matt clay in the light of the scene
    Clay,
    /// A ball of glazed clay that faces the viewer alike
    Matcap,
    /// Normals in the world as colours: (n + 1) / 2
    Normals,
    /// The nearer, the brighter
    Depth,
    /// A checkerboard by texture coordinates
    Uv,
    /// A colour for each part
    Ids,
    /// The colours of materials in three steps of light, with outlines
    Toon,
    /// As if of glass: denser along the line of sight
    XRay,
    /// The edges of all triangles
    Wireframe,
    /// The edges of all triangles, paler the farther away they are
    DepthCued,
    /// A line drawing with hidden lines removed
    Lines,
    /// A line drawing with hidden lines dashed
    Dashed,
    /// The outline alone
    Silhouette,
    /// Visible, hidden and tangent edges with the line types and widths of ISO 128
    Technical,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum OverlayArg {
    /// The axes of the world
    Axes,
    /// A grid on the ground
    Grid,
    /// Where horizontal directions vanish
    Horizon,
    /// Where the axes vanish
    VanishingPoints,
    /// The edges of the surfaces, where they can be seen
    Edges,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ProjectionArg {
    /// What is farther away is smaller
    Perspective,
    /// Parallel, at right angles to the picture
    Orthographic,
    /// The front in true shape, or what --view names
    Multiview,
    /// All three axes shortened alike
    Isometric,
    /// x and y in full, z by half
    Dimetric,
    /// Each axis shortened by a factor of its own
    Trimetric,
    /// The front in true shape, depth in full at 45°
    Cavalier,
    /// The front in true shape, depth by half at 45°
    Cabinet,
    /// The ground plan in true shape, heights straight up
    Military,
    /// Lines in depth meet in one point
    OnePoint,
    /// Uprights stay upright, the other lines meet in two points
    TwoPoint,
    /// Uprights meet too
    ThreePoint,
}
