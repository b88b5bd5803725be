//! `alberti sweep`: one parameter of camera or lens, step by step, on one page.

use super::CliError;
use super::args::ProjectionArg;
use super::page_output::{check_panel_output, finish_panels};
use super::panel_subject::PanelSubjectArgs;
use super::progress::Progress;
use super::render::thread_count;
use super::scene_overrides::named_view;
use camera::NamedView;
use pipeline::Scene;
use pipeline::demonstration::{Sweep, SweepParameter};
use pipeline::scene::ResolveOptions;
use pipeline::scene::file::{DEFAULT_PADDING, ViewFile};
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
pub(crate) struct SweepArgs {
    /// Where the page goes: .svg, .pdf, .png or .html
    #[arg(short, long, value_name = "FILE", default_value = "sweep.svg")]
    output: PathBuf,
    /// What is varied
    #[arg(long, value_name = "WHAT")]
    vary: VaryArg,
    /// The first value, in degrees, in units of the scene or as a plain number
    #[arg(long, value_name = "A", value_parser = number, allow_hyphen_values = true)]
    from: f64,
    /// The last value
    #[arg(long, value_name = "B", value_parser = number, allow_hyphen_values = true)]
    to: f64,
    /// How many pictures, their values evenly spaced
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=64))]
    steps: u32,
    /// Show below each picture its view volume and the eye, as they stand about the models
    #[arg(long)]
    volumes: bool,
    /// Pictures in a row [default: as many as make the page about square]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=16))]
    columns: Option<u8>,
    /// Frame everything from this side to begin with
    #[arg(long, value_parser = named_view())]
    view: Option<NamedView>,
    /// The projection to begin with
    #[arg(long)]
    projection: Option<ProjectionArg>,
    #[command(flatten)]
    subject: PanelSubjectArgs,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum VaryArg {
    /// The vertical opening angle in degrees; the eye stays
    Fov,
    /// The height of the window in a parallel projection
    Height,
    /// Width by height of the window; the picture's own stays, so others distort
    Aspect,
    /// The distance of the near plane; it only cuts off
    Near,
    /// The distance of the far plane; it only cuts off
    Far,
    /// The distance of the near plane under a window of fixed size, as glFrustum has it; the angle changes
    Lens,
    /// How far the window is moved to the right, in halves of its width
    Shift,
    /// The distance of the eye from the middle of the models
    Distance,
    /// The distance too, with the angle such that the middle keeps its size (a dolly zoom)
    Dolly,
    /// Degrees around the models, counterclockwise as seen from above
    Angle,
}

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
    let options = ResolveOptions { import: args.subject.load_options.import_options() };
    let scene = Scene::resolve(&origin, &file, &options)?;
    progress.enter_stage("drawing");
    let (vary, volumes) = (args.vary.into(), args.volumes);
    let sweep = Sweep { parameter: vary, from: args.from, to: args.to, steps: args.steps, volumes };
    let mut panels = sweep.draw_panels(&scene, thread_count(args.subject.threads))?;
    panels.columns = args.columns.map_or(panels.columns, usize::from);
    finish_panels(&args.output, &panels, &scene, progress)
}

fn number(text: &str) -> Result<f64, String> {
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
