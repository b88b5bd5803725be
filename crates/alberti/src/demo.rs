//! `alberti demo`: what goes wrong where a stage of the pipeline is left out.

use super::CliError;
use super::page_output::{check_panel_output, write_panels};
use pipeline::demonstration::wraparound_panels;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
pub(crate) struct DemoArgs {
    #[command(subcommand)]
    subject: DemoSubject,
}

#[derive(Debug, clap::Subcommand)]
enum DemoSubject {
    /// A floor that runs past the eye, divided at once and clipped first: why clipping comes before the divide
    Tear(TearArgs),
}

#[derive(Debug, clap::Args)]
struct TearArgs {
    /// Where the page goes: .svg, .pdf, .png or .html
    #[arg(short, long, value_name = "FILE", default_value = "tear.svg")]
    output: PathBuf,
}

pub(crate) fn run(args: &DemoArgs) -> Result<(), CliError> {
    let DemoSubject::Tear(args) = &args.subject;
    check_panel_output(&args.output)?;
    write_panels(&args.output, &wraparound_panels()?)
}
