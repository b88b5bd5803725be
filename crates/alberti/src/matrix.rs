//! `alberti matrix`: identifies 4x4 and 3x3 matrices, and builds matrices from parameters.
//!
//! The numbers come from other programs, logs or books, so any brackets and separators are
//! accepted. The report names the matrix's convention (handedness, depth range, row or column
//! vectors). If a flag such as `--perspective` is set, the matrix is built from parameters instead.

mod build;
mod builders;

use super::explain::{SubjectPoint, parse_point};
use super::{CliError, print_stdout};
use build::{BuildArgs, BuildOptions, BuiltMatrix, DISTANCES};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args as _, FromArgMatches as _};
use explain::{
    ApiConventions, BareMap, Explanation, ExplanationEntry, ItemValue, Step, explain_matrix,
    explain_planar_matrix, without_rounding,
};
use glam::DMat4;
use homog::HPoint;
use recognition::{CodeLanguage, GivenMatrix, parse_matrix};
use std::io::Read as _;

/// The examples in the help.
const EXAMPLES: &str = "\
Examples:
  alberti matrix 0.9743 0 0 0  0 1.7321 0 0  0 0 -1.002 -0.2002  0 0 -1 0
                                                  the meaning of a printed matrix
  alberti matrix --look-at 0,2,-5,0,0,0 --conventions direct3d
                                                  XMMatrixLookAtLH
  alberti matrix --viewport 640,480 --perspective 60,4/3,0.1,100 --look-at 4,3,6,0,0,0 --point 0,1,0
                                                  a world-space point mapped to pixels";

/// The languages of `--code`, with their names and descriptions.
const LANGUAGES: [(&str, &str, CodeLanguage); 5] = [
    ("c", "C array of 16 doubles, column by column", CodeLanguage::C),
    ("glsl", "GLSL mat4", CodeLanguage::Glsl),
    ("python", "Python list of rows", CodeLanguage::Python),
    ("rust", "Rust array of columns, as in glam", CodeLanguage::Rust),
    ("latex", "LaTeX bmatrix", CodeLanguage::Latex),
];

/// Parses the name of a language.
fn code_parser() -> impl TypedValueParser<Value = CodeLanguage> {
    let values = LANGUAGES.map(|(name, help, _)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(values).map(|name| {
        let found = LANGUAGES.iter().find(|(known, ..)| known.eq_ignore_ascii_case(&name));
        found.map_or(CodeLanguage::Rust, |(.., language)| *language)
    })
}

/// Arguments of `alberti matrix`.
#[derive(Debug, clap::Args)]
#[command(after_help = format!(
    "For all matrices from parameters except --p, {DISTANCES}.\n\n{EXAMPLES}"
))]
pub(crate) struct MatrixArgs {
    /// Sixteen or nine numbers, row by row [default: read from the standard input]
    ///
    /// Brackets and commas between them are ignored, and fractions such as 2/3 are allowed. Source
    /// code in C, GLSL, Python and Rust is accepted in the form that --code prints. Constructors
    /// such as mat4 are read column by column. Other code is read row by row, unless its comments
    /// state another order.
    #[arg(allow_hyphen_values = true)]
    numbers: Vec<String>,
    /// Read the numbers column by column, as OpenGL, glTF and glam store them
    #[arg(long, conflicts_with = "BuildArgs")]
    column_major: bool,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
    /// Print only the matrix, as source code or LaTeX
    #[arg(long, value_name = "LANGUAGE", conflicts_with = "json", value_parser = code_parser())]
    code: Option<CodeLanguage>,
    /// Map a point with the matrix; add W for a homogeneous point, or W = 0 for a direction
    #[arg(
        long,
        value_name = "X,Y,Z[,W]",
        value_parser = parse_point,
        allow_hyphen_values = true,
        conflicts_with = "code"
    )]
    point: Option<SubjectPoint>,
    /// API conventions for a matrix from parameters [default: opengl]
    #[arg(
        long,
        value_name = "NAME",
        value_parser = super::explain::conventions_parser()
    )]
    conventions: Option<ApiConventions>,
    /// Swap the depths of near and far (reversed z)
    #[arg(long)]
    reversed: bool,
    /// Drop z, as textbook projections do (for --oblique, --axonometric and --n-point)
    #[arg(long)]
    onto_plane: bool,
    #[command(flatten)]
    build: BuildArgs,
}

/// Prints the meaning of a matrix, or the matrix that the parameters describe.
///
/// # Errors
/// Returns an error if there are neither sixteen nor nine numbers, if a number is not finite, or if
/// a parameter is invalid.
pub(crate) fn run(args: &MatrixArgs) -> Result<(), CliError> {
    match flags_after_numbers(&args.numbers) {
        Some(reordered) => run_ordered(&reordered),
        None => run_ordered(args),
    }
}

/// Returns the arguments with the flags moved to the front, if a flag follows a number.
///
/// Numbers may begin with a minus sign, so everything after the first number is parsed as a number.
fn flags_after_numbers(words: &[String]) -> Option<MatrixArgs> {
    let first = words.iter().position(|word| word.starts_with("--"))?;
    let (numbers, flags) = words.split_at(first);
    let command = MatrixArgs::augment_args(clap::Command::new("alberti matrix"));
    let reordered = ["matrix".to_owned()].into_iter().chain(flags.iter().chain(numbers).cloned());
    let matches = command.try_get_matches_from(reordered);
    let parsed = matches.and_then(|matches| MatrixArgs::from_arg_matches(&matches));
    match parsed {
        Ok(args) if !args.numbers.iter().any(|word| word.starts_with("--")) => Some(args),
        Ok(_) => None,
        Err(error) => error.exit(),
    }
}

