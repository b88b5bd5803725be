//! `alberti curve`: plots of the pipeline's functions, with their tables.

use super::format::OutputFormat;
use super::page_output::{has_extension, write_page};
use super::{CliError, print_stdout};
use drawing::Spacing;
use explorer::demonstration::{DepthRow, DepthTable};
use files::visible_path;
use projection::{Convention, DepthFormat};
use std::path::{Path, PathBuf};

/// Arguments of `alberti curve`.
#[derive(Debug, clap::Args)]
pub(crate) struct CurveArgs {
    #[command(subcommand)]
    subject: CurveSubject,
}

/// The functions that can be plotted.
#[derive(Debug, clap::Subcommand)]
enum CurveSubject {
    /// Plot depth against distance, standard and reversed, with the resolution of the depth buffer
    Depth(DepthArgs),
}

/// Arguments of `alberti curve depth`.
#[derive(Debug, clap::Args)]
struct DepthArgs {
    /// Distance of the near plane
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    near: f64,
    /// Distance of the far plane; `inf` for an infinite projection
    #[arg(long, value_name = "F", allow_hyphen_values = true)]
    far: f64,
    /// Format of the depth buffer: fixed point with 1 to 64 bits, or 32f for floating point
    #[arg(long, value_name = "N|32f", default_value = "24", value_parser = parse_depth_format)]
    bits: DepthFormat,
    /// Depths of the near and far planes; swapped for the reversed curve
    #[arg(long, value_name = "RANGE", default_value = "zero-one")]
    range: DepthRangeArg,
    /// Distances in the table, separated by commas [default: 16 from near to far, logarithmically
    /// spaced]
    #[arg(long, value_name = "DISTANCES", value_delimiter = ',', allow_hyphen_values = true)]
    distances: Vec<f64>,
    /// Spacing of the plot's distance axis
    #[arg(long, value_name = "SPACING", default_value = "logarithmic")]
    axis: AxisArg,
    /// Output file (.svg, .pdf, .dxf or .png for the plot; .txt, .md, .csv or .json for the table
    /// only) [default: the table on the standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The range of normalized device depth.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum DepthRangeArg {
    /// Near at 0, far at 1: Vulkan, Direct3D, Metal, WebGPU
    ZeroOne,
    /// Near at -1, far at 1: OpenGL, WebGL
    MinusOneOne,
}

/// The spacing of an axis.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum AxisArg {
    /// Equal lengths on the page represent equal ratios
    Logarithmic,
    /// Equal lengths on the page represent equal differences
    Linear,
}

impl From<AxisArg> for Spacing {
    fn from(axis: AxisArg) -> Self {
        match axis {
            AxisArg::Logarithmic => Self::Logarithmic,
            AxisArg::Linear => Self::Linear,
        }
    }
}

/// Formats a depth table as text.
type TableFormatter = fn(&DepthTable, &[DepthRow]) -> String;

/// The file extensions for a table without a plot, with their formatters.
///
/// Any other extension means a plot.
const TABLE_FORMATS: [(&str, TableFormatter); 4] = [
    ("txt", DepthTable::to_text),
    ("md", DepthTable::to_markdown),
    ("csv", DepthTable::to_csv),
    ("json", DepthTable::to_json),
];

/// Plots a function, or prints its table.
///
/// # Errors
/// Returns an error if the planes do not define a projection, a distance is invalid, or writing the
/// output fails.
pub(crate) fn run(args: &CurveArgs) -> Result<(), CliError> {
    let CurveSubject::Depth(args) = &args.subject;
    let convention = match args.range {
        DepthRangeArg::ZeroOne => Convention::WEBGPU,
        DepthRangeArg::MinusOneOne => Convention::OPENGL,
    };
    let table =
        DepthTable::new(args.near, args.far, convention, args.bits).map_err(projection_error)?;
    let distances = match args.distances.as_slice() {
        [] => table.default_distances(),
        given => given.to_vec(),
    };
    let rows: Vec<DepthRow> = distances
        .into_iter()
        .map(|distance| table.row_at(distance))
        .collect::<Result<_, _>>()
        .map_err(projection_error)?;
    match &args.output {
        Some(output) => write_output(output, &table, &rows, args.axis.into()),
        None => print_stdout(table.to_text(&rows).as_bytes()),
    }
}

/// Writes the table or the plot, depending on the output's extension.
///
/// For an unknown extension, the error lists every extension, not only the plot formats.
fn write_output(
    output: &Path,
    table: &DepthTable,
    rows: &[DepthRow],
    distances: Spacing,
) -> Result<(), CliError> {
    if let Some((_, written)) =
        TABLE_FORMATS.iter().find(|(ending, _)| has_extension(output, ending))
    {
        return Ok(pipeline::write_file(output, written(table, rows).as_bytes())?);
    }
    OutputFormat::from_path(output).map_err(|_| {
        let (name, extensions) =
            (visible_path(output), ".svg, .pdf, .dxf, .png, .txt, .md, .csv or .json");
        CliError::Usage(format!("{name}: unsupported output format; use {extensions}"))
    })?;
    write_page(output, &table.to_page(rows, distances))
}

/// Reports planes that define no projection, such as a near plane behind the eye, as a usage error.
fn projection_error(error: projection::ProjectionError) -> CliError {
    CliError::Usage(error.to_string())
}

/// Parses a number of bits from 1 to 64, or `32f`.
fn parse_depth_format(text: &str) -> Result<DepthFormat, String> {
    if text.eq_ignore_ascii_case("32f") {
        return Ok(DepthFormat::Float32);
    }
    let bits = text.parse().ok().filter(|bits| (1..=64).contains(bits));
    let bits = bits.map(DepthFormat::FixedPoint);
    bits.ok_or_else(|| "expected a number of bits from 1 to 64, such as 24, or 32f".to_owned())
}
