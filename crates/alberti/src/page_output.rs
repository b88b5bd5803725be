//! Output of pages and panels as HTML, SVG, PDF, DXF or a raster image, according to the extension.
//!
//! An HTML page contains the panels as inline SVG and refers to no other file. The other formats
//! put all panels on one page.

use super::CliError;
use super::format::{DEFAULT_QUALITY, OutputFormat};
use super::messages::print_warnings;
use super::progress::Progress;
use super::sheet;
use drawing::{Page, Panels};
use files::visible_path;
use pipeline::Scene;
use std::path::Path;

/// Writes the panels of a scene, then prints the warnings about its models and panels.
///
/// The progress line is removed before the first warning.
///
/// # Errors
/// Returns an error if writing the output fails; in that case, no warnings are printed.
pub(super) fn finish_panels(
    output: &Path,
    panels: &Panels,
    scene: &Scene,
    progress: Progress,
) -> Result<(), CliError> {
    progress.enter_stage("writing");
    write_panels(output, panels)?;
    drop(progress);
    print_warnings(scene, &panels.warnings(), false);
    Ok(())
}

/// Writes panels as HTML or as one page; if the extension is unsupported, no file is written.
pub(super) fn write_panels(output: &Path, panels: &Panels) -> Result<(), CliError> {
    if is_html(output) {
        return Ok(pipeline::write_file(output, panels.to_html().as_bytes())?);
    }
    write_page(output, &panels.to_page())
}

/// Writes a page as SVG, PDF, DXF or a raster image.
pub(super) fn write_page(output: &Path, page: &Page) -> Result<(), CliError> {
    let format = OutputFormat::from_path(output)?;
    let bytes = match format {
        format if format.is_raster() => {
            let picture = sheet::rasterize_page(page, sheet::DEFAULT_DPI)?;
            format.encode_picture(&picture, DEFAULT_QUALITY)?
        }
        _ => format.encode_pages(std::slice::from_ref(page)),
    };
    Ok(pipeline::write_file(output, &bytes)?)
}

/// Rejects an output with an unsupported extension before any work is done.
///
/// Drawing may take a minute, too long to wait for an error about a misspelled extension.
pub(super) fn check_panel_output(output: &Path) -> Result<(), CliError> {
    if is_html(output) {
        return Ok(());
    }
    OutputFormat::from_path(output).map(|_| ()).map_err(|_| {
        let name = visible_path(output);
        CliError::Usage(format!(
            "{name}: unsupported output format; use .svg, .pdf, .dxf, .png, .jpg, .webp or .html"
        ))
    })
}

/// Whether the output is a web page.
fn is_html(output: &Path) -> bool {
    has_extension(output, "html")
}

/// Whether a file name has this extension, ignoring case.
pub(super) fn has_extension(output: &Path, ending: &str) -> bool {
    output.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}