fn run_ordered(args: &MatrixArgs) -> Result<(), CliError> {
    let options = BuildOptions {
        given_conventions: args.conventions,
        reversed: args.reversed,
        onto_plane: args.onto_plane,
    };
    args.build.check_alone(&args.numbers)?;
    if let Some(built) = args.build.build(options) {
        let built = built?;
        if let Some(language) = args.code {
            return print_stdout(language.format_matrix(rows_of(built.matrix)).as_bytes());
        }
        let found = explain_built(&built);
        return print_explanation(&map_point(found, rows_of(built.matrix), args)?, args.json);
    }
    options.check_unused()?;
    let text = if args.numbers.is_empty() { read_stdin()? } else { args.numbers.join(" ") };
    let parsed = parse_matrix(&text, args.column_major);
    let parsed = parsed.map_err(|error| CliError::Usage(error.to_string()))?;
    let (code, found) = match parsed.matrix {
        GivenMatrix::Space(rows) => {
            let found = explain_matrix(rows).map_err(CliError::Usage)?;
            (args.code.map(|language| language.format_matrix(rows)), map_point(found, rows, args)?)
        }
        GivenMatrix::Plane(_) if args.point.is_some() => {
            let message = "--point needs a 4 × 4 matrix, or a matrix from parameters";
            return Err(CliError::Usage(message.to_owned()));
        }
        GivenMatrix::Plane(rows) => {
            let found = explain_planar_matrix(rows).map_err(CliError::Usage)?;
            (args.code.map(|language| language.format_matrix(rows)), found)
        }
    };
    if let Some(code) = code {
        return print_stdout(code.as_bytes());
    }
    let order = parsed.order.map_or(String::new(), |order| format!(", read {order}"));
    let subject = found.subject.clone() + &order;
    print_explanation(&Explanation { subject, ..found }, args.json)
}

/// Adds the image of `--point` to the explanation.
fn map_point(
    found: Explanation,
    rows: [[f64; 4]; 4],
    args: &MatrixArgs,
) -> Result<Explanation, CliError> {
    let Some(point) = args.point else { return Ok(found) };
    let mapped = BareMap::from_rows(rows).explain_points(&[HPoint::from(point.numbers())]);
    let mapped = mapped.map_err(CliError::Usage)?;
    let steps = found.steps.into_iter().chain(mapped.steps.into_iter().skip(1)).collect();
    Ok(Explanation { steps, verdict: format!("{} {}", found.verdict, mapped.verdict), ..found })
}

fn print_explanation(found: &Explanation, json: bool) -> Result<(), CliError> {
    let text = if json { format!("{:#}\n", found.to_json()) } else { found.to_string() };
    print_stdout(text.as_bytes())
}

fn rows_of(matrix: DMat4) -> [[f64; 4]; 4] {
    matrix.transpose().to_cols_array_2d()
}

/// Explains the matrix, its factors in order of application, and its inverse.
fn explain_built(built: &BuiltMatrix) -> Explanation {
    let entry = |id: &str, name: &str, value: ItemValue| ExplanationEntry {
        id: id.to_owned(),
        name: name.to_owned(),
        value,
    };
    let matrix = |id: &str, name: &str, matrix: DMat4| entry(id, name, rows_of(matrix).into());
    let step = |id, title: &str, formula, items: Vec<ExplanationEntry>| Step {
        id,
        title: title.to_owned(),
        formula,
        items,
    };
    let mut whole = vec![matrix("matrix", "matrix", built.matrix)];
    whole.extend(built.note.map(|note| entry("note", "note", note.into())));
    let mut steps = vec![step("matrix", "The matrix", built.formula, whole)];
    let factors = built.factors.iter().map(|(name, factor)| (*name, *factor));
    let multiplied = built.product_of.iter().map(|(name, factor)| (name.as_str(), *factor));
    let items: Vec<_> = (1..)
        .zip(factors.chain(multiplied))
        .map(|(at, (name, factor))| matrix(&format!("factor_{at}"), name, factor))
        .collect();
    if !items.is_empty() {
        let title = "Its factors, in the order in which they are applied";
        steps.push(step("factors", title, built.factor_formula, items));
    }
    let inverse = built.matrix.inverse();
    let verdict = if inverse.is_finite() && built.matrix.determinant() != 0.0 {
        let rows = without_rounding(built.matrix, inverse);
        let inverse = vec![entry("inverse", "inverse", rows.into())];
        steps.push(step("inverse", "Inverse", None, inverse));
        "For column vectors, row by row."
    } else {
        "For column vectors, row by row. The matrix is singular, so it has no inverse."
    };
    Explanation { subject: built.subject.clone(), steps, verdict: verdict.to_owned() }
}

/// Reads the standard input as text, up to a limit far above the length of sixteen numbers.
///
/// Bytes beyond the limit are not read, because surplus numbers are an error anyway.
fn read_stdin() -> Result<String, CliError> {
    const MAX_BYTES: u64 = 1 << 16;
    let mut bytes = Vec::new();
    let read = std::io::stdin().take(MAX_BYTES).read_to_end(&mut bytes);
    let fault =
        |problem: String| CliError::Usage(format!("cannot read the standard input: {problem}"));
    read.map_err(|error| fault(error.to_string()))?;
    String::from_utf8(bytes).map_err(|_| fault("it is not UTF-8 text".to_owned()))
}
