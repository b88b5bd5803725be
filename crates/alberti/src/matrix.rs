//! `alberti matrix`: the meaning of a 4x4 or 3x3 matrix, and matrices from parameters.
//!
//! The numbers come from other programs, logs or books, so any brackets and separators are
//! accepted, and the report names the convention (handedness, depth range, row or column vectors)
//! that makes sense of them. With a flag such as `--perspective` the matrix is built instead.

mod build;
mod code;

use super::{CliError, print_stdout};
use build::{BuildArgs, BuildOptions, BuiltMatrix};
use clap::{Args as _, FromArgMatches as _};
use code::CodeLanguage;
use glam::DMat4;
use pipeline::explain::{
    ApiConventions, Explanation, ExplanationEntry, Step, explain_matrix, explain_planar_matrix,
};
use std::io::Read as _;

/// Arguments of `alberti matrix`.
#[derive(Debug, clap::Args)]
pub(crate) struct MatrixArgs {
    /// Sixteen or nine numbers, row by row [default: read from the standard input]
    ///
    /// Brackets and commas between them are ignored; fractions such as 2/3 are numbers.
    #[arg(allow_hyphen_values = true, conflicts_with = "BuildArgs")]
    numbers: Vec<String>,
    /// Read the numbers column by column, as OpenGL, glTF and glam store them
    #[arg(long, conflicts_with = "BuildArgs")]
    column_major: bool,
    /// Print the report as JSON
    #[arg(long)]
    json: bool,
    /// Print the matrix alone, as source code or LaTeX
    #[arg(long, value_name = "LANGUAGE", conflicts_with = "json")]
    code: Option<CodeLanguage>,
    /// API conventions of the matrix that is built from parameters
    #[arg(
        long,
        value_name = "NAME",
        default_value = "opengl",
        value_parser = super::explain::conventions_parser()
    )]
    conventions: ApiConventions,
    /// Exchange the depths of near and far (reversed z)
    #[arg(long, requires = "BuildArgs")]
    reversed: bool,
    /// Drop z, as the projections of the textbooks do: --oblique, --axonometric, --n-point
    #[arg(long, requires = "BuildArgs")]
    onto_plane: bool,
    #[command(flatten)]
    build: BuildArgs,
}

/// Prints the meaning of a matrix, or the matrix that the parameters describe.
///
/// # Errors
/// If there are neither sixteen nor nine numbers, one of them is not finite, or a parameter is
/// refused.
pub(crate) fn run(args: &MatrixArgs) -> Result<(), CliError> {
    match flags_after_numbers(&args.numbers) {
        Some(reordered) => run_ordered(&reordered),
        None => run_ordered(args),
    }
}

/// The arguments again with the flags first, if one stands behind a number.
///
/// Numbers may begin with a minus sign, so everything behind the first one is taken for a number.
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
        conventions: args.conventions,
        reversed: args.reversed,
        onto_plane: args.onto_plane,
    };
    if let Some(built) = args.build.build(options) {
        let built = built?;
        if let Some(language) = args.code {
            return print_stdout(language.format_matrix(rows_of(built.matrix)).as_bytes());
        }
        return print_explanation(&explain_built(&built), args.json);
    }
    let text = if args.numbers.is_empty() { read_stdin()? } else { args.numbers.join(" ") };
    let given = parse_matrix(&text, args.column_major).map_err(CliError::Usage)?;
    let (code, found) = match given {
        GivenMatrix::Space(rows) => {
            (args.code.map(|language| language.format_matrix(rows)), explain_matrix(rows))
        }
        GivenMatrix::Plane(rows) => {
            (args.code.map(|language| language.format_matrix(rows)), explain_planar_matrix(rows))
        }
    };
    let found = found.map_err(CliError::Usage)?;
    match code {
        Some(code) => print_stdout(code.as_bytes()),
        None => print_explanation(&found, args.json),
    }
}

fn print_explanation(found: &Explanation, json: bool) -> Result<(), CliError> {
    let text = if json { format!("{:#}\n", found.to_json()) } else { found.to_string() };
    print_stdout(text.as_bytes())
}

fn rows_of(matrix: DMat4) -> [[f64; 4]; 4] {
    matrix.transpose().to_cols_array_2d()
}

/// The matrix, its factors in the order a point passes them, and its inverse.
fn explain_built(built: &BuiltMatrix) -> Explanation {
    let entry = |id: &str, name: &str, matrix: DMat4| ExplanationEntry {
        id: id.to_owned(),
        name: name.to_owned(),
        value: rows_of(matrix).into(),
    };
    let step = |id, title: &str, items: Vec<ExplanationEntry>| Step {
        id,
        title: title.to_owned(),
        formula: None,
        items,
    };
    let whole = step("matrix", "The matrix", vec![entry("matrix", "matrix", built.matrix)]);
    let mut steps = vec![Step { formula: Some(built.formula), ..whole }];
    if !built.factors.is_empty() {
        let numbered = (1..).zip(&built.factors);
        let items =
            numbered.map(|(at, (name, factor))| entry(&format!("factor_{at}"), name, *factor));
        let title = "Its factors, the one that is applied first at the top";
        steps.push(step("factors", title, items.collect()));
    }
    let inverse = built.matrix.inverse();
    let verdict = if inverse.is_finite() && built.matrix.determinant() != 0.0 {
        steps.push(step("inverse", "Its inverse", vec![entry("inverse", "inverse", inverse)]));
        "For column vectors, row by row."
    } else {
        "For column vectors, row by row. A dimension is lost: there is no inverse."
    };
    Explanation { subject: built.subject.clone(), steps, verdict: verdict.to_owned() }
}

