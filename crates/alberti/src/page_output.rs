//! Where figures go: panels and pages, as drawings, pictures or web pages, by the end of the output's name.

use super::CliError;
use super::format::OutputFormat;
use super::progress::Progress;
use super::render::print_warnings;
use super::sheet;
use drawing::{Page, Panels};
use pipeline::Scene;
use std::path::Path;

/// Writes the panels of a scene, and then what is to be said of them.
pub(super) fn finish_panels(
    output: &Path,
    panels: &Panels,
    scene: &Scene,
    progress: Progress,
) -> Result<(), CliError> {
    progress.enter_stage("writing");
    write_panels(output, panels)?;
    drop(progress);
    print_warnings(scene, &panels.warnings());
    Ok(())
}

/// Writes panels: .svg, .pdf, .png or .html. No file is touched if they cannot be written so.
pub(super) fn write_panels(output: &Path, panels: &Panels) -> Result<(), CliError> {
    if is_html(output) {
        return Ok(pipeline::write_file(output, panels.to_html().as_bytes())?);
    }
    write_page(output, &panels.to_page())
}

/// Writes a page: .svg, .pdf or .png.
pub(super) fn write_page(output: &Path, page: &Page) -> Result<(), CliError> {
    let format = OutputFormat::from_path(output)?;
    let bytes = match format {
        OutputFormat::Png => sheet::rasterize_page(page)?.to_png(),
        OutputFormat::Svg | OutputFormat::Pdf => format.encode_pages(std::slice::from_ref(page)),
    };
    Ok(pipeline::write_file(output, &bytes)?)
}

/// Refuses a name before any work is done for it.
pub(super) fn check_panel_output(output: &Path) -> Result<(), CliError> {
    if is_html(output) {
        return Ok(());
    }
    OutputFormat::from_path(output).map(|_| ()).map_err(|_| {
        let name = output.display();
        CliError::Usage(format!("the output {name} does not end in .svg, .pdf, .png or .html"))
    })
}

fn is_html(output: &Path) -> bool {
    has_extension(output, "html")
}

/// Whether a name ends so, in capitals or not.
pub(super) fn has_extension(output: &Path, ending: &str) -> bool {
    output.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}
