//! `alberti curve`: curves of the pipeline's formulas, with their tables.

use super::format::OutputFormat;
use super::page_output::{has_extension, write_page};
use super::{CliError, print_stdout};
use pipeline::demonstration::{DepthRow, DepthTable};
use projection::{Convention, DepthFormat};
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
pub(crate) struct CurveArgs {
    #[command(subcommand)]
    subject: CurveSubject,
}

#[derive(Debug, clap::Subcommand)]
enum CurveSubject {
    /// Depth after the divide against distance, normal and reversed, and how finely it can tell distances apart
    Depth(DepthArgs),
}

#[derive(Debug, clap::Args)]
struct DepthArgs {
    /// The distance of the near plane
    #[arg(long, value_name = "N")]
    near: f64,
    /// The distance of the far plane; `inf` for none
    #[arg(long, value_name = "F")]
    far: f64,
    /// How depth is stored: whole numbers of so many bits, 1 to 64, or `32f` for floating point
    #[arg(long, value_name = "N|32f", default_value = "24", value_parser = parse_bits)]
    bits: DepthFormat,
    /// Which depths the near and the far plane have; reversed they are the other way round
    #[arg(long, value_name = "WHICH", default_value = "zero-one")]
    range: DepthRangeArg,
    /// The distances of the table, with commas between [default: sixteen from near to far, in equal ratios]
    #[arg(long, value_name = "DISTANCES", value_delimiter = ',')]
    at: Vec<f64>,
    /// Where it goes: curves and table as .svg, .pdf or .png, the table alone as .txt, .md or .csv [default: the table, to the
    /// standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum DepthRangeArg {
    /// Near at 0, far at 1: Vulkan, Direct3D, Metal, WebGPU
    ZeroOne,
    /// Near at -1, far at 1: OpenGL, WebGL
    MinusOneOne,
}

/// The ways in which a table is written without its curves.
type TableFormatter = fn(&DepthTable, &[DepthRow]) -> String;
const TABLE_FORMATS: [(&str, TableFormatter); 3] =
    [("txt", DepthTable::to_text), ("md", DepthTable::to_markdown), ("csv", DepthTable::to_csv)];

pub(crate) fn run(args: &CurveArgs) -> Result<(), CliError> {
    let CurveSubject::Depth(args) = &args.subject;
    let convention = match args.range {
        DepthRangeArg::ZeroOne => Convention::WEBGPU,
        DepthRangeArg::MinusOneOne => Convention::OPENGL,
    };
    let table =
        DepthTable::new(args.near, args.far, convention, args.bits).map_err(projection_error)?;
    let distances = if args.at.is_empty() { table.default_distances() } else { args.at.clone() };
    let rows: Vec<DepthRow> = distances
        .into_iter()
        .map(|distance| table.row_at(distance))
        .collect::<Result<_, _>>()
        .map_err(projection_error)?;
    match &args.output {
        Some(output) => write_output(output, &table, &rows),
        None => print_stdout(table.to_text(&rows).as_bytes()),
    }
}

fn write_output(output: &Path, table: &DepthTable, rows: &[DepthRow]) -> Result<(), CliError> {
    if let Some((_, written)) =
        TABLE_FORMATS.iter().find(|(ending, _)| has_extension(output, ending))
    {
        return Ok(pipeline::write_file(output, written(table, rows).as_bytes())?);
    }
    OutputFormat::from_path(output).map_err(|_| {
        let (name, endings) = (output.display(), ".svg, .pdf, .png, .txt, .md or .csv");
        CliError::Usage(format!("the output {name} does not end in {endings}"))
    })?;
    write_page(output, &table.to_page(rows))
}

fn projection_error(error: projection::ProjectionError) -> CliError {
    CliError::Usage(error.to_string())
}

fn parse_bits(text: &str) -> Result<DepthFormat, String> {
    if text.eq_ignore_ascii_case("32f") {
        return Ok(DepthFormat::Float32);
    }
    let bits = text.parse().ok().filter(|bits| (1..=64).contains(bits));
    let bits = bits.map(DepthFormat::FixedPoint);
    bits.ok_or_else(|| "expected a number of bits from 1 to 64, such as 24, or 32f".to_owned())
}