/// A matrix of space or of the plane, by rows.
#[derive(PartialEq, Debug)]
enum GivenMatrix {
    Space([[f64; 4]; 4]),
    Plane([[f64; 3]; 3]),
}

/// Reads the standard input as text, up to a limit that sixteen numbers cannot reach.
///
/// Further bytes are not read, and surplus numbers give the error of a wrong count.
fn read_stdin() -> Result<String, CliError> {
    const MAX_BYTES: u64 = 1 << 16;
    let mut bytes = Vec::new();
    let read = std::io::stdin().take(MAX_BYTES).read_to_end(&mut bytes);
    let fault =
        |problem: String| CliError::Usage(format!("cannot read the standard input: {problem}"));
    read.map_err(|error| fault(error.to_string()))?;
    String::from_utf8(bytes).map_err(|_| fault("it is not UTF-8 text".to_owned()))
}

/// Parses the rows of a matrix from sixteen or nine numbers between any brackets, commas and
/// spaces.
///
/// ```text
/// 1 0 0 2  0 1 0 1/2  0 0 1 -1e3  0 0 0 1
/// [[1,0,0,2],[0,1,0,.5],[0,0,1,-1000],[0,0,0,1]]
/// ```
/// Rows are for column vectors: translation is in the last column. Numbers stored column by
/// column, as in OpenGL, are transposed here.
fn parse_matrix(text: &str, columns: bool) -> Result<GivenMatrix, String> {
    let between = |c: char| c.is_whitespace() || "[](){},;|".contains(c);
    let words = text.split(between).filter(|word| !word.is_empty());
    let numbers: Vec<f64> = words.map(parse_number).collect::<Result<_, _>>()?;
    match numbers.len() {
        16 => Ok(GivenMatrix::Space(arrange(&numbers, columns))),
        9 => Ok(GivenMatrix::Plane(arrange(&numbers, columns))),
        found => Err(format!("expected 16 numbers, or 9 of a 3 × 3 matrix, found {found}")),
    }
}

/// The rows of N × N numbers listed by rows, or by columns.
fn arrange<const N: usize>(listed: &[f64], columns: bool) -> [[f64; N]; N] {
    let at = |row: usize, column: usize| if columns { N * column + row } else { N * row + column };
    std::array::from_fn(|row| std::array::from_fn(|column| listed[at(row, column)]))
}

/// Parses a number or a fraction such as `2/3`, also with the minus sign of printed text.
///
/// A division by zero gives an infinite number, which is rejected later with all others that are
/// not finite.
fn parse_number(word: &str) -> Result<f64, String> {
    let fault = || format!("`{word}` is not a number");
    let parse = |digits: &str| digits.replace('−', "-").parse::<f64>().map_err(|_| fault());
    match word.split_once('/') {
        Some((above, below)) => Ok(parse(above)? / parse(below)?),
        None => parse(word),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brackets_commas_and_fractions_are_accepted() {
        let rows = [
            [1.0, 0.0, 0.0, 2.0],
            [0.0, 1.0, 0.0, 0.5],
            [0.0, 0.0, 1.0, -1e3],
            [0.0, 0.0, 0.0, 1.0],
        ];
        let space = Ok(GivenMatrix::Space(rows));
        assert_eq!(parse_matrix("1 0 0 2 0 1 0 1/2 0 0 1 −1e3 0 0 0 1", false), space);
        assert_eq!(parse_matrix("[[1,0,0,2],[0,1,0,.5],[0,0,1,-1000],[0,0,0,1]]", false), space);
        assert_eq!(parse_matrix("(1 0 0 0) (0 1 0 0) (0 0 1 0) (2 0.5 -1000 1)", true), space);
        let plane = GivenMatrix::Plane([[1.0, 0.0, -0.5], [0.0, 1.0, 2.0], [0.0, 0.0, 1.0]]);
        assert_eq!(parse_matrix("1 0 -.5 0 1 2 0 0 1", false), Ok(plane));
        let message = "expected 16 numbers, or 9 of a 3 × 3 matrix, found 3";
        assert_eq!(parse_matrix("1 2 3", false), Err(message.to_owned()));
        assert_eq!(parse_matrix("1 x", false), Err("`x` is not a number".to_owned()));
    }
}
