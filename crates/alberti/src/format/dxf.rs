//! DXF output: the flag for its arcs, and the warning about images that the format omits.

use super::OutputFormat;
use drawing::Warning;
use page::{DxfOptions, Page};

/// Arguments of DXF output.
#[derive(Debug, clap::Args)]
pub(crate) struct DxfArgs {
    /// Tolerance for arcs in a DXF, in millimeters on the page [default: 0.005]
    ///
    /// Points this close to a circle become an arc; 0 writes only straight lines. An arc needs at
    /// least eight evenly spaced points, less than 30 degrees apart, so polygons with up to twelve
    /// corners remain polygons.
    #[arg(help_heading = "Lines", long, value_name = "MM", value_parser = parse_tolerance)]
    arc_tolerance: Option<f64>,
}

impl DxfArgs {
    /// Whether the tolerance is set.
    pub(crate) const fn has_tolerance(&self) -> bool {
        self.arc_tolerance.is_some()
    }

    /// Returns the options with the flag's tolerance.
    pub(crate) fn apply_to(&self, options: DxfOptions) -> DxfOptions {
        DxfOptions { arc_tolerance: self.arc_tolerance.unwrap_or(options.arc_tolerance), ..options }
    }
}

/// Returns a warning if a format omits the images of a page.
pub(crate) fn image_warning<W>(format: OutputFormat, page: &Page<W>) -> Option<Warning> {
    let leaves_out = format == OutputFormat::Dxf && !page.images.is_empty();
    leaves_out.then_some(Warning::ImagesNotInDxf)
}

/// Parses a tolerance in millimeters.
fn parse_tolerance(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|mm: &f64| (0.0..=10.0).contains(mm));
    number.ok_or_else(|| "expected 0 to 10 millimeters, such as 0.01".to_owned())
}
