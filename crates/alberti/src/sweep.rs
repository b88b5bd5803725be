//! `alberti sweep`: a series of panels that vary one camera parameter.

use super::CliError;
use super::args::ProjectionArg;
use super::page_output::{check_panel_output, finish_panels};
use super::panel_subject::PanelSubjectArgs;
use super::progress::Progress;
use super::render::thread_count;
use super::scene_overrides::named_view_parser;
use camera::NamedView;
use explorer::demonstration::{Sweep, SweepParameter};
use pipeline::Scene;
use scene::ResolveOptions;
use scene_file::file::{DEFAULT_PADDING, ViewFile};
use std::path::PathBuf;

/// Arguments of `alberti sweep`.
#[derive(Debug, clap::Args)]
pub(crate) struct SweepArgs {
    /// Output file (.svg, .pdf, .dxf, .png or .html)
    #[arg(short, long, value_name = "FILE", default_value = "sweep.svg")]
    output: PathBuf,
    /// Parameter to vary
    #[arg(long, value_name = "WHAT")]
    vary: VaryArg,
    /// First value, in degrees or scene units, or a plain number
    #[arg(long, value_name = "A", value_parser = parse_number, allow_hyphen_values = true)]
    from: f64,
    /// Last value
    #[arg(long, value_name = "B", value_parser = parse_number, allow_hyphen_values = true)]
    to: f64,
    /// Number of panels; their values are evenly spaced
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=64))]
    steps: u32,
    /// Draw the view volume and the eye, seen from outside, below each panel
    #[arg(long)]
    view_volumes: bool,
    /// Panels per row [default: chosen for a roughly square page]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=16))]
    columns: Option<u8>,
    /// Initial view: frame all models from this direction
    #[arg(long, value_parser = named_view_parser())]
    view: Option<NamedView>,
    /// Initial projection
    #[arg(long)]
    projection: Option<ProjectionArg>,
    #[command(flatten)]
    subject: PanelSubjectArgs,
}

/// The parameters of a sweep, by their names as values of `--vary`.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum VaryArg {
    /// Vertical field of view in degrees, with a fixed eye
    Fov,
    /// Height of the window of a parallel projection
    Height,
    /// Aspect ratio of the window; the picture keeps its aspect ratio, so other values distort it
    Aspect,
    /// Distance of the near plane
    Near,
    /// Distance of the far plane
    Far,
    /// Distance of the near plane with a window of fixed size, as in glFrustum
    Lens,
    /// Lens shift to the right, in half widths of the window
    Shift,
    /// Distance of the eye from the center of the models
    Distance,
    /// Dolly zoom: the distance, with a field of view that keeps the center the same size
    Dolly,
    /// Orbit angle around the models in degrees, counterclockwise as seen from above
    Angle,
}

/// Draws the page of panels.
///
/// The initial camera is the scene's, with `--view` and `--projection` applied; each panel then
/// changes one of its parameters. Models are loaded once for all panels.
///
/// # Errors
/// Returns an error if the input is invalid, or if the parameter is out of range or does not apply.
pub(crate) fn run(args: &SweepArgs) -> Result<(), CliError> {
    check_panel_output(&args.output)?;
    let progress = Progress::start("loading");
    let (origin, mut file) = args.subject.open_scene()?;
    if let Some(view) = args.view {
        let from = Some(view.into());
        file.camera.view = ViewFile::Frame { from, padding_percent: DEFAULT_PADDING };
    }
    if let Some(projection) = args.projection {
        file.camera.projection = Some(projection.into());
    }
    let options = ResolveOptions::with_import(args.subject.load_options.import_options());
    let scene = Scene::resolve(&origin, &file, &options)?;
    progress.enter_stage("drawing");
    let (vary, volumes) = (args.vary.into(), args.view_volumes);
    let sweep = Sweep { parameter: vary, from: args.from, to: args.to, steps: args.steps, volumes };
    let mut panels = sweep.draw_panels(&scene, thread_count(args.subject.threads))?;
    panels.columns = args.columns.map_or(panels.columns, usize::from);
    finish_panels(&args.output, &panels, &scene, progress)
}

/// Parses a finite number.
fn parse_number(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| "expected a number, such as 35 or 0.5".to_owned())
}

impl From<VaryArg> for SweepParameter {
    fn from(arg: VaryArg) -> Self {
        match arg {
            VaryArg::Fov => Self::Fov,
            VaryArg::Height => Self::Height,
            VaryArg::Aspect => Self::Aspect,
            VaryArg::Near => Self::Near,
            VaryArg::Far => Self::Far,
            VaryArg::Lens => Self::Lens,
            VaryArg::Shift => Self::Shift,
            VaryArg::Distance => Self::Distance,
            VaryArg::Dolly => Self::Dolly,
            VaryArg::Angle => Self::Angle,
        }
    }
}
