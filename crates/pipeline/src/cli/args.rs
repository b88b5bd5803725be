//! Flags and arguments.

use super::loading::LoadArgs;
use super::pick::PickArgs;
use super::sheet::SheetArgs;
use camera::NamedView;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
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

Exit codes: 0 done, 1 the input or the work failed (no output file is touched), 2 wrong usage.
`check` ends with 1 if there are errors, and with 0 if there are only warnings and notes.";

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
}

#[derive(Debug, clap::Args)]
pub(crate) struct RenderArgs {
    /// A scene (.ron) or a model (.gltf, .glb)
    pub(crate) input: PathBuf,
    /// Where the picture goes: .png, or a line drawing as .svg or .pdf [default: the input's name with .png, in the current
    /// folder]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Width and height in pixels, such as 1920x1080
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<(u32, u32)>,
    /// How surfaces are drawn
    #[arg(long)]
    pub(crate) style: Option<StyleArg>,
    /// A camera of the model, by name or by number from 0
    #[arg(long, value_name = "NAME|INDEX", conflicts_with = "view")]
    pub(crate) camera: Option<String>,
    #[command(flatten)]
    pub(crate) pick: PickArgs,
    /// Frame everything from this side
    #[arg(long, value_parser = named_view())]
    pub(crate) view: Option<NamedView>,
    /// The projection
    #[arg(long)]
    pub(crate) projection: Option<ProjectionArg>,
    /// What is drawn over the picture to explain it; may be given several times
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    pub(crate) overlay: Vec<OverlayArg>,
    /// What is seen where no model is: transparent, or a colour such as #f4f1ea
    #[arg(long, value_name = "COLOR")]
    pub(crate) background: Option<String>,
    /// Coverage samples per pixel: 1, 4, 8 or 16
    #[arg(long, value_name = "N")]
    pub(crate) samples: Option<u32>,
    /// Threads to use; the picture does not depend on it [default: as many as there are cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    pub(crate) threads: Option<u16>,
    /// Tell how long each stage took
    #[arg(long)]
    pub(crate) timings: bool,
    #[command(flatten)]
    pub(crate) load: LoadArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct CheckArgs {
    /// A scene (.ron) or a model (.gltf, .glb)
    pub(crate) input: PathBuf,
    /// The report for programs
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) load: LoadArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct InfoArgs {
    /// A model (.gltf, .glb)
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) pick: PickArgs,
    /// Everything there is to know, for programs
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) load: LoadArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum StyleArg {
    /// Lit, with the smooth normals of the file
    Shaded,
    /// Lit, each triangle with one normal
    Flat,
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

/// The views of the `camera` crate by their names.
fn named_view() -> impl TypedValueParser<Value = NamedView> {
    let value = |view: NamedView| match view {
        NamedView::Isometric => PossibleValue::new(view.name()).alias("iso"),
        _ => PossibleValue::new(view.name()),
    };
    PossibleValuesParser::new(NamedView::ALL.map(value)).try_map(|name| name.parse::<NamedView>())
}

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let fault =
        || format!("expected WIDTHxHEIGHT, such as 1920x1080, each from 1 to {}", raster::MAX_SIDE);
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(fault)?;
    let side = |digits: &str| {
        let side: u32 = digits.parse().map_err(|_| fault())?;
        (1..=raster::MAX_SIDE).contains(&side).then_some(side).ok_or_else(fault)
    };
    Ok((side(width)?, side(height)?))
}
