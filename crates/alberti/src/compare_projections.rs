//! `alberti compare-projections`: a subject in every classical projection, side by side.

use super::CliError;
use super::args::ProjectionArg;
use super::page_output::{check_panel_output, finish_panels};
use super::panel_subject::PanelSubjectArgs;
use super::progress::Progress;
use super::render::thread_count;
use clap::ValueEnum as _;
use explorer::demonstration::{NamedProjection, projection_panels};
use pipeline::Scene;
use scene::ResolveOptions;
use std::path::PathBuf;

/// Arguments of `alberti compare-projections`.
#[derive(Debug, clap::Args)]
pub(crate) struct CompareProjectionsArgs {
    /// Output file (.svg, .pdf, .dxf, .png or .html)
    #[arg(short, long, value_name = "FILE", default_value = "projections.svg")]
    output: PathBuf,
    /// Projections to show, in this order [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    projections: Vec<ProjectionArg>,
    /// Panels per row [default: chosen for a roughly square page]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=16))]
    columns: Option<u8>,
    #[command(flatten)]
    subject: PanelSubjectArgs,
}

/// Draws the page of panels.
pub(crate) fn run(args: &CompareProjectionsArgs) -> Result<(), CliError> {
    check_panel_output(&args.output)?;
    let progress = Progress::start("loading");
    let (origin, file) = args.subject.open_scene()?;
    let options = ResolveOptions::with_import(args.subject.load_options.import_options());
    let scene = Scene::resolve(&origin, &file, &options)?;
    progress.enter_stage("drawing");
    let members = select_members(&args.projections);
    let threads = thread_count(args.subject.threads);
    let mut panels = projection_panels(&origin, &file, &scene.models, &members, threads)?;
    panels.columns = args.columns.map_or(panels.columns, usize::from);
    finish_panels(&args.output, &panels, &scene, progress)
}

/// Returns the requested projections without duplicates, or all of them by default.
///
/// A panel's name is the flag's value, so that it can be copied to `--projection`. A repeated
/// projection gets one panel, at its first position.
fn select_members(wanted: &[ProjectionArg]) -> Vec<NamedProjection> {
    let all = if wanted.is_empty() { ProjectionArg::value_variants() } else { wanted };
    let mut members: Vec<NamedProjection> = Vec::new();
    for projection in all {
        let value = projection.to_possible_value();
        let name = value.map(|value| value.get_name().to_owned()).unwrap_or_default();
        if members.iter().all(|member| member.name != name) {
            members.push(NamedProjection { name, projection: (*projection).into() });
        }
    }
    members
}
