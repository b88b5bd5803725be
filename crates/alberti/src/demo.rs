//! `alberti demo`: the artifacts that appear when a pipeline stage is skipped.
//!
//! A demonstration draws a fixed scene twice, with and without the stage, in panels with captions.
//! It needs no input, so its output can be compared byte by byte.

use super::CliError;
use super::page_output::{check_panel_output, write_panels};
use explorer::demonstration::wraparound_panels;
use std::path::PathBuf;

/// Arguments of `alberti demo`.
#[derive(Debug, clap::Args)]
pub(crate) struct DemoArgs {
    #[command(subcommand)]
    subject: DemoSubject,
}

/// The demonstrations.
#[derive(Debug, clap::Subcommand)]
enum DemoSubject {
    /// Draw a floor that extends behind the eye, with and without clipping before the divide
    ///
    /// Points behind the eye have w < 0: divided without clipping, they wrap around infinity and
    /// reappear on the wrong side of the picture.
    WrapAround(WrapAroundArgs),
}

/// Arguments of `alberti demo wrap-around`.
#[derive(Debug, clap::Args)]
struct WrapAroundArgs {
    /// Output file (.svg, .pdf, .dxf, .png or .html)
    #[arg(short, long, value_name = "FILE", default_value = "wrap-around.svg")]
    output: PathBuf,
}

/// Draws a demonstration.
pub(crate) fn run(args: &DemoArgs) -> Result<(), CliError> {
    let DemoSubject::WrapAround(args) = &args.subject;
    check_panel_output(&args.output)?;
    write_panels(&args.output, &wraparound_panels()?)
}
